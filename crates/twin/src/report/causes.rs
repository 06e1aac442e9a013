//! After a failed check of agreement: why do model and physics differ? The cause becomes a note of the check, which every
//! report shows, and the whole diagnosis is in `report.json`.

use congruent_agreement::{
    compare::diagnose,
    report::{ReportedDiagnosis, foremost},
};
use congruent_description::{RobotDescription, Tolerance};
use congruent_kinematics::larger;

use crate::{
    run::Outcome,
    scenario::CheckKind,
    setup::RunSetup,
    source::SimulatedPoses,
    verdict::{CheckResult, Status},
};

/// Differences below it are rounding, which has no cause. Unit: m or rad; kind: rounding of two chains of seven joints,
/// worst seen 4e-15.
const ROUNDING: f64 = 1e-12;

/// Diagnoses the first failed check of agreement, if there is one, with its limits as tolerance.
pub(crate) fn explain(setup: &RunSetup, outcome: &mut Outcome) {
    let is_failed =
        |check: &&mut CheckResult| check.check == CheckKind::Agreement && check.status == Status::Fail;
    let Some(check) = outcome.checks.iter_mut().find(is_failed) else { return };
    let worst = check.measures.iter().filter_map(|measure| measure.worst.as_ref());
    if worst.map(|worst| worst.value).fold(0.0, larger) <= ROUNDING {
        check
            .notes
            .push("the difference is rounding: no limit below 1e-12 m and 1e-12 rad can be kept".to_owned());
        return;
    }
    let declared = setup.description.tolerance;
    let limits = limits(check, declared);
    let mut description = RobotDescription { tolerance: limits, ..setup.description.clone() };
    outcome.diagnoses = diagnosed(&description, setup.scenario.seed);
    // A link whose frame the table does not declare may be off by more than the tip: what is within the limits there
    // is found by the tolerance of the robot file.
    description.tolerance = closer(limits, declared);
    if foremost(&outcome.diagnoses).is_none() && description.tolerance != limits {
        let found = diagnosed(&description, setup.scenario.seed);
        if foremost(&found).is_some() {
            outcome.diagnoses = found;
        }
    }
    match (&outcome.diagnosis, foremost(&outcome.diagnoses)) {
        // Model and physics are the same robot: the twin differs from what is measured.
        // The report has that once, for all checks.
        (Some(_), None) => {}
        _ => check.notes.extend(notes(&outcome.diagnoses, &description)),
    }
}

/// A robot that has just been simulated can be simulated; without its physics there is no diagnosis.
fn diagnosed(description: &RobotDescription, seed: u64) -> Vec<ReportedDiagnosis> {
    let physics = SimulatedPoses::new(&description.robot).ok();
    physics.and_then(|mut physics| diagnose(description, &mut physics, seed).ok()).unwrap_or_default()
}

/// The smaller of two tolerances, each part by itself.
fn closer(a: Tolerance, b: Tolerance) -> Tolerance {
    Tolerance {
        position_m: a.position_m.min(b.position_m),
        orientation_rad: a.orientation_rad.min(b.orientation_rad),
    }
}

/// The limits of the check, but not less than rounding.
fn limits(check: &CheckResult, declared: Tolerance) -> Tolerance {
    let limit = |quantity: &str, declared: f64| {
        let measure = check.measures.iter().find(|measure| measure.quantity == quantity);
        measure.map_or(declared, |measure| measure.limit).max(ROUNDING)
    };
    Tolerance {
        position_m: limit("position", declared.position_m),
        orientation_rad: limit("orientation", declared.orientation_rad),
    }
}

fn notes(diagnoses: &[ReportedDiagnosis], description: &RobotDescription) -> Vec<String> {
    let command = format!("congruent check {}", description.path.display());
    if diagnoses.is_empty() {
        return vec![format!("it cannot be diagnosed: `{command}` shows what differs")];
    }
    let Some(diagnosis) = foremost(diagnoses) else {
        return vec![format!(
            "no cause at rest: model and physics agree within these limits if they are placed at configurations; `{command} \
             --configurations FILE` compares them at those of this report"
        )];
    };
    let statements = diagnosis.statements();
    if statements.is_empty() {
        return vec![format!("no known cause explains it: `{command}` shows what differs")];
    }
    let first = format!("cause ({}): ", diagnosis.title);
    let starts = std::iter::once(first.as_str()).chain(std::iter::repeat("and: "));
    let mut notes: Vec<String> =
        starts.zip(statements).map(|(start, line)| format!("{start}{line}")).collect();
    match diagnosis.indistinguishable.len() {
        0 => {}
        1 => notes.push(format!("another cause cannot be distinguished from it: `{command}` shows it")),
        count => notes
            .push(format!("{count} other causes cannot be distinguished from it: `{command}` lists them")),
    }
    notes
}
