//! The corrections of a calibration as displacements: of the base, between the joints, and of the tool.

use congruent_kinematics::{Pose, ScrewChain};

use super::{
    corrected_chain::CorrectedChain,
    correction_parameter::{CorrectionEntry, CorrectionParameter},
};

/// What the corrections do to the chain, in link `base` at zero.
///
/// | field | shape | meaning |
/// |---|---|---|
/// | `base` | SE(3) | pose of link `base` in the frame in which the rows were measured |
/// | `zeros` | n | of each joint, the part of its slot that moves along its own screw |
/// | `slots` | n + 1 | of each slot all of the arm, `zeros` among them: slot 0 is before the first joint, k behind joint k |
/// | `tool` | SE(3) | behind everything |
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Displacements {
    pub(crate) base: Pose,
    pub(crate) zeros: Vec<Pose>,
    pub(crate) slots: Vec<Pose>,
    pub(crate) tool: Pose,
}

impl Displacements {
    pub(crate) fn new(chain: &CorrectedChain, values: &[f64]) -> Self {
        let joints = chain.nominal().joint_count();
        let mut all = Self {
            base: Pose::identity(),
            zeros: vec![Pose::identity(); joints],
            slots: vec![Pose::identity(); joints + 1],
            tool: Pose::identity(),
        };
        for (parameter, value) in chain.parameters().iter().zip(values) {
            let step = parameter.generator_in_base.exp(*value);
            match parameter.entry {
                // In a slot the base comes first and the tool last, so each is a factor of its own.
                CorrectionEntry::Base => all.base = all.base * step,
                CorrectionEntry::Tool => all.tool = all.tool * step,
                _ => all.slots[parameter.slot] = all.slots[parameter.slot] * step,
            }
            if let Some(joint) = along_its_joint(parameter) {
                all.zeros[joint] = all.zeros[joint] * step;
            }
        }
        all
    }

    /// The corrected chain: screws at zero in the frame in which the rows were measured.
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), eq. 4.14 with `E exp([S] q) E^-1 = exp([Ad(E) S] q)`.
    pub(crate) fn screws(&self, nominal: &ScrewChain) -> ScrewChain {
        let mut before = self.base * self.slots[0];
        let mut twists_in_base = Vec::with_capacity(nominal.joint_count());
        for (twist, slot) in nominal.twists_in_base.iter().zip(&self.slots[1..]) {
            twists_in_base.push(twist.transformed_by(&before));
            before = before * *slot;
        }
        let base_from_tip_at_zero = before * self.tool * nominal.base_from_tip_at_zero;
        ScrewChain { twists_in_base, base_from_tip_at_zero }
    }
}

/// The joint along whose own screw a correction moves: such a one may be counted before the joint or behind it, and turns the
/// link of the joint as well.
fn along_its_joint(parameter: &CorrectionParameter) -> Option<usize> {
    let is_along = matches!(
        parameter.entry,
        CorrectionEntry::Zero | CorrectionEntry::JointEntry | CorrectionEntry::ConstantEntry
    );
    parameter.joint.filter(|_| is_along)
}
