"""Which files are robots, and the references that a robot file names. Nothing is checked here."""

from __future__ import annotations

import glob
import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROBOT_FILE = "robot.toml"

# The rule of `congruent check --changed`: lines that robot files have, and other files in TOML do not.
_LINE_OF_ROBOT_FILE = re.compile(r"[ \t]*(?:(?:urdf|description)[ \t]*=|\[dh[\].]|\[\[dh\.|dh\.|\[poe\]|\[\[poe\.)", re.MULTILINE)
# The same for an MJCF: its root element, behind a byte order mark, the declaration and comments.
_MJCF = re.compile(r"\ufeff?\s*(?:(?:<!--.*?-->|<\?.*?\?>)\s*)*<mujoco[\s>/]", re.DOTALL)


class NoRobot(Exception):
    """A pattern that matches no robot."""


@dataclass(frozen=True)
class FoundRobots:
    """The robots of a pattern."""

    folder: Path
    """The folder that the pattern is relative to."""
    robots: list[Path]
    """Absolute paths, in the order of their names."""


def find(pattern: str, folders: Iterable[Path]) -> FoundRobots:
    """The robots of a pattern, in the first of the folders that has one."""
    looked_at: list[str] = []
    for folder in dict.fromkeys(folders):
        # An absolute pattern takes the place of the folder.
        matches = sorted(Path(match) for match in glob.glob(str(Path(glob.escape(str(folder))) / pattern), recursive=True))
        robots = [match for match in matches if not glob.has_magic(pattern) or why_no_robot(match) is None]
        if robots:
            return FoundRobots(folder, robots)
        looked_at.append(f"  {folder}" + ("" if matches else ": no file matches"))
        looked_at.extend(f"  {match}: {why_no_robot(match)}" for match in matches[:10])
    raise NoRobot("\n".join([f'congruent_check("{pattern}"): no robot in', *looked_at]))


def why_no_robot(path: Path) -> str | None:
    """Why a pattern passes over a path; ``None`` if it is a robot."""
    if path.is_dir():
        return None if (path / ROBOT_FILE).is_file() else f"a folder without {ROBOT_FILE}"
    ending = path.suffix.lower()
    if path.name == ROBOT_FILE or ending == ".urdf":
        return None
    if ending == ".toml":
        return None if _LINE_OF_ROBOT_FILE.search("\n" + _text(path)) else "no robot file: it has neither urdf nor [dh] nor [poe]"
    if ending == ".xml":
        return None if _MJCF.match(_text(path)) else "no MJCF: its root element is not <mujoco>"
    return "neither a robot file nor a URDF nor an MJCF"


def robot_file(robot: Path) -> Path | None:
    """The robot file of a robot; ``None`` for a URDF or an MJCF."""
    if robot.is_dir():
        return robot / ROBOT_FILE
    return robot if robot.suffix.lower() == ".toml" else None


def references(robot: Path) -> list[str] | None:
    """The files that the robot file names under ``[[reference]]``, as it writes them; ``None`` if they cannot be read here, which
    the check then says or does without."""
    file = robot_file(robot)
    if file is None:
        return []
    document = parsed(_text(file))
    named = None if document is None else document.get("reference", [])
    if not isinstance(named, list) or not all(isinstance(one, dict) and isinstance(one.get("file"), str) for one in named):
        return None
    return [one["file"] for one in named]


def parsed(text: str) -> dict[str, Any] | None:
    """A document in TOML; ``None`` if it is none, or if Python 3.10 is without tomli, which pytest brings there."""
    try:
        import tomllib as toml
    except ModuleNotFoundError:
        try:
            import tomli as toml  # type: ignore[import-not-found,no-redef,unused-ignore]
        except ModuleNotFoundError:
            return None
    try:
        return toml.loads(text.removeprefix("\ufeff"))
    except ValueError:
        return None


def _text(path: Path) -> str:
    """The text of a file; what cannot be read is empty, and what is wrong with it is found by the check."""
    try:
        return path.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""
