"""Engines: what they have loaded is compared with the file, and bugs of an importer are found, named and placed."""

from __future__ import annotations

import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import CORPUS, ROBOTS

import congruent

MUJOCO = "mujoco"
PINOCCHIO = "pinocchio"


@dataclass(frozen=True)
class Arm:
    """A robot whose file states losses at one joint, for faults at that joint and the link that it carries."""

    urdf: Path
    joint: str
    link: str

    def line(self, opening: str, part: str) -> int:
        """The line of a part of an element, from 1."""
        text = self.urdf.read_text()
        start = text.index(opening)
        return text[: text.index(part, start)].count("\n") + 1

    @property
    def of_joint(self) -> str:
        return f'<joint name="{self.joint}"'

    @property
    def of_link(self) -> str:
        return f'<link name="{self.link}"'


@pytest.fixture(params=["ur5e", "panda", "iiwa14"])
def arm(request: pytest.FixtureRequest, tmp_path: Path) -> Arm:
    places = {
        "ur5e": (ROBOTS / "ur5e/ur5e.urdf", "shoulder_lift_joint", "upper_arm_link"),
        "panda": (ROBOTS / "panda/panda.urdf", "panda_joint4", "panda_link4"),
        "iiwa14": (None if CORPUS is None else CORPUS / "robots/iiwa14/robot.urdf", "iiwa_joint_4", "iiwa_link_4"),
    }
    source, joint, link = places[request.param]
    if source is None:
        pytest.skip("CONGRUENT_CORPUS names no folder of public robots")
    losses = '<dynamics damping="0.5" friction="0.2"/>'
    element = re.compile(rf'(<joint name="{joint}".*?)(\s*<dynamics[^>]*/>)?(\s*</joint>)', re.S)
    text = element.sub(lambda of: f"{of[1]}\n    {losses}{of[3]}", source.read_text(), count=1)
    urdf = tmp_path / f"{request.param}.urdf"
    urdf.write_text(text)
    return Arm(urdf, joint, link)


def mujoco_model(urdf: Path, fuse: bool = False) -> Any:
    """The URDF as MuJoCo loads it, without its meshes, which may be anywhere."""
    mujoco = pytest.importorskip(MUJOCO)
    root = ElementTree.parse(urdf).getroot()
    for link in root.iter("link"):
        for shape in [*link.findall("visual"), *link.findall("collision")]:
            link.remove(shape)
    options = ElementTree.SubElement(ElementTree.SubElement(root, "mujoco"), "compiler")
    options.set("fusestatic", str(fuse).lower())
    return mujoco.MjModel.from_xml_string(ElementTree.tostring(root, encoding="unicode"))


def pinocchio_model(urdf: Path) -> Any:
    return pytest.importorskip(PINOCCHIO).buildModelFromUrdf(str(urdf))


def answer(arm: Arm, engine: congruent.engines.Engine) -> str:
    """The answer of a check that finds a difference."""
    report = congruent.check(arm.urdf, engine=engine)
    assert not report.ok, str(report)
    assert "/tmp" not in report.headline.replace(str(arm.urdf), "")
    return report.headline


def degrees(arm: Arm, model: Any) -> None:
    model.jnt_range[model.joint(arm.joint).id] *= 180 / np.pi


def rotation(arm: Arm, model: Any) -> None:
    model.body_quat[model.body(arm.link).id] = [1, 0, 0, 0]


def damping(arm: Arm, model: Any) -> None:
    model.dof_damping[model.joint(arm.joint).dofadr] = 0


def friction(arm: Arm, model: Any) -> None:
    model.dof_frictionloss[model.joint(arm.joint).dofadr] = 0


def armature(arm: Arm, model: Any) -> None:
    model.dof_armature[model.joint(arm.joint).dofadr] = 0.1


def density(arm: Arm, model: Any) -> None:
    body = model.body(arm.link).id
    model.body_mass[body] *= 1000 / 785
    model.body_inertia[body] *= 1000 / 785


def mass(arm: Arm, model: Any) -> None:
    model.body_mass[model.body(arm.link).id] = 1


def centre(arm: Arm, model: Any) -> None:
    model.body_ipos[model.body(arm.link).id] = 0


@pytest.mark.parametrize(
    ("fault", "words", "element", "part"),
    [
        (rotation, ["origin rpy=", 'loaded rpy="0 0 0"'], "of_joint", "<origin"),
        (damping, ["damping 0.5 N m s/rad", "0 N m s/rad in MuJoCo"], "of_joint", "<dynamics"),
        (friction, ["friction 0.2 N m", "0 N m in MuJoCo"], "of_joint", "<dynamics"),
        (armature, ["armature 0 kg m^2", "0.1 kg m^2 in MuJoCo"], "of_joint", "<joint"),
        (density, ["mass and inertia are wrong by the same factor"], "of_link", "<mass"),
        (mass, ["mass ", "1 kg in MuJoCo"], "of_link", "<mass"),
        (centre, ["the centre of mass is off"], "of_link", "<origin"),
        (degrees, ["limit", "is MuJoCo 4", "in degrees?"], "of_joint", "<limit"),
    ],
)
def test_a_fault_of_the_importer_in_mujoco(
    arm: Arm, fault: Callable[[Arm, Any], None], words: list[str], element: str, part: str
) -> None:
    model = mujoco_model(arm.urdf)
    assert congruent.check(arm.urdf, engine=congruent.engines.mujoco(model)).ok
    fault(arm, model)
    found = answer(arm, congruent.engines.mujoco(model))
    assert all(word in found for word in words), found
    assert arm.joint in found or arm.link in found, found
    # An armature has no line in a URDF: the one of another part of the joint is named.
    lines = [arm.line(getattr(arm, element), part)]
    if fault is armature:
        lines = list(range(lines[0], arm.line(arm.of_joint, "</joint>") + 1))
    assert any(f"{arm.urdf.name}:{line}" in found for line in lines), (found, lines)


def test_joints_in_another_order_in_mujoco(arm: Arm) -> None:
    model = mujoco_model(arm.urdf)
    one = model.joint(arm.joint).id
    names = model.name_jntadr.copy()
    model.name_jntadr[[one, one + 1]] = names[[one + 1, one]]
    found = answer(arm, congruent.engines.mujoco(model))
    assert "the names of joints" in found and "are exchanged" in found and arm.joint in found


def joint_of(arm: Arm, model: Any) -> Any:
    return model.joints[model.getJointId(arm.joint)]


def p_rotation(arm: Arm, model: Any) -> None:
    model.jointPlacements[model.getJointId(arm.joint)].rotation = np.eye(3)


def p_damping(arm: Arm, model: Any) -> None:
    model.damping[joint_of(arm, model).idx_v] = 0


def p_friction(arm: Arm, model: Any) -> None:
    model.upperDryFrictionLimit[joint_of(arm, model).idx_v] = 0


def p_armature(arm: Arm, model: Any) -> None:
    model.armature[joint_of(arm, model).idx_v] = 0.1


def p_density(arm: Arm, model: Any) -> None:
    inertia = model.inertias[model.getJointId(arm.joint)]
    lighter = type(inertia)(inertia.mass * 1000 / 785, inertia.lever, inertia.inertia * 1000 / 785)
    model.inertias[model.getJointId(arm.joint)] = lighter


def p_mass(arm: Arm, model: Any) -> None:
    inertia = model.inertias[model.getJointId(arm.joint)]
    model.inertias[model.getJointId(arm.joint)] = type(inertia).Zero()


@pytest.mark.parametrize(
    ("fault", "words", "element", "part"),
    [
        (p_rotation, ["origin rpy=", 'loaded rpy="0 0 0"'], "of_joint", "<origin"),
        (p_damping, ["damping 0.5 N m s/rad", "0 N m s/rad in Pinocchio"], "of_joint", "<dynamics"),
        (p_friction, ["friction 0.2 N m", "0 N m in Pinocchio"], "of_joint", "<dynamics"),
        (p_armature, ["armature 0 kg m^2", "0.1 kg m^2 in Pinocchio"], "of_joint", "<joint"),
        (p_density, ["mass and inertia are wrong by the same factor"], "of_link", "<mass"),
        (p_mass, ["not given in Pinocchio"], "of_link", "<mass"),
    ],
)
def test_a_fault_of_the_importer_in_pinocchio(
    arm: Arm, fault: Callable[[Arm, Any], None], words: list[str], element: str, part: str
) -> None:
    model = pinocchio_model(arm.urdf)
    assert congruent.check(arm.urdf, engine=congruent.engines.pinocchio(model)).ok
    fault(arm, model)
    found = answer(arm, congruent.engines.pinocchio(model))
    assert all(word in found for word in words), found
    lines = [arm.line(getattr(arm, element), part)]
    if fault is p_armature:
        lines = list(range(lines[0], arm.line(arm.of_joint, "</joint>") + 1))
    assert any(f"{arm.urdf.name}:{line}" in found for line in lines), (found, lines)


def test_joints_in_another_order_in_pinocchio(arm: Arm) -> None:
    model = pinocchio_model(arm.urdf)
    one = model.getJointId(arm.joint)
    model.names[one], model.names[one + 1] = model.names[one + 1], model.names[one]
    found = answer(arm, congruent.engines.pinocchio(model))
    assert "the names of joints" in found and arm.joint in found


def public_robots() -> list[Path]:
    own = sorted(ROBOTS.glob("*/*.urdf"))
    return own if CORPUS is None else [*own, *sorted(CORPUS.glob("robots/*/robot.urdf"))]


def test_the_public_robots_are_there() -> None:
    if CORPUS is None:
        pytest.skip("CONGRUENT_CORPUS names no folder of public robots: those of the repository alone are loaded")
    assert len(public_robots()) >= 16


@pytest.mark.parametrize("urdf", public_robots(), ids=lambda urdf: urdf.parent.name)
@pytest.mark.parametrize("fuse", [False, True], ids=["bodies", "fused"])
def test_no_alarm_in_mujoco(urdf: Path, fuse: bool) -> None:
    try:
        model = mujoco_model(urdf, fuse)
    except ValueError as error:
        pytest.skip(f"MuJoCo refuses the file: {error}")
    report = congruent.check(urdf, engine=congruent.engines.mujoco(model))
    assert report.ok and report.grade == "identical", str(report)
    assert report.headline.partition(": ")[2].startswith("SAME ROBOT"), report.headline


@pytest.mark.parametrize("urdf", public_robots(), ids=lambda urdf: urdf.parent.name)
def test_no_alarm_in_pinocchio(urdf: Path) -> None:
    report = congruent.check(urdf, engine=congruent.engines.pinocchio(pinocchio_model(urdf)))
    assert report.ok and report.grade == "identical", str(report)


def test_the_state_of_mujoco_is_as_before() -> None:
    mujoco = pytest.importorskip(MUJOCO)
    model = mujoco_model(ROBOTS / "ur5e/ur5e.urdf")
    model.opt.gravity[:] = [1, 2, 3]
    model.opt.disableflags = int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
    model.opt.viscosity = 0.25
    model.body_gravcomp[3] = 0.5
    before = {
        name: np.array(getattr(model.opt, name)) for name in ("gravity", "disableflags", "enableflags", "viscosity", "density")
    }
    report = congruent.check(ROBOTS / "ur5e/ur5e.urdf", engine=congruent.engines.mujoco(model))
    assert "FORCES COMPARED IN PART" in report.headline and "gravity is [1.0, 2.0, 3.0]" in str(report)
    assert "gravcomp 0.5" in str(report)
    for name, value in before.items():
        np.testing.assert_array_equal(getattr(model.opt, name), value)
    assert model.body_gravcomp[3] == 0.5


def test_the_state_is_as_before_after_an_exception(monkeypatch: pytest.MonkeyPatch) -> None:
    mujoco = pytest.importorskip(MUJOCO)
    model = mujoco_model(ROBOTS / "ur5e/ur5e.urdf")

    def broken(*_: Any) -> None:
        raise RuntimeError("broken engine")

    monkeypatch.setattr(mujoco, "mj_inverse", broken)
    model.opt.gravity[:] = [0, 0, -1]
    with pytest.raises(RuntimeError, match="broken engine"):
        congruent.check(ROBOTS / "ur5e/ur5e.urdf", engine=congruent.engines.mujoco(model))
    assert model.opt.disableflags == 0 and list(model.opt.gravity) == [0, 0, -1]


def test_an_engine_that_computes_something_else_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    mujoco = pytest.importorskip(MUJOCO)
    model = mujoco_model(ROBOTS / "ur5e/ur5e.urdf")
    real = mujoco.mj_kinematics

    def off(of: Any, data: Any) -> None:
        real(of, data)
        data.xpos[5] += [0, 0, 1e-6]

    monkeypatch.setattr(mujoco, "mj_kinematics", off)
    with pytest.raises(congruent.CongruentError, match=r'the pose of "upper_arm_link" that it computes is 1e-06 m'):
        congruent.check(ROBOTS / "ur5e/ur5e.urdf", engine=congruent.engines.mujoco(model))


BESIDE_ITS_ORIGIN = """
<mujoco><option gravity="0 0 -9.81"/>
<worldbody>
  <body name="table" pos="2 0 0"><freejoint/><geom size="0.1" mass="1"/></body>
  <body name="base" pos="1 2 3" euler="0 90 0">
    <body name="arm" pos="0 0 0.3" euler="10 20 30">
      <inertial pos="0.1 0 0.2" mass="2" fullinertia="0.03 0.02 0.02 0.001 0.002 0.003"/>
      <joint name="turn" axis="0 1 1" pos="0.1 0.2 0" ref="20" range="-90 90" damping="0.3" frictionloss="0.1" armature="0.05"/>
      <joint name="shift" type="slide" axis="1 0 0" ref="0.1" range="-0.5 0.5"/>
      <body name="hand" pos="0.2 0 0"><inertial pos="0 0 0.1" mass="1" diaginertia="0.01 0.01 0.01"/>
        <joint name="left" axis="0 0 1" range="-30 30"/>
        <body name="finger" pos="0 0.1 0"><inertial pos="0 0 0.1" mass="0.1" diaginertia="0.001 0.001 0.001"/>
        <joint name="right" axis="0 0 1" range="-60 60"/></body>
      </body>
    </body>
  </body>
</worldbody>
<actuator><motor joint="turn" gear="50" ctrlrange="-2 2"/><position joint="shift" kp="10" forcerange="-30 20"/></actuator>
<equality><joint joint1="right" joint2="left" polycoef="0.1 -1.5 0 0 0"/></equality>
</mujoco>
"""


def test_an_mjcf_with_axes_beside_origins_in_a_scene(tmp_path: Path) -> None:
    mujoco = pytest.importorskip(MUJOCO)
    file = tmp_path / "scene.xml"
    file.write_text(BESIDE_ITS_ORIGIN)
    model = mujoco.MjModel.from_xml_path(str(file))
    robot = congruent.Robot(file, base="base", tip="finger")
    report = congruent.check(robot, engine=congruent.engines.mujoco(model))
    assert report.ok, str(report)
    model.eq_data[0][1] = -1.4
    report = congruent.check(robot, engine=congruent.engines.mujoco(model))
    assert not report.ok and "-1.4" in report.headline, report.headline


def test_a_robot_that_stands_elsewhere_in_the_scene(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    mujoco = pytest.importorskip(MUJOCO)
    # MuJoCo writes its warnings into the current folder.
    monkeypatch.chdir(tmp_path)
    urdf = ROBOTS / "planar_2r/planar_2r.urdf"
    cart = "<body name='cart' pos='1 2 3' euler='0 90 0'><freejoint/><geom size='0.1'/></body>"
    scene = mujoco.MjSpec.from_string(f"<mujoco><worldbody>{cart}</worldbody></mujoco>")
    arm = mujoco.MjSpec.from_file(str(urdf))
    arm.compiler.fusestatic = False
    scene.body("cart").add_frame().attach_body(arm.worldbody.first_body(), "", "")
    model = scene.compile()
    report = congruent.check(urdf, engine=congruent.engines.mujoco(model))
    assert report.ok and report.grade == "identical", str(report)
    # In the world the robot lies on its side.
    report = congruent.check(urdf, engine=congruent.engines.mujoco(model, root="cart"))
    assert "loaded model" in str(report)


def test_what_cannot_be_asked(ur5e: congruent.Robot) -> None:
    pytest.importorskip(MUJOCO)
    with pytest.raises(congruent.CongruentError, match="str is no mujoco.MjModel") as refused:
        congruent.engines.mujoco("ur5e.urdf")
    assert refused.value.findings[0].code == "python::engine"
    with pytest.raises(congruent.CongruentError, match="is no adapter of an engine"):
        congruent.check(ur5e, engine=3)  # type: ignore[call-overload]
    model = mujoco_model(ROBOTS / "ur5e/ur5e.urdf")
    with pytest.raises(congruent.CongruentError, match='no body "nowhere"'):
        congruent.check(ur5e, engine=congruent.engines.mujoco(model, root="nowhere"))
    with pytest.raises(TypeError, match="takes one of against, engine and poses"):
        congruent.check(ur5e, "other.urdf", engine=congruent.engines.mujoco(model))  # type: ignore[call-overload]


def test_an_engine_that_is_not_installed_is_named() -> None:
    code = (
        "import sys; sys.modules['mujoco'] = None\nimport congruent\n"
        "try: congruent.engines.mujoco(1)\nexcept congruent.CongruentError as e: print(e)"
    )
    printed = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert "the Python package mujoco is not installed" in printed.stdout, printed
    assert "pip install mujoco" in printed.stdout


def test_engines_are_imported_only_if_used() -> None:
    code = "import sys, congruent\nprint([name for name in ('mujoco', 'pinocchio', 'pydrake', 'pybullet', 'newton') if name in sys.modules])"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout.strip() == "[]"
