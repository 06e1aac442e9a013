//! What is found after a run. After a failed check of agreement: why do model and physics differ? The cause becomes a note of the check,
//! which every report shows, and the whole diagnosis is in `report.json`.

use congruent_agreement::{
    compare::{CheckOptions, Grade, check, diagnose},
    report::{ReportedDiagnosis, foremost},
};
use congruent_description::{RobotDescription, Tolerance};
use congruent_fault_diagnosis::{DiagnosedRun, RunDiagnosis, diagnose as diagnose_samples};
use congruent_input::Quantity;
use congruent_kinematics::larger;
use congruent_monitors::verdict::{CheckResult, Status};
use congruent_proximity::MovingBodies;
use congruent_scenario::CheckKind;
use congruent_twin::{Outcome, Run, RunSetup, source::SimulatedPoses};

use super::cases::UncertaintyReport;

/// Differences below it are rounding, which has no cause. Unit: m or rad; kind: rounding of two chains of seven joints,
/// worst seen 4e-15.
const ROUNDING: f64 = 1e-12;

/// What was found after a run: why checks failed, and what the cases of `[uncertainty]` show.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct AfterRun {
    /// Why model and twin differ, if a check of their agreement failed and the source is the physics.
    pub poses: Vec<ReportedDiagnosis>,
    /// What the samples show to be wrong with the twin, if a check failed.
    pub samples: Option<RunDiagnosis>,
    /// The cases of `[uncertainty]`, if the scenario has some.
    pub cases: Option<UncertaintyReport>,
    /// The same as the text of `cases.csv`, a row for each case.
    pub case_table: Option<Vec<u8>>,
}

impl AfterRun {
    /// The causes of a run whose poses are not diagnosed: it was placed at its setpoints, or the diagnosis is read back.
    pub fn from_samples(samples: Option<RunDiagnosis>) -> Self {
        Self { samples, ..Self::default() }
    }
}

/// What the samples of a finished run show to be wrong with the twin, if a check failed.
pub fn diagnose_run(run: &mut Run<'_>, outcome: &Outcome) -> Option<RunDiagnosis> {
    // The faults that are known by their traces are those of a simulation: a log has no second source to compare with.
    if !run.is_simulated() || outcome.checks.iter().all(|check| check.status != Status::Fail) {
        return None;
    }
    let setup = run.setup();
    // What is wrong with a case of [uncertainty] is known: the values that its controllers do not know.
    if setup.uncertain_case.is_some() {
        return None;
    }
    let diagnosed = DiagnosedRun {
        description: &setup.description,
        clock: &setup.clock,
        controller: setup.controller.kind,
        actuators: setup.actuator_limits(),
        dynamics: setup.declared_dynamics(),
        bodies: MovingBodies::new(&setup.bodies, &setup.obstacles),
    };
    let (samples, clearance) = run.samples_and_clearance();
    let found = diagnose_samples(diagnosed, samples, clearance);
    with_actuators(found, outcome)
}

/// The same with the actuators that do not deliver what they are commanded to, and of which the motion shows no fault.
fn with_actuators(found: Option<RunDiagnosis>, outcome: &Outcome) -> Option<RunDiagnosis> {
    let measures = outcome.checks.iter().flat_map(|check| &check.measures);
    let violations = measures
        .filter(|measure| measure.quantity == Quantity::EffortError)
        .filter_map(|measure| measure.first_violation.as_ref());
    let is_named = |joint: &String| {
        let start = format!("joint {joint}: ");
        found.as_ref().is_some_and(|found| {
            found.run_faults().any(|fault| fault.joints.contains(joint))
                || found.unexplained.iter().any(|sentence| sentence.starts_with(&start))
        })
    };
    let unnamed: Vec<String> = violations
        .filter(|violation| !is_named(&violation.subject))
        .map(|violation| {
            format!(
                "joint {}: its actuator does not deliver the commanded effort, and the motion does not show which part: what is \
                 missing is too small beside the efforts of the arm, or the joint is at a limit",
                violation.subject
            )
        })
        .collect();
    if unnamed.is_empty() {
        return found;
    }
    let mut found = found.unwrap_or_default();
    found.unexplained.extend(unnamed);
    Some(found)
}

/// Why checks of a finished run failed: what its samples show, and the cause of the first failed check of agreement, which
/// becomes a note of that check.
pub fn explain(run: &mut Run<'_>, outcome: &mut Outcome) -> AfterRun {
    let mut causes = AfterRun::from_samples(diagnose_run(run, outcome));
    explain_poses(run.setup(), &mut outcome.checks, &mut causes);
    causes
}

/// Diagnoses the first failed check of agreement, if there is one, with its limits as tolerance.
fn explain_poses(setup: &RunSetup, checks: &mut [CheckResult], causes: &mut AfterRun) {
    let is_failed =
        |check: &&mut CheckResult| check.check == CheckKind::Agreement && check.status == Status::Fail;
    let Some(check) = checks.iter_mut().find(is_failed) else { return };
    let worst = check.measures.iter().filter_map(|measure| measure.worst.as_ref());
    if worst.map(|worst| worst.value).fold(0.0, larger) <= ROUNDING {
        check
            .notes
            .push("the difference is rounding: choose limits of at least 1e-12 m and 1e-12 rad".to_owned());
        return;
    }
    let declared = setup.description.tolerance;
    let limits = limits(check, declared);
    let mut description = RobotDescription { tolerance: limits, ..setup.description.clone() };
    causes.poses = diagnosed(&description, setup.scenario.seed);
    // The limits of the check may be wider than the difference that has a cause: a link whose frame the table does not
    // declare may differ by more than the tip. The tolerance of the robot file then finds the cause.
    description.tolerance = closer(limits, declared);
    if foremost(&causes.poses).is_none() && description.tolerance != limits {
        let found = diagnosed(&description, setup.scenario.seed);
        if foremost(&found).is_some() {
            causes.poses = found;
        }
    }
    match (&causes.samples, foremost(&causes.poses)) {
        // Model and physics are the same robot, so the cause is a fault of the twin, which the report states once for all
        // checks.
        (Some(_), None) => {}
        (None, None) if differs_by_rounding(&setup.description, setup.scenario.seed) => {
            check.notes.push(BY_ROUNDING.to_owned());
        }
        _ => check.notes.extend(notes(&causes.poses, &description)),
    }
}

/// What to do about a table that is typed with fewer digits than the URDF.
const BY_ROUNDING: &str = "table and URDF differ by rounding alone, by which a run does not judge: declare in robot.toml what it may \
    be, for example [tolerance] position_mm = 1.0, or write more digits";

/// Whether `check` finds table and URDF the same within the digits that they are written with.
fn differs_by_rounding(description: &RobotDescription, seed: u64) -> bool {
    let written = RobotDescription { tolerance: Tolerance::default(), ..description.clone() };
    let options = CheckOptions { seed, ..CheckOptions::default() };
    let physics = SimulatedPoses::new(&written.robot).ok();
    let report = physics.and_then(|mut physics| check(&written, Ok(&mut physics), &options).ok());
    report.is_some_and(|report| report.grade == Some(Grade::SameWithinDigits))
}

/// The diagnosis of model against physics; none if the robot cannot be simulated again.
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
    let limit = |quantity: Quantity, declared: f64| {
        let measure = check.measures.iter().find(|measure| measure.quantity == quantity);
        measure.map_or(declared, |measure| measure.limit).max(ROUNDING)
    };
    Tolerance {
        position_m: limit(Quantity::Position, declared.position_m),
        orientation_rad: limit(Quantity::Orientation, declared.orientation_rad),
    }
}

fn notes(diagnoses: &[ReportedDiagnosis], description: &RobotDescription) -> Vec<String> {
    let command = format!("congruent check {}", description.path.display());
    if diagnoses.is_empty() {
        return vec![format!("no diagnosis is possible: `{command}` lists the differences")];
    }
    let Some(diagnosis) = foremost(diagnoses) else {
        return vec![format!(
            "no cause at rest: model and physics agree within these limits at random configurations; `{command} \
             --configurations FILE` compares them at the configurations of this report"
        )];
    };
    let statements = diagnosis.statements();
    if statements.is_empty() {
        return vec![format!("no known cause explains the difference: `{command}` lists the differences")];
    }
    let first = format!("cause ({}): ", diagnosis.title);
    let starts = std::iter::once(first.as_str()).chain(std::iter::repeat("and: "));
    starts.zip(statements).map(|(start, line)| format!("{start}{line}")).collect()
}
