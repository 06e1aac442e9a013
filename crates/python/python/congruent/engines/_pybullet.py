"""PyBullet: what a client has loaded of a body. Tested with PyBullet 3.2.7."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from .._native import Robot
from ._engine import Asked, Engine, Precision, State, imported, refused
from ._loaded import Array, LoadedJoint, LoadedLink, LoadedModel, floats, free_name, inverse, matrix_of, quaternion_of

BASE = -1
REVOLUTE, PRISMATIC, FIXED = 0, 1, 4
"""Types of joints."""
USUAL_GRAVITY = [0.0, 0.0, -9.81]


def pybullet(body: int, *, client: int = 0) -> Engine:
    """A body that PyBullet has loaded, as ``congruent.check("arm.urdf", engine=congruent.engines.pybullet(body))``.

    ``body`` is what ``loadURDF`` has returned, ``client`` what ``connect`` has. Without the flag ``URDF_USE_INERTIA_FROM_FILE``
    PyBullet computes inertias from shapes, and a link without an inertial gets 1 kg: both are differences from the file. Poses
    are verified, and torques are not.

    Raises ``CongruentError`` if PyBullet is not installed, or has no such body.
    """
    module = imported("pybullet", "pybullet", "pybullet")
    if not isinstance(body, int) or not module.isConnected(client) or body not in _bodies(module, client):
        raise refused(
            f"congruent.engines.pybullet: client {client} has no body {body!r}",
            "body = pybullet.loadURDF(path, useFixedBase=True)",
        )
    return _Pybullet(module, body, client)


def _bodies(module: Any, client: int) -> list[int]:
    return [module.getBodyUniqueId(at, physicsClientId=client) for at in range(module.getNumBodies(physicsClientId=client))]


class _Pybullet(Engine):
    # Its wheels compute transforms in 32-bit numbers.
    precision = Precision.single()

    def __init__(self, module: Any, body: int, client: int) -> None:
        self._module, self._body, self._client = module, body, {"physicsClientId": client}

    @property
    def name(self) -> str:
        return f"PyBullet {self._module.getAPIVersion()} (loaded model, 32-bit numbers)"

    def read(self, robot: Robot) -> LoadedModel:
        module, body = self._module, self._body
        infos = [module.getJointInfo(body, at, **self._client) for at in range(module.getNumJoints(body, **self._client))]
        with self._still():
            root, name = module.getBodyInfo(body, **self._client)
            links = [free_name(root.decode(), ())]
            for info in infos:
                links.append(free_name(info[12].decode(), links))
            self.joints = {info[1].decode(): at for at, info in enumerate(infos) if info[2] != FIXED}
            self.links = {link: at for at, link in enumerate(links, BASE)}
            poses = self._poses()
            joints = [self._joint(info, links, poses) for info in infos]
        loaded = [self._link(link, at) for link, at in self.links.items()]
        return LoadedModel(self.name, name.decode(), loaded, joints, self._forces(), couples=False, is_single_precision=True)

    def _link(self, name: str, at: int) -> LoadedLink:
        info = self._module.getDynamicsInfo(self._body, at, **self._client)
        turn = matrix_of((0.0, 0.0, 0.0), _wxyz(info[4]))[:3, :3]
        tensor = turn @ np.diag(info[2]) @ turn.T
        return LoadedLink(name, float(info[0]), floats(info[3]), [floats(row) for row in tensor])

    def _joint(self, info: Any, links: list[str], poses: dict[str, Array]) -> LoadedJoint:
        name, kind, parent, child = info[1].decode(), info[2], links[info[16] + 1], links[info[0] + 1]
        if kind not in (REVOLUTE, PRISMATIC, FIXED):
            raise refused(f'{self.name}: joint "{name}" neither turns about an axis nor slides')
        placed = inverse(poses[parent]) @ poses[child]
        pose = floats(placed[:3, 3]), quaternion_of(placed[:3, :3])
        if kind == FIXED:
            return LoadedJoint(name, "fixed", parent, child, *pose)
        lower, upper = floats(info[8:10])
        # In the axes of the inertia of the child.
        turn = matrix_of((0.0, 0.0, 0.0), _wxyz(self._module.getDynamicsInfo(self._body, info[0], **self._client)[4]))[:3, :3]
        return LoadedJoint(
            name,
            "hinge" if kind == REVOLUTE else "slide",
            parent,
            child,
            *pose,
            axis=floats(turn @ info[13]),
            # Without limits the lower end is above the upper one.
            range=[lower, upper] if lower < upper else None,
            effort=float(info[10]) or None,
            velocity=float(info[11]) or None,
            damping=float(info[6]),
            friction=float(info[7]),
        )

    def _forces(self) -> list[str]:
        found = self._gravity()
        usual = found == USUAL_GRAVITY
        return [] if usual else [f"gravity is {found} m/s^2 in PyBullet; torques are compared under 9.81 m/s^2"]

    def _gravity(self) -> list[float]:
        parameters = self._module.getPhysicsEngineParameters(**self._client)
        return [float(parameters[f"gravityAcceleration{axis}"]) for axis in "XYZ"]

    @contextmanager
    def _still(self) -> Iterator[None]:
        """All joints at zero; where they were afterwards."""
        module, body = self._module, self._body
        count = module.getNumJoints(body, **self._client)
        before = [module.getJointState(body, at, **self._client)[:2] for at in range(count)]
        try:
            for at in range(count):
                module.resetJointState(body, at, 0.0, 0.0, **self._client)
            yield
        finally:
            for at, (position, speed) in enumerate(before):
                module.resetJointState(body, at, position, speed, **self._client)

    def _poses(self) -> dict[str, Array]:
        """Poses of the links in the root link, joints where they are."""
        module, body = self._module, self._body
        centre = module.getBasePositionAndOrientation(body, **self._client)
        info = module.getDynamicsInfo(body, BASE, **self._client)
        # PyBullet places the centre of mass of the base.
        world_from_root = matrix_of(centre[0], _wxyz(centre[1])) @ inverse(matrix_of(info[3], _wxyz(info[4])))
        root_from_world, found = inverse(world_from_root), {}
        for name, at in self.links.items():
            if at == BASE:
                found[name] = np.eye(4)
                continue
            state = module.getLinkState(body, at, computeForwardKinematics=1, **self._client)
            found[name] = root_from_world @ matrix_of(state[4], _wxyz(state[5]))
        return found

    @contextmanager
    def asking(self, model: LoadedModel) -> Iterator[Asked]:
        with self._still():
            yield _Asked(self)


class _Asked:
    def __init__(self, engine: _Pybullet) -> None:
        self._engine = engine

    def poses(self, q: State) -> dict[str, Array]:
        engine = self._engine
        for name, at in engine.joints.items():
            engine._module.resetJointState(engine._body, at, q[name], 0.0, **engine._client)
        return engine._poses()

    def torques(self, q: State, qd: State, qdd: State) -> None:
        """None: inverse dynamics of PyBullet keep the masses of their first call, so that asking here would change answers
        later."""


def _wxyz(xyzw: Any) -> list[float]:
    x, y, z, w = floats(xyzw)
    return [w, x, y, z]
