"""The command that the package installs."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import congruent

# Where pip puts scripts: beside Python, or in the folder that a wheel is installed into.
PLACES = [Path(sys.executable).parent, Path(congruent.__file__).parents[1] / "bin"]


def test_the_script_is_the_command(root: Path) -> None:
    scripts = [place / "congruent" for place in PLACES if (place / "congruent").exists()]
    assert scripts, "there is no script: install the wheel, as crates/python/test does"
    script = scripts[0]
    version = subprocess.run([script, "--version"], capture_output=True, text=True)
    assert version.returncode == 0 and version.stdout.startswith("congruent ")
    check = subprocess.run([script, "check", "robots/ur5e", "-q"], cwd=root, capture_output=True, text=True)
    assert check.returncode == 0 and "SAME ROBOT" in check.stdout
    wrong = subprocess.run([script, "chekc"], capture_output=True, text=True)
    assert wrong.returncode == 2 and "check" in wrong.stderr


def test_a_closed_pipe_is_no_traceback(root: Path) -> None:
    head = shutil.which("head")
    if head is None:
        pytest.skip("there is no head")
    line = f'"{sys.executable}" -m congruent describe robots/ur5e --format json | "{head}" -c 1'
    ended = subprocess.run(line, shell=True, cwd=root, capture_output=True, text=True)
    assert "Traceback" not in ended.stderr
