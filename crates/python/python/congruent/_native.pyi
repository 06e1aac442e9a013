"""Types and documentation of the compiled part.

Units are m, kg, s and rad, N m for joints that turn and N for joints that slide. ``q`` and its like are a configuration, (joints,),
or many, (n, joints), in the order of ``Robot.joints``; or a dictionary by the names of joints, whose values are numbers or
arrays of n of them, and in which a joint that is not named is at 0. Results of one configuration have no dimension for the rows.

Arrays of 64-bit floats in C order are read where they are, and must not be changed by another thread during a call. Many rows are
computed on all cores, without the interpreter's lock, and Ctrl-C ends them.

Every function raises ``CongruentError`` for an input that is refused, with its findings: a wrong shape, a value that is not finite,
an unknown joint or link, or a fault of a file.
"""

import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, TypeAlias, final

from numpy import float64
from numpy.typing import ArrayLike, NDArray

from ._errors import Finding
from ._results import BaseParameter, IkResult
from .engines._engine import Engine
from .engines._loaded import LoadedModel

__all__ = [
    "Report",
    "Robot",
    "adjoint",
    "check",
    "dh_row",
    "dh_transform",
    "elementary",
    "euler_angles",
    "euler_rotation",
    "exp_of_rotation",
    "identified_screws",
    "loaded_robot",
    "log_of_rotation",
    "robot_of_screws",
    "run",
    "run_command",
    "tool_pose",
    "twist_exp",
    "twist_log",
    "twist_matrix",
]

_Path: TypeAlias = str | os.PathLike[str]
_Joints: TypeAlias = ArrayLike | Mapping[str, ArrayLike]

@final
class Robot:
    """A robot, read once and ready for computations. It never changes, so several threads may use it.

    ``path`` is a folder with robot.toml, a robot file, a URDF or an MJCF, or ``git:REV:PATH``. ``base`` and ``tip`` are links, if
    the chain is not the declared one.
    """

    def __new__(cls, path: _Path, *, base: str | None = None, tip: str | None = None) -> Robot: ...
    @staticmethod
    def from_text(text: str, *, base: str | None = None, tip: str | None = None) -> Robot:
        """The robot of the text of a URDF or an MJCF, such as a ``robot_description`` of ROS."""

    @staticmethod
    def from_xacro(path: _Path, **arguments: str | float | bool) -> Robot:
        """The robot of a xacro file with these arguments, expanded by the Python package xacro, which must be installed."""

    @property
    def name(self) -> str:
        """The name that the robot file gives, or the URDF's."""

    @property
    def path(self) -> str:
        """The file that it was read from."""

    @property
    def base(self) -> str:
        """The link in whose frame poses are."""

    @property
    def tip(self) -> str:
        """The link whose pose is computed if no other is named."""

    @property
    def joints(self) -> list[str]:
        """The joints that arrays have columns for: those that move by themselves, in the robot's order. A joint that follows another
        by ``<mimic>`` has none; it moves with its master, and its torque acts there."""

    @property
    def links(self) -> list[str]:
        """All links, in the order of the file."""

    @property
    def dof(self) -> int:
        """Number of joints."""

    @property
    def limits(self) -> NDArray[float64]:
        """Lower and upper limit of each joint, (joints, 2), rad or m; infinite without a limit."""

    @property
    def warnings(self) -> list[Finding]:
        """What is suspicious in its files."""

    def fk(self, q: _Joints, link: str | None = None) -> NDArray[float64]:
        """Poses as homogeneous matrices ``base_from_tip``: (4, 4), or (n, 4, 4).

        ``link`` is another link, or ``"tcp"`` for the declared tool centre point.
        """

    def jacobian(
        self,
        q: _Joints,
        link: str | None = None,
        *,
        kind: Literal["geometric", "space", "body"] = "geometric",
    ) -> NDArray[float64]:
        """Velocity of the tip for a unit velocity of each joint: (6, joints), or (n, 6, joints).

        Rows 0 to 2 are the angular velocity in rad/s, rows 3 to 5 the linear one in m/s. ``geometric`` has the axes of the base and
        the velocity of the origin of the link, ``body`` the axes of the link and the same point, ``space`` the axes of the base and
        the point of the body that passes its origin.
        """

    def ik(
        self,
        target: ArrayLike,
        start: _Joints | None = None,
        *,
        link: str | None = None,
        position_only: bool = False,
        tolerance_m: float = 1e-9,
        tolerance_rad: float = 1e-9,
        max_iterations: int = 5000,
        seed: int = 0,
    ) -> IkResult:
        """Joint positions that bring the tip to target poses, (4, 4) or (n, 4, 4), or its origin to positions, (3,) or (n, 3), in m.

        A target that is not reached is a result, with ``converged`` false and the residuals, and no error. The search starts at
        ``start``, one for all targets or one for each, or in the middle of the joint ranges.
        """

    def inverse_dynamics(
        self, q: _Joints, qd: _Joints, qdd: _Joints, *, friction: bool = False
    ) -> NDArray[float64]:
        """Torques of motions: positions, speeds and accelerations to (joints,), or (n, joints), in N m or N.

        Gravity is 9.81 m/s^2 against z of the root link, armature counts; ``friction`` adds damping and dry friction.
        """

    def mass_matrix(self, q: _Joints) -> NDArray[float64]:
        """The mass matrix with armature on its diagonal: (joints, joints), or (n, joints, joints)."""

    def forward_dynamics(
        self, q: _Joints, qd: _Joints, tau: _Joints, *, friction: bool = False
    ) -> NDArray[float64]:
        """Accelerations under torques of the actuators: (joints,), or (n, joints), in rad/s^2 or m/s^2."""

    def regressor(self, q: _Joints, qd: _Joints, qdd: _Joints) -> NDArray[float64]:
        """The matrix that gives the torques of the bodies from ``parameters``: (joints, parameters), or (n, joints, parameters).

        Armature, damping and dry friction are not in it.
        """

    @property
    def parameter_names(self) -> list[str]:
        """Names of ``parameters``: ``joint.ixx`` to ``joint.izz``, ``joint.mx`` to ``joint.mz``, ``joint.m`` of each moving joint."""

    @property
    def parameters(self) -> NDArray[float64]:
        """Inertias about the origin of the link of each moving joint, first moments and masses of the body that it carries:
        (parameters,), kg m^2, kg m and kg."""

    def base_parameters(self) -> list[BaseParameter]:
        """The sums of parameters that are identifiable from joint torques, from the base to the tip."""

@final
class Report:
    """The answer of ``check`` or ``run``. ``str`` is what the command prints, and so is what a notebook shows; it is true if ``ok``."""

    @property
    def ok(self) -> bool:
        """Whether the exit code of the command is 0: the robots agree, or the run went as expected."""

    @property
    def exit_code(self) -> int:
        """Exit code of the command: 0 as expected, 1 a check failed, 2 bad input, 3 broken, 4 nothing was checked."""

    @property
    def grade(self) -> str | None:
        """How much alike the poses are: ``identical``, ``same_within_digits``, ``equal_after_mapping`` or ``different``; ``None`` for a
        run, or if nothing was compared. Of several comparisons the worst. Masses and limits have no part in it: ``ok`` has."""

    @property
    def headline(self) -> str:
        """The answer in a line, as ``--quiet`` prints it."""

    @property
    def series(self) -> dict[str, Any]:
        """What happened in a run: arrays of numbers by the name of the column with its unit, (samples,); lists of names for columns
        that have names. Empty for a check."""

    @property
    def folder(self) -> str | os.PathLike[str] | None:
        """The folder of the results of a run, if they are kept."""

    def json(self) -> Any:
        """The document that the command prints with ``--format json``."""

    def __bool__(self) -> bool: ...
    def _repr_html_(self) -> str: ...

def check(
    robot: Robot | _Path,
    against: _Path | None = None,
    *,
    engine: Engine | None = None,
    poses: Callable[[NDArray[float64]], Any] | None = None,
    joints: Sequence[str] | None = None,
    tolerance: str | None = None,
    base: str | None = None,
    tip: str | None = None,
    seed: int = 0,
    strict: bool = False,
) -> Report:
    """Whether the descriptions of a robot are the same robot, as ``congruent check``: its table, its URDF and its physics, and the
    robot of ``against``, a path or ``git:REV``.

    In the place of ``against`` may be ``engine``, what an engine has loaded, as ``congruent.engines.mujoco(model)``; or ``poses``, a function
    that takes q, (joints,), in rad and m, and gives ``base_from_tip``, (4, 4), with ``joints``, the names of the joints of q in its order.

    Without these each ``[[reference]]`` of the robot file is compared. ``tolerance`` is a text with units, as
    ``"1mm,0.1deg"``. A difference is an answer, and no error. After Ctrl-C the rest of a check ends unseen.
    """

def run(
    scenario: _Path,
    *,
    set: Mapping[str, Any] | None = None,
    seed: int | None = None,
    out: _Path | None = None,
) -> Report:
    """Runs a scenario, as ``congruent run``, and gives what happened as arrays.

    ``set`` replaces values of the scenario by the keys joined by dots: ``{"controller.stiffness": 500}``. Results are kept in a folder
    of the scenario's name in ``out``, with ``trajectory.parquet`` unless the scenario asks for another table; without ``out``
    nothing is kept. After Ctrl-C the run ends in order, what it has computed is in ``out``, and ``KeyboardInterrupt`` is raised.
    """

def loaded_robot(model: LoadedModel, file: Robot | None = None) -> Robot:
    """The robot of what an engine has loaded, under the name that messages have for it. ``file`` is the robot that it is compared with,
    whose couplings of joints it gets if the engine couples none."""

def identified_screws(
    base_from_tip: Callable[[list[float]], list[list[float]]],
    middle: list[float],
    half: list[float],
    configurations: list[list[float]],
) -> tuple[list[list[float]], list[list[float]], tuple[float, float]]:
    """The screws of a chain, angular before linear, its pose at zero, and how far these are from the function ``base_from_tip`` at the given
    configurations: nothing if each joint is a pure turn or shift.

    It is asked around ``middle`` and nowhere farther from it than some 1.3 times ``half``, since a function may have limits.
    """

def robot_of_screws(text: str, name: str, residual: tuple[float, float]) -> Robot:
    """The robot of a ``robot.toml`` with screws that were identified, under the name that messages have for it. ``residual`` is how far the
    poses of the function are from it, in m and rad."""

def elementary(motion: str, value: float) -> list[list[float]]: ...
def euler_rotation(set: str, angles: list[float]) -> list[list[float]]: ...
def euler_angles(set: str, matrix: list[list[float]]) -> tuple[list[float], list[float], str, float]: ...
def tool_pose(
    normal: list[float] | None, sliding: list[float], approach: list[float], origin: list[float]
) -> list[list[float]]: ...
def dh_transform(convention: str, row: list[float]) -> list[list[float]]: ...
def dh_row(convention: str, transform: list[list[float]]) -> list[float]: ...
def twist_matrix(twist: list[float]) -> list[list[float]]: ...
def adjoint(transform: list[list[float]]) -> list[list[float]]: ...
def twist_exp(twist: list[float], scalar: float) -> list[list[float]]: ...
def twist_log(transform: list[list[float]]) -> list[float]: ...
def exp_of_rotation(turn_rad: list[float]) -> list[list[float]]: ...
def log_of_rotation(matrix: list[list[float]]) -> list[float]: ...
def run_command(arguments: list[str]) -> int:
    """Does what the command does with these arguments and returns its exit code. It is made for one call in a process."""
