//! Faults of encoders: from the true state of the drives to what the encoders give.

use congruent_description::RobotQ;

use super::planned::FaultAction;

/// What the encoders of all joints give.
#[derive(Debug, Clone)]
pub(super) struct Reading {
    pub(super) q: RobotQ,
    pub(super) qd: Vec<f64>,
    /// The effort that the drive reports.
    pub(super) effort: Vec<f64>,
}

impl Reading {
    pub(super) fn new(dof: usize) -> Self {
        Self { q: RobotQ::zeros(dof), qd: vec![0.0; dof], effort: vec![0.0; dof] }
    }

    pub(super) fn copy_from(&mut self, other: &Self) {
        self.q.copy_from_slice(&other.q);
        self.qd.copy_from_slice(&other.qd);
        self.effort.copy_from_slice(&other.effort);
    }
}

/// From which drive the encoder of a joint reads, counted from where both stood when they were exchanged.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Wire {
    pub(super) drive: usize,
    /// 1, or -1 for the other way round.
    direction: f64,
    reading_at: f64,
    drive_at: f64,
}

impl Wire {
    /// The wires that a fault connects when the robot is at `q`: each with the joint that it belongs to.
    pub(super) fn for_fault(action: &FaultAction, q: &[f64]) -> Vec<(usize, Self)> {
        let wire = |joint: usize, drive: usize, direction: f64| {
            // The state at the exchange: readings continue without a jump, as those of incremental encoders.
            (joint, Self { drive, direction, reading_at: q[joint], drive_at: q[drive] })
        };
        match *action {
            FaultAction::FlippedAxis { joint } => vec![wire(joint, joint, -1.0)],
            FaultAction::SwappedJoints { joints: [a, b] } => vec![wire(a, b, 1.0), wire(b, a, 1.0)],
            _ => Vec::new(),
        }
    }

    pub(super) fn is_reversed(&self) -> bool {
        self.direction < 0.0
    }

    /// What the encoder of `joint` gives of a state.
    pub(super) fn read(&self, joint: usize, state: &Reading, reading: &mut Reading) {
        reading.q[joint] = self.reading_at + self.direction * (state.q[self.drive] - self.drive_at);
        reading.qd[joint] = self.direction * state.qd[self.drive];
        reading.effort[joint] = self.direction * state.effort[self.drive];
    }

    /// Where its drive goes if the reading is to be `q` with the speed `qd`.
    pub(super) fn driven(&self, q: f64, qd: f64) -> (f64, f64) {
        (self.drive_at + self.direction * (q - self.reading_at), self.direction * qd)
    }
}

/// Adds what an encoder reads too much, `since_s` after the beginning of the fault.
pub(super) fn falsify(action: &FaultAction, since_s: f64, reading: &mut Reading) {
    match *action {
        FaultAction::EncoderOffset { joint, offset } => reading.q[joint] += offset,
        FaultAction::EncoderDrift { joint, rate } => {
            reading.q[joint] += rate * since_s;
            reading.qd[joint] += rate;
        }
        _ => {}
    }
}
