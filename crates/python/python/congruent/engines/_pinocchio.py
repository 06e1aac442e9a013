"""Pinocchio: what a ``pinocchio.Model`` has in its arrays. Tested with Pinocchio 4.1."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from .._native import Robot
from ._engine import Asked, Engine, State, imported, refused, restored
from ._loaded import Array, LoadedJoint, LoadedLink, LoadedModel, floats, free_name, quaternion_of

UNIVERSE = 0
"""The joint that carries what does not move."""
USUAL_GRAVITY = (0.0, 0.0, -9.81)
FREE_FLYER = 7
"""Coordinates of a joint that moves freely."""


def pinocchio(model: Any) -> Engine:
    """The robot that Pinocchio has loaded, as ``congruent.check("arm.urdf", engine=congruent.engines.pinocchio(model))``.

    ``model`` is a ``pinocchio.Model``, of a URDF or an MJCF. A joint at the root that moves freely is left out.

    Raises ``CongruentError`` if Pinocchio is not installed, or ``model`` is no model.
    """
    module = imported("pinocchio", "pin", "pinocchio")
    if not isinstance(model, module.Model):
        raise refused(
            f"congruent.engines.pinocchio: {type(model).__name__} is no pinocchio.Model", "pinocchio.buildModelFromUrdf(path)"
        )
    return _Pinocchio(module, model)


class _Pinocchio(Engine):
    # Damping and dry friction are values of the model that its torques do not have.
    counts_damping = False

    def __init__(self, module: Any, model: Any) -> None:
        self._module, self._model = module, model

    @property
    def name(self) -> str:
        return f"Pinocchio {self._module.__version__} (loaded model)"

    def read(self, robot: Robot) -> LoadedModel:
        self._reader = _Reader(self._module, self._model, self.name, robot)
        return self._reader.loaded()

    @contextmanager
    def asking(self, model: LoadedModel) -> Iterator[Asked]:
        of = self._model
        with restored((of.gravity, "linear"), (of.gravity, "angular")):
            of.gravity.linear = np.array(USUAL_GRAVITY)
            of.gravity.angular = np.zeros(3)
            yield _Asked(self._module, of, self._reader)


class _Reader:
    """``frames`` and ``joints`` have the numbers of both in the model, by the names that they have here."""

    def __init__(self, module: Any, model: Any, engine: str, robot: Robot) -> None:
        self._module, self._model, self._engine = module, model, engine
        self._data = model.createData()
        # The axis of a joint is known once it has a position.
        module.forwardKinematics(model, self._data, module.neutral(model))
        self._known = set(robot.links)
        self.root = self._root()
        self.followers = {str(model.names[int(at)]) for at in model.mimicking_joints}
        self.joints: dict[str, int] = {str(model.names[at]): at for at in range(1, model.njoints) if at != self.root}
        self.frames: dict[str, int] = {}
        self._bodies: dict[int, str] = {}

    def _root(self) -> int:
        """The joint whose body is the root: the universe, or a free one below it."""
        model = self._model
        free = [at for at in range(1, model.njoints) if model.parents[at] == UNIVERSE and model.joints[at].nq == FREE_FLYER]
        return free[0] if free else UNIVERSE

    def loaded(self) -> LoadedModel:
        """All that is compared."""
        frames = self._frames_of_joints()
        links: list[LoadedLink] = []
        joints: list[LoadedJoint] = []
        for at in [self.root, *self.joints.values()]:
            body, fixed = self._body(at, frames[at])
            links.append(self._link(body, at))
            if at != self.root:
                joints.append(self._joint(at, body))
            for frame in fixed:
                name = str(self._model.frames[frame].name)
                placement = self._model.frames[frame].placement
                links.append(LoadedLink(name))
                pose = floats(placement.translation), quaternion_of(placement.rotation)
                joints.append(LoadedJoint(f"{name} (fixed)", "fixed", body, name, *pose))
        # By default Pinocchio does not read which joints follow others.
        name = str(self._model.name) or "robot"
        return LoadedModel(self._engine, name, links, joints, self._forces(), couples=bool(self.followers))

    def _frames_of_joints(self) -> dict[int, list[int]]:
        """The frames of bodies that each joint carries, each name once."""
        found: dict[int, list[int]] = {at: [] for at in [self.root, *self.joints.values()]}
        for number, frame in enumerate(self._model.frames):
            carrier = int(frame.parentJoint)
            is_body = frame.type == self._module.FrameType.BODY
            if is_body and carrier in found and str(frame.name) not in self.frames:
                self.frames[str(frame.name)] = number
                found[carrier].append(number)
        return found

    def _body(self, at: int, frames: list[int]) -> tuple[str, list[int]]:
        """The link that a joint carries, which has the frame of the joint, and the frames that are fixed to it."""
        model = self._model
        at_joint = [frame for frame in frames if model.frames[frame].placement.isIdentity(0.0)]
        # The links of the file come before frames of the same place, such as the world.
        own = next((frame for frame in at_joint if str(model.frames[frame].name) in self._known), next(iter(at_joint), None))
        name = free_name(f"{model.names[at]} (body)", self.frames) if own is None else str(model.frames[own].name)
        self._bodies[at] = name
        others = [frame for frame in frames if frame != own]
        return name, [frame for frame in others if at != UNIVERSE or str(model.frames[frame].name) in self._known]

    def _link(self, name: str, at: int) -> LoadedLink:
        inertia = self._model.inertias[at]
        tensor = [floats(row) for row in inertia.inertia]
        return LoadedLink(name, float(inertia.mass), floats(inertia.lever), tensor)

    def _joint(self, at: int, body: str) -> LoadedJoint:
        model, joint, name = self._model, self._model.joints[at], str(self._model.names[at])
        if name in self.followers:
            return self._follower(at, body)
        if joint.nv != 1:
            raise refused(f'{self._engine}: joint "{name}" neither turns about an axis nor slides ({joint.shortname()})')
        motion = np.array(self._data.joints[at].S).ravel()
        is_slide = not np.any(motion[3:])
        placement = model.jointPlacements[at]
        # A turn without limits has the coordinates of a point of the circle.
        q, v = int(joint.idx_q), int(joint.idx_v)
        ends = [float(model.lowerPositionLimit[q]), float(model.upperPositionLimit[q])] if joint.nq == 1 else [-np.inf, np.inf]
        return LoadedJoint(
            name=name,
            kind="slide" if is_slide else "hinge",
            parent=self._bodies[int(model.parents[at])],
            child=body,
            position_m=floats(placement.translation),
            quaternion_wxyz=quaternion_of(placement.rotation),
            axis=floats(motion[:3] if is_slide else motion[3:]),
            range=ends if np.all(np.abs(ends) < 1e30) else None,
            effort=_limit(model.upperEffortLimit[v]),
            velocity=_limit(model.upperVelocityLimit[v]),
            damping=float(model.damping[v]),
            friction=float(model.upperDryFrictionLimit[v]),
            armature=float(model.armature[v]),
        )

    def _follower(self, at: int, body: str) -> LoadedJoint:
        """A joint that has no coordinate of its own, and no limits and losses either."""
        model, mimic = self._model, self._model.joints[at].extract()
        leaders = dict(zip(map(int, model.mimicking_joints), map(int, model.mimicked_joints)))
        scaling, offset = float(mimic.scaling), float(mimic.offset)
        motion = np.array(self._data.joints[at].S).ravel() / scaling
        is_slide = not np.any(motion[3:])
        leader = model.joints[leaders[at]]
        ends = [
            scaling * float(limit[int(leader.idx_q)]) + offset for limit in (model.lowerPositionLimit, model.upperPositionLimit)
        ]
        placement = model.jointPlacements[at]
        return LoadedJoint(
            name=str(model.names[at]),
            kind="slide" if is_slide else "hinge",
            parent=self._bodies[int(model.parents[at])],
            child=body,
            position_m=floats(placement.translation),
            quaternion_wxyz=quaternion_of(placement.rotation),
            axis=floats(motion[:3] if is_slide else motion[3:]),
            range=sorted(ends),
            follows=(str(model.names[leaders[at]]), scaling, offset),
        )

    def _forces(self) -> list[str]:
        gravity = floats(self._model.gravity.linear)
        usual = tuple(gravity) == USUAL_GRAVITY
        return [] if usual else [f"gravity is {gravity} m/s^2 in Pinocchio; torques are compared under 9.81 m/s^2"]


def _limit(value: float) -> float | None:
    return float(value) if value < 1e30 else None


class _Asked:
    """Data of its own, so that those of the caller are not touched."""

    def __init__(self, module: Any, model: Any, reader: _Reader) -> None:
        self._module, self._model, self._reader = module, model, reader
        self._data = model.createData()

    def _moving(self) -> list[tuple[str, int]]:
        """The joints that have coordinates of their own."""
        return [(name, at) for name, at in self._reader.joints.items() if name not in self._reader.followers]

    def _q(self, q: State) -> Array:
        coordinates = np.array(self._module.neutral(self._model))
        for name, at in self._moving():
            joint, value = self._model.joints[at], q[name]
            first = int(joint.idx_q)
            coordinates[first : first + joint.nq] = value if joint.nq == 1 else (np.cos(value), np.sin(value))
        return coordinates

    def _v(self, of: State) -> Array:
        speeds = np.zeros(self._model.nv)
        for name, at in self._moving():
            speeds[int(self._model.joints[at].idx_v)] = of[name]
        return speeds

    def poses(self, q: State) -> dict[str, Array]:
        self._module.framesForwardKinematics(self._model, self._data, self._q(q))
        world_from_root = self._data.oMi[self._reader.root]
        frames = self._reader.frames.items()
        return {name: np.array((world_from_root.inverse() * self._data.oMf[frame]).homogeneous) for name, frame in frames}

    def torques(self, q: State, qd: State, qdd: State) -> dict[str, float]:
        torques = self._module.rnea(self._model, self._data, self._q(q), self._v(qd), self._v(qdd))
        # Torques of followers act at the joints that they follow.
        own = {name: float(torques[int(self._model.joints[at].idx_v)]) for name, at in self._moving()}
        return {**dict.fromkeys(self._reader.followers, 0.0), **own}
