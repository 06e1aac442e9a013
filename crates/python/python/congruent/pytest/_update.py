"""``--congruent-update``: what is declared in a robot file is brought up to date. Tables, URDFs and MJCFs are never written."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from decimal import ROUND_CEILING, Context, Decimal
from math import degrees
from pathlib import Path
from typing import Any

from ._comparison import DECLARED_MAPPING, Answer, Comparison, Outcome, shown
from ._robots import parsed, robot_file
from ._sections import MappingPlace, with_values

# A part of a pose with the keys of [tolerance] that state it, each with its conversion from m or rad.
_TOLERANCES: dict[str, dict[str, Callable[[float], float]]] = {
    "position_m": {"position_m": float, "position_mm": lambda length_m: length_m * 1e3},
    "orientation_rad": {"orientation_rad": float, "orientation_deg": degrees},
}
# Digits of a tolerance, rounded up.
_DIGITS = Context(prec=2, rounding=ROUND_CEILING)


@dataclass
class Updater:
    """Writes into robot files what the answers of comparisons print to be declared."""

    show: Callable[[str], None]
    """Shows a change before it is written."""
    in_use: set[tuple[Path, MappingPlace]] = field(default_factory=set)
    """The mappings with which a comparison has passed: they are not written for another one."""

    def passed(self, comparison: Comparison) -> None:
        """Keeps the mapping of a comparison that has passed."""
        file = robot_file(comparison.robot)
        if file is not None and comparison.against is not None and not comparison.is_with_revision:
            self.in_use.add((file, _place_in_use(comparison, _read(file))))

    def updated(self, comparison: Comparison, answer: Answer) -> Answer:
        """The answer after an update, or the one before with the reason why nothing is written."""
        try:
            return self._updated(comparison, answer)
        except OSError as error:
            return _with_note(answer, f"not written: {error}")

    def _updated(self, comparison: Comparison, answer: Answer) -> Answer:
        file = robot_file(comparison.robot)
        lines = _lines_to_declare(answer)
        if file is None:
            return answer if lines is None else _with_note(answer, _no_robot_file(comparison, lines))
        text = _read(file)
        if values := _wider_tolerance(answer, comparison, text):
            return self._write_and_check(comparison, answer, file, text, with_values(text, "tolerance", values), _as_lines(values))
        if lines is None and _declares_mapping(comparison, answer, text):
            lines = _lines_without_mapping(comparison, file, text)
        return answer if lines is None else self._declare_mapping(comparison, answer, file, text, lines)

    def _declare_mapping(self, comparison: Comparison, answer: Answer, file: Path, text: str, lines: list[str]) -> Answer:
        if comparison.is_with_revision:
            return _with_note(answer, "not written: a difference from a revision is a change, and no mapping")
        place = MappingPlace(comparison.reference)
        if (file, place) in self.in_use:
            note = f"not written: {place.name} of {shown(file)} is that of another comparison; name both files under [[reference]]"
            return _with_note(answer, f"{note}, each with a mapping of its own")
        return self._write_and_check(comparison, answer, file, text, place.written(text, lines), lines)

    def _write_and_check(
        self, comparison: Comparison, answer: Answer, file: Path, text: str, changed: str | None, lines: list[str]
    ) -> Answer:
        """Shows the change, writes it and checks again."""
        if changed is None or not _is_change_of_declarations(text, changed):
            note = f"not written: {shown(file)} has this in a form that only you can change. To declare:"
            return _with_note(answer, "\n".join([note, *_indented(lines)]))
        difference = _difference(file, text, changed)
        self.show(difference)
        with _tried(file, changed) as trial:
            again = comparison.answer()
            trial.is_kept = again.outcome is Outcome.PASSED
        if again.outcome is Outcome.PASSED:
            return again
        note = f"not written: the check fails with this change, too, and {shown(file)} is as it was:"
        return _with_note(answer, "\n".join([note, difference, "with it:", again.text]))


def _read(file: Path) -> str:
    return file.read_bytes().decode("utf-8", "surrogateescape")


def _write(file: Path, text: str) -> None:
    file.write_bytes(text.encode("utf-8", "surrogateescape"))


@dataclass
class _Trial:
    is_kept: bool = False


@contextmanager
def _tried(file: Path, text: str) -> Iterator[_Trial]:
    """A robot file with another text, which is put back unless it is kept, whatever happens."""
    before = _read(file)
    trial = _Trial()
    try:
        _write(file, text)
        yield trial
    finally:
        if not trial.is_kept and _read(file) != before:
            _write(file, before)


def _lines_to_declare(answer: Answer) -> list[str] | None:
    """The lines of a mapping that was found, if it is the only difference."""
    document = answer.document or {}
    if document.get("grade") != "equal_after_mapping":
        return None
    mapping = (document.get("against") or {}).get("mapping") or {}
    return None if mapping.get("is_declared", True) else mapping.get("lines")


def _place_in_use(comparison: Comparison, text: str) -> MappingPlace:
    """A reference without a mapping of its own has that of the robot file."""
    own = MappingPlace(comparison.reference)
    return own if own.find(text) else MappingPlace()


def _declares_mapping(comparison: Comparison, answer: Answer, text: str) -> bool:
    """Whether a comparison has failed under a mapping that is declared, and may be out of date."""
    if comparison.against is None or comparison.is_with_revision or not _place_in_use(comparison, text).find(text):
        return False
    return answer.document is not None or DECLARED_MAPPING in answer.codes


def _lines_without_mapping(comparison: Comparison, file: Path, text: str) -> list[str] | None:
    """The lines that the check prints if nothing is declared; the robot file is put back."""
    without = MappingPlace().removed(MappingPlace(comparison.reference).removed(text))
    with _tried(file, without):
        return _lines_to_declare(comparison.answer())


def _wider_tolerance(answer: Answer, comparison: Comparison, text: str) -> dict[str, str]:
    """The values of ``[tolerance]`` with which a difference by rounding alone passes; none if the difference is another one, or if the
    tolerance is that of the test."""
    document = answer.document or {}
    if document.get("grade") != "same_within_digits" or "tolerance" in comparison.options:
        return {}
    table = (parsed(text) or {}).get("tolerance")
    written: dict[str, Any] = table if isinstance(table, dict) else {}
    values: dict[str, str] = {}
    for part, keys in _TOLERANCES.items():
        key = next((key for key in keys if key in written), None)
        if key is not None and document["worst"][part] > document["tolerance"][part]:
            values[key] = repr(float(_DIGITS.create_decimal(Decimal(keys[key](document["worst"][part])))))
    return values


def _is_change_of_declarations(before: str, after: str) -> bool:
    """Whether two texts differ in mappings and in the tolerance alone. Without a reader of TOML nothing is written."""
    old, new = parsed(before), parsed(after)
    return old is not None and new is not None and _without_declarations(old) == _without_declarations(new)


def _without_declarations(document: dict[str, Any]) -> dict[str, Any]:
    rest = {key: value for key, value in document.items() if key not in ("mapping", "tolerance", "reference")}
    references = document.get("reference", [])
    rest["reference"] = [{key: value for key, value in one.items() if key != "mapping"} for one in references]
    return rest


def _difference(file: Path, before: str, after: str) -> str:
    """The change as lines of a diff."""
    old, new = before.splitlines(), after.splitlines()
    return "\n".join(difflib.unified_diff(old, new, shown(file), shown(file), n=1, lineterm=""))


def _no_robot_file(comparison: Comparison, lines: list[str]) -> str:
    robot = comparison.shown_robot
    name = Path(robot).stem
    note = f"not written: {robot} has no robot file. Make one by: congruent new robot {robot} --out {name}\nand declare in it:"
    return "\n".join([note, *_indented(lines)])


def _as_lines(values: dict[str, str]) -> list[str]:
    return ["[tolerance]", *(f"{key} = {value}" for key, value in values.items())]


def _indented(lines: list[str]) -> list[str]:
    return [f"  {line}" for line in lines]


def _with_note(answer: Answer, note: str) -> Answer:
    return replace(answer, text=f"{answer.text}\n\n--congruent-update: {note}")
