"""Poses of all links as TF."""

from __future__ import annotations

from collections.abc import Mapping

from .._native import Robot
from ..engines._loaded import floats, quaternion_of
from ._messages import Transform, Transforms


def transforms(robot: Robot, q: Mapping[str, float], time_s: float, prefix: str = "") -> Transforms:
    """Each link in the base, which is the frame that the robot's own TF has as well. Joints that are not in ``q`` are at 0. With a
    prefix the base itself is a frame, too, so that a viewer finds every link under its prefix."""
    own = {joint: q.get(joint, 0.0) for joint in robot.joints}
    found = []
    for link in robot.links:
        if link != robot.base or prefix:
            pose = robot.fk(own, link)
            turn = quaternion_of(pose[:3, :3])
            found.append(Transform(time_s, robot.base, prefix + link, floats(pose[:3, 3]), turn))
    return Transforms(found)
