"""Inverse kinematics: what it gives is put through the forward kinematics."""

import numpy as np
import pytest
from conftest import load

import congruent

# Entries of a pose that is reached within 1 nm and 1 nrad, m and 1. Kind: solver stop; x5.
REACHED = 5e-9
# Joints of an arm that reaches 1 m within 1 nm, far from its singular positions, rad. Kind: solver stop; x100.
REACHED_RAD = 1e-7
# A distance beyond the reach, whose search ends where it falls no further, m. Kind: solver stop.
BEYOND_M = 1e-6


def test_poses_are_reached(ur5e: congruent.Robot) -> None:
    q = np.random.default_rng(6).uniform(-2, 2, (50, 6))
    targets = ur5e.fk(q)
    found = ur5e.ik(targets)
    assert found.q.shape == (50, 6) and found.converged.all() and found.iterations.dtype == np.int64
    np.testing.assert_allclose(ur5e.fk(found.q), targets, rtol=0, atol=REACHED)
    assert (found.position_error_m <= 1e-9).all() and (found.orientation_error_rad <= 1e-9).all()
    assert ((found.q >= ur5e.limits[:, 0]) & (found.q <= ur5e.limits[:, 1])).all()


def test_one_target_has_no_dimension_for_rows(ur5e: congruent.Robot) -> None:
    q = np.array([0.1, -1.2, 1.0, -0.5, 0.4, 0.2])
    found = ur5e.ik(ur5e.fk(q), start=q + 0.05)
    assert found.q.shape == (6,) and found.converged.shape == () and bool(found.converged)
    np.testing.assert_allclose(found.q, q, atol=REACHED_RAD)


def test_positions_of_the_plane() -> None:
    # (0.6, 0.4) is reached with the elbow at a right angle: 0.6^2 + 0.4^2.
    robot = load("planar_2r")
    found = robot.ik([0.6, 0.4, 0.0], start=[0.1, 1.0])
    np.testing.assert_allclose(found.q, [0, np.pi / 2], atol=REACHED_RAD)
    # (2, 0) is a metre beyond the reach of 1 m: a result with its residual.
    beyond = robot.ik([[2.0, 0.0, 0.0]])
    assert not beyond.converged[0]
    np.testing.assert_allclose(beyond.position_error_m, [1.0], atol=BEYOND_M)


def test_the_tool_and_joints_that_do_not_move_it(panda: congruent.Robot) -> None:
    q = panda.limits.mean(axis=1)
    target = panda.fk(q, "tcp")
    start = q + 0.1
    start[7] = 0.02
    found = panda.ik(target, start, link="tcp")
    assert found.converged
    np.testing.assert_allclose(panda.fk(found.q, "tcp"), target, atol=REACHED)
    assert found.q[7] == 0.02


def test_position_only_and_tolerances(ur5e: congruent.Robot) -> None:
    target = ur5e.fk(np.full(6, 0.4))
    found = ur5e.ik(target, position_only=True, tolerance_m=1e-3)
    assert found.converged and found.position_error_m <= 1e-3 and found.orientation_error_rad == 0
    with pytest.raises(congruent.CongruentError, match="tolerance_m = -1 is not greater than 0"):
        ur5e.ik(target, tolerance_m=-1)
    with pytest.raises(congruent.CongruentError, match="more than 1000000"):
        ur5e.ik(target, max_iterations=10**7)


@pytest.mark.parametrize(
    ("target", "message"),
    [
        (np.zeros((4, 4)), "last row"),
        (np.diag([2.0, 2.0, 2.0, 1.0]), "rotation"),
        (np.diag([-1.0, 1.0, 1.0, 1.0]), "rotation"),
        (np.full((4, 4), np.nan), "finite"),
        (np.zeros((2, 5)), r"\(2, 5\)"),
        ([0.0, np.inf, 0.0], "finite"),
    ],
)
def test_what_is_no_target(ur5e: congruent.Robot, target: object, message: str) -> None:
    with pytest.raises(congruent.CongruentError, match=message) as refused:
        ur5e.ik(target)  # type: ignore[arg-type]
    assert refused.value.findings[0].help


def test_starts_as_many_as_targets(ur5e: congruent.Robot) -> None:
    with pytest.raises(congruent.CongruentError, match="start has 3 rows, but there are 2 targets"):
        ur5e.ik(np.zeros((2, 3)), start=np.zeros((3, 6)))


def test_an_unknown_option_names_the_nearest(ur5e: congruent.Robot) -> None:
    with pytest.raises(TypeError, match="did you mean 'tolerance_m'"):
        ur5e.ik([0.3, 0.3, 0.3], tolerance_n=1.0)  # type: ignore[call-arg]
