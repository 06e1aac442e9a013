"""The proof that a model was read right: the engine's own poses and torques are those of the numbers read."""

from __future__ import annotations

import numpy as np

from .._native import Robot, loaded_robot
from ._engine import Asked, Engine, State, refused
from ._loaded import Array, LoadedJoint, LoadedModel

STATES = 32
"""Random states, beside zero. Kind: choice; a wrong number that shows nowhere in them is improbable."""
SEED = 0
SLIDE_M = 1.0
"""How far joints slide that have no range."""
LEAST_TORQUE = 1e-3
"""Torques that are smaller everywhere are compared with this one, N m."""


def prove(engine: Engine, model: LoadedModel) -> tuple[float, float]:
    """How far the poses that the engine computes are from those of what was read, at most, in m and rad.

    Raises ``CongruentError`` with the numbers if they differ by more than the precision of the engine.
    """
    plain = loaded_robot(model.without_friction())
    moving = [joint for joint in model.joints if joint.kind != "fixed"]
    if not moving:
        raise refused(f"{engine.name}: the model has no joint that turns or slides", "load the robot before it is asked")
    states = [_State(moving, positions, plain) for positions in _positions(moving)]
    with engine.asking(model) as asked:
        within = _prove_poses(engine, asked, plain, states)
        _prove_torques(engine, asked, plain, states)
    return within


class _State:
    """A motion at one instant: random positions, speeds and accelerations of the joints that lead, and what follows from them."""

    def __init__(self, moving: list[LoadedJoint], positions: Array, robot: Robot) -> None:
        rng = np.random.default_rng([SEED, int(abs(float(positions.sum())) * 1e6)])
        names = [joint.name for joint in moving]
        self.q = dict(zip(names, map(float, positions)))
        self.qd = dict(zip(names, map(float, rng.uniform(-1, 1, len(names)))))
        self.qdd = dict(zip(names, map(float, rng.uniform(-1, 1, len(names)))))
        for joint in moving:
            if joint.follows is not None:
                leader, factor, offset = joint.follows
                self.q[joint.name] = factor * self.q[leader] + offset
                self.qd[joint.name] = factor * self.qd[leader]
                self.qdd[joint.name] = factor * self.qdd[leader]
        self.followers = {joint.name: joint.follows for joint in moving if joint.follows is not None}
        self.driven = robot.joints

    def of_robot(self, of: State) -> list[float]:
        """The values of the joints that lead, in the order of the robot."""
        return [of[name] for name in self.driven]

    def folded(self, torques: State) -> list[float]:
        """Torques at the joints that lead, with those of their followers."""
        sums = {name: torques[name] for name in self.driven}
        for name, (leader, factor, _) in self.followers.items():
            sums[leader] += factor * torques[name]
        return [sums[name] for name in self.driven]


def _positions(moving: list[LoadedJoint]) -> list[Array]:
    rng = np.random.default_rng(SEED)
    ends = np.array([_ends(joint) for joint in moving])
    zero = np.clip(np.zeros(len(moving)), ends[:, 0], ends[:, 1])
    return [zero, *rng.uniform(ends[:, 0], ends[:, 1], (STATES, len(moving)))]


def _ends(joint: LoadedJoint) -> tuple[float, float]:
    most = np.pi if joint.kind == "hinge" else SLIDE_M
    if joint.range is None:
        return -most, most
    # A loaded range may be the wrong way round, which is a difference and no reason to ask nothing.
    low, high = sorted(map(float, joint.range))
    # A range of 1e6 m stands for none, and would leave no digits.
    return max(low, -4 * most), min(high, 4 * most)


def _prove_poses(engine: Engine, asked: Asked, robot: Robot, states: list[_State]) -> tuple[float, float]:
    links = [link for link in robot.links if link in asked.poses(states[0].q) and link != robot.base]
    read = {link: robot.fk([state.of_robot(state.q) for state in states], link) for link in links}
    limit, worst = engine.precision, np.zeros(2)
    for number, state in enumerate(states):
        computed = asked.poses(state.q)
        for link in links:
            off_m, off_rad = _apart(read[link][number], computed[link])
            if off_m > limit.position_m or off_rad > limit.orientation_rad or np.isnan(off_m + off_rad):
                message = (
                    f'{engine.name}: the pose of "{link}" that it computes is {off_m:.3g} m and {off_rad:.3g} rad from that of the '
                    f"numbers read, limit {limit.position_m:.0e} m and {limit.orientation_rad:.0e} rad, at {_listed(state.q)}"
                )
                raise refused(message, "the adapter does not read this model right: please report it")
            worst = np.maximum(worst, (off_m, off_rad))
    return float(worst[0]), float(worst[1])


def _apart(read: Array, computed: Array) -> tuple[float, float]:
    turn = read[:3, :3].T @ computed[:3, :3]
    # By the sine: the cosine has no digits near 0.
    sine = np.linalg.norm([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2
    angle = float(np.arctan2(sine, (np.trace(turn) - 1) / 2))
    return float(np.linalg.norm(read[:3, 3] - computed[:3, 3])), angle


def _prove_torques(engine: Engine, asked: Asked, robot: Robot, states: list[_State]) -> None:
    computed = [asked.torques(state.q, state.qd, state.qdd) for state in states]
    answers = [state.folded(torques) for state, torques in zip(states, computed) if torques is not None]
    if len(answers) < len(states):
        return
    q, qd, qdd = ([state.of_robot(of) for state, of in zip(states, rows)] for rows in zip(*((s.q, s.qd, s.qdd) for s in states)))
    read = robot.inverse_dynamics(q, qd, qdd, friction=engine.counts_damping)
    off = np.abs(read - np.array(answers))
    largest = max(float(np.abs(read).max()), float(np.abs(answers).max()), LEAST_TORQUE)
    if not off.max() <= engine.precision.torque_relative * largest:
        number, joint = np.unravel_index(int(np.nanargmax(off)), off.shape)
        message = (
            f'{engine.name}: the torque of "{robot.joints[joint]}" that it computes is {answers[number][joint]:.6g}, and '
            f"{read[number, joint]:.6g} by the numbers read, limit {engine.precision.torque_relative:.0e} of {largest:.3g}, "
            f"at {_listed(states[number].q)}"
        )
        raise refused(message, "the adapter does not read this model right: please report it")


def _listed(q: State) -> str:
    return ", ".join(f"{name} = {value:.4g}" for name, value in q.items())
