"""The messages, in m, rad and s: what both transports carry, without either of them."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum, IntEnum
from typing import TypeAlias


@dataclass(frozen=True)
class JointState:
    """Values of joints by position in the lists; a list may be empty, or of another length if the sender is at fault."""

    time_s: float
    """Stamp of the sender; 0 if it has given none."""
    name: list[str]
    position: list[float]
    velocity: list[float] = field(default_factory=list)
    effort: list[float] = field(default_factory=list)


@dataclass(frozen=True)
class Transform:
    """The pose ``frame_from_child``."""

    time_s: float
    frame: str
    child: str
    translation_m: list[float]
    quaternion_wxyz: list[float]


@dataclass(frozen=True)
class Transforms:
    """One message of TF."""

    transforms: list[Transform]


class Level(IntEnum):
    """The levels of ``diagnostic_msgs/DiagnosticStatus``."""

    OK = 0
    WARN = 1
    ERROR = 2
    STALE = 3


@dataclass(frozen=True)
class Status:
    """One line of the diagnostics."""

    level: Level
    name: str
    message: str
    robot: str
    values: dict[str, str]


@dataclass(frozen=True)
class Diagnostics:
    """All that is known at a time."""

    time_s: float
    statuses: list[Status]


@dataclass(frozen=True)
class Text:
    """A text, such as a URDF."""

    text: str


@dataclass(frozen=True)
class Unreadable:
    """A message whose bytes are not of its type."""

    reason: str


Message: TypeAlias = JointState | Transforms | Diagnostics | Text


class Kind(Enum):
    """Types of topics, with their names in ROS."""

    JOINT_STATE = "sensor_msgs/JointState"
    TRANSFORMS = "tf2_msgs/TFMessage"
    DIAGNOSTICS = "diagnostic_msgs/DiagnosticArray"
    TEXT = "std_msgs/String"
