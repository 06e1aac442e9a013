//! Faults against checks: which check sees which fault, after how long, and what the diagnosis says.

use congruent_description::{Finding, display::quantity, visible};
use schemars::JsonSchema;
use serde::Serialize;

use super::run_report::RunReport;
use crate::{
    diagnosis::RunDiagnosis,
    fault::{Judgement, RunFault, judge},
    scenario::CheckKind,
    verdict::{CheckResult, Status, Verdict},
};

/// The runs of several scenarios, each with its faults or with none.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FaultTable {
    /// One row for each scenario.
    pub rows: Vec<FaultRow>,
    /// Every kind of check of these scenarios.
    pub checks: Vec<CheckKind>,
    /// Kinds of check that see none of the faults.
    pub blind_checks: Vec<CheckKind>,
    /// Scenarios with faults that no check sees.
    pub unseen: Vec<String>,
    /// Scenarios without faults in which a check fails or the diagnosis finds something.
    pub false_alarms: Vec<String>,
    /// Scenarios whose diagnosis is not right.
    pub not_diagnosed: Vec<String>,
    /// Scenarios whose simulation failed.
    pub broken: Vec<String>,
}

/// One scenario.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FaultRow {
    /// Its name.
    pub scenario: String,
    /// Its robot.
    pub robot: String,
    /// The faults that are injected.
    pub faults: Vec<RunFault>,
    /// Every kind of check of this scenario.
    pub checks: Vec<SeenBy>,
    /// What the samples show to be wrong.
    pub diagnosis: Option<RunDiagnosis>,
    /// Whether that is right.
    pub judgement: Judgement,
    /// What is suspicious about the scenario and its robot.
    pub warnings: Vec<Finding>,
}

/// What one kind of check says.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct SeenBy {
    /// The kind.
    pub check: CheckKind,
    /// Whether it failed.
    pub fails: bool,
    /// Whether it failed before the first fault began, so that it is not the fault that it sees.
    pub before_fault: bool,
    /// Time from the beginning of the first fault to the first violation.
    pub after_s: Option<f64>,
}

impl FaultTable {
    /// The table of these runs.
    pub fn new(reports: &[RunReport]) -> Self {
        let rows: Vec<FaultRow> = reports.iter().map(FaultRow::new).collect();
        let mut checks: Vec<CheckKind> = Vec::new();
        for seen in rows.iter().flat_map(|row| &row.checks) {
            if !checks.contains(&seen.check) {
                checks.push(seen.check);
            }
        }
        let named = |is: &dyn Fn(&FaultRow) -> bool| -> Vec<String> {
            rows.iter().filter(|row| is(row)).map(|row| row.scenario.clone()).collect()
        };
        let broken = reports.iter().filter(|report| report.verdict == Verdict::Broken);
        let sees = |kind: CheckKind| {
            let faulty = rows.iter().filter(|row| !row.faults.is_empty());
            faulty
                .flat_map(|row| &row.checks)
                .any(|seen| seen.check == kind && seen.fails && !seen.before_fault)
        };
        Self {
            blind_checks: checks.iter().copied().filter(|&kind| !sees(kind)).collect(),
            unseen: named(&|row| !row.faults.is_empty() && !row.is_seen()),
            false_alarms: named(&FaultRow::is_false_alarm),
            not_diagnosed: named(&|row| !row.faults.is_empty() && row.judgement != Judgement::Right),
            broken: broken.map(|report| report.scenario.clone()).collect(),
            checks,
            rows,
        }
    }

    /// Whether every fault is seen and diagnosed, and nothing is seen without one.
    pub fn is_sound(&self) -> bool {
        [&self.unseen, &self.false_alarms, &self.not_diagnosed, &self.broken]
            .iter()
            .all(|names| names.is_empty())
    }

    /// What is not as it should be, in sentences.
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
            scenarios(&self.unseen, "seen by no check"),
            scenarios(
                &self.false_alarms,
                "a check fails or the diagnosis finds something without a fault, or before it",
            ),
            scenarios(&self.not_diagnosed, "the diagnosis is not right"),
            remark(&blind, "checks that see none of these faults"),
        ]
        .into_iter()
        .flatten()
        .collect()
    }

    /// The table for a document.
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
        let mut checks: Vec<SeenBy> = Vec::new();
        for result in &report.checks {
            let seen = seen_by(result, begin_s);
            match checks.iter_mut().find(|known| known.check == seen.check) {
                Some(known) if seen.fails && (!known.fails || seen.after_s < known.after_s) => *known = seen,
                Some(_) => {}
                None => checks.push(seen),
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

    fn is_seen(&self) -> bool {
        self.checks.iter().any(|seen| seen.fails && !seen.before_fault)
    }

    /// Whether something is seen without a fault, or before one.
    fn is_false_alarm(&self) -> bool {
        let without = self.faults.is_empty() && (self.is_seen() || self.diagnosis.is_some());
        without || self.checks.iter().any(|seen| seen.before_fault)
    }

    /// What a check says of it: the time after which it sees the fault, or a dash.
    pub fn cell(&self, kind: CheckKind) -> String {
        match self.checks.iter().find(|seen| seen.check == kind) {
            Some(SeenBy { before_fault: true, .. }) => "before it".to_owned(),
            Some(SeenBy { fails: true, after_s, .. }) => {
                after_s.map_or("fails".to_owned(), |after_s| quantity(after_s, "s"))
            }
            Some(_) => "-".to_owned(),
            None => String::new(),
        }
    }

    /// The injected faults.
    pub fn injected(&self) -> String {
        let sentences: Vec<String> = self.faults.iter().map(RunFault::sentence).collect();
        if sentences.is_empty() { "nothing".to_owned() } else { sentences.join("; ") }
    }

    /// What the diagnosis says.
    pub fn diagnosed(&self) -> String {
        let sentences = self.diagnosis.as_ref().map(RunDiagnosis::sentences).unwrap_or_default();
        if sentences.is_empty() { "nothing".to_owned() } else { sentences.join("; ") }
    }

    /// Whether it is right.
    pub fn judged(&self) -> &'static str {
        match self.judgement {
            Judgement::Right => "yes",
            Judgement::OtherValue => "another value",
            Judgement::Wrong | Judgement::Nothing => "no",
        }
    }
}

/// Times are products of whole numbers of steps, which rounding leaves equal to this, s.
const AT_THE_BEGIN_S: f64 = 1e-9;

fn seen_by(result: &CheckResult, begin_s: f64) -> SeenBy {
    let violations = result.measures.iter().filter_map(|measure| measure.first_violation.as_ref());
    let first_s = violations.map(|moment| moment.time_s).fold(f64::INFINITY, f64::min);
    let after_s = first_s - begin_s;
    let fails = result.status == Status::Fail;
    SeenBy {
        check: result.check,
        fails,
        before_fault: fails && begin_s.is_finite() && after_s < -AT_THE_BEGIN_S,
        after_s: after_s.is_finite().then_some(after_s),
    }
}
