//! A joint that follows another one in two files in different ways: as a fault with the lines of both, and what to
//! write.

use congruent_description::{JointElement, ParameterPlace, RobotDescription};
use congruent_input::{
    Diagnostic,
    display::{number, quantity},
};
use congruent_kinematics::PoseError;

use super::{
    content::{Fault, ReportedCause, ReportedDiagnosis, ReportedStage},
    describe::several,
    values::ReportedValue,
};
use crate::{diagnosis::Cause, source_pair::SourcePair};

/// How a joint follows another one: `multiplier * q_master + offset`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Relation {
    /// The joint that is followed.
    pub(crate) master: String,
    /// Ratio of the two positions.
    pub(crate) multiplier: f64,
    /// Position if the master is at zero, rad or m.
    pub(crate) offset: f64,
}

/// A joint with its relation in the file that is checked and in the other one; `None` if it follows none.
#[derive(Debug, Clone)]
pub(crate) struct FollowedJoint {
    pub(crate) joint: String,
    /// Unit of its position.
    pub(crate) unit: &'static str,
    pub(crate) relations: [Option<Relation>; 2],
}

/// Puts such faults before those of the diagnosis; `worst` are the largest differences of all links, with none of
/// them corrected, with the first, and so on.
pub(crate) fn with_mimics(
    diagnosis: Option<ReportedDiagnosis>,
    joints: &[FollowedJoint],
    descriptions: [&RobotDescription; 2],
    worst: &[PoseError],
) -> ReportedDiagnosis {
    let pair = SourcePair::UrdfOther;
    let mut diagnosis = diagnosis.unwrap_or_else(|| ReportedDiagnosis {
        name: pair,
        title: pair.title(),
        causes: Vec::new(),
        indistinguishable: Vec::new(),
        invariants: Vec::new(),
        table: None,
        corrected: None,
        findings: Vec::new(),
    });
    let (mut parts, mut findings): (Vec<Fault>, Vec<Diagnostic>) =
        joints.iter().map(|joint| joint.fault(descriptions)).unzip();
    let mut stages: Vec<ReportedStage> =
        worst.windows(2).map(|pair| ReportedStage { before: pair[0], after: pair[1] }).collect();
    let remaining = worst.last().copied().unwrap_or_default();
    let (mut residual, mut within_tolerance) = (remaining, remaining.is_within(&descriptions[0].tolerance));
    if !diagnosis.causes.is_empty() {
        let of_poses = diagnosis.causes.remove(0);
        residual = PoseError { position_m: of_poses.residual_m, orientation_rad: of_poses.residual_rad };
        within_tolerance = of_poses.within_tolerance;
        // The chain is diagnosed with all joints driven, so its faults are others than these and come after them.
        if of_poses.fault.cause != Cause::Unexplained {
            stages.extend(of_poses.stages);
            findings.append(&mut diagnosis.findings);
            parts.extend(if of_poses.parts.is_empty() { vec![of_poses.fault] } else { of_poses.parts });
        }
    }
    let fault = if parts.len() == 1 { parts.remove(0) } else { several(&parts) };
    let PoseError { position_m: residual_m, orientation_rad: residual_rad } = residual;
    diagnosis
        .causes
        .insert(0, ReportedCause { fault, residual_m, residual_rad, within_tolerance, parts, stages });
    diagnosis.findings = findings;
    diagnosis
}

impl FollowedJoint {
    /// The fault as data and as a finding, the file that is checked first.
    fn fault(&self, [description, other]: [&RobotDescription; 2]) -> (Fault, Diagnostic) {
        let [found, expected] = &self.relations;
        let there = place(other, &self.joint);
        let there = if other.is_loaded() { there } else { format!("the other file ({there})") };
        let message = format!("{} in {there}", self.message());
        let suggestion = format!(
            "{}, or {} in {}",
            self.to_write(expected.as_ref(), description),
            self.to_write(found.as_ref(), other),
            other.urdf_path.display()
        );
        let (parameter, numbers) = self.numbers();
        let [found_value, expected_value] = match numbers {
            Some(pair) => pair.map(ReportedValue::Number),
            None => [found, expected].map(|relation| ReportedValue::Text(self.words(relation.as_ref()))),
        };
        let finding = Diagnostic::error(Cause::Mimic.code(), message.clone()).with_help(suggestion.clone());
        let place = mimic_place(description, &self.joint);
        let path = place.as_ref().map_or(&description.urdf_path, |at| &at.source.path);
        let file = path.display().to_string();
        let fault = Fault {
            cause: Cause::Mimic,
            joint: Some(self.joint.clone()),
            parameter: Some(parameter.to_owned()),
            value: numbers.map(|[found, expected]| found - expected),
            found: Some(found_value),
            expected: Some(expected_value),
            file: Some(file),
            line: place.as_ref().map(ParameterPlace::line),
            message,
            suggestion,
            ..Fault::default()
        };
        let finding = match place {
            Some(at) => finding.at(at.span).in_file(&at.source),
            None => finding,
        };
        (fault, finding)
    }

    /// The two relations, without places.
    pub(crate) fn message(&self) -> String {
        let [found, expected] = [0, 1].map(|file| self.words(self.relations[file].as_ref()));
        format!("joint \"{}\" {found} here, but {expected}", self.joint)
    }

    fn words(&self, relation: Option<&Relation>) -> String {
        let Some(Relation { master, multiplier, offset }) = relation else {
            return "follows none".to_owned();
        };
        let follows = format!("follows {} x \"{master}\"", number(*multiplier));
        if *offset == 0.0 { follows } else { format!("{follows} + {}", quantity(*offset, self.unit)) }
    }

    /// The `<mimic>` that a file with the relation has, or the `<equality>` of an MJCF, as an instruction.
    fn to_write(&self, relation: Option<&Relation>, file: &RobotDescription) -> String {
        let (joint, is_urdf) = (&self.joint, file.places.urdf.is_some());
        match relation {
            None if is_urdf => format!("remove the <mimic> of joint \"{joint}\""),
            None => format!("remove joint \"{joint}\" from <equality>"),
            Some(Relation { master, multiplier, offset }) if is_urdf => {
                format!("write <mimic joint=\"{master}\" multiplier=\"{multiplier}\" offset=\"{offset}\"/>")
            }
            Some(Relation { master, multiplier, offset }) => {
                let mjcf = file.places.mjcf.as_ref();
                let constant =
                    mjcf.and_then(|of| of.coupling_constant([joint, master], *multiplier, *offset));
                let constant = constant.unwrap_or(*offset);
                format!(
                    "write <joint joint1=\"{joint}\" joint2=\"{master}\" polycoef=\"{constant} {multiplier} 0 0 0\"/> in <equality>"
                )
            }
        }
    }

    /// The one number that differs, found and expected; none if more than that does.
    fn numbers(&self) -> (&'static str, Option<[f64; 2]>) {
        let [Some(found), Some(expected)] = &self.relations else { return ("mimic", None) };
        #[expect(clippy::float_cmp, reason = "values of two files are the same or not")]
        let differ = (found.multiplier != expected.multiplier, found.offset != expected.offset);
        match differ {
            _ if found.master != expected.master => ("mimic", None),
            (true, false) => ("multiplier", Some([found.multiplier, expected.multiplier])),
            (false, true) => ("offset", Some([found.offset, expected.offset])),
            _ => ("multiplier, offset", None),
        }
    }
}

/// File and line of the `<mimic>` of a joint, or of its `<equality>`.
fn place(description: &RobotDescription, joint: &str) -> String {
    let place = mimic_place(description, joint);
    place.map_or_else(|| description.urdf_path.display().to_string(), |at| at.to_string())
}

fn mimic_place(description: &RobotDescription, joint: &str) -> Option<ParameterPlace> {
    description.places.parameters()?.joint_part(joint, JointElement::Mimic)
}
