//! How drives are connected: whose command a drive gets, and in which direction it turns.

use crate::{
    commands::{Commands, Motor},
    joints_view::MeasuredState,
};

/// The connection of the drive of one joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DriveConnection {
    /// The coordinate whose commands it gets; its own in a robot without fault.
    pub commanded_as: usize,
    /// Whether it turns in the other direction than it is commanded.
    pub is_reversed: bool,
}

impl DriveConnection {
    fn direction(self) -> f64 {
        if self.is_reversed { -1.0 } else { 1.0 }
    }
}

/// The state of the joints themselves, whatever their sensors say.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TrueState<'a> {
    pub(crate) q: &'a [f64],
    pub(crate) qd: &'a [f64],
}

/// The connections of all drives.
#[derive(Debug, Clone)]
pub(crate) struct Connections {
    of_drives: Vec<DriveConnection>,
}

impl Connections {
    /// Every drive gets the commands of its own joint.
    pub(crate) fn new(dof: usize) -> Self {
        let own = |commanded_as| DriveConnection { commanded_as, is_reversed: false };
        Self { of_drives: (0..dof).map(own).collect() }
    }

    pub(crate) fn set(&mut self, coordinate: usize, connection: DriveConnection) {
        assert!(connection.commanded_as < self.of_drives.len(), "a coordinate of this robot");
        self.of_drives[coordinate] = connection;
    }

    fn are_usual(&self) -> bool {
        let own = |(drive, connection): (usize, &DriveConnection)| {
            connection.commanded_as == drive && !connection.is_reversed
        };
        self.of_drives.iter().enumerate().all(own)
    }

    /// Brings commands, which are for the measured state, to the drives, which act on the true state: a servo keeps the
    /// error that the controller sees.
    pub(crate) fn connect(
        &self,
        commands: &mut Commands,
        scratch: &mut Commands,
        TrueState { q, qd }: TrueState<'_>,
        measured: &MeasuredState<'_>,
    ) {
        if self.are_usual() {
            for (coordinate, motor) in commands.motors.iter_mut().enumerate() {
                // q_target - measured + true: the error that acts is the one that the controller knows.
                if let Some(motor) = motor {
                    motor.q += q[coordinate] - measured.q[coordinate];
                    motor.qd += qd[coordinate] - measured.qd[coordinate];
                }
            }
            return;
        }
        // A copy, since exchanged drives read commands that the loop has already overwritten.
        scratch.copy_from(commands);
        for (drive, connection) in self.of_drives.iter().enumerate() {
            let (from, direction) = (connection.commanded_as, connection.direction());
            commands.torque[drive] = direction * scratch.torque[from];
            commands.motors[drive] = scratch.motors[from].map(|motor| Motor {
                gains: motor.gains,
                q: q[drive] + direction * (motor.q - measured.q[from]),
                qd: qd[drive] + direction * (motor.qd - measured.qd[from]),
            });
        }
    }
}
