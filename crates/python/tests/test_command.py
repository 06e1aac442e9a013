"""The command that the package installs."""

import shutil
import signal
import subprocess
import sys
import time
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


def test_an_interrupted_run_ends_in_order(root: Path, tmp_path: Path) -> None:
    words = [sys.executable, "-m", "congruent", "run", "scenarios/ur5e_pick.toml", "--out", str(tmp_path)]
    running = subprocess.Popen(
        [*words, "--set", "simulation.step_s=1e-5"], cwd=root, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    # The recording is begun when the run is.
    while not list(tmp_path.glob("*/*.partial")) and running.poll() is None:
        time.sleep(0.02)
    running.send_signal(signal.SIGINT)
    printed, errors = running.communicate(timeout=60)
    assert running.returncode == 3 and "Traceback" not in errors, errors
    assert "interrupted" in printed and list(tmp_path.glob("*/report.json"))
