//! Derivatives of the pose of the tip by every number of a product of exponentials, as twists.

use congruent_description::ChainQ;

use super::chain::ScrewChain;
use crate::{
    error::KinematicsError,
    spatial::{pose::Pose, twist::Twist},
};

/// Pose of the tip at one configuration and its derivative by every number of a [`ScrewChain`], each
/// as the twist `(dT/dp) T^-1` in the base: to first order, `dp` moves the tip to `exp([V] dp) T`.
///
/// | field | shape | unit | of |
/// |---|---|---|---|
/// | `base_from_tip` | SE(3) | m | |
/// | `by_screws` | n x 6 | 1 per unit of the component | the components of each screw, free of one another |
/// | `by_home` | 6 | 1 per rad, per m | a twist of the home pose, in the base: `exp([V]) base_from_tip(0)` |
///
/// The six are in the order of [`Twist::units`]: angular first.
///
/// Source: Park & Okamura, *Kinematic calibration and the product of exponentials formula* (1994);
/// the derivative of each exponential is [`Twist::dexp`].
///
/// # Examples
/// An arm of 1 m along x that turns about z. At zero its screw moves nothing, whatever it is; at a
/// quarter turn, a shift along x in the screw has been turned before: `(sin q, 1 - cos q)`.
/// ```
/// use congruent_description::ChainQ;
/// use congruent_kinematics::{Pose, Screw, ScrewChain, ScrewDerivatives, Twist};
/// use nalgebra::{Matrix3, Point3, Vector3};
/// let chain = ScrewChain {
///     twists_in_base: vec![Screw::revolute(Vector3::z_axis(), &Point3::origin()).twist()],
///     base_from_tip_at_zero: Pose::from_parts(Matrix3::identity(), Vector3::x()),
/// };
/// let mut derivatives = ScrewDerivatives::default();
/// chain.derivatives_into(&ChainQ::zeros(1), &mut derivatives)?;
/// assert_eq!(derivatives.by_screws[0], [Twist::zero(); 6]);
/// chain.derivatives_into(&ChainQ::from([std::f64::consts::FRAC_PI_2]), &mut derivatives)?;
/// let by_shift_along_x = derivatives.by_screws[0][3];
/// assert!((by_shift_along_x.linear - Vector3::new(1., 1., 0.)).norm() < 4.0 * f64::EPSILON);
/// # Ok::<(), congruent_kinematics::KinematicsError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ScrewDerivatives {
    /// Pose of the tip in the base.
    pub base_from_tip: Pose,
    /// Derivatives by the six components of each screw.
    pub by_screws: Vec<[Twist; 6]>,
    /// Derivatives by a twist of the home pose.
    pub by_home: [Twist; 6],
}

impl ScrewChain {
    /// Pose of the tip, and its derivative by every number of the chain.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `q` | n | rad, m | joints of the chain, base to tip |
    /// | `derivatives` | n screws | 1 per unit of the number | base |
    ///
    /// It allocates only while `derivatives` is of a shorter chain.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when `q` has another length.
    /// # Examples
    /// See [`ScrewDerivatives`].
    pub fn derivatives_into(
        &self,
        q: &ChainQ,
        derivatives: &mut ScrewDerivatives,
    ) -> Result<(), KinematicsError> {
        KinematicsError::check_joints(self.joint_count(), q)?;
        let ScrewDerivatives { base_from_tip, by_screws, by_home } = derivatives;
        by_screws.clear();
        let mut before = Pose::identity();
        for (twist, &q) in self.twists_in_base.iter().zip(q) {
            // The exponent is the screw times q, and so is its change. Its motion happens after that of the joints
            // before, which carry it.
            let by = |unit: Twist| (*twist * q).dexp(&(unit * q)).transformed_by(&before);
            by_screws.push(Twist::units().map(by));
            before = before * twist.exp(q);
        }
        // A twist on the left of the home pose moves with all joints.
        *by_home = Twist::units().map(|unit| unit.transformed_by(&before));
        *base_from_tip = before * self.base_from_tip_at_zero;
        Ok(())
    }
}
