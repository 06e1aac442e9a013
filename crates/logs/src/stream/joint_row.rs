//! All joints at one instant of a log.

use crate::event::EventTime;

/// The joints at one instant. A joint that no topic has is NaN.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct JointRow {
    /// Time from the origin on, s.
    pub time_s: f64,
    /// The times of the message whose time the row has.
    pub message: EventTime,
    /// Positions, rad or m.
    pub q: Vec<f64>,
    /// Velocities, rad/s or m/s; NaN where the log has none.
    pub qd: Vec<f64>,
    /// Efforts as written; NaN where the log has none.
    pub effort: Vec<f64>,
    /// Commanded positions; NaN where the log has none.
    pub setpoint_q: Vec<f64>,
    /// Commanded velocities, likewise.
    pub setpoint_qd: Vec<f64>,
    /// Instants since the row before that were left out, since a joint was not known.
    pub left_out: u64,
    /// Messages since the row before that could not be used: unreadable, late, lost, or at a time that does not advance.
    pub unusable: u64,
}

impl JointRow {
    /// A row of this number of joints.
    pub fn new(joints: usize) -> Self {
        let unknown = || vec![f64::NAN; joints];
        Self {
            time_s: 0.0,
            message: EventTime::default(),
            q: unknown(),
            qd: unknown(),
            effort: unknown(),
            setpoint_q: unknown(),
            setpoint_qd: unknown(),
            left_out: 0,
            unusable: 0,
        }
    }
}

/// How many messages became rows, and what became of the others.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct JointRowCounts {
    /// Rows that were given.
    pub rows: u64,
    /// Instants at which a joint was not known, not even between two messages.
    pub incomplete: u64,
    /// Messages at a time that another one of their topic has.
    pub repeated: u64,
    /// Messages that came after later ones of their topic had been given.
    pub late: u64,
    /// Messages with an array that is neither empty nor as long as the names.
    pub wrong_lengths: u64,
    /// Messages without a position of any joint that is taken.
    pub without_positions: u64,
    /// Times at which a clock went back by more than a second; what follows is put behind what was before.
    pub restarts: u64,
    /// Parts of the log that cannot be read.
    pub unreadable_parts: u64,
}
