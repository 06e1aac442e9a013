"""MuJoCo: what an ``MjModel`` has in its arrays. Tested with MuJoCo 4.0."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from .._native import Robot
from ._engine import Asked, Engine, Precision, State, imported, refused, restored
from ._loaded import Array, LoadedModel, inverse
from ._mujoco_model import ModelReader

GRAVITY_M_S2 = 9.81
"""The gravity with which torques are computed here."""
TORQUE_RELATIVE = 1e-7
"""MuJoCo keeps inertias in principal axes, whose rounding is larger than that of sums; worst seen 3e-10."""


def mujoco(model: Any, *, root: str | None = None) -> Engine:
    """The robot that MuJoCo has loaded, as ``congruent.check("arm.urdf", engine=congruent.engines.mujoco(model))``.

    ``model`` is a ``mujoco.MjModel``, of a URDF or an MJCF. ``root`` is the body in whose frame poses are compared: by default
    that of the name of the root link of the file, or the world if MuJoCo has fused that link with it. The rest of a scene is not
    compared.

    Raises ``CongruentError`` if MuJoCo is not installed, or ``model`` is no model.
    """
    module = imported("mujoco", "mujoco", "mujoco")
    if not isinstance(model, module.MjModel):
        raise refused(
            f"congruent.engines.mujoco: {type(model).__name__} is no mujoco.MjModel", "mujoco.MjModel.from_xml_path(path)"
        )
    return _Mujoco(module, model, root)


class _Mujoco(Engine):
    precision = Precision(1e-10, 1e-10, TORQUE_RELATIVE)

    def __init__(self, module: Any, model: Any, root: str | None) -> None:
        self._module, self._model, self._root = module, model, root

    @property
    def name(self) -> str:
        return f"MuJoCo {self._module.__version__} (loaded model)"

    def read(self, robot: Robot) -> LoadedModel:
        self._reader = ModelReader(self._module, self._model, self.name, robot, self._root)
        return self._reader.loaded()

    @contextmanager
    def asking(self, model: LoadedModel) -> Iterator[Asked]:
        of = self._model
        off = self._module.mjtDisableBit
        without = [off.mjDSBL_CONTACT, off.mjDSBL_LIMIT, off.mjDSBL_EQUALITY]
        without += [off.mjDSBL_FRICTIONLOSS, off.mjDSBL_ACTUATION, off.mjDSBL_SPRING]
        option = of.opt
        scalars = ("disableflags", "enableflags", "gravity", "density", "viscosity")
        arrays = (
            "body_gravcomp",
            "dof_dampingpoly",
            "tendon_stiffness",
            "tendon_damping",
            "tendon_armature",
            "actuator_dampingpoly",
        )
        known = [name for name in arrays if hasattr(of, name)]
        with restored(*((option, name) for name in scalars), *((of, name) for name in known)):
            option.disableflags = sum(int(bit) for bit in without)
            option.enableflags = 0
            option.density = option.viscosity = 0.0
            for name in known:
                getattr(of, name)[:] = 0.0
            yield _Asked(self._module, of, self._reader)


class _Asked:
    """Data of its own, so that those of the caller are not touched."""

    def __init__(self, module: Any, model: Any, reader: ModelReader) -> None:
        self._module, self._model, self._reader = module, model, reader
        self._data = module.MjData(model)
        module.mj_kinematics(model, self._data)
        turn = self._pose(reader.root)[:3, :3]
        # Gravity of the root link, wherever the root stands in the world.
        model.opt.gravity[:] = turn @ [0.0, 0.0, -GRAVITY_M_S2]

    def _pose(self, body: int) -> Array:
        matrix = np.eye(4)
        matrix[:3, :3] = self._data.xmat[body].reshape(3, 3)
        matrix[:3, 3] = self._data.xpos[body]
        return matrix

    def _set(self, q: State) -> None:
        for name, joint in self._reader.joints.items():
            self._data.qpos[self._model.jnt_qposadr[joint]] = q[name]

    def poses(self, q: State) -> dict[str, Array]:
        self._set(q)
        self._module.mj_kinematics(self._model, self._data)
        root_from_world = inverse(self._pose(self._reader.root))
        return {name: root_from_world @ self._pose(body) for name, body in self._reader.bodies.items()}

    def torques(self, q: State, qd: State, qdd: State) -> dict[str, float]:
        self._set(q)
        for name, joint in self._reader.joints.items():
            dof = self._model.jnt_dofadr[joint]
            self._data.qvel[dof], self._data.qacc[dof] = qd[name], qdd[name]
        self._module.mj_inverse(self._model, self._data)
        dofs = {name: self._model.jnt_dofadr[joint] for name, joint in self._reader.joints.items()}
        return {name: float(self._data.qfrc_inverse[dof]) for name, dof in dofs.items()}
