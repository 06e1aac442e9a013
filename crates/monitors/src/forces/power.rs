//! Energy: the work of the actuators against the change of kinetic energy, the work against gravity, and the losses by damping
//! and dry friction, step by step; the differences add up over the run. They are relative to the energy that was moved, by the
//! actuators and by gravity, and of first order in the step, as the physics is.
//!
//! All work is that of the mean velocity of a step. Semi-implicit Euler moves with the velocity at the end of the step, so that
//! the height runs ahead by half a step: that is not a difference of energy, and the check `twist` detects it.

use congruent_description::Robot;
use congruent_input::{Quantity, SiUnit, display::quantity};
use congruent_scenario::PowerCheck;
use nalgebra::DMatrix;

use super::{dynamics::AT_REST, not_evaluated::NotEvaluated};
use crate::{
    CheckContext, Names, RunDynamics, RunPayload, SameInput, StepForces,
    monitor::{Monitor, Observed},
    names::ALL_JOINTS,
    sample::Sample,
    verdict::{Bound, InstantValue},
    watch::Watch,
};

/// Default limit for each second of a step. Kind: truncation, of first order in the step. Worst seen in the scenarios: 1.2
/// (UR5e), 0.4 (Panda), 0.2 (course arm), with steps of 1 ms and of 0.25 ms alike; x2.5.
pub(crate) const RELATIVE_PER_S: f64 = 3.0;
/// The energy that is moved counts at least as much as lifting all links by this, m: without motion it is zero. Kind:
/// engineering.
const LEAST_LIFT_M: f64 = 1e-2;
/// A joint with dry friction that is slower may be held by it, with any torque up to its largest, rad/s and m/s. Kind: physics,
/// as in the check `dynamics`.
const CREEPING: f64 = 5e-3;
/// Gravity for that lift, m/s^2, whatever the scenario has.
const GRAVITY_M_S2: f64 = 9.81;

pub(crate) struct PowerMonitor<'a> {
    dynamics: RunDynamics<'a>,
    payloads: &'a [RunPayload],
    mass_matrix: DMatrix<f64>,
    /// Torques that hold the robot against gravity, as the mass matrix of the last sample.
    gravity: Vec<f64>,
    /// What both were computed from.
    computed: SameInput,
    before: PreviousSample,
    now: EnergyState,
    /// Work minus change of energy minus losses, since the start.
    missing_j: f64,
    /// Largest overestimate of the friction losses of creeping joints, since the start.
    unknown_j: f64,
    moved_j: f64,
    least_j: f64,
    watch: Watch,
    compared: u64,
    not_evaluated: NotEvaluated,
}

/// The quantities of one instant that the balance needs.
struct EnergyState {
    kinetic_j: f64,
    /// Torques that hold the robot against gravity.
    gravity: Vec<f64>,
}

/// The sample at the beginning of the step, with its energies.
struct PreviousSample {
    time_s: f64,
    qd: Vec<f64>,
    state: EnergyState,
    is_set: bool,
}

impl<'a> PowerMonitor<'a> {
    pub(crate) fn new(check: &PowerCheck, context: &CheckContext<'a>) -> Self {
        let dof = context.dof();
        let limit = check.relative.unwrap_or(RELATIVE_PER_S * context.clock.step_s);
        let state = || EnergyState { kinetic_j: 0.0, gravity: vec![0.0; dof] };
        Self {
            dynamics: context.dynamics.clone(),
            payloads: context.payloads,
            mass_matrix: DMatrix::zeros(dof, dof),
            gravity: vec![0.0; dof],
            computed: SameInput::default(),
            before: PreviousSample { time_s: 0.0, qd: vec![0.0; dof], state: state(), is_set: false },
            now: state(),
            missing_j: 0.0,
            unknown_j: 0.0,
            moved_j: 0.0,
            least_j: moving_kg(&context.description.robot) * GRAVITY_M_S2 * LEAST_LIFT_M,
            watch: Watch::new(Quantity::EnergyError, SiUnit::Ratio, Bound::AtMost, limit, dof),
            compared: 0,
            not_evaluated: NotEvaluated::default(),
        }
    }

    /// Takes the state of a sample, with the payloads of a time.
    fn take(&mut self, time_s: f64, sample: &Sample<'_>) -> Option<()> {
        let truth = sample.joints.state();
        if !self.computed.repeats(self.dynamics.revision_at(time_s), [truth.q]) {
            let (tree, buffer) = self.dynamics.at(time_s);
            let computed = tree
                .mass_matrix_into(truth.q, buffer, &mut self.mass_matrix)
                .and_then(|()| tree.gravity_into(truth.q, buffer, &mut self.gravity));
            if computed.is_err() {
                self.computed.forget();
                return None;
            }
        }
        self.now.gravity.copy_from_slice(&self.gravity);
        self.now.kinetic_j = 0.0;
        for (row, qd) in truth.qd.iter().enumerate() {
            let momentum: f64 =
                truth.qd.iter().enumerate().map(|(column, qd)| self.mass_matrix[(row, column)] * qd).sum();
            self.now.kinetic_j += 0.5 * qd * momentum;
        }
        Some(())
    }

    /// Adds the balance of one step, in which the actuators' efforts were constant.
    fn balance(&mut self, sample: &Sample<'_>, step_s: f64) {
        let (truth, before) = (sample.joints.state(), &self.before);
        // A step carries what was fixed at its beginning.
        let (tree, _) = self.dynamics.at(before.time_s);
        let (mut work_j, mut lifted_j, mut lost_j) = (0.0, 0.0, 0.0);
        for (joint, resistance) in tree.resistances().iter().enumerate() {
            let mean_qd = 0.5 * (truth.qd[joint] + before.qd[joint]);
            // Displacement by the mean of both velocities, as for all work here: see the module.
            let displacement = mean_qd * step_s;
            work_j += truth.effort[joint] * displacement;
            let gravity = 0.5 * (self.now.gravity[joint] + before.state.gravity[joint]);
            lifted_j += gravity * displacement;
            let holding = truth.effort[joint] - gravity;
            lost_j += resistance.damping * mean_qd * displacement;
            lost_j += friction(resistance.friction, mean_qd, holding) * displacement;
            // At such speeds friction may hold the joint or oppose it, with any torque up to its largest: its work is
            // known only within that.
            if (AT_REST..CREEPING).contains(&mean_qd.abs()) {
                self.unknown_j += resistance.friction * displacement.abs();
            }
            self.moved_j += (truth.effort[joint] * displacement).abs();
        }
        self.moved_j += lifted_j.abs();
        self.missing_j += work_j - (self.now.kinetic_j - before.state.kinetic_j) - lifted_j - lost_j;
        self.compared += 1;
        // `max` drops a NaN: with a plain 0 an error that is not a number would become 0 and pass.
        let missing_j = (self.missing_j.abs() - self.unknown_j).max(0.0 * self.missing_j);
        self.watch.observe(missing_j / self.moved_j.max(self.least_j), truth.q.len(), sample);
    }

    /// Keeps this sample for the next step, with the payloads of that step; `None` if its state cannot be computed.
    fn remember(&mut self, sample: &Sample<'_>) -> Option<()> {
        let (before_s, now_s) = (self.before.time_s, sample.time_s);
        let mut payloads = self.payloads.iter();
        // The state just computed has the load of the step that ends here; the next step begins with another, and so
        // do its energies.
        if payloads.any(|load| load.is_carried_at(before_s) != load.is_carried_at(now_s)) {
            self.take(now_s, sample)?;
        }
        std::mem::swap(&mut self.before.state, &mut self.now);
        self.before.time_s = now_s;
        self.before.qd.copy_from_slice(sample.joints.state().qd);
        Some(())
    }
}

/// The torque of dry friction at a joint: at rest the torque that holds the joint, else the largest against the velocity.
fn friction(largest: f64, qd: f64, holding: f64) -> f64 {
    if qd.abs() < AT_REST { holding.clamp(-largest, largest) } else { largest.copysign(qd) }
}

/// The mass that joints move.
fn moving_kg(robot: &Robot) -> f64 {
    let moving = robot.link_indices().filter(|&link| robot.body(link) != robot.root());
    moving.filter_map(|link| robot.link(link).inertia.as_ref()).map(|inertia| inertia.mass_kg).sum()
}

impl Monitor for PowerMonitor<'_> {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        let truth = sample.joints.state();
        let has_all = truth.qd.len() == truth.q.len() && truth.effort.len() == truth.q.len();
        let step_s = sample.since_s.filter(|_| self.before.is_set);
        // At the first sample there is no step before, only one to come.
        let carried_s = step_s.map_or(sample.time_s, |_| self.before.time_s);
        let state = if has_all { self.take(carried_s, sample) } else { None };
        match (step_s, state, sample.forces) {
            (None, ..) => {}
            (Some(step_s), Some(()), StepForces::Declared) => self.balance(sample, step_s),
            (_, _, StepForces::Constrained | StepForces::Contact) => self.not_evaluated.constrained += 1,
            (_, Some(()), StepForces::Unknown) => self.not_evaluated.unknown += 1,
            (_, None, _) => self.not_evaluated.refused += 1,
        }
        self.before.is_set = state.and_then(|()| self.remember(sample)).is_some();
    }

    fn finish(&self, names: &Names) -> Observed {
        let measure = self.watch.measure(&names.joints, |_| ALL_JOINTS.to_owned());
        let mut notes = self.not_evaluated.notes(self.compared);
        if self.compared > 0 {
            notes.push(format!("energy moved: {}", quantity(self.moved_j, "J")));
        }
        Observed {
            samples: self.compared,
            not_evaluated: self.not_evaluated.count(),
            measures: vec![measure],
            notes,
            ..Observed::default()
        }
    }

    fn values(&self, time_s: f64, take: &mut dyn FnMut(InstantValue)) {
        [&self.watch].into_iter().filter_map(|watch| watch.at(time_s)).for_each(take);
    }

    fn has_failed(&self) -> bool {
        self.watch.is_violated()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An arm of 0.6 kg that 5 N m of friction hold against 0.5 N m creeps by 1e-5 rad/s: in 5 s 2.5e-5 J, not 2.5e-4 J.
    #[test]
    fn friction_that_holds_takes_what_holds() {
        for (qd, holding, expected) in [
            (1e-5, 0.5, 0.5),
            (1e-5, -0.5, -0.5),
            (1e-5, 8.0, 5.0),
            (-1e-5, -8.0, -5.0),
            (0.1, 0.5, 5.0),
            (-0.1, 0.5, -5.0),
        ] {
            let torque = friction(5.0, qd, holding);
            assert!((torque - expected).abs() < 1e-12, "{qd} rad/s, {holding} N m: {torque}");
        }
    }
}
