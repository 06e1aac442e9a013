"""``play``: the motion of a scenario or a log as joint states, TF and the URDF."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy import float64
from numpy.typing import NDArray

from .._native import Robot, run
from ._links import transforms
from ._messages import JointState, Kind, Text
from ._robots import command, urdf_of
from ._transport import RosError, Transport

# How long other publishers are looked for, and readers have to find this one, before the first row: within one machine that takes
# some tenths of a second.
SEARCH_S = 1.0
# A wait is cut into such parts, so that Ctrl-C ends it.
WAIT_S = 0.05


@dataclass(frozen=True)
class Motion:
    """Rows of joint values by the time from the first."""

    robot: Robot
    urdf: str
    time_s: NDArray[float64]
    q: dict[str, NDArray[float64]]
    qd: dict[str, NDArray[float64]]
    effort: dict[str, NDArray[float64]]


def read_motion(file: Path, robot: str | None, folder: Path) -> Motion:
    """The motion of a scenario, or of a log of the robot. The command runs the scenario, or one that it writes for the log, in
    ``folder``."""
    if not file.exists():
        raise RosError(f"{file} does not exist")
    if file.suffix in (".urdf", ".xml", ".xacro") or (file / "robot.toml").exists():
        raise RosError(f"{file} is a robot: play takes a scenario, or a log with --robot {file}")
    scenario = file
    if file.suffix != ".toml":
        if robot is None:
            raise RosError(f"{file} is read as a log, and a log needs its robot: --robot ROBOT")
        scenario = _scenario_of_log(file, robot, folder / "log")
    report = run(scenario, out=folder / "run", set={"output.trajectory": "parquet"})
    print(report.headline, flush=True)
    assert report.folder is not None
    played = _robot_of(Path(report.folder) / "scenario.resolved.toml")
    columns = report.series
    # The true positions, if the encoders are not simulated.
    q = _columns(columns, ".measured_q_rad", ".measured_q_m") or _columns(columns, ".q_rad", ".q_m")
    speeds, efforts = _columns(columns, ".qd_rad_s", ".qd_m_s"), _columns(columns, ".effort_n_m", ".effort_n")
    return Motion(Robot(played), urdf_of(played), columns["time_s"], q, speeds, efforts)


class Player:
    """Publishes a motion. Positions are those of the encoders, as a driver publishes them; TF is computed from them."""

    def __init__(self, motion: Motion, transport: Transport, topics: dict[str, str]) -> None:
        self._motion, self._transport = motion, transport
        self._joint_states, self._tf = topics["joint_states"], topics["tf"]
        transport.advertise(self._joint_states, Kind.JOINT_STATE)
        transport.advertise(self._tf, Kind.TRANSFORMS)
        transport.advertise(topics["robot_description"], Kind.TEXT, kept=True)
        self._refuse_a_second_publisher()
        transport.publish(topics["robot_description"], Text(motion.urdf))

    @property
    def duration_s(self) -> float:
        """From the first row to the last."""
        return float(self._motion.time_s[-1] - self._motion.time_s[0])

    def play(self, rate: float, rows_per_s: float, is_stopped: Callable[[], bool]) -> int:
        """Publishes the rows at their times divided by ``rate``, and gives their number."""
        started_s, sent = time.monotonic(), 0
        for row in rows(self._motion.time_s, rate / rows_per_s):
            due_s = started_s + float(self._motion.time_s[row] - self._motion.time_s[0]) / rate
            while (early_s := due_s - time.monotonic()) > 0 and not is_stopped():
                time.sleep(min(early_s, WAIT_S))
            if is_stopped():
                break
            self._publish(row, rate)
            sent += 1
        return sent

    def _publish(self, row: int, rate: float) -> None:
        now_s, motion = time.time(), self._motion
        q, qd, effort = ({name: float(values[row]) for name, values in all.items()} for all in (motion.q, motion.qd, motion.effort))
        names = list(q)
        known = [name for name in names if np.isfinite(q[name])]
        # Time runs `rate` times as fast for who sees it, so velocities do, too.
        speeds = [qd[name] * rate for name in known] if all(name in qd and np.isfinite(qd[name]) for name in known) else []
        efforts = [effort[name] for name in known] if all(name in effort and np.isfinite(effort[name]) for name in known) else []
        state = JointState(now_s, known, [q[name] for name in known], speeds, efforts)
        self._transport.publish(self._joint_states, state)
        self._transport.publish(self._tf, transforms(motion.robot, {name: q[name] for name in known}, now_s))

    def _refuse_a_second_publisher(self) -> None:
        topic = self._joint_states
        self._transport.subscribe(topic, Kind.JOINT_STATE)
        end_s = time.monotonic() + SEARCH_S
        while time.monotonic() < end_s:
            if self._transport.publishers(topic) > 1:
                raise RosError(
                    f"{topic} already has a publisher: a robot, or something else that plays (one that was killed counts for"
                    " 10 s more); play in another ROS_DOMAIN_ID, or under a namespace: --topic joint_states=/played/joint_states"
                )
            time.sleep(WAIT_S)
        self._transport.unsubscribe(topic)


def rows(time_s: NDArray[float64], period_s: float) -> Iterator[int]:
    """The first row and those that are at least a period after the row before them, by some rounding less."""
    next_s = float("-inf")
    for row, at_s in enumerate(time_s):
        if at_s >= next_s - 1e-9:
            yield row
            next_s = float(at_s) + period_s


def _scenario_of_log(log: Path, robot: str, folder: Path) -> Path:
    # Exit code 1 says that the log fails its checks, and 4 that there was nothing to check: it can be played.
    command("replay", robot, str(log), "--out", str(folder), "--no-recording", "--quiet", accepted=(0, 1, 4))
    return next(folder.glob("*.toml"))


def _robot_of(resolved: Path) -> str:
    """The robot that a resolved scenario names, relative to its own folder."""
    for line in resolved.read_text(encoding="utf-8").splitlines():
        if line.startswith("robot = "):
            return str(resolved.parent / json.loads(line.removeprefix("robot = ")))
    raise AssertionError(f"{resolved} names no robot")


def _columns(columns: dict[str, NDArray[float64]], *ends: str) -> dict[str, NDArray[float64]]:
    """The columns of this quantity by their joint; those without any value are left out."""
    found = {}
    for name, values in columns.items():
        for end in ends:
            joint = name.removesuffix(end)
            if joint != name and np.isfinite(values).any():
                found[joint] = values
    return found
