//! From the rows of a recording to the equations of its joints.

use std::sync::Arc;

use congruent_description::RobotQ;
use congruent_dynamics::{BodyTree, DynamicsError};

use crate::{
    equations::{BLOCKS, RecordedEquations},
    regressor_row::ColumnMaker,
    smoothing::{KeptRow, SmoothedInstant, Smoothing, SmoothingWindow},
};

/// One instant of a recording.
#[derive(Debug, Clone, Copy)]
pub struct RecordedRow<'a> {
    /// When, s.
    pub time_s: f64,
    /// Positions of all moving joints, rad or m.
    pub q: &'a RobotQ,
    /// Efforts of all moving joints, NaN where none was recorded.
    pub effort: &'a [f64],
}

impl RecordedRow<'_> {
    pub(crate) fn kept(&self) -> Arc<KeptRow> {
        Arc::new(KeptRow { time_s: self.time_s, q: self.q.clone(), effort: self.effort.to_vec() })
    }
}

/// Which instants count.
#[derive(Debug, Clone, PartialEq)]
pub enum Instants {
    /// Those at which a joint moves faster than this, for each joint, rad/s or m/s: near zero, friction is not what it is in motion.
    Moving(Vec<f64>),
    /// Those at which all joints are slower than this: gravity alone.
    Still(Vec<f64>),
}

/// Adds up the equations of a recording, in memory that does not grow with it.
#[derive(Debug)]
pub struct Collector<'a> {
    window: SmoothingWindow,
    maker: ColumnMaker<'a>,
    equations: RecordedEquations,
    instants: Instants,
    /// First instant and length of the recording, s.
    from_s: f64,
    duration_s: f64,
}

/// Numbers that are larger are no efforts of a robot; their squares would not be numbers. N m or N; kind: choice.
pub(crate) const LARGEST: f64 = 1e12;

impl<'a> Collector<'a> {
    /// For a recording of this length.
    pub fn new(
        tree: &'a BodyTree,
        smoothing: Smoothing,
        instants: Instants,
        from_s: f64,
        duration_s: f64,
    ) -> Self {
        let (maker, equations) = ColumnMaker::new(tree);
        Self { window: SmoothingWindow::new(smoothing), maker, equations, instants, from_s, duration_s }
    }

    /// Ends a part: what follows is not connected with the rows so far.
    pub fn break_here(&mut self) {
        self.window.break_here();
    }

    /// Adds a row, later than those before it.
    ///
    /// # Errors
    /// The row is another robot's.
    pub fn push(&mut self, row: RecordedRow<'_>) -> Result<(), DynamicsError> {
        let mut outcome = Ok(());
        let Self { window, maker, equations, instants, from_s, duration_s } = self;
        window.push(row.kept(), |instant| {
            let block = block(instant.time_s - *from_s, *duration_s);
            if outcome.is_ok() {
                outcome = add(instant, block, instants, maker, equations);
            }
        });
        outcome
    }

    /// The equations of all rows.
    pub fn finish(self) -> RecordedEquations {
        self.equations
    }
}

/// The block of a time since the beginning.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "the cast of floats saturates, and there are few blocks"
)]
fn block(since_s: f64, duration_s: f64) -> usize {
    ((since_s / duration_s * BLOCKS as f64) as usize).min(BLOCKS - 1)
}

fn add(
    instant: &SmoothedInstant,
    block: usize,
    instants: &Instants,
    maker: &mut ColumnMaker<'_>,
    equations: &mut RecordedEquations,
) -> Result<(), DynamicsError> {
    let speed = |joint: usize| instant.qd[joint].abs();
    // Within the window the velocity may pass zero.
    let slowest = |joint: usize| speed(joint) - instant.velocity_change[joint];
    let is_still = |limits: &[f64]| (0..limits.len()).all(|joint| speed(joint) <= limits[joint]);
    let still;
    let instant = match instants {
        Instants::Still(limits) if !is_still(limits) => return Ok(()),
        Instants::Still(_) => {
            let zeros = vec![0.0; instant.qd.len()];
            still = SmoothedInstant {
                qd: zeros.clone(),
                qdd: zeros.clone(),
                effort_rate: zeros,
                ..instant.clone()
            };
            &still
        }
        Instants::Moving(_) => instant,
    };
    let rows = maker.rows(instant, &equations.joints)?;
    let mut is_used = false;
    for (row, joint) in rows.iter().zip(&mut equations.joints) {
        let moves = match instants {
            Instants::Moving(limits) => slowest(joint.joint) > limits[joint.joint],
            Instants::Still(_) => true,
        };
        if moves && row.iter().all(|value| value.abs() < LARGEST) {
            let at = joint.joint;
            let [of_first, of_second] = instant.of_derivatives;
            joint.add(
                block,
                row,
                [instant.q_variance[at] * of_second, instant.effort_variance[at] * of_first],
            );
            is_used = true;
        }
    }
    equations.instants += usize::from(is_used);
    Ok(())
}
