//! The pose of the TCP as the controller of a UR writes it.

use crate::event::{EventTime, LoggedPose};

/// The frame of these poses: that of the controller, in which URDFs of these robots have a link.
const FRAME: &str = "base";

/// Position in m and rotation vector in rad, as a pose of a topic.
pub(crate) fn pose_of_ur([x, y, z, rx, ry, rz]: [f64; 6], topic: usize, time: EventTime) -> LoggedPose {
    let angle = (rx * rx + ry * ry + rz * rz).sqrt();
    // sin(angle / 2) / angle, whose limit at 0 is 1 / 2.
    let factor = if angle > 0.0 { libm::sin(angle / 2.0) / angle } else { 0.5 };
    LoggedPose {
        topic,
        time,
        is_first_of_message: true,
        frame: FRAME.to_owned(),
        child: None,
        child_in_frame_m: [x, y, z],
        frame_from_child_wxyz: [libm::cos(angle / 2.0), factor * rx, factor * ry, factor * rz],
    }
}
