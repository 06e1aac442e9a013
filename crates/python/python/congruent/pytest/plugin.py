"""The plugin that pytest loads: it puts a test for each comparison in the place of ``congruent_check``."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from types import FunctionType

import pytest

from ._comparison import Comparison, Outcome
from ._request import REQUEST, CheckRequest
from ._robots import NoRobot, find, references
from ._update import Updater

_UPDATER = pytest.StashKey[Updater]()


def pytest_addoption(parser: pytest.Parser) -> None:
    """The option of the plugin."""
    text = "write the mappings and the tolerances that congruent prints into robot files, after showing them; never tables, URDFs or MJCFs"
    parser.getgroup("congruent").addoption("--congruent-update", action="store_true", help=text)


def pytest_configure(config: pytest.Config) -> None:
    """Prepares the update of robot files, one after another."""
    if not config.getoption("--congruent-update"):
        return
    if hasattr(config, "workerinput") or config.getoption("numprocesses", None):
        raise pytest.UsageError("--congruent-update writes files, which several processes would do at once: add -n 0")
    config.stash[_UPDATER] = Updater(lambda change: _show(config, change))


def pytest_pycollect_makeitem(
    collector: pytest.Module | pytest.Class, name: str, obj: object
) -> list[ComparisonTest] | None:
    """The tests of a ``congruent_check``. They are made from the names of files; nothing is checked."""
    request = getattr(obj, REQUEST, None) if isinstance(obj, FunctionType) else None
    if not isinstance(request, CheckRequest):
        return None
    try:
        named = list(_comparisons(request, [collector.path.parent, collector.config.rootpath]))
    except NoRobot as error:
        raise pytest.Collector.CollectError(str(error)) from None
    counts: Counter[str] = Counter()
    tests = []
    for identifier, comparison in named:
        counts[identifier] += 1
        number = f"-{counts[identifier]}" if counts[identifier] > 1 else ""
        test = ComparisonTest.from_parent(collector, name=f"{name}[{identifier}{number}]", comparison=comparison)
        tests.append(test)
    return tests


def _comparisons(request: CheckRequest, folders: list[Path]) -> Iterator[tuple[str, Comparison]]:
    """Each comparison with its name."""
    seen: set[Path] = set()
    for pattern in request.patterns:
        found = find(pattern, folders)
        for robot in found.robots:
            if robot in seen:
                continue
            seen.add(robot)
            name = _name(robot, found.folder)
            if request.against:
                for other in request.against:
                    path = other if other.startswith("git:") else str(found.folder / other)
                    yield f"{name}-against-{other}", Comparison(robot, path, None, request.options)
            elif named := references(robot):
                for place, file in enumerate(named):
                    yield f"{name}-against-{file}", Comparison(robot, file, place, request.options)
            else:
                yield name, Comparison(robot, None, None, request.options)


def _name(robot: Path, folder: Path) -> str:
    path = robot.relative_to(folder) if robot.is_relative_to(folder) else robot
    return path.as_posix()


class ComparisonTest(pytest.Item):
    """The test of one comparison."""

    def __init__(self, *, comparison: Comparison, **arguments: object) -> None:
        super().__init__(**arguments)  # type: ignore[arg-type]
        self.comparison = comparison

    def runtest(self) -> None:
        """Compares, and updates the robot file if that is requested."""
        answer = self.comparison.answer()
        updater = self.config.stash.get(_UPDATER, None)
        if updater is not None and answer.outcome is Outcome.FAILED:
            answer = updater.updated(self.comparison, answer)
        if answer.outcome is Outcome.SKIPPED:
            pytest.skip(answer.text.partition("\n")[0])
        if answer.outcome is Outcome.FAILED:
            pytest.fail(f"{answer.text}\n\nto repeat: {self.comparison.command}", pytrace=False)
        if updater is not None:
            updater.passed(self.comparison)

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException]) -> object:  # type: ignore[override]
        """The answer, without a traceback. The summary of pytest has its headline, without the path that the test is named by."""
        shown = super().repr_failure(excinfo)
        crash = getattr(shown, "reprcrash", None)
        if crash is not None and isinstance(excinfo.value, pytest.fail.Exception):
            crash.message = str(excinfo.value).partition("\n")[0].partition(": ")[2]
        return shown

    def reportinfo(self) -> tuple[os.PathLike[str] | str, int | None, str]:
        """The test module, and the name above a failure."""
        return self.path, None, self.name


def _show(config: pytest.Config, change: str) -> None:
    """Prints at once, and not only if the test fails."""
    reporter = config.pluginmanager.get_plugin("terminalreporter")
    capture = config.pluginmanager.get_plugin("capturemanager")
    if reporter is None:
        return
    if capture is not None:
        with capture.global_and_fixture_disabled():
            _write(reporter, change)
    else:
        _write(reporter, change)


def _write(reporter: pytest.TerminalReporter, change: str) -> None:
    reporter.ensure_newline()
    for line in change.splitlines():
        reporter.write_line(line)
