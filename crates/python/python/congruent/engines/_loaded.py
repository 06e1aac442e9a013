"""What an engine has loaded, in the same terms for all engines: links, and joints between them.

Units are m, kg, s and rad; of a joint that slides N, N s/m and kg. The frame of a link is that of the joint which carries it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy import float64
from numpy.typing import NDArray

Array = NDArray[float64]


@dataclass(frozen=True)
class LoadedLink:
    """A rigid part; with mass 0 and no inertia it is a frame."""

    name: str
    mass_kg: float = 0.0
    com_m: Sequence[float] = (0.0, 0.0, 0.0)
    """Centre of mass in the link, (3,)."""
    tensor_kg_m2: Sequence[Sequence[float]] = ((0.0,) * 3,) * 3
    """Inertia about the centre of mass, in the axes of the link, (3, 3)."""


@dataclass(frozen=True)
class LoadedJoint:
    """A joint between two links: ``hinge``, ``slide`` or ``fixed``."""

    name: str
    kind: str
    parent: str
    child: str
    position_m: Sequence[float] = (0.0, 0.0, 0.0)
    """Origin of the joint in its parent link, (3,)."""
    quaternion_wxyz: Sequence[float] = (1.0, 0.0, 0.0, 0.0)
    """Its orientation there, (4,)."""
    axis: Sequence[float] = (0.0, 0.0, 1.0)
    """Axis in the joint, (3,)."""
    range: Sequence[float] | None = None
    """Least and largest position; ``None`` without limits."""
    effort: float | None = None
    """Largest torque or force; ``None`` if the engine has none."""
    velocity: float | None = None
    damping: float = 0.0
    friction: float = 0.0
    armature: float = 0.0
    follows: tuple[str, float, float] | None = None
    """``(leader, factor, offset)`` if its position is ``factor * leader + offset``."""


@dataclass(frozen=True)
class LoadedModel:
    """All that an engine has loaded of one robot."""

    name: str
    """What reports call it, as ``MuJoCo 4.0.0 (loaded model)``."""
    robot: str
    links: list[LoadedLink]
    joints: list[LoadedJoint]
    forces: list[str] = field(default_factory=list)
    """What the engine computes with and a robot has no place for, such as springs, one sentence each."""
    couples: bool = True
    """Whether it says which joints follow others; if not, those of the file follow here as well."""
    is_single_precision: bool = False
    """Whether its numbers have 32 bits."""

    within: tuple[float, float] = (0.0, 0.0)
    """How far the engine's own poses are from those of the numbers, at most, m and rad."""

    @property
    def root(self) -> str:
        """The link that no joint carries."""
        carried = {joint.child for joint in self.joints}
        return next(link.name for link in self.links if link.name not in carried)

    def without_friction(self) -> LoadedModel:
        """The same without dry friction, which has no value at rest."""
        return replace(self, joints=[replace(joint, friction=0.0) for joint in self.joints])


def free_name(wanted: str, taken: Iterable[str]) -> str:
    """The name, or with a number behind it if it is taken."""
    names, name, number = set(taken), wanted, 2
    while name in names:
        name, number = f"{wanted} {number}", number + 1
    return name


def matrix_of(position_m: Sequence[float], quaternion_wxyz: Sequence[float]) -> Array:
    """A pose as a homogeneous matrix, (4, 4)."""
    w, x, y, z = np.asarray(quaternion_wxyz, float) / np.linalg.norm(quaternion_wxyz)
    matrix = np.eye(4)
    matrix[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    matrix[:3, 3] = position_m
    return matrix


def quaternion_of(rotation: Array) -> list[float]:
    """A rotation matrix, (3, 3), as a unit quaternion w, x, y, z: the eigenvector of the largest eigenvalue of Bar-Itzhack's
    matrix (Journal of Guidance, Control, and Dynamics 23, 2000), which needs no branches."""
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = rotation
    symmetric = np.array(
        [
            [xx + yy + zz, zy - yz, xz - zx, yx - xy],
            [zy - yz, xx - yy - zz, xy + yx, xz + zx],
            [xz - zx, xy + yx, yy - xx - zz, yz + zy],
            [yx - xy, xz + zx, yz + zy, zz - xx - yy],
        ]
    )
    vector = np.linalg.eigh(symmetric)[1][:, -1]
    return [float(value) for value in vector * (1.0 if vector[0] >= 0 else -1.0)]


def inverse(matrix: Array) -> Array:
    """The inverse of a homogeneous matrix, (4, 4)."""
    turned = matrix[:3, :3].T
    result = np.eye(4)
    result[:3, :3], result[:3, 3] = turned, -turned @ matrix[:3, 3]
    return result


def floats(values: Iterable[float]) -> list[float]:
    """Numbers of any array as those of Python, which have 64 bits."""
    return [float(value) for value in values]
