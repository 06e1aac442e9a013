"""Whether the URDF that the robot publishes is the robot that is judged."""

from __future__ import annotations

import tempfile
import threading
from pathlib import Path

from .._errors import CongruentError
from .._native import check
from ._messages import Level


class DescriptionCheck:
    """Compares each new text, as ``congruent check ROBOT --against``, in a thread, since that takes some seconds."""

    def __init__(self, robot: str) -> None:
        self._robot = robot
        self._text: str | None = None
        self._result: tuple[Level, str] | None = None

    def compare(self, urdf: str) -> None:
        """Begins to compare this text, unless it is the last one."""
        if urdf != self._text:
            self._text = urdf
            threading.Thread(target=self._compare, args=(urdf,), daemon=True).start()

    @property
    def result(self) -> tuple[Level, str] | None:
        """The answer for the last text, once it is there."""
        return self._result

    def _compare(self, urdf: str) -> None:
        try:
            with tempfile.TemporaryDirectory() as folder:
                file = Path(folder) / "robot_description.urdf"
                file.write_text(urdf, encoding="utf-8")
                report = check(self._robot, against=file)
                headline = report.headline.replace(f"{folder}/", "")
            answer = Level.OK if report.ok else Level.ERROR, headline
        except CongruentError as error:
            text = str(error).replace(f"{folder}/", "")
            answer = Level.WARN, f"cannot be compared: {text}"
        if urdf == self._text:
            self._result = answer
