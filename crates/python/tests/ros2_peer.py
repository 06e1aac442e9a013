"""A driver of a robot, in a process of its own: joint states at a steady rate, for the tests of the bridge."""

import argparse
import math
import time

from congruent.ros2._messages import JointState, Kind
from congruent.ros2._transport import open_transport

JOINTS = [f"{joint}_joint" for joint in ("shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3")]
NEVER = 1_000_000
# The elbow turns to pi.
BEYOND_LIMIT_RAD = 3.5


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--hz", type=float, default=500.0)
    parser.add_argument("--count", type=int, default=NEVER)
    parser.add_argument("--readers", type=int, default=2)
    parser.add_argument("--beyond-at", type=int, default=NEVER)
    parser.add_argument("--back-at", type=int, default=NEVER)
    parser.add_argument("--damaged-at", type=int, default=NEVER)
    given = parser.parse_args()
    transport = open_transport("cyclonedds")
    transport.advertise("/joint_states", Kind.JOINT_STATE)
    writer = transport._writers["/joint_states"]  # type: ignore[attr-defined]
    # What is sent before a reader has found the writer is not for it. The readers are the test and the bridge.
    while len(writer.get_matched_subscriptions()) < given.readers:
        time.sleep(0.01)
    time.sleep(1.0)
    started_s = time.monotonic()
    for number in range(given.count):
        time.sleep(max(0.0, started_s + number / given.hz - time.monotonic()))
        turn = 0.1 * math.sin(number / given.hz)
        q = [turn, -1.0, BEYOND_LIMIT_RAD if given.beyond_at <= number < given.back_at else 1.0, 0.0, 0.1, 0.2]
        names = JOINTS[:4] if number == given.damaged_at else JOINTS
        transport.publish("/joint_states", JointState(time.time(), names, q, [0.0] * 6))
    # All that was sent has to be read before the process ends.
    time.sleep(1.0)


if __name__ == "__main__":
    main()
