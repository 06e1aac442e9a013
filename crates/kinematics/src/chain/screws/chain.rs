//! A serial chain as space screws and a home pose: the form in which two models are compared,
//! whatever they were written as.

use std::convert::Infallible;

use congruent_description::{ChainQ, LinkIndex, Robot, RobotQ};

use crate::{
    chain::{dh::chain::DhChain, urdf::UrdfTree},
    error::KinematicsError,
    spatial::{pose::Pose, twist::Twist},
};

/// How far each joint is moved when a chain is identified: for a joint that follows a screw the
/// recovered twist does not depend on it, and half a unit is far from both rounding and pi.
const IDENTIFICATION_STEP: f64 = 0.5;
/// A step so short that a joint must turn 400 times as far as its variable says before the turn
/// wraps: it is taken first, and if half a unit would wrap, a shorter step is taken.
const SHORT_STEP: f64 = 1.0 / 128.0;

/// A serial chain: `base_from_tip(q) = exp([S_1] q_1) ... exp([S_n] q_n) base_from_tip(0)`.
///
/// The twists are not scaled to unit length: a joint that moves less than its variable says has a
/// shorter one.
///
/// Source: Lynch & Park, *Modern Robotics* (2017), eq. 4.14.
#[derive(Debug, Clone, PartialEq)]
pub struct ScrewChain {
    /// Space twists at position zero, in the base frame, base to tip.
    pub twists_in_base: Vec<Twist>,
    /// `base_from_tip` at position zero.
    pub base_from_tip_at_zero: Pose,
}

impl ScrewChain {
    /// Recovers a chain of `n` joints from any forward kinematics, by `2 n + 1` evaluations.
    ///
    /// `base_from_tip` is evaluated at `q` of length `n`. Around a generic `q0` (different values for
    /// each joint, so that swapped joints show) the motion of one joint alone is
    /// `exp(h T_i)`, where `T_i` is its twist at `q0`; moving that back by the joints before it gives
    /// the twist at zero. For joints that follow screws this is exact, not a difference quotient.
    pub fn identify(n: usize, mut base_from_tip: impl FnMut(&ChainQ) -> Pose) -> Self {
        let Ok(chain) = Self::try_identify(n, |q| Ok::<_, Infallible>(base_from_tip(q)));
        chain
    }

    fn try_identify<E>(
        n: usize,
        mut base_from_tip: impl FnMut(&ChainQ) -> Result<Pose, E>,
    ) -> Result<Self, E> {
        // Different for each joint and not simple multiples of each other, so that exchanged joints show; none near a quarter
        // turn, where errors of sign or axis can cancel.
        #[expect(clippy::cast_precision_loss, reason = "arms have few joints")]
        let q0: ChainQ = (0..n).map(|joint| 0.3 + 0.1 * (joint as f64).sqrt()).collect();
        let at_q0 = base_from_tip(&q0)?;
        let mut q = q0.clone();
        let mut twists_in_base: Vec<Twist> = Vec::with_capacity(n);
        let mut before = Pose::identity();
        for joint in 0..n {
            let mut twist_by = |step: f64| -> Result<Twist, E> {
                q[joint] += step;
                let moved = base_from_tip(&q)?;
                q[joint] = q0[joint];
                let Twist { angular, linear } = Twist::log(&(moved * at_q0.inverse()));
                Ok(Twist { angular: angular / step, linear: linear / step })
            };
            // The logarithm is unique only below half a turn. A joint in degrees turns 57.3 times as far as its variable says,
            // and half a unit of it would wrap: a short step measures the rate first.
            let rate = twist_by(SHORT_STEP)?.angular.norm();
            let at_q0 = twist_by(if rate * IDENTIFICATION_STEP < 1.0 {
                IDENTIFICATION_STEP
            } else {
                IDENTIFICATION_STEP / rate
            })?;
            // Ad of the inverse motion of the joints before moves the twist at q0 back to position zero.
            let at_zero = at_q0.transformed_by(&before.inverse());
            before = before * at_zero.exp(q0[joint]);
            twists_in_base.push(at_zero);
        }
        Ok(Self { twists_in_base, base_from_tip_at_zero: before.inverse() * at_q0 })
    }

    /// The chain that a table describes, from link `base` to link `tip`; joints are its rows.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when `dof` is not that of the table's robot.
    pub fn from_dh(chain: &DhChain, dof: usize) -> Result<Self, KinematicsError> {
        let mut q = RobotQ::zeros(dof);
        Self::try_identify(chain.coordinates().len(), |rows| {
            q.set_chain(chain.coordinates(), rows);
            chain.base_from_tip(&q)
        })
    }

    /// The chain from link `base` to link `tip` of a robot; joints are its entries `coordinates` of
    /// the configuration vector, all others stay at zero.
    ///
    /// # Errors
    /// [`KinematicsError`] never comes for a link of the robot.
    pub fn from_urdf(
        robot: &Robot,
        base: LinkIndex,
        tip: LinkIndex,
        coordinates: &[usize],
    ) -> Result<Self, KinematicsError> {
        let tree = UrdfTree::new(robot);
        let mut q = RobotQ::zeros(robot.dof());
        Self::try_identify(coordinates.len(), |values| {
            q.set_chain(coordinates, values);
            let root_from_base = tree.root_from_link(&q, base)?;
            Ok(root_from_base.inverse() * tree.root_from_link(&q, tip)?)
        })
    }

    /// The body screws: the same twists at zero, expressed in the tip frame, `B_i = Ad(M^-1) S_i`.
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), section 4.1.2.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::{Pose, Screw, ScrewChain};
    /// use nalgebra::{Matrix3, Point3, Vector3};
    /// let chain = ScrewChain {
    ///     twists_in_base: vec![Screw::revolute(Vector3::z_axis(), &Point3::origin()).twist()],
    ///     base_from_tip_at_zero: Pose::from_parts(Matrix3::identity(), Vector3::x()),
    /// };
    /// let twists_in_tip = chain.twists_in_tip();
    /// assert_eq!(twists_in_tip[0].linear, Vector3::y()); // the tip, 1 m out, goes sideways
    /// assert_eq!(ScrewChain::from_twists_in_tip(&twists_in_tip, chain.base_from_tip_at_zero), chain);
    /// ```
    pub fn twists_in_tip(&self) -> Vec<Twist> {
        let tip_from_base = self.base_from_tip_at_zero.inverse();
        self.twists_in_base.iter().map(|twist| twist.transformed_by(&tip_from_base)).collect()
    }

    /// The chain with these body screws, the inverse of [`ScrewChain::twists_in_tip`].
    pub fn from_twists_in_tip(twists_in_tip: &[Twist], base_from_tip_at_zero: Pose) -> Self {
        let in_base = |twist: &Twist| twist.transformed_by(&base_from_tip_at_zero);
        Self { twists_in_base: twists_in_tip.iter().map(in_base).collect(), base_from_tip_at_zero }
    }

    /// Number of joints, each with one screw.
    pub fn joint_count(&self) -> usize {
        self.twists_in_base.len()
    }

    /// Pose of the tip in the base.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `q` | n | rad, m | joints of the chain, base to tip |
    /// | result | SE(3) | m | `base_from_tip` |
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when `q` has another length.
    pub fn base_from_tip(&self, q: &ChainQ) -> Result<Pose, KinematicsError> {
        KinematicsError::check_joints(self.twists_in_base.len(), q)?;
        let product = |pose: Pose, (twist, &q): (&Twist, &f64)| pose * twist.exp(q);
        let moved = self.twists_in_base.iter().zip(q).fold(Pose::identity(), product);
        Ok(moved * self.base_from_tip_at_zero)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    /// Rounding of a dozen exponentials within 2 m. Worst seen: 9e-16.
    const ROUNDING: f64 = 1e-14;

    #[test]
    fn a_chain_is_identified_from_its_poses() {
        let twist = |angular: [f64; 3], linear: [f64; 3]| Twist {
            angular: Vector3::from(angular),
            linear: Vector3::from(linear),
        };
        let chain = ScrewChain {
            twists_in_base: vec![
                twist([0.0, 0.0, 1.0], [0.0, 0.0, 0.0]),
                twist([0.0, 1.0, 0.0], [-0.3, 0.0, 0.1]),
                twist([0.0, 0.0, 0.0], [0.6, 0.0, 0.8]),
                twist([0.5, 0.0, 0.0], [0.0, 0.2, -0.1]), // a joint that moves half as far as it says
            ],
            base_from_tip_at_zero: twist([0.1, 0.2, 0.3], [1.0, 0.5, 0.2]).exp(1.0),
        };
        let identified = ScrewChain::identify(4, |q| chain.base_from_tip(q).unwrap());
        for (found, expected) in identified.twists_in_base.iter().zip(&chain.twists_in_base) {
            assert!((found.angular - expected.angular).norm() < ROUNDING);
            assert!((found.linear - expected.linear).norm() < ROUNDING);
        }
        assert!(identified.base_from_tip_at_zero.distance_m(&chain.base_from_tip_at_zero) < ROUNDING);
    }

    #[test]
    fn a_joint_in_degrees_does_not_wrap() {
        /// Rounding of a half radian divided by the step of 0.5/57.3 that it takes; worst seen 5e-14.
        const FAST: f64 = 5e-13;
        let turn =
            Twist { angular: Vector3::new(0.0, 180.0 / std::f64::consts::PI, 0.0), linear: Vector3::x() };
        let chain = ScrewChain { twists_in_base: vec![turn], base_from_tip_at_zero: Pose::identity() };
        let identified = ScrewChain::identify(1, |q| chain.base_from_tip(q).unwrap());
        assert!((identified.twists_in_base[0].angular - turn.angular).norm() < FAST);
        assert!((identified.twists_in_base[0].linear - turn.linear).norm() < FAST);
    }
}
