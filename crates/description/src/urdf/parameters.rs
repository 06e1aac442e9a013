//! Where a URDF writes parameters of links and joints, and the edits of its text that change them.

use std::{ops::Range, sync::Arc};

use congruent_input::{SourceFile, TextEdit};
use congruent_robot::{Inertia, JointResistance};

use super::places::UrdfPlaces;
use crate::parameter_places::{JointElement, ParameterPlace, ParameterPlaces};

impl UrdfPlaces {
    fn place_of(&self, span: Range<usize>) -> ParameterPlace {
        ParameterPlace { source: Arc::clone(UrdfPlaces::source(self)), span, class: None }
    }

    fn parameter_span(&self, of: &str, parameter: &str) -> Option<Range<usize>> {
        match parameter {
            "mass" => self.inertial_part(of, "mass"),
            "com_x" | "com_y" | "com_z" => self.inertial_part(of, "origin"),
            "ixx" | "ixy" | "ixz" | "iyy" | "iyz" | "izz" => self.inertial_part(of, "inertia"),
            "damping" | "friction" | "armature" => self.joint_dynamics(of),
            "velocity" | "effort" | "lower" | "upper" | "acceleration" | "deceleration" | "jerk" => {
                self.joint_limit(of)
            }
            _ => None,
        }
    }
}

impl ParameterPlaces for UrdfPlaces {
    fn source(&self) -> &Arc<SourceFile> {
        UrdfPlaces::source(self)
    }

    fn parameter(&self, of: &str, parameter: &str) -> Option<ParameterPlace> {
        Some(self.place_of(self.parameter_span(of, parameter)?))
    }

    fn joint_part(&self, joint: &str, part: JointElement) -> Option<ParameterPlace> {
        let span = match part {
            JointElement::Origin => self.joint_origin(joint),
            JointElement::Axis => self.joint_axis(joint),
            JointElement::Mimic => self.joint_mimic(joint),
        };
        Some(self.place_of(span?))
    }

    fn states_joint_terms(&self, joint: &str) -> bool {
        self.has_joint_dynamics(joint)
    }

    fn set_inertial(&self, link: &str, inertia: &Inertia) -> Option<Vec<TextEdit>> {
        Some(self.set_inertia(link, inertia))
    }

    fn set_terms(&self, joint: &str, terms: &JointResistance) -> Option<Vec<TextEdit>> {
        Some(self.set_joint_dynamics(joint, terms.damping, terms.friction))
    }

    fn link_text(&self, link: &str) -> Option<String> {
        self.link_with_its_joint(link)
    }

    fn add_link(&self, text: &str) -> Vec<TextEdit> {
        self.add_elements(text)
    }

    fn set_limit(&self, joint: &str, parameter: &str, value: f64) -> Vec<TextEdit> {
        self.set_joint_limit(joint, parameter, value)
    }
}
