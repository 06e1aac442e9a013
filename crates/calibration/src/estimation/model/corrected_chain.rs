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
    /// One entry for each correction.
    start: Vec<f64>,
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
        // `linearise` visits slots in order and takes parameters as they come, without searching.
        parameters.sort_by_key(|parameter| parameter.slot);
        let start = vec![0.0; parameters.len()];
        Self { chain, parameters, start }
    }

    /// The corrections, in the order of the vector `p`.
    pub fn parameters(&self) -> &[CorrectionParameter] {
        &self.parameters
    }

    /// The corrections at which an estimate starts, about which it is decided what is identified, and at which the others are
    /// held: 0, the nominal chain, unless base and tool were aligned before.
    pub fn start(&self) -> &[f64] {
        &self.start
    }

    /// The same chain with another start.
    ///
    /// # Panics
    /// If `start` has another length than there are corrections.
    #[must_use]
    pub fn starting_at(&self, start: Vec<f64>) -> Self {
        assert_eq!(start.len(), self.parameters.len(), "one entry for each correction");
        Self { start, ..self.clone() }
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
        self.at(p).base_from_tip(q)
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
        self.at(p).linearise(q, twists_in_base)
    }

    /// The chain at these corrections, for many configurations.
    ///
    /// # Panics
    /// If `p` has another length.
    pub(in crate::estimation) fn at(&self, p: &[f64]) -> ChainAt<'_> {
        assert_eq!(p.len(), self.parameters.len(), "one entry for each correction");
        let mut slots = vec![Pose::identity(); self.chain.joint_count() + 1];
        let generator = |(parameter, p): (&CorrectionParameter, &f64)| {
            // Before its own exponential is multiplied: the generator commutes with it.
            let before = &mut slots[parameter.slot];
            let generator = parameter.generator_in_base.transformed_by(before);
            *before = *before * parameter.generator_in_base.exp(*p);
            generator
        };
        let generators = self.parameters.iter().zip(p).map(generator).collect();
        ChainAt { chain: self, slots, generators }
    }
}

/// A corrected chain at some corrections. They are the same for all measurements, so the motions of their slots are computed
/// once: a configuration then takes two products for each joint, however many corrections there are.
#[derive(Debug, Clone)]
pub(in crate::estimation) struct ChainAt<'a> {
    chain: &'a CorrectedChain,
    /// The motion of all corrections of each slot.
    slots: Vec<Pose>,
    /// The generator of each correction in the frame before its slot, moved by the corrections before it there.
    generators: Vec<Twist>,
}

impl ChainAt<'_> {
    /// [`CorrectedChain::base_from_tip`] at these corrections.
    pub(in crate::estimation) fn base_from_tip(&self, q: &ChainQ) -> Pose {
        self.walk(q, |_, _| {})
    }

    /// [`CorrectedChain::linearise`] at these corrections.
    pub(in crate::estimation) fn linearise(&self, q: &ChainQ, twists_in_base: &mut [Twist]) -> Pose {
        assert_eq!(twists_in_base.len(), self.generators.len(), "one twist for each correction");
        let mut at = 0;
        // Sorted by slot: the corrections of a slot follow those of the slots before it.
        self.walk(q, |slot, before| {
            while self.chain.parameters.get(at).is_some_and(|parameter| parameter.slot == slot) {
                twists_in_base[at] = self.generators[at].transformed_by(before);
                at += 1;
            }
        })
    }

    /// Visits each slot with the pose before it.
    fn walk(&self, q: &ChainQ, mut each: impl FnMut(usize, &Pose)) -> Pose {
        let chain = &self.chain.chain;
        assert_eq!(q.len(), chain.joint_count(), "one entry for each joint");
        let mut pose = Pose::identity();
        for (slot, corrections) in self.slots.iter().enumerate() {
            if slot > 0 {
                pose = pose * chain.twists_in_base[slot - 1].exp(q[slot - 1]);
            }
            each(slot, &pose);
            pose = pose * *corrections;
        }
        pose * chain.base_from_tip_at_zero
    }
}
