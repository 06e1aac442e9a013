"""Poses, Jacobians, mass matrices and torques of Pinocchio, which reads the same URDFs by code of its own.

`goldens/make.py` wrote the numbers; where Pinocchio is installed, states that no file has are compared, too.
"""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import ROBOTS, load

import congruent

GOLDENS: dict[str, Any] = json.loads((Path(__file__).parent / "goldens/pinocchio.json").read_text())["robots"]

# Entries of poses and Jacobians, m and 1. Kind: rounding of products of seven matrices; worst seen 9e-16; x20.
ROUNDING = 2e-14
# Torques and mass matrices, relative to the largest. Kind: rounding; worst seen 2.5e-15; x16.
RELATIVE = 4e-14


def ratios(robot: congruent.Robot, joints: list[str]) -> np.ndarray:
    """Positions of all joints from those of the driven ones: the second finger of the hand follows the first."""
    followed = {"panda_finger_joint2": "panda_finger_joint1"}
    return np.array([[float(followed.get(joint, joint) == driven) for driven in robot.joints] for joint in joints])


def assert_near(found: np.ndarray, expected: np.ndarray) -> None:
    np.testing.assert_allclose(found, expected, rtol=0, atol=RELATIVE * max(1.0, np.abs(expected).max()))


@pytest.mark.parametrize("name", GOLDENS)
def test_the_numbers_of_pinocchio(name: str) -> None:
    golden, robot = GOLDENS[name], load(name)
    follow = ratios(robot, golden["joints"])
    assert robot.tip == golden["tip"]
    for state in golden["states"]:
        q, qd, qdd = (np.array(state[key]) for key in ("q", "qd", "qdd"))
        by_name = dict(zip(golden["joints"], q))
        own = {joint: by_name[joint] for joint in robot.joints}
        np.testing.assert_allclose(robot.fk(own), state["base_from_tip"], rtol=0, atol=ROUNDING)
        # The tip does not depend on the fingers, so their columns are zero for both.
        np.testing.assert_allclose(robot.jacobian(own), state["jacobian"] @ follow, rtol=0, atol=ROUNDING)
        if follow.shape[0] == follow.shape[1]:
            order = [golden["joints"].index(joint) for joint in robot.joints]
            assert_near(robot.mass_matrix(own), np.array(state["mass_matrix"])[np.ix_(order, order)])
            assert_near(robot.inverse_dynamics(own, qd[order], qdd[order]), np.array(state["tau"])[order])


@pytest.mark.parametrize("name", GOLDENS)
def test_pinocchio_itself(name: str) -> None:
    pin = pytest.importorskip("pinocchio")
    robot = load(name)
    model = pin.buildModelFromUrdf(str(ROBOTS / name / f"{name}.urdf"))
    data, frame = model.createData(), model.getFrameId(robot.tip)
    follow = ratios(robot, list(model.names)[1:])
    random = np.random.default_rng(13)
    q, qd, qdd = (random.uniform(-1, 1, (200, robot.dof)) for _ in range(3))
    poses, jacobians = robot.fk(q), robot.jacobian(q)
    matrices, tau = robot.mass_matrix(q), robot.inverse_dynamics(q, qd, qdd)
    for row in range(200):
        of_all = [follow @ vector[row] for vector in (q, qd, qdd)]
        pin.forwardKinematics(model, data, of_all[0])
        pose = pin.updateFramePlacement(model, data, frame).homogeneous
        np.testing.assert_allclose(poses[row], pose, rtol=0, atol=ROUNDING)
        jacobian = pin.computeFrameJacobian(model, data, of_all[0], frame, pin.LOCAL_WORLD_ALIGNED) @ follow
        np.testing.assert_allclose(jacobians[row], np.vstack([jacobian[3:], jacobian[:3]]), rtol=0, atol=ROUNDING)
        # Principle of virtual work: torques of followers act on their masters.
        assert_near(tau[row], follow.T @ pin.rnea(model, data, *of_all))
        assert_near(matrices[row], follow.T @ pin.crba(model, data, of_all[0]) @ follow)
