"""What every adapter of an engine has, and the proof that a model was read right."""

from __future__ import annotations

import importlib
from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, replace
from types import ModuleType
from typing import Any, Protocol

from .._errors import CongruentError, Finding
from .._native import Robot, loaded_robot
from ._loaded import Array, LoadedModel

CODE, ID = "python::engine", "CGR-PYTHON-004"


@dataclass(frozen=True)
class Precision:
    """How exact an engine computes: what its own poses and torques may differ by from the numbers that were read."""

    position_m: float
    orientation_rad: float
    torque_relative: float
    """As a share of the largest torque of all joints and states."""

    @classmethod
    def double(cls) -> Precision:
        """Of 64-bit numbers: rounding of chains of some dozens of joints; worst seen 3e-15 m and 2e-13 of the torque."""
        return cls(1e-10, 1e-10, 1e-8)

    @classmethod
    def single(cls) -> Precision:
        """Of 32-bit numbers: 7 digits, less those that sums of a chain cost."""
        return cls(1e-5, 1e-5, 1e-3)


State = Mapping[str, float]
"""A value for each joint that moves, by name."""


class Asked(Protocol):
    """An engine while it is asked. States have a value for every moving joint, followers among them."""

    def poses(self, q: State) -> dict[str, Array]:
        """Poses of links in the root link, (4, 4), by the names that were read."""

    def torques(self, q: State, qd: State, qdd: State) -> dict[str, float] | None:
        """Torques of a motion with damping and armature, without dry friction, under 9.81 m/s^2 against z of the root link, by
        the names of joints; ``None`` if the engine computes none."""


class Engine(ABC):
    """An engine that has loaded a robot: for ``congruent.check(file, engine=...)``."""

    precision: Precision = Precision.double()
    counts_damping: bool = True
    """Whether the damping of joints is in its torques."""

    @property
    @abstractmethod
    def name(self) -> str:
        """What reports call it."""

    @abstractmethod
    def read(self, robot: Robot) -> LoadedModel:
        """What it has loaded of a robot with these links and joints: by the names of its bodies and joints, where they are the
        same."""

    @abstractmethod
    def asking(self, model: LoadedModel) -> AbstractContextManager[Asked]:
        """The engine with limits, contacts, constraints and dry friction off; as before afterwards, also after an exception."""


def asked(engine: Any, robot: Robot) -> Robot:
    """The robot that an engine has loaded, verified against the poses and torques that the engine itself computes.

    Raises ``CongruentError`` if the engine computes something else than what was read.
    """
    from ._proof import prove

    if not isinstance(engine, Engine):
        message = f"engine: {type(engine).__name__} is no adapter of an engine"
        raise refused(message, "engine=congruent.engines.mujoco(model), or another of congruent.engines")
    model = engine.read(robot)
    return loaded_robot(replace(model, within=prove(engine, model)), robot)


def refused(message: str, help: str | None = None, code: str = CODE, id: str = ID) -> CongruentError:
    """The exception for what cannot be compared."""
    finding = Finding("error", code, id, message, None, None, None, help)
    return CongruentError(str(finding), [finding])


def imported(module: str, package: str, adapter: str) -> ModuleType:
    """The module of an engine, which is imported only if it is used."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        message = f"congruent.engines.{adapter}: the Python package {package} is not installed ({error})"
        raise refused(message, f"pip install {package}") from None


@contextmanager
def restored(*values: tuple[Any, str]) -> Iterator[None]:
    """Gives attributes of objects the values again that they had, also after an exception. Arrays are changed in place."""
    before = [(owner, name, _copied(getattr(owner, name))) for owner, name in values]
    try:
        yield
    finally:
        for owner, name, value in before:
            if hasattr(value, "shape") and getattr(value, "shape", ()) != ():
                getattr(owner, name)[:] = value
            else:
                setattr(owner, name, value)


def _copied(value: Any) -> Any:
    return value.copy() if hasattr(value, "copy") else value
