"""PyBullet, Newton and Drake: no alarm where they load what the file says, and what each of them changes is named."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import ROBOTS

import congruent

UR5E = ROBOTS / "ur5e/ur5e.urdf"
PLANAR = ROBOTS / "planar_2r/planar_2r.urdf"
OWN = sorted(ROBOTS.glob("*/*.urdf"))


def without_shapes(urdf: Path) -> str:
    root = ElementTree.parse(urdf).getroot()
    for link in root.iter("link"):
        for shape in [*link.findall("visual"), *link.findall("collision")]:
            link.remove(shape)
    return ElementTree.tostring(root, encoding="unicode")


def newton_model(urdf: Path) -> Any:
    newton = pytest.importorskip("newton")
    pytest.importorskip("warp").config.quiet = True
    builder = newton.ModelBuilder()
    builder.add_urdf(without_shapes(urdf), floating=False)
    return builder.finalize(device="cpu")


def drake_plant(urdf: Path) -> Any:
    """A plant that is not finalized."""
    pytest.importorskip("pydrake")
    from pydrake.multibody.parsing import Parser
    from pydrake.multibody.plant import MultibodyPlant

    plant = MultibodyPlant(0.0)
    Parser(plant).AddModelsFromString(without_shapes(urdf), "urdf")
    root = congruent.Robot(urdf).links[0]
    if root != "world":
        plant.WeldFrames(plant.world_frame(), plant.GetFrameByName(root))
    return plant


@pytest.fixture
def bullet(tmp_path: Path) -> Iterator[Any]:
    """A function that loads a file into a client of its own."""
    pybullet = pytest.importorskip("pybullet")
    client = pybullet.connect(pybullet.DIRECT)
    pybullet.setGravity(0, 0, -9.81, physicsClientId=client)

    def load(urdf: Path, text: str | None = None) -> Any:
        # PyBullet keeps what it has read of a path.
        file = tmp_path / f"{len(list(tmp_path.iterdir()))}.urdf"
        file.write_text(text or without_shapes(urdf))
        flags = pybullet.URDF_USE_INERTIA_FROM_FILE
        body = pybullet.loadURDF(str(file), useFixedBase=True, flags=flags, physicsClientId=client)
        return congruent.engines.pybullet(body, client=client)

    yield load
    pybullet.disconnect(client)


@pytest.mark.parametrize("urdf", OWN, ids=lambda urdf: urdf.parent.name)
def test_no_alarm_in_newton(urdf: Path) -> None:
    report = congruent.check(urdf, engine=congruent.engines.newton(newton_model(urdf)))
    assert report.ok and report.grade == "same_within_digits", str(report)
    assert "SAME ROBOT within the digits written" in report.headline and "32-bit numbers" in str(report)


def test_faults_in_newton() -> None:
    for array, words in [
        ("joint_armature", "elbow_joint: armature 0 kg m^2"),
        ("joint_damping", "elbow_joint: damping 0"),
        ("joint_friction", "elbow_joint: friction 0"),
    ]:
        model = newton_model(UR5E)
        values = getattr(model, array).numpy()
        values[2] = 0.1
        getattr(model, array).assign(values)
        report = congruent.check(UR5E, engine=congruent.engines.newton(model))
        assert not report.ok and words in report.headline and "ur5e.urdf:" in report.headline, report.headline
    model = newton_model(UR5E)
    places = model.joint_X_p.numpy()
    number = next(at for at, label in enumerate(model.joint_label) if label.endswith("shoulder_lift_joint"))
    places[number][3:] = [0, 0, 0, 1]
    model.joint_X_p.assign(places)
    report = congruent.check(UR5E, engine=congruent.engines.newton(model))
    assert not report.ok and 'joint "shoulder_lift_joint": origin rpy=' in report.headline, report.headline


def test_a_millimetre_is_not_taken_for_a_digit_of_newton() -> None:
    model = newton_model(UR5E)
    places = model.joint_X_p.numpy()
    number = next(at for at, label in enumerate(model.joint_label) if label.endswith("wrist_1_joint"))
    places[number][0] += 0.001
    model.joint_X_p.assign(places)
    report = congruent.check(UR5E, engine=congruent.engines.newton(model))
    assert not report.ok and 'joint "wrist_1_joint": origin xyz=' in report.headline and "off by 1 mm" in report.headline


def test_gravity_of_newton_is_as_before() -> None:
    model = newton_model(PLANAR)
    model.gravity.assign(np.float32([[0, 0, -1]]))
    report = congruent.check(PLANAR, engine=congruent.engines.newton(model))
    assert report.ok and "FORCES COMPARED IN PART" in report.headline
    np.testing.assert_array_equal(model.gravity.numpy(), np.float32([[0, 0, -1]]))


@pytest.mark.parametrize("urdf", OWN, ids=lambda urdf: urdf.parent.name)
def test_no_alarm_in_drake(urdf: Path) -> None:
    plant = drake_plant(urdf)
    plant.Finalize()
    report = congruent.check(urdf, engine=congruent.engines.drake(plant))
    assert report.ok and report.grade == "identical", str(report)


def test_faults_in_drake() -> None:
    plant = drake_plant(UR5E)
    plant.GetJointByName("elbow_joint").set_default_damping(0.5)
    plant.Finalize()
    report = congruent.check(UR5E, engine=congruent.engines.drake(plant))
    assert not report.ok and "elbow_joint: damping 0 N m s/rad in" in report.headline, report.headline
    assert "0.5 N m s/rad in Drake" in report.headline
    with pytest.raises(congruent.CongruentError, match="is no finalized MultibodyPlant"):
        congruent.engines.drake(drake_plant(UR5E))


def test_pybullet_gives_an_empty_link_a_kilogram(bullet: Any) -> None:
    report = congruent.check(PLANAR, engine=bullet(PLANAR))
    assert not report.ok and "tip: the link has no inertia" in report.headline, report.headline
    assert "1 kg in PyBullet" in report.headline


def test_no_alarm_in_pybullet_and_a_fault(bullet: Any, tmp_path: Path) -> None:
    pybullet = pytest.importorskip("pybullet")
    text = PLANAR.read_text()
    light = (
        '<link name="tip"><inertial><mass value="0"/><inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial></link>'
    )
    assert '<link name="tip"/>' in text
    file = tmp_path / "planar.urdf"
    file.write_text(text.replace('<link name="tip"/>', light))
    engine = bullet(file)
    report = congruent.check(file, engine=engine)
    assert report.ok and report.grade == "same_within_digits", str(report)
    body, client = engine._body, engine._client
    pybullet.resetJointState(body, 0, 0.7, 0.1, **client)
    pybullet.changeDynamics(body, 0, mass=3.0, **client)
    report = congruent.check(file, engine=engine)
    assert not report.ok and "link_1" in report.headline and "3 kg in PyBullet" in report.headline, report.headline
    assert pybullet.getJointState(body, 0, **client)[0] == pytest.approx(0.7, abs=1e-6)


def test_a_body_that_pybullet_does_not_have() -> None:
    pytest.importorskip("pybullet")
    with pytest.raises(congruent.CongruentError, match="client 7 has no body 3"):
        congruent.engines.pybullet(3, client=7)
