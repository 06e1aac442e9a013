//! Positions, speeds and a third vector of each row, for all moving joints of the robot.

use std::ops::Range;

use super::columns::JointColumns;
use crate::array::JointRows;

/// What the third vector of a row is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Third {
    /// Accelerations, which followers have, too.
    Accelerations,
    /// Torques of the actuators, which followers do not have.
    Torques,
}

/// Vectors of many rows, one after another, in columns of the driven joints.
#[derive(Clone, Copy)]
pub(super) struct MotionRows<'a> {
    columns: &'a JointColumns,
    q: &'a [f64],
    qd: &'a [f64],
    third: &'a [f64],
    of_third: Third,
}

/// The same for some rows, with a value for each moving joint.
#[derive(Debug, Clone, Copy)]
pub(super) struct MovingRows<'a> {
    pub(super) q: &'a [f64],
    pub(super) qd: &'a [f64],
    pub(super) third: &'a [f64],
}

/// Memory for rows of robots with joints that follow others.
#[derive(Debug, Default)]
pub(super) struct RowMemory {
    q: Vec<f64>,
    qd: Vec<f64>,
    third: Vec<f64>,
}

impl<'a> MotionRows<'a> {
    /// Rows of one call, in the order positions, speeds, third.
    pub(super) fn new(columns: &'a JointColumns, of_third: Third, rows: [&'a JointRows<'_>; 3]) -> Self {
        let [q, qd, third] = rows.map(JointRows::values);
        Self { columns, q, qd, third, of_third }
    }

    /// The values of these rows for all moving joints: those of the caller's arrays as they are if no joint follows another.
    pub(super) fn of_moving<'b>(&self, rows: Range<usize>, memory: &'b mut RowMemory) -> MovingRows<'b>
    where
        'a: 'b,
    {
        let (columns, n) = (self.columns, self.columns.count());
        let of_rows = n * rows.start..n * rows.end;
        let given = [self.q, self.qd, self.third].map(|values| &values[of_rows.clone()]);
        let [q, qd, third] = given;
        if columns.is_configuration() {
            return MovingRows { q, qd, third };
        }
        columns.positions_into(q, &mut memory.q);
        columns.rates_into(qd, &mut memory.qd);
        match self.of_third {
            Third::Accelerations => columns.rates_into(third, &mut memory.third),
            Third::Torques => columns.torques_into(third, &mut memory.third),
        }
        MovingRows { q: &memory.q, qd: &memory.qd, third: &memory.third }
    }
}
