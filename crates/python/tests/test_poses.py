"""Poses: numbers of teaching documents, which a reader can compute by hand, and what batches must have in common."""

import tracemalloc

import numpy as np
import pytest
from conftest import load

import congruent

# Poses on two paths, m and 1. Kind: rounding; worst seen 1e-15; x10.
ROUNDING = 1e-14
# Digits of the documents, m. Kind: golden digits; they have twelve.
GOLDEN_M = 1e-11


def test_two_links_in_a_plane() -> None:
    # A lecture on forward kinematics: lengths 0.6 m and 0.4 m, 30 deg and -45 deg.
    base_from_tip = load("planar_2r").fk(np.radians([30, -45]))
    expected = [0.6 * np.cos(np.pi / 6) + 0.4 * np.cos(-np.pi / 12), 0.6 * 0.5 + 0.4 * np.sin(-np.pi / 12), 0]
    np.testing.assert_allclose(base_from_tip[:3, 3], expected, rtol=0, atol=ROUNDING)
    np.testing.assert_allclose(base_from_tip[:2, 3], [0.905985572786, 0.196472381959], rtol=0, atol=GOLDEN_M)


def test_three_joints_in_space_and_their_tool() -> None:
    robot, q = load("spatial_3r"), np.radians([20, -30, 40])
    base_from_tip = robot.fk(q)
    rotation = [
        [0.925416578398, -0.163175911167, 0.342020143326],
        [0.336824088833, -0.059391174614, -0.939692620786],
        [0.173648177667, 0.984807753012, 0],
    ]
    np.testing.assert_allclose(base_from_tip[:3, :3], rotation, rtol=0, atol=GOLDEN_M)
    position_m = [0.792510174455, 0.288450113855, 0.034729635533]
    np.testing.assert_allclose(base_from_tip[:3, 3], position_m, rtol=0, atol=GOLDEN_M)
    np.testing.assert_array_equal(base_from_tip[3], [0, 0, 0, 1])
    # 0.1 m along x3.
    tcp_m = [0.885051832295, 0.322132522738, 0.052094453300]
    np.testing.assert_allclose(robot.fk(q, "tcp")[:3, 3], tcp_m, rtol=0, atol=GOLDEN_M)


@pytest.mark.parametrize("rows", [0, 1, 2, 7, 8, 9, 1023, 1024, 1025, 5000])
def test_a_batch_is_its_rows_one_by_one(ur5e: congruent.Robot, rows: int) -> None:
    q = np.random.default_rng(1).uniform(-3, 3, (rows, 6))
    poses = ur5e.fk(q)
    assert poses.shape == (rows, 4, 4) and poses.dtype == np.float64
    for row in range(0, rows, 97):
        np.testing.assert_array_equal(poses[row], ur5e.fk(q[row]))


def test_joints_by_name(ur5e: congruent.Robot) -> None:
    q = np.zeros(6)
    q[ur5e.joints.index("elbow_joint")] = 0.7
    np.testing.assert_array_equal(ur5e.fk({"elbow_joint": 0.7}), ur5e.fk(q))
    np.testing.assert_array_equal(ur5e.fk({}), ur5e.fk(np.zeros(6)))
    # A number beside arrays is that of all rows.
    angles = np.linspace(-1, 1, 5)
    many = np.zeros((5, 6))
    many[:, 2], many[:, 0] = angles, 0.3
    by_name = ur5e.fk({"elbow_joint": angles, "shoulder_pan_joint": 0.3})
    np.testing.assert_array_equal(by_name, ur5e.fk(many))


@pytest.mark.parametrize("dtype", [np.float32, np.int64, np.uint8, ">f8"])
def test_other_types_and_orders_are_read_as_numbers(ur5e: congruent.Robot, dtype: type | str) -> None:
    q = np.arange(24).reshape(4, 6) % 3
    expected = ur5e.fk(q.astype(float))
    np.testing.assert_array_equal(ur5e.fk(q.astype(dtype)), expected)
    # In memory one column after another: rows must not be read as columns.
    np.testing.assert_array_equal(ur5e.fk(np.asfortranarray(q.astype(float))), expected)
    np.testing.assert_array_equal(ur5e.fk(np.repeat(q.astype(float), 2, axis=0)[::2]), expected)
    np.testing.assert_array_equal(ur5e.fk(q.tolist()), expected)


def test_an_array_that_may_not_be_written_is_read(ur5e: congruent.Robot) -> None:
    q = np.zeros((3, 6))
    q.flags.writeable = False
    assert ur5e.fk(q).shape == (3, 4, 4)
    assert ur5e.fk(np.broadcast_to(np.zeros(6), (4, 6))).shape == (4, 4, 4)


def test_an_array_is_read_where_it_is(ur5e: congruent.Robot) -> None:
    q = np.random.default_rng(14).uniform(-3, 3, (200_000, 6))
    ur5e.fk(q[:2])
    tracemalloc.start()
    try:
        poses = ur5e.fk(q)
        _, most_bytes = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    # numpy reports its memory: that of the result, and no copy of what was given.
    assert poses.nbytes <= most_bytes < poses.nbytes + q.nbytes / 2


def test_a_link_of_the_chain_and_one_beside_it(panda: congruent.Robot) -> None:
    q = {joint: 0.1 * (at + 1) for at, joint in enumerate(panda.joints)}
    finger = {**q, "panda_finger_joint1": 0.03}
    # The fingers move along y of the hand, the second as the first, to the other side.
    hand = panda.fk(finger, "panda_hand")
    left, right = (np.linalg.inv(hand) @ panda.fk(finger, f"panda_{side}finger") for side in ("left", "right"))
    np.testing.assert_allclose(left[:3, 3], [0, 0.03, 0.0584], rtol=0, atol=ROUNDING)
    np.testing.assert_allclose(right[:3, 3], [0, -0.03, 0.0584], rtol=0, atol=ROUNDING)
    # They do not move the tip.
    np.testing.assert_array_equal(panda.fk(q), panda.fk(finger))


def test_what_a_robot_says_of_itself(panda: congruent.Robot, ur5e: congruent.Robot) -> None:
    assert panda.joints == [f"panda_joint{at}" for at in range(1, 8)] + ["panda_finger_joint1"]
    assert panda.dof == 8 and panda.base == "panda_link0" and panda.tip == "panda_link8"
    assert panda.limits.shape == (8, 2)
    np.testing.assert_allclose(panda.limits[3], [-3.0718, -0.0698])
    assert "panda_rightfinger" in panda.links
    assert "6 joints" in repr(ur5e) and "ur5e" in ur5e.name.lower()


def test_another_chain(ur5e: congruent.Robot, root) -> None:  # type: ignore[no-untyped-def]
    forearm = congruent.Robot(root / "robots/ur5e", tip="forearm_link")
    assert forearm.tip == "forearm_link"
    q = np.random.default_rng(2).uniform(-1, 1, 6)
    np.testing.assert_allclose(forearm.fk(q), ur5e.fk(q, "forearm_link"), rtol=0, atol=ROUNDING)
