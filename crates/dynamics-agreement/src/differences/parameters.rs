//! Parameters of links, joints and gravity that differ, each as one entry.

use congruent_description::PlaceElsewhere;
use congruent_dynamics::JointResistance;
use congruent_input::SiUnit;
use nalgebra::{Matrix3, Vector3};

use crate::{
    model::{Frames, Inertial, JointTerm},
    thresholds::SAME_VALUE,
};

/// One parameter of a link, a joint or of gravity that differs, with both values.
#[derive(Debug, Clone, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct ParameterDifference {
    /// Name of the link or joint that has the parameter; empty for gravity.
    pub of: String,
    /// `mass`, `com_x`, `ixx`, `damping`, ...
    #[serde(rename = "figure")]
    pub parameter: String,
    /// The candidate's value; `null` if it gives none.
    pub found: Option<f64>,
    /// The corrected value, or the reference's; `null` if there is none.
    pub expected: Option<f64>,
    /// SI unit of `found` and `expected`.
    #[schemars(with = "String")]
    pub unit: SiUnit,
    /// Line of the parameter in the candidate's file; `null` if it is not known.
    pub line: Option<usize>,
    /// Line of the parameter in the reference's file; `null` if it is not known.
    pub expected_line: Option<usize>,
    /// Where the candidate's value is written if its element does not write it in the candidate's file.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub elsewhere: Option<PlaceElsewhere>,
    /// The same of the reference.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub expected_elsewhere: Option<PlaceElsewhere>,
    /// Whether `expected` is what gives the torques of the reference, and not what its file writes: it has other links as one, or writes
    /// the same body in other parameters.
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    pub is_computed: bool,
    /// The relative change of all torques by this difference alone, if it is below the resolution of the comparison; `null`
    /// if the parameter has no effect on torques, or one above the resolution.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub below_resolution: Option<f64>,
    /// The same change, if it is above the resolution and the other differences cancel it: the parameters differ, and all
    /// torques agree.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub cancelled: Option<f64>,
}

impl ParameterDifference {
    /// Whether it is a component of gravity, which belongs to no link and no joint.
    pub fn is_of_gravity(&self) -> bool {
        self.parameter.starts_with("gravity_")
    }
}

const PARAMETER_UNITS: [(&str, SiUnit); 10] = [
    ("mass", SiUnit::Kilogram),
    ("com_x", SiUnit::Metre),
    ("com_y", SiUnit::Metre),
    ("com_z", SiUnit::Metre),
    ("ixx", SiUnit::KilogramSquareMetre),
    ("ixy", SiUnit::KilogramSquareMetre),
    ("ixz", SiUnit::KilogramSquareMetre),
    ("iyy", SiUnit::KilogramSquareMetre),
    ("iyz", SiUnit::KilogramSquareMetre),
    ("izz", SiUnit::KilogramSquareMetre),
];

/// The ten parameters of an inertial, each with the size that its difference is relative to: of one coordinate the largest
/// coordinate, of one entry of the tensor the largest entry.
fn parameters(inertial: &Inertial, t: &Matrix3<f64>) -> ([f64; 10], [f64; 10]) {
    let (m, c) = (inertial.mass_kg, inertial.com_m);
    let (length, size) = (c.amax(), t.amax());
    let values = [m, c.x, c.y, c.z, t[(0, 0)], t[(0, 1)], t[(0, 2)], t[(1, 1)], t[(1, 2)], t[(2, 2)]];
    let mut sizes = [size; 10];
    sizes[0] = m.abs();
    sizes[1..4].fill(length);
    (values, sizes)
}

/// A parameter of an inertial with this tensor by its name, with the size that its difference is relative to; `None` if no inertial has it.
pub(crate) fn parameter(name: &str, inertial: &Inertial, tensor: &Matrix3<f64>) -> Option<(f64, f64)> {
    let at = PARAMETER_UNITS.iter().position(|(parameter, _)| *parameter == name)?;
    let (values, sizes) = parameters(inertial, tensor);
    Some((values[at], sizes[at]))
}

/// The parameters of a link that differ. Tensors are compared as they are written if the axes are the same, else in the
/// axes of the link.
pub(crate) fn link_differences(
    name: &str,
    found: Option<&Inertial>,
    expected: Option<&Inertial>,
) -> Vec<ParameterDifference> {
    let as_written = match (found, expected) {
        // Written values are easier to find in the file; with different axes they are not comparable entry by
        // entry.
        (Some(found), Some(expected)) => found.link_from_axes == expected.link_from_axes,
        _ => true,
    };
    let tensor = |inertial: &Inertial| {
        if as_written { inertial.tensor_kg_m2 } else { inertial.tensor_in_link() }
    };
    let values = [found, expected].map(|model| model.map(|inertial| parameters(inertial, &tensor(inertial))));
    let differs = |at: usize| match &values {
        [Some((a, sizes)), Some((b, other_sizes))] => {
            (a[at] - b[at]).abs() > SAME_VALUE * sizes[at].max(other_sizes[at])
        }
        [None, None] => false,
        _ => true,
    };
    let value = |model: usize, at: usize| values[model].as_ref().map(|(values, _)| values[at]);
    let all = PARAMETER_UNITS.into_iter().enumerate().filter(|(at, _)| differs(*at));
    all.map(|(at, (parameter, unit))| ParameterDifference {
        of: name.to_owned(),
        parameter: parameter.to_owned(),
        found: value(0, at),
        expected: value(1, at),
        unit,
        line: None,
        expected_line: None,
        elsewhere: None,
        expected_elsewhere: None,
        below_resolution: None,
        is_computed: false,
        cancelled: None,
    })
    .collect()
}

/// Damping, friction and armature of joints that differ.
pub(crate) fn joint_term_differences(
    frames: &Frames,
    found: &[JointResistance],
    expected: &[JointResistance],
) -> Vec<ParameterDifference> {
    let mut differences = Vec::new();
    for (joint, (found, expected)) in frames.joints.iter().zip(found.iter().zip(expected)) {
        for term in JointTerm::ALL {
            let (found, expected) = (term.value_in(found), term.value_in(expected));
            if (found - expected).abs() > SAME_VALUE * found.abs().max(expected.abs()) {
                differences.push(ParameterDifference {
                    of: joint.name.clone(),
                    parameter: term.name().to_owned(),
                    found: Some(found),
                    expected: Some(expected),
                    unit: term.unit(joint),
                    line: None,
                    expected_line: None,
                    elsewhere: None,
                    expected_elsewhere: None,
                    below_resolution: None,
                    is_computed: false,
                    cancelled: None,
                });
            }
        }
    }
    differences
}

/// The components of gravity that differ.
pub(crate) fn gravity_differences(found: &Vector3<f64>, expected: &Vector3<f64>) -> Vec<ParameterDifference> {
    let size = found.amax().max(expected.amax());
    let names = ["gravity_x", "gravity_y", "gravity_z"].into_iter().enumerate();
    let differing = names.filter(|(at, _)| (found[*at] - expected[*at]).abs() > SAME_VALUE * size);
    differing
        .map(|(at, name)| ParameterDifference {
            of: String::new(),
            parameter: name.to_owned(),
            found: Some(found[at]),
            expected: Some(expected[at]),
            unit: SiUnit::MetrePerSecondSquared,
            line: None,
            expected_line: None,
            elsewhere: None,
            expected_elsewhere: None,
            below_resolution: None,
            is_computed: false,
            cancelled: None,
        })
        .collect()
}
