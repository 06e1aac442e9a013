"""The page "Your robot in CI in five minutes": its commands are run in an empty folder, and print what is shown."""

from __future__ import annotations

import doctest
import os
import re
import shutil
import stat
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.metadata import entry_points
from pathlib import Path

import pytest

from conftest import ROBOTS, ROOT

PAGE = ROOT / "docs/ci/five_minutes.md"
# `...` is any number of lines, spaces and line ends do not count.
FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
# What differs from machine to machine: times, and the lines that pytest fills up to the width of the terminal.
OF_A_MACHINE = [(r"\bin \d+\.\d+s( \(\d+:\d+:\d+\))?", "in <time>"), (r"={3,}", "==="), (r"_{3,}", "___")]

pytestmark = pytest.mark.skipif(shutil.which("sh") is None, reason="the commands are lines of a shell")


@dataclass
class Block:
    """A block of code with the words behind its fence, and its place in the page."""

    words: list[str]
    text: str
    line: int

    def word(self, key: str) -> str | None:
        """The value of a word such as ``exit=1``."""
        return next((word.removeprefix(key) for word in self.words if word.startswith(key)), None)

    def commands(self) -> Iterator[tuple[str, str]]:
        """Each command with what it prints."""
        for part in re.split(r"^\$ ", self.text, flags=re.MULTILINE)[1:]:
            command, _, printed = part.partition("\n")
            yield command, printed


def blocks() -> list[Block]:
    text = PAGE.read_text(encoding="utf-8")
    found = re.finditer(r"^```(\S[^\n]*)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    return [Block(one[1].split(), one[2], text.count("\n", 0, one.start()) + 1) for one in found]


def plain(text: str) -> str:
    """A text without what differs from machine to machine."""
    for pattern, word in OF_A_MACHINE:
        text = re.sub(pattern, word, text)
    return text


@pytest.fixture
def shell(tmp_path: Path) -> Iterator[tuple[Path, dict[str, str]]]:
    """An empty folder with arm.urdf, and an environment in which the commands are those of this Python."""
    programs = tmp_path / "bin"
    programs.mkdir()
    for name in ("congruent", "pytest"):
        program = programs / name
        program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m {name} "$@"\n')
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
    # Those of the machine that runs this test: CI and the width change what pytest prints.
    others = ("CI", "BUILD_NUMBER", "GITHUB_ACTIONS", "FORCE_COLOR", "PYTEST_ADDOPTS", "PYTEST_DISABLE_PLUGIN_AUTOLOAD")
    environment = {name: value for name, value in os.environ.items() if name not in others}
    environment |= {"PATH": f"{programs}{os.pathsep}{environment['PATH']}", "COLUMNS": "80"}
    folder = tmp_path / "home"
    folder.mkdir()
    shutil.copy(ROBOTS / "ur5e/ur5e.urdf", folder / "arm.urdf")
    yield folder, environment


def test_every_command_prints_what_is_shown(shell: tuple[Path, dict[str, str]]) -> None:
    folder, environment = shell
    count = 0
    for block in blocks():
        if (name := block.word("file=")) is not None:
            (folder / name).write_text(block.text)
        if block.words[0] != "shell-session":
            continue
        commands = list(block.commands())
        for at, (command, shown) in enumerate(commands):
            count += 1
            if command.startswith("pip install"):
                is_installed(command)
                continue
            ended = subprocess.run(command, shell=True, cwd=folder, env=environment, capture_output=True, text=True)
            place = f"{PAGE.name}:{block.line}: $ {command}\n{ended.stdout}{ended.stderr}"
            assert ended.returncode == (int(block.word("exit=") or 0) if at == len(commands) - 1 else 0), place
            if shown.strip():
                assert doctest.OutputChecker().check_output(plain(shown), plain(ended.stdout), FLAGS), place
    assert count >= 10


def is_installed(command: str) -> None:
    """The wheel is installed before the tests are run, as there is no network here: what it brings must be there."""
    assert command == "pip install target/wheels/congruent-*.whl pytest"
    assert command.split()[2] in (ROOT / "docs/python.md").read_text(encoding="utf-8")
    assert entry_points(group="pytest11", name="congruent")


def test_the_workflow_is_short_and_runs_the_test() -> None:
    [workflow] = [block for block in blocks() if block.words[0] == "yaml"]
    assert len(workflow.text.splitlines()) <= 15
    yaml = pytest.importorskip("yaml")
    job = yaml.safe_load(workflow.text)["jobs"]["robots"]
    assert [step["run"] for step in job["steps"] if "run" in step] == ['pip install "$WHEEL" pytest', "pytest"]
    assert job["env"]["WHEEL"].endswith(".whl")


def test_the_test_module_has_three_lines() -> None:
    [module] = [block for block in blocks() if block.words[0] == "python"]
    assert len(module.text.splitlines()) == 3
