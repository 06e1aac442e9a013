"""The one exception of the package, and what it is about."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Finding:
    """What is wrong with an input, or suspicious in it, and where."""

    severity: str
    """``error`` or ``warning``."""
    code: str
    """Stable name of the kind of finding, as ``urdf::axis``; ``congruent explain`` has more about each."""
    id: str | None
    """Stable number, as ``CGR-URDF-017``."""
    message: str
    """What is wrong, in one sentence."""
    file: str | None
    """The file, if it is about one."""
    line: int | None
    """Line in the file, from 1."""
    column: int | None
    """Column in the line, in characters from 1."""
    help: str | None
    """How to correct it."""

    def __str__(self) -> str:
        place = "" if self.file is None else f"{self.file}: " if self.line is None else f"{self.file}:{self.line}: "
        return f"{place}{self.message}" + ("" if self.help is None else f"; {self.help}")


class CongruentError(ValueError):
    """An input is refused, or the machine failed: its text is what the command would print in a line for each finding.

    ``findings`` has every error and warning with file and line; it is empty if the machine failed, as for a full disk.
    """

    findings: list[Finding]

    def __init__(self, message: str, findings: Sequence[Finding] = ()) -> None:
        # Both are arguments of the exception, so that it can be pickled.
        super().__init__(message, list(findings))
        self.findings = list(findings)

    def __str__(self) -> str:
        return str(self.args[0])
