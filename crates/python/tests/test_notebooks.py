"""The notebooks of the guide run without an error, and print what is stored in them.

``python crates/python/tests/test_notebooks.py`` stores what they print. Figures and widgets are not stored.
"""

from __future__ import annotations

import importlib.util
import json
import re
import shutil
import tempfile
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[3]
NOTEBOOKS = ROOT / "docs/notebooks"
NAMES = ["disagreement", "course", "engine"]
# What a notebook imports beside numpy.
NEEDS = {"disagreement": ["matplotlib"], "course": ["matplotlib"], "engine": ["matplotlib", "mujoco"]}
# What its cells read: the kernel runs in a copy, so that results are not written to the project.
READ = ["robots", "scenarios", "docs/examples", "docs/notebooks"]
# A cell whose output depends on what is installed: it is run, and its output is not stored.
ANY_OUTPUT = "any-output"
# No cell takes more than some seconds; a build for debugging takes longer.
TIMEOUT_S = 300
LONGEST_LINE = 119
ABSOLUTE_PATH = re.compile(r"(?<![\w.<>/])/(?:home|tmp|usr|var|opt|root|work|mnt|srv|Users|private)/|\b[A-Z]:\\")


def read(name: str) -> Any:
    import nbformat

    return nbformat.read(NOTEBOOKS / f"{name}.ipynb", as_version=4)


def code_cells(notebook: Any) -> list[Any]:
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def executed(name: str, folder: Path) -> Any:
    """The notebook after a run in a copy of the project. An error in a cell is raised."""
    import nbclient

    for part in READ:
        shutil.copytree(ROOT / part, folder / part)
    notebook = read(name)
    client = nbclient.NotebookClient(
        notebook, timeout=TIMEOUT_S, kernel_name="python3", resources={"metadata": {"path": str(folder)}}
    )
    client.execute()
    return notebook


def printed(cell: Any) -> str:
    """What a cell prints and what its last line gives, as text. The version of MuJoCo may be another."""
    parts = []
    for output in cell.outputs:
        if output.output_type == "stream" and output.name == "stdout":
            parts.append(output.text)
        elif output.output_type == "execute_result":
            parts.append(output.data["text/plain"])
    return re.sub(r"MuJoCo \d+(\.\d+)+", "MuJoCo", "".join(parts))


def store(name: str) -> None:
    """Runs a notebook and stores the text that it prints, without figures, numbers of executions and times."""
    import nbformat

    with tempfile.TemporaryDirectory() as folder:
        notebook = executed(name, Path(folder))
    for cell in code_cells(notebook):
        cell.execution_count = None
        cell.metadata.pop("execution", None)
        kept: list[Any] = []
        for output in [] if ANY_OUTPUT in cell.metadata.get("tags", []) else cell.outputs:
            if output.output_type == "stream" and output.name == "stdout":
                # One print may arrive in several messages: how many depends on the time that the cell takes.
                if kept and kept[-1].output_type == "stream":
                    kept[-1].text += output.text
                else:
                    kept.append(output)
            elif output.output_type == "execute_result":
                output.execution_count = None
                output.data = {"text/plain": output.data["text/plain"]}
                kept.append(output)
        cell.outputs = kept
    notebook.metadata = {
        "kernelspec": {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"},
        "language_info": {"name": "python"},
    }
    (NOTEBOOKS / f"{name}.ipynb").write_text(nbformat.writes(notebook, indent=1) + "\n")


def test_every_notebook_is_run() -> None:
    assert sorted(path.stem for path in NOTEBOOKS.glob("*.ipynb")) == sorted(NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_it_runs_and_prints_what_is_stored(name: str, tmp_path: Path) -> None:
    for module in ["nbclient", "ipykernel", *NEEDS[name]]:
        if importlib.util.find_spec(module) is None:
            pytest.skip(f"{module} is not installed")
    stored = read(name)
    for before, after in zip(code_cells(stored), code_cells(executed(name, tmp_path)), strict=True):
        if ANY_OUTPUT not in before.metadata.get("tags", []):
            assert printed(after) == printed(before), before.source


@pytest.mark.parametrize("name", NAMES)
def test_what_is_stored_has_no_traces_of_a_run(name: str) -> None:
    text = (NOTEBOOKS / f"{name}.ipynb").read_text()
    found = ABSOLUTE_PATH.search(text)
    assert found is None, text[max(0, found.start() - 60) : found.end() + 60]
    for cell in json.loads(text)["cells"]:
        source = "".join(cell["source"])
        assert max(map(len, source.splitlines())) <= LONGEST_LINE, source
        if cell["cell_type"] == "code":
            assert cell["execution_count"] is None and "execution" not in cell["metadata"]
            for output in cell["outputs"]:
                assert output["output_type"] == "stream" or list(output["data"]) == ["text/plain"], source


def test_absolute_paths_are_found() -> None:
    for path in ["/tmp/x", '"/home/me/a.toml"', "in /Users/me", "C:\\temp"]:
        assert ABSOLUTE_PATH.search(path), path
    for other in ["out/engine/ur5e.urdf", "docs/home/page", "N m s/rad", "</usr/>"]:
        assert not ABSOLUTE_PATH.search(other), other


if __name__ == "__main__":
    for notebook_name in NAMES:
        store(notebook_name)
