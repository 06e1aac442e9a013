"""Drake: what a ``MultibodyPlant`` has of one robot. Tested with Drake 1.51."""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import metadata
from typing import Any

import numpy as np

from .._native import Robot
from ._engine import Asked, Engine, State, imported, refused
from ._loaded import Array, LoadedJoint, LoadedLink, LoadedModel, floats, inverse, quaternion_of

USUAL_GRAVITY = (0.0, 0.0, -9.81)
KINDS = {"RevoluteJoint": "hinge", "PrismaticJoint": "slide", "WeldJoint": "fixed"}


def drake(plant: Any, *, root: str | None = None) -> Engine:
    """The robot that Drake has loaded, as ``congruent.check("arm.urdf", engine=congruent.engines.drake(plant))``.

    ``plant`` is a finalized ``pydrake.multibody.plant.MultibodyPlant``, whose default values are read. ``root`` is the body in
    whose frame poses are compared, by default that of the name of the root link of the file. Drake has no dry friction of joints.

    Raises ``CongruentError`` if Drake is not installed, or ``plant`` is no finalized plant.
    """
    module = imported("pydrake.multibody.plant", "drake", "drake")
    if not isinstance(plant, module.MultibodyPlant) or not plant.is_finalized():
        raise refused(f"congruent.engines.drake: {type(plant).__name__} is no finalized MultibodyPlant", "plant.Finalize()")
    return _Drake(plant, root)


class _Drake(Engine):
    # Damping is a value of the joint that inverse dynamics do not have.
    counts_damping = False

    def __init__(self, plant: Any, root: str | None) -> None:
        self._plant, self._root = plant, root

    @property
    def name(self) -> str:
        return f"Drake {metadata.version('drake')} (loaded model)"

    def read(self, robot: Robot) -> LoadedModel:
        self._reader = _Reader(self._plant, self.name, self._root or robot.links[0])
        return self._reader.loaded()

    @contextmanager
    def asking(self, model: LoadedModel) -> Iterator[Asked]:
        field = self._plant.mutable_gravity_field()
        before = field.gravity_vector().copy()
        try:
            asked = _Asked(self._plant, self._reader)
            field.set_gravity_vector(asked.world_from_root()[:3, :3] @ USUAL_GRAVITY)
            yield asked
        finally:
            field.set_gravity_vector(before)


class _Reader:
    """``joints`` and ``bodies`` are those of Drake, by the names that they have here."""

    def __init__(self, plant: Any, engine: str, root: str) -> None:
        self._plant, self._engine = plant, engine
        named = [body for body in _bodies(plant) if body.name() == root]
        if len(named) != 1:
            raise refused(f'{engine}: there are {len(named)} bodies "{root}"', "root is one of its bodies")
        self.root = named[0]
        self.bodies: dict[str, Any] = {root: self.root}
        self.joints: dict[str, Any] = {}
        self._below: list[Any] = []
        all_joints = [plant.get_joint(index) for index in plant.GetJointIndices()]
        found = [self.root]
        while found:
            body = found.pop(0)
            for joint in all_joints:
                if joint.parent_body().index() == body.index():
                    self._below.append(joint)
                    self.bodies[joint.child_body().name()] = joint.child_body()
                    found.append(joint.child_body())

    def loaded(self) -> LoadedModel:
        """All that is compared."""
        links = [_link(name, body) for name, body in self.bodies.items()]
        joints: list[LoadedJoint] = []
        for joint in self._below:
            own, frame = self._joint(joint)
            joints += own
            links += frame
        gravity = floats(self._plant.gravity_field().gravity_vector())
        is_usual = tuple(gravity) == USUAL_GRAVITY
        forces = [] if is_usual else [f"gravity is {gravity} m/s^2 in Drake; torques are compared under 9.81 m/s^2"]
        return LoadedModel(self._engine, "robot", links, joints, forces, couples=False)

    def _joint(self, joint: Any) -> tuple[list[LoadedJoint], list[LoadedLink]]:
        """The joint, with a link between it and its child if the child has another frame."""
        name, kind = joint.name(), KINDS.get(type(joint).__name__)
        if kind is None:
            raise refused(f'{self._engine}: joint "{name}" neither turns about an axis nor slides ({type(joint).__name__})')
        parent, child = joint.parent_body().name(), joint.child_body().name()
        placed = joint.frame_on_parent().GetFixedPoseInBodyFrame().GetAsMatrix4()
        if kind == "fixed":
            placed = placed @ joint.X_FM().GetAsMatrix4()
        after = inverse(joint.frame_on_child().GetFixedPoseInBodyFrame().GetAsMatrix4())
        if kind == "fixed" or np.array_equal(after, np.eye(4)):
            return [self._values(joint, kind, parent, child, placed @ after)], []
        between = f"{child} (at {name})"
        fixed = LoadedJoint(f"{child} (fixed)", "fixed", between, child, floats(after[:3, 3]), quaternion_of(after[:3, :3]))
        return [self._values(joint, kind, parent, between, placed), fixed], [LoadedLink(between)]

    def _values(self, joint: Any, kind: str, parent: str, child: str, placed: Array) -> LoadedJoint:
        name, pose = joint.name(), (floats(placed[:3, 3]), quaternion_of(placed[:3, :3]))
        if kind == "fixed":
            return LoadedJoint(name, kind, parent, child, *pose)
        self.joints[name] = joint
        ends = [float(joint.position_lower_limit()), float(joint.position_upper_limit())]
        effort, armature = self._actuation(joint)
        speed = float(joint.velocity_upper_limit())
        return LoadedJoint(
            name,
            kind,
            parent,
            child,
            *pose,
            axis=floats(joint.revolute_axis() if kind == "hinge" else joint.translation_axis()),
            range=ends if np.isfinite(ends).all() else None,
            effort=effort,
            velocity=speed if np.isfinite(speed) else None,
            damping=float(joint.default_damping()),
            armature=armature,
        )

    def _actuation(self, joint: Any) -> tuple[float | None, float]:
        """The largest effort of its actuators, and the inertia that these add."""
        effort: float | None = None
        armature = 0.0
        for index in self._plant.GetJointActuatorIndices():
            actuator = self._plant.get_joint_actuator(index)
            if actuator.joint().index() == joint.index():
                own = float(actuator.effort_limit())
                effort = (effort or 0.0) + own if np.isfinite(own) else effort
                armature += float(actuator.default_rotor_inertia()) * float(actuator.default_gear_ratio()) ** 2
        return effort, armature


def _bodies(plant: Any) -> list[Any]:
    instances = [plant.get_joint(index) for index in plant.GetJointIndices()]
    found = {body.index(): body for joint in instances for body in (joint.parent_body(), joint.child_body())}
    return list(found.values())


def _link(name: str, body: Any) -> LoadedLink:
    inertia = body.default_spatial_inertia()
    mass = float(inertia.get_mass())
    if not mass > 0:
        return LoadedLink(name)
    com = inertia.get_com()
    tensor = inertia.CalcRotationalInertia().ShiftToCenterOfMass(mass, com).CopyToFullMatrix3()
    return LoadedLink(name, mass, floats(com), [floats(row) for row in tensor])


class _Asked:
    """A context of its own, so that those of the caller are not touched."""

    def __init__(self, plant: Any, reader: _Reader) -> None:
        self._plant, self._reader = plant, reader
        self._tree = importlib.import_module("pydrake.multibody.tree")
        self._context = plant.CreateDefaultContext()

    def world_from_root(self) -> Array:
        """Where the root stands."""
        return np.array(self._plant.EvalBodyPoseInWorld(self._context, self._reader.root).GetAsMatrix4())

    def _set(self, q: State, qd: State) -> None:
        positions, speeds = self._plant.GetPositions(self._context).copy(), np.zeros(self._plant.num_velocities())
        for name, joint in self._reader.joints.items():
            positions[joint.position_start()], speeds[joint.velocity_start()] = q[name], qd[name]
        self._plant.SetPositions(self._context, positions)
        self._plant.SetVelocities(self._context, speeds)

    def poses(self, q: State) -> dict[str, Array]:
        self._set(q, dict.fromkeys(q, 0.0))
        root_from_world = inverse(self.world_from_root())
        bodies = self._reader.bodies.items()
        return {
            name: root_from_world @ self._plant.EvalBodyPoseInWorld(self._context, body).GetAsMatrix4() for name, body in bodies
        }

    def torques(self, q: State, qd: State, qdd: State) -> dict[str, float]:
        self._set(q, qd)
        accelerations = np.zeros(self._plant.num_velocities())
        for name, joint in self._reader.joints.items():
            accelerations[joint.velocity_start()] = qdd[name]
        forces = self._tree.MultibodyForces(self._plant)
        torques = self._plant.CalcInverseDynamics(self._context, accelerations, forces)
        torques = torques - self._plant.CalcGravityGeneralizedForces(self._context)
        return {name: float(torques[joint.velocity_start()]) for name, joint in self._reader.joints.items()}
