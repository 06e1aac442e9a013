//! A report as a test suite: one case for each check, compared with the expectation of the scenario.

use congruent_fault_diagnosis::RunDiagnosis;
use congruent_input::display::quantity;
use congruent_monitors::verdict::{CheckResult, Status, Verdict};
use congruent_scenario::{CheckKind, Expectation};
use congruent_twin::RunSetup;

use super::{
    cases::{CheckInCases, RequirementVerdict, UncertaintyReport, case_lines, unfinished_words},
    run_report::{RunClockReport, RunReport},
    sentence::lines,
    suite::{CasePlace, Clock, Reason, TestCase, TestResult, TestSuite},
};

impl RunReport {
    /// The checks as a test suite, in the order of the scenario; its time is the simulated one.
    pub fn test_suite(&self) -> TestSuite {
        let checks = self.checks.iter().enumerate();
        let mut cases: Vec<TestCase> = checks.map(|(index, check)| self.case(index, check)).collect();
        if let Some(uncertainty) = &self.uncertainty {
            cases.extend(uncertainty.checks.iter().map(|check| self.in_cases(uncertainty, check)));
        }
        if self.verdict == Verdict::NothingChecked || self.error.is_some() {
            let message = match &self.error {
                Some(error) => format!("{}: {error}", self.broken()),
                None => "nothing was checked".to_owned(),
            };
            let reason = Reason { kind: "run".to_owned(), message };
            let result = TestResult::Error(reason);
            cases.push(TestCase {
                name: "run".to_owned(),
                result,
                output: String::new(),
                place: None,
                further: Vec::new(),
            });
        }
        let time_s = self.simulation.duration_s;
        TestSuite { cases, time_s, clock: Clock::Simulated, ..TestSuite::new(&self.scenario) }
    }

    /// When and after how many steps a failed run ended.
    fn broken(&self) -> String {
        let RunClockReport { steps, duration_s, .. } = self.simulation;
        format!("the run failed at {} after {steps} steps", quantity(duration_s, "s"))
    }

    /// A check in all cases of `[uncertainty]`. Too few of them are an error: nothing is known.
    fn in_cases(&self, cases: &UncertaintyReport, check: &CheckInCases) -> TestCase {
        let mut lines = case_lines(cases, check);
        if check.requirement.verdict != RequirementVerdict::Met {
            lines.extend(unfinished_words(cases));
            let command = check.first_failing.map(|case| self.command_of(case));
            lines.extend(command.map(|command| format!("the first case that fails: {command}")));
        }
        let output = lines.join("\n");
        let reason = || Reason { kind: check.check.word().to_owned(), message: output.clone() };
        let result = match check.requirement.verdict {
            RequirementVerdict::Met => TestResult::Passed,
            RequirementVerdict::NotMet => TestResult::Failed(reason()),
            RequirementVerdict::NotEnoughCases => {
                let Reason { kind, message } = reason();
                TestResult::Error(Reason { kind, message: format!("not enough cases: {message}") })
            }
        };
        let place = CasePlace::if_known(self.scenario_file.as_deref(), check.line);
        let added = if check.is_default { [BY_DEFAULT, IN_CASES].concat() } else { IN_CASES.to_owned() };
        let name = case_name(check.number - 1, check.check, &added);
        TestCase { name, result, output, place, further: Vec::new() }
    }

    fn case(&self, index: usize, check: &CheckResult) -> TestCase {
        let diagnosis = self.diagnosis.iter().filter(|_| check.status == Status::Fail);
        let causes = diagnosis.flat_map(RunDiagnosis::sentences).map(|cause| format!("diagnosis: {cause}"));
        let output = lines(check).into_iter().chain(causes).collect::<Vec<_>>().join("\n");
        let message = match &self.error {
            Some(error) if check.status == Status::Error => {
                format!("{}: {error}; result until then: {output}", self.broken())
            }
            _ => output.clone(),
        };
        let result = judged(check.check, check.status, &self.expected, self.verdict, message);
        let place = CasePlace::if_known(self.scenario_file.as_deref(), check.line);
        let added = if check.is_default { BY_DEFAULT } else { "" };
        TestCase { name: case_name(index, check.check, added), result, output, place, further: Vec::new() }
    }
}

/// The result of a check by what the scenario expects of it, in a run of this verdict.
pub fn judged(
    check: CheckKind,
    status: Status,
    expected: &Expectation,
    verdict: Verdict,
    message: String,
) -> TestResult {
    let must_fail = match expected {
        Expectation::Pass => false,
        Expectation::Fail { checks } => checks.is_empty() || checks.contains(&check),
    };
    let reason = |message: String| Reason { kind: check.word().to_owned(), message };
    match status {
        Status::Pass if !must_fail => TestResult::Passed,
        Status::Fail if must_fail => TestResult::Passed,
        // With no kind named, any one failure is enough.
        Status::Pass if verdict == Verdict::AsExpected => TestResult::Passed,
        Status::Pass => TestResult::Failed(reason(format!("unexpected pass: {message}"))),
        Status::Skipped | Status::Inconclusive => TestResult::Skipped(message),
        Status::Error => TestResult::Error(reason(message)),
        Status::Fail => TestResult::Failed(reason(message)),
    }
}

/// The suite of a scenario before its run: every check as not run, an error.
pub fn planned_suite(setup: &RunSetup) -> TestSuite {
    let file = setup.path.as_ref().map(|path| path.display().to_string());
    let cases = setup.checks().into_iter().enumerate().map(|(index, check)| {
        let message = "not finished: the program ended before this check".to_owned();
        let added = if check.is_default { BY_DEFAULT } else { "" };
        TestCase {
            name: case_name(index, check.kind, added),
            result: TestResult::Error(Reason { kind: "unfinished".to_owned(), message }),
            output: String::new(),
            place: CasePlace::if_known(file.as_deref(), check.line),
            further: Vec::new(),
        }
    });
    let mut cases: Vec<TestCase> = cases.collect();
    if cases.is_empty() {
        let message = "not finished: the program ended before this run".to_owned();
        let reason = Reason { kind: "unfinished".to_owned(), message };
        cases = TestSuite::with_case("", "run", TestResult::Error(reason)).cases;
    }
    TestSuite { cases, ..TestSuite::new(&setup.scenario.name) }
}

/// Added to the name of a check that the scenario does not give.
const BY_DEFAULT: &str = "_default";

/// Added to the name of a check in all cases of `[uncertainty]`.
const IN_CASES: &str = "_in_cases";

/// The name of a case: the number of the check in the scenario, from 1, and its kind.
fn case_name(index: usize, kind: CheckKind, added: &str) -> String {
    format!("{}_{kind}{added}", index + 1)
}
