//! A diagnosis in names of the robot, as a report for programs and as findings for people.

use congruent_description::{Diagnostic, display::length_and_angle};

use super::{
    content::{Fault, ReportedAlternative, ReportedCause, ReportedDiagnosis, ReportedDifference},
    fault_message::{FaultMessage, FileLocation, fault_message_of},
    names::ModelNames,
};
use crate::{
    diagnosis::{Cause, Diagnosis, Equivalence, Explanation, JointDifference, ModelPair},
    source_pair::SourcePair,
};

pub(super) fn reported_diagnosis(
    pair: SourcePair,
    models: &ModelPair,
    diagnosis: &Diagnosis,
    names: &ModelNames<'_>,
) -> ReportedDiagnosis {
    let described: Vec<(ReportedCause, Vec<Diagnostic>)> =
        diagnosis.explanations.iter().map(|explanation| describe(models, explanation, names)).collect();
    let findings = described.first().map(|(_, findings)| findings.clone()).unwrap_or_default();
    let alternative = |(explanation, equivalence): &(Explanation, Equivalence)| ReportedAlternative {
        cause: describe(models, explanation, names).0,
        equivalence: *equivalence,
        reason: equivalence.sentence(),
    };
    ReportedDiagnosis {
        name: pair,
        title: pair.title(),
        causes: described.into_iter().map(|(cause, _)| cause).collect(),
        indistinguishable: diagnosis.indistinguishable.iter().map(alternative).collect(),
        invariants: diagnosis.differences.iter().map(|each| difference(each, names)).collect(),
        findings,
    }
}

fn describe(
    models: &ModelPair,
    explanation: &Explanation,
    names: &ModelNames<'_>,
) -> (ReportedCause, Vec<Diagnostic>) {
    let fault_messages: Vec<FaultMessage> = explanation
        .faults
        .iter()
        .map(|fault| fault_message_of(fault, models, &explanation.corrected, names))
        .collect();
    let residual = explanation.residual;
    let after_the_fix = format!(
        "residual after the fix: {}",
        length_and_angle(residual.position_m, residual.orientation_rad)
    );
    let findings =
        fault_messages.iter().map(|fault_message| finding(fault_message, &after_the_fix)).collect();
    let mut parts: Vec<Fault> = fault_messages.into_iter().map(|fault_message| fault_message.fault).collect();
    let located = parts.iter().find(|part| part.line.is_some());
    let fault = match parts.len() {
        0 => Fault {
            cause: Cause::Unexplained,
            suggestion: "no known cause explains the difference: see `invariants` for the screws that differ"
                .into(),
            ..Fault::default()
        },
        1 => parts.remove(0),
        _ => Fault {
            cause: Cause::Several,
            joints: involved(&parts),
            file: located.and_then(|part| part.file.clone()),
            line: located.and_then(|part| part.line),
            suggestion: parts.iter().map(|part| part.suggestion.as_str()).collect::<Vec<_>>().join("; "),
            ..Fault::default()
        },
    };
    let cause = ReportedCause {
        fault,
        residual_m: residual.position_m,
        residual_rad: residual.orientation_rad,
        parts,
    };
    (cause, findings)
}

fn involved(parts: &[Fault]) -> Vec<String> {
    let mut joints: Vec<String> =
        parts.iter().flat_map(|part| part.joint.iter().chain(&part.joints)).cloned().collect();
    joints.sort();
    joints.dedup();
    joints
}

/// A fault as a finding in its file.
fn finding(fault_message: &FaultMessage, after_the_fix: &str) -> Diagnostic {
    let FaultMessage { fault, message, location } = fault_message;
    let finding = Diagnostic::error(fault.cause.code(), message.clone())
        .with_help(format!("{}; {after_the_fix}", fault.suggestion));
    match location {
        Some(FileLocation { source, span }) => finding.at(span.clone()).in_file(source),
        None => finding,
    }
}

fn difference(difference: &JointDifference, names: &ModelNames<'_>) -> ReportedDifference {
    let JointDifference { invariant, joint, found, expected } = *difference;
    ReportedDifference { invariant, joint: names.moving_joint(joint), found, expected }
}
