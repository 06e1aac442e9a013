//! A diagnosis in names of the robot, as a report for programs and as findings for people.

use congruent_input::{Diagnostic, display::length_and_angle};
use congruent_kinematics::PoseError;

use super::{
    advice::{self, FileCorrection, file_correction},
    as_written::is_same_as_written,
    content::{
        CorrectedFile, Fault, ReportedAlternative, ReportedCause, ReportedDiagnosis, ReportedDifference,
        ReportedStage,
    },
    fault_message::{FaultContext, FaultMessage, FileLocation, describe_fault},
    names::ModelNames,
    preferred::with_known_values,
    table::table_comparison,
};
use crate::{
    diagnosis::{Cause, Criterion, Diagnosis, Equivalence, Explanation, JointDifference, ModelPair},
    source_pair::SourcePair,
};

pub(super) fn reported_diagnosis(
    pair: SourcePair,
    models: &ModelPair,
    criterion: &Criterion,
    mut diagnosis: Diagnosis,
    names: &ModelNames<'_>,
) -> ReportedDiagnosis {
    let described = |explanation: &Explanation| describe(explanation, models, criterion, names);
    let agrees = |file: &CorrectedFile| is_same_as_written(file, models, criterion, names);
    let mut causes: Vec<DescribedCause> = diagnosis.explanations.iter().map(described).collect();
    let mut others: Vec<DescribedCause> =
        diagnosis.indistinguishable.iter().map(|(other, _)| described(other)).collect();
    // Named is a cause whose correction, as it is written, makes the models the same, if there is one.
    if diagnosis.explanations.first().is_some_and(|first| first.is_complete)
        && let Some(better) = better_as_written(&causes[0], &others, agrees)
    {
        std::mem::swap(&mut causes[0], &mut others[better]);
        others[..=better].rotate_right(1);
        diagnosis = diagnosis.preferring(better, models, criterion);
    }
    let findings = causes.first().map(|first| first.findings.clone()).unwrap_or_default();
    // The file without the named cause, or if the file cannot say its correction without one that cannot be distinguished
    // from it, rather one that the next check will agree with; none for a cause that is exact in place of one that digits excuse.
    let is_exact = |of: &Explanation| criterion.is_beyond_digits(&of.residual);
    let needs_exact = diagnosis.explanations.first().is_some_and(is_exact);
    let alternatives = others.iter().zip(&diagnosis.indistinguishable);
    let alternatives = alternatives.filter(|(_, (other, _))| !needs_exact || is_exact(other));
    let corrected = causes.first().and_then(|first| first.corrected.clone()).or_else(|| {
        let mut files = alternatives.filter_map(|(other, _)| other.corrected.as_ref());
        files.clone().find(|file| agrees(file) == Some(true)).or_else(|| files.next()).cloned()
    });
    // Beside a cause with a residual above the tolerance, or if the digits explain a difference that is not tolerated.
    let rounded = || Explanation::without_faults(models, criterion);
    let unexplained = match diagnosis.explanations.first() {
        Some(first) => (!first.is_complete).then(|| first.clone()),
        None => (!models.is_within_tolerance(criterion)).then(rounded),
    };
    let equivalences = diagnosis.indistinguishable.iter().map(|(_, equivalence)| *equivalence);
    let alternative = |(other, equivalence): (DescribedCause, Equivalence)| ReportedAlternative {
        cause: other.cause,
        equivalence,
        reason: equivalence.sentence(),
    };
    ReportedDiagnosis {
        name: pair,
        title: pair.title(),
        causes: causes.into_iter().map(|described| described.cause).collect(),
        indistinguishable: others.into_iter().zip(equivalences).map(alternative).collect(),
        invariants: diagnosis.differences.iter().map(|each| difference(each, names)).collect(),
        table: unexplained.and_then(|first| table_comparison(models, &first, criterion, names)),
        corrected,
        findings,
    }
}

/// Which of the causes that cannot be distinguished from the named one agrees as it is written, if that one does not.
fn better_as_written(
    named: &DescribedCause,
    others: &[DescribedCause],
    agrees: impl Fn(&CorrectedFile) -> Option<bool>,
) -> Option<usize> {
    let agrees = |cause: &DescribedCause| cause.corrected.as_ref().and_then(&agrees);
    if others.is_empty() || agrees(named) != Some(false) {
        return None;
    }
    others.iter().position(|other| agrees(other) == Some(true))
}

/// A cause with its findings, and the robot file without it, if the file can say the correction.
struct DescribedCause {
    cause: ReportedCause,
    findings: Vec<Diagnostic>,
    corrected: Option<CorrectedFile>,
}

fn describe(
    explanation: &Explanation,
    models: &ModelPair,
    criterion: &Criterion,
    names: &ModelNames<'_>,
) -> DescribedCause {
    let explanation = &with_known_values(explanation, models, criterion);
    let slack = advice::slack(models, explanation, criterion);
    let message = |fault| {
        describe_fault(&FaultContext { fault, before: models, after: &explanation.corrected, slack, names })
    };
    let mut messages: Vec<FaultMessage> = explanation.faults.iter().map(message).collect();
    let mut corrected = None;
    if let Some(places) = names.places {
        let FileCorrection { by_fault, edits } = file_correction(models, explanation, places, slack);
        if !edits.is_empty() && by_fault.iter().all(Option::is_some) {
            corrected = Some(CorrectedFile::new(places.source(), &edits));
        }
        for (message, changes) in messages.iter_mut().zip(by_fault) {
            if let Some(changes) = changes {
                message.advise(changes, places.source());
            }
        }
    }
    let stages = explanation.stages.windows(2).map(|pair| ReportedStage { before: pair[0], after: pair[1] });
    let (messages, stages) = without_repeated(messages, stages.collect());
    // After the advice: the findings show the lines to write.
    let findings = messages.iter().zip(&stages).map(|(message, stage)| finding(message, stage));
    let findings = findings.collect();
    let mut parts: Vec<Fault> = messages.into_iter().map(|message| message.fault).collect();
    let fault = match parts.len() {
        0 => Fault {
            cause: Cause::Unexplained,
            message: "no known cause explains the difference".to_owned(),
            suggestion: "no known cause explains the difference: compare the table row by row with the data sheet; `invariants` lists the joint axes that differ"
                .into(),
            ..Fault::default()
        },
        1 => parts.remove(0),
        _ => several(&parts),
    };
    let PoseError { position_m, orientation_rad } = explanation.residual;
    let cause = ReportedCause {
        fault,
        residual_m: position_m,
        residual_rad: orientation_rad,
        within_tolerance: explanation.is_complete,
        parts,
        stages,
    };
    DescribedCause { cause, findings, corrected }
}

/// Two faults with the same words as one, such as two rows that are exchanged in one half after the other.
fn without_repeated(
    messages: Vec<FaultMessage>,
    stages: Vec<ReportedStage>,
) -> (Vec<FaultMessage>, Vec<ReportedStage>) {
    // An incomplete explanation may have fewer stages than faults.
    if messages.len() != stages.len() {
        return (messages, stages);
    }
    let mut kept: Vec<(FaultMessage, ReportedStage)> = Vec::new();
    for (message, stage) in messages.into_iter().zip(stages) {
        match kept.last_mut().filter(|(last, _)| last.message == message.message) {
            Some((last, before)) => {
                before.after = stage.after;
                // The lines to write are those of one of the two.
                if last.fault.changes.is_empty() {
                    *last = message;
                }
            }
            None => kept.push((message, stage)),
        }
    }
    kept.into_iter().unzip()
}

/// Several faults as one: all of their lines.
pub(super) fn several(parts: &[Fault]) -> Fault {
    let located = parts.iter().find(|part| part.line.is_some());
    let all =
        |words: fn(&Fault) -> &str, between: &str| parts.iter().map(words).collect::<Vec<_>>().join(between);
    Fault {
        cause: Cause::Several,
        joints: involved(parts),
        file: located.and_then(|part| part.file.clone()),
        line: located.and_then(|part| part.line),
        message: all(|part| &part.message, "; "),
        suggestion: all(|part| &part.suggestion, "\n"),
        changes: parts.iter().flat_map(|part| part.changes.iter().cloned()).collect(),
        ..Fault::default()
    }
}

fn involved(parts: &[Fault]) -> Vec<String> {
    let mut joints: Vec<String> =
        parts.iter().flat_map(|part| part.joint.iter().chain(&part.joints)).cloned().collect();
    joints.sort();
    joints.dedup();
    joints
}

/// A fault as a finding in its file.
pub(super) fn finding(fault_message: &FaultMessage, stage: &ReportedStage) -> Diagnostic {
    let FaultMessage { fault, message, location } = fault_message;
    let formatted = |error: &PoseError| length_and_angle(error.position_m, error.orientation_rad);
    let error = format!(
        "difference before the fix: {}, after it: {}",
        formatted(&stage.before),
        formatted(&stage.after)
    );
    let pasted: Vec<String> = fault.pasted.iter().map(ToString::to_string).collect();
    let advice = if pasted.is_empty() { fault.suggestion.clone() } else { pasted.join("\n") };
    let finding =
        Diagnostic::error(fault.cause.code(), message.clone()).with_help(format!("{advice}\n{error}"));
    match location {
        Some(FileLocation { source, span }) => finding.at(span.clone()).in_file(source),
        None => finding,
    }
}

pub(super) fn difference(difference: &JointDifference, names: &ModelNames<'_>) -> ReportedDifference {
    let JointDifference { invariant, joint, found, expected } = *difference;
    ReportedDifference { invariant, joint: names.moving_joint(joint), found, expected }
}
