"""Jacobians against differences of poses, and the three kinds against each other."""

import numpy as np
import pytest

import congruent

STEP_RAD = 1e-6
# Central differences of a reach below 1.5 m: h^2 / 6 and rounding eps / h. Kind: truncation and rounding; worst seen 2e-10; x15.
DIFFERENCE = 3e-9


# Entries of a Jacobian that is computed on two paths. Kind: rounding; worst seen 1e-15; x10.
ROUNDING = 1e-14


def log_of_small_turn(rotation: np.ndarray) -> np.ndarray:
    skew = (rotation - rotation.T) / 2
    return np.array([skew[2, 1], skew[0, 2], skew[1, 0]])


def by_differences(robot: congruent.Robot, q: np.ndarray, link: str | None) -> np.ndarray:
    columns = []
    for joint in range(robot.dof):
        step = np.eye(robot.dof)[joint] * STEP_RAD
        before, after = robot.fk(q - step, link), robot.fk(q + step, link)
        angular = log_of_small_turn(after[:3, :3] @ before[:3, :3].T)
        columns.append(np.concatenate([angular, after[:3, 3] - before[:3, 3]]) / (2 * STEP_RAD))
    return np.array(columns).T


@pytest.mark.parametrize("link", [None, "tcp", "panda_link4", "panda_rightfinger"])
def test_the_geometric_jacobian_is_the_derivative_of_the_pose(panda: congruent.Robot, link: str | None) -> None:
    for q in np.random.default_rng(3).uniform(-1, 1, (5, 8)):
        jacobian = panda.jacobian(q, link)
        assert jacobian.shape == (6, 8)
        np.testing.assert_allclose(jacobian, by_differences(panda, q, link), rtol=0, atol=DIFFERENCE)


@pytest.mark.parametrize("link", [None, "tcp"])
def test_the_three_kinds_are_one_velocity(panda: congruent.Robot, link: str | None) -> None:
    q = np.random.default_rng(4).uniform(-1, 1, 8)
    pose = panda.fk(q, link)
    rotation, position = pose[:3, :3], pose[:3, 3]
    geometric = panda.jacobian(q, link)
    body = panda.jacobian(q, link, kind="body")
    np.testing.assert_allclose(np.vstack([rotation @ body[:3], rotation @ body[3:]]), geometric, atol=ROUNDING)
    # The point of the body at the origin of the base: v_0 = v_p - w x p.
    space = panda.jacobian(q, link, kind="space")
    moved = geometric[3:] - np.cross(geometric[:3].T, position).T
    np.testing.assert_allclose(space, np.vstack([geometric[:3], moved]), atol=ROUNDING)


def test_a_batch_is_its_rows(ur5e: congruent.Robot) -> None:
    q = np.random.default_rng(5).uniform(-3, 3, (700, 6))
    jacobians = ur5e.jacobian(q)
    assert jacobians.shape == (700, 6, 6)
    for row in (0, 255, 256, 699):
        np.testing.assert_array_equal(jacobians[row], ur5e.jacobian(q[row]))


def test_an_unknown_kind(ur5e: congruent.Robot) -> None:
    with pytest.raises(ValueError, match="geometric"):
        ur5e.jacobian(np.zeros(6), kind="spatial")  # type: ignore[arg-type]
