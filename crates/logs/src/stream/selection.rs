//! What is taken from a log.

use crate::survey::ClockKind;

/// What is taken from a log, with every name and unit resolved.
#[derive(Debug, Clone, PartialEq)]
pub struct StreamSelection {
    /// The clock by which messages are ordered.
    pub clock: ClockKind,
    /// Time that counts as 0, s from the log time of the first message.
    pub origin_s: f64,
    /// Number of joints of a row.
    pub joints_of_row: usize,
    /// The topics with joint states. The rows have the times of the first.
    pub joints: Vec<SelectedJoints>,
    /// The topics with poses.
    pub poses: Vec<SelectedPoses>,
    /// Rows at these times are taken, s from the origin.
    pub between_s: [f64; 2],
    /// Whether messages come while they are read: none is held back for others that may be earlier.
    pub is_live: bool,
}

/// The joints of a topic.
#[derive(Debug, Clone, PartialEq)]
pub struct SelectedJoints {
    /// The topic.
    pub topic: String,
    /// Whether its states are commanded, not measured.
    pub is_setpoint: bool,
    /// Nothing is interpolated across a longer time without messages.
    pub maximum_gap_s: f64,
    /// Whether its efforts are torques and forces, N m and N: drivers write other things under this name.
    pub effort_is_torque: bool,
    /// The joints that are taken.
    pub joints: Vec<SelectedJoint>,
}

impl StreamSelection {
    /// The longest time between two rows that is no gap: that of the topic whose times they have.
    pub fn maximum_gap_s(&self) -> f64 {
        self.joints.first().map_or(f64::INFINITY, |topic| topic.maximum_gap_s)
    }
}

/// A joint of a topic.
#[derive(Debug, Clone, PartialEq)]
pub struct SelectedJoint {
    /// Its name in the log.
    pub name: String,
    /// Its place in a row.
    pub joint: usize,
    /// What one of the unit of its positions and velocities is in rad or m, and per second.
    pub si_per_unit: f64,
}

/// Poses of one frame in another.
#[derive(Debug, Clone, PartialEq)]
pub struct SelectedPoses {
    /// The topic.
    pub topic: String,
    /// The frame in which they are given.
    pub frame: String,
    /// The frame whose poses they are; `None` for messages that do not name it.
    pub child: Option<String>,
    /// Is added to their times.
    pub offset_s: f64,
    /// Is multiplied by their times and added to them, s/s.
    pub drift: f64,
}
