"""rclpy, where a ROS 2 is installed: its middleware, its security, its settings. Not tested: rclpy cannot be installed by pip."""

from __future__ import annotations

import functools
import importlib
from types import SimpleNamespace
from typing import Any

from ._messages import Kind, Message, Unreadable
from ._transport import refuse_unless_writable
from ._wire import Wire

READ_DEPTH = 10_000
WRITE_DEPTH = 100
CLASSES = {
    "builtin_interfaces.msg": ("Time",),
    "std_msgs.msg": ("Header", "String"),
    "sensor_msgs.msg": ("JointState",),
    "geometry_msgs.msg": ("Vector3", "Quaternion", "Transform", "TransformStamped"),
    "tf2_msgs.msg": ("TFMessage",),
    "diagnostic_msgs.msg": ("KeyValue", "DiagnosticStatus", "DiagnosticArray"),
}


class RclpyTransport:
    """A node ``congruent``."""

    def __init__(self, domain: int) -> None:
        self._rclpy: Any = importlib.import_module("rclpy")
        self._qos: Any = importlib.import_module("rclpy.qos")
        # Ctrl-C is handled by the caller.
        signals = importlib.import_module("rclpy.signals").SignalHandlerOptions.NO
        self._rclpy.init(args=[], domain_id=domain, signal_handler_options=signals)
        self._node = self._rclpy.create_node("congruent")
        names = {name: getattr(importlib.import_module(module), name) for module, names in CLASSES.items() for name in names}
        self._wire = Wire(SimpleNamespace(**names), lambda number: bytes([number]), lambda level: int(level[0]))
        self._subscriptions: dict[str, Any] = {}
        self._writers: dict[str, Any] = {}
        self._arrived: list[tuple[str, Message | Unreadable]] = []

    def subscribe(self, topic: str, kind: Kind, *, kept: bool = False) -> None:
        """See ``Transport``; reliability as in ``_dds``."""
        arrive = functools.partial(self._arrive, topic, kind)
        qos = self._profile(READ_DEPTH, kept, is_reliable=kept)
        self._subscriptions[topic] = self._node.create_subscription(self._wire.classes[kind], topic, arrive, qos)

    def unsubscribe(self, topic: str) -> None:
        """See ``Transport``."""
        self._node.destroy_subscription(self._subscriptions.pop(topic))

    def take(self, timeout_s: float) -> list[tuple[str, Message | Unreadable]]:
        """See ``Transport``."""
        self._rclpy.spin_once(self._node, timeout_sec=timeout_s)
        while self._arrived and len(self._arrived) < WRITE_DEPTH:
            before = len(self._arrived)
            self._rclpy.spin_once(self._node, timeout_sec=0)
            if len(self._arrived) == before:
                break
        taken, self._arrived = self._arrived, []
        return taken

    def publishers(self, topic: str) -> int:
        """See ``Transport``."""
        return int(self._node.count_publishers(topic))

    def advertise(self, topic: str, kind: Kind, *, kept: bool = False) -> None:
        """See ``Transport``."""
        refuse_unless_writable(topic, kind)
        qos = self._profile(1 if kept else WRITE_DEPTH, kept, is_reliable=True)
        self._writers[topic] = self._node.create_publisher(self._wire.classes[kind], topic, qos)

    def publish(self, topic: str, message: Message) -> None:
        """See ``Transport``."""
        self._writers[topic].publish(self._wire.to_ros(message))

    def advertised(self) -> set[str]:
        """See ``Transport``."""
        return set(self._writers)

    def close(self) -> None:
        """See ``Transport``."""
        self._node.destroy_node()
        self._rclpy.shutdown()

    def _arrive(self, topic: str, kind: Kind, received: Any) -> None:
        self._arrived.append((topic, self._wire.from_ros(received, kind)))

    def _profile(self, depth: int, kept: bool, *, is_reliable: bool) -> Any:
        qos = self._qos
        reliable, best_effort = qos.ReliabilityPolicy.RELIABLE, qos.ReliabilityPolicy.BEST_EFFORT
        later, now = qos.DurabilityPolicy.TRANSIENT_LOCAL, qos.DurabilityPolicy.VOLATILE
        reliability = reliable if is_reliable else best_effort
        return qos.QoSProfile(depth=depth, reliability=reliability, durability=later if kept else now)
