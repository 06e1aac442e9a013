"""Between our messages and those of ROS. Both transports use it, since ROS's classes have the same fields in both."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ._messages import Diagnostics, JointState, Kind, Level, Message, Status, Text, Transform, Transforms

NANOSECONDS = 1_000_000_000


class Wire:
    """``types`` has the classes of ROS as attributes; ``level_of`` makes their level of a diagnostic from its number, and
    ``number_of`` the number from it: rclpy has a byte string for it."""

    def __init__(self, types: Any, level_of: Callable[[int], Any] = int, number_of: Callable[[Any], int] = int) -> None:
        self._types, self._level_of, self._number_of = types, level_of, number_of
        self.classes: dict[Kind, Any] = {
            Kind.JOINT_STATE: types.JointState,
            Kind.TRANSFORMS: types.TFMessage,
            Kind.DIAGNOSTICS: types.DiagnosticArray,
            Kind.TEXT: types.String,
        }

    def to_ros(self, message: Message) -> Any:
        """The message as an object of ROS's class."""
        types = self._types
        if isinstance(message, JointState):
            header = self._header(message.time_s)
            lists = (message.position, message.velocity, message.effort)
            position, velocity, effort = ([float(value) for value in values] for values in lists)
            return types.JointState(header=header, name=list(message.name), position=position, velocity=velocity, effort=effort)
        if isinstance(message, Transforms):
            return types.TFMessage(transforms=[self._transform(one) for one in message.transforms])
        if isinstance(message, Diagnostics):
            statuses = [self._status(status) for status in message.statuses]
            return types.DiagnosticArray(header=self._header(message.time_s), status=statuses)
        return types.String(data=message.text)

    def from_ros(self, received: Any, kind: Kind) -> Message:
        """Our message from ROS's."""
        if kind is Kind.JOINT_STATE:
            lists = (received.position, received.velocity, received.effort)
            return JointState(_seconds(received.header.stamp), list(received.name), *(list(values) for values in lists))
        if kind is Kind.TRANSFORMS:
            return Transforms([_transform(one) for one in received.transforms])
        if kind is Kind.DIAGNOSTICS:
            statuses = [self._status_of(status) for status in received.status]
            return Diagnostics(_seconds(received.header.stamp), statuses)
        return Text(received.data)

    def _header(self, time_s: float, frame: str = "") -> Any:
        sec, nanosec = divmod(round(time_s * NANOSECONDS), NANOSECONDS)
        return self._types.Header(stamp=self._types.Time(sec=sec, nanosec=nanosec), frame_id=frame)

    def _transform(self, one: Transform) -> Any:
        types = self._types
        x, y, z = one.translation_m
        w, i, j, k = one.quaternion_wxyz
        pose = types.Transform(translation=types.Vector3(x=x, y=y, z=z), rotation=types.Quaternion(x=i, y=j, z=k, w=w))
        header = self._header(one.time_s, one.frame)
        return types.TransformStamped(header=header, child_frame_id=one.child, transform=pose)

    def _status(self, status: Status) -> Any:
        types = self._types
        values = [types.KeyValue(key=key, value=value) for key, value in status.values.items()]
        return types.DiagnosticStatus(
            level=self._level_of(int(status.level)),
            name=status.name,
            message=status.message,
            hardware_id=status.robot,
            values=values,
        )

    def _status_of(self, received: Any) -> Status:
        values = {pair.key: pair.value for pair in received.values}
        level = Level(self._number_of(received.level))
        return Status(level, received.name, received.message, received.hardware_id, values)


def _seconds(stamp: Any) -> float:
    return float(stamp.sec + stamp.nanosec / NANOSECONDS)


def _transform(received: Any) -> Transform:
    at, turn = received.transform.translation, received.transform.rotation
    frames = (received.header.frame_id, received.child_frame_id)
    return Transform(_seconds(received.header.stamp), *frames, [at.x, at.y, at.z], [turn.w, turn.x, turn.y, turn.z])
