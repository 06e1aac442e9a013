//! A chain with corrections between its joints: pose, and the exact derivative by each of them.

use congruent_description::ChainQ;
use congruent_kinematics::{Pose, ScrewChain, Twist};

use super::correction_parameter::CorrectionParameter;

/// A serial chain with corrections `p`: with `E_k` the product of `exp(G_j p_j)` over the corrections
/// of slot k,
/// `base_from_tip(q, p) = E_0 exp(S_1 q_1) E_1 ... exp(S_n q_n) E_n base_from_tip(0, 0)`.
///
/// Source: the local form of the product of exponentials; Okamura & Park, *Kinematic calibration
/// using the product of exponentials formula* (1996).
///
/// # Examples
/// ```
/// use congruent_kinematics::{Pose, ScrewChain, Twist};
/// use congruent_calibration::estimation::{CorrectedChain, zero_offsets};
/// use nalgebra::{Matrix3, Vector3};
/// let axis = Twist { angular: Vector3::z(), linear: Vector3::zeros() };
/// let at_zero = Pose::from_parts(Matrix3::identity(), Vector3::x());
/// let chain = ScrewChain { twists_in_base: vec![axis], base_from_tip_at_zero: at_zero };
/// let corrected = CorrectedChain::new(chain.clone(), zero_offsets(&chain, &["joint"]));
/// let moved = corrected.base_from_tip(&[0.3].into(), &[0.2]);
/// assert!(moved.distance_m(&chain.base_from_tip(&[0.5].into())?) < 4.0 * f64::EPSILON);
/// # Ok::<(), congruent_kinematics::KinematicsError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct CorrectedChain {
    chain: ScrewChain,
    /// Sorted by slot, as they are applied along the chain.
    parameters: Vec<CorrectionParameter>,
}

impl CorrectedChain {
    /// Sorts the corrections by slot; those of one slot keep their order, in which they compose.
    ///
    /// # Panics
    /// If a slot lies behind the chain's last joint.
    pub fn new(chain: ScrewChain, mut parameters: Vec<CorrectionParameter>) -> Self {
        let slots = chain.joint_count();
        assert!(
            parameters.iter().all(|parameter| parameter.slot <= slots),
            "slots end behind the last joint"
        );
        // `walk` visits slots in order and takes parameters as they come, without searching.
        parameters.sort_by_key(|parameter| parameter.slot);
        Self { chain, parameters }
    }

    /// The corrections, in the order of the vector `p`.
    pub fn parameters(&self) -> &[CorrectionParameter] {
        &self.parameters
    }

    /// The chain without corrections.
    pub fn nominal(&self) -> &ScrewChain {
        &self.chain
    }

    /// Pose of the tip in the base.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `q` | n | rad, m | joints of the chain |
    /// | `p` | number of corrections | rad, m | |
    /// | result | SE(3) | m | `base_from_tip` |
    ///
    /// # Panics
    /// If `q` or `p` has another length.
    pub fn base_from_tip(&self, q: &ChainQ, p: &[f64]) -> Pose {
        self.walk(q, p, |_, _| {})
    }

    /// The pose, and for each correction the twist `(dT/dp_j) T^-1` of the tip, in the base.
    ///
    /// A correction's generator is transformed by everything before it:
    /// `Ad(E_0 exp(S_1 q_1) ... ) G_j`; it commutes with its own exponential.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `twists_in_base` | number of corrections | 1 per unit of the correction | base |
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), eq. 5.11, for corrections instead of joints.
    ///
    /// # Panics
    /// If `q`, `p` or `twists_in_base` has another length.
    pub fn linearise(&self, q: &ChainQ, p: &[f64], twists_in_base: &mut [Twist]) -> Pose {
        assert_eq!(twists_in_base.len(), self.parameters.len(), "one twist for each correction");
        self.walk(q, p, |at, before| {
            twists_in_base[at] = self.parameters[at].generator_in_base.transformed_by(before);
        })
    }

    fn walk(&self, q: &ChainQ, p: &[f64], mut each: impl FnMut(usize, &Pose)) -> Pose {
        assert_eq!(q.len(), self.chain.joint_count(), "one entry for each joint");
        assert_eq!(p.len(), self.parameters.len(), "one entry for each correction");
        let mut pose = Pose::identity();
        let mut at = 0;
        for slot in 0..=q.len() {
            if slot > 0 {
                pose = pose * self.chain.twists_in_base[slot - 1].exp(q[slot - 1]);
            }
            // Before its own exponential is multiplied: the generator commutes with it, and `pose` is then
            // everything before the correction.
            while at < p.len() && self.parameters[at].slot == slot {
                each(at, &pose);
                pose = pose * self.parameters[at].generator_in_base.exp(p[at]);
                at += 1;
            }
        }
        pose * self.chain.base_from_tip_at_zero
    }
}
