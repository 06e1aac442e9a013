"""What is known of the robot, as statuses of diagnostics: one of the joint states, one of the judge, one of each check."""

from __future__ import annotations

from dataclasses import dataclass, field

from . import _events as events
from ._judge import NOTHING_CHECKED, Line
from ._messages import Level, Status

# For so long something that is over, such as a gap, is a warning. Its number is kept.
WARNING_S = 5.0
# Joint states of another robot on the topic are usual, and no fault.
OTHERS = "messages of other joints"
# Statuses that are no check of the judge.
OWN_STATUSES = ("joint states", "robot description", "judge")


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
        self._value_s: dict[str, float] = {}
        self._started_s, self._arrived_s = now_s, float("-inf")
        self._messages, self._counted, self._counted_s, self._rate_hz = 0, 0, now_s, 0.0
        kinds: tuple[str, ...] = ("malformed messages", "messages without positions", "gaps", "samples lost", "lines refused", "left out")
        kinds += ("messages not judged", OTHERS)
        self._notes = {kind: _Notes() for kind in kinds}
        self._checks: dict[str, _Check] = {}
        self._names: list[str] = []
        self._judge = _Check(Level.STALE, "begins with the first joint states")
        self._description: _Check | None = None
        self.publishers = 0

    def arrived(self, joints: list[str], now_s: float) -> None:
        """Positions of these joints have arrived."""
        self._messages += 1
        self._arrived_s = now_s
        self._value_s.update(dict.fromkeys(joints, now_s))
        if self._missing:
            self._missing = [joint for joint in self._missing if joint not in joints]

    def note(self, kind: str, text: str, now_s: float) -> None:
        """Something is wrong with a message."""
        self._notes[kind].add(text, now_s)

    def judged(self, event: Line, now_s: float) -> None:
        """The judge has said something."""
        kind = event.get("kind")
        if kind == "started":
            self._judge = _Check(Level.OK, "watches", events.start_values(event))
            self._names = events.check_names(event)
            self._checks = {name: _Check(Level.OK, "not violated") for name in self._names}
        elif kind in ("violation", "recovered"):
            level, word = (Level.ERROR, "violated") if kind == "violation" else (Level.OK, "recovered")
            self._change(int(event["number"]), level, word, event)
        elif kind == "gap":
            self.note("gaps", events.gap_sentence(event), now_s)
        elif kind == "lost":
            self.note("samples lost", events.lost_sentence(event), now_s)
        elif kind == "bad_line":
            self.note("lines refused", str(event.get("message")), now_s)
        elif kind == "left_out":
            self.note("left out", str(event.get("message")), now_s)
        elif kind == "finished":
            for number, change in events.failed_checks(event):
                # What is violated now has said so.
                if self._checks[self._names[number - 1]].level is not Level.ERROR:
                    self._change(number, Level.ERROR, "failed", change)
            self._judge = _Check(Level.OK, f"has finished, verdict {event.get('verdict')}", events.end_values(event))
        elif "error" in event:
            self._judge = _Check(Level.ERROR, events.error_sentence(event))

    def _change(self, number: int, level: Level, word: str, change: Line) -> None:
        self._checks[self._names[number - 1]] = _Check(level, f"{word}: {events.change_sentence(change)}", events.change_values(change))

    def described(self, level: Level, message: str) -> None:
        """The URDF that the robot publishes has been compared."""
        self._description = _Check(level, message)

    def ended(self, code: int) -> None:
        """The judge has ended. 0 and 1 are answers of it."""
        if code == NOTHING_CHECKED:
            self._judge = _Check(Level.STALE, "has ended, and nothing was judged: no joint states came")
        elif code not in (0, 1):
            reason = f": {self._judge.message}" if self._judge.level is Level.ERROR else ""
            self._judge = _Check(Level.ERROR, f"has ended with exit code {code}{reason}; nothing is judged any more")

    @property
    def judge_message(self) -> str:
        """What the judge does, or has found."""
        return self._judge.message

    def count_rate(self, now_s: float) -> None:
        """Ends the time over which the rate is counted."""
        if now_s > self._counted_s:
            self._rate_hz = (self._messages - self._counted) / (now_s - self._counted_s)
        self._counted, self._counted_s = self._messages, now_s

    def all(self, now_s: float) -> list[Status]:
        """All statuses. What was fine is stale if no joint states arrive; what was violated remains so."""
        joints = self._joint_states(now_s)
        checks = {}
        # Without one joint, no sample is judged.
        is_blind = joints.level is Level.STALE or bool(self._lost(now_s))
        for name, check in self._checks.items():
            is_stale = is_blind and check.level is Level.OK
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

    def _lost(self, now_s: float) -> list[str]:
        """Joints that have had a value, and have none any more."""
        return [joint for joint, at_s in self._value_s.items() if now_s - at_s > self._stale_after_s]

    def _level(self, age_s: float, now_s: float) -> tuple[Level, str]:
        if not self._messages:
            who = {0: "nobody publishes it", 1: "its publisher sends none"}.get(self.publishers, "its publishers send none")
            wrong = [f"{kind}: {notes.last}" for kind, notes in self._notes.items() if notes.count]
            reason = "; ".join(wrong) or who
            return Level.STALE, f"no joint states on {self._topic} yet, after {now_s - self._started_s:.1f} s: {reason}"
        if age_s > self._stale_after_s:
            return Level.STALE, f"no joint states on {self._topic} for {age_s:.1f} s"
        if lost := self._lost(now_s):
            age_s = now_s - min(self._value_s[joint] for joint in lost)
            return Level.WARN, f"no value of {', '.join(lost)} for {age_s:.1f} s: nothing is judged without it"
        recent = [f"{kind}: {notes.last}" for kind, notes in self._notes.items() if now_s - notes.at_s < WARNING_S and kind != OTHERS]
        if recent:
            return Level.WARN, "; ".join(recent)
        if self._missing:
            return Level.WARN, f"no value of {', '.join(self._missing)}, taken as 0 in the TF of the model"
        return Level.OK, "arrive"
