"""The bridge to ROS 2: processes that talk over the loopback, in a domain of their own for each test."""

from __future__ import annotations

import csv
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import congruent
from congruent.ros2 import __main__ as command
from congruent.ros2._messages import Diagnostics, JointState, Kind, Level, Message, Status, Text, Transform, Transforms, Unreadable
from congruent.ros2._transport import WRITABLE, RosError, Transport, open_transport

pytest.importorskip("cyclonedds")

LOOPBACK = (
    "<CycloneDDS><Domain><General><Interfaces>"
    '<NetworkInterface name="lo" multicast="true"/>'
    "</Interfaces></General></Domain></CycloneDDS>"
)
HERE = Path(__file__).parent
# A machine that does much else is slow; no test waits for so long if all is well.
PATIENCE_S = 90.0
_domains = count(os.getpid() % 90 + 1)


@pytest.fixture(autouse=True)
def domain(monkeypatch: pytest.MonkeyPatch) -> None:
    """A domain of its own, on the loopback alone."""
    monkeypatch.setenv("CYCLONEDDS_URI", LOOPBACK)
    # Above 101 the ports of a domain are those that Linux gives to any program.
    monkeypatch.setenv("ROS_DOMAIN_ID", str(next(_domains) % 100 + 1))


class Process:
    """A process that ends with the test, and what it has printed."""

    def __init__(self, *words: str, cwd: Path) -> None:
        self.process = subprocess.Popen(words, cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def interrupt(self) -> tuple[int, str]:
        """Ctrl-C, then its exit code and what it has printed."""
        self.process.send_signal(signal.SIGINT)
        return self.end()

    def end(self) -> tuple[int, str]:
        printed, _ = self.process.communicate(timeout=PATIENCE_S)
        return self.process.returncode, printed

    def kill(self) -> None:
        self.process.kill()
        self.process.wait()


@pytest.fixture
def start(root: Path) -> Iterator[Callable[..., Process]]:
    """Starts processes in the root of the repository."""
    started: list[Process] = []

    def start(*words: str) -> Process:
        started.append(Process(sys.executable, *words, cwd=root))
        return started[-1]

    yield start
    for process in started:
        process.kill()


WITH_STAND_IN = """
import sys
from congruent.ros2.__main__ import main
sys.exit(main(sys.argv[2:], judge=[sys.executable, sys.argv[1], *sys.argv[3:]]))
"""


@pytest.fixture
def watch(start: Callable[..., Process]) -> Callable[..., Process]:
    """Starts ``watch`` with the stand-in of the judge."""
    return lambda *words: start("-c", WITH_STAND_IN, str(HERE / "watch_stand_in.py"), "watch", *words)


@pytest.fixture
def driver(start: Callable[..., Process]) -> Callable[..., Process]:
    """Starts a driver."""
    return lambda *words: start(str(HERE / "ros2_peer.py"), *words)


class Listener:
    """What arrives on some topics, while a test waits for something."""

    def __init__(self, transport: Transport) -> None:
        self._transport = transport
        self.heard: list[tuple[str, Message | Unreadable]] = []

    def until(self, is_done: Callable[[], Any], what: str) -> Any:
        """Waits for something, and gives it."""
        end_s = time.monotonic() + PATIENCE_S
        while time.monotonic() < end_s:
            self.heard += self._transport.take(0.05)
            if done := is_done():
                return done
        raise AssertionError(f"{what} has not come; the last that came: {self.heard[-3:]}")

    def of(self, kind: type) -> list[Any]:
        """All messages of a class."""
        return [message for _, message in self.heard if isinstance(message, kind)]

    def status(self, name: str) -> Status | None:
        """The latest status of a name."""
        for report in reversed(self.of(Diagnostics)):
            for status in report.statuses:
                if status.name == f"congruent: ur5e: {name}":
                    return status
        return None

    def until_level(self, name: str, level: Level) -> Status:
        """Waits until a status has a level."""
        self.heard.clear()

        def status() -> Status | None:
            found = self.status(name)
            return found if found is not None and found.level is level else None

        return self.until(status, f"{level.name} of {name}")  # type: ignore[no-any-return]


@pytest.fixture
def listener() -> Iterator[Listener]:
    transport = open_transport()
    transport.subscribe("/diagnostics", Kind.DIAGNOSTICS)
    transport.subscribe("/tf", Kind.TRANSFORMS)
    transport.subscribe("/joint_states", Kind.JOINT_STATE)
    transport.subscribe("/robot_description", Kind.TEXT, kept=True)
    yield Listener(transport)
    transport.close()


# Bytes by the package rosbags 0.11.9, which knows the messages of ROS 2 Jazzy.
TIME = "0c00000080b2e60e"
BYTES: dict[str, tuple[Message, Kind]] = {
    f"00010000{TIME}0100000000000000020000000200000061000000040000006263640002000000000000000000f03f"
    "000000000000004002000000000000000000000000000840000000000000104000000000": (
        JointState(12.25, ["a", "bcd"], [1.0, 2.0], [3.0, 4.0]),
        Kind.JOINT_STATE,
    ),
    f"0001000001000000{TIME}05000000626173650000000006000000746f6f6c3000000000000000000000000000f03f00000000000000400000000000000840"
    "000000000000000000000000000000000000000000"
    "00f03f0000000000000000": (Transforms([Transform(12.25, "base", "tool0", [1.0, 2.0, 3.0], [0.0, 0.0, 0.0, 1.0])]), Kind.TRANSFORMS),
    f"00010000{TIME}01000000000000000100000003000000020000006e000000030000006d6d000005000000757235650000000001000000020000006b000000"
    "020000007600": (Diagnostics(12.25, [Status(Level.STALE, "n", "mm", "ur5e", {"k": "v"})]), Kind.DIAGNOSTICS),
    "00010000050000007572646600": (Text("urdf"), Kind.TEXT),
}


def test_the_bytes_are_those_of_ros() -> None:
    from congruent.ros2 import _idl
    from congruent.ros2._wire import Wire

    wire = Wire(_idl)
    for text, (message, kind) in BYTES.items():
        written = wire.to_ros(message).serialize(use_version_2=False)
        # The last two bits of the header say how many bytes were added at the end, which ROS does not need.
        assert written[4 : len(text) // 2] == bytes.fromhex(text)[4:] and not any(written[len(text) // 2 :]), kind
        assert wire.from_ros(wire.classes[kind].deserialize(bytes.fromhex(text)), kind) == message


def test_every_joint_state_is_judged(watch: Any, driver: Any, listener: Listener) -> None:
    watching = watch("robots/ur5e")
    listener.until_level("joint states", Level.STALE)
    assert driver("--hz", "500", "--count", "2500").end() == (0, "")
    arrived = listener.until_level("joint states", Level.STALE)
    assert arrived.values["messages"] == "2500", arrived
    listener.heard.clear()
    code, printed = watching.interrupt()
    judge = listener.until(lambda: (found := listener.status("judge")) and "samples" in found.values and found, "the end of the judge")
    assert (code, judge.values, judge.message) == (0, {"verdict": "pass", "samples": "2500"}, "has finished, verdict pass"), printed


def test_a_violation_is_an_error_with_its_joint(watch: Any, driver: Any, listener: Listener) -> None:
    watching = watch("robots/ur5e")
    driver("--beyond-at", "300", "--back-at", "1000")
    violated = listener.until_level("limits", Level.ERROR)
    assert violated.message == "violated: 20.5 deg beyond the limit at elbow_joint" and violated.robot == "ur5e"
    assert violated.values["where"] == "elbow_joint" and violated.values["value"] == "0.358407346 rad"
    assert violated.values["limit"] == "<= 1e-06 rad" and float(violated.values["time_s"]) > 1.7e9
    assert listener.until_level("limits", Level.OK).message == "recovered: margin 123 deg at elbow_joint"
    code, printed = watching.interrupt()
    assert code == 1 and "ERROR ur5e: limits: violated: 20.5 deg beyond" in printed, printed


def test_the_first_violation_ends_the_watch_if_wanted(watch: Any, driver: Any, listener: Listener) -> None:
    watching = watch("robots/ur5e", "--until-violation")
    driver("--beyond-at", "300")
    violated = listener.until_level("limits", Level.ERROR)
    assert "elbow_joint" in violated.message
    assert watching.end()[0] == 1


def has_watch() -> bool:
    words = [sys.executable, "-m", "congruent", "watch", "--help"]
    return subprocess.run(words, capture_output=True).returncode == 0


def test_the_command_judges(start: Any, driver: Any, listener: Listener) -> None:
    if not has_watch():
        pytest.skip("the command has no `watch`")
    watching = start("-m", "congruent.ros2", "watch", "robots/ur5e", "--until-violation")
    driver("--beyond-at", "1000")
    listener.until_level("judge", Level.OK)
    violated = listener.until_level("limits", Level.ERROR)
    assert "elbow_joint" in violated.message, violated
    assert watching.end()[0] == 1


def test_a_killed_driver_is_stale_until_it_comes_back(watch: Any, driver: Any, listener: Listener) -> None:
    watching = watch("robots/ur5e")
    waits = listener.until_level("joint states", Level.STALE)
    assert waits.message.startswith("no joint states on /joint_states yet, after") and "nobody publishes it" in waits.message
    first = driver()
    listener.until_level("joint states", Level.OK)
    listener.until_level("limits", Level.OK)
    first.kill()
    stale = listener.until_level("joint states", Level.STALE)
    assert stale.message.startswith("no joint states on /joint_states for ")
    assert listener.until_level("limits", Level.STALE).message.endswith("before: not violated")
    driver()
    listener.until_level("joint states", Level.OK)
    listener.until_level("limits", Level.OK)
    code, printed = watching.interrupt()
    assert code == 0 and "Traceback" not in printed, printed
    levels = [line.split()[0] for line in printed.splitlines() if "joint states:" in line]
    # More of them if the machine itself has paused for a second.
    assert levels[:2] == ["STALE", "OK"] and len(levels) >= 4, printed


def test_a_joint_that_has_lost_its_value_makes_the_checks_stale() -> None:
    from congruent.ros2._statuses import Statuses

    statuses = Statuses("ur5e", ["elbow_joint", "wrist_1_joint"], "/joint_states", 1.0, 0.0)
    statuses.arrived(["elbow_joint", "wrist_1_joint"], 0.0)
    statuses.judged({"kind": "started", "checks": ["limits"], "rate_hz": 100.0, "poses": []}, 0.1)

    def levels(now_s: float) -> dict[str, tuple[Level, str]]:
        return {status.name.rpartition(": ")[2]: (status.level, status.message) for status in statuses.all(now_s)}

    assert levels(0.5)["limits"][0] is Level.OK
    statuses.arrived(["elbow_joint"], 2.0)
    lost = levels(2.0)
    assert lost["joint states"] == (Level.WARN, "no value of wrist_1_joint for 2.0 s: nothing is judged without it")
    assert lost["limits"][0] is Level.STALE
    statuses.arrived(["elbow_joint", "wrist_1_joint"], 2.5)
    assert levels(2.6)["joint states"][0] is Level.OK and levels(2.6)["limits"][0] is Level.OK


def test_what_the_judge_says_is_said() -> None:
    """Lines of ``congruent watch`` that the stand-in does not say."""
    from congruent.ros2._statuses import Statuses

    statuses = Statuses("ur5e", [], "/joint_states", 1.0, 0.0)

    def status(name: str) -> Status:
        return {status.name.rpartition(": ")[2]: status for status in statuses.all(0.5)}[name]

    statuses.arrived(["elbow_joint"], 0.0)
    statuses.judged({"kind": "started", "checks": ["pose", "clearance", "pose"], "rate_hz": 499.123456789, "poses": []}, 0.1)
    assert status("judge").values == {"rate_hz": "499.123457", "checks": "pose, clearance, pose"}
    pose = {"quantity": "position_error", "limit": 0.002, "unit": "m", "bound": "at_most", "value": 0.0071, "where": "tool0"}
    statuses.judged({"kind": "violation", "check": "pose", "number": 3, "time_s": 12.5, **pose}, 0.2)
    assert status("pose 3").message == "violated: position error 7.1 mm at tool0, limit <= 2 mm"
    assert status("pose 1").level is Level.OK and status("joint states").level is Level.OK
    statuses.judged({"kind": "gap", "from_s": 12.0, "to_s": 12.18, "cause": "no_samples"}, 0.3)
    assert status("joint states").message == "gaps: nothing came for 0.18 s, nothing is judged in it"
    statuses.judged({"kind": "gap", "from_s": 12.0, "to_s": 2.0, "cause": "clock_went_back"}, 0.3)
    statuses.judged({"kind": "bad_line", "line": 7, "message": "no number", "text": "{"}, 0.3)
    statuses.judged({"kind": "left_out", "message": "controller poses began too late"}, 0.3)
    statuses.judged({"kind": "lost", "what": "samples", "message": "the queue is full", "samples": 3}, 0.3)
    statuses.judged({"kind": "something_new"}, 0.3)
    values = status("joint states").values
    assert values["gaps"] == "2, the last: the clock of the sender went back by 10 s, a new part begins"
    assert values["lines refused"] == "1, the last: no number" and values["samples lost"] == "1, the last: 3 samples: the queue is full"
    assert values["left out"] == "1, the last: controller poses began too late"
    clearance = {"quantity": "distance", "limit": 0.02, "unit": "m", "bound": "at_least", "worst": {"value": 0.01, "subject": "a--b", "time_s": 1.0}}
    report = {"checks": [{"status": "pass"}, {"status": "fail", "measures": [clearance]}, {"status": "fail", "measures": []}]}
    statuses.judged({"kind": "finished", "verdict": "not_as_expected", "counts": {"samples": 9, "late": 0}, "report": report}, 0.4)
    assert status("clearance").message == "failed: distance 10 mm at a--b, limit >= 20 mm"
    assert status("pose 3").message.startswith("violated")
    assert status("judge").values == {"verdict": "not_as_expected", "samples": "9"}
    statuses.judged({"error": "bad input", "findings": [{"message": "unknown joint"}]}, 0.4)
    statuses.ended(2)
    assert status("judge").message == "has ended with exit code 2: unknown joint; nothing is judged any more"


def test_a_malformed_message_does_not_end_the_watch(watch: Any, driver: Any, listener: Listener) -> None:
    watching = watch("robots/ur5e")
    driver("--damaged-at", "100")
    warned = listener.until_level("joint states", Level.WARN)
    assert warned.message == "malformed messages: 4 names, 6 positions, 6 velocities, 0 efforts"
    fine = listener.until_level("joint states", Level.OK)
    assert fine.values["malformed messages"] == "1, the last: 4 names, 6 positions, 6 velocities, 0 efforts"
    assert watching.interrupt()[0] == 0


def test_joint_states_of_another_robot_are_none(watch: Any, driver: Any, listener: Listener) -> None:
    watching = watch("robots/rrr_arm")
    driver("--hz", "50")

    def said() -> str | None:
        reports = [status for report in listener.of(Diagnostics) for status in report.statuses if "joint states" in status.name]
        return reports[-1].message if reports and "messages of other joints" in reports[-1].values else None

    message = listener.until(said, "messages of other joints")
    assert "no joint states on /joint_states yet" in message and "messages of other joints: shoulder_pan_joint, " in message
    assert watching.interrupt()[0] == 4


def test_bytes_of_another_type_do_not_end_a_transport() -> None:
    """ROS sends no types that DDS could compare: the bytes of any type may come under the name."""
    from congruent.ros2 import _dds, _idl

    transport = open_transport()
    transport.subscribe("/joint_states", Kind.JOINT_STATE)

    class Reader:
        """Gives what a damaged message raises, then nothing."""

        def __init__(self) -> None:
            self.damaged = [True]

        def take(self, N: int) -> list[Any]:
            if self.damaged:
                self.damaged.pop()
                _idl.JointState.deserialize(b"\x00\x01\x00\x00\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff")
            return []

    assert isinstance(transport, _dds.DdsTransport)
    kind, _, arrived = transport._readers["/joint_states"]
    transport._readers["/joint_states"] = (kind, Reader(), arrived)
    ((topic, message),) = transport.take(0.01)
    assert topic == "/joint_states" and isinstance(message, Unreadable)
    transport.close()


def test_the_model_is_in_tf(watch: Any, driver: Any, listener: Listener, ur5e: congruent.Robot) -> None:
    watch("robots/ur5e", "--model-prefix", "ghost/")
    driver("--hz", "50")
    model = listener.until(lambda: listener.of(Transforms), "TF")[-1].transforms
    states = {state.time_s: state for state in listener.of(JointState)}
    listener.until(lambda: any(state.time_s == model[0].time_s for state in listener.of(JointState)), "its joint states")
    states = {state.time_s: state for state in listener.of(JointState)}
    state = states[model[0].time_s]
    assert [one.child for one in model] == [f"ghost/{link}" for link in ur5e.links]
    for one in model:
        pose = ur5e.fk(dict(zip(state.name, state.position)), one.child.removeprefix("ghost/"))
        assert one.frame == "base_link" and np.allclose(one.translation_m, pose[:3, 3], atol=1e-12)
        assert np.allclose(rotation(one.quaternion_wxyz), pose[:3, :3], atol=1e-12)


def rotation(quaternion_wxyz: list[float]) -> Any:
    w, x, y, z = quaternion_wxyz
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]


def test_the_published_description_is_compared(watch: Any, start: Any, listener: Listener, root: Path) -> None:
    watching = watch("robots/ur5e")
    urdf = root / "robots/ur5e/ur5e.urdf"
    publishing = start("-c", DESCRIPTION, str(urdf), "a", "a")
    assert "SAME ROBOT" in listener.until_level("robot description", Level.OK).message
    publishing.kill()
    publishing = start("-c", DESCRIPTION, str(urdf), '<mass value="2.846"/>', '<mass value="2846"/>')
    assert "forearm_link: mass 2.846 kg" in listener.until_level("robot description", Level.ERROR).message
    publishing.kill()
    start("-c", DESCRIPTION, str(urdf), "<robot", "<robo")
    assert "cannot be compared" in listener.until_level("robot description", Level.WARN).message
    assert watching.interrupt()[0] == 4


DESCRIPTION = """
import pathlib, sys, time
from congruent.ros2._messages import Kind, Text
from congruent.ros2._transport import open_transport
transport = open_transport()
transport.advertise("/robot_description", Kind.TEXT, kept=True)
file, before, after = sys.argv[1:]
transport.publish("/robot_description", Text(pathlib.Path(file).read_text().replace(before, after)))
time.sleep(1000)
"""


def test_poses_of_tf_have_their_origin(
    watch: Any, start: Any, listener: Listener, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    lines = tmp_path / "lines.jsonl"
    monkeypatch.setenv("STAND_IN_LINES", str(lines))
    watching = watch("robots/ur5e", "--measured-frame", "tracker/tool=tool0")
    start("-c", POSES)
    expected = {("derived", "base_link", "wrist_3_link"), ("controller", "base", "tool0"), ("measured", "world", "tool0")}

    def poses() -> list[Any]:
        return [json.loads(line) for line in lines.read_text().splitlines()] if lines.exists() else []

    def origins() -> set[Any]:
        return {(line["origin"], line["pose"]["frame"], line["pose"]["child"]) for line in poses()}

    listener.until(lambda: len(origins()) >= 3 and len(poses()) > 6, "poses of three origins")
    assert origins() == expected
    assert poses()[0]["pose"]["translation_m"] == [0.1, 0.2, 0.3] and poses()[0]["pose"]["quaternion_wxyz"] == [1.0, 0.0, 0.0, 0.0]
    assert watching.interrupt()[0] == 0


POSES = """
import time
from congruent.ros2._messages import Kind, Transform, Transforms
from congruent.ros2._transport import open_transport
transport = open_transport()
transport.advertise("/tf", Kind.TRANSFORMS)
frames = [("base_link", "wrist_3_link"), ("base", "tool0_controller"), ("world", "tracker/tool"), ("world", "table"), ("base_link", "model/tool0")]
while True:
    for frame, child in frames:
        transport.publish("/tf", Transforms([Transform(time.time(), frame, child, [0.1, 0.2, 0.3], [1.0, 0.0, 0.0, 0.0])]))
        time.sleep(0.1)
"""


def publications() -> dict[str, str]:
    """The topics that are published in the domain, with their types, by their names on DDS."""
    from cyclonedds.builtin import BuiltinDataReader, BuiltinTopicDcpsPublication
    from cyclonedds.domain import DomainParticipant

    participant = DomainParticipant(int(os.environ["ROS_DOMAIN_ID"]))
    reader = BuiltinDataReader(participant, BuiltinTopicDcpsPublication)
    end_s, found = time.monotonic() + 3.0, {}
    while time.monotonic() < end_s:
        found |= {sample.topic_name: sample.type_name for sample in reader.take(100) if hasattr(sample, "topic_name")}
        time.sleep(0.1)
    return found


def test_nothing_that_moves_a_robot_is_published(watch: Any, start: Any, driver: Any, listener: Listener, root: Path) -> None:
    assert set(WRITABLE) == {"joint_states", "tf", "robot_description", "diagnostics"}
    transport = open_transport()
    for topic in ("/joint_command", "/arm_controller/joint_trajectory", "/joint_states_desired", "/joint_states/command"):
        with pytest.raises(RosError, match=f"{topic} is not published"):
            transport.advertise(topic, Kind.JOINT_STATE)
    with pytest.raises(RosError, match="is not published"):
        transport.advertise("/diagnostics", Kind.TEXT)
    transport.advertise("/played/joint_states", Kind.JOINT_STATE)
    assert transport.advertised() == {"/played/joint_states"}
    transport.close()

    watching = watch("robots/ur5e")
    listener.until_level("joint states", Level.STALE)
    diagnostics = {"rt/diagnostics": "diagnostic_msgs::msg::dds_::DiagnosticArray_"}
    tf = {"rt/tf": "tf2_msgs::msg::dds_::TFMessage_"}
    assert publications() == diagnostics | tf
    code, printed = watching.interrupt()
    assert code == 4 and "nothing was judged: no joint states came" in printed, printed
    start("-m", "congruent.ros2", "play", "scenarios/ur5e_pick.toml", "--loop")
    listener.until(lambda: listener.of(JointState), "joint states")
    # Those of the first process were withdrawn when it ended.
    joint_states = {"rt/joint_states": "sensor_msgs::msg::dds_::JointState_"}
    assert publications() == joint_states | tf | {"rt/robot_description": "std_msgs::msg::dds_::String_"}
    refused = start("-m", "congruent.ros2", "play", "scenarios/ur5e_pick.toml", "--topic", "joint_states=/joint_command")
    code, printed = refused.end()
    assert code == 2 and "/joint_command is not published: nothing but" in printed


def trajectory(root: Path, scenario: str, folder: Path) -> list[dict[str, str]]:
    words = [sys.executable, "-m", "congruent", "run", scenario, "--set", "output.trajectory=csv", "--out", str(folder), "-q"]
    subprocess.run(words, cwd=root, check=True, capture_output=True)
    with next(folder.glob("*/trajectory.csv")).open(newline="") as file:
        return list(csv.DictReader(file))


def test_a_scenario_is_played(start: Any, listener: Listener, root: Path, tmp_path: Path) -> None:
    playing = start("-m", "congruent.ros2", "play", "scenarios/rrr_arm_wave.toml", "--rate", "2")
    code, printed = playing.end()
    listener.until(lambda: len(listener.of(JointState)) >= 301 and listener.of(Text), "all joint states")
    assert code == 0 and "rrr_arm_wave: pass" in printed and "played: 301 joint states" in printed, printed
    written = trajectory(root, "scenarios/rrr_arm_wave.toml", tmp_path)
    states = listener.of(JointState)
    assert len(states) == 301
    # Twice as fast, 100 joint states per second: every 20th row of 1 ms.
    for state, row in zip(states, written[::20]):
        expected = {name: float(row[f"{name}.measured_q_{'m' if 'gripper' in name else 'rad'}"]) for name in state.name}
        assert dict(zip(state.name, state.position)) == expected and len(expected) == 6
    stamps = [state.time_s for state in states]
    assert stamps == sorted(stamps) and stamps[-1] - stamps[0] > 2.9
    assert listener.of(Text)[0].text == (root / "robots/rrr_arm/rrr_arm.urdf").read_text()
    robot = congruent.Robot(root / "robots/rrr_arm")
    tip = {one.child: one for one in listener.of(Transforms)[-1].transforms}[robot.tip]
    assert np.allclose(tip.translation_m, robot.fk(dict(zip(states[-1].name, states[-1].position)))[:3, 3], atol=1e-9)


def test_a_log_is_played(start: Any, listener: Listener, root: Path) -> None:
    log = "docs/examples/log/joints.csv"
    playing = start("-m", "congruent.ros2", "play", log, "--robot", "robots/ur5e")
    code, printed = playing.end()
    assert code == 0 and "played: 18 joint states" in printed, printed
    listener.until(lambda: len(listener.of(JointState)) >= 18, "all joint states")
    with (root / log).open(newline="") as file:
        # A row is repeated, and one has no value of a joint, which is interpolated.
        expected = {float(row["time_s"]): row["ur_shoulder_pan_joint_position"] for row in csv.DictReader(file)}
    played = [dict(zip(state.name, state.position))["shoulder_pan_joint"] for state in listener.of(JointState)]
    assert played == [float(value) for value in expected.values()]


def test_a_second_publisher_is_refused(start: Any, driver: Any, listener: Listener) -> None:
    driver("--readers", "1")
    listener.until(lambda: listener.of(JointState), "joint states")
    code, printed = start("-m", "congruent.ros2", "play", "scenarios/ur5e_pick.toml").end()
    assert code == 2 and "/joint_states already has a publisher" in printed, printed


def test_ctrl_c_ends_a_play(start: Any, listener: Listener) -> None:
    playing = start("-m", "congruent.ros2", "play", "scenarios/ur5e_pick.toml", "--loop")
    listener.until(lambda: listener.of(JointState), "joint states")
    code, printed = playing.interrupt()
    assert code == 130 and "stopped: " in printed and "Traceback" not in printed


def test_a_judge_that_fails_ends_the_watch(start: Any, listener: Listener, tmp_path: Path) -> None:
    judge = tmp_path / "judge.py"
    judge.write_text("import sys\nprint('error: it cannot', file=sys.stderr)\nsys.exit(2)\n")
    code, printed = start("-c", WITH_STAND_IN, str(judge), "watch", "robots/ur5e").end()
    assert code == 2 and "error: it cannot" in printed
    assert "ERROR ur5e: judge: has ended with exit code 2; nothing is judged any more" in printed


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["watch", "robots/no_robot"], "does not exist"),
        (["watch", "robots/ur5e", "--topic", "joint_state=/a"], "NAME=/TOPIC, where NAME is one of joint_states, tf"),
        (["watch", "robots/ur5e", "--measured-frame", "tracker=tool"], "FRAME=LINK, where LINK is one of base_link, base"),
        (["watch", "robots/ur5e", "--scenario", "scenarios/no_scenario.toml"], "scenarios/no_scenario.toml does not exist"),
        (["watch", "robots/ur5e", "--backend", "rclpy"], "rclpy is not installed: source /opt/ros/DISTRO/setup.bash"),
        (["play", "docs/examples/log/joints.csv"], "a log needs its robot: --robot ROBOT"),
        (["play", "scenarios/no_scenario.toml"], "scenarios/no_scenario.toml does not exist"),
        (["play", "robots/ur5e"], "robots/ur5e is a robot: play takes a scenario, or a log with --robot robots/ur5e"),
    ],
)
def test_bad_input_has_a_sentence(
    words: list[str], said: str, root: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(root)
    assert command.main(words) == 2
    assert said in capsys.readouterr().err


def test_a_missing_package_has_a_sentence(
    root: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    assert command.main(["watch", str(root / "robots/ur5e")]) == 2
    assert capsys.readouterr().err == "error: cyclonedds is not installed: pip install 'congruent[ros2]'\n"
    monkeypatch.setenv("ROS_DOMAIN_ID", "300")
    assert command.main(["watch", str(root / "robots/ur5e")]) == 2
    assert "ROS_DOMAIN_ID = '300' is no number from 0 to 232" in capsys.readouterr().err


def test_the_judge_gets_its_options() -> None:
    from congruent.ros2._judge import command_of

    words = command_of("robots/ur5e", "checks.toml", True)
    assert words[1:] == ["-m", "congruent", "watch", "robots/ur5e", "--format", "json", "--scenario", "checks.toml", "--until-violation"]
    assert json.dumps(command_of("a", None, False)[1:]) == '["-m", "congruent", "watch", "a", "--format", "json"]'
