"""What is known of the robot, as statuses of diagnostics: one of the joint states, one of the judge, one of each check."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from ._judge import Line
from ._messages import Level, Status

# For so long something that is over, such as a gap, is a warning. Its number is kept.
WARNING_S = 5.0
# Joint states of another robot on the topic are usual, and no fault.
OTHERS = "messages of other joints"
# Statuses that are no check of the judge.
OWN_STATUSES = ("joint states", "robot description", "judge")
# Keys of an event that are said elsewhere in its status.
SAID_ELSEWHERE = {"kind", "check", "message"}


@dataclass
class _Notes:
    """Things that happened and are over."""

    count: int = 0
    last: str = ""
    at_s: float = float("-inf")

    def add(self, text: str, now_s: float) -> None:
        self.count, self.last, self.at_s = self.count + 1, text, now_s


@dataclass
class _Check:
    level: Level
    message: str
    values: dict[str, str] = field(default_factory=dict)


class Statuses:
    """``now_s`` is the time of a clock that never goes back."""

    def __init__(self, robot: str, joints: list[str], topic: str, stale_after_s: float, now_s: float) -> None:
        self._robot, self._topic, self._stale_after_s = robot, topic, stale_after_s
        self._missing = list(joints)
        self._started_s, self._arrived_s = now_s, float("-inf")
        self._messages, self._counted, self._counted_s, self._rate_hz = 0, 0, now_s, 0.0
        kinds = ("malformed messages", "messages without positions", "gaps", "messages lost", "lines refused", "messages not judged", OTHERS)
        self._notes = {kind: _Notes() for kind in kinds}
        self._checks: dict[str, _Check] = {}
        self._judge = _Check(Level.WARN, "starts")
        self._description: _Check | None = None
        self.publishers = 0

    def arrived(self, joints: list[str], now_s: float) -> None:
        """Positions of these joints have arrived."""
        self._messages += 1
        self._arrived_s = now_s
        if self._missing:
            self._missing = [joint for joint in self._missing if joint not in joints]

    def note(self, kind: str, text: str, now_s: float) -> None:
        """Something is wrong with a message."""
        self._notes[kind].add(text, now_s)

    def judged(self, event: Line, now_s: float) -> None:
        """The judge has said something."""
        kind, text = event.get("kind"), sentence(event)
        if kind == "started":
            self._judge = _Check(Level.OK, "watches", values_of(event))
            for check in event.get("checks") or []:
                name = str(check.get("check", check) if isinstance(check, dict) else check)
                self._checks.setdefault(name, _Check(Level.OK, "not violated"))
        elif kind == "violation":
            self._checks[_name(event)] = _Check(Level.ERROR, text, values_of(event))
        elif kind == "recovered":
            self._checks[_name(event)] = _Check(Level.OK, text, values_of(event))
        elif kind == "pose":
            check = self._checks.setdefault("pose", _Check(Level.OK, "not violated"))
            check.values = values_of(event)
        elif kind == "gap":
            self.note("gaps", text, now_s)
        elif kind == "lost":
            self.note("messages lost", text, now_s)
        elif kind in ("bad_line", "unreadable"):
            self.note("lines refused", text, now_s)
        elif kind == "finished":
            self._judge = _Check(Level.OK, f"has finished: {text}", values_of(event))

    def described(self, level: Level, message: str) -> None:
        """The URDF that the robot publishes has been compared."""
        self._description = _Check(level, message)

    def ended(self, code: int) -> None:
        """The judge has ended by itself. 0 and 1 are answers of it."""
        if code not in (0, 1):
            self._judge = _Check(Level.ERROR, f"has ended with exit code {code}: nothing is judged any more")

    def count_rate(self, now_s: float) -> None:
        """Ends the time over which the rate is counted."""
        if now_s > self._counted_s:
            self._rate_hz = (self._messages - self._counted) / (now_s - self._counted_s)
        self._counted, self._counted_s = self._messages, now_s

    def all(self, now_s: float) -> list[Status]:
        """All statuses. What was fine is stale if no joint states arrive; what was violated remains so."""
        joints = self._joint_states(now_s)
        checks = {}
        for name, check in self._checks.items():
            is_stale = joints.level is Level.STALE and check.level is Level.OK
            checks[name] = _Check(Level.STALE, f"{joints.message}; before: {check.message}", check.values) if is_stale else check
        found = {"joint states": joints, "judge": self._judge, **checks}
        if self._description is not None:
            found["robot description"] = self._description
        prefix = f"congruent: {self._robot}: "
        return [Status(one.level, prefix + name, one.message, self._robot, one.values) for name, one in found.items()]

    def _joint_states(self, now_s: float) -> _Check:
        age_s = now_s - self._arrived_s
        values = {"topic": self._topic, "publishers": str(self.publishers), "messages": str(self._messages)}
        if self._messages:
            values["rate"] = f"{self._rate_hz:.4g} Hz"
            values["time since the last message"] = f"{age_s:.3f} s"
        if self._missing and self._messages:
            values["joints without a value"] = ", ".join(self._missing)
        for kind, notes in self._notes.items():
            if notes.count:
                values[kind] = f"{notes.count}, the last: {notes.last}"
        return _Check(*self._level(age_s, now_s), values)

    def _level(self, age_s: float, now_s: float) -> tuple[Level, str]:
        if not self._messages:
            who = {0: "nobody publishes it", 1: "its publisher sends none"}.get(self.publishers, "its publishers send none")
            wrong = [f"{kind}: {notes.last}" for kind, notes in self._notes.items() if notes.count]
            reason = "; ".join(wrong) or who
            return Level.STALE, f"no joint states on {self._topic} yet, after {now_s - self._started_s:.1f} s: {reason}"
        if age_s > self._stale_after_s:
            return Level.STALE, f"no joint states on {self._topic} for {age_s:.1f} s"
        recent = [f"{kind}: {notes.last}" for kind, notes in self._notes.items() if now_s - notes.at_s < WARNING_S and kind != OTHERS]
        if recent:
            return Level.WARN, "; ".join(recent)
        if self._missing:
            return Level.WARN, f"no value of {', '.join(self._missing)}, taken as 0 in the TF of the model"
        return Level.OK, "arrive"


def sentence(event: Line) -> str:
    """What the judge says of the event, or its values."""
    said = event.get("message")
    if isinstance(said, str) and said:
        return said
    return ", ".join(f"{key} {value}" for key, value in values_of(event).items()) or str(event.get("kind"))


def values_of(event: Line) -> dict[str, str]:
    """Its values by their keys, which have the units."""
    found: dict[str, str] = {}
    for key, value in event.items():
        if key not in SAID_ELSEWHERE:
            _put(found, key, value)
    return found


def _put(found: dict[str, str], key: str, value: Any) -> None:
    if isinstance(value, dict):
        for below, inner in value.items():
            _put(found, f"{key}.{below}", inner)
    elif value is not None:
        found[key] = _text(value)


def _text(value: Any) -> str:
    if isinstance(value, list):
        return ", ".join(map(_text, value))
    # Enough digits for the microseconds of a time since 1970.
    return f"{value:.16g}" if isinstance(value, float) else str(value)


def _name(event: Line) -> str:
    return str(event.get("check") or "judge")
