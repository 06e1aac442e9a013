//! Faults against checks: which check detects which fault, after which time, and whether the diagnosis is right.

use congruent_fault_diagnosis::{FaultVerdict, RunDiagnosis, judge};
use congruent_input::{Finding, display::quantity, visible};
use congruent_monitors::verdict::{CheckResult, Status, Verdict};
use congruent_scenario::{CheckKind, RunFault};
use schemars::JsonSchema;
use serde::Serialize;

use super::run_report::RunReport;

/// The runs of several scenarios, each with its faults or with none.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FaultTable {
    /// One row for each scenario.
    pub rows: Vec<FaultRow>,
    /// Every kind of check of these scenarios.
    pub checks: Vec<CheckKind>,
    /// Kinds of check that detect none of the faults.
    pub blind_checks: Vec<CheckKind>,
    /// Names of scenarios with faults that no check detects.
    pub unseen: Vec<String>,
    /// Names of scenarios without faults in which a check fails or the diagnosis names a fault.
    pub false_alarms: Vec<String>,
    /// Names of scenarios whose diagnosis is not right.
    pub not_diagnosed: Vec<String>,
    /// Names of scenarios whose simulation failed.
    pub broken: Vec<String>,
}

/// One scenario of the table, with its faults, checks and diagnosis.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FaultRow {
    /// Name of the scenario.
    pub scenario: String,
    /// Name of the robot.
    pub robot: String,
    /// The faults that the scenario injects.
    pub faults: Vec<RunFault>,
    /// Every kind of check of this scenario, with its detection time.
    pub checks: Vec<DetectedBy>,
    /// Faults that the diagnosis found in the samples of the run; `None` for none.
    pub diagnosis: Option<RunDiagnosis>,
    /// Agreement of the diagnosis with the injected faults.
    pub judgement: FaultVerdict,
    /// Warnings about the scenario and its robot.
    pub warnings: Vec<Finding>,
}

/// Whether and when one kind of check detects the fault.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct DetectedBy {
    /// Kind of the check.
    pub check: CheckKind,
    /// Whether the check failed.
    pub fails: bool,
    /// Whether the check failed before the first fault began, so that the fault is not the reason.
    pub before_fault: bool,
    /// Time from the beginning of the first fault to the first violation.
    pub after_s: Option<f64>,
}

impl FaultTable {
    /// The table of these runs.
    pub fn new(reports: &[RunReport]) -> Self {
        let rows: Vec<FaultRow> = reports.iter().map(FaultRow::new).collect();
        let mut checks: Vec<CheckKind> = Vec::new();
        for detected in rows.iter().flat_map(|row| &row.checks) {
            if !checks.contains(&detected.check) {
                checks.push(detected.check);
            }
        }
        let named = |is: &dyn Fn(&FaultRow) -> bool| -> Vec<String> {
            rows.iter().filter(|row| is(row)).map(|row| row.scenario.clone()).collect()
        };
        let broken = reports.iter().filter(|report| report.verdict == Verdict::Broken);
        let detects = |kind: CheckKind| {
            let faulty = rows.iter().filter(|row| !row.faults.is_empty());
            faulty
                .flat_map(|row| &row.checks)
                .any(|detected| detected.check == kind && detected.fails && !detected.before_fault)
        };
        Self {
            blind_checks: checks.iter().copied().filter(|&kind| !detects(kind)).collect(),
            unseen: named(&|row| !row.faults.is_empty() && !row.is_detected()),
            false_alarms: named(&FaultRow::is_false_alarm),
            not_diagnosed: named(&|row| !row.faults.is_empty() && row.judgement != FaultVerdict::Right),
            broken: broken.map(|report| report.scenario.clone()).collect(),
            checks,
            rows,
        }
    }

    /// Whether every fault is detected and diagnosed, and there is no false alarm.
    pub fn is_sound(&self) -> bool {
        [&self.unseen, &self.false_alarms, &self.not_diagnosed, &self.broken]
            .iter()
            .all(|names| names.is_empty())
    }

    /// Each deviation from a sound table, in a sentence.
    pub fn remarks(&self) -> Vec<String> {
        let remark =
            |names: &[&str], what: &str| (!names.is_empty()).then(|| format!("{what}: {}", names.join(", ")));
        let scenarios = |found: &[String], what: &str| {
            let names: Vec<&str> = found.iter().map(String::as_str).collect();
            remark(&names, what)
        };
        let blind: Vec<&str> = self.blind_checks.iter().map(|kind| kind.word()).collect();
        [
            scenarios(&self.broken, "the simulation failed"),
            scenarios(&self.unseen, "not detected by any check"),
            scenarios(
                &self.false_alarms,
                "false alarm: a check fails or the diagnosis names a fault without a fault, or before it",
            ),
            scenarios(&self.not_diagnosed, "the diagnosis is not right"),
            remark(&blind, "checks that detect none of these faults"),
        ]
        .into_iter()
        .flatten()
        .collect()
    }

    /// The table in Markdown, with the remarks as a list below it.
    pub fn markdown(&self) -> String {
        let words: Vec<&str> = self.checks.iter().map(|kind| kind.word()).collect();
        let mut lines = vec![
            format!("| scenario | injected | {} | diagnosis | right |", words.join(" | ")),
            format!("|---|---|{}---|---|", "---|".repeat(words.len())),
        ];
        for row in &self.rows {
            let checks: Vec<String> = self.checks.iter().map(|&kind| row.cell(kind)).collect();
            lines.push(format!(
                "| `{}` | {} | {} | {} | {} |",
                cell(&row.scenario),
                cell(&row.injected()),
                checks.join(" | "),
                cell(&row.diagnosed()),
                row.judged()
            ));
        }
        let remarks = self.remarks();
        if !remarks.is_empty() {
            lines.push(String::new());
            lines.extend(remarks.iter().map(|remark| format!("- {}", cell(remark))));
        }
        lines.join("\n") + "\n"
    }
}

/// Text with names of files as text of a cell: it ends neither the cell nor its quotes, and is no HTML.
fn cell(text: &str) -> String {
    visible(text).replace('|', "\\|").replace('`', "'").replace('<', "&lt;")
}

impl FaultRow {
    fn new(report: &RunReport) -> Self {
        let begin_s = report.faults.iter().map(|fault| fault.from_s).fold(f64::INFINITY, f64::min);
        let mut checks: Vec<DetectedBy> = Vec::new();
        for result in &report.checks {
            let detected = detected_by(result, begin_s);
            match checks.iter_mut().find(|known| known.check == detected.check) {
                Some(known) if detected.fails && (!known.fails || detected.after_s < known.after_s) => {
                    *known = detected;
                }
                Some(_) => {}
                None => checks.push(detected),
            }
        }
        let found: Vec<RunFault> = report.diagnosis.iter().flat_map(RunDiagnosis::run_faults).collect();
        Self {
            scenario: report.scenario.clone(),
            robot: report.robot.clone(),
            faults: report.faults.clone(),
            checks,
            diagnosis: report.diagnosis.clone(),
            judgement: judge(&report.faults, &found),
            warnings: report.warnings.clone(),
        }
    }

    fn is_detected(&self) -> bool {
        self.checks.iter().any(|detected| detected.fails && !detected.before_fault)
    }

    /// Whether a check or the diagnosis reports a fault without one, or a check fails before it.
    fn is_false_alarm(&self) -> bool {
        let without = self.faults.is_empty() && (self.is_detected() || self.diagnosis.is_some());
        without || self.checks.iter().any(|detected| detected.before_fault)
    }

    /// The cell of a check: the time from the fault to its detection, or a dash.
    pub fn cell(&self, kind: CheckKind) -> String {
        match self.checks.iter().find(|detected| detected.check == kind) {
            Some(DetectedBy { before_fault: true, .. }) => "before it".to_owned(),
            Some(DetectedBy { fails: true, after_s, .. }) => {
                after_s.map_or("fails".to_owned(), |after_s| quantity(after_s, "s"))
            }
            Some(_) => "-".to_owned(),
            None => String::new(),
        }
    }

    /// The injected faults, in sentences.
    pub fn injected(&self) -> String {
        let sentences: Vec<String> = self.faults.iter().map(RunFault::sentence).collect();
        if sentences.is_empty() { "nothing".to_owned() } else { sentences.join("; ") }
    }

    /// The faults of the diagnosis, in sentences.
    pub fn diagnosed(&self) -> String {
        let sentences = self.diagnosis.as_ref().map(RunDiagnosis::sentences).unwrap_or_default();
        if sentences.is_empty() { "nothing".to_owned() } else { sentences.join("; ") }
    }

    /// Whether the diagnosis is right: the cell of the last column.
    pub fn judged(&self) -> &'static str {
        match self.judgement {
            FaultVerdict::Right => "yes",
            FaultVerdict::OtherValue => "another value",
            FaultVerdict::Wrong | FaultVerdict::Nothing => "no",
        }
    }
}

/// Times are products of whole numbers of steps, which are equal to this within rounding, s.
const AT_THE_BEGIN_S: f64 = 1e-9;

fn detected_by(result: &CheckResult, begin_s: f64) -> DetectedBy {
    let violations = result.measures.iter().filter_map(|measure| measure.first_violation.as_ref());
    let first_s = violations.map(|moment| moment.time_s).fold(f64::INFINITY, f64::min);
    let after_s = first_s - begin_s;
    let fails = result.status == Status::Fail;
    DetectedBy {
        check: result.check,
        fails,
        before_fault: fails && begin_s.is_finite() && after_s < -AT_THE_BEGIN_S,
        after_s: after_s.is_finite().then_some(after_s),
    }
}
