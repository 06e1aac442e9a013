//! The telescoping bound: the joints are exchanged one after the other, and the differences are summed.
//!
//! ```text
//! A_1..A_n M_a - B_1..B_n M_b = sum_i A_1..A_(i-1) (A_i - B_i) B_(i+1)..B_n M_b + A_1..A_n (M_a - M_b)
//! ```
//! The factors on the left only turn the difference, and those on the right only limit the distance of the
//! tip. Nothing is sampled or iterated, and the bound is proportional to the difference.

use congruent_kinematics::{Pose, ScrewChain, Twist};

use super::corner::PositionInterval;

/// Outward rounding of a sum of a few dozen positive terms.
const OUTWARD: f64 = 1.0 + 256.0 * f64::EPSILON;

/// How far each exchange can move the tip, in position and in orientation.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TelescopingBound {
    /// One entry for each joint, base to tip, then one for the home pose, m.
    pub(super) position_m: Vec<f64>,
    /// One entry for each joint, base to tip, then one for the home pose, rad.
    pub(super) orientation_rad: Vec<f64>,
}

impl TelescopingBound {
    /// The bound of two chains with as many joints as there are ranges.
    ///
    /// Source for one joint: Duhamel's formula
    /// `exp(A) - exp(B) = integral over s in 0..1 of exp(s A) (A - B) exp((1 - s) B)`.
    pub(super) fn new(a: &ScrewChain, b: &ScrewChain, ranges: &[PositionInterval]) -> Self {
        let (home_a, home_b) = (&a.base_from_tip_at_zero, &b.base_from_tip_at_zero);
        let mut position_m = vec![home_a.distance_m(home_b)];
        let mut orientation_rad = vec![angle_at_most_rad(home_a, home_b)];
        // From tip to base: the lever arm of joint `i` is what the joints `i..n` of `b` can make of the tip's distance,
        // and each joint only adds to it.
        let mut radius_m = home_b.translation.norm();
        for ((a, b), range) in a.twists_in_base.iter().zip(&b.twists_in_base).zip(ranges).rev() {
            let furthest = furthest(*range);
            // Before the joint's own term: Duhamel's integral moves the tip by a part of the joint's own motion, too.
            radius_m += radius_growth_m(b, furthest);
            let turn = (a.angular - b.angular).norm();
            position_m.push(furthest * (turn * radius_m + (a.linear - b.linear).norm()));
            orientation_rad.push(furthest * turn);
        }
        // The loop ran from tip to base, with the home pose first.
        position_m.reverse();
        orientation_rad.reverse();
        Self { position_m, orientation_rad }
    }

    /// A bound of the disagreement in position, in metres.
    pub(super) fn total_m(&self) -> f64 {
        self.position_m.iter().sum::<f64>() * OUTWARD
    }

    /// A bound of the disagreement in orientation, in radians.
    pub(super) fn total_rad(&self) -> f64 {
        (self.orientation_rad.iter().sum::<f64>() * OUTWARD).min(std::f64::consts::PI)
    }
}

/// Largest absolute position in a range.
pub(super) fn furthest((lower, upper): PositionInterval) -> f64 {
    lower.abs().max(upper.abs())
}

/// How much a joint can increase the distance of a point from the base's origin: the path length of the
/// origin itself, or the diameter of its circle if that is less.
fn radius_growth_m(twist: &Twist, furthest: f64) -> f64 {
    let rate = twist.angular.norm();
    let path_m = twist.linear.norm() * furthest;
    if rate == 0.0 {
        return path_m;
    }
    let axis = twist.angular / rate;
    let along = axis.dot(&twist.linear);
    let across = (twist.linear - axis * along).norm();
    // A large turn does not carry the origin farther than the diameter of its circle, `2 |m|` with the moment `m`.
    path_m.min(along.abs() * furthest + 2.0 * across / rate)
}

/// An upper bound of the angle between two orientations from the chord of their matrices,
/// `|R_a - R_b| = 2 sqrt(2) sin(angle / 2)`; rounding of the entries counts as rotation.
fn angle_at_most_rad(a: &Pose, b: &Pose) -> f64 {
    let half_sine = (a.rotation - b.rotation).norm() / 8.0_f64.sqrt();
    // The arcsine loses digits near 1; from 60 deg on the angle of the poses is accurate enough.
    if half_sine < 0.5 { 2.0 * libm::asin(half_sine) } else { a.angle_rad(b) }
}
