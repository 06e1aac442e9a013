"""The poses of any function against a file: a fault is found with its cause and line, and what is no pose is refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import ROBOTS

import congruent

PoseFunction = Callable[[Any], Any]


@pytest.fixture(params=["ur5e", "panda"])
def arm(request: pytest.FixtureRequest) -> congruent.Robot:
    return congruent.Robot(ROBOTS / f"{request.param}/{request.param}.urdf")


def joints(robot: congruent.Robot) -> list[str]:
    """The joints of the arm, without a gripper."""
    return [name for name in robot.joints if "finger" not in name]


def kinematics(robot: congruent.Robot) -> PoseFunction:
    def my_fk(q: Any) -> Any:
        return robot.fk(dict(zip(joints(robot), q)))

    return my_fk


def with_fault(robot: congruent.Robot, old: str, new: str) -> tuple[PoseFunction, int]:
    """Kinematics of the file with a fault, and the line of it."""
    text = Path(robot.path).read_text()
    assert text.count(old) == 1
    return kinematics(congruent.Robot.from_text(text.replace(old, new))), text[: text.index(old)].count("\n") + 1


def test_the_same_kinematics(arm: congruent.Robot) -> None:
    report = congruent.check(arm, poses=kinematics(arm), joints=joints(arm))
    assert report.ok and report.grade == "identical", str(report)
    assert "SAME GEOMETRY" in report.headline and "URDF, poses and physics agree over the whole joint range" in report.headline
    assert "poses of my_fk: poses say nothing of masses, losses and limits" in str(report)


@pytest.mark.parametrize(
    ("name", "old", "new", "words"),
    [
        ("ur5e", '"-0.3922 0 0.1333"', '"-0.3932 0 0.1333"', 'by the poses xyz="-0.3932 0 0.1333", off by 1 mm'),
        ("ur5e", '"0 0 0" rpy="1.5707963267948966 0 0"', '"0 0 0"', 'by the poses rpy="0 0 0", off by 90 deg'),
        ("ur5e", '"0 -0.0997 0" rpy="1.5707963267948966 0 0"', '"0 -0.0997 0"', 'by the poses rpy="0 0 0", off by 90 deg'),
        ("panda", '"0 -0.316 0" rpy="1.5707963267948966 0 0"', '"0 -0.316 0"', 'by the poses rpy="0 0 0", off by 90 deg'),
        ("panda", '"-0.0825 0.384 0"', '"-0.0835 0.384 0"', 'by the poses xyz="-0.0835 0.384 0", off by 1 mm'),
    ],
)
def test_a_fault_with_its_line(name: str, old: str, new: str, words: str) -> None:
    robot = congruent.Robot(ROBOTS / f"{name}/{name}.urdf")
    poses, line = with_fault(robot, old, new)
    report = congruent.check(robot, poses=poses, joints=joints(robot))
    assert not report.ok and words in report.headline and f"{name}.urdf:{line})" in report.headline, report.headline
    assert "(certified)" in str(report)


def test_joints_in_another_order(arm: congruent.Robot) -> None:
    names = joints(arm)
    exchanged = [names[0], names[2], names[1], *names[3:]]
    report = congruent.check(arm, poses=kinematics(arm), joints=exchanged)
    assert not report.ok and f"{names[1]} and {names[2]} have another name" in report.headline, report.headline
    assert f"q[1], called {names[2]}" in str(report)

    def in_this_order(q: Any) -> Any:
        return kinematics(arm)([q[0], q[2], q[1], *q[3:]])

    assert congruent.check(arm, poses=in_this_order, joints=exchanged).ok


def test_32_bit_poses(arm: congruent.Robot) -> None:
    def single(q: Any) -> Any:
        return kinematics(arm)(q).astype(np.float32)

    report = congruent.check(arm, poses=single, joints=joints(arm))
    assert report.ok and report.grade == "same_within_digits", str(report)
    assert "32-bit numbers" in str(report) and "<1 pm" not in report.headline
    bound = report.json()["certificate"]
    assert 1e-8 < bound["position_m"] < 1e-5


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda pose: pose * np.nan, "values that are not finite"),
        (lambda pose: pose[:3], r"shape \(3, 4\)"),
        (lambda pose: pose * 2, "no homogeneous one with a rotation"),
        (lambda pose: np.diag([1, 1, -1, 1]) @ pose, "no homogeneous one with a rotation"),
        (lambda pose: None, "NoneType|shape"),
        (lambda pose: "pose", "no array of numbers"),
        (lambda pose: 1 / 0, "it raises ZeroDivisionError: division by zero"),
    ],
)
def test_what_is_no_pose(arm: congruent.Robot, change: Callable[[Any], Any], words: str) -> None:
    with pytest.raises(congruent.CongruentError, match=words) as refused:
        congruent.check(arm, poses=lambda q: change(kinematics(arm)(q)), joints=joints(arm))
    # With q: the first joint has a name and a value.
    assert f"{joints(arm)[0]} = 0.3" in str(refused.value)
    assert refused.value.findings[0].code == "python::poses"


def test_units_and_chains_that_are_none(arm: congruent.Robot) -> None:
    my_fk, names = kinematics(arm), joints(arm)

    def millimetres(q: Any) -> Any:
        pose = my_fk(q)
        pose[:3, 3] *= 1000
        return pose

    for poses, words in [
        (lambda q: my_fk(np.deg2rad(q)), "does the function take degrees"),
        (millimetres, "its lengths are 1000 times those of the file"),
        (lambda q: my_fk(q + 1e-4 * np.sin(5 * q)), "no chain of joints that turn or slide about fixed axes"),
        (lambda q: my_fk([*q[:-1], 1.00001 * q[-1]]), "moves 1.00001 times as far as q says"),
    ]:
        with pytest.raises(congruent.CongruentError, match=words):
            congruent.check(arm, poses=poses, joints=names)


def test_names_of_joints(ur5e: congruent.Robot) -> None:
    my_fk, names = kinematics(ur5e), joints(ur5e)
    with pytest.raises(congruent.CongruentError, match='joints names "elbow".*did you mean "elbow_joint"'):
        congruent.check(ur5e, poses=my_fk, joints=[*names[:2], "elbow", *names[3:]])
    with pytest.raises(congruent.CongruentError, match='joints lacks "wrist_3_joint", which moves "tool0"'):
        congruent.check(ur5e, poses=my_fk, joints=names[:-1])
    with pytest.raises(congruent.CongruentError, match="twice"):
        congruent.check(ur5e, poses=my_fk, joints=[*names, names[0]])
    with pytest.raises(congruent.CongruentError, match="int cannot be called"):
        congruent.check(ur5e, poses=3, joints=names)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="poses and joints together"):
        congruent.check(ur5e, poses=my_fk)


def test_another_tip_and_base(ur5e: congruent.Robot) -> None:
    part = congruent.Robot(ur5e.path, base="base", tip="wrist_1_link")
    names = ur5e.joints[:4]
    report = congruent.check(part, poses=lambda q: part.fk(dict(zip(names, q))), joints=names)
    assert report.ok, str(report)


def test_a_wrong_tool_at_the_link_of_the_last_joint(arm: congruent.Robot) -> None:
    tip = {"ur5e": "wrist_3_link", "panda": "panda_link7"}[Path(arm.path).stem]
    robot = congruent.Robot(arm.path, tip=tip)

    def right(q: Any) -> Any:
        return robot.fk(dict(zip(joints(robot), q)))

    def shifted(q: Any) -> Any:
        return right(q) @ congruent.spatial.shift_z(0.01)

    assert congruent.check(robot, poses=right, joints=joints(robot)).ok
    report = congruent.check(robot, poses=shifted, joints=joints(robot))
    assert not report.ok and "DIFFERENT, by up to 10 mm" in report.headline, str(report)
