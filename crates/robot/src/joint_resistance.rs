//! What a joint itself does against its motion.

use crate::joint::Joint;

/// The resistance of a joint itself: damping, dry friction and armature.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointResistance {
    /// Viscous damping, N m s/rad or N s/m.
    pub damping: f64,
    /// Dry friction against the motion, N m or N; zero at rest.
    pub friction: f64,
    /// Inertia of motor and gear as the joint feels it, kg m^2 or kg.
    pub armature: f64,
}

impl From<&Joint> for JointResistance {
    /// The values of a description; an armature that it does not state counts as zero.
    fn from(joint: &Joint) -> Self {
        let armature = joint.armature.unwrap_or(0.0);
        Self { damping: joint.damping, friction: joint.friction, armature }
    }
}

impl JointResistance {
    /// Torque of damping and dry friction against a speed, N m or N.
    #[inline]
    pub fn against_speed(&self, qd: f64) -> f64 {
        // `signum` of zero is one, but there is no friction at rest.
        let direction = if qd == 0.0 { 0.0 } else { qd.signum() };
        self.damping * qd + self.friction * direction
    }
}
