"""The stubs: right for the compiled part, and for code that uses it."""

import ast
import inspect
import subprocess
import sys
from pathlib import Path

import pytest

import congruent
import congruent._native as native

STUB = Path(congruent.__file__).with_name("_native.pyi")

RIGHT = """
import numpy as np
import congruent
from congruent.pytest import congruent_check

robot = congruent.Robot("robots/ur5e", tip="tool0")
poses = robot.fk(np.zeros((3, 6)))
first: float = float(poses[0, 0, 3])
by_name = robot.fk({"elbow_joint": 0.1})
found = robot.ik(poses, start=[0.0] * 6, tolerance_m=1e-6)
reached: bool = bool(found.converged.all())
report = congruent.check(robot, against="other.urdf", tolerance="1mm")
grade: str | None = report.grade
try:
    congruent.run("scenario.toml", set={"seed": 3})
except congruent.CongruentError as error:
    lines: list[int | None] = [finding.line for finding in error.findings]
test_robots = congruent_check("robots/*", against=["git:main"], tolerance="1mm", strict=True)
"""

WRONG = [
    'congruent.Robot(3)',
    'congruent.Robot("a").fk([0.0], link=3)',
    'congruent.Robot("a").jacobian([0.0], kind="spatial")',
    'congruent.check("a", tolerance=0.001)',
    'congruent.run("a", stiffness=500)',
    'import congruent.pytest; congruent.pytest.congruent_check("robots/*", tolerance=0.001)',
    'grade: int = congruent.check("a").grade',
]


def mypy(code: str, folder: Path) -> subprocess.CompletedProcess[str]:
    pytest.importorskip("mypy")
    file = folder / "used.py"
    file.write_text(code)
    words = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(folder / "cache"), str(file)]
    return subprocess.run(words, capture_output=True, text=True, cwd=folder)


def test_code_with_right_types(tmp_path: Path) -> None:
    checked = mypy(RIGHT, tmp_path)
    assert checked.returncode == 0, checked.stdout


def test_code_with_wrong_types(tmp_path: Path) -> None:
    checked = mypy("import congruent\n" + "\n".join(WRONG), tmp_path)
    for line in range(2, len(WRONG) + 2):
        assert f"used.py:{line}: error" in checked.stdout, f"{WRONG[line - 2]}\n{checked.stdout}"


# Modules on cyclonedds, which may not be installed, and which adds attributes to its classes.
ALLOWED = r"""
congruent\.ros2\._dds
congruent\.ros2\._idl.*
"""


def test_the_stub_has_what_is_compiled(tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    allowed = tmp_path / "allowed"
    allowed.write_text(ALLOWED)
    words = [sys.executable, "-m", "mypy.stubtest", "congruent", "--ignore-disjoint-bases"]
    words += ["--allowlist", str(allowed), "--ignore-unused-allowlist"]
    checked = subprocess.run(words, capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout


def test_help_says_what_editors_show() -> None:
    checked = 0
    for node in ast.parse(STUB.read_text()).body:
        if isinstance(node, ast.ClassDef):
            owner = getattr(native, node.name)
            members = [(getattr(owner, m.name), m) for m in node.body if isinstance(m, ast.FunctionDef)]
            members.append((owner, node))  # type: ignore[arg-type]
        elif isinstance(node, ast.FunctionDef):
            members = [(getattr(native, node.name), node)]
        else:
            continue
        for member, written in members:
            if text := ast.get_docstring(written):
                assert inspect.getdoc(member) == text, written.name
                checked += 1
    assert checked > 30
