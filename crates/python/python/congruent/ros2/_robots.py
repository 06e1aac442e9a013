"""What the command ``congruent describe`` knows of a robot, which ``Robot`` does not have."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

from ._transport import RosError


def command(*words: str, accepted: tuple[int, ...] = (0,)) -> str:
    """What the command prints. What it has to say to the user goes to standard error."""
    done = subprocess.run([sys.executable, "-m", "congruent", *words], stdout=subprocess.PIPE, encoding="utf-8")
    if done.returncode not in accepted:
        raise RosError(f"congruent {words[0]} has ended with exit code {done.returncode}")
    return done.stdout


def moving_joints(robot: str) -> set[str]:
    """The joints that move, those among them that follow others."""
    joints = json.loads(command("describe", robot, "--format", "json"))["joints"]
    return {joint["name"] for joint in joints if joint["kind"] != "fixed"}


def urdf_of(robot: str) -> str:
    """The text of its URDF; of a robot without one, what the command converts it to."""
    described = json.loads(command("describe", robot, "--format", "json"))
    if described["format"] == "URDF" and described["urdf"]:
        return Path(described["urdf"]).read_text(encoding="utf-8")
    return command("convert", robot, "--to", "urdf")
