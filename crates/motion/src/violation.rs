//! The largest violation of joint limits by a planned move: of velocity, and of acceleration and jerk if they are declared.

use congruent_description::RobotQ;

use super::{
    motion_plan::{JointSpacePath, PlannedMove, SetpointMut},
    timing::MotionLimits,
};

/// Intervals between the instants at which a move is compared with the limits; splines have four for each knot. Even, so
/// that one instant is in the middle, where profiles are fastest.
const INSTANTS: usize = 400;
/// Part of the duration by which the first and the last instant are inside the move: outside it the joints rest.
const INSIDE: f64 = 1e-9;
/// Part of the duration over which the change of the acceleration is taken as its jerk.
const JERK_OVER: f64 = 1e-5;
/// Part of a limit by which rounding may exceed it; of a jerk, rounding of a difference of accelerations.
const ROUNDING: [f64; 3] = [1e-9, 1e-9, 1e-6];

/// A derivative of the position that has a limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rate {
    Velocity,
    Acceleration,
    Jerk,
}

impl Rate {
    /// The words before the value in a message.
    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Velocity => "would move at",
            Self::Acceleration => "would accelerate at",
            Self::Jerk => "would have a jerk of",
        }
    }

    /// The end of the unit, after that of the position.
    pub(super) fn per(self) -> &'static str {
        match self {
            Self::Velocity => "/s",
            Self::Acceleration => "/s^2",
            Self::Jerk => "/s^3",
        }
    }

    /// Factor by which the duration has to grow if the limit is exceeded by `times`: the n-th derivative falls with its n-th
    /// power.
    fn slower(self, times: f64) -> f64 {
        match self {
            Self::Velocity => times,
            Self::Acceleration => times.sqrt(),
            Self::Jerk => libm::cbrt(times),
        }
    }
}

/// The limit violation that needs the longest duration.
#[derive(Debug, Clone, Copy)]
pub(super) struct LimitViolation {
    pub(super) rate: Rate,
    pub(super) coordinate: usize,
    /// Time within the time scaling of the move.
    pub(super) time_s: f64,
    pub(super) value: f64,
    pub(super) limit: f64,
    /// By which factor the duration has to grow.
    pub(super) slower: f64,
}

/// The limit violation of a move that needs the longest duration; `None` if it keeps all limits.
pub(super) fn worst_violation(planned: &PlannedMove, limits: &MotionLimits) -> Option<LimitViolation> {
    let instants = match &planned.joint_path {
        JointSpacePath::Straight(_) => INSTANTS,
        JointSpacePath::Spline(spline) => INSTANTS.max(4 * spline.knots().len()),
    };
    let duration_s = planned.time_scaling.duration_s();
    let has_jerk_limit = limits.declared_jerk.iter().any(|limit| limit.is_finite());
    let mut rates = Rates::new(planned);
    let mut worst: Option<LimitViolation> = None;
    for instant in 0..=instants {
        #[expect(clippy::cast_precision_loss, reason = "far below 2^52")]
        let share = instant as f64 / instants as f64;
        rates.look(
            planned,
            share.clamp(INSIDE, 1.0 - INSIDE) * duration_s,
            has_jerk_limit.then_some(duration_s * JERK_OVER),
        );
        let all = [
            (Rate::Velocity, &rates.velocity, &limits.velocity),
            (Rate::Acceleration, &rates.acceleration, &limits.declared_acceleration),
            (Rate::Jerk, &rates.jerk, &limits.declared_jerk),
        ];
        for ((rate, values, limits), rounding) in all.into_iter().zip(ROUNDING) {
            for (coordinate, (value, &limit)) in values.iter().zip(limits).enumerate() {
                // An infinite limit gives 0.
                let times = value.abs() / limit;
                // Compared by duration, not by ratio: 2x the velocity needs twice the time, 2x the jerk only 1.26 times.
                let slower = rate.slower(times);
                if times > 1.0 + rounding && worst.is_none_or(|worst| slower > worst.slower) {
                    let (time_s, value) = (share * duration_s, value.abs());
                    worst = Some(LimitViolation { rate, coordinate, time_s, value, limit, slower });
                }
            }
        }
    }
    worst
}

/// Derivatives of all joints at one instant.
struct Rates {
    q: RobotQ,
    velocity: Vec<f64>,
    acceleration: Vec<f64>,
    jerk: Vec<f64>,
    /// Velocities and accelerations half an interval and an interval later.
    later: [[Vec<f64>; 2]; 2],
}

impl Rates {
    fn new(planned: &PlannedMove) -> Self {
        let zeros = || vec![0.0; planned.to.len()];
        let later = [[zeros(), zeros()], [zeros(), zeros()]];
        Self {
            q: RobotQ::zeros(planned.to.len()),
            velocity: zeros(),
            acceleration: zeros(),
            jerk: zeros(),
            later,
        }
    }

    /// Evaluates the move at a time; jerks are changes of the acceleration over `jerk_over_s`. A jump of the acceleration, as
    /// some profiles have, is in one half of that interval only and does not count: no duration would keep a limit there.
    fn look(&mut self, planned: &PlannedMove, time_s: f64, jerk_over_s: Option<f64>) {
        let elapsed_s = time_s - planned.begins_s;
        let (qd, qdd) = (&mut self.velocity, &mut self.acceleration);
        planned.at(elapsed_s, SetpointMut { q: &mut self.q, qd, qdd });
        let Some(over_s) = jerk_over_s else { return };
        // Towards the middle, so that the interval is inside the move: at its ends the acceleration jumps to zero.
        let half_s =
            if time_s < planned.time_scaling.duration_s() / 2.0 { over_s / 2.0 } else { -over_s / 2.0 };
        for ([qd, qdd], halves) in self.later.iter_mut().zip([1.0, 2.0]) {
            planned.at(elapsed_s + halves * half_s, SetpointMut { q: &mut self.q, qd, qdd });
        }
        let [[_, middle], [_, end]] = &self.later;
        for (joint, jerk) in self.jerk.iter_mut().enumerate() {
            let first = (middle[joint] - self.acceleration[joint]).abs();
            let second = (end[joint] - middle[joint]).abs();
            *jerk = first.min(second) / half_s.abs();
        }
    }
}
