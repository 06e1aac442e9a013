//! The two frames that are aligned, and which of them may move.

use congruent_kinematics::Pose;

/// Poses of the two ends of the chain: `measured_from_target = measured_from_base * base_from_tip * tip_from_target`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BaseAndTool {
    /// Of the base in the frame in which the rows were measured.
    pub(super) measured_from_base: Pose,
    /// Of the measured target in the tip.
    pub(super) tip_from_target: Pose,
}

/// Which of the two frames may move; the other one is the identity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct WhichFrames {
    pub(super) base: bool,
    pub(super) tool: bool,
}

impl WhichFrames {
    /// The same frames of the chain that is gone through from its other end.
    pub(super) fn reversed(self) -> Self {
        Self { base: self.tool, tool: self.base }
    }
}

impl BaseAndTool {
    /// The same frames of the chain that is gone through from its other end: `M = B A T` is `M^-1 = T^-1 A^-1 B^-1`.
    pub(super) fn reversed(&self) -> Self {
        Self {
            measured_from_base: self.tip_from_target.inverse(),
            tip_from_target: self.measured_from_base.inverse(),
        }
    }

    /// Pose of the target, in the frame in which the rows were measured.
    pub(super) fn measured_from_target(&self, base_from_tip: &Pose) -> Pose {
        self.measured_from_base * *base_from_tip * self.tip_from_target
    }
}
