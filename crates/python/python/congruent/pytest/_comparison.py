"""One comparison of a robot, and its answer."""

from __future__ import annotations

import os
import shlex
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Any

import congruent

from ._request import CheckOptions

NOTHING_COMPARED = 4
"""The exit code of ``congruent check`` if there was nothing to compare."""
DECLARED_MAPPING = "check::declared_mapping"
"""The code of a mapping that does not fit the other description."""


class Outcome(Enum):
    """What a test says."""

    PASSED = "passed"
    FAILED = "failed"
    SKIPPED = "skipped"


@dataclass(frozen=True)
class Answer:
    """The answer of a comparison. The first line of its text is the headline."""

    outcome: Outcome
    text: str
    document: dict[str, Any] | None = None
    """The report as JSON; ``None`` for bad input, or if the robot file has several comparisons in one."""
    codes: tuple[str, ...] = ()
    """The codes of what is wrong with an input."""


@dataclass(frozen=True)
class Comparison:
    """A robot with the description that it is compared with."""

    robot: Path
    against: str | None
    """An absolute path, ``git:REV``, or the file of a ``[[reference]]`` as it is written; without one the robot is checked by itself."""
    reference: int | None
    """The place under ``[[reference]]`` of the robot file, from 0."""
    options: CheckOptions

    @property
    def is_with_revision(self) -> bool:
        """Whether the robot is compared with a former state."""
        return self.against is not None and self.against.startswith("git:")

    @property
    def shown_robot(self) -> str:
        """The path of the robot as it is printed."""
        return shown(self.robot)

    @property
    def shown_against(self) -> str | None:
        """The other description as it is printed."""
        if self.against is None or self.is_with_revision:
            return self.against
        if self.reference is None:
            return shown(Path(self.against))
        # As the check writes it: it finds the mapping of a reference by its path.
        folder = self.shown_robot if self.robot.is_dir() else os.path.dirname(self.shown_robot) or "."
        return os.path.join(folder, self.against)

    @property
    def command(self) -> str:
        """The command that gives the same answer."""
        words = ["congruent", "check", self.shown_robot]
        if self.shown_against is not None:
            words += ["--against", self.shown_against]
        for name, value in self.options.items():
            words += [f"--{name}"] if value is True else [f"--{name}", str(value)]
        return shlex.join(words)

    def answer(self) -> Answer:
        """Compares."""
        try:
            report = congruent.check(self.shown_robot, self.shown_against, **self.options)
        except congruent.CongruentError as error:
            codes = tuple(finding.code for finding in error.findings)
            return Answer(Outcome.FAILED, f"{self.shown_robot}: BAD INPUT: {_findings(error)}", codes=codes)
        except ValueError as error:
            # An option of the test, such as a tolerance without its unit.
            return Answer(Outcome.FAILED, f"{self.shown_robot}: BAD INPUT: {error}")
        if report.ok:
            outcome = Outcome.PASSED
        elif report.exit_code == NOTHING_COMPARED and not self.options.get("strict"):
            outcome = Outcome.SKIPPED
        else:
            outcome = Outcome.FAILED
        document = report.json()
        return Answer(outcome, str(report).rstrip(), document if isinstance(document, dict) else None)


def _findings(error: congruent.CongruentError) -> str:
    """What is wrong with an input, the errors first, in a line each."""
    errors = [str(finding) for finding in error.findings if finding.severity == "error"]
    warnings = [f"warning: {finding}" for finding in error.findings if finding.severity != "error"]
    return "\n".join(errors + warnings) or str(error)


def shown(path: Path) -> str:
    """A path from the current folder, if it is below."""
    folder = os.getcwd()
    text = str(path)
    return text[len(folder) + 1 :] if text.startswith(folder + os.sep) else text
