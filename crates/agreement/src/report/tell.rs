//! What the ladder found, as programs read it and as a compiler would say it.

use congruent_description::Diagnostic;

use super::{
    content::{Fault, ReportedAlternative, ReportedCause, ReportedDiagnosis, ReportedDifference},
    fault_message::{FaultMessage, Spot, fault_message_of},
    names::{ModelNames, PairTitle},
    values::{angle, length},
};
use crate::diagnosis::{Cause, Diagnosis, Explanation, JointDifference, ModelPair};

pub(super) fn reported_diagnosis(
    title: PairTitle,
    models: &ModelPair,
    diagnosis: &Diagnosis,
    names: &ModelNames<'_>,
) -> ReportedDiagnosis {
    let told: Vec<(ReportedCause, Vec<Diagnostic>)> =
        diagnosis.explanations.iter().map(|explanation| tell(models, explanation, names)).collect();
    let findings = told.first().map(|(_, findings)| findings.clone()).unwrap_or_default();
    let alternative = |(explanation, equivalence): &(Explanation, crate::diagnosis::Equivalence)| {
        ReportedAlternative { cause: tell(models, explanation, names).0, reason: equivalence.sentence() }
    };
    ReportedDiagnosis {
        name: title.name,
        title: title.title,
        diagnosis: told.into_iter().map(|(cause, _)| cause).collect(),
        indistinguishable: diagnosis.indistinguishable.iter().map(alternative).collect(),
        invariants: diagnosis.differences.iter().map(|each| difference(each, names)).collect(),
        findings,
    }
}

fn tell(
    models: &ModelPair,
    explanation: &Explanation,
    names: &ModelNames<'_>,
) -> (ReportedCause, Vec<Diagnostic>) {
    let fault_messages: Vec<FaultMessage> = explanation
        .parts
        .iter()
        .map(|part| fault_message_of(part, models, &explanation.corrected, names))
        .collect();
    let residual = explanation.residual;
    let left = format!("that leaves {} and {}", length(residual.position_m), angle(residual.orientation_rad));
    let findings = fault_messages.iter().map(|fault_message| finding(fault_message, &left)).collect();
    let mut parts: Vec<Fault> = fault_messages.into_iter().map(|fault_message| fault_message.fault).collect();
    let located = parts.iter().find(|part| part.line.is_some());
    let fault = match parts.len() {
        0 => Fault {
            cause: Cause::Unexplained.name(),
            suggestion: "nothing in the catalogue explains it: see `invariants` for where the screws differ"
                .into(),
            ..Fault::default()
        },
        1 => parts.remove(0),
        _ => Fault {
            cause: Cause::Several.name(),
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

/// A fault as a finding about its file.
fn finding(fault_message: &FaultMessage, left: &str) -> Diagnostic {
    let FaultMessage { fault, message, spot, .. } = fault_message;
    let finding = Diagnostic::error(fault_message.code(), message.clone())
        .with_help(format!("{}; {left}", fault.suggestion));
    match spot {
        Some(Spot { source, span }) => finding.at(span.clone()).in_file(source),
        None => finding,
    }
}

fn difference(difference: &JointDifference, names: &ModelNames<'_>) -> ReportedDifference {
    let JointDifference { invariant, joint, found, expected } = *difference;
    ReportedDifference { invariant: invariant.name(), joint: names.moving_joint(joint), found, expected }
}
