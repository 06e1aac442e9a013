"""The examples of the guide are run, and print what is shown."""

import doctest
import importlib.util
from pathlib import Path

import pytest

import congruent

FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


ENGINES = "## Does the simulator simulate my file?"


def test_the_page(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(root)
    before, section, rest = (root / "docs/python.md").read_text().partition(ENGINES)
    assert section
    if importlib.util.find_spec("mujoco") is None:
        # Its examples need MuJoCo.
        rest = rest[rest.index("\n## ") :]
    page = tmp_path / "python.md"
    page.write_text(before + rest)
    failed, tried = doctest.testfile(str(page), module_relative=False, optionflags=FLAGS)
    assert failed == 0 and tried > 25


def test_the_package(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(root)
    failed, tried = doctest.testmod(congruent, optionflags=FLAGS)
    assert failed == 0 and tried >= 3
