"""The plugin of pytest: what a user's test module collects, what a failure prints, and what ``--congruent-update`` writes."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from congruent.pytest import congruent_check
from congruent.pytest._sections import MappingPlace, sections, with_values
from conftest import ROBOTS

pytest_plugins = ["pytester"]

NOTHING_MOVES = """
<robot name="plate"><link name="a"/><link name="b"/>
<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint></robot>
"""
LINES_OF_ELBOW = """[mapping]
[mapping.joints]
joint_2 = { joint = "A2", sign = -1, offset_deg = 90.0 }
"""


@pytest.fixture(autouse=True)
def whole_summaries(monkeypatch: pytest.MonkeyPatch) -> None:
    """In CI pytest does not shorten the lines of its summary."""
    monkeypatch.setenv("CI", "1")


def module(pytester: pytest.Pytester, arguments: str, name: str = "test_robots.py") -> None:
    pytester.path.joinpath(name).write_text(
        f"from congruent.pytest import congruent_check\ntest_robots = congruent_check({arguments})\n"
    )


def run(pytester: pytest.Pytester, *options: str) -> pytest.RunResult:
    return pytester.runpytest("-p", "no:cacheprovider", *options)


def names(pytester: pytest.Pytester, *options: str) -> list[str]:
    lines = run(pytester, "--collect-only", "-q", *options).outlines
    return [line.partition("::")[2] for line in lines if "::" in line]


def write(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(text.encode())
    return path


def own_arm() -> str:
    return (ROBOTS / "planar_2r/planar_2r.urdf").read_text()


def vendor_arm() -> str:
    """The same arm, whose elbow has another name, another direction and another zero."""
    text = own_arm()
    begin = text.index('<joint name="joint_2"')
    end = text.index("</joint>", begin)
    elbow = text[begin:end].replace('"0.6 0 0"', '"0.6 0 0" rpy="0 0 1.5707963267948966"')
    elbow = elbow.replace('axis xyz="0 0 1"', 'axis xyz="0 0 -1"')
    range_here = 'lower="-2.6179938779914944" upper="2.6179938779914944"'
    elbow = elbow.replace(range_here, 'lower="-1.0471975511965976" upper="4.1887902047863905"')
    return (text[:begin] + elbow + text[end:]).replace('"joint_2"', '"A2"')


def two_arms(folder: Path, robot_file: str) -> Path:
    """A robot file beside own.urdf and vendor.urdf."""
    write(folder / "own.urdf", own_arm())
    write(folder / "vendor.urdf", vendor_arm())
    return write(folder / "robot.toml", robot_file)


def rounded_table(folder: Path, tolerance: str = "position_m = 1e-12 # fine\norientation_rad = 1e-12\n") -> Path:
    """A robot file whose table has lost digits, with a tolerance that is finer."""
    shutil.copy(ROBOTS / "ur5e/ur5e.urdf", write(folder / "ur5e.urdf", ""))
    table, _, _ = (ROBOTS / "ur5e/robot.toml").read_text().partition("[dynamics]")
    table = table.replace("d_m = 0.1625", "d_m = 0.163").replace("a_m = -0.3922", "a_m = -0.392")
    return write(folder / "robot.toml", f"{table}# As the vendor states it.\n[tolerance] # of the table\n{tolerance}\n# end\n")


# What is collected.


def test_the_plugin_is_registered_and_pytest_is_imported_by_it_alone() -> None:
    code = "import sys, congruent, congruent.pytest; sys.exit('pytest' in sys.modules or '_pytest' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0
    from importlib.metadata import entry_points

    assert [point.value for point in entry_points(group="pytest11", name="congruent")] == ["congruent.pytest.plugin"]


def test_a_pattern_takes_robots_alone(pytester: pytest.Pytester) -> None:
    robots = pytester.path / "robots"
    write(robots / "arm/robot.toml", 'urdf = "arm.urdf"\n')
    write(robots / "meshes/link.stl", "solid")
    write(robots / "left.toml", 'name = "left"\n  urdf = "arm.urdf"\n')
    write(robots / "pixi.toml", '[project]\nname = "arms"\n')
    write(robots / "scene.xml", '\ufeff<?xml version="1.0"?>\n<!-- a > b -->\n<mujoco model="arm"/>')
    write(robots / "package.xml", "<package/>")
    write(robots / "lone.URDF", "<robot/>")
    write(robots / "README.md", "# Arms")
    module(pytester, '"robots/*"')
    assert names(pytester) == [f"test_robots[robots/{name}]" for name in ("arm", "left.toml", "lone.URDF", "scene.xml")]
    assert names(pytester, "-k", "left or scene") == ["test_robots[robots/left.toml]", "test_robots[robots/scene.xml]"]


def test_a_robot_is_named_once(pytester: pytest.Pytester) -> None:
    write(pytester.path / "robots/arm/robot.toml", 'urdf = "arm.urdf"\n')
    module(pytester, '"robots/*", "robots/arm", "robots/*/robot.toml"')
    assert names(pytester) == ["test_robots[robots/arm]", "test_robots[robots/arm/robot.toml]"]


def test_robots_are_beside_the_test_or_in_the_root(pytester: pytest.Pytester) -> None:
    pytester.makeini("[pytest]")
    write(pytester.path / "robots/arm/robot.toml", 'urdf = "arm.urdf"\n')
    pytester.mkdir("sub")
    module(pytester, '"robots/*"', "sub/test_robots.py")
    assert names(pytester) == ["test_robots[robots/arm]"]
    write(pytester.path / "sub/robots/near/robot.toml", 'urdf = "arm.urdf"\n')
    assert names(pytester) == ["test_robots[robots/near]"]


def test_a_pattern_without_a_robot_is_an_error(pytester: pytest.Pytester) -> None:
    write(pytester.path / "robots/meshes/link.stl", "solid")
    module(pytester, '"robots/*"')
    result = run(pytester)
    assert result.ret == pytest.ExitCode.INTERRUPTED
    result.stdout.fnmatch_lines(
        ['congruent_check("robots/[*]"): no robot in', f"  {pytester.path}", "  */robots/meshes: a folder without robot.toml"]
    )
    result.stdout.no_fnmatch_line("*Traceback*")


def test_a_path_without_a_wildcard_is_always_checked(pytester: pytest.Pytester) -> None:
    write(pytester.path / "robots/meshes/link.stl", "solid")
    module(pytester, '"robots/meshes"')
    result = run(pytester)
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["robots/meshes: BAD INPUT: robots/meshes is a directory without a robot.toml*"])
    module(pytester, '"robots/nothing"')
    run(pytester).assert_outcomes(errors=1)


def test_nothing_is_checked_without_the_plugin(pytester: pytest.Pytester) -> None:
    write(pytester.path / "own.urdf", own_arm())
    module(pytester, '"own.urdf"')
    result = pytester.runpytest_subprocess("-p", "no:congruent")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*the plugin is not loaded*"])


def test_no_path_is_an_error_at_once() -> None:
    with pytest.raises(TypeError, match="needs a path or a pattern"):
        congruent_check()
    with pytest.raises(TypeError, match="tolerence"):
        congruent_check("robots/*", tolerence="1mm")  # type: ignore[call-arg]


# What is printed.


def test_robots_that_agree_and_one_that_does_not(pytester: pytest.Pytester) -> None:
    shutil.copytree(ROBOTS / "ur5e", pytester.path / "robots/ur5e")
    module(pytester, '"robots/*", "robots/ur5e/tool_5mm_off.toml"')
    result = run(pytester, "-v")
    result.assert_outcomes(passed=1, failed=1)
    diagnosis = "DIFFERENT, by up to 5 mm at tool0*Cause: the declared transform dhn_from_tip is off by 5 mm (tool_5mm_off.toml:12)"
    result.stdout.fnmatch_lines(
        [
            "*::test_robots[[]robots/ur5e[]] PASSED*",
            f"robots/ur5e/tool_5mm_off.toml: {diagnosis}",
            "  to write:",
            "    dhn_from_tip = { xyz_m = [[]0, 0, 0[]] }  # line 12",
            "to repeat: congruent check robots/ur5e/tool_5mm_off.toml",
            f"FAILED *::test_robots[[]robots/ur5e/tool_5mm_off.toml[]] - {diagnosis}",
        ]
    )
    result.stdout.no_fnmatch_line("*plugin.py*")


def test_nothing_to_compare_is_skipped_unless_strict(pytester: pytest.Pytester) -> None:
    write(pytester.path / "plate.urdf", NOTHING_MOVES)
    module(pytester, '"plate.urdf"')
    result = run(pytester, "-rs")
    result.assert_outcomes(skipped=1)
    result.stdout.fnmatch_lines(["SKIPPED *plate.urdf: NOTHING COMPARED: no joint moves between base and tip"])
    module(pytester, '"plate.urdf", strict=True')
    result = run(pytester)
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["plate.urdf: NOTHING COMPARED*", "to repeat: congruent check plate.urdf --strict"])


def test_bad_input_fails_with_its_line(pytester: pytest.Pytester) -> None:
    write(pytester.path / "bad.urdf", '<robot name="b">\n<link name="a">')
    write(pytester.path / "bad.toml", 'urdf = "bad.urdf"\nnames = "a"\n[[reference]\n')
    module(pytester, '"bad.*"')
    result = run(pytester)
    result.assert_outcomes(failed=2)
    result.stdout.fnmatch_lines(["bad.toml: BAD INPUT: bad.toml:3: *", "bad.urdf: BAD INPUT: bad.urdf:2: *<link> *is not closed*"])
    result.stdout.fnmatch_lines(["FAILED *[[]bad.urdf[]] - BAD INPUT: bad.urdf:2: *"])
    result.stdout.no_fnmatch_line("*Traceback*")


def test_options_are_passed_on(pytester: pytest.Pytester) -> None:
    shutil.copytree(ROBOTS / "ur5e", pytester.path / "ur5e")
    file = '"ur5e/tool_5mm_off.toml"'
    module(pytester, f'{file}, tolerance="6mm,1deg", base="base_link", tip="tool0", seed=3')
    run(pytester).assert_outcomes(passed=1)
    module(pytester, f'{file}, tolerance="4mm,1deg", base="base_link", tip="tool0", seed=3')
    result = run(pytester)
    repeat = "congruent check ur5e/tool_5mm_off.toml --tolerance 4mm,1deg --base base_link --tip tool0 --seed 3"
    result.stdout.fnmatch_lines([f"to repeat: {repeat}"])
    printed = subprocess.run([sys.executable, "-m", *repeat.split()], cwd=pytester.path, capture_output=True, text=True)
    assert printed.returncode == 1 and printed.stdout.rstrip() in result.stdout.str()
    module(pytester, f'{file}, tolerance="4"')
    result = run(pytester)
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(['*BAD INPUT: tolerance: "4" has no unit: 4mm or 4deg*'])


# What is compared with what.


def test_each_of_against_is_a_test(pytester: pytest.Pytester) -> None:
    write(pytester.path / "robots/own.urdf", own_arm())
    write(pytester.path / "robots/same.urdf", own_arm())
    write(pytester.path / "robots/heavy.urdf", own_arm().replace('<mass value="2"/>', '<mass value="2.4"/>'))
    module(pytester, '"robots/own.urdf", against=["robots/same.urdf", "robots/heavy.urdf"]')
    result = run(pytester)
    result.assert_outcomes(passed=1, failed=1)
    result.stdout.fnmatch_lines(["FAILED *[[]robots/own.urdf-against-robots/heavy.urdf[]] - *DIFFERENT DYNAMICS*mass 2 kg in*"])


def test_a_robot_is_compared_with_its_revision(pytester: pytest.Pytester) -> None:
    git = shutil.which("git")
    if git is None:
        pytest.skip("there is no git")
    arm = write(pytester.path / "robots/arm/own.urdf", own_arm())
    write(pytester.path / "robots/arm/robot.toml", 'urdf = "own.urdf"\n')
    identity = ["-c", "user.name=me", "-c", "user.email=me@example.org"]
    for words in (["init", "-q", "-b", "main"], ["add", "."], [*identity, "commit", "-qm", "arm"]):
        subprocess.run([git, *words], cwd=pytester.path, check=True)
    module(pytester, '"robots/*", against="git:main"')
    assert names(pytester) == ["test_robots[robots/arm-against-git:main]"]
    run(pytester).assert_outcomes(passed=1)
    write(arm, vendor_arm())
    before = (pytester.path / "robots/arm/robot.toml").read_bytes()
    run(pytester, "--congruent-update").assert_outcomes(failed=1)
    assert (pytester.path / "robots/arm/robot.toml").read_bytes() == before


def test_each_reference_is_a_test(pytester: pytest.Pytester) -> None:
    text = 'urdf = "own.urdf"\n[[reference]]\nfile = "vendor.urdf"\n[reference.mapping.joints]\n'
    text += 'joint_2 = { joint = "A2", sign = -1, offset_deg = 90 }\n[[reference]]\nfile = "./own.urdf"\n'
    text += '[[reference]]\nfile = "heavy.urdf"\n'
    two_arms(pytester.path / "robots/arm", text)
    write(pytester.path / "robots/arm/heavy.urdf", own_arm().replace('<mass value="2"/>', '<mass value="2.4"/>'))
    module(pytester, '"robots/*"')
    files = ["vendor.urdf", "./own.urdf", "heavy.urdf"]
    assert names(pytester) == [f"test_robots[robots/arm-against-{file}]" for file in files]
    result = run(pytester)
    result.assert_outcomes(passed=2, failed=1)
    result.stdout.fnmatch_lines(["to repeat: congruent check robots/arm --against robots/arm/heavy.urdf"])
    # A robot file in the current folder, whose path has no folder.
    shutil.copytree(pytester.path / "robots/arm", pytester.path, dirs_exist_ok=True)
    module(pytester, '"robot.toml"')
    run(pytester).assert_outcomes(passed=2, failed=1)


def test_processes_check_at_once(pytester: pytest.Pytester) -> None:
    pytest.importorskip("xdist")
    shutil.copytree(ROBOTS / "ur5e", pytester.path / "ur5e")
    module(pytester, '"ur5e", "ur5e/*.toml"')
    result = pytester.runpytest_subprocess("-n", "2", "-p", "no:cacheprovider")
    result.assert_outcomes(passed=2, failed=2)
    result.stdout.fnmatch_lines(["FAILED *tool_5mm_off.toml[]] - DIFFERENT*"])
    refused = pytester.runpytest_subprocess("-n", "2", "--congruent-update")
    assert refused.ret == pytest.ExitCode.USAGE_ERROR
    refused.stderr.fnmatch_lines(["*--congruent-update writes files, which several processes would do at once: add -n 0"])


# What --congruent-update writes.


@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_a_mapping_of_a_reference_is_written(pytester: pytest.Pytester, newline: str) -> None:
    before = '# mine\nurdf = "own.urdf" # [mapping]\n\n[[reference]]\nfile = "own.urdf"\n\n[[reference]] # vendor\nfile = "vendor.urdf"\n'
    after = "\n# fine\n[tolerance]\nposition_m = 1e-9\n\n# end"
    before, after = (text.replace("\n", newline) for text in (before, after))
    file = two_arms(pytester.path / "robots/arm", before + after)
    module(pytester, '"robots/*"')
    run(pytester).assert_outcomes(passed=1, failed=1)
    assert file.read_bytes() == (before + after).encode()
    result = run(pytester, "--congruent-update")
    result.assert_outcomes(passed=2)
    result.stdout.fnmatch_lines(["--- robots/arm/robot.toml", '+joint_2 = { joint = "A2", sign = -1, offset_deg = 90.0 }'])
    lines = LINES_OF_ELBOW.replace("[mapping", "[reference.mapping").replace("\n", newline)
    assert file.read_bytes().decode() == before + lines + after
    run(pytester).assert_outcomes(passed=2)


def test_a_mapping_is_written_at_the_end(pytester: pytest.Pytester) -> None:
    file = two_arms(pytester.path, 'urdf = "own.urdf" # no line end')
    module(pytester, '"robot.toml", against="vendor.urdf"')
    run(pytester, "--congruent-update").assert_outcomes(passed=1)
    assert file.read_text() == f'urdf = "own.urdf" # no line end\n\n{LINES_OF_ELBOW}'
    run(pytester).assert_outcomes(passed=1)


@pytest.mark.parametrize("elbow", ["'A3'", '{ joint = "A2", sign = 1 }'])
def test_a_mapping_that_is_out_of_date_is_replaced(pytester: pytest.Pytester, elbow: str) -> None:
    before, after = 'urdf = "own.urdf"\n\n# The controller counts otherwise.\n', '\n# end\n[tcp]\nxyz_m = [0, 0, 0]\n'
    file = two_arms(pytester.path, f"{before}[mapping.joints] # old\njoint_2 = {elbow}\n{after}")
    module(pytester, '"robot.toml", against="vendor.urdf"')
    run(pytester).assert_outcomes(failed=1)
    run(pytester, "--congruent-update").assert_outcomes(passed=1)
    assert file.read_text() == before + LINES_OF_ELBOW + after
    run(pytester).assert_outcomes(passed=1)


def test_a_mapping_of_another_comparison_is_not_replaced(pytester: pytest.Pytester) -> None:
    file = two_arms(pytester.path, f'urdf = "own.urdf"\n\n{LINES_OF_ELBOW}')
    write(pytester.path / "other.urdf", own_arm().replace('"joint_2"', '"B2"'))
    before = file.read_bytes()
    module(pytester, '"robot.toml", against=["vendor.urdf", "other.urdf"]')
    result = run(pytester, "--congruent-update")
    result.assert_outcomes(passed=1, failed=1)
    result.stdout.fnmatch_lines(["*not written: [[]mapping[]] of robot.toml is that of another comparison; name both files under*"])
    assert file.read_bytes() == before


def test_without_a_robot_file_the_lines_are_shown(pytester: pytest.Pytester) -> None:
    write(pytester.path / "own.urdf", own_arm())
    write(pytester.path / "vendor.urdf", vendor_arm())
    module(pytester, '"own.urdf", against="vendor.urdf"')
    result = run(pytester, "--congruent-update")
    result.assert_outcomes(failed=1)
    lines = ["*Make one by: congruent new robot own.urdf --out own", "  [[]mapping[]]", "  joint_2 = { joint = *"]
    result.stdout.fnmatch_lines(lines, consecutive=False)
    assert (pytester.path / "own.urdf").read_text() == own_arm()


def test_a_reference_in_one_line_is_shown(pytester: pytest.Pytester) -> None:
    file = two_arms(pytester.path, 'urdf = "own.urdf"\nreference = [{ file = "vendor.urdf" }]\n')
    before = file.read_bytes()
    module(pytester, '"robot.toml"')
    result = run(pytester, "--congruent-update")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*not written: robot.toml has this in a form that only you can change. To declare:", "  [[]mapping[]]"])
    assert file.read_bytes() == before


@pytest.mark.parametrize(
    ("tolerance", "wider"),
    [
        ("position_m = 1e-12 # fine\norientation_rad = 1e-12\n", "position_m = 0.0007 # fine\norientation_rad = 1e-12\n"),
        ("orientation_deg = 0.1\nposition_mm=0.1", "orientation_deg = 0.1\nposition_mm=0.7"),
    ],
)
def test_a_tolerance_for_rounding_is_written(pytester: pytest.Pytester, tolerance: str, wider: str) -> None:
    file = rounded_table(pytester.path / "robots/arm", tolerance)
    before = file.read_text()
    module(pytester, '"robots/*"')
    run(pytester).assert_outcomes(failed=1)
    result = run(pytester, "--congruent-update")
    result.assert_outcomes(passed=1)
    result.stdout.fnmatch_lines(["-position_*", "+position_*"])
    assert file.read_text() == before.replace(tolerance, wider)
    run(pytester).assert_outcomes(passed=1)


def test_a_mistake_is_not_updated(pytester: pytest.Pytester) -> None:
    file = rounded_table(pytester.path / "robots/arm")
    write(file, file.read_text().replace("d_m = 0.0997", "d_m = 0.0897"))
    before = {path: path.read_bytes() for path in file.parent.iterdir()}
    module(pytester, '"robots/*"')
    result = run(pytester, "--congruent-update")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["robots/arm/robot.toml: DIFFERENT, by up to *d_m = 0.0897*"])
    assert {path: path.read_bytes() for path in file.parent.iterdir()} == before


def test_a_mistake_under_a_mapping_is_not_updated(pytester: pytest.Pytester) -> None:
    file = two_arms(pytester.path, f'urdf = "own.urdf"\n\n{LINES_OF_ELBOW}')
    write(pytester.path / "own.urdf", own_arm().replace('"0.6 0 0"', '"0.65 0 0"'))
    before = {path: path.read_bytes() for path in pytester.path.glob("*.[tu]*")}
    module(pytester, '"robot.toml", against="vendor.urdf"')
    result = run(pytester, "--congruent-update")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["robot.toml: DIFFERENT*"])
    assert {path: path.read_bytes() for path in before} == before and len(before) == 3


def test_what_fails_after_an_update_is_put_back(pytester: pytest.Pytester) -> None:
    # With a wider tolerance the inertials, which are in frames of the table, are compared and differ.
    file = rounded_table(pytester.path / "robots/arm")
    inertials = (ROBOTS / "ur5e/robot.toml").read_text().partition("[dynamics]")[2].partition("[tcp]")[0]
    write(file, f"{file.read_text()}\n[dynamics]{inertials}")
    before = file.read_bytes()
    module(pytester, '"robots/*"')
    result = run(pytester, "--congruent-update")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(
        [
            "robots/arm/robot.toml: DIFFERENT by rounding alone*",
            "*not written: the check fails with this change, too, and robots/arm/robot.toml is as it was:",
            "+position_m = 0.0007 # fine",
            "robots/arm/robot.toml: SAME GEOMETRY, DIFFERENT DYNAMICS*",
        ]
    )
    assert file.read_bytes() == before


def test_a_file_that_cannot_be_written_is_no_traceback(pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(file: Path, text: str) -> None:
        raise PermissionError(13, "Permission denied", str(file))

    monkeypatch.setattr("congruent.pytest._update._write", refused)
    file = two_arms(pytester.path, 'urdf = "own.urdf"\n')
    module(pytester, '"robot.toml", against="vendor.urdf"')
    result = run(pytester, "--congruent-update")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["robot.toml: EQUAL AFTER MAPPING*", "--congruent-update: not written: *Permission denied*"])
    assert file.read_text() == 'urdf = "own.urdf"\n'


# Where sections begin and end.

HARD = '''# [no]
text = """
[no]
""" # "
list = [
  [1, 2], # ]
  ["]", '['],
]
 [ a . "b.c" ]   # [x]
x = { y = [1] }
[[reference]]
file = 'a'

# of b
[[reference]]
file = "b" # 'b
[other]
x = 1
[reference.mapping]
base = "fitted"
# end
'''


def test_sections_are_found() -> None:
    found = sections(HARD)
    paths = [("a", "b.c"), ("reference",), ("reference",), ("other",), ("reference", "mapping")]
    assert [section.path for section in found] == paths
    assert [section.is_array for section in found] == [False, True, True, False, False]
    assert HARD[found[1].start : found[1].end] == "[[reference]]\nfile = 'a'\n"
    assert HARD[found[4].start : found[4].end] == '[reference.mapping]\nbase = "fitted"\n'
    assert sections("") == [] and sections("a = 1") == []


def test_each_reference_has_its_mapping() -> None:
    assert MappingPlace(0).find(HARD) == [] and len(MappingPlace(1).find(HARD)) == 1 and MappingPlace().find(HARD) == []
    first = MappingPlace(0).written(HARD, ["[mapping]", 'left_out = ["a"]'])
    assert first == HARD.replace("file = 'a'\n", "file = 'a'\n[reference.mapping]\nleft_out = [\"a\"]\n")
    second = MappingPlace(1).written(HARD, ["[mapping]"])
    assert second == HARD.replace('base = "fitted"\n', "")
    assert MappingPlace(2).written(HARD, ["[mapping]"]) is None


def test_values_are_replaced_in_their_table_alone() -> None:
    text = "x = 1\n[a]\nx = 1\n[tolerance]\n\"x\"  =  1e-9# fine\n[b]\nx = 1\n"
    assert with_values(text, "tolerance", {"x": "2"}) == text.replace("1e-9", "2")
    assert with_values(text, "tolerance", {"y": "2"}) is None
