//! The URDF against the `[[inertial]]` entries of the robot file: a vendor's masses, in link frames or DH frames.

use std::sync::Arc;

use congruent_description::{
    DeclaredInertial, DynamicsTable, Inertia, InertialPlaces, JointResistance, ParameterPlace,
    ParameterPlaces, Robot, RobotDescription,
};
use congruent_dynamics_agreement::{
    CompareError, DynamicsCause, DynamicsExplanation, DynamicsModel, DynamicsReport, Inertial, NamedModel,
    ParameterDifference, compare,
};
use congruent_input::{SourceFile, TextEdit};
use congruent_kinematics::{Pose, PoseError};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::Serialize;

use super::{
    declared_body::DeclaredBody,
    declared_digits::with_values_of_urdf,
    model_frames::{AtZero, add_certificates, urdf_model, urdf_places},
};

/// The dynamics that the robot file declares beside the URDF.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct DeclaredSource {
    /// Where the values come from, as the file says.
    pub source: Option<String>,
    /// Values that the file does not declare, so that they are not compared.
    pub not_declared: Vec<String>,
    /// Values that differ from those of the URDF by no more than the digits that they are written with, which is no difference.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub values_within_digits: Vec<String>,
}

/// Compares the URDF with what the robot file declares. One of the two is taken to be wrong: the one whose correction
/// costs less, and the URDF if both cost the same. `of_table` is what digits leave open of the frames of the table.
pub(super) fn compared(
    description: &RobotDescription,
    declared: &DynamicsTable,
    of_table: PoseError,
    seed: u64,
) -> Result<(DeclaredSource, DynamicsReport), CompareError> {
    // By bodies, since an entry declares all that fixed joints hold to the link of its joint.
    let urdf = urdf_model(description).by_bodies();
    let zero =
        AtZero::new(description).map_err(|error| CompareError::Source { message: error.to_string() })?;
    let bodies: Vec<DeclaredBody> =
        declared.inertials.iter().map(|of| DeclaredBody::new(of, &zero, &description.robot)).collect();
    let mut model = declared_model(declared, &bodies, &zero, &urdf);
    let values_within_digits = with_values_of_urdf(&mut model, &urdf, &bodies, description, of_table);
    let places = description.places.inertials.as_deref();
    let robot = &description.robot;
    let places =
        places.map(|places| DeclaredPlaces { places, bodies: &bodies, robot, parameters: InFrame::Link });
    let names = [&description.urdf_path, &description.path].map(|path| path.display().to_string());
    let by_urdf = NamedModel { name: &names[0], model: &urdf, places: urdf_places(description) };
    let by_file = places.as_ref().map(|places| places as &dyn ParameterPlaces);
    let by_file = NamedModel { name: &names[1], model: &model, places: by_file };
    let mut report = compare(&by_urdf, &by_file, seed)?;
    if !report.has_same_torques() {
        // A mistake in the file was made in the frames of the file.
        let frames: Vec<(usize, Pose)> =
            bodies.iter().map(|body| (body.link, body.link_from_frame)).collect();
        let [urdf, model] = [&urdf, &model].map(|model| model.in_frames(&frames));
        let places = places.as_ref().map(|places| DeclaredPlaces { parameters: InFrame::Entry, ..*places });
        let file_in_entries = NamedModel {
            model: &model,
            places: places.as_ref().map(|places| places as &dyn ParameterPlaces),
            ..by_file
        };
        let urdf_in_entries = NamedModel { model: &urdf, ..by_urdf };
        let mut other = compare(&file_in_entries, &urdf_in_entries, seed)?;
        // Both explanations are tried: the numbers alone do not say which of the two files is wrong.
        let reach_m = urdf.frames().reach_m();
        let [of_urdf, of_file] = [
            cost(&report, reach_m, |parameter| {
                parameter.is_of_gravity() || parameter.parameter == "armature"
            }),
            cost(&other, reach_m, |_| false),
        ];
        let mut sides = [&by_urdf, &by_file];
        // A URDF that does not state a value is no reference for it: it is the one that lacks the value.
        if of_file < of_urdf && other.not_stated.is_empty() {
            std::mem::swap(&mut report, &mut other);
            sides = [&file_in_entries, &urdf_in_entries];
        }
        // The bound takes most of the time: once, of the comparison that is reported.
        add_certificates(&mut report, sides[0], sides[1], seed)?;
        // As many free numbers in either file: neither is more likely, so the report names the other one as well.
        if of_file.numbers == of_urdf.numbers {
            report.add_otherwise(&other);
        }
    }
    let source = declared.source.clone();
    let not_declared = not_declared(declared, &description.robot);
    Ok((DeclaredSource { source, not_declared, values_within_digits }, report))
}

/// Cost of the explanation that one of the two files is wrong. Fields are compared in their order.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Cost {
    /// Whether it is unexplained, whether its correction is physically impossible, and whether the file has no place
    /// for a part of it, as a URDF has none for gravity.
    against_it: [bool; 3],
    /// Free numbers, in halves.
    numbers: u32,
    is_implausible: bool,
    /// Whether the cause is nothing but other values; that values are left out, which zeros show, is more likely.
    is_of_free_values: bool,
}

fn cost(report: &DynamicsReport, reach_m: f64, has_no_place: impl Fn(&ParameterDifference) -> bool) -> Cost {
    let explanations = &report.explanations;
    let numbers: f64 = explanations.iter().map(|explanation| explanation.numbers).sum();
    let any = |is_so: fn(&DynamicsExplanation) -> bool| explanations.iter().any(is_so);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a few free numbers, in halves"
    )]
    Cost {
        against_it: [
            explanations.is_empty(),
            any(|of| !of.is_a_body),
            any(|of| of.changes.is_empty())
                || explanations.iter().any(|of| of.parameters.iter().any(&has_no_place)),
        ],
        numbers: (2.0 * numbers).round() as u32,
        is_implausible: explanations.iter().any(|of| has_plausible_com(of, reach_m)),
        is_of_free_values: any(|of| of.cause.is_of_free_values()),
    }
}

/// Whether a unit is said to be wrong of a centre of mass that lies within the robot as it is written, while the other
/// one does not, or is so near to the joint that it is likely the one that was divided.
fn has_plausible_com(explanation: &DynamicsExplanation, reach_m: f64) -> bool {
    let farthest = |value: fn(&ParameterDifference) -> Option<f64>| {
        let values = explanation.parameters.iter().filter(|of| of.parameter.starts_with("com_"));
        values.filter_map(value).fold(0.0_f64, |farthest, value| farthest.max(value.abs()))
    };
    let (found, expected) = (farthest(|of| of.found), farthest(|of| of.expected));
    explanation.cause == DynamicsCause::ComUnit
        && found <= reach_m
        && (found > expected || expected > reach_m)
}

/// Parameters without an entry, in words.
fn not_declared(declared: &DynamicsTable, robot: &Robot) -> Vec<String> {
    let names: Vec<&str> = robot.movable_joint_names().collect();
    let entry = |name: &str| declared.inertials.iter().find(|of| robot.joint(of.joint).name == name);
    let lacking = |what: &str, is_there: fn(&DeclaredInertial) -> bool| {
        let lacks = |name: &&str| !entry(name).is_some_and(is_there);
        let lacking: Vec<&str> = names.iter().copied().filter(lacks).collect();
        match lacking.len() {
            0 => None,
            all if all == names.len() => Some(format!("{what} of all joints")),
            _ => Some(format!("{what} of {}", lacking.join(", "))),
        }
    };
    let left_out = [
        lacking("mass", |_| true),
        lacking("centre of mass", |of| of.com_m.is_some()),
        lacking("inertia", |of| of.tensor_kg_m2.is_some()),
        lacking("damping", |of| of.damping.is_some()),
        lacking("friction", |of| of.friction.is_some()),
        declared.gravity_in_base_m_s2.is_none().then(|| "gravity".to_owned()),
    ];
    left_out.into_iter().flatten().collect()
}

/// The dynamics that the file declares; values that it omits are those of the URDF.
fn declared_model(
    declared: &DynamicsTable,
    bodies: &[DeclaredBody],
    zero: &AtZero,
    urdf: &DynamicsModel,
) -> DynamicsModel {
    let mut model = urdf.clone();
    for (body, declared) in bodies.iter().zip(&declared.inertials) {
        let mut parameters = body.parameters;
        // Values without an entry are copied from the URDF, so that they cannot differ and are not compared.
        if let Some(written) = &model.inertials[body.link] {
            if !body.has_com {
                parameters.com_m = written.com_m;
            }
            if !body.has_tensor {
                (parameters.link_from_axes, parameters.tensor_kg_m2) =
                    (written.link_from_axes, written.tensor_kg_m2);
            }
        }
        model.inertials[body.link] = Some(parameters);
        let terms = &mut model.resistances[body.joint];
        terms.armature = declared.armature.unwrap_or(terms.armature);
        terms.damping = declared.damping.unwrap_or(terms.damping);
        terms.friction = declared.friction.unwrap_or(terms.friction);
    }
    if let Some(gravity) = declared.gravity_in_base_m_s2 {
        model.gravity_m_s2 = zero.root_from_base.rotation * gravity;
    }
    model
}

/// The entries of the file as parameters of links and joints.
#[derive(Debug)]
struct DeclaredPlaces<'a> {
    places: &'a InertialPlaces,
    bodies: &'a [DeclaredBody],
    robot: &'a Robot,
    parameters: InFrame,
}

/// The frame in which parameters are compared and written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum InFrame {
    /// The frame of the link that the joint carries.
    Link,
    /// The frame that the entry declares.
    Entry,
}

impl DeclaredPlaces<'_> {
    /// The entry of a link or of a joint.
    fn entry(&self, of: &str) -> Option<usize> {
        let link = self.robot.find_link(of).map(congruent_description::LinkIndex::get);
        let joint = self.robot.find_joint(of).and_then(|joint| self.robot.coordinate(joint));
        self.bodies.iter().position(|body| Some(body.link) == link || Some(body.joint) == joint)
    }
}

impl ParameterPlaces for DeclaredPlaces<'_> {
    fn source(&self) -> &Arc<SourceFile> {
        self.places.source()
    }

    fn parameter(&self, of: &str, parameter: &str) -> Option<ParameterPlace> {
        let span = match of {
            "" => self.places.gravity(),
            _ => self.places.parameter(self.entry(of)?, parameter),
        };
        Some(ParameterPlace { source: Arc::clone(self.places.source()), span: span?, class: None })
    }

    fn set_inertial(&self, link: &str, inertia: &Inertia) -> Option<Vec<TextEdit>> {
        let entry = self.entry(link)?;
        let parameters = &Inertial::from(inertia);
        let body = &self.bodies[entry];
        let written = body.written();
        let new = match self.parameters {
            InFrame::Link => body.about_point(&body.in_frame(parameters)),
            InFrame::Entry => body.about_point(parameters),
        };
        let mut edits = self.places.set_mass(entry, parameters.mass_kg);
        // Relative to the larger vector, since a component that is zero has no scale of its own.
        let length = written.com_m.amax().max(new.com_m.amax());
        if (new.com_m - written.com_m).amax() > ROUNDING * length {
            let com = new.com_m.map(|value| cleaned(value, length));
            edits.extend(self.places.set_com(entry, &com));
        }
        let size = written.tensor_kg_m2.amax().max(new.tensor_kg_m2.amax());
        if body.has_tensor && (new.tensor_kg_m2 - written.tensor_kg_m2).amax() > ROUNDING * size {
            let tensor = new.tensor_kg_m2.map(|value| cleaned(value, size));
            edits.extend(self.places.set_tensor(entry, &tensor));
        }
        Some(edits)
    }

    fn set_terms(&self, joint: &str, terms: &JointResistance) -> Option<Vec<TextEdit>> {
        let entry = self.entry(joint)?;
        Some(self.places.set_terms(entry, [terms.armature, terms.damping, terms.friction]))
    }

    fn set_gravity(&self, gravity_m_s2: &Vector3<f64>) -> Vec<TextEdit> {
        self.places.set_gravity(gravity_m_s2)
    }
}

/// A parameter that changes by a smaller share of its body's is the same, and a smaller one is zero. No unit; kind:
/// rounding of the rotation into another frame.
const ROUNDING: f64 = 1e-12;

fn cleaned(value: f64, size: f64) -> f64 {
    if value.abs() <= ROUNDING * size { 0.0 } else { value }
}
