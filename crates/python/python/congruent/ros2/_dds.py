"""CycloneDDS, as the PyPI package ``cyclonedds`` has it: ROS 2 without an installation of ROS. Tested with 11.0.1."""

# cyclonedds may be missing where types are checked.
# mypy: disable-error-code="import-not-found"

from __future__ import annotations

from typing import Any

from cyclonedds.core import DDSException, InstanceState, Policy, Qos, ReadCondition, SampleState, ViewState, WaitSet
from cyclonedds.domain import DomainParticipant
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration

from . import _idl
from ._messages import Kind, Message, Unreadable
from ._transport import RosError, refuse_unless_writable
from ._wire import Wire

# Messages that wait for `take`: 20 s at 500 Hz. Without a history only the last one of those would be kept.
READ_DEPTH = 10_000
# Messages that wait for a slow reader, as tf2 has them. Few enough that a writer never waits for a reader that was killed.
WRITE_DEPTH = 100
# A message is taken by itself, so that one whose bytes are damaged does not take others with it; this many per call.
MOST_PER_TAKE = 1_000


def _read_qos(kept: bool) -> Qos:
    """A best-effort reader gets the messages of best-effort and of reliable writers; a reliable one would get nothing from a driver
    that publishes as best effort. Messages that are kept for later readers come from reliable writers alone."""
    durability = Policy.Durability.TransientLocal if kept else Policy.Durability.Volatile
    reliability = Policy.Reliability.Reliable(duration(milliseconds=100)) if kept else Policy.Reliability.BestEffort
    return Qos(reliability, durability, Policy.History.KeepLast(READ_DEPTH))


def _write_qos(kept: bool) -> Qos:
    """As ROS publishes by default: reliable, so that readers of both sorts get the messages."""
    durability = Policy.Durability.TransientLocal if kept else Policy.Durability.Volatile
    history = Policy.History.KeepLast(1 if kept else WRITE_DEPTH)
    # ROS knows the first version of the encoding alone.
    encoding = Policy.DataRepresentation(use_cdrv0_representation=True)
    return Qos(Policy.Reliability.Reliable(duration(milliseconds=100)), durability, history, encoding)


class DdsTransport:
    """A participant of the domain ``domain``, the ROS_DOMAIN_ID."""

    def __init__(self, domain: int) -> None:
        try:
            self._participant = DomainParticipant(domain)
        except DDSException as error:
            raise RosError(f"CycloneDDS cannot join domain {domain}: {error}; is CYCLONEDDS_URI right?") from error
        self._waiting = WaitSet(self._participant)
        self._wire = Wire(_idl)
        self._readers: dict[str, tuple[Kind, Any, Any]] = {}
        self._writers: dict[str, Any] = {}

    def subscribe(self, topic: str, kind: Kind, *, kept: bool = False) -> None:
        """See ``Transport``."""
        reader = DataReader(self._participant, self._topic(topic, kind), qos=_read_qos(kept))
        arrived = ReadCondition(reader, SampleState.Any | ViewState.Any | InstanceState.Any)
        self._waiting.attach(arrived)
        self._readers[topic] = (kind, reader, arrived)

    def unsubscribe(self, topic: str) -> None:
        """See ``Transport``."""
        _, reader, arrived = self._readers.pop(topic)
        self._waiting.detach(arrived)
        del arrived, reader

    def take(self, timeout_s: float) -> list[tuple[str, Message | Unreadable]]:
        """See ``Transport``."""
        self._waiting.wait(duration(seconds=timeout_s))
        taken: list[tuple[str, Message | Unreadable]] = []
        for topic, (kind, reader, _) in self._readers.items():
            for _ in range(MOST_PER_TAKE):
                try:
                    samples = reader.take(N=1)
                except Exception as error:  # what a decoder of damaged bytes raises is not documented
                    taken.append((topic, Unreadable(f"{type(error).__name__}: {error}")))
                    continue
                if not samples:
                    break
                # A sample of another class says that a publisher has ended.
                if isinstance(samples[0], self._wire.classes[kind]):
                    taken.append((topic, self._wire.from_ros(samples[0], kind)))
        return taken

    def publishers(self, topic: str) -> int:
        """See ``Transport``."""
        return len(self._readers[topic][1].get_matched_publications())

    def advertise(self, topic: str, kind: Kind, *, kept: bool = False) -> None:
        """See ``Transport``."""
        refuse_unless_writable(topic, kind)
        self._writers[topic] = DataWriter(self._participant, self._topic(topic, kind), qos=_write_qos(kept))

    def publish(self, topic: str, message: Message) -> None:
        """See ``Transport``."""
        self._writers[topic].write(self._wire.to_ros(message))

    def advertised(self) -> set[str]:
        """See ``Transport``."""
        return set(self._writers)

    def close(self) -> None:
        """See ``Transport``."""
        self._readers.clear()
        self._writers.clear()
        del self._waiting, self._participant

    def _topic(self, topic: str, kind: Kind) -> Any:
        # On DDS, ROS puts `rt` before the names of topics.
        return Topic(self._participant, f"rt{topic}", self._wire.classes[kind])
