//! The worst case: every parameter anywhere within its tolerance at once. From above by a bound that holds, from below by
//! parameters that attain it.
//!
//! With `T(q, e) = exp(e_1 V_1) ... exp(e_n V_n) T(q, 0)` (`error_chain.rs`) a point `p` is moved by motion after motion, the last
//! first. A turn by `e` moves a point `x` by `e V(x)` and a remainder of at most `e^2 |V(x)| / 2`, where `V(x)` is its velocity;
//! a shift has no remainder. So with the velocity taken at `p` and not at the moved point, and `b` a bound of how far the
//! point is already moved:
//! ```text
//! remainder += h b + h^2 (|V(p)| + b) / 2,   b += h (|V(p)| + b)        for a turn within h
//! ```
//! The sum of the `e V(p)` themselves, over all errors within their tolerances, is bounded by directions that cover the sphere
//! (`farthest_sum.rs`). Of the orientation: the path `exp(t e_1 w_1) ... exp(t e_n w_n)`, t from 0 to 1, has at each t an
//! angular velocity that differs from `sum e_i w_i` by at most `t sum_i h_i sum_(k<i) h_k`.
//!
//! Over the whole joint range the directions are not known, but the tool is no farther from a place of the chain than the path
//! from axis to axis (`lever_m`), and within one place the errors keep their directions among each other.

use congruent_description::RobotQ;
use congruent_kinematics::Twist;
use nalgebra::Vector3;

use crate::{
    error_chain::{ErrorChain, ErrorMotion, ErrorMotions},
    farthest_sum::{CoveringDirections, long_sum},
};

/// Outward rounding of sums and products of some hundred terms, and of the poses of the chain.
const OUTWARD: f64 = 1.0 + 1e-11;

/// Rounding of a product of some hundred motions, relative to the distance of the tool.
const ROUNDING: f64 = 1e-13;

/// How far the tool can be off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CertifiedError {
    /// No errors within the tolerances move the tool farther, m.
    pub(crate) position_m: f64,
    /// No errors within the tolerances turn it farther, rad.
    pub(crate) orientation_rad: f64,
}

/// The motion within its tolerance, and how fast it moves the tool.
#[derive(Debug, Clone, Copy)]
struct BoundedMotion {
    /// 1 for a turn, 0 for a shift.
    turn: f64,
    /// Half width, rad or m.
    within: f64,
    /// Bound of the velocity of the tool per unit.
    speed: f64,
}

/// What is beyond the first order, m: see the head of this file.
fn remainder_m(motions: &[BoundedMotion]) -> f64 {
    let (mut remainder, mut moved) = (0.0, 0.0);
    for BoundedMotion { turn, within, speed } in motions.iter().rev() {
        let speed_there = speed + turn * moved;
        remainder += turn * within * (moved + within * speed_there / 2.0);
        moved += within * speed_there;
    }
    remainder
}

/// What is beyond the first order of the orientation, rad.
fn remainder_rad(motions: &[BoundedMotion]) -> f64 {
    let (mut before, mut remainder) = (0.0, 0.0);
    for BoundedMotion { turn, within, .. } in motions {
        remainder += turn * within * before / 2.0;
        before += turn * within;
    }
    remainder
}

/// The angle of a rotation that is at most a sum of turns: none is above half a turn.
fn angle(turned_rad: f64) -> f64 {
    turned_rad.min(std::f64::consts::PI)
}

/// A bound of the error at one configuration, for errors of the parameters within `tolerances`.
pub(crate) fn certified_at(
    at: &ErrorMotions,
    tolerances: &[f64],
    directions: &CoveringDirections,
) -> CertifiedError {
    let mut columns = Vec::new();
    at.columns_into(tolerances, &mut columns);
    let linear: Vec<Vector3<f64>> = columns.iter().map(|column| column.linear).collect();
    let angular: Vec<Vector3<f64>> = columns.iter().map(|column| column.angular).collect();
    let bounded = |motion: &ErrorMotion| BoundedMotion {
        turn: motion.turn(),
        within: tolerances[motion.parameter] * motion.rate,
        speed: motion.velocity(&at.tcp_in_base).norm(),
    };
    let motions: Vec<BoundedMotion> = at.motions.iter().map(bounded).collect();
    // Rounding of the poses is relative to the tool's distance from the base, not to the error itself.
    let rounding_m = at.tcp_in_base.norm() * ROUNDING;
    CertifiedError {
        position_m: (directions.longest_at_most(&linear) + remainder_m(&motions)) * OUTWARD + rounding_m,
        orientation_rad: angle((directions.longest_at_most(&angular) + remainder_rad(&motions)) * OUTWARD),
    }
}

/// A bound of the error over ranges of all joints of the chain.
pub(crate) fn certified_over(
    chain: &ErrorChain,
    ranges: &[(f64, f64)],
    tolerances: &[f64],
    directions: &CoveringDirections,
) -> CertifiedError {
    let mut bounded = Vec::with_capacity(chain.motions.len());
    let (mut position_m, mut orientation_rad) = (0.0, 0.0);
    for slot in 0..=ranges.len() {
        let placed = chain.motions.iter().filter(|placed| placed.slot == slot);
        let motions: Vec<ErrorMotion> = placed.map(|placed| placed.motion).collect();
        let within = |motion: &ErrorMotion| tolerances[motion.parameter] * motion.rate;
        let turns: Vec<Vector3<f64>> =
            motions.iter().map(|motion| motion.twist.angular * within(motion)).collect();
        let turned_rad = directions.longest_at_most(&turns);
        orientation_rad += turned_rad;
        // Any point that moves with the link before the errors gives a bound; the best of a few is taken.
        let mut best: Option<(f64, Vec<BoundedMotion>)> = None;
        for point in reference_points(chain, slot, &motions) {
            let lever_m = lever_m(chain, ranges, slot, &point);
            let at_point: Vec<Vector3<f64>> =
                motions.iter().map(|motion| motion.velocity(&point) * within(motion)).collect();
            let bound = directions.longest_at_most(&at_point) + turned_rad * lever_m;
            if best.as_ref().is_none_or(|(known, _)| bound < *known) {
                let speed = |motion: &ErrorMotion| BoundedMotion {
                    turn: motion.turn(),
                    within: within(motion),
                    speed: motion.velocity(&point).norm() + motion.turn() * lever_m,
                };
                best = Some((bound, motions.iter().map(speed).collect()));
            }
        }
        if let Some((bound, motions)) = best {
            position_m += bound;
            bounded.extend(motions);
        }
    }
    CertifiedError {
        position_m: (position_m + remainder_m(&bounded)) * OUTWARD,
        orientation_rad: angle((orientation_rad + remainder_rad(&bounded)) * OUTWARD),
    }
}

/// Points on the axes of the turns of a slot, nearest to the tool at zero and to the next joint.
fn reference_points(chain: &ErrorChain, slot: usize, motions: &[ErrorMotion]) -> Vec<Vector3<f64>> {
    let tool = chain.chain.base_from_tip_at_zero.translation;
    let next = chain.chain.twists_in_base.get(slot).and_then(axis_point);
    let targets = [Some(tool), next];
    let mut points: Vec<Vector3<f64>> = Vec::new();
    for motion in motions.iter().filter(|motion| motion.turn() > 0.0) {
        let axis = &motion.twist.angular;
        let nearest_to_origin = axis.cross(&motion.twist.linear);
        for target in targets.into_iter().flatten() {
            points.push(nearest_to_origin + axis * axis.dot(&target));
        }
    }
    if points.is_empty() {
        points.push(tool);
    }
    points
}

/// The point of the axis of a joint that is nearest to the origin; none if it slides.
fn axis_point(twist: &Twist) -> Option<Vector3<f64>> {
    let square = twist.angular.norm_squared();
    (square > 0.0).then(|| twist.angular.cross(&twist.linear) / square)
}

/// How far the tool can be from a point of the link before a slot, m: along the path from axis to axis, which no motion of the
/// joints lengthens, and the travel of those that slide.
fn lever_m(chain: &ErrorChain, ranges: &[(f64, f64)], slot: usize, point: &Vector3<f64>) -> f64 {
    let (mut path_m, mut at) = (0.0, *point);
    let joints = chain.chain.twists_in_base.iter().zip(ranges).skip(slot);
    for (twist, (lower, upper)) in joints {
        let (turn, slide) = (twist.angular, twist.linear);
        let (square, travel) = (turn.norm_squared(), lower.abs().max(upper.abs()));
        let Some(origin) = axis_point(twist) else {
            path_m += slide.norm() * travel;
            continue;
        };
        let on_axis = origin + turn * (turn.dot(&at) / square);
        path_m += (on_axis - at).norm() + (turn.dot(&slide) / square.sqrt()).abs() * travel;
        at = on_axis;
    }
    path_m + (chain.chain.base_from_tip_at_zero.translation - at).norm()
}

/// Errors at the ends of their tolerances, and how far they move the tool.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct AttainedError {
    /// Of each parameter, rad or m.
    pub(crate) errors: Vec<f64>,
    /// m; exact, without linearisation.
    pub(crate) position_m: f64,
    /// Largest angle by other ends, rad.
    pub(crate) orientation_rad: f64,
}

/// Finds errors that move the tool far at configurations, one after another, in buffers of its own.
#[derive(Debug)]
pub(crate) struct WorstErrors<'a> {
    chain: &'a ErrorChain,
    tolerances: &'a [f64],
    at: ErrorMotions,
    columns: Vec<Twist>,
}

impl<'a> WorstErrors<'a> {
    /// For a chain whose parameters are within `tolerances`.
    pub(crate) fn new(chain: &'a ErrorChain, tolerances: &'a [f64]) -> Self {
        Self { chain, tolerances, at: ErrorMotions::default(), columns: Vec::new() }
    }

    /// The ends of the tolerances that to first order move the tool farthest, by sign of the gradient.
    pub(crate) fn at(&mut self, q: &RobotQ) -> AttainedError {
        self.chain.motions_into(q, &mut self.at);
        self.at.columns_into(self.tolerances, &mut self.columns);
        let linear: Vec<Vector3<f64>> = self.columns.iter().map(|column| column.linear).collect();
        let angular: Vec<Vector3<f64>> = self.columns.iter().map(|column| column.angular).collect();
        let ends = |vectors: &[Vector3<f64>], opposite: f64| -> Vec<f64> {
            let signs = long_sum(vectors).signs;
            signs.iter().zip(self.tolerances).map(|(sign, within)| opposite * sign * within).collect()
        };
        // To first order both signs move it as far; exactly, one of the two moves it farther.
        let [one, other] = [1.0, -1.0].map(|opposite| {
            let errors = ends(&linear, opposite);
            (self.at.tool_error(&errors).shift_in_base.norm(), errors)
        });
        let (position_m, errors) = if one.0 >= other.0 { one } else { other };
        let turned = |opposite| self.at.tool_error(&ends(&angular, opposite)).angle_rad;
        AttainedError { errors, position_m, orientation_rad: turned(1.0).max(turned(-1.0)) }
    }
}
