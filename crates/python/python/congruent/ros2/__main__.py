"""``python -m congruent.ros2``: the command line."""

from __future__ import annotations

import argparse
import signal
import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from types import FrameType

from .._errors import CongruentError
from .._native import Robot
from ._judge import Judge, command_of
from ._play import Player, read_motion
from ._transport import RosError, open_transport
from ._watch import PoseFrame, Watch, WatchOptions

TOPICS = ("joint_states", "tf", "tf_static", "robot_description", "diagnostics")
# Exit codes of the command: bad input, and what Ctrl-C ends with in a shell.
BAD_INPUT, INTERRUPTED = 2, 130


def main(arguments: Sequence[str] | None = None, judge: Sequence[str] | None = None) -> int:
    """Does what the arguments say, and gives the exit code. ``judge`` is another command line of the judge, for tests."""
    options = _parser().parse_args(arguments)
    try:
        return _watch(options, judge) if options.command == "watch" else _play(options)
    except (RosError, CongruentError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return BAD_INPUT
    except KeyboardInterrupt:
        return INTERRUPTED


def _watch(options: argparse.Namespace, judge: Sequence[str] | None) -> int:
    robot = Robot(options.robot)
    frames = dict(_pose_frame(text, "controller", robot) for text in options.controller_frame)
    frames |= dict(_pose_frame(text, "measured", robot) for text in options.measured_frame)
    topics = _topics(options.topic)
    # The judge reads it when the robot moves, which is late for a mistake in its name.
    if options.scenario is not None and not Path(options.scenario).exists():
        raise RosError(f"{options.scenario} does not exist")
    transport = open_transport(options.backend)
    is_stopped = _stopped_by_signals()
    print(f"{robot.name}: joint states on {topics['joint_states']}, verdicts on {topics['diagnostics']}; Ctrl-C ends", flush=True)
    running = Judge(judge or command_of(options.robot, options.scenario, options.until_violation))
    try:
        watch_options = WatchOptions(options.robot, topics, frames, options.model_prefix, options.model_rate, options.stale_after)
        return Watch(robot, running, transport, watch_options).run(is_stopped)
    finally:
        running.finish()
        transport.close()


def _play(options: argparse.Namespace) -> int:
    topics = _topics(options.topic)
    transport = open_transport(options.backend)
    try:
        with tempfile.TemporaryDirectory() as folder:
            motion = read_motion(Path(options.file), options.robot, Path(folder))
        return _play_motion(Player(motion, transport, topics), options, topics)
    finally:
        transport.close()


def _play_motion(player: Player, options: argparse.Namespace, topics: dict[str, str]) -> int:
    is_stopped = _stopped_by_signals()
    named = [topics[name] for name in ("joint_states", "tf", "robot_description")]
    print(f"plays {player.duration_s / options.rate:.4g} s on {', '.join(named)}; Ctrl-C ends", flush=True)
    while True:
        sent = player.play(options.rate, options.hz, is_stopped)
        print(f"{'stopped' if is_stopped() else 'played'}: {sent} joint states", flush=True)
        if is_stopped() or not options.loop:
            return INTERRUPTED if is_stopped() else 0


def _stopped_by_signals() -> Callable[[], bool]:
    """Whether Ctrl-C or SIGTERM has come. A second one ends the process at once."""
    stopped = []

    def stop(number: int, frame: FrameType | None) -> None:
        stopped.append(number)
        signal.signal(number, signal.SIG_DFL)

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, stop)
    return lambda: bool(stopped)


def _topics(given: list[str]) -> dict[str, str]:
    topics = {name: f"/{name}" for name in TOPICS}
    for text in given:
        name, equals, topic = text.partition("=")
        if name not in topics or not equals or not topic.startswith("/"):
            raise RosError(f"--topic {text}: NAME=/TOPIC, where NAME is one of {', '.join(TOPICS)}")
        topics[name] = topic
    return topics


def _pose_frame(text: str, origin: str, robot: Robot) -> tuple[str, PoseFrame]:
    frame, equals, link = text.partition("=")
    if not equals or link not in robot.links:
        raise RosError(f"--{origin}-frame {text}: FRAME=LINK, where LINK is one of {', '.join(robot.links)}")
    return frame, PoseFrame(link, origin)


def _positive(text: str) -> float:
    value = float(text)
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text} is no number above 0")
    return value


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m congruent.ros2",
        description="Judges a robot that runs, and plays scenarios and logs, over ROS 2. It observes and reports: it never commands"
        " a robot. ROS_DOMAIN_ID is the domain; CYCLONEDDS_URI are the settings of CycloneDDS.",
    )
    commands = parser.add_subparsers(dest="command", required=True, metavar="watch|play")
    watch = commands.add_parser(
        "watch",
        help="judge joint states and TF as they arrive",
        description="Judges joint states and TF by `congruent watch` as they arrive. Verdicts are diagnostics, once a second and at"
        " once if something changes; the model is in TF beside the robot. The exit code is that of `congruent watch`.",
    )
    watch.add_argument("robot", metavar="ROBOT", help="a folder with robot.toml, a robot file, a URDF or an MJCF")
    watch.add_argument("--scenario", metavar="FILE", help="a scenario with checks, obstacles and zones")
    watch.add_argument("--until-violation", action="store_true", help="end with the first violation")
    watch.add_argument("--stale-after", type=_positive, default=1.0, metavar="S", help="joint states are stale after S seconds (default 1)")
    watch.add_argument("--model-prefix", default="model/", metavar="TEXT", help="of the frames of the model (default model/)")
    watch.add_argument("--model-rate", type=_positive, default=30.0, metavar="HZ", help="TF of the model, at most (default 30)")
    text = "this frame of TF is the pose of the link {} (may be given several times)"
    for origin, who in (("controller", "by the robot's controller"), ("measured", "as a tracker or a camera measures it")):
        watch.add_argument(f"--{origin}-frame", action="append", default=[], metavar="FRAME=LINK", help=text.format(who))
    play = commands.add_parser(
        "play",
        help="publish a scenario or a log as joint states, TF and URDF",
        description="Runs a scenario, or reads a log, and publishes its joint positions as joint states, the poses of all links as"
        " TF, and the URDF, with the time of now. Nothing else is ever published.",
    )
    play.add_argument("file", metavar="FILE", help="a scenario (.toml), or a log: MCAP, CSV, Parquet, a folder of rosbag2")
    play.add_argument("--robot", metavar="ROBOT", help="the robot of a log")
    play.add_argument("--rate", type=_positive, default=1.0, help="how many times as fast (default 1)")
    play.add_argument("--hz", type=_positive, default=100.0, help="at most so many joint states per second (default 100)")
    play.add_argument("--loop", action="store_true", help="start again at the end")
    for command in (watch, play):
        command.add_argument("--topic", action="append", default=[], metavar="NAME=/TOPIC", help=f"another topic for {', '.join(TOPICS)}")
        backends = ("auto", "cyclonedds", "rclpy")
        command.add_argument("--backend", choices=backends, default="auto", help="by default CycloneDDS if it is installed, then rclpy")
    return parser


if __name__ == "__main__":
    sys.exit(main())
