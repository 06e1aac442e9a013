//! Compares two forward kinematics of one serial chain: the proof of a conversion.

use congruent_description::ChainQ;

use super::screws::chain::ScrewChain;
use crate::spatial::{pose::Pose, pose_error::larger};

/// How far two models of a chain are apart, by screws and by poses.
///
/// Two maps are equal for every `q` if and only if their screws and home poses are equal. The poses at configurations are a
/// second test, by the models' own arithmetic.
///
/// Source: Lynch & Park, *Modern Robotics* (2017), eq. 4.14; `(dT/dq_i) T^-1` at zero is the screw.
///
/// # Examples
/// ```
/// use congruent_description::ChainQ;
/// use congruent_kinematics::{Pose, Proof, Screw};
/// use nalgebra::Vector3;
/// let lift = |q: &ChainQ| Screw::prismatic(Vector3::z_axis()).exp(q[0]);
/// let proof = Proof::compare(1, &[[0.3].into()], &mut |q| lift(q), &mut |q| lift(q));
/// assert_eq!(proof.worst(), 0.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Proof {
    /// Largest difference of two screws in direction, rad per unit of the joint.
    pub screw_rad: f64,
    /// Largest difference of two screws in moment, m per unit of the joint.
    pub screw_m: f64,
    /// Angle between the home orientations, rad.
    pub home_rad: f64,
    /// Distance of the home origins, m.
    pub home_m: f64,
    /// Largest angle between orientations at a configuration, rad.
    pub orientation_rad: f64,
    /// Largest distance of origins at a configuration, m.
    pub position_m: f64,
    /// Number of compared configurations.
    pub configurations: usize,
}

/// A forward kinematics as a black box: `base_from_tip` at the positions of the chain's joints.
type BaseFromTip<'a> = dyn FnMut(&ChainQ) -> Pose + 'a;

impl Proof {
    /// Identifies both models of `n` joints and compares them at the configurations too.
    pub fn compare(
        n: usize,
        configurations: &[ChainQ],
        found: &mut BaseFromTip<'_>,
        expected: &mut BaseFromTip<'_>,
    ) -> Self {
        let mut proof = Self { configurations: configurations.len(), ..Self::default() };
        let (by_found, by_expected) =
            (ScrewChain::identify(n, &mut *found), ScrewChain::identify(n, &mut *expected));
        for (found, expected) in by_found.twists_in_base.iter().zip(&by_expected.twists_in_base) {
            proof.screw_rad = larger(proof.screw_rad, (found.angular - expected.angular).norm());
            proof.screw_m = larger(proof.screw_m, (found.linear - expected.linear).norm());
        }
        let (home, expected_home) = (by_found.base_from_tip_at_zero, by_expected.base_from_tip_at_zero);
        proof.home_rad = home.angle_rad(&expected_home);
        proof.home_m = home.distance_m(&expected_home);
        for q in configurations {
            let (found, expected) = (found(q), expected(q));
            proof.orientation_rad = larger(proof.orientation_rad, found.angle_rad(&expected));
            proof.position_m = larger(proof.position_m, found.distance_m(&expected));
        }
        proof
    }

    /// The largest of all residuals, rad and m alike: the value that is compared with a limit.
    pub fn worst(&self) -> f64 {
        let Self { screw_rad, screw_m, home_rad, home_m, orientation_rad, position_m, .. } = *self;
        // `larger` keeps a NaN, which `f64::max` would drop: a broken model must not prove anything.
        [screw_rad, screw_m, home_rad, home_m, orientation_rad, position_m].into_iter().fold(0.0, larger)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    #[test]
    fn a_model_that_gives_no_numbers_proves_nothing() {
        let nowhere = Pose { translation: Vector3::repeat(f64::NAN), ..Pose::identity() };
        let proof = Proof::compare(1, &[[0.3].into()], &mut |_| nowhere, &mut |_| Pose::identity());
        assert!(proof.worst().is_nan());
    }
}
