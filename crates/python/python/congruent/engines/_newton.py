"""Newton: what a ``newton.Model`` has in its arrays, of 32-bit numbers. Tested with Newton 1.8."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from .._native import Robot
from ._engine import Asked, Engine, Precision, State, imported, refused
from ._loaded import Array, LoadedJoint, LoadedLink, LoadedModel, floats, inverse, matrix_of

WORLD = -1
USUAL_GRAVITY = (0.0, 0.0, -9.81)
UNLIMITED = 1e5
"""Limits from here on stand for none: Newton writes 1e6 and more."""


def newton(model: Any) -> Engine:
    """The robot that Newton has loaded, as ``congruent.check("arm.urdf", engine=congruent.engines.newton(model))``.

    ``model`` is a finalized ``newton.Model`` with one robot: ``builder.add_urdf(path, floating=False);
    builder.finalize(device="cpu")``. What its 32-bit numbers do not hold is no difference.

    Raises ``CongruentError`` if Newton is not installed, or ``model`` is no model.
    """
    module = imported("newton", "newton", "newton")
    if not isinstance(model, module.Model):
        raise refused(f"congruent.engines.newton: {type(model).__name__} is no newton.Model", "model = builder.finalize()")
    return _Newton(module, model)


class _Newton(Engine):
    precision = Precision.single()
    # Damping is a value of the joint that inverse dynamics do not have.
    counts_damping = False

    def __init__(self, module: Any, model: Any) -> None:
        self._module, self._model = module, model

    @property
    def name(self) -> str:
        return f"Newton {self._module.__version__} (loaded model, 32-bit numbers)"

    def read(self, robot: Robot) -> LoadedModel:
        self._reader = _Reader(self._module, self._model, self.name, robot)
        return self._reader.loaded()

    @contextmanager
    def asking(self, model: LoadedModel) -> Iterator[Asked]:
        gravity = self._model.gravity.numpy().copy()
        try:
            self._model.gravity.assign(np.tile(np.array(USUAL_GRAVITY, np.float32), (len(gravity), 1)))
            yield _Asked(self._module, self._model, self._reader)
        finally:
            self._model.gravity.assign(gravity)


class _Reader:
    """``joints`` and ``bodies`` have the numbers of both in the model, by the names that they have here."""

    def __init__(self, module: Any, model: Any, engine: str, robot: Robot) -> None:
        self._module, self._model, self._engine = module, model, engine
        known = {*robot.links, *robot.joints}
        self._links = [_name(label, known) for label in model.body_label]
        self._labels = [_name(label, known) for label in model.joint_label]
        if len(set(self._links)) < len(self._links):
            raise refused(f"{engine}: several bodies have the same name", "build a model with one robot")
        self._parents, self._children = (values.numpy() for values in (model.joint_parent, model.joint_child))
        self.root = next((int(child) for parent, child in zip(self._parents, self._children) if parent == WORLD), 0)
        kinds = module.JointType
        self._kinds = {int(kinds.REVOLUTE): "hinge", int(kinds.PRISMATIC): "slide", int(kinds.FIXED): "fixed"}
        types = model.joint_type.numpy()
        self._kind_of = [self._kinds.get(int(kind)) for kind in types]
        numbers = range(model.joint_count)
        self.joints = {
            self._labels[at]: at for at in numbers if self._kind_of[at] in ("hinge", "slide") and self._parents[at] != WORLD
        }
        self.bodies = {name: at for at, name in enumerate(self._links)}

    def loaded(self) -> LoadedModel:
        """All that is compared."""
        links = [self._link(at) for at in range(self._model.body_count)]
        joints: list[LoadedJoint] = []
        for at in range(self._model.joint_count):
            if self._parents[at] != WORLD:
                joints.append(self._joint(at))
        follows = self._followers()
        joints = [LoadedJoint(**{**vars(joint), "follows": follows.get(joint.name)}) for joint in joints]
        return LoadedModel(self._engine, "robot", links, joints, self._forces(), couples=bool(follows), is_single_precision=True)

    def _link(self, at: int) -> LoadedLink:
        model = self._model
        tensor = [floats(row) for row in model.body_inertia.numpy()[at]]
        return LoadedLink(self._links[at], float(model.body_mass.numpy()[at]), floats(model.body_com.numpy()[at]), tensor)

    def _joint(self, at: int) -> LoadedJoint:
        model, name, kind = self._model, self._labels[at], self._kind_of[at]
        child_from_joint = model.joint_X_c.numpy()[at]
        if kind is None or not np.allclose(child_from_joint, [0, 0, 0, 0, 0, 0, 1]):
            raise refused(
                f'{self._engine}: joint "{name}" neither turns about an axis nor slides, or its child has another frame'
            )
        x, y, z, *xyzw = floats(model.joint_X_p.numpy()[at])
        parent, child = self._links[self._parents[at]], self._links[self._children[at]]
        place = LoadedJoint(name, kind, parent, child, [x, y, z], [xyzw[3], *xyzw[:3]])
        if kind == "fixed":
            return place
        dof = int(model.joint_qd_start.numpy()[at])

        def value(array: str) -> float:
            return float(getattr(model, array).numpy()[dof])

        ends = [value("joint_limit_lower"), value("joint_limit_upper")]
        return LoadedJoint(
            **{
                **vars(place),
                "axis": floats(model.joint_axis.numpy()[dof]),
                "range": ends if max(map(abs, ends)) < UNLIMITED else None,
                "effort": _limit(value("joint_effort_limit")),
                "velocity": _limit(value("joint_velocity_limit")),
                "damping": value("joint_damping"),
                "friction": value("joint_friction"),
                "armature": value("joint_armature"),
            }
        )

    def _followers(self) -> dict[str, tuple[str, float, float]]:
        """Joints that follow others: ``q0 = coef0 + coef1 q1``."""
        model = self._model
        names = {at: name for name, at in self.joints.items()}
        found: dict[str, tuple[str, float, float]] = {}
        arrays = (
            model.constraint_mimic_joint0,
            model.constraint_mimic_joint1,
            model.constraint_mimic_coef0,
            model.constraint_mimic_coef1,
        )
        for follower, leader, offset, factor in zip(*(values.numpy() for values in arrays)):
            found[names[int(follower)]] = (names[int(leader)], float(factor), float(offset))
        return found

    def _forces(self) -> list[str]:
        gravity = floats(self._model.gravity.numpy()[0])
        found = []
        if not np.allclose(gravity, USUAL_GRAVITY, rtol=1e-6, atol=1e-6):
            found.append(f"gravity is {gravity} m/s^2 in Newton; torques are compared under 9.81 m/s^2")
        stiffness = self._model.joint_stiffness.numpy()
        for name, at in self.joints.items():
            spring = float(stiffness[int(self._model.joint_qd_start.numpy()[at])])
            if spring:
                found.append(f'joint "{name}": a spring of {spring:g} acts in Newton')
        return found


def _name(label: str, known: set[str]) -> str:
    """The name in the file: Newton puts that of the robot before it."""
    return label if label in known else label.rpartition("/")[2]


def _limit(value: float) -> float | None:
    return value if 0 < value < UNLIMITED else None


class _Asked:
    """A state of its own, so that those of the caller are not touched."""

    def __init__(self, module: Any, model: Any, reader: _Reader) -> None:
        self._module, self._model, self._reader = module, model, reader
        self._state = model.state()

    def _set(self, q: State, qd: State) -> None:
        starts = self._model.joint_q_start.numpy(), self._model.joint_qd_start.numpy()
        positions, speeds = self._model.joint_q.numpy().copy(), np.zeros(self._model.joint_dof_count, np.float32)
        for name, at in self._reader.joints.items():
            positions[starts[0][at]], speeds[starts[1][at]] = q[name], qd[name]
        self._state.joint_q.assign(positions)
        self._state.joint_qd.assign(speeds)
        self._module.eval_fk(self._model, self._state.joint_q, self._state.joint_qd, self._state)

    def poses(self, q: State) -> dict[str, Array]:
        self._set(q, dict.fromkeys(q, 0.0))
        rows = self._state.body_q.numpy()
        world_from = {name: _pose(rows[at]) for name, at in self._reader.bodies.items()}
        root_from_world = inverse(_pose(rows[self._reader.root]))
        return {name: root_from_world @ pose for name, pose in world_from.items()}

    def torques(self, q: State, qd: State, qdd: State) -> dict[str, float] | None:
        evaluate = getattr(self._module, "eval_inverse_dynamics_force", None)
        root = self._model.body_q.numpy()[self._reader.root]
        if evaluate is None or not np.allclose(_pose(root)[:3, :3], np.eye(3), atol=1e-6):
            return None
        warp = imported("warp", "warp-lang", "newton")
        self._set(q, qd)
        model, count = self._model, self._model.joint_dof_count
        largest = model.max_dofs_per_articulation
        mass_matrix = warp.zeros((model.articulation_count, largest, largest), dtype=float, device=model.device)
        gravity, coriolis, found = (warp.zeros(count, dtype=float, device=model.device) for _ in range(3))
        accelerations = np.zeros(count, np.float32)
        starts = model.joint_qd_start.numpy()
        for name, at in self._reader.joints.items():
            accelerations[starts[at]] = qdd[name]
        asked = {"mass_matrix": mass_matrix, "coriolis_force": coriolis, "gravity_force": gravity}
        self._module.eval_inverse_dynamics_passive(model, self._state, **asked)
        given = warp.array(accelerations, dtype=float, device=model.device)
        evaluate(model, self._state, **asked, joint_qdd=given, joint_f=found)
        torques = found.numpy()
        return {name: float(torques[starts[at]]) for name, at in self._reader.joints.items()}


def _pose(row: Array) -> Array:
    x, y, z, *xyzw = floats(row)
    return matrix_of([x, y, z], [xyzw[3], *xyzw[:3]])
