//! A chain in which each parameter may be off: small motions between its joints, exactly as the parameters make them.
//!
//! ```text
//! T(q, e) = exp(e_1 V_1) exp(S_1 q_1) exp(e_2 V_2) ... M = exp(e_1 V_1(q)) exp(e_2 V_2(q)) ... T(q, 0)
//! ```
//! with `V_i(q) = Ad(exp(S_1 q_1) ... exp(S_k q_k)) V_i` of an error behind joint k. So at one configuration the errors
//! are motions about axes that do not depend on the errors, and a draw of all errors costs one turn or shift for each.

use congruent_calibration::estimation::CorrectionParameter;
use congruent_description::RobotQ;
use congruent_kinematics::{Pose, ScrewChain, Twist};
use nalgebra::{Quaternion, Vector3};

/// A twist with less rotation per unit is a shift. Unit: rad per unit; kind: rounding of an identified twist, below 1e-15.
const TURNS_ABOVE: f64 = 1e-9;

/// One small motion of everything behind a place in the chain: a turn about an axis, or a shift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ErrorMotion {
    /// The parameter whose error makes it.
    pub(crate) parameter: usize,
    /// Unit turn or unit shift, in the base.
    pub(crate) twist: Twist,
    /// rad or m of the motion per unit of the parameter's error.
    pub(crate) rate: f64,
}

impl ErrorMotion {
    /// Of a correction of one unit: the twist as a unit motion and a rate. Of a screw with a pitch the turn alone counts, and no
    /// joint has one.
    pub(crate) fn new(parameter: usize, generator: &Twist) -> Self {
        let turn = generator.angular.norm();
        if turn > TURNS_ABOVE {
            let angular = generator.angular / turn;
            let linear = generator.linear / turn;
            let twist = Twist { angular, linear: linear - angular * angular.dot(&linear) };
            return Self { parameter, twist, rate: turn };
        }
        let rate = generator.linear.norm();
        let linear = if rate > 0.0 { generator.linear / rate } else { Vector3::zeros() };
        Self { parameter, twist: Twist { angular: Vector3::zeros(), linear }, rate }
    }

    /// 1 if it turns, 0 if it shifts.
    pub(crate) fn turn(&self) -> f64 {
        if self.twist.angular == Vector3::zeros() { 0.0 } else { 1.0 }
    }

    /// Velocity of a point per unit of the motion.
    pub(crate) fn velocity(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.twist.linear + self.twist.angular.cross(point)
    }
}

/// The errors that are inserted between two joints.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PlacedMotion {
    /// 0 before the first joint, k behind joint k.
    pub(crate) slot: usize,
    /// At configuration zero.
    pub(crate) motion: ErrorMotion,
}

/// A chain with errors, up to the tool centre point.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ErrorChain {
    pub(crate) chain: ScrewChain,
    /// For each joint its entry of the configuration vector.
    pub(crate) coordinates: Vec<usize>,
    /// Base to tip, in the order in which they act.
    pub(crate) motions: Vec<PlacedMotion>,
}

impl ErrorChain {
    /// The chain with these corrections as errors: correction k is parameter k.
    pub(crate) fn new(
        chain: ScrewChain,
        coordinates: Vec<usize>,
        corrections: impl IntoIterator<Item = CorrectionParameter>,
    ) -> Self {
        let placed = |(parameter, correction): (usize, CorrectionParameter)| PlacedMotion {
            slot: correction.slot,
            motion: ErrorMotion::new(parameter, &correction.generator_in_base),
        };
        Self::of_motions(chain, coordinates, corrections.into_iter().enumerate().map(placed).collect())
    }

    /// The chain with these motions, which come in the order in which those of one slot act.
    pub(crate) fn of_motions(
        chain: ScrewChain,
        coordinates: Vec<usize>,
        mut motions: Vec<PlacedMotion>,
    ) -> Self {
        // Stable: the order within a slot is that of the factors of a row, which finite errors depend on.
        motions.sort_by_key(|placed| placed.slot);
        Self { chain, coordinates, motions }
    }

    /// The motions of the errors at a configuration of the robot. It allocates only while `motions` is shorter.
    pub(crate) fn motions_into(&self, q: &RobotQ, at: &mut ErrorMotions) {
        at.motions.clear();
        let mut placed = self.motions.iter().peekable();
        let mut before = Pose::identity();
        for slot in 0..=self.coordinates.len() {
            while let Some(error) = placed.next_if(|error| error.slot == slot) {
                let twist = error.motion.twist.transformed_by(&before);
                at.motions.push(ErrorMotion { twist, ..error.motion });
            }
            if let Some(&coordinate) = self.coordinates.get(slot) {
                before = before * self.chain.twists_in_base[slot].exp(q[coordinate]);
            }
        }
        at.tcp_in_base = (before * self.chain.base_from_tip_at_zero).translation;
    }
}

/// What the errors do at one configuration.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct ErrorMotions {
    /// In the base, in the order in which they act.
    pub(crate) motions: Vec<ErrorMotion>,
    /// The tool centre point without errors, in the base.
    pub(crate) tcp_in_base: Vector3<f64>,
}

/// How far errors move the tool.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ToolError {
    /// In the base, m.
    pub(crate) shift_in_base: Vector3<f64>,
    /// rad.
    pub(crate) angle_rad: f64,
}

impl ErrorMotions {
    /// The error of the tool at these errors of the parameters, in rad and m: exact, without linearisation.
    pub(crate) fn tool_error(&self, errors: &[f64]) -> ToolError {
        let (mut point, mut turned) = (self.tcp_in_base, Quaternion::identity());
        // The last factor acts first.
        for motion in self.motions.iter().rev() {
            let by = errors[motion.parameter] * motion.rate;
            if motion.turn() == 0.0 {
                point += motion.twist.linear * by;
                continue;
            }
            let (half_sine, half_cosine) = libm::sincos(by / 2.0);
            let axis = &motion.twist.angular;
            let velocity = motion.velocity(&point);
            // p + sin e (w x p + v) + (1 - cos e) w x (w x p + v), by half angles, which lose no digits at small e.
            point += velocity * (2.0 * half_sine * half_cosine)
                + axis.cross(&velocity) * (2.0 * half_sine * half_sine);
            turned = Quaternion::from_parts(half_cosine, axis * half_sine) * turned;
        }
        let angle_rad = 2.0 * libm::atan2(turned.imag().norm(), turned.scalar().abs());
        ToolError { shift_in_base: point - self.tcp_in_base, angle_rad }
    }

    /// To first order: velocity and angular velocity of the tool per unit of each parameter's error, times `scales`.
    pub(crate) fn columns_into(&self, scales: &[f64], columns: &mut Vec<Twist>) {
        columns.clear();
        columns.resize(scales.len(), Twist::zero());
        for motion in &self.motions {
            let by = motion.rate * scales[motion.parameter];
            let column = &mut columns[motion.parameter];
            column.angular += motion.twist.angular * by;
            column.linear += motion.velocity(&self.tcp_in_base) * by;
        }
    }
}
