"""The arrays of an ``MjModel`` as links and joints."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from .._native import Robot
from ._engine import refused
from ._loaded import (
    Array,
    LoadedJoint,
    LoadedLink,
    LoadedModel,
    floats,
    free_name,
    inverse,
    matrix_of,
    quaternion_of,
)

FREE, BALL, SLIDE, HINGE = range(4)
"""``mjtJoint``."""
WORLD = 0
USUAL_GRAVITY = (0.0, 0.0, -9.81)


class ModelReader:
    """The bodies and joints of one robot in a scene.

    ``bodies`` and ``joints`` have the numbers of both in the model, by the names that they have here.
    """

    def __init__(self, module: Any, model: Any, engine: str, robot: Robot, root: str | None) -> None:
        self._module, self._model, self._engine = module, model, engine
        objects = module.mjtObj
        self._body_names = self._names(objects.mjOBJ_BODY, model.nbody, "body")
        self._joint_names = self._names(objects.mjOBJ_JOINT, model.njnt, "joint")
        self.root = self._found_root(robot, root)
        chosen = self._chosen(robot)
        self.bodies: dict[str, int] = {self._body_names[body]: body for body in chosen}
        self.joints: dict[str, int] = {}
        self._links: list[LoadedLink] = []
        self._joints: list[LoadedJoint] = []

    def _names(self, kind: Any, count: int, what: str) -> list[str]:
        names: list[str] = []
        for number in range(count):
            written = self._module.mj_id2name(self._model, kind, number)
            names.append(free_name(written or f"{what} {number}", names))
        return names

    def _found_root(self, robot: Robot, root: str | None) -> int:
        wanted = robot.links[0] if root is None else root
        if wanted in self._body_names:
            return self._body_names.index(wanted)
        if root is not None:
            known = ", ".join(self._body_names[:12])
            raise refused(f'{self._engine}: there is no body "{root}"', f"root is one of its bodies: {known}")
        # A link that does not move is fused with the world, if MuJoCo is allowed to.
        return WORLD

    def _chosen(self, robot: Robot) -> list[int]:
        """The bodies of the robot: below the root, in branches that have a link or joint of its names, or all if none has."""
        model, known = self._model, {*robot.links, *robot.joints}
        parents = [int(parent) for parent in model.body_parentid]
        below = {self.root}
        for body in range(1, model.nbody):
            if parents[body] in below:
                below.add(body)
        names = {body: {self._body_names[body], *(self._joint_names[joint] for joint in self._joints_of(body))} for body in below}
        wanted: set[int] = set()
        for body in sorted(below, reverse=True):
            if body in wanted or names[body] & known:
                wanted.add(body)
                if body != self.root:
                    wanted.add(parents[body])
        if wanted <= {self.root}:
            return sorted(below)
        # What hangs at a body of the robot belongs to it, such as a tool with names of its own.
        for body in sorted(below):
            if parents[body] in wanted - {WORLD}:
                wanted.add(body)
        return sorted(wanted | {self.root})

    def _joints_of(self, body: int) -> range:
        first = int(self._model.body_jntadr[body])
        return range(first, first + int(self._model.body_jntnum[body])) if first >= 0 else range(0)

    def loaded(self) -> LoadedModel:
        """All that is compared."""
        for name, body in self.bodies.items():
            if body == self.root:
                self._links.append(self._link(name, body))
            else:
                self._add_body(name, body)
        followers = self._followers()
        joints = [self._with_follows(joint, followers) for joint in self._joints]
        robot = self._module.mj_id2name(self._model, self._module.mjtObj.mjOBJ_BODY, self.root) or "robot"
        return LoadedModel(self._engine, robot, self._links, joints, self._forces())

    def _link(self, name: str, body: int) -> LoadedLink:
        model = self._model
        turn = matrix_of((0.0, 0.0, 0.0), model.body_iquat[body])[:3, :3]
        tensor = turn @ np.diag(model.body_inertia[body]) @ turn.T
        return LoadedLink(name, float(model.body_mass[body]), floats(model.body_ipos[body]), [floats(row) for row in tensor])

    def _add_body(self, name: str, body: int) -> None:
        """A body with its joints: links between them, and before the body if its axis is beside its origin."""
        model = self._model
        position, quaternion = floats(model.body_pos[body]), floats(model.body_quat[body])
        before = self._body_names[int(model.body_parentid[body])]
        before_from_body: Array | None = None
        moving = self._joints_of(body)
        for joint in moving:
            joint_name = self._joint_names[joint]
            kind = int(model.jnt_type[joint])
            if kind == FREE:
                # As in a file: the body is where the model puts it.
                continue
            if kind == BALL:
                raise refused(
                    f'{self._engine}: joint "{joint_name}" of body "{name}" neither turns about an axis nor slides',
                    "give the body above which the robot stands: root=...",
                )
            axis = floats(model.jnt_axis[joint])
            anchor = np.eye(4)
            if kind == HINGE:
                anchor[:3, 3] = model.jnt_pos[joint]
            from_zero = _motion(kind, axis, -float(model.qpos0[model.jnt_qposadr[joint]]))
            moved = anchor @ from_zero
            if before_from_body is not None or not np.array_equal(moved, np.eye(4)):
                placed = (matrix_of(position, quaternion) if before_from_body is None else before_from_body) @ moved
                position, quaternion = floats(placed[:3, 3]), quaternion_of(placed[:3, :3])
            is_last = joint == moving[-1] and np.array_equal(anchor, np.eye(4))
            child = name if is_last else free_name(f"{name} (at {joint_name})", self._body_names)
            self._joints.append(self._joint(joint, before, child, position, quaternion, axis))
            self.joints[joint_name] = joint
            if child != name:
                self._links.append(LoadedLink(child))
            before, before_from_body = child, inverse(anchor)
        if before != name:
            if before_from_body is not None:
                position, quaternion = floats(before_from_body[:3, 3]), quaternion_of(before_from_body[:3, :3])
            self._joints.append(LoadedJoint(f"{name} (fixed)", "fixed", before, name, position, quaternion))
        self._links.append(self._link(name, body))

    def _joint(
        self, joint: int, parent: str, child: str, position: list[float], quaternion: list[float], axis: list[float]
    ) -> LoadedJoint:
        model = self._model
        dof = int(model.jnt_dofadr[joint])
        added = [self._of_actuators(joint, term) for term in ("actuator_damping", "actuator_armature")]
        return LoadedJoint(
            name=self._joint_names[joint],
            kind="hinge" if int(model.jnt_type[joint]) == HINGE else "slide",
            parent=parent,
            child=child,
            position_m=position,
            quaternion_wxyz=quaternion,
            axis=axis,
            range=floats(model.jnt_range[joint]) if model.jnt_limited[joint] else None,
            effort=self._effort(joint),
            damping=float(model.dof_damping[dof]) + added[0],
            friction=float(model.dof_frictionloss[dof]),
            armature=float(model.dof_armature[dof]) + added[1],
        )

    def _actuators(self, joint: int) -> list[int]:
        model, of_joint = self._model, int(self._module.mjtTrn.mjTRN_JOINT)
        numbers = range(model.nu)
        return [at for at in numbers if int(model.actuator_trntype[at]) == of_joint and int(model.actuator_trnid[at][0]) == joint]

    def _of_actuators(self, joint: int, term: str) -> float:
        """What actuators of MuJoCo 4 add to damping or armature of their joint, times the square of the gear."""
        values = getattr(self._model, term, None)
        if values is None:
            return 0.0
        return sum(float(np.ravel(values[at])[0]) * float(self._model.actuator_gear[at][0]) ** 2 for at in self._actuators(joint))

    def _effort(self, joint: int) -> float | None:
        """The largest effort of all actuators of the joint, within its own limits; ``None`` if one has no limits."""
        model = self._model
        own = floats(model.jnt_actfrcrange[joint]) if model.jnt_actfrclimited[joint] else None
        total = np.zeros(2)
        for at in self._actuators(joint):
            gear = float(model.actuator_gear[at][0])
            is_motor = int(model.actuator_gaintype[at]) == 0 and int(model.actuator_biastype[at]) == 0
            if model.actuator_forcelimited[at]:
                ends = gear * model.actuator_forcerange[at]
            elif model.actuator_ctrllimited[at] and is_motor:
                ends = gear * float(model.actuator_gainprm[at][0]) * model.actuator_ctrlrange[at]
            else:
                return None if own is None else max(own[1], -own[0])
            total += np.sort(ends)
        if not self._actuators(joint):
            return None if own is None else max(own[1], -own[0])
        if own is not None:
            total = np.clip(total, own[0], own[1])
        return float(max(total[1], -total[0]))

    def _followers(self) -> dict[str, tuple[str, float, float]]:
        """Joints that an equality couples linearly with another, from the equalities that are active."""
        model, kinds = self._model, self._module.mjtEq
        numbers = {joint: name for name, joint in self.joints.items()}
        followers: dict[str, tuple[str, float, float]] = {}
        for equality in range(model.neq):
            ends = int(model.eq_obj1id[equality]), int(model.eq_obj2id[equality])
            if int(model.eq_type[equality]) != int(kinds.mjEQ_JOINT) or not model.eq_active0[equality]:
                continue
            constant, factor, *higher = floats(model.eq_data[equality][:5])
            if ends[0] not in numbers or ends[1] not in numbers or any(higher):
                continue
            own, other = (float(model.qpos0[model.jnt_qposadr[joint]]) for joint in ends)
            # q1 - ref1 = c0 + c1 (q2 - ref2)
            followers.setdefault(numbers[ends[0]], (numbers[ends[1]], factor, own + constant - factor * other))
        return followers

    def _with_follows(self, joint: LoadedJoint, followers: dict[str, tuple[str, float, float]]) -> LoadedJoint:
        return replace(joint, follows=followers.get(joint.name))

    def _forces(self) -> list[str]:
        """What MuJoCo computes with and a robot has no place for."""
        model = self._model
        found: list[str] = []
        gravity = floats(model.opt.gravity)
        if tuple(gravity) != USUAL_GRAVITY:
            found.append(f"gravity is {gravity} m/s^2 in MuJoCo; torques are compared under 9.81 m/s^2")
        for name, body in self.bodies.items():
            if model.body_gravcomp[body]:
                found.append(
                    f'body "{name}": gravcomp {float(model.body_gravcomp[body]):g} carries a part of its weight in MuJoCo'
                )
        for name, joint in self.joints.items():
            if np.any(model.jnt_stiffness[joint]):
                found.append(f'joint "{name}": a spring of {float(model.jnt_stiffness[joint]):g} acts in MuJoCo')
            if np.any(model.dof_dampingpoly[int(model.jnt_dofadr[joint])]):
                found.append(f'joint "{name}": a damping by powers of the speed acts in MuJoCo')
        return found


def _motion(kind: int, axis: list[float], by: float) -> Array:
    if kind == SLIDE:
        matrix = np.eye(4)
        matrix[:3, 3] = np.multiply(axis, by)
        return matrix
    half = by / 2
    return matrix_of((0.0, 0.0, 0.0), (np.cos(half), *np.multiply(axis, np.sin(half)))) if by else np.eye(4)
