"""Checks and runs: the answers are those of the command, word for word."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import congruent


def command(*arguments: object, cwd: Path) -> subprocess.CompletedProcess[str]:
    words = [sys.executable, "-m", "congruent", *map(str, arguments)]
    return subprocess.run(words, cwd=cwd, capture_output=True, text=True)


@pytest.mark.parametrize(
    ("robot", "grade", "exit_code"),
    [("robots/ur5e", "identical", 0), ("robots/ur5e/wrong_convention.toml", "different", 1)],
)
def test_a_check_is_that_of_the_command(
    root: Path, monkeypatch: pytest.MonkeyPatch, robot: str, grade: str, exit_code: int
) -> None:
    monkeypatch.chdir(root)
    report = congruent.check(robot)
    assert (report.grade, report.exit_code) == (grade, exit_code)
    assert report.ok is (exit_code == 0) and bool(report) is report.ok
    printed = command("check", robot, cwd=root)
    assert printed.returncode == exit_code
    assert str(report) == printed.stdout and repr(report) == printed.stdout.rstrip()
    assert report.json() == json.loads(command("check", robot, "--format", "json", cwd=root).stdout)
    assert report.headline == command("check", robot, "-q", cwd=root).stdout.rstrip()
    assert report.series == {} and report.folder is None


def test_the_cause_and_its_line(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    urdf = (root / "robots/ur5e/ur5e.urdf").read_text()
    lines = urdf.splitlines()
    line = next(at for at, text in enumerate(lines, 1) if '<mass value="2.846"/>' in text)
    Path("mine.urdf").write_text(urdf)
    Path("grams.urdf").write_text(urdf.replace('<mass value="2.846"/>', '<mass value="2846"/>'))
    report = congruent.check("mine.urdf", against="grams.urdf")
    assert not report.ok and "grams?" in report.headline and f"grams.urdf:{line}" in report.headline
    assert report.json()["verdict"] == "disagree"
    # The same of a robot that was read before.
    assert str(congruent.check(congruent.Robot("mine.urdf"), "grams.urdf")) == str(report)


def test_a_tolerance_with_its_unit(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(root)
    robot = "docs/examples/gen3"
    assert not congruent.check(robot)
    report = congruent.check(robot, tolerance="1mm,0.1deg")
    assert report.ok and str(report) == command("check", robot, "--tolerance", "1mm,0.1deg", cwd=root).stdout
    with pytest.raises(ValueError, match='"1" has no unit: 1mm or 1deg'):
        congruent.check(robot, tolerance="1")


def test_a_missing_second_description_with_strict(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(root)
    urdf = "robots/ur5e/ur5e.urdf"
    assert congruent.check(urdf).ok
    assert not congruent.check(urdf, strict=True).ok


def test_every_reference_of_a_robot_file_is_compared(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    urdf = (root / "robots/ur5e/ur5e.urdf").read_text()
    Path("arm.urdf").write_text(urdf)
    Path("same.urdf").write_text(urdf)
    Path("grams.urdf").write_text(urdf.replace('<mass value="2.846"/>', '<mass value="2846"/>'))
    references = "".join(f'[[reference]]\nfile = "{name}.urdf"\n' for name in ("same", "grams"))
    Path("robot.toml").write_text(f'name = "arm"\nurdf = "arm.urdf"\ntip = "tool0"\n{references}')
    report = congruent.check(".")
    printed = command("check", ".", cwd=tmp_path)
    assert report.exit_code == printed.returncode == 1
    assert [part["against"]["file"] for part in report.json()] == ["./same.urdf", "./grams.urdf"]
    assert report.headline.count("\n") == 1 and "grams?" in report.headline


def test_what_cannot_be_checked(root: Path) -> None:
    with pytest.raises(congruent.CongruentError, match="nothing.urdf"):
        congruent.check(root / "robots/ur5e", against="nothing.urdf")
    with pytest.raises(TypeError, match="unexpected keyword argument 'tolerence'; did you mean 'tolerance'"):
        congruent.check(root / "robots/ur5e", tolerence="1mm")  # type: ignore[call-arg]


def test_html_shows_the_text_and_obeys_nothing(tmp_path: Path) -> None:
    urdf = '<robot name="&lt;b&gt;"><link name="a"/><link name="&lt;script&gt;"/>'
    urdf += '<joint name="j" type="continuous"><parent link="a"/><child link="&lt;script&gt;"/></joint></robot>'
    report = congruent.check(congruent.Robot.from_text(urdf))
    page = report._repr_html_()
    assert page.startswith("<pre>") and "<script>" not in page and "&lt;script&gt;" in page


def test_a_run_with_its_series(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(root)
    report = congruent.run("scenarios/rrr_arm_wave.toml", out=tmp_path)
    assert report.ok and report.grade is None
    assert report.folder is not None and Path(report.folder).parent == tmp_path
    printed = command("run", "scenarios/rrr_arm_wave.toml", "--out", tmp_path / "again", cwd=root)
    assert printed.stdout.splitlines()[:-1] == str(report).splitlines()[:-1]
    document = report.json()
    assert document == json.loads((Path(report.folder) / "report.json").read_text())
    time_s = report.series["time_s"]
    steps = document["simulation"]["steps"]
    assert time_s.shape == (steps + 1,)
    np.testing.assert_allclose(np.diff(time_s), document["simulation"]["step_s"], atol=1e-12)
    assert time_s[-1] == pytest.approx(document["simulation"]["duration_s"])
    assert (Path(report.folder) / "recording.rrd").exists()


def test_a_run_of_uncertain_values_has_its_cases(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(root)
    # 29 cases without a failure show 90 %, with confidence 95 %.
    enough = {"uncertainty.cases": 29, "check.clearance.passing": 0.9, "check.tracking.passing": 0.9}
    report = congruent.run("scenarios/ur5e_uncertain.toml", set=enough, out=tmp_path)
    cases = report.json()["uncertainty"]
    assert report.ok and cases["ran"] == 29 and cases["verdict"] == "met"
    assert report.folder is not None
    table = (Path(report.folder) / "cases.csv").read_text().splitlines()
    assert len(table) == 30 and table[0].startswith("case,seed,verdict,payload.gripper.mass_kg")
    few = congruent.run("scenarios/ur5e_uncertain.toml", set={**enough, "uncertainty.cases": 28})
    assert not few.ok and "29 cases are needed" in str(few)


def test_values_of_a_scenario_are_replaced(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(root)
    report = congruent.run("scenarios/rrr_arm_wave.toml", set={"simulation.step_s": 0.002, "name": "coarse"}, seed=3)
    document = report.json()
    assert document["simulation"]["step_s"] == 0.002 and document["scenario"] == "coarse" and document["seed"] == 3
    assert report.folder is None
    # Texts stay texts, and numbers of numpy are numbers.
    start_rad = {f"joint_{at}": np.float32(0.25) for at in range(1, 5)}
    values = {"start.joints_rad": start_rad, "name": "17", "seed": np.int64(5), "limits.over_limit": "slow"}
    report = congruent.run("scenarios/rrr_arm_wave.toml", set=values)
    assert report.json()["scenario"] == "17" and report.json()["seed"] == 5
    assert [report.series[f"joint_{at}.q_rad"][0] for at in range(1, 5)] == [0.25] * 4
    with pytest.raises(TypeError, match="no value of type object"):
        congruent.run("scenarios/rrr_arm_wave.toml", set={"seed": object()})
    with pytest.raises(congruent.CongruentError, match="stifness"):
        congruent.run("scenarios/rrr_arm_wave.toml", set={"controller.stifness": 500})
    with pytest.raises(congruent.CongruentError):
        congruent.run("scenarios/no_such.toml")
