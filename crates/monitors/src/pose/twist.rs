//! The velocity of the tool centre point: the Jacobian at the measured joint positions times the measured joint
//! velocities, against the change of the twin's pose from one sample to the next.
//!
//! Sources differ in the meaning of a velocity. A simulation that integrates by semi-implicit Euler, as the physics here,
//! gives the velocity of the whole last step; a log, or a playback, gives that of the instant, so that the mean of two
//! instants is that of the step, or the first of them if the velocity jumps. All three are computed, and the nearest counts.

use congruent_description::{LinkIndex, RobotQ};
use congruent_input::{Quantity, SiUnit};
use congruent_kinematics::{JacobianKind, Twist, UrdfTree, larger};
use congruent_scenario::TwistCheck;
use nalgebra::{Isometry3, Vector3};

use crate::{
    CheckContext, Names,
    monitor::{Monitor, Observed},
    sample::Sample,
    verdict::{Bound, InstantValue},
    watch::Watch,
};

/// Default limits for each squared second of a step, m/s and rad/s. Kind: truncation, of second order in the step. Worst seen
/// in the scenarios: 0.57 and 1.1 by physics (steps of 1 ms and 0.25 ms alike), 9.5 and 5.5 in playback of quintic moves; x3.
const LINEAR_M_S_PER_S2: f64 = 28.0;
const ANGULAR_RAD_S_PER_S2: f64 = 16.0;
/// Rounding of positions, which is divided by the step, m and rad. Kind: rounding of sums below 4 m and 4 rad.
const ROUNDING: f64 = 3e-15;

/// The default limits: linear, m/s, and angular, rad/s.
pub(crate) fn twist_limits(step_s: f64) -> [f64; 2] {
    let limit = |per_s2: f64| per_s2 * step_s * step_s + ROUNDING / step_s;
    [LINEAR_M_S_PER_S2, ANGULAR_RAD_S_PER_S2].map(limit)
}

pub(crate) struct TwistMonitor {
    tree: UrdfTree,
    tip: LinkIndex,
    tip_from_tcp: Isometry3<f64>,
    before: Instant,
    now: Instant,
    linear: Watch,
    angular: Watch,
    samples: u64,
    /// Samples with contact or a joint at its stop: the physics moves bodies apart without a velocity.
    constrained: u64,
    has_velocities: bool,
}

/// The quantities of one sample that the comparison needs.
struct Instant {
    /// Of the TCP, in the axes of the root.
    columns: Vec<Twist>,
    qd: Vec<f64>,
    root_from_tcp: Isometry3<f64>,
    is_set: bool,
}

impl Instant {
    fn new(dof: usize) -> Self {
        Self {
            columns: vec![Twist::zero(); dof],
            qd: vec![0.0; dof],
            root_from_tcp: Isometry3::identity(),
            is_set: false,
        }
    }

    /// The TCP's velocity by this Jacobian.
    fn times(&self, qd: &[f64]) -> Twist {
        let mut sum = Twist::zero();
        for (column, qd) in self.columns.iter().zip(qd) {
            sum.angular += column.angular * *qd;
            sum.linear += column.linear * *qd;
        }
        sum
    }
}

impl TwistMonitor {
    pub(crate) fn new(check: &TwistCheck, context: &CheckContext<'_>) -> Self {
        let (description, dof) = (context.description, context.dof());
        let [linear_m_s, angular_rad_s] = twist_limits(context.clock.step_s);
        let [linear, angular] = check.unit_keys().map(|keys| keys.value());
        let watch = |quantity, unit, limit| Watch::new(quantity, unit, Bound::AtMost, limit, dof);
        Self {
            tree: UrdfTree::new(&description.robot),
            tip: description.tip,
            tip_from_tcp: description.tip_from_tcp.unwrap_or_else(Isometry3::identity),
            before: Instant::new(dof),
            now: Instant::new(dof),
            linear: watch(Quantity::Velocity, SiUnit::MetrePerSecond, linear.unwrap_or(linear_m_s)),
            angular: watch(
                Quantity::AngularVelocity,
                SiUnit::RadianPerSecond,
                angular.unwrap_or(angular_rad_s),
            ),
            samples: 0,
            constrained: 0,
            has_velocities: true,
        }
    }

    /// Takes the instant of a sample; `None` if the source has no velocities, or joint positions that are none.
    fn take(&mut self, q: &RobotQ, qd: &[f64], sample: &Sample<'_>) -> Option<()> {
        if qd.len() != q.len() {
            return None;
        }
        let now = &mut self.now;
        let root_from_tip =
            self.tree.jacobian_into(q, self.tip, JacobianKind::Geometric, &mut now.columns).ok()?;
        let tip_to_tcp = root_from_tip.rotation * self.tip_from_tcp.translation.vector;
        // From the tip's origin to the TCP: v_tcp = v_tip + w x r.
        for column in &mut now.columns {
            column.linear += column.angular.cross(&tip_to_tcp);
        }
        now.qd.copy_from_slice(qd);
        now.root_from_tcp = sample.twin[self.tip.get()] * self.tip_from_tcp;
        now.is_set = true;
        Some(())
    }
}

impl Monitor for TwistMonitor {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        std::mem::swap(&mut self.before, &mut self.now);
        let measured = sample.joints.measured;
        if self.take(measured.q, measured.qd, sample).is_none() {
            (self.has_velocities, self.now.is_set) = (false, false);
            return;
        }
        let (before, now) = (&self.before, &self.now);
        let Some(step_s) = sample.since_s.filter(|_| before.is_set) else { return };
        if sample.forces.are_constrained() {
            self.constrained += 1;
            return;
        }
        // The mean of the Jacobians at both ends makes all three of second order in the step.
        let moved = change(&before.root_from_tcp, &now.root_from_tcp, step_s);
        let of_the_step = mean(before.times(&now.qd), now.times(&now.qd));
        let of_the_step_before = mean(before.times(&before.qd), now.times(&before.qd));
        let of_two_instants = mean(before.times(&before.qd), now.times(&now.qd));
        let error = |by_jacobian: Twist| {
            [(moved.linear - by_jacobian.linear).norm(), (moved.angular - by_jacobian.angular).norm()]
        };
        let errors = [of_the_step, of_the_step_before, of_two_instants].map(error);
        // Sources differ in the instant of their velocities: that of the position, or the mean of a step. Any of them
        // is consistent; a wrong Jacobian is near none.
        let [linear, angular] = nearest(errors, [self.linear.limit(), self.angular.limit()]);
        self.samples += 1;
        self.linear.observe(linear, self.tip.get(), sample);
        self.angular.observe(angular, self.tip.get(), sample);
    }

    fn finish(&self, names: &Names) -> Observed {
        let link = |link: usize| names.links[link].clone();
        let measures = [&self.linear, &self.angular].map(|watch| watch.measure(&names.joints, link)).into();
        let mut notes = Vec::new();
        if !self.has_velocities {
            notes.push("the source of joint states has no velocities".to_owned());
        }
        if self.constrained > 0 {
            let all = self.samples + self.constrained;
            notes.push(format!(
                "{} of {all} samples not evaluated: contact, or a joint at its stop",
                self.constrained
            ));
        }
        Observed {
            samples: self.samples,
            not_evaluated: self.constrained,
            measures,
            notes,
            ..Observed::default()
        }
    }

    fn values(&self, time_s: f64, take: &mut dyn FnMut(InstantValue)) {
        [&self.linear, &self.angular].into_iter().filter_map(|watch| watch.at(time_s)).for_each(take);
    }

    fn has_failed(&self) -> bool {
        self.linear.is_violated() || self.angular.is_violated()
    }
}

/// The smallest errors, both parts relative to their limits; NaN counts as larger than every number.
fn nearest(errors: [[f64; 2]; 3], limits: [f64; 2]) -> [f64; 2] {
    let size = |[linear, angular]: [f64; 2]| larger(linear / limits[0], angular / limits[1]);
    let nearer = |a: [f64; 2], b: [f64; 2]| if size(b) < size(a) { b } else { a };
    let [first, second, third] = errors;
    nearer(nearer(first, second), third)
}

fn mean(a: Twist, b: Twist) -> Twist {
    Twist { angular: (a.angular + b.angular) * 0.5, linear: (a.linear + b.linear) * 0.5 }
}

/// The mean velocity from one pose to another, in the axes of the root.
fn change(before: &Isometry3<f64>, now: &Isometry3<f64>, step_s: f64) -> Twist {
    let turn: Vector3<f64> = (now.rotation * before.rotation.inverse()).scaled_axis();
    Twist { angular: turn / step_s, linear: (now.translation.vector - before.translation.vector) / step_s }
}
