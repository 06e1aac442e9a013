//! An `<origin>` or an `<axis>` of a joint that another URDF has otherwise: as a fault with the places in both files,
//! what each writes, and the line to write.

use std::sync::Arc;

use congruent_description::{Joint, JointElement, ParameterPlace, RobotDescription};
use congruent_input::{
    RevisionName, Slack, TextEdit,
    display::angle,
    fitted_rpy_fixed_xyz_rad, line_column,
    units::{Unit, UnitSystem},
};
use congruent_kinematics::{Pose, PoseError, rotation_log};
use congruent_mapping::{ExplainedByJoints, JointCorrection, JointPart, MatchedRobots};
use nalgebra::{Isometry3, Unit as UnitVector, Vector3};

use super::{
    content::{
        Fault, ReportedAlternative, ReportedCause, ReportedDiagnosis, ReportedDifference, ReportedStage,
    },
    describe::{finding, several},
    fault_message::{FaultMessage, FileLocation, off_by},
    joint_advice::{JointAttribute, advise_together, edits_of},
    values::ReportedValue,
};
use crate::{
    diagnosis::{Cause, Equivalence, thresholds::SAME_UNIT_RATIO},
    source_pair::SourcePair,
};

/// A part of a turn or of a shift that is smaller is rounding. Unit: m or rad; kind: rounding of products of poses, and of zeros
/// that are found by a fit.
const ROUNDING: f64 = 1e-10;

/// Numbers that no file writes are given without the digits that are noise of that size.
const WITHOUT_NOISE: Slack = Slack { length_m: ROUNDING, angle_rad: ROUNDING };

/// Two axes are opposite if their sum is smaller. No unit; kind: rounding.
const OPPOSITE: f64 = 1e-9;

/// Whether several origins differ by the factor between millimetres and metres.
pub(crate) fn may_be_unit(explained: &ExplainedByJoints, robots: &MatchedRobots<'_>) -> bool {
    let is_scaled = |of: &JointCorrection| {
        let JointPart::Origin(expected) = of.expected else { return false };
        let found = robots.robot.joint(of.joint).parent_from_joint.translation.vector.norm();
        let ratio = found / expected.translation.vector.norm();
        [1e3, 1e-3].iter().any(|factor| (ratio / factor - 1.0).abs() < SAME_UNIT_RATIO)
    };
    explained.corrections.len() > 1 && explained.corrections.iter().all(is_scaled)
}

/// The diagnosis that names these joints; `differences` are those of the chain.
pub(crate) fn diagnosed_by_joints(
    descriptions: [&RobotDescription; 2],
    robots: &MatchedRobots<'_>,
    explained: &ExplainedByJoints,
    differences: Vec<ReportedDifference>,
) -> ReportedDiagnosis {
    let parts = CorrectionMessages { descriptions, robots };
    let ExplainedByJoints { corrections, worst, alternatives } = explained;
    let stages: Vec<ReportedStage> =
        worst.windows(2).map(|pair| ReportedStage { before: pair[0], after: pair[1] }).collect();
    let messages = parts.messages(corrections);
    let findings = messages.iter().zip(&stages).map(|(message, stage)| finding(message, stage)).collect();
    let faults = messages.into_iter().map(|message| message.fault).collect();
    let alternative = |of: &JointCorrection| {
        let equivalence = Equivalence::SameEffect;
        let messages = parts.messages(std::slice::from_ref(of));
        let cause = cause(messages.into_iter().map(|of| of.fault).collect(), stages.clone());
        ReportedAlternative { cause, equivalence, reason: equivalence.sentence() }
    };
    let pair = SourcePair::UrdfOther;
    ReportedDiagnosis {
        name: pair,
        title: pair.title(),
        indistinguishable: alternatives.iter().map(alternative).collect(),
        causes: vec![cause(faults, stages)],
        invariants: differences,
        table: None,
        corrected: None,
        findings,
    }
}

/// A cause that explains everything.
fn cause(mut parts: Vec<Fault>, stages: Vec<ReportedStage>) -> ReportedCause {
    let fault = if parts.len() == 1 { parts.remove(0) } else { several(&parts) };
    let PoseError { position_m, orientation_rad } =
        stages.last().map(|stage| stage.after).unwrap_or_default();
    ReportedCause {
        fault,
        residual_m: position_m,
        residual_rad: orientation_rad,
        within_tolerance: true,
        parts,
        stages,
    }
}

/// Two descriptions, the one that is checked first.
struct CorrectionMessages<'a> {
    descriptions: [&'a RobotDescription; 2],
    robots: &'a MatchedRobots<'a>,
}

impl CorrectionMessages<'_> {
    /// The messages of corrections, with the lines in which all of them are made.
    fn messages(&self, corrections: &[JointCorrection]) -> Vec<FaultMessage> {
        let mut messages: Vec<FaultMessage> = corrections.iter().map(|of| self.message(of)).collect();
        if let Some(places) = self.descriptions[0].places.parameters() {
            let edits: Vec<Vec<TextEdit>> = corrections.iter().map(|of| self.edits(of)).collect();
            advise_together(&mut messages, &edits, places);
        }
        messages
    }

    /// What a correction changes in the file.
    fn edits(&self, correction: &JointCorrection) -> Vec<TextEdit> {
        let joint = self.robots.robot.joint(correction.joint);
        let places = &self.descriptions[0].places;
        match (&places.urdf, &places.mjcf, &correction.expected) {
            (Some(urdf), _, JointPart::Origin(expected)) => {
                edits_of(urdf, &joint.name, "origin", &self.origin(joint, expected))
            }
            (Some(urdf), _, JointPart::Axis(expected)) => {
                edits_of(urdf, &joint.name, "axis", &self.axis(joint, expected))
            }
            (None, Some(mjcf), JointPart::Origin(origin)) => mjcf.set_joint_origin(&joint.name, origin),
            (None, Some(mjcf), JointPart::Axis(axis)) => mjcf.set_joint_axis(&joint.name, axis),
            (None, None, _) => Vec::new(),
        }
    }

    fn message(&self, correction: &JointCorrection) -> FaultMessage {
        let joint = self.robots.robot.joint(correction.joint);
        let (element, part, attributes, fault) = match &correction.expected {
            JointPart::Origin(expected) => {
                let fault = origin_fault(&joint.parent_from_joint, expected);
                (JointElement::Origin, "origin", self.origin(joint, expected), fault)
            }
            JointPart::Axis(expected) => {
                (JointElement::Axis, "axis", self.axis(joint, expected), axis_fault(joint, expected))
            }
        };
        let own = self.descriptions[0].places.urdf.as_ref();
        let [found_at, other] = self.descriptions.map(|of| of.places.parameters());
        let location = found_at.and_then(|places| places.joint_part(&joint.name, element));
        let location = location.map(|at| FileLocation { source: at.source, span: at.span });
        // Screws that are the robot have no elements of a URDF: the row of the joint is the place.
        let own_model = self.descriptions[0].places.own_model.as_ref();
        let location = location.or_else(|| {
            let span = own_model?.joint(&joint.name)?;
            Some(FileLocation { source: Arc::clone(own_model?.source()), span })
        });
        let there = self.there(joint, &correction.expected);
        let expected_at = there.zip(other).and_then(|(there, of)| of.joint_part(&there.name, element));
        let words = |value: fn(&JointAttribute) -> &str| {
            let written = attributes.iter().map(|of| format!("{}=\"{}\"", of.name, value(of)));
            written.collect::<Vec<_>>().join(" ")
        };
        let [found, expected] = [words(|of| &of.found), words(|of| &of.expected)];
        let as_in = self.as_in(joint, there, expected_at.as_ref());
        let unit = attributes.iter().find_map(JointAttribute::other_unit).unwrap_or_default();
        // Of two files one may be right; a revision is what the file was.
        let there = self.descriptions[1];
        let other = match there.is_loaded() {
            true if there.own_model().is_some() => "by the poses",
            true => "loaded",
            false if self.is_revision() => "was",
            false => "expected",
        };
        let other = format!("{other} {expected}{as_in}");
        let text = sentence(&fault, &joint.name, [&found, &other]) + unit;
        let fault = Fault {
            joint: Some(joint.name.clone()),
            parameter: Some(attributes.iter().map(|of| of.name).collect::<Vec<_>>().join(", ")),
            suggestion: match own_model {
                Some(_) => format!("correct the row of joint \"{}\": its axis is elsewhere", joint.name),
                // An MJCF, whose bodies have other attributes than an origin.
                None if own.is_none() => {
                    let mjcf = self.descriptions[0].places.mjcf.as_ref();
                    let has_reference = mjcf.is_some_and(|places| places.has_reference(&joint.name));
                    in_mjcf(&joint.name, &attributes, &correction.expected)
                        + if has_reference { "; its ref is then 0" } else { "" }
                }
                None => format!("write {expected} in the <{part}> of joint \"{}\"", joint.name),
            },
            found: Some(ReportedValue::Text(found)),
            expected: Some(ReportedValue::Text(expected)),
            file: location.as_ref().map(|at| at.source.path.display().to_string()),
            line: location.as_ref().map(|at| line_column(&at.source.text, at.span.start).0),
            expected_file: expected_at.as_ref().map(|at| at.source.path.display().to_string()),
            expected_line: expected_at.as_ref().map(ParameterPlace::line),
            message: text.clone(),
            ..fault
        };
        FaultMessage { fault, message: text, location }
    }

    fn is_revision(&self) -> bool {
        RevisionName::of(&self.descriptions[1].path).is_some()
    }

    /// The joint of the other file that has the expected value; `None` if none has it alone.
    fn there(&self, joint: &Joint, expected: &JointPart) -> Option<&Joint> {
        match expected {
            JointPart::Axis(_) => self.robots.namesake(joint),
            JointPart::Origin(origin) => {
                // The joint between the same links first: a file may use the name for another place of the chain.
                let candidates = [self.robots.same_joint(joint), self.robots.namesake(joint)];
                candidates
                    .into_iter()
                    .flatten()
                    .find(|there| apart(&there.parent_from_joint, origin) <= ROUNDING)
            }
        }
    }

    fn as_in(&self, joint: &Joint, there: Option<&Joint>, at: Option<&ParameterPlace>) -> String {
        let (Some(there), Some(at)) = (there, at) else { return String::new() };
        let named =
            if there.name == joint.name { String::new() } else { format!(" (joint \"{}\")", there.name) };
        // An MJCF has these numbers in other attributes.
        let places = self.descriptions[1].places.urdf.as_ref();
        let is_written = places.is_some_and(|places| !places.is_rewritten());
        let preposition = match (self.is_revision(), is_written) {
            (true, _) => "in",
            (false, true) => "as in",
            // In the variables and frames of this file, which the line does not have.
            (false, false) => "from",
        };
        format!(" {preposition} {at}{named}")
    }

    /// `xyz` and `rpy` of an origin, each if it differs.
    fn origin(&self, joint: &Joint, expected: &Isometry3<f64>) -> Vec<JointAttribute> {
        let there = self.there(joint, &JointPart::Origin(*expected));
        let own = |name: &str| self.written(0, joint, "origin", name);
        let mut attributes = origin_attributes([&joint.parent_from_joint, expected], WITHOUT_NOISE, own);
        for attribute in &mut attributes {
            let written = there.and_then(|there| self.written(1, there, "origin", attribute.name));
            attribute.expected = written.unwrap_or_else(|| attribute.expected.clone());
        }
        attributes
    }

    fn axis(&self, joint: &Joint, expected_axis: &UnitVector<Vector3<f64>>) -> Vec<JointAttribute> {
        let numbers = |axis: &UnitVector<Vector3<f64>>| {
            listed(Unit::Length, axis.into_inner().into(), Slack::default())
        };
        let found = self.written(0, joint, "axis", "xyz").unwrap_or_else(|| numbers(&joint.axis_in_joint));
        let there = self.robots.namesake(joint);
        let expected = there.and_then(|there| self.written(1, there, "axis", "xyz"));
        let expected = expected.unwrap_or_else(|| numbers(expected_axis));
        vec![JointAttribute { name: "xyz", found, expected }]
    }

    /// An attribute as a file writes it; without it the default of the URDF reader counts.
    fn written(&self, file: usize, joint: &Joint, part: &str, attribute: &str) -> Option<String> {
        self.descriptions[file].places.urdf.as_ref()?.joint_attribute(&joint.name, part, attribute)
    }
}

/// The sentence for one fault: what the file has, and what is expected or was before.
fn sentence(fault: &Fault, joint: &str, [found, other]: [&str; 2]) -> String {
    match fault.cause {
        Cause::AxisFlipped => {
            format!("joint \"{joint}\" moves in the opposite direction: axis {found}, {other}")
        }
        Cause::JointAxis => {
            let off = angle(turn(fault));
            format!("joint \"{joint}\": axis {found}, {other}, off by {off}")
        }
        _ => {
            let off = off_by(shift(fault), turn(fault));
            format!("joint \"{joint}\": origin {found}, {other}, off by {off}")
        }
    }
}

/// What to write of these attributes in an MJCF.
fn in_mjcf(joint: &str, attributes: &[JointAttribute], expected: &JointPart) -> String {
    let JointPart::Origin(pose) = expected else {
        let axis = attributes.first().map_or("", |of| &of.expected);
        return format!("write axis=\"{axis}\" in the <joint> \"{joint}\"");
    };
    let number = |value: f64| Unit::Length.fitted(value, UnitSystem::Si, WITHOUT_NOISE);
    let written = |of: &JointAttribute| {
        if of.name == "xyz" {
            return format!("pos=\"{}\"", of.expected);
        }
        let [i, j, k, w]: [f64; 4] = pose.rotation.coords.into();
        format!("quat=\"{}\"", [w, i, j, k].map(number).join(" "))
    };
    let written = attributes.iter().map(written).collect::<Vec<_>>().join(" ");
    format!("write {written} in the <body> of joint \"{joint}\", its pose in the body before it")
}

fn listed(unit: Unit, values: [f64; 3], slack: Slack) -> String {
    values.map(|value| unit.fitted(value, UnitSystem::Si, slack)).join(" ")
}

/// Found minus expected, m, and the rotation from expected to found, rad.
fn off(found: &Isometry3<f64>, expected: &Isometry3<f64>) -> [Vector3<f64>; 2] {
    let [found, expected] = [found, expected].map(|pose| Pose::from(*pose));
    let turn = rotation_log(&(expected.rotation.transpose() * found.rotation));
    [found.translation - expected.translation, turn]
}

fn apart(one: &Isometry3<f64>, other: &Isometry3<f64>) -> f64 {
    off(one, other).iter().map(Vector3::norm).fold(0.0, f64::max)
}

/// `xyz` and `rpy` of an origin that is not the expected one, each if it differs; `written` gives them as the file does.
pub(super) fn origin_attributes(
    [found, expected]: [&Isometry3<f64>; 2],
    slack: Slack,
    written: impl Fn(&str) -> Option<String>,
) -> Vec<JointAttribute> {
    let numbers = |name: &str, pose: &Isometry3<f64>, slack: Slack| match name {
        "xyz" => listed(Unit::Length, pose.translation.vector.into(), slack),
        _ => listed(Unit::Angle, fitted_rpy_fixed_xyz_rad(pose, slack), slack),
    };
    let attribute = |name: &'static str| JointAttribute {
        name,
        found: written(name).unwrap_or_else(|| numbers(name, found, Slack::default())),
        expected: numbers(name, expected, slack),
    };
    let [shift, turn] = off(found, expected);
    let xyz = (shift.norm() > ROUNDING).then(|| attribute("xyz"));
    let rpy = (turn.norm() > ROUNDING).then(|| attribute("rpy"));
    xyz.into_iter().chain(rpy).collect()
}

pub(super) fn origin_fault(found: &Isometry3<f64>, expected: &Isometry3<f64>) -> Fault {
    let [shift, turn] = off(found, expected);
    Fault {
        cause: Cause::JointOrigin,
        translation_m: Some(shift.into()),
        rotation_rad: Some(turn.into()),
        ..Fault::default()
    }
}

fn axis_fault(joint: &Joint, expected: &UnitVector<Vector3<f64>>) -> Fault {
    let found = joint.axis_in_joint.into_inner();
    // An axis of the opposite direction is called a flipped joint, not an axis that is off by 180 deg.
    let is_flipped = (found + expected.into_inner()).norm() < OPPOSITE;
    let across = expected.cross(&found);
    let angle_rad = libm::atan2(across.norm(), expected.dot(&found));
    let turn = across.try_normalize(0.0).map(|about| about * angle_rad);
    Fault {
        cause: if is_flipped { Cause::AxisFlipped } else { Cause::JointAxis },
        value: is_flipped.then_some(-1.0),
        rotation_rad: turn.filter(|_| !is_flipped).map(Into::into),
        ..Fault::default()
    }
}

pub(super) fn shift(fault: &Fault) -> f64 {
    fault.translation_m.map_or(0.0, |shift| Vector3::from(shift).norm())
}

pub(super) fn turn(fault: &Fault) -> f64 {
    fault.rotation_rad.map_or(0.0, |turn| Vector3::from(turn).norm())
}
