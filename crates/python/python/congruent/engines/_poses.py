"""The poses of any function, such as the kinematics of a controller: the screws of its joints are identified from them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any

import numpy as np

from .._errors import CongruentError
from .._native import Robot, identified_screws, robot_of_screws
from ._engine import Precision, refused
from ._loaded import Array, floats, quaternion_of

CODE, ID = "python::poses", "CGR-PYTHON-005"
CONFIGURATIONS = 48
"""Configurations at which the screws are verified. Kind: choice."""
STEPS_RAD = 1.3
"""How far from the middle of a range a joint is asked, at most, to identify its screw; less in a range that is smaller."""
SLIDE_M = 0.5
"""Half of the range in which joints are asked that slide without limits."""
ROTATION = 1e-5
"""How far a matrix may be from a rotation. Kind: choice; six digits of a printed matrix are enough."""
MILLIMETRES = (900.0, 1100.0)
"""Lengths that are so many times those of the file are in mm."""


def asked(poses: Any, joints: Any, robot: Robot) -> Robot:
    """The chain that a function shows.

    ``poses`` takes q, (joints,), in rad and m and in the order of ``joints``, and gives ``base_from_tip``, (4, 4). Joints that
    do not move the tip are at 0.

    Raises ``CongruentError`` if it raises or gives no pose, or if its joints do not turn or slide about fixed axes.
    """
    function = _Function(poses, _named(joints, robot), robot)
    for order in _orders(function):
        chain = _Chain.identified(function, order)
        if chain.is_proved:
            function.refuse_millimetres()
            return robot_of_screws(chain.text(), function.name, chain.residual)
    chain = _Chain.identified(function, function.moving)
    off_m, off_rad = chain.residual
    message = (
        f"{function.name}: no chain of joints that turn or slide about fixed axes gives them, with the joints {', '.join(function.moving)} in "
        f"any order given: they are up to {off_m:.3g} m and {off_rad:.3g} rad off"
    )
    raise refused(message, "the function has to be a rigid chain: no limits, no coupling, no rounding to few digits", CODE, ID)


def _named(joints: Any, robot: Robot) -> list[str]:
    names = list(joints) if not isinstance(joints, str) else [joints]
    for name in names:
        if name not in robot.joints:
            near = get_close_matches(str(name), robot.joints, 1, 0.0)
            raise refused(
                f'joints names "{name}", which is no joint that moves by itself in {robot.path}',
                f'did you mean "{near[0]}"?' if near else None,
                CODE,
                ID,
            )
        if names.count(name) > 1:
            raise refused(f'joints names "{name}" twice', "one name for each entry of q", CODE, ID)
    return names


class _Function:
    """A function of poses that is asked at positions of the joints that move the tip."""

    def __init__(self, poses: Callable[[Array], Any], joints: list[str], robot: Robot) -> None:
        if not callable(poses):
            raise refused(f"poses: {type(poses).__name__} cannot be called", "poses=lambda q: my_fk(q)", CODE, ID)
        written = str(getattr(poses, "__name__", type(poses).__name__))
        self._called = "poses of the function" if written == "<lambda>" else f"poses of {written}"
        self._poses, self._joints, self._robot = poses, joints, robot
        self.is_single = False
        limits = dict(zip(robot.joints, robot.limits))
        self.moving = self._moving(limits)
        lacking = [name for name in self.moving if name not in joints]
        if lacking:
            message = f'joints lacks "{lacking[0]}", which moves "{robot.tip}"'
            raise refused(message, "name the joints of q in its order, or choose another tip=", CODE, ID)
        self.limits = {name: limits[name] for name in self.moving}

    @property
    def name(self) -> str:
        """What reports call it."""
        return f"{self._called} (32-bit numbers)" if self.is_single else self._called

    def _moving(self, limits: dict[str, Array]) -> list[str]:
        """The joints that move the tip, from base to tip."""
        middle = [np.clip(0.3 + 0.1 * at, *limits[name]) for at, name in enumerate(self._robot.joints)]
        jacobian = self._robot.jacobian(middle)
        return [name for at, name in enumerate(self._robot.joints) if np.abs(jacobian[:, at]).max() > 1e-12]

    def asked_range(self, joint: str) -> tuple[float, float]:
        """Middle and half width of the positions at which a joint is asked."""
        lower, upper = self.limits[joint]
        if not np.isfinite([lower, upper]).all():
            return 0.0, STEPS_RAD
        return float(lower + upper) / 2, min(STEPS_RAD, float(upper - lower) / 2)

    def at(self, positions: dict[str, float]) -> list[list[float]]:
        """The pose at these positions, (4, 4), as the function gives it."""
        q = np.array([positions.get(name, 0.0) for name in self._joints])
        where = ", ".join(f"{name} = {value:.6g}" for name, value in zip(self._joints, q))
        try:
            given = self._poses(q.copy())
        except Exception as error:
            raise self._refused(f"it raises {type(error).__name__}: {error}", where) from error
        return [floats(row) for row in self._pose(given, where)]

    def refuse_millimetres(self) -> None:
        """Refuses lengths in mm: all of them differ from those of the file by the same factor."""
        places = {name: self.asked_range(name) for name in self.moving}
        q = [{name: middle + share * half for name, (middle, half) in places.items()} for share in (-0.5, 0.0, 0.5)]
        far = max(float(np.linalg.norm(np.array(self.at(of))[:3, 3])) for of in q)
        expected = max(float(np.linalg.norm(self._robot.fk(of)[:3, 3])) for of in q)
        if MILLIMETRES[0] * expected < far < MILLIMETRES[1] * expected:
            raise refused(
                f"{self.name}: its lengths are {far / expected:.6g} times those of the file",
                "it has to give m, and not mm",
                CODE,
                ID,
            )

    def _pose(self, given: Any, where: str) -> Array:
        if hasattr(given, "homogeneous"):
            given = given.homogeneous
        try:
            matrix = np.asarray(given)
            self.is_single |= matrix.dtype == np.float32
            matrix = matrix.astype(float)
        except (TypeError, ValueError):
            raise self._refused(f"it gives {type(given).__name__}, and no array of numbers", where) from None
        if matrix.shape != (4, 4):
            raise self._refused(f"it gives an array of shape {matrix.shape}, and not (4, 4)", where)
        if not np.isfinite(matrix).all():
            raise self._refused(f"it gives values that are not finite: {matrix.tolist()}", where)
        rotation = matrix[:3, :3]
        off = max(float(np.abs(rotation.T @ rotation - np.eye(3)).max()), float(np.abs(matrix[3] - [0, 0, 0, 1]).max()))
        if off > ROTATION or np.linalg.det(rotation) < 0:
            raise self._refused(
                f"it gives a matrix that is no homogeneous one with a rotation (off by {off:.2g}): {matrix.tolist()}", where
            )
        # The nearest rotation, so that digits of the matrix do not stretch the arm.
        u, _, v = np.linalg.svd(rotation)
        matrix[:3, :3] = u @ v
        return matrix

    def _refused(self, what: str, where: str) -> CongruentError:
        return refused(
            f"{self.name}: {what}, at {where}", "it has to give base_from_tip as a homogeneous matrix, (4, 4), in m", CODE, ID
        )


def _orders(function: _Function) -> list[list[str]]:
    """The orders from base to tip in which the joints may be: that of the file, and that of q, if names are exchanged."""
    given = [name for name in function._joints if name in function.moving]
    return [function.moving] if given == function.moving else [function.moving, given]


@dataclass(frozen=True)
class _Chain:
    function: _Function
    joints: list[str]
    twists: list[Sequence[float]]
    """At zero, in the base: angular, then linear, (6,) each."""
    home: Array
    residual: tuple[float, float]

    @classmethod
    def identified(cls, function: _Function, joints: list[str]) -> _Chain:
        """The chain with its joints in this order from base to tip."""
        places = [function.asked_range(joint) for joint in joints]
        middle, half = [place[0] for place in places], [place[1] / STEPS_RAD for place in places]

        def at(q: Sequence[float]) -> list[list[float]]:
            return function.at(dict(zip(joints, q)))

        rng = np.random.default_rng(0)
        ends = np.array([_ends(*function.limits[joint]) for joint in joints])
        verified = rng.uniform(ends[:, 0], ends[:, 1], (CONFIGURATIONS, len(joints)))
        twists, home, residual = identified_screws(at, middle, half, [floats(row) for row in verified])
        return cls(function, joints, list(twists), np.array(home), residual)

    @property
    def _precision(self) -> Precision:
        return Precision.single() if self.function.is_single else Precision.double()

    @property
    def is_proved(self) -> bool:
        """Whether the poses are those of the screws, to the precision of the numbers."""
        limit = self._precision
        return self.residual[0] <= limit.position_m and self.residual[1] <= limit.orientation_rad

    def text(self) -> str:
        """The chain as a robot file with all digits: what its residual leaves open is said beside it."""
        home = f"xyz_m = {_numbers(self.home[:3, 3])}, quaternion_wxyz = {_numbers(quaternion_of(self.home[:3, :3]))}"
        lines = [f'name = "{self.function.name}"', "[poe]", 'frame = "space"', f"home = {{ {home} }}"]
        for joint, twist in zip(self.joints, self.twists):
            lines += ["[[poe.joint]]", *self._joint(joint, np.array(twist))]
        return "\n".join(lines)

    def _joint(self, joint: str, twist: Array) -> list[str]:
        angular, linear = twist[:3], twist[3:]
        rate = float(np.linalg.norm(angular))
        least = self._precision.orientation_rad
        turns = rate > least
        rate = rate if turns else float(np.linalg.norm(linear))
        if abs(rate - 1) > least:
            raise self._refused(
                f'"{joint}" moves {rate:.10g} times as far as q says', "q is in rad and m: does the function take degrees or mm?"
            )
        if turns and abs(float(angular @ linear)) > self._precision.position_m:
            raise self._refused(f'"{joint}" slides {float(angular @ linear):.3g} m/rad along the axis about which it turns', None)
        key = "range_rad" if turns else "range_m"
        limits = self.function.limits[joint]
        lines = [f'joint = "{self._label(joint)}"', f'kind = "{"revolute" if turns else "prismatic"}"']
        lines.append(f"omega = {_numbers(angular / rate if turns else np.zeros(3))}")
        lines.append(f"v_m = {_numbers(linear if turns else linear / rate)}")
        # The function says nothing of limits: those of the file are no difference.
        return [*lines, f"{key} = [{float(limits[0])!r}, {float(limits[1])!r}]"] if np.isfinite(limits).all() else lines

    def _label(self, joint: str) -> str:
        """Its name; with its place in q if the places say something else than the names."""
        at = self.joints.index(joint)
        if joint == self.function.moving[at]:
            return joint
        return f"q[{at}], called {joint}"

    def _refused(self, what: str, help: str | None) -> CongruentError:
        return refused(f"{self.function.name}: {what}", help, CODE, ID)


def _numbers(values: Any) -> str:
    return "[" + ", ".join(f"{value:.17f}" for value in values) + "]"


def _ends(lower: float, upper: float) -> tuple[float, float]:
    is_finite = np.isfinite([lower, upper]).all()
    return (float(lower), float(upper)) if is_finite else (-np.pi, np.pi)
