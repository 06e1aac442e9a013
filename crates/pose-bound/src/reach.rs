//! How far the tip of a chain can be from its base: no two chains with the same base are farther apart than both
//! together.

use congruent_kinematics::ScrewChain;
use nalgebra::Vector3;

use super::corner::PositionInterval;

/// Outward rounding of some dozen operations for each joint.
const OUTWARD: f64 = 1.0 + 1e-12;

/// An upper bound of the distance of the tip from the origin of the base, m; each joint within its range.
///
/// A point of an axis is carried by the links before and behind it. So its distance from a point of the next axis
/// stays, whatever the joints do, and the tip is no farther than from point to point; a joint that slides adds its
/// travel.
pub(super) fn reach_m(chain: &ScrewChain, ranges: &[PositionInterval]) -> f64 {
    let (mut path_m, mut at) = (0.0, Vector3::zeros());
    for (twist, &(lower, upper)) in chain.twists_in_base.iter().zip(ranges) {
        let (turn, slide) = (twist.angular, twist.linear);
        let (square, travel) = (turn.norm_squared(), lower.abs().max(upper.abs()));
        if square == 0.0 {
            // A prismatic joint has no axis to pass by: the next point is taken from where the last one was.
            path_m += slide.norm() * travel;
            continue;
        }
        // The point of the axis nearest to the last point: `w x v / |w|^2` is the one nearest to the origin, and
        // the second term goes along the axis. Any point would give a bound, this one gives the shortest step.
        let on_axis = turn.cross(&slide) / square + turn * (turn.dot(&at) / square);
        path_m += (on_axis - at).norm() + (turn.dot(&slide) / square.sqrt()).abs() * travel;
        at = on_axis;
    }
    (path_m + (chain.base_from_tip_at_zero.translation - at).norm()) * OUTWARD
}

#[cfg(test)]
mod tests {
    use congruent_kinematics::{Pose, Twist, Uniform};

    use super::*;

    fn turn(axis: Vector3<f64>, through: Vector3<f64>) -> Twist {
        Twist { angular: axis, linear: through.cross(&axis) }
    }

    #[test]
    fn a_planar_arm_reaches_its_links() {
        let arm = ScrewChain {
            twists_in_base: vec![
                turn(Vector3::z(), Vector3::new(0.0, 0.0, 0.3)),
                turn(Vector3::z(), Vector3::new(0.6, 0.0, 0.0)),
                Twist { angular: Vector3::zeros(), linear: Vector3::x() },
            ],
            base_from_tip_at_zero: Pose { translation: Vector3::new(1.0, 0.0, 0.0), ..Pose::identity() },
        };
        let reach = reach_m(&arm, &[(-3.0, 3.0), (-3.0, 3.0), (-0.1, 0.2)]);
        assert!((reach - 1.2).abs() < 1e-9, "{reach}");
    }

    #[test]
    fn no_tip_is_farther() {
        let mut random = Uniform::seeded(5);
        let mut vector = || Vector3::from_fn(|_, _| random.between(-1.0, 1.0));
        for _ in 0..200 {
            let mut twists_in_base: Vec<Twist> = (0..5).map(|_| turn(vector(), vector())).collect();
            twists_in_base[2] = Twist { angular: Vector3::zeros(), linear: vector() };
            let along = twists_in_base[4].angular * 0.1;
            twists_in_base[4].linear += along; // a screw
            let base_from_tip_at_zero = Pose { translation: vector(), ..Pose::identity() };
            let chain = ScrewChain { twists_in_base, base_from_tip_at_zero };
            let ranges = [(-2.0, 3.0); 5];
            let reach = reach_m(&chain, &ranges);
            for _ in 0..20 {
                let q = (0..5).map(|_| 0.5 + 2.5 * vector().x).collect();
                let tip = chain.base_from_tip(&q).unwrap().translation.norm();
                assert!(tip <= reach, "{tip} {reach}");
            }
        }
    }
}
