"""What carries messages: CycloneDDS, or rclpy. ``watch`` and ``play`` know this interface alone."""

from __future__ import annotations

import importlib.util
import os
from typing import Protocol

from ._messages import Kind, Message, Unreadable

# All that may ever be published, by the last part of the topic's name. None of it moves a robot: positions of joints are a
# command under another name in some drivers (`joint_command`), so a topic may get a namespace, but no other name.
WRITABLE = {
    "joint_states": Kind.JOINT_STATE,
    "tf": Kind.TRANSFORMS,
    "robot_description": Kind.TEXT,
    "diagnostics": Kind.DIAGNOSTICS,
}


class RosError(Exception):
    """Something that the caller can put right; the text says what."""


class Transport(Protocol):
    """Topics have the names of ROS, as ``/joint_states``. ``kept`` topics give their last message also to those who come later
    (transient local); all others are volatile."""

    def subscribe(self, topic: str, kind: Kind, *, kept: bool = False) -> None:
        """From now on ``take`` gives the messages of this topic."""

    def unsubscribe(self, topic: str) -> None:
        """No more messages of this topic."""

    def take(self, timeout_s: float) -> list[tuple[str, Message | Unreadable]]:
        """What has arrived, with its topic, in the order of arrival on each topic. Waits until something is there."""

    def publishers(self, topic: str) -> int:
        """How many publishers there are of a topic that is subscribed to."""

    def advertise(self, topic: str, kind: Kind, *, kept: bool = False) -> None:
        """Prepares ``publish``. Raises ``RosError`` if the topic is none that may be published."""

    def publish(self, topic: str, message: Message) -> None:
        """Sends a message on a topic that is advertised."""

    def advertised(self) -> set[str]:
        """The topics that can be published."""

    def close(self) -> None:
        """Ends all topics."""


def refuse_unless_writable(topic: str, kind: Kind) -> None:
    """Every transport calls this before it makes a publisher."""
    if WRITABLE.get(topic.rpartition("/")[2]) is not kind:
        names = ", ".join(WRITABLE)
        raise RosError(f"{topic} is not published: nothing but {names} is, in any namespace, so that no robot is ever commanded")


def open_transport(backend: str = "auto") -> Transport:
    """``cyclonedds``, ``rclpy``, or ``auto``: CycloneDDS if it is installed, otherwise rclpy."""
    domain = _domain()
    has = {name: importlib.util.find_spec(name) is not None for name in ("cyclonedds", "rclpy")}
    if backend == "auto":
        backend = "cyclonedds" if has["cyclonedds"] or not has["rclpy"] else "rclpy"
    if not has[backend]:
        how = "pip install 'congruent[ros2]'" if backend == "cyclonedds" else "source /opt/ros/DISTRO/setup.bash"
        raise RosError(f"{backend} is not installed: {how}")
    if backend == "rclpy":
        from ._rclpy import RclpyTransport

        return RclpyTransport(domain)
    from ._dds import DdsTransport

    return DdsTransport(domain)


def _domain() -> int:
    text = os.environ.get("ROS_DOMAIN_ID", "").strip() or "0"
    # DDS has ports for 0 to 232.
    if not text.isdecimal() or int(text) > 232:
        raise RosError(f"ROS_DOMAIN_ID = {text!r} is no number from 0 to 232")
    return int(text)
