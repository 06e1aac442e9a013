"""What the judge says, as sentences and values of diagnostics. ``congruent schema watch`` has all of its lines."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from ._judge import Line

BOUNDS = {"at_most": "<=", "at_least": ">="}
# What a status has of the first line.
OF_START = ("joints", "held", "rate_hz", "checks", "taken")


def check_names(started: Line) -> list[str]:
    """Names of the checks by their numbers, from 1 on: the kind, with the number if there are several of a kind."""
    kinds = [str(kind) for kind in started.get("checks", [])]
    return [kind if kinds.count(kind) == 1 else f"{kind} {number}" for number, kind in enumerate(kinds, 1)]


def change_sentence(change: Line) -> str:
    """The value of a check and its limit."""
    bound = BOUNDS.get(str(change.get("bound")), "")
    subject = f" at {change['where']}" if change.get("where") else ""
    quantity = str(change.get("quantity", "value"))
    if quantity.endswith("_beyond_limit") and change.get("value") is not None:
        # Negative within the range of the joint.
        beyond = float(change["value"])
        size = _amount({**change, "value": abs(beyond)}, "value")
        return f"{size} beyond the limit{subject}" if beyond > 0 else f"margin {size}{subject}"
    return f"{quantity.replace('_', ' ')} {_amount(change, 'value')}{subject}, limit {bound} {_amount(change, 'limit')}"


def change_values(change: Line) -> dict[str, str]:
    """The same as values, with all digits."""
    unit = f" {change['unit']}" if change.get("unit") else ""
    time_s = change.get("time_s")
    # A time since 1970 has more digits than other values.
    values = {"time_s": None if time_s is None else f"{time_s:.6f}", "quantity": change.get("quantity"), "where": change.get("where")}
    found = {key: text(value) for key, value in values.items() if value is not None}
    found["value"] = "infinite" if change.get("value") is None else text(change["value"]) + unit
    found["limit"] = f"{BOUNDS.get(str(change.get('bound')), '')} {text(change.get('limit'))}{unit}"
    return found


def start_values(started: Line) -> dict[str, str]:
    """What it has found in the stream."""
    return {key: text(started[key]) for key in OF_START if started.get(key)}


def gap_sentence(gap: Line) -> str:
    """What was missing for how long."""
    if gap.get("cause") == "clock_went_back":
        return f"the clock of the sender went back by {float(gap['from_s']) - float(gap['to_s']):.3g} s, a new part begins"
    return f"nothing came for {float(gap['to_s']) - float(gap['from_s']):.3g} s, nothing is judged in it"


def lost_sentence(lost: Line) -> str:
    """What was lost."""
    return f"{lost.get('samples', 0)} samples: {lost.get('message')}"


def end_values(finished: Line) -> dict[str, str]:
    """The verdict, and what became of the messages."""
    counts = {key: value for key, value in (finished.get("counts") or {}).items() if value}
    return {"verdict": text(finished.get("verdict")), **{key.replace("_", " "): text(value) for key, value in counts.items()}}


def failed_checks(finished: Line) -> Iterator[tuple[int, Line]]:
    """The checks with a value that is beyond its limit at its worst, by their numbers, with that value as a change."""
    for number, check in enumerate((finished.get("report") or {}).get("checks", []), 1):
        measures = [measure for measure in check.get("measures", []) if measure.get("worst") and _is_beyond(measure)]
        if check.get("status") == "fail" and measures:
            worst = measures[0]["worst"]
            # Its time is that of the run, and not of the stream.
            yield number, {**measures[0], "value": worst.get("value"), "where": worst.get("subject")}


def error_sentence(event: Line) -> str:
    """Why it cannot judge."""
    return "; ".join(str(finding.get("message")) for finding in event.get("findings", [])) or str(event.get("error"))


def text(value: Any) -> str:
    """A value as a text."""
    if isinstance(value, list):
        return ", ".join(map(text, value))
    return f"{value:.9g}" if isinstance(value, float) else str(value)


def _is_beyond(measure: Line) -> bool:
    value, limit = measure["worst"].get("value"), measure.get("limit")
    if value is None or limit is None:
        return True
    return bool(value < limit if measure.get("bound") == "at_least" else value > limit)


def _amount(change: Line, key: str) -> str:
    """In the unit that people read."""
    value, unit = change.get(key), change.get("unit") or ""
    if value is None:
        return "infinite" if key == "value" else "unknown"
    if unit == "rad":
        return f"{math.degrees(value):.3g} deg"
    if unit == "m" and abs(value) < 1:
        return f"{1000 * value:.3g} mm"
    return f"{value:.3g} {unit}".rstrip()
