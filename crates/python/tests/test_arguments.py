"""Arrays and robots that are refused: every message says what, where and what now."""

from pathlib import Path
import pickle

import numpy as np
import pytest

import congruent


@pytest.mark.parametrize(
    ("q", "message"),
    [
        (np.zeros(5), r"q has the shape \(5,\), but the robot has 6 joints"),
        (np.zeros((6, 4)), r"q has the shape \(6, 4\)"),
        (np.zeros((2, 3, 6)), r"\(2, 3, 6\)"),
        (3.0, r"q has the shape \(\)"),
        ("elbow", "not an array of numbers"),
        ([[0.0] * 6, [0.0] * 5], "not an array of numbers"),
        (np.zeros(6, dtype=complex), "complex128"),
        (np.zeros(6, dtype=bool), "bool"),
        (np.array([None] * 6), "object"),
        (None, "not an array of numbers"),
        ([0, 0, np.nan, 0, 0, 0], r'q of joint "elbow_joint" is NaN, not a finite number'),
        ([[0.0] * 6, [0, np.inf, 0, 0, 0, 0]], r'joint "shoulder_lift_joint" in row 1 is inf'),
        ({"elbow": 0.1}, 'did you mean "elbow_joint"'),
        ({"elbow_joint": [0.1, 0.2], "wrist_1_joint": [0.1]}, r"\(1,\)"),
        ({"elbow_joint": [[0.1]]}, r"\(1, 1\)"),
        ({"elbow_joint": np.nan}, "not a finite number"),
    ],
)
def test_positions_that_are_refused(ur5e: congruent.Robot, q: object, message: str) -> None:
    with pytest.raises(congruent.CongruentError, match=message) as refused:
        ur5e.fk(q)  # type: ignore[arg-type]
    [finding] = refused.value.findings
    assert finding.severity == "error" and finding.help and finding.id and finding.code


def test_an_unknown_link_names_the_nearest(ur5e: congruent.Robot) -> None:
    with pytest.raises(congruent.CongruentError, match='did you mean "forearm_link"'):
        ur5e.fk(np.zeros(6), "forarm_link")


def test_a_fault_of_a_file_has_its_line(tmp_path: Path) -> None:
    urdf = tmp_path / "arm.urdf"
    urdf.write_text('<robot name="arm">\n<link name="base"/>\n<joint name="a" type="hinge">\n</joint></robot>\n')
    with pytest.raises(congruent.CongruentError) as refused:
        congruent.Robot(urdf)
    errors = [finding for finding in refused.value.findings if finding.severity == "error"]
    assert errors and all(finding.file == str(urdf) for finding in errors)
    assert errors[0].line == 3 and f"{urdf}:3: " in str(refused.value)


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(congruent.CongruentError, match="nothing.urdf"):
        congruent.Robot(tmp_path / "nothing.urdf")
    # It is a ValueError for those who know nothing of this package.
    with pytest.raises(ValueError):
        congruent.Robot(str(tmp_path / "nothing.urdf"))


def test_an_exception_survives_another_process(tmp_path: Path) -> None:
    with pytest.raises(congruent.CongruentError) as refused:
        congruent.Robot(tmp_path / "nothing.urdf")
    again = pickle.loads(pickle.dumps(refused.value))
    assert str(again) == str(refused.value) and again.findings == refused.value.findings


def test_a_text_of_each_format(root: Path) -> None:
    urdf = congruent.Robot.from_text((root / "robots/ur5e/ur5e.urdf").read_text())
    file = congruent.Robot(root / "robots/ur5e/ur5e.urdf")
    q = np.linspace(-1, 1, 6)
    np.testing.assert_array_equal(urdf.fk(q, "tool0"), file.fk(q, "tool0"))
    mjcf = """<mujoco><worldbody><body name="arm" pos="0 0 1"><joint name="turn" axis="0 0 1"/>
      <geom size="0.1" mass="1"/><body name="hand" pos="0.5 0 0"/></body></worldbody></mujoco>"""
    arm = congruent.Robot.from_text(mjcf)
    np.testing.assert_allclose(arm.fk([np.pi / 2], "hand")[:3, 3], [0, 0.5, 1], atol=1e-15)
    with pytest.raises(congruent.CongruentError):
        congruent.Robot.from_text("joint positions")


def test_a_xacro_file(tmp_path: Path) -> None:
    pytest.importorskip("xacro")
    file = tmp_path / "slider.urdf.xacro"
    file.write_text(
        """<robot name="slider" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:arg name="length" default="1"/>
        <link name="base"/><link name="tip"/><joint name="slide" type="prismatic"><parent link="base"/><child link="tip"/>
        <origin xyz="$(arg length) 0 0"/><axis xyz="0 0 1"/><limit lower="0" upper="1" effort="1" velocity="1"/></joint></robot>"""
    )
    np.testing.assert_array_equal(congruent.Robot.from_xacro(file, length=0.25).fk([0.5])[:3, 3], [0.25, 0, 0.5])
    file.write_text(file.read_text().replace("$(arg length)", "${lenght}"))
    with pytest.raises(congruent.CongruentError, match="lenght") as refused:
        congruent.Robot.from_xacro(file)
    assert refused.value.findings[0].code == "python::xacro"
