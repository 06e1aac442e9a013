"""The calculations of a course in robotics: transforms, Euler angles, rows of a table, twists, exponentials and logarithms.

Lengths are in m and angles in rad. A transform ``a_from_b`` is a homogeneous matrix, (4, 4): the pose of b in a. A twist is
angular, then linear, (6,), as in Lynch & Park; texts that write the linear part first exchange the two halves.

Every function raises ``CongruentError`` if a matrix is no rotation, or a shape or a name is wrong.

>>> import numpy as np
>>> from congruent import spatial
>>> np.allclose(spatial.log(spatial.turn_z(0.3) @ spatial.shift_x(0.0)), [0, 0, 0.3, 0, 0, 0])
True
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np
from numpy import float64
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._errors import CongruentError, Finding

__all__ = [
    "DhRow",
    "EulerAngles",
    "ToolAxes",
    "adjoint",
    "dh_row_from_transform",
    "dh_transform",
    "euler_angles",
    "euler_rotation",
    "exp",
    "hat",
    "log",
    "rotation_exp",
    "rotation_log",
    "shift_x",
    "shift_y",
    "shift_z",
    "tip_velocity",
    "tool_axes",
    "tool_pose",
    "turn_x",
    "turn_y",
    "turn_z",
]

Array = NDArray[float64]


def turn_x(angle_rad: float) -> Array:
    """A turn about x, (4, 4). Source: Siciliano et al., *Robotics* (2009), sections 2.2.1 and 2.4."""
    return np.array(_native.elementary("turn_x", angle_rad))


def turn_y(angle_rad: float) -> Array:
    """A turn about y, (4, 4). Source: Siciliano et al., *Robotics* (2009), sections 2.2.1 and 2.4."""
    return np.array(_native.elementary("turn_y", angle_rad))


def turn_z(angle_rad: float) -> Array:
    """A turn about z, (4, 4). Source: Siciliano et al., *Robotics* (2009), sections 2.2.1 and 2.4."""
    return np.array(_native.elementary("turn_z", angle_rad))


def shift_x(by_m: float) -> Array:
    """A shift along x, (4, 4). Source: Siciliano et al., *Robotics* (2009), sections 2.2.1 and 2.4."""
    return np.array(_native.elementary("shift_x", by_m))


def shift_y(by_m: float) -> Array:
    """A shift along y, (4, 4). Source: Siciliano et al., *Robotics* (2009), sections 2.2.1 and 2.4."""
    return np.array(_native.elementary("shift_y", by_m))


def shift_z(by_m: float) -> Array:
    """A shift along z, (4, 4). Source: Siciliano et al., *Robotics* (2009), sections 2.2.1 and 2.4."""
    return np.array(_native.elementary("shift_z", by_m))


class EulerAngles(NamedTuple):
    """The angles of one rotation."""

    angles_rad: Array
    """First, middle, last, (3,). The middle one is in -pi/2 to pi/2, of a set like ``zyz`` in 0 to pi."""
    other_rad: Array
    """The other solution, (3,)."""
    determined: str
    """``both``; in a singular position ``sum`` or ``difference``: only that of the first and the last angle, and the first is
    0."""
    from_singular_rad: float
    """How far the middle angle is from the nearest singular position."""


def euler_rotation(axes: str, angles_rad: ArrayLike) -> Array:
    """The rotation of three turns in a row, (3, 3): ``zyx`` is ``Rz(first) Ry(middle) Rx(last)``, each about an axis of the
    frame that the one before has turned. All twelve sets are known.

    Source: Craig, *Introduction to Robotics* (3rd ed. 2005), section 2.8 and appendix B.
    """
    return np.array(_native.euler_rotation(axes, _row(angles_rad, 3, "angles_rad")))


def euler_angles(axes: str, rotation: ArrayLike) -> EulerAngles:
    """The angles of a rotation, (3, 3), both solutions, and how well it determines them.

    Source: Craig (2005), eq. 2.66 to 2.75.
    """
    angles, other, determined, distance = _native.euler_angles(axes, _rows(rotation, 3, "rotation"))
    return EulerAngles(np.array(angles), np.array(other), determined, distance)


class ToolAxes(NamedTuple):
    """The axes and the origin of a tool in its base, (3,) each."""

    normal: Array
    sliding: Array
    approach: Array
    origin_m: Array


def tool_axes(base_from_tool: ArrayLike) -> ToolAxes:
    """Normal, sliding and approach, the columns of the rotation. Source: Spong, Hutchinson & Vidyasagar, *Robot Modeling and
    Control* (2006), section 3.2.2."""
    matrix = np.array(_rows(base_from_tool, 4, "base_from_tool"))
    return ToolAxes(matrix[:3, 0], matrix[:3, 1], matrix[:3, 2], matrix[:3, 3])


def tool_pose(sliding: ArrayLike, approach: ArrayLike, origin_m: ArrayLike, normal: ArrayLike | None = None) -> Array:
    """``base_from_tool`` of a tool with these axes, (4, 4). Without ``normal``, sliding and approach may have any length;
    approach is kept, and sliding is made perpendicular to it. Source: Spong, Hutchinson & Vidyasagar (2006), section 3.2.2."""
    vectors = [_row(of, 3, name) for of, name in ((sliding, "sliding"), (approach, "approach"), (origin_m, "origin_m"))]
    return np.array(_native.tool_pose(None if normal is None else _row(normal, 3, "normal"), *vectors))


class DhRow(NamedTuple):
    """A row of a Denavit-Hartenberg table."""

    a_m: float
    alpha_rad: float
    d_m: float
    theta_rad: float


def dh_transform(row: Sequence[float], convention: Literal["standard", "modified"] = "standard") -> Array:
    """The transform of a row ``(a_m, alpha_rad, d_m, theta_rad)``, (4, 4).

    Source: Spong, Hutchinson & Vidyasagar (2006), eq. 3.10, ``Rz(theta) Tz(d) Tx(a) Rx(alpha)``; for ``modified`` Craig (2005),
    eq. 3.6, ``Rx(alpha) Tx(a) Rz(theta) Tz(d)``.
    """
    return np.array(_native.dh_transform(convention, _row(row, 4, "row")))


def dh_row_from_transform(transform: ArrayLike, convention: Literal["standard", "modified"] = "standard") -> DhRow:
    """The row with this transform, which is unique.

    Four parameters cannot hold the six of a rigid motion: ``CongruentError`` names DH1, if the x axis of one frame is not
    perpendicular to the z axis of the other, and DH2, if it does not meet it, with the deviation in deg and m.

    Source: Spong, Hutchinson & Vidyasagar (2006), section 3.2.1.
    """
    return DhRow(*_native.dh_row(convention, _rows(transform, 4, "transform")))


def hat(twist: ArrayLike) -> Array:
    """The matrix of a twist, (4, 4). Source: Lynch & Park, *Modern Robotics* (2017), section 3.3.2."""
    return np.array(_native.twist_matrix(_row(twist, 6, "twist")))


def adjoint(a_from_b: ArrayLike) -> Array:
    """The matrix that takes twists of b to twists of a, (6, 6). Source: Lynch & Park (2017), definition 3.20."""
    return np.array(_native.adjoint(_rows(a_from_b, 4, "a_from_b")))


def exp(twist: ArrayLike, scalar: float = 1.0) -> Array:
    """The motion along a twist times a number, (4, 4): the matrix exponential. Source: Lynch & Park (2017), proposition 3.25,
    eq. 3.88."""
    return np.array(_native.twist_exp(_row(twist, 6, "twist"), scalar))


def log(transform: ArrayLike) -> Array:
    """The twist whose exponential is the transform, (6,): the matrix logarithm. Source: Lynch & Park (2017), section 3.3.3.2."""
    return np.array(_native.twist_log(_rows(transform, 4, "transform")))


def rotation_exp(turn_rad: ArrayLike) -> Array:
    """The rotation about the direction of a vector by its length, (3, 3): Rodrigues' formula. Source: Lynch & Park (2017), eq.
    3.51."""
    return np.array(_native.exp_of_rotation(_row(turn_rad, 3, "turn_rad")))


def rotation_log(rotation: ArrayLike) -> Array:
    """The vector of a rotation, (3,), of length 0 to pi. The inverse of Lynch & Park (2017), eq. 3.51."""
    return np.array(_native.log_of_rotation(_rows(rotation, 3, "rotation")))


def tip_velocity(robot: _native.Robot, q: ArrayLike, qd: ArrayLike) -> Array:
    """The velocity of the tip in the axes of the base, ``V = J qd``, (6,): angular in rad/s, then that of the origin of the tip
    in m/s.

    Source: Siciliano et al. (2009), section 3.1, the geometric Jacobian.
    """
    return np.asarray(robot.jacobian(_row(q, robot.dof, "q"))) @ np.array(_row(qd, robot.dof, "qd"))


def _row(values: ArrayLike, count: int, name: str) -> list[float]:
    array = _numbers(values, name)
    if array.shape != (count,):
        raise _wrong_shape(name, array.shape, f"({count},)")
    return [float(value) for value in array]


def _rows(values: ArrayLike, count: int, name: str) -> list[list[float]]:
    array = _numbers(values, name)
    if array.shape != (count, count):
        raise _wrong_shape(name, array.shape, f"({count}, {count})")
    return [[float(value) for value in row] for row in array]


def _numbers(values: ArrayLike, name: str) -> Array:
    try:
        return np.asarray(values, float)
    except (TypeError, ValueError):
        raise _wrong_shape(name, (), "numbers") from None


def _wrong_shape(name: str, shape: tuple[int, ...], expected: str) -> CongruentError:
    message = f"{name} has shape {shape}, expected {expected}"
    return CongruentError(message, [Finding("error", "python::array", "CGR-PYTHON-001", message, None, None, None, None)])
