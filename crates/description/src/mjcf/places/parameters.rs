//! Where an MJCF writes masses, limits and losses.

use std::sync::Arc;

use congruent_input::{SourceFile, TextEdit};
use congruent_mjcf::{MjActuator, MjEffort, MjInertial, MjPlace, MjTarget};
use congruent_robot::{Inertia, JointResistance};

use super::MjcfPlaces;
use crate::parameter_places::{JointElement, ParameterPlace, ParameterPlaces};

impl ParameterPlaces for MjcfPlaces {
    fn source(&self) -> &Arc<SourceFile> {
        &self.files[0]
    }

    fn parameter(&self, of: &str, parameter: &str) -> Option<ParameterPlace> {
        let place = match parameter {
            "mass" => self.of_inertial(of, |inertial| inertial.mass.place.as_ref()),
            "com_x" | "com_y" | "com_z" => self.of_inertial(of, |inertial| inertial.pos.place.as_ref()),
            "ixx" | "ixy" | "ixz" | "iyy" | "iyz" | "izz" => {
                self.of_inertial(of, |inertial| inertial.inertia.place.as_ref())
            }
            "damping" | "friction" | "armature" => self.of_losses(of, parameter),
            "effort" => self.of_effort(self.joint(of)?.0),
            "lower" | "upper" => {
                let (_, joint) = self.joint(of)?;
                Some(joint.range.as_ref().and_then(|range| range.place.as_ref()).unwrap_or(&joint.place))
            }
            // An MJCF has no other limits.
            _ => None,
        };
        place.map(|place| self.named(place))
    }

    fn joint_part(&self, joint: &str, part: JointElement) -> Option<ParameterPlace> {
        self.part_of_joint(joint, part)
    }

    fn writes_joint_terms(&self, joint: &str) -> bool {
        let joint = self.joint(joint).map(|(_, joint)| joint);
        joint.is_some_and(|of| {
            of.damping.place.is_some() || of.friction_loss.place.is_some() || of.armature.place.is_some()
        })
    }

    fn set_inertial(&self, link: &str, inertia: &Inertia) -> Option<Vec<TextEdit>> {
        self.inertial_edits(link, inertia)
    }

    fn set_terms(&self, joint: &str, terms: &JointResistance) -> Option<Vec<TextEdit>> {
        self.loss_edits(joint, terms)
    }

    fn set_limit(&self, joint: &str, parameter: &str, value: f64) -> Vec<TextEdit> {
        self.limit_edits(joint, parameter, value)
    }
}

impl MjcfPlaces {
    /// A part of the `<inertial>`, or the element if that is missing. Where the mass follows from geoms, the only one of them, or
    /// the body.
    fn of_inertial(&self, link: &str, part: impl Fn(&MjInertial) -> Option<&MjPlace>) -> Option<&MjPlace> {
        let (index, body) = self.body(link)?;
        Some(match (&self.model.geoms_of_mass(index)[..], &body.inertial) {
            ([], Some(inertial)) => part(inertial).unwrap_or(&inertial.place),
            ([only], _) => only.mass.place.as_ref().unwrap_or(&only.place),
            _ => &body.place,
        })
    }

    /// A loss of the joint, or the joint if the file does not state it; of one that an actuator adds, the actuator.
    fn of_losses(&self, joint: &str, parameter: &str) -> Option<&MjPlace> {
        let (index, joint) = self.joint(joint)?;
        let own = match parameter {
            "damping" => joint.damping.place.as_ref(),
            "friction" => joint.friction_loss.place.as_ref(),
            _ => joint.armature.place.as_ref(),
        };
        let adds = |actuator: &&MjActuator| match parameter {
            "damping" => actuator.damping != 0.0,
            "armature" => actuator.armature != 0.0,
            _ => false,
        };
        let actuator = || self.actuators_of(index).find(adds).map(|actuator| &actuator.place);
        Some(own.or_else(actuator).unwrap_or(&joint.place))
    }

    /// The range of forces that limits the effort: of the joint, or of its first actuator.
    pub(super) fn of_effort(&self, joint: usize) -> Option<&MjPlace> {
        let joint = &self.model.joints[joint];
        let MjEffort::Within { places, .. } = &joint.effort else { return None };
        // The limit of the joint is behind those of the actuators, and only there if it is the smaller one.
        let of_joint = joint.actuator_force_range.as_ref().and_then(|range| range.place.as_ref());
        places.last().filter(|last| Some(*last) == of_joint).or_else(|| places.first())
    }

    /// The actuators that act on a joint itself.
    pub(super) fn actuators_of(&self, joint: usize) -> impl Iterator<Item = &MjActuator> {
        self.model.actuators.iter().filter(move |actuator| actuator.target == MjTarget::Joint(joint))
    }
}
