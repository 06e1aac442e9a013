//! The acceleration of the twin in each step against forward dynamics by analysis (the articulated body algorithm), at the
//! twin's state before the step and with the efforts that its actuators exerted in it. The analysis starts again from the
//! twin's state at every sample, so that nothing adds up.
//!
//! A difference of accelerations is turned into torques by the mass matrix, `M (qdd_twin - qdd_model)`: an unknown torque at one
//! joint accelerates all joints, but appears at its own joint alone. It is relative to the torques that act at the joint, so
//! that a wrist counts as much as a shoulder. It is of first order in the step, as the physics is.

use congruent_description::{JointIndex, RobotQ};
use congruent_dynamics::DrivenState;
use congruent_input::{Quantity, SiUnit};
use congruent_kinematics::larger;
use congruent_scenario::DynamicsCheck;
use nalgebra::DMatrix;

use super::not_evaluated::NotEvaluated;
use crate::{
    CheckContext, Names, RunDynamics, SameInput, StepForces,
    joints::LARGEST_VELOCITY_SHARE,
    monitor::{Monitor, Observed},
    sample::Sample,
    verdict::{Bound, InstantValue},
    watch::Watch,
};

/// Default limit for each second of a step. Kind: truncation, of first order in the step. Worst seen in the scenarios: 14.4
/// (UR5e at 0.73 of its velocity limit), 4.8 (Panda), 1.8 (course arm), with steps of 1 ms and of 0.25 ms alike; x2.
pub(crate) const RELATIVE_PER_S: f64 = 30.0;
/// The torques that act at a joint count at least as much as this acceleration of the joint alone takes, rad/s^2 and
/// m/s^2: at rest and without load they are zero. Kind: engineering; arms are driven with 1 to 20 rad/s^2.
const LEAST_ACCELERATION: f64 = 1.0;
/// A joint with dry friction that is slower is at rest, and its friction is then any torque up to its largest, rad/s and m/s.
/// Kind: physics; a joint that friction holds creeps at 4e-7 rad/s.
pub(super) const AT_REST: f64 = 1e-4;
/// The same as a share of the speed of the fastest joint, whose motion the solver passes on to the others. Kind: solver stop.
const CREEP_OF_FASTEST: f64 = 1e-3;
/// Slower than this a joint is at rest if its friction can stop it within the step: then it is whatever it takes to stop it,
/// rad/s and m/s. Kind: physics, with a bound so that a light wrist with much friction is compared when it moves.
const STOPPED_IN_A_STEP: f64 = 5e-3;

pub(crate) struct DynamicsMonitor<'a> {
    dynamics: RunDynamics<'a>,
    mass_matrix: DMatrix<f64>,
    /// Accelerations by analysis.
    qdd: Vec<f64>,
    /// Those of the twin minus those by analysis.
    difference: Vec<f64>,
    /// What the analysis started from.
    analysed: SameInput,
    bias: Vec<f64>,
    before: StateBefore,
    /// For each joint, the one that it follows with its ratio; itself if it follows none.
    drivers: Vec<(usize, f64)>,
    torque: Watch,
    frictions: Vec<f64>,
    /// Speeds up to which the error of the step is known, rad/s and m/s; infinite without a velocity limit.
    fastest: Vec<f64>,
    compared: u64,
    not_evaluated: NotEvaluated,
}

/// The state at the sample before.
struct StateBefore {
    time_s: f64,
    q: RobotQ,
    qd: Vec<f64>,
    is_set: bool,
}

impl<'a> DynamicsMonitor<'a> {
    pub(crate) fn new(check: &DynamicsCheck, context: &CheckContext<'a>) -> Self {
        let (robot, dof) = (&context.description.robot, context.dof());
        let driver = |(row, &joint): (usize, _)| {
            let mimic = robot.joint(joint).mimic;
            let master = mimic.and_then(|mimic| Some((robot.coordinate(mimic.master)?, mimic.multiplier)));
            master.unwrap_or((row, 1.0))
        };
        let mut dynamics = context.dynamics.clone();
        let frictions = dynamics.at(0.0).0.resistances().iter().map(|resistance| resistance.friction);
        let limit = check.relative.unwrap_or(RELATIVE_PER_S * context.clock.step_s);
        let velocity = |&joint: &JointIndex| {
            let velocity = robot.joint(joint).limit.and_then(|limit| limit.velocity);
            velocity
                .filter(|&limit| limit > 0.0)
                .map_or(f64::INFINITY, |limit| limit * LARGEST_VELOCITY_SHARE)
        };
        Self {
            fastest: robot.movable_joints().iter().map(velocity).collect(),
            frictions: frictions.collect(),
            dynamics,
            mass_matrix: DMatrix::zeros(dof, dof),
            qdd: vec![0.0; dof],
            difference: vec![0.0; dof],
            analysed: SameInput::default(),
            bias: vec![0.0; dof],
            before: StateBefore { time_s: 0.0, q: RobotQ::zeros(dof), qd: vec![0.0; dof], is_set: false },
            drivers: robot.movable_joints().iter().enumerate().map(driver).collect(),
            torque: Watch::new(Quantity::AccelerationError, SiUnit::Ratio, Bound::AtMost, limit, dof),
            compared: 0,
            not_evaluated: NotEvaluated::default(),
        }
    }

    /// Fills the accelerations by analysis, the torques without acceleration, and the mass matrix. Forces that depend on the
    /// velocity are those of the end of the step, as in the physics, which integrates them implicitly.
    fn analyse(&mut self, effort: &[f64], qd: &[f64]) -> Option<()> {
        let StateBefore { time_s, q, .. } = &self.before;
        if self.analysed.repeats(self.dynamics.revision_at(*time_s), [q, qd, effort]) {
            return Some(());
        }
        let (tree, buffer) = self.dynamics.at(*time_s);
        let state = DrivenState { q, qd, tau: effort };
        let analysed = tree
            .forward_into(&state, buffer, &mut self.qdd)
            .and_then(|()| tree.bias_into(q, qd, buffer, &mut self.bias))
            .and_then(|()| tree.mass_matrix_into(q, buffer, &mut self.mass_matrix));
        if analysed.is_err() {
            self.analysed.forget();
        }
        analysed.ok()
    }

    /// The relative difference at one joint and the joints that mimic it. Friction at rest is any torque up to its largest, so
    /// the part of the difference that it can explain does not count.
    fn relative(&self, joint: usize, sample: &Sample<'_>, step_s: f64, at_rest: f64) -> f64 {
        let (truth, dof) = (sample.joints.state(), self.qdd.len());
        let (mut difference, mut acting, mut alone) = (0.0, 0.0, 0.0);
        let mut held = StuckFriction::default();
        // A mimic joint has no drive: by virtual work its torque acts at its master, multiplied by the ratio.
        for row in (0..dof).filter(|&row| self.drivers[row].0 == joint) {
            let (friction, ratio) = (self.frictions[row], self.drivers[row].1);
            // The speed that friction can take away within one step: a joint that is slower ends at rest somewhere
            // inside it.
            let stopped = (friction * step_s / self.mass_matrix[(row, row)]).min(STOPPED_IN_A_STEP);
            if sticks(friction, self.before.qd[row], truth.qd[row], at_rest.max(stopped)) {
                held.add(friction, ratio, truth.qd[row]);
            }
            let torque: f64 =
                (0..dof).map(|other| self.mass_matrix[(row, other)] * self.difference[other]).sum();
            difference += ratio * torque;
            acting += ratio.abs() * truth.effort[row].abs().max(self.bias[row].abs());
            acting += ratio.abs() * self.torque_of_frictions(row);
            alone += ratio * ratio * self.mass_matrix[(row, row)];
        }
        // Without the last term a light joint at rest, on which no torque acts, would have any relative difference.
        held.unexplained(difference) / (acting + alone * LEAST_ACCELERATION)
    }

    /// Torque at a joint by the dry friction of the other joints, which slows them down: it acts at this joint by coupling.
    fn torque_of_frictions(&self, row: usize) -> f64 {
        let others = (0..self.frictions.len()).filter(|&other| other != row && self.frictions[other] > 0.0);
        let brought = |other: usize| {
            self.mass_matrix[(row, other)].abs() * self.frictions[other] / self.mass_matrix[(other, other)]
        };
        others.map(brought).sum()
    }

    fn compare(&mut self, sample: &Sample<'_>, step_s: f64) {
        let truth = sample.joints.state();
        if self.analyse(truth.effort, truth.qd).is_none() {
            self.not_evaluated.refused += 1;
            return;
        }
        let accelerations =
            truth.qd.iter().zip(&self.before.qd).map(|(after, before)| (after - before) / step_s);
        for ((difference, twin), model) in self.difference.iter_mut().zip(accelerations).zip(&self.qdd) {
            *difference = twin - model;
        }
        let speeds = truth.qd.iter().chain(&self.before.qd);
        // Coupling passes a share of the fastest joint's motion on to joints that friction holds.
        let at_rest = speeds.map(|qd| qd.abs() * CREEP_OF_FASTEST).fold(AT_REST, larger);
        for joint in (0..self.qdd.len()).filter(|&joint| self.drivers[joint].0 == joint) {
            self.torque.observe(self.relative(joint, sample, step_s, at_rest), joint, sample);
        }
        self.compared += 1;
    }
}

/// Whether a joint is faster than it may be. The difference of the two schemes grows with the square of the speeds, and its limit is
/// that of arms within their velocity limits; without actuators a wrist whips at many times its own.
fn is_too_fast(qd: &[f64], fastest: &[f64]) -> bool {
    qd.iter().zip(fastest).any(|(qd, fastest)| qd.abs() > *fastest)
}

/// Whether a joint with dry friction is at rest in the step, or turns round in it.
fn sticks(friction: f64, before: f64, after: f64, at_rest: f64) -> bool {
    friction > 0.0 && (before * after <= 0.0 || before.abs().min(after.abs()) < at_rest)
}

/// The dry friction of a joint and its followers at rest.
#[derive(Debug, Clone, Copy, Default)]
struct StuckFriction {
    /// Friction torque that the analysis assumes: the largest, against the velocity.
    assumed: f64,
    /// Largest friction torque in either direction.
    largest: f64,
}

impl StuckFriction {
    fn add(&mut self, friction: f64, ratio: f64, qd: f64) {
        // At exactly 0 the analysis assumes no friction, and `signum` of 0 would be 1.
        let direction = if qd == 0.0 { 0.0 } else { qd.signum() };
        self.assumed += ratio * friction * direction;
        self.largest += ratio.abs() * friction;
    }

    /// The part of a torque difference that no friction within its limits explains.
    fn unexplained(self, difference: f64) -> f64 {
        let beyond = (difference - self.assumed).abs() - self.largest;
        // `max` drops a NaN: with a plain 0 a difference that is not a number would become 0 and pass.
        beyond.max(0.0 * beyond)
    }
}

impl Monitor for DynamicsMonitor<'_> {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        let truth = sample.joints.state();
        let has_all = truth.qd.len() == truth.q.len() && truth.effort.len() == truth.q.len();
        if let Some(step_s) = sample.since_s.filter(|_| self.before.is_set) {
            match sample.forces {
                StepForces::Declared
                    if has_all
                        && [truth.qd, &self.before.qd].iter().any(|qd| is_too_fast(qd, &self.fastest)) =>
                {
                    self.not_evaluated.fast += 1;
                }
                StepForces::Declared if has_all => self.compare(sample, step_s),
                StepForces::Constrained | StepForces::Contact => self.not_evaluated.constrained += 1,
                StepForces::Declared | StepForces::Unknown => self.not_evaluated.unknown += 1,
            }
        }
        self.before.is_set = has_all;
        if has_all {
            self.before.time_s = sample.time_s;
            self.before.q.copy_from_slice(truth.q);
            self.before.qd.copy_from_slice(truth.qd);
        }
    }

    fn finish(&self, names: &Names) -> Observed {
        let measure = self.torque.measure(&names.joints, |joint| names.joints[joint].clone());
        let notes = self.not_evaluated.notes(self.compared);
        Observed {
            samples: self.compared,
            not_evaluated: self.not_evaluated.count(),
            measures: vec![measure],
            notes,
            ..Observed::default()
        }
    }

    fn values(&self, time_s: f64, take: &mut dyn FnMut(InstantValue)) {
        [&self.torque].into_iter().filter_map(|watch| watch.at(time_s)).for_each(take);
    }

    fn has_failed(&self) -> bool {
        self.torque.is_violated()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn friction_explains_no_difference_that_is_not_a_number() {
        let mut held = StuckFriction::default();
        assert!(held.unexplained(f64::NAN).is_nan());
        held.add(5.0, 1.0, 0.0);
        assert!(held.unexplained(f64::NAN).is_nan());
        assert!(held.unexplained(4.0).abs() < f64::MIN_POSITIVE);
        assert!((held.unexplained(-7.0) - 2.0).abs() < 1e-12);
    }
}
