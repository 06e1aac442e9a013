"""The judge: the command ``congruent watch`` in a process of its own, with lines of JSON in both directions."""

from __future__ import annotations

import json
import queue
import subprocess
import sys
import threading
from collections.abc import Sequence
from typing import Any, TypeAlias

Line: TypeAlias = dict[str, Any]

# Lines that wait if the judge is slower than the robot: a minute at 500 Hz. A judge that does not keep up even so is reported,
# and does not take the memory of the machine.
WAITING = 30_000
# Exit code of the command if nothing was checked.
NOTHING_CHECKED = 4
# A judge that is to end writes what it found, and needs no longer.
SECONDS_TO_END = 30.0


def command_of(robot: str, scenario: str | None, until_violation: bool) -> list[str]:
    """The command line of the judge."""
    words = [sys.executable, "-m", "congruent", "watch", robot, "--format", "json"]
    words += ["--scenario", scenario] if scenario is not None else []
    return words + ["--until-violation"] * until_violation


class Judge:
    """A running judge. What it has to say to the user goes to standard error, as that of any command."""

    def __init__(self, command: Sequence[str]) -> None:
        # In a session of its own Ctrl-C does not reach it: its input ends instead, so that it judges all that it was given.
        self._process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, encoding="utf-8", start_new_session=True
        )
        self._waiting: queue.Queue[Line | None] = queue.Queue(WAITING)
        self._events: queue.SimpleQueue[Line] = queue.SimpleQueue()
        self._has_lines = False
        self._writing = threading.Thread(target=self._write, daemon=True)
        self._reading = threading.Thread(target=self._read, daemon=True)
        self._writing.start()
        self._reading.start()

    def send(self, line: Line) -> bool:
        """Whether the line is taken; false if the judge is too slow."""
        try:
            self._waiting.put_nowait(line)
        except queue.Full:
            return False
        self._has_lines = True
        return True

    def events(self) -> list[Line]:
        """What it has said since the last call."""
        said = []
        while not self._events.empty():
            said.append(self._events.get())
        return said

    @property
    def has_ended(self) -> bool:
        """Whether it has ended and all that it said is in ``events``."""
        return self._process.poll() is not None and not self._reading.is_alive()

    def finish(self) -> int:
        """Ends its input, waits until it has judged the rest, and gives its exit code; 3 if it does not end."""
        if not self._has_lines and not self.has_ended:
            # It would take the empty input for a mistake of the caller.
            self._process.kill()
            self._process.wait()
            return NOTHING_CHECKED
        try:
            self._waiting.put(None, timeout=SECONDS_TO_END)
            code = self._process.wait(SECONDS_TO_END)
        except (queue.Full, subprocess.TimeoutExpired):
            self._process.kill()
            self._process.wait()
            code = 3
        self._reading.join(SECONDS_TO_END)
        # A process that a signal ended has a negative code.
        return code if code >= 0 else 3

    def _write(self) -> None:
        stdin = self._process.stdin
        assert stdin is not None
        try:
            while (line := self._waiting.get()) is not None:
                stdin.write(json.dumps(line, allow_nan=False) + "\n")
                if self._waiting.empty():
                    stdin.flush()
            stdin.close()
        except (BrokenPipeError, ValueError):
            # It has ended; whoever reads `has_ended` says so.
            pass

    def _read(self) -> None:
        stdout = self._process.stdout
        assert stdout is not None
        for text in stdout:
            try:
                event = json.loads(text)
            except ValueError:
                event = None
            self._events.put(event if isinstance(event, dict) else {"kind": "bad_line", "message": f"its answer {text.strip()}"})
