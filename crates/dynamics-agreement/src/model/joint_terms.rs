//! The three torque terms of a joint itself: damping, dry friction, armature.

use congruent_dynamics::JointResistance;
use congruent_input::SiUnit;

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

    pub(crate) fn unit(self, joint: &JointPlace) -> SiUnit {
        match (self, joint.is_angular) {
            (Self::Damping, true) => SiUnit::NewtonMetreSecondPerRadian,
            (Self::Damping, false) => SiUnit::NewtonSecondPerMetre,
            (Self::Friction, _) => joint.effort_unit(),
            (Self::Armature, true) => SiUnit::KilogramSquareMetre,
            (Self::Armature, false) => SiUnit::Kilogram,
        }
    }
}
