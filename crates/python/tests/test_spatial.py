"""The calculations of the course: values by hand, laws, and what is refused."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
import pytest

import congruent
from congruent import spatial

TAIT_BRYAN = ["".join(axes) for axes in itertools.permutations("xyz")]
PROPER = [first + middle + first for first, middle in itertools.permutations("xyz", 2)]
# Products of a few rotations; worst seen 9e-16.
ROUNDING = 1e-14


def motion(seed: int) -> Any:
    rng = np.random.default_rng(seed)
    return spatial.exp(rng.uniform(-1, 1, 6))


def test_elementary_transforms_by_hand() -> None:
    quarter = np.pi / 2
    np.testing.assert_allclose(spatial.turn_x(quarter) @ [0, 1, 0, 1], [0, 0, 1, 1], atol=ROUNDING)
    np.testing.assert_allclose(spatial.turn_y(quarter) @ [0, 0, 1, 1], [1, 0, 0, 1], atol=ROUNDING)
    np.testing.assert_allclose(spatial.turn_z(quarter) @ [1, 0, 0, 1], [0, 1, 0, 1], atol=ROUNDING)
    shifted = spatial.shift_x(1) @ spatial.shift_y(2) @ spatial.shift_z(3) @ [0, 0, 0, 1]
    np.testing.assert_array_equal(shifted, [1, 2, 3, 1])


@pytest.mark.parametrize("axes", TAIT_BRYAN + PROPER)
def test_the_twelve_euler_sets(axes: str) -> None:
    turns = {"x": spatial.turn_x, "y": spatial.turn_y, "z": spatial.turn_z}
    angles = [0.3, 0.7, -0.4]
    product = np.eye(4)
    for axis, angle in zip(axes, angles):
        product = product @ turns[axis](angle)
    rotation = spatial.euler_rotation(axes, angles)
    np.testing.assert_allclose(rotation, product[:3, :3], atol=ROUNDING)
    found = spatial.euler_angles(axes, rotation)
    np.testing.assert_allclose(found.angles_rad, angles, atol=ROUNDING)
    np.testing.assert_allclose(spatial.euler_rotation(axes, found.other_rad), rotation, atol=ROUNDING)
    assert found.determined == "both"
    middle = 0.0 if axes[0] == axes[2] else np.pi / 2
    singular = spatial.euler_angles(axes, spatial.euler_rotation(axes, [0.3, middle, 0.2]))
    assert singular.determined in ("sum", "difference") and singular.angles_rad[0] == 0


def test_normal_sliding_approach() -> None:
    pose = spatial.tool_pose(sliding=[0, 0.1, 0], approach=[0, 0, -2], origin_m=[0.4, 0, 0.2])
    axes = spatial.tool_axes(pose)
    np.testing.assert_array_equal(axes.normal, [-1, 0, 0])
    np.testing.assert_array_equal(axes.origin_m, [0.4, 0, 0.2])
    np.testing.assert_array_equal(spatial.tool_pose(axes.sliding, axes.approach, axes.origin_m, axes.normal), pose)
    with pytest.raises(congruent.CongruentError, match="left-handed") as refused:
        spatial.tool_pose(axes.sliding, axes.approach, axes.origin_m, -axes.normal)
    assert refused.value.findings[0].code == "python::spatial"
    with pytest.raises(congruent.CongruentError, match="parallel"):
        spatial.tool_pose([0, 0, 1], [0, 0, 2], [0, 0, 0])


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_a_row_and_its_transform(convention: Any) -> None:
    row = (0.25, -0.5, 0.1, 2.0)
    a, alpha, d, theta = row
    parts = [spatial.turn_z(theta), spatial.shift_z(d), spatial.shift_x(a), spatial.turn_x(alpha)]
    if convention == "modified":
        parts = [parts[3], parts[2], parts[0], parts[1]]
    transform = spatial.dh_transform(row, convention)
    np.testing.assert_allclose(np.linalg.multi_dot(parts), transform, atol=ROUNDING)
    np.testing.assert_allclose(spatial.dh_row_from_transform(transform, convention), row, atol=ROUNDING)
    for beside, words in [
        (spatial.shift_y(0.003), r"passes z. at a distance of 0.003.*\(DH2\)"),
        (spatial.turn_y(0.1), r"deg off the perpendicular.*\(DH1\)"),
        (spatial.turn_y(0.1) @ spatial.shift_y(0.003), r"\(DH1, DH2\)"),
    ]:
        with pytest.raises(congruent.CongruentError, match=words):
            spatial.dh_row_from_transform(beside, convention)
    with pytest.raises(congruent.CongruentError, match='no convention "craig"'):
        spatial.dh_transform(row, "craig")  # type: ignore[arg-type]


def test_exponential_and_logarithm() -> None:
    for seed in range(20):
        twist = np.random.default_rng(seed).uniform(-1, 1, 6)
        transform = spatial.exp(twist)
        np.testing.assert_allclose(spatial.log(transform), twist, atol=1e-13)
        np.testing.assert_allclose(spatial.rotation_exp(twist[:3]), transform[:3, :3], atol=ROUNDING)
        np.testing.assert_allclose(spatial.rotation_log(transform[:3, :3]), twist[:3], atol=1e-13)
        # The series of the exponential, to the rounding of its sum.
        power, total = np.eye(4), np.eye(4)
        for order in range(1, 30):
            power = power @ spatial.hat(twist) / order
            total = total + power
        np.testing.assert_allclose(transform, total, atol=1e-14)
    np.testing.assert_array_equal(spatial.log(np.eye(4)), np.zeros(6))
    np.testing.assert_allclose(spatial.exp([0, 0, 1, 0, 0, 0], np.pi / 2), spatial.turn_z(np.pi / 2), atol=ROUNDING)


def test_the_adjoint_moves_twists() -> None:
    a_from_b, twist = motion(1), np.random.default_rng(2).uniform(-1, 1, 6)
    # Ad(T) V is the twist whose matrix is T [V] T^-1.
    moved = a_from_b @ spatial.hat(twist) @ np.linalg.inv(a_from_b)
    np.testing.assert_allclose(spatial.hat(spatial.adjoint(a_from_b) @ twist), moved, atol=ROUNDING)


def test_the_velocity_of_the_tip(ur5e: congruent.Robot) -> None:
    q, qd = np.linspace(0.1, 0.6, 6), np.linspace(-0.3, 0.4, 6)
    velocity = spatial.tip_velocity(ur5e, q, qd)
    # Central difference, h = 1e-5: 1e-10 m/s and rad/s.
    before, after = (ur5e.fk(q + step * qd) for step in (-1e-5, 1e-5))
    np.testing.assert_allclose(velocity[3:], (after - before)[:3, 3] / 2e-5, atol=1e-9)
    turn = spatial.rotation_log(after[:3, :3] @ before[:3, :3].T)
    np.testing.assert_allclose(velocity[:3], turn / 2e-5, atol=1e-9)


def test_what_is_refused() -> None:
    for call, words in [
        (lambda: spatial.log(2 * np.eye(4)), "no homogeneous one"),
        (lambda: spatial.rotation_log(np.diag([1, 1, -1])), "no rotation"),
        (lambda: spatial.adjoint(np.full((4, 4), np.nan)), "no homogeneous one"),
        (lambda: spatial.log(np.eye(3)), r"shape \(3, 3\), expected \(4, 4\)"),
        (lambda: spatial.hat([1, 2]), r"shape \(2,\), expected \(6,\)"),
        (lambda: spatial.euler_rotation("xxy", [0, 0, 0]), 'unknown set of Euler angles "xxy"'),
        (lambda: spatial.hat("abc"), "expected numbers"),
    ]:
        with pytest.raises(congruent.CongruentError, match=words):
            call()
