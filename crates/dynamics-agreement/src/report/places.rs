//! Places of parameters in a file, and the edits that change them.

use std::{fmt::Debug, ops::Range};

use congruent_description::{Inertia, UrdfPlaces};
use congruent_dynamics::JointResistance;
use congruent_input::{ChangedLines, SourceFile, TextEdit, changed_lines, line_column};
use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

use crate::{
    differences::{LimitDifference, ParameterDifference, limits::UNIFORM_THERE},
    model::Inertial,
    thresholds::{SAME_VALUE, ZERO_VALUE},
};

/// A file with parameters of links, joints or gravity that can be located and edited.
pub trait ParameterPlaces: Debug {
    /// The file with its text.
    fn source(&self) -> &SourceFile;

    /// Place of a parameter, such as `mass` or `com_x`, in the text; `of` is the link or joint, empty for gravity.
    fn parameter(&self, of: &str, parameter: &str) -> Option<Range<usize>>;

    /// Whether the file has an entry for damping and dry friction of a joint: if not, their zeros are no statement.
    fn states_joint_terms(&self, _joint: &str) -> bool {
        true
    }

    /// The edits that give a link these parameters; empty if the file format cannot express them.
    fn set_inertial(&self, link: &str, parameters: &Inertial) -> Vec<TextEdit>;

    /// The edits that give a joint these terms; empty if the file format cannot express them.
    fn set_terms(&self, joint: &str, terms: &JointResistance) -> Vec<TextEdit>;

    /// The edits that set gravity, in the root link; empty if the file format cannot express it.
    fn set_gravity(&self, gravity_m_s2: &Vector3<f64>) -> Vec<TextEdit>;

    /// The text of a link and of the joint that carries it, to be added to another file; `None` if the file has no such link.
    fn link_text(&self, _link: &str) -> Option<String> {
        None
    }

    /// The edits that add a link of another file; empty if the file format cannot express it.
    fn add_link(&self, _text: &str) -> Vec<TextEdit> {
        Vec::new()
    }

    /// The edits that set a limit of a joint, such as `effort`; empty if the file format cannot express it.
    fn set_limit(&self, _joint: &str, _parameter: &str, _value: f64) -> Vec<TextEdit> {
        Vec::new()
    }
}

impl dyn ParameterPlaces + '_ {
    fn line(&self, of: &str, parameter: &str) -> Option<usize> {
        let at = self.parameter(of, parameter)?;
        Some(line_column(&self.source().text, at.start).0)
    }

    pub(crate) fn lines(&self, edits: &[TextEdit]) -> Vec<ChangedLines> {
        changed_lines(&self.source().text, edits)
    }
}

/// The files of the two models; `None` if the places of their parameters are not known.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ModelFiles<'a> {
    pub(crate) found: Option<&'a dyn ParameterPlaces>,
    pub(crate) expected: Option<&'a dyn ParameterPlaces>,
}

impl ModelFiles<'_> {
    pub(crate) fn place(&self, differences: &mut [ParameterDifference]) {
        for difference in differences {
            let line = |file: Option<&dyn ParameterPlaces>| file?.line(&difference.of, &difference.parameter);
            (difference.line, difference.expected_line) = (line(self.found), line(self.expected));
        }
    }

    pub(crate) fn place_limits(&self, differences: &mut [LimitDifference]) {
        for difference in &mut *differences {
            let line =
                |file: Option<&dyn ParameterPlaces>| file?.line(&difference.joint, &difference.parameter);
            (difference.line, difference.expected_line) = (line(self.found), line(self.expected));
        }
        let Some(file) = self.found else { return };
        // A placeholder is no value to write.
        let set = |of: &LimitDifference| {
            let expected = of.expected.filter(|_| of.detail != UNIFORM_THERE);
            expected.map_or_else(Vec::new, |value| file.set_limit(&of.joint, &of.parameter, value))
        };
        let edits: Vec<Vec<TextEdit>> = differences.iter().map(set).collect();
        let joints: Vec<String> = differences.iter().map(|of| of.joint.clone()).collect();
        for (difference, own) in differences.iter_mut().zip(&edits) {
            difference.file = Some(file.source().path.display().to_string());
            if !own.is_empty() {
                let of_joint = edits.iter().zip(&joints).filter(|(_, joint)| **joint == difference.joint);
                // All limits of a joint are one element: edits of one limit alone would leave the others wrong in
                // the suggested line.
                let all: Vec<TextEdit> = of_joint.flat_map(|(edits, _)| edits.iter().cloned()).collect();
                difference.changes = file.lines(&all);
            }
        }
    }
}

impl ParameterPlaces for UrdfPlaces {
    fn source(&self) -> &SourceFile {
        UrdfPlaces::source(self)
    }

    fn parameter(&self, of: &str, parameter: &str) -> Option<Range<usize>> {
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

    fn states_joint_terms(&self, joint: &str) -> bool {
        self.has_joint_dynamics(joint)
    }

    fn set_inertial(&self, link: &str, parameters: &Inertial) -> Vec<TextEdit> {
        let rotation = Rotation3::from_matrix_unchecked(parameters.link_from_axes);
        let inertia = Inertia {
            mass_kg: parameters.mass_kg,
            link_from_inertial: Isometry3::from_parts(
                Translation3::from(parameters.com_m),
                UnitQuaternion::from_rotation_matrix(&rotation),
            ),
            tensor_kg_m2: parameters.tensor_kg_m2,
        };
        self.set_inertia(link, &inertia)
    }

    fn set_terms(&self, joint: &str, terms: &JointResistance) -> Vec<TextEdit> {
        self.set_joint_dynamics(joint, terms.damping, terms.friction)
    }

    fn set_gravity(&self, _: &Vector3<f64>) -> Vec<TextEdit> {
        Vec::new()
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

/// Corrected parameters as they should be written: values that differ from the written ones by rounding alone keep the written
/// digits, and values that differ from zero by rounding alone become zero.
pub(super) fn without_rounding(written: Option<&Inertial>, corrected: &Inertial) -> Inertial {
    let nothing = Inertial::nothing();
    let written = written.unwrap_or(&nothing);
    let kept = |old: f64, new: f64, size: f64| match new {
        // Before the comparison with zero, so that a written tiny value is kept rather than cleared.
        _ if (old - new).abs() <= SAME_VALUE * size => old,
        _ if new.abs() <= ZERO_VALUE * size => 0.0,
        _ => new,
    };
    let mass = written.mass_kg.abs().max(corrected.mass_kg.abs());
    let length = corrected.com_m.amax();
    let mut parameters = Inertial {
        mass_kg: kept(written.mass_kg, corrected.mass_kg, mass),
        com_m: written.com_m.zip_map(&corrected.com_m, |old, new| kept(old, new, length)),
        ..*corrected
    };
    let size = corrected.tensor_kg_m2.amax();
    // Of axes that turn by rounding alone the written angles are kept.
    parameters.tensor_kg_m2 = if (written.link_from_axes - corrected.link_from_axes).amax() <= SAME_VALUE {
        parameters.link_from_axes = written.link_from_axes;
        written.tensor_kg_m2.zip_map(&corrected.tensor_kg_m2, |old, new| kept(old, new, size))
    } else {
        corrected.tensor_kg_m2.map(|new| kept(0.0, new, size))
    };
    // Rounded entry by entry, the two halves could differ; the upper one decides.
    parameters.tensor_kg_m2 = Matrix3::from_fn(|row, column| {
        let at = if row <= column { (row, column) } else { (column, row) };
        parameters.tensor_kg_m2[at]
    });
    parameters
}
