//! The three torque terms of a joint itself: damping, dry friction, armature.

use congruent_dynamics::JointResistance;

use super::frames::JointPlace;

/// A torque term of a joint, with its name and unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum JointTerm {
    Damping,
    Friction,
    Armature,
}

impl JointTerm {
    pub(crate) const ALL: [Self; 3] = [Self::Damping, Self::Friction, Self::Armature];

    pub(crate) fn value_in(self, resistance: &JointResistance) -> f64 {
        match self {
            Self::Damping => resistance.damping,
            Self::Friction => resistance.friction,
            Self::Armature => resistance.armature,
        }
    }

    pub(crate) fn set(self, resistance: &mut JointResistance, value: f64) {
        match self {
            Self::Damping => resistance.damping = value,
            Self::Friction => resistance.friction = value,
            Self::Armature => resistance.armature = value,
        }
    }

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Damping => "damping",
            Self::Friction => "friction",
            Self::Armature => "armature",
        }
    }

    pub(crate) fn unit(self, joint: &JointPlace) -> &'static str {
        match (self, joint.is_angular) {
            (Self::Damping, true) => "N m s/rad",
            (Self::Damping, false) => "N s/m",
            (Self::Friction, true) => "N m",
            (Self::Friction, false) => "N",
            (Self::Armature, true) => "kg m^2",
            (Self::Armature, false) => "kg",
        }
    }
}
