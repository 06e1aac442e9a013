//! What efforts are, while the samples come: without a column for each parameter, so that a check of a run can have it.

use std::sync::Arc;

use congruent_dynamics::{BodyTree, DynamicsBuffer, JointMotionState};
use nalgebra::{DMatrix, DVector};

use crate::{
    collect::{LARGEST, RecordedRow},
    effort_kind::{
        DELAY, EFFORT, GRAVITY, RIGID, RecognisedEffort, SMALL, SmallBlocks, TERMS, recognise_small,
    },
    equations::{BLOCKS, SummedRows},
    smoothing::{SmoothedInstant, Smoothing, SmoothingWindow},
    unknowns::JointUnknown,
};

/// A window is taken if the residual of the efforts with it is at most this much larger than with the best one, and that of no shorter one is. No unit; kind: choice.
const AS_GOOD: f64 = 1.1;
/// Length of a block, s; they are filled in turns, since nobody knows when the samples end. Kind: choice.
const BLOCK_S: f64 = 1.0;
/// A joint moves if it is faster than this, rad/s or m/s. Kind: choice; the joints of an arm in motion reach a hundred times as much.
const MOVING: f64 = 0.01;

/// Explains efforts as each kind, with windows of several lengths.
#[derive(Debug)]
pub struct EffortFit {
    tree: BodyTree,
    buffer: DynamicsBuffer,
    windows: Vec<(SmoothingWindow, Vec<SmallBlocks>)>,
    effort: DrivenEffort,
}

/// Torques of the rigid bodies, and those of gravity alone, of the moving joints and of the driven ones.
#[derive(Debug)]
struct DrivenEffort {
    of_all: [Vec<f64>; 2],
    of_driven: [Vec<f64>; 2],
}

impl EffortFit {
    /// For samples that are this far apart.
    pub fn new(tree: BodyTree, period_s: f64) -> Self {
        let joints = tree.driven_joints().len();
        let empty: SmallBlocks = vec![
            SummedRows {
                gram: DMatrix::zeros(SMALL, SMALL),
                rows: 0,
                armature_noise: 0.0,
                delay_signal: 1.0
            };
            BLOCKS
        ];
        let windows = Smoothing::of_period(period_s)
            .map(|smoothing| (SmoothingWindow::new(smoothing), vec![empty.clone(); joints]))
            .collect();
        let tree = tree.without_resistances();
        let zeros = |count: usize| [vec![0.0; count], vec![0.0; count]];
        let effort = DrivenEffort { of_all: zeros(tree.dof()), of_driven: zeros(joints) };
        Self { buffer: tree.buffer(), tree, windows, effort }
    }

    /// Ends a part: what follows is not connected with the samples so far.
    pub fn break_here(&mut self) {
        self.windows.iter_mut().for_each(|(window, _)| window.break_here());
    }

    /// Adds a sample, later than those before it.
    pub fn push(&mut self, row: RecordedRow<'_>) {
        let Self { tree, buffer, windows, effort } = self;
        let row = row.kept();
        for (window, joints) in windows {
            window.push(Arc::clone(&row), |instant| {
                // A row of another length cannot come: samples are the robot's.
                if effort.fill(tree, buffer, instant).is_some() {
                    add(tree, instant, effort, joints);
                }
            });
        }
    }

    /// What the efforts are, by the window that explains them best.
    pub fn recognised(&self) -> RecognisedEffort {
        let tried: Vec<RecognisedEffort> =
            self.windows.iter().map(|(_, joints)| recognise_small(joints)).collect();
        let current = |of: &RecognisedEffort| if of.left[2].is_nan() { f64::INFINITY } else { of.left[2] };
        let best = tried.iter().map(current).fold(f64::INFINITY, f64::min);
        let chosen = tried.iter().position(|of| current(of) <= AS_GOOD * best).unwrap_or(0);
        tried.into_iter().nth(chosen).unwrap_or_else(|| recognise_small(&[]))
    }
}

impl DrivenEffort {
    /// The torques of an instant; `None` if it is another robot's.
    fn fill(
        &mut self,
        tree: &BodyTree,
        buffer: &mut DynamicsBuffer,
        instant: &SmoothedInstant,
    ) -> Option<()> {
        let SmoothedInstant { q, qd, qdd, .. } = instant;
        let [rigid, gravity] = &mut self.of_all;
        tree.inverse_into(&JointMotionState { q, qd, qdd }, buffer, rigid).ok()?;
        tree.gravity_into(q, buffer, gravity).ok()?;
        for (of_driven, of_all) in self.of_driven.iter_mut().zip(&self.of_all) {
            of_driven.fill(0.0);
            for (joint, value) in of_all.iter().enumerate() {
                let (driver, ratio) = tree.driver(joint);
                of_driven[driver] += ratio * value;
            }
        }
        Some(())
    }
}

fn add(tree: &BodyTree, instant: &SmoothedInstant, effort: &DrivenEffort, joints: &mut [SmallBlocks]) {
    let mut row = DVector::zeros(SMALL);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the cast of floats saturates"
    )]
    let block = (instant.time_s.max(0.0) / BLOCK_S) as usize % BLOCKS;
    for (at, (&joint, blocks)) in tree.driven_joints().iter().zip(joints).enumerate() {
        let qd = instant.qd[joint];
        if qd.abs() - instant.velocity_change[joint] <= MOVING {
            continue;
        }
        (row[RIGID], row[GRAVITY]) = (effort.of_driven[0][at], effort.of_driven[1][at]);
        row[TERMS + JointUnknown::Viscous as usize] = qd;
        row[TERMS + JointUnknown::Coulomb as usize] = qd.signum();
        row[TERMS + JointUnknown::Armature as usize] = instant.qdd[joint];
        row[TERMS + JointUnknown::Offset as usize] = 1.0;
        (row[DELAY], row[EFFORT]) = (-instant.effort_rate[joint], instant.effort[joint]);
        if row.iter().all(|value| value.abs() < LARGEST) {
            let SummedRows { gram, rows, .. } = &mut blocks[block];
            gram.ger(1.0, &row, &row, 1.0);
            *rows += 1;
        }
    }
}
