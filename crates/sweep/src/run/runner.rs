//! Runs single cases in this process, without files.

use std::{
    collections::BTreeMap,
    path::Path,
    sync::{Arc, Mutex, atomic::AtomicBool},
};

use congruent_description::{Robot, RobotDescription, load_robot_set};
use congruent_input::{
    Diagnostic, FileAccess, Findings, Override,
    codes::{cli::SET, toml::UNKNOWN_KEY},
};
use congruent_monitors::NoRecorder;
use congruent_results::report::{AfterRun, RunReport, diagnose_run};
use congruent_twin::{CaseValue, KnownValues, Run, RunSetup};

use super::case_row::CaseRow;
use crate::{
    codes,
    plan::{SweepCase, SweepPlan, VariedKey},
};

/// Most robots that are kept: a plan that varies values of the robot file needs another one in each case.
const MOST_ROBOTS: usize = 16;

/// Runs cases of a plan. A robot is loaded once for each set of values of its file.
#[derive(Debug)]
pub struct CaseRunner<'a> {
    plan: &'a SweepPlan,
    access: FileAccess,
    /// The values that controllers and planner know; `None` if they know those of the case.
    known: Option<Arc<KnownValues>>,
    robots: Mutex<BTreeMap<String, Arc<RobotDescription>>>,
}

impl<'a> CaseRunner<'a> {
    /// A runner of the cases of a plan, whose scenario and robot may open these files.
    pub fn new(plan: &'a SweepPlan, access: FileAccess) -> Self {
        Self { plan, access, known: None, robots: Mutex::default() }
    }

    /// The same for the cases of `[uncertainty]`: controllers and planner of each know the values of `nominal`, the scenario as it is
    /// written.
    #[must_use]
    pub fn with_controllers_of(self, nominal: &RunSetup) -> Self {
        Self { known: Some(Arc::new(nominal.known_values())), ..self }
    }

    /// The plan.
    pub fn plan(&self) -> &'a SweepPlan {
        self.plan
    }

    /// The values that controllers and planner of the cases know.
    pub(crate) fn known(&self) -> Option<&KnownValues> {
        self.known.as_deref()
    }

    /// The files that were opened for the plan.
    pub(crate) fn access(&self) -> &FileAccess {
        &self.access
    }

    /// The checked scenario of a case.
    ///
    /// # Errors
    /// Every finding, if the scenario cannot be run with the values of the case.
    pub fn setup(&self, case: &SweepCase) -> Result<RunSetup, Findings> {
        let setup = self.setup_with(&case.overrides)?;
        let Some(known) = &self.known else { return Ok(setup) };
        let value = |(varied, value): (&VariedKey, &String)| CaseValue {
            key: varied.keys.join(", "),
            value: value.clone(),
            nominal: varied.nominal_value,
        };
        let values = self.plan.varied.iter().zip(&case.values).map(value);
        Ok(setup.as_case(Arc::clone(known), case.case, values.collect()))
    }

    /// The scenario of the first case, or, if its values are refused, of the plan without what varies. What is wrong with a key is
    /// wrong with every case.
    ///
    /// # Errors
    /// The findings about a key, at its place in the plan; or those of the scenario.
    pub fn first_setup(&self) -> Result<RunSetup, Findings> {
        let plan = self.plan;
        self.setup(&plan.case(0)).or_else(|findings| {
            let is_of_key = |finding: &Diagnostic| [UNKNOWN_KEY, SET].contains(&finding.code);
            if findings.iter().any(is_of_key) {
                return Err(plan.at_keys(findings));
            }
            self.setup_with(&plan.set).map_err(|_| findings)
        })
    }

    /// The scenario with these overrides.
    ///
    /// # Errors
    /// As [`CaseRunner::setup`].
    pub fn setup_with(&self, overrides: &[Override]) -> Result<RunSetup, Findings> {
        let robot = |path: &Path, overrides: &[Override], access: &FileAccess| {
            let (of_model, of_file): (Vec<&Override>, Vec<&Override>) =
                overrides.iter().partition(|change| Robot::has_value(change));
            let loaded = self.robot(path, &of_file.into_iter().cloned().collect::<Vec<_>>(), access)?;
            // Values of links and joints are set without the files, since plans vary them continuously.
            let described = RobotDescription::clone(&loaded).with_model_values(&of_model)?;
            if let Some(known) = self.known() {
                same_joints(&described.robot, &known.description.robot)?;
            }
            Ok(described)
        };
        let (access, known) = (self.access.fresh(), self.known().map(|known| &known.description));
        RunSetup::load_with_robot(&self.plan.scenario, overrides, &access, &robot, known)?.for_simulation()
    }

    fn robot(
        &self,
        path: &Path,
        overrides: &[Override],
        access: &FileAccess,
    ) -> Result<Arc<RobotDescription>, Findings> {
        let set: Vec<String> = overrides.iter().map(ToString::to_string).collect();
        let key = format!("{} {}", path.display(), set.join(" "));
        if let Some(known) = self.robots().get(&key) {
            return Ok(Arc::clone(known));
        }
        // Not while the others wait: two threads may load the same robot once.
        let loaded = Arc::new(load_robot_set(path, overrides, access)?);
        let mut robots = self.robots();
        if robots.len() >= MOST_ROBOTS {
            robots.clear();
        }
        robots.insert(key, Arc::clone(&loaded));
        Ok(loaded)
    }

    fn robots(&self) -> std::sync::MutexGuard<'_, BTreeMap<String, Arc<RobotDescription>>> {
        self.robots.lock().expect("no thread panics while it looks a robot up")
    }

    /// The report of a case, or why it cannot be run; `None` if it was interrupted.
    pub(crate) fn report(
        &self,
        case: &SweepCase,
        interrupt: &AtomicBool,
    ) -> Option<Result<RunReport, String>> {
        let setup = match self.setup(case) {
            Ok(setup) => setup,
            Err(findings) => return Some(Err(in_one_line(&findings))),
        };
        Some(report(&setup, interrupt)).filter(|report| {
            report.as_ref().map_or(true, |report| report.error.as_deref() != Some(INTERRUPTED))
        })
    }

    /// The row of a case. What cannot be run has a row that says why.
    pub fn run(&self, case: u64, interrupt: &AtomicBool) -> Option<CaseRow> {
        let case = self.plan.case(case);
        Some(match self.report(&case, interrupt)? {
            Ok(report) => CaseRow::of_run(case, &report),
            Err(error) => CaseRow::refused(case, error),
        })
    }
}

/// Refuses a robot whose joints and links are not those that controllers know.
fn same_joints(robot: &Robot, known: &Robot) -> Result<(), Diagnostic> {
    let names = |robot: &Robot| -> Vec<String> {
        let links = robot.links().iter().map(|link| link.name.clone());
        links.chain(robot.movable_joints().iter().map(|&joint| robot.joint(joint).name.clone())).collect()
    };
    if names(robot) == names(known) {
        return Ok(());
    }
    Err(Diagnostic::error(codes::sweep::KEY, "the robot has other links or joints than with nominal values"))
}

/// The error of a run that somebody has ended, which is no result.
const INTERRUPTED: &str = "interrupted";

/// Runs a checked scenario without files, on this thread.
fn report(setup: &RunSetup, interrupt: &AtomicBool) -> Result<RunReport, String> {
    let run = Run::new(setup).map_err(|error| error.to_string())?;
    let mut run = run.on_one_thread().interrupted_by(Some(interrupt));
    let sources = run.model().sources().to_vec();
    let (outcome, result) = run.finish(&mut setup.checks(), &mut NoRecorder, |_| ());
    let causes = AfterRun::from_samples(diagnose_run(&mut run, &outcome));
    Ok(RunReport::new(setup, &sources, outcome, causes, result.as_ref().err()))
}

/// The errors among findings, without the places of files, which differ from machine to machine.
fn in_one_line(findings: &Findings) -> String {
    let is_error = |finding: &&Diagnostic| finding.severity == congruent_input::Severity::Error;
    let messages: Vec<String> = findings
        .iter()
        .filter(is_error)
        .map(|finding| format!("{}: {}", finding.code.name, finding.message))
        .collect();
    messages.join("; ")
}
