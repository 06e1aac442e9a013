//! Energy: the work of the actuators against the change of kinetic and potential energy and what damping and dry friction
//! take, step by step; the differences add up over the run. They are relative to the energy that was moved, by the
//! actuators and by gravity, and of first order in the step, as the physics is.
//!
//! Potential energy is that of the twin's link poses, kinetic energy comes from the analytical mass matrix.

use congruent_description::{Inertia, LinkIndex, Robot, display::quantity};
use congruent_dynamics::Energy;
use nalgebra::{DMatrix, Vector3};

use super::left_out::LeftOut;
use crate::{
    monitor::{CheckContext, Monitor, Names, Observed, names::ALL_JOINTS, watch::Watch},
    sample::Sample,
    scenario::PowerCheck,
    setup::{DeclaredDynamics, Payload},
    source::StepForces,
    verdict::Bound,
};

/// The limit of a check that gives none, for each second of a step. Kind: truncation, of first order in the step. Worst
/// seen in the scenarios: 3.0 (UR5e), 2.7 (course arm), 0.9 (Panda), 5.3 where a servo starts with a jump, by steps of 1
/// ms and of 0.25 ms alike; x2.
pub(crate) const RELATIVE_PER_S: f64 = 10.0;
/// The energy that is moved counts at least as much as lifting all links by this, m: without motion it is zero. Kind:
/// engineering.
const LEAST_LIFT_M: f64 = 1e-2;
/// Gravity for that lift, m/s^2, whatever the scenario has.
const GRAVITY_M_S2: f64 = 9.81;

pub(crate) struct PowerMonitor<'a> {
    dynamics: DeclaredDynamics<'a>,
    payloads: &'a [Payload],
    weights: Vec<Weight>,
    gravity_in_root: Vector3<f64>,
    mass_matrix: DMatrix<f64>,
    before: Before,
    /// Work less change of energy less losses, so far.
    missing_j: f64,
    moved_j: f64,
    least_j: f64,
    watch: Watch,
    compared: u64,
    left_out: LeftOut,
}

/// The mass of a link that moves, and its centre.
struct Weight {
    link: usize,
    mass_kg: f64,
    com_in_link: Vector3<f64>,
}

/// What the sample before has left.
struct Before {
    time_s: f64,
    qd: Vec<f64>,
    energy: Energy,
    is_set: bool,
}

impl<'a> PowerMonitor<'a> {
    pub(crate) fn new(check: &PowerCheck, context: &CheckContext<'a>) -> Self {
        let (dof, clock) = (context.dof(), context.clock);
        let weights = weights(&context.description.robot);
        let mass_kg: f64 = weights.iter().map(|weight| weight.mass_kg).sum();
        let limit = check.relative.unwrap_or(RELATIVE_PER_S * clock.step_s);
        Self {
            dynamics: context.dynamics.clone(),
            payloads: context.payloads,
            weights,
            gravity_in_root: clock.gravity_in_world,
            mass_matrix: DMatrix::zeros(dof, dof),
            before: Before {
                time_s: 0.0,
                qd: vec![0.0; dof],
                energy: Energy { kinetic_j: 0.0, potential_j: 0.0 },
                is_set: false,
            },
            missing_j: 0.0,
            moved_j: 0.0,
            least_j: mass_kg * GRAVITY_M_S2 * LEAST_LIFT_M,
            watch: Watch::new("energy_error", "", Bound::AtMost, limit, dof),
            compared: 0,
            left_out: LeftOut::default(),
        }
    }

    /// Kinetic and potential energy at a sample, with the payloads of a time.
    fn energy(&mut self, time_s: f64, sample: &Sample<'_>) -> Option<Energy> {
        let truth = sample.joints.truth;
        let (tree, buffer) = self.dynamics.at(time_s);
        tree.mass_matrix_into(truth.q, buffer, &mut self.mass_matrix).ok()?;
        let mut kinetic_j = 0.0;
        for (row, qd) in truth.qd.iter().enumerate() {
            let momentum: f64 =
                truth.qd.iter().enumerate().map(|(column, qd)| self.mass_matrix[(row, column)] * qd).sum();
            kinetic_j += 0.5 * qd * momentum;
        }
        let carried = self.payloads.iter().filter(|payload| payload.is_carried_at(time_s));
        let carried =
            carried.map(|payload| Weight::new(payload.carried.link.get(), payload.inertia_in_link()));
        let height = |weight: &Weight| {
            let com = sample.twin[weight.link] * nalgebra::Point3::from(weight.com_in_link);
            weight.mass_kg * self.gravity_in_root.dot(&com.coords)
        };
        let potential_j = -self.weights.iter().map(height).sum::<f64>()
            - carried.map(|weight| height(&weight)).sum::<f64>();
        Some(Energy { kinetic_j, potential_j })
    }

    /// Adds the balance of one step, in which the actuators' efforts were constant.
    fn balance(&mut self, energy: Energy, sample: &Sample<'_>) {
        let truth = sample.joints.truth;
        let step_s = sample.time_s - self.before.time_s;
        let (tree, _) = self.dynamics.at(self.before.time_s);
        let (mut work_j, mut lost_j) = (0.0, 0.0);
        for (joint, resistance) in tree.resistances().iter().enumerate() {
            // By the mean of the velocities, not by the way: the kinetic energy then changes by exactly what is left over,
            // and what semi-implicit Euler shifts in the potential energy does not add up.
            let mean_qd = 0.5 * (truth.qd[joint] + self.before.qd[joint]);
            let way = mean_qd * step_s;
            work_j += truth.effort[joint] * way;
            self.moved_j += (truth.effort[joint] * way).abs();
            lost_j += resistance.damping * mean_qd * way + resistance.friction * way.abs();
        }
        let lifted_j = energy.potential_j - self.before.energy.potential_j;
        self.moved_j += lifted_j.abs();
        self.missing_j += work_j - (energy.kinetic_j - self.before.energy.kinetic_j) - lifted_j - lost_j;
        self.compared += 1;
        self.watch.observe(self.missing_j.abs() / self.moved_j.max(self.least_j), truth.q.len(), sample);
    }

    /// Keeps this sample for the next step, with what is carried in it.
    fn remember(&mut self, energy: Option<Energy>, sample: &Sample<'_>) {
        let truth = sample.joints.truth;
        let (before_s, now_s) = (self.before.time_s, sample.time_s);
        let mut payloads = self.payloads.iter();
        let is_as_before = payloads.all(|load| load.is_carried_at(before_s) == load.is_carried_at(now_s));
        let energy = if is_as_before { energy } else { self.energy(now_s, sample) };
        self.before.is_set = energy.is_some();
        if let Some(energy) = energy {
            self.before.time_s = now_s;
            self.before.energy = energy;
            self.before.qd.copy_from_slice(truth.qd);
        }
    }
}

impl Weight {
    fn new(link: usize, inertia: &Inertia) -> Self {
        Self { link, mass_kg: inertia.mass_kg, com_in_link: inertia.link_from_inertial.translation.vector }
    }
}

/// The links that a joint moves and that have a mass.
fn weights(robot: &Robot) -> Vec<Weight> {
    let moves = |link: &LinkIndex| robot.body(*link) != robot.root();
    let weight = |link: LinkIndex| Some(Weight::new(link.get(), robot.link(link).inertia.as_ref()?));
    robot.link_indices().filter(moves).filter_map(weight).collect()
}

impl Monitor for PowerMonitor<'_> {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        let truth = sample.joints.truth;
        let has_all = truth.qd.len() == truth.q.len() && truth.effort.len() == truth.q.len();
        let (is_step, step_began_s) = (self.before.is_set, self.before.time_s);
        let carried_s = if is_step { step_began_s } else { sample.time_s };
        let energy = if has_all { self.energy(carried_s, sample) } else { None };
        match (is_step, energy, sample.forces) {
            (false, ..) => {}
            (true, Some(energy), StepForces::Declared) => self.balance(energy, sample),
            (true, _, StepForces::Constrained) => self.left_out.constrained += 1,
            (true, Some(_), StepForces::Unknown) => self.left_out.unknown += 1,
            (true, None, _) => self.left_out.refused += 1,
        }
        self.remember(energy, sample);
    }

    fn finish(&self, names: &Names) -> Observed {
        let measure = self.watch.measure(&names.joints, |_| ALL_JOINTS.to_owned());
        let mut notes = self.left_out.notes(self.compared);
        if self.compared > 0 {
            notes.push(format!("energy moved: {}", quantity(self.moved_j, "J")));
        }
        Observed { samples: self.compared, measures: vec![measure], notes, ..Observed::default() }
    }

    fn has_failed(&self) -> bool {
        self.watch.is_violated()
    }
}
