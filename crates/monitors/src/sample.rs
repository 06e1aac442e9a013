//! One instant of a run, as monitors and recorders get it.

use congruent_kinematics::{Pose, PoseError};
use congruent_proximity::{Clearance, MovingBodies, Nearest, Pair};
use nalgebra::Isometry3;

use crate::{ContactForce, JointSample, StepForces, verdict::CheckValue};

/// How far the physics keeps two shapes apart at most, m: the path of a link at 5 m/s in a step of 1 ms. Kind: physics.
const KEPT_APART_M: f64 = 5e-3;

/// Whether a pose differs from that of the sample before, by the model or by the twin.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PoseChange {
    /// One does.
    Moved,
    /// None does, to the last bit: what follows from poses alone is as before.
    AsBefore,
}

/// What is between two samples that do not follow each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interruption {
    /// A time without samples.
    Gap,
    /// Another part of what was recorded begins: its time from the sample before means nothing.
    NewPart,
}

/// Instants that a source could not give.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct LeftOutInstants {
    /// A joint was not known at them.
    pub incomplete: u64,
    /// Their messages could not be used: unreadable, late, lost, or at a time that does not advance.
    pub unusable: u64,
}

/// One instant: borrowed from the run loop, nothing is copied.
#[derive(Debug)]
pub struct Sample<'a> {
    /// Number of samples before this one.
    pub step: u64,
    /// Time of the source.
    pub time_s: f64,
    /// Time from the sample before. `None` for the first sample, and for the first after a gap: nothing is compared or
    /// differentiated across it.
    pub since_s: Option<f64>,
    /// Instants since the sample before that the source has left out.
    pub left_out: LeftOutInstants,
    /// Instants that the source has left out after this sample, if it is the last.
    pub left_out_after: LeftOutInstants,
    /// What is between the sample before and this one; `None` for the first, and for one that follows.
    pub interruption: Option<Interruption>,
    /// When the last motion ends, as far as it is known by now.
    pub motions_s: f64,
    /// Whether the poses are those of the sample before.
    pub change: PoseChange,
    /// Whether no step follows. For monitors this is the end of the scenario, for recorders also the end
    /// by a check at this instant.
    pub is_last: bool,
    /// Whether a check stops the run: from its violation on the setpoint departs from the motions and comes to rest.
    pub is_stopping: bool,
    /// Number of checks that have been violated by now; none for the checks themselves.
    pub violated_checks: usize,
    /// The joints: true states, measured states and setpoints.
    pub joints: JointSample<'a>,
    /// What acted in the step that led here.
    pub forces: StepForces,
    /// The links and obstacles that pushed each other in that step.
    pub contact_forces: &'a [ContactForce],
    /// Poses by analysis at the measured joint positions, in the root link's frame and the robot's order of
    /// links.
    pub model: &'a [Pose],
    /// Poses of the twin, likewise.
    pub twin: &'a [Isometry3<f64>],
    /// What the checks have measured at this instant; none for the checks themselves.
    pub values: &'a [CheckValue],
    /// Model against twin, link by link.
    pub errors: &'a [PoseError],
    /// Distances between links and to obstacles, measured when a monitor needs them.
    pub clearance: &'a mut Clearance,
    /// The obstacles that move.
    pub bodies: &'a MovingBodies<'a>,
    /// Distances from links to the zones that are forbidden to them, likewise.
    pub zones: &'a mut Clearance,
}

impl Sample<'_> {
    /// Whether the source knows the forces of contacts in the step that led here.
    pub fn knows_contact_forces(&self) -> bool {
        self.step > 0 && self.forces != StepForces::Unknown
    }

    /// Normal force of a pair of a link and an obstacle in the step that led here, N. `None` between links, and if the source
    /// knows no forces, as at the start.
    pub fn contact_force_n(&self, Pair { a, b }: Pair) -> Option<f64> {
        let links = self.twin.len();
        let obstacle = b.checked_sub(links).filter(|_| self.knows_contact_forces() && a < links)?;
        let acts = |force: &&ContactForce| force.link == a && force.obstacle == obstacle;
        Some(self.contact_forces.iter().filter(acts).map(|force| force.force_n).sum())
    }

    /// The pair that the physics keeps apart in this step although its hulls do not meet: the nearest of the chosen pairs of
    /// a link and an obstacle. `None` if a pair overlaps, which then is the one in contact.
    pub fn kept_apart(&mut self, is_chosen: impl Fn(usize) -> bool) -> Option<usize> {
        if self.forces != StepForces::Contact {
            return None;
        }
        let links = self.twin.len();
        let is_chosen = |pair: usize, Pair { b, .. }: Pair| b >= links && is_chosen(pair);
        let Nearest { distance_m, pair } = self.clearance.nearest_of(KEPT_APART_M, is_chosen)?;
        (distance_m > 0.0).then_some(pair)
    }
}
