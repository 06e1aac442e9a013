"""``watch``: joint states and TF to the judge, its verdicts to the diagnostics, and the model beside the robot in TF."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, field

from .._native import Robot
from ._judge import Judge, Line
from ._links import transforms
from ._messages import Diagnostics, JointState, Kind, Level, Message, Status, Text, Transform, Transforms, Unreadable
from ._published_urdf import DescriptionCheck
from ._robots import moving_joints
from ._statuses import OTHERS, OWN_STATUSES, Statuses
from ._transport import Transport

REPORT_PERIOD_S = 1.0
# How long the loop waits for messages: the delay of a violation, and of Ctrl-C.
WAIT_S = 0.05


@dataclass(frozen=True)
class PoseFrame:
    """A frame of TF that is a link's pose from elsewhere."""

    link: str
    origin: str
    """``controller`` or ``measured``."""


@dataclass(frozen=True)
class WatchOptions:
    """What the command line of ``watch`` says."""

    robot: str
    topics: dict[str, str]
    """Names of topics by the names that they have by default, without the slash."""
    pose_frames: dict[str, PoseFrame] = field(default_factory=dict)
    model_prefix: str = "model/"
    model_rate_hz: float = 30.0
    stale_after_s: float = 1.0


class Watch:
    """The bridge between a transport and a judge."""

    def __init__(self, robot: Robot, judge: Judge, transport: Transport, options: WatchOptions) -> None:
        self._robot, self._judge, self._transport, self._options = robot, judge, transport, options
        topics = options.topics
        self._joint_states, self._diagnostics, self._tf = topics["joint_states"], topics["diagnostics"], topics["tf"]
        self._statuses = Statuses(robot.name, robot.joints, self._joint_states, options.stale_after_s, time.monotonic())
        self._description = DescriptionCheck(options.robot)
        self._links, self._moving = set(robot.links), moving_joints(options.robot)
        self._q: dict[str, float] = {}
        self._time_s: float | None = None
        self._fixed: list[Line] = []
        self._levels: dict[str, Level] = {}
        self._has_moved = False

    def run(self, is_stopped: Callable[[], bool]) -> int:
        """Watches until the judge ends or the caller stops it, and gives the judge's exit code."""
        transport = self._transport
        transport.advertise(self._diagnostics, Kind.DIAGNOSTICS)
        transport.advertise(self._tf, Kind.TRANSFORMS)
        transport.subscribe(self._joint_states, Kind.JOINT_STATE)
        transport.subscribe(self._tf, Kind.TRANSFORMS)
        transport.subscribe(self._options.topics["tf_static"], Kind.TRANSFORMS, kept=True)
        transport.subscribe(self._options.topics["robot_description"], Kind.TEXT, kept=True)
        next_report_s = next_model_s = time.monotonic()
        while not is_stopped() and not self._judge.has_ended:
            for topic, message in transport.take(WAIT_S):
                self._receive(topic, message)
            self._hear()
            now_s = time.monotonic()
            if self._has_moved and now_s >= next_model_s:
                self._publish_model()
                next_model_s = now_s + 1.0 / self._options.model_rate_hz
            is_due = now_s >= next_report_s
            if is_due:
                self._statuses.publishers = transport.publishers(self._joint_states)
                self._statuses.count_rate(now_s)
                next_report_s = now_s + REPORT_PERIOD_S
            self._report(is_due)
        code = self._judge.finish()
        self._hear()
        self._statuses.ended(code)
        self._report(True)
        print(f"{self._robot.name}: the judge {self._statuses.judge_message}", flush=True)
        return code

    def _receive(self, topic: str, message: Message | Unreadable) -> None:
        if isinstance(message, Unreadable):
            self._statuses.note("malformed messages", f"{topic}: {message.reason}", time.monotonic())
        elif isinstance(message, JointState):
            self._receive_joints(message)
        elif isinstance(message, Text):
            self._description.compare(message.text)
        elif isinstance(message, Transforms):
            lines = [line for line in map(self._pose_line, message.transforms) if line is not None]
            if topic == self._tf:
                self._send(lines)
            else:
                # A fixed transform holds at all times: it is judged with the next joint states.
                self._fixed += lines

    def _receive_joints(self, message: JointState) -> None:
        now_s = time.monotonic()
        lengths = [len(values) for values in (message.position, message.velocity, message.effort)]
        if any(length not in (0, len(message.name)) for length in lengths):
            position, velocity, effort = lengths
            text = f"{len(message.name)} names, {position} positions, {velocity} velocities, {effort} efforts"
            self._statuses.note("malformed messages", text, now_s)
            return
        q = self._finite(message.name, message.position)
        if not q and not self._moving.intersection(message.name) and message.name:
            self._statuses.note(OTHERS, ", ".join(message.name), now_s)
            return
        if not q:
            self._statuses.note("messages without positions", f"joints {', '.join(message.name) or 'none'}", now_s)
            return
        # A sender without a clock stamps 0.
        time_s = message.time_s or time.time()
        line: Line = {"time_s": time_s, "q": q}
        line |= {"v": v} if (v := self._finite(message.name, message.velocity)) else {}
        line |= {"tau": tau} if (tau := self._finite(message.name, message.effort)) else {}
        self._statuses.arrived(list(q), now_s)
        self._q |= q
        self._time_s, self._has_moved = time_s, True
        self._send([line])
        self._send([{**fixed, "time_s": time_s} for fixed in self._fixed])
        self._fixed.clear()

    def _finite(self, names: list[str], values: list[float]) -> dict[str, float]:
        """Values by joint of the robot. Those that are not numbers are left out: a driver has NaN for what it does not know."""
        return {name: value for name, value in zip(names, values) if name in self._moving and math.isfinite(value)}

    def _pose_line(self, one: Transform) -> Line | None:
        """The line of a transform, if it is a pose of the robot."""
        frame, child = one.frame.lstrip("/"), one.child.lstrip("/")
        if child in self._options.pose_frames:
            source = self._options.pose_frames[child]
        elif (link := child.removesuffix("_controller")) != child and link in self._links:
            source = PoseFrame(link, "controller")
        elif frame in self._links and child in self._links:
            source = PoseFrame(child, "derived")
        else:
            return None
        if not all(map(math.isfinite, one.translation_m + one.quaternion_wxyz)):
            self._statuses.note("malformed messages", f"{self._tf}: the pose of {child} is not finite", time.monotonic())
            return None
        pose = {"frame": frame, "child": source.link, "translation_m": one.translation_m, "quaternion_wxyz": one.quaternion_wxyz}
        return {"time_s": one.time_s or time.time(), "pose": pose, "origin": source.origin}

    def _send(self, lines: list[Line]) -> None:
        for line in lines:
            if not self._judge.send(line):
                self._statuses.note("messages not judged", "the judge is slower than the robot", time.monotonic())

    def _hear(self) -> None:
        for event in self._judge.events():
            self._statuses.judged(event, time.monotonic())
        if self._description.result is not None:
            self._statuses.described(*self._description.result)

    def _publish_model(self) -> None:
        """The stamp is that of the joint states, so that a viewer shows model and robot at the same time."""
        self._has_moved = False
        assert self._time_s is not None
        self._transport.publish(self._tf, transforms(self._robot, self._q, self._time_s, self._options.model_prefix))

    def _report(self, is_due: bool) -> None:
        """Publishes the diagnostics if it is time, and at once if a level has changed."""
        statuses = self._statuses.all(time.monotonic())
        levels = {status.name: status.level for status in statuses}
        if is_due or levels != self._levels:
            self._transport.publish(self._diagnostics, Diagnostics(time.time(), statuses))
        self._print_changes(statuses)
        self._levels = levels

    def _print_changes(self, statuses: list[Status]) -> None:
        """A line of the terminal for each change. That checks are stale as well is said by the line of the joint states."""
        for status in statuses:
            before = self._levels.get(status.name)
            is_check = status.name.rpartition(": ")[2] not in OWN_STATUSES
            is_quiet = is_check and status.level is not Level.ERROR and before is not Level.ERROR
            if before is not status.level and not is_quiet:
                print(f"{status.level.name:<5} {status.name.removeprefix('congruent: ')}: {status.message}", flush=True)
