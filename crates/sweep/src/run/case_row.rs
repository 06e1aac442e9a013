//! The row of a case: its values, its verdict, and the worst value of each check.

use std::collections::BTreeMap;

use congruent_input::{Quantity, SiUnit};
use congruent_monitors::verdict::{Bound, CheckResult, Measure, Status, Verdict};
use congruent_results::report::RunReport;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::plan::SweepCase;

/// One case of a sweep. It has nothing of the machine or of the time, so that a case has the same row wherever it ran.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CaseRow {
    /// Number of the case, from 0.
    pub case: u64,
    /// Seed of its run.
    pub seed: u64,
    /// Value of each varied key, as TOML.
    pub values: Vec<String>,
    /// How the run went.
    pub verdict: CaseVerdict,
    /// The checks that failed, by their names.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub failed: Vec<String>,
    /// The worst value of each quantity of each check, by its name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub worst: BTreeMap<String, WorstValue>,
    /// When a check ended the run early, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stopped_s: Option<f64>,
    /// What the samples show to be wrong with the robot, if a check failed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cause: Option<String>,
    /// Why there is no result, or none of the whole run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    /// SHA-256 over the joint positions of every sample.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub trajectory_sha256: Option<String>,
}

/// How the run of a case went.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CaseVerdict {
    /// Every check has the result that the scenario expects.
    Pass,
    /// A check has another result than the scenario expects.
    Fail,
    /// Nothing was checked.
    NothingChecked,
    /// The run broke before its end.
    Broken,
    /// The scenario cannot be run with these values.
    Refused,
}

/// The worst value of one quantity of a check.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WorstValue {
    /// The value, in the unit of the quantity; `null` if it is infinite or not a number.
    pub value: Option<f64>,
    /// Its distance from the limit, in the same unit; negative if it is outside.
    pub margin: Option<f64>,
    /// The limit.
    pub limit: f64,
    /// Whether the value is outside of the limit.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_outside: bool,
}

impl WorstValue {
    /// The margin as a share of the limit. A limit of 0 has no shares: `None` within it, -1 outside.
    pub fn margin_share(&self) -> Option<f64> {
        let limit = self.limit.abs();
        match self.margin {
            Some(margin) if limit > 0.0 => Some(margin / limit),
            _ => self.is_outside.then_some(-1.0),
        }
    }
}

impl CaseVerdict {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Pass, Self::Fail, Self::NothingChecked, Self::Broken, Self::Refused];

    /// The name in reports and tables.
    pub fn word(self) -> &'static str {
        congruent_input::serde_name(&self)
    }
}

impl From<Verdict> for CaseVerdict {
    fn from(verdict: Verdict) -> Self {
        match verdict {
            Verdict::AsExpected => Self::Pass,
            Verdict::NotAsExpected => Self::Fail,
            // A case has no cases of its own.
            Verdict::NothingChecked | Verdict::NotEnoughCases => Self::NothingChecked,
            Verdict::Broken => Self::Broken,
        }
    }
}

impl CaseRow {
    /// The row of a case whose scenario cannot be run.
    pub(crate) fn refused(case: SweepCase, error: String) -> Self {
        let SweepCase { case, seed, values, .. } = case;
        Self {
            case,
            seed,
            values,
            verdict: CaseVerdict::Refused,
            failed: Vec::new(),
            worst: BTreeMap::new(),
            stopped_s: None,
            cause: None,
            error: Some(error),
            trajectory_sha256: None,
        }
    }

    /// The row of a case that ran.
    pub(crate) fn of_run(case: SweepCase, report: &RunReport) -> Self {
        let names = check_names(&report.checks);
        let failed = names.iter().zip(&report.checks).filter(|(_, check)| check.status == Status::Fail);
        let causes = report.diagnosis.as_ref().map(|diagnosis| diagnosis.sentences().join("; "));
        Self {
            verdict: report.verdict.into(),
            failed: failed.map(|(name, _)| name.clone()).collect(),
            worst: worst(&names, &report.checks),
            stopped_s: report.stopped.as_ref().map(|stop| stop.time_s),
            cause: causes.filter(|causes| !causes.is_empty()),
            error: report.error.clone(),
            trajectory_sha256: Some(report.trajectory_sha256.clone()),
            ..Self::refused(case, String::new())
        }
    }

    /// The quantity with the smallest margin as a share of its limit, and that share.
    pub fn least_margin(&self) -> Option<(&str, f64)> {
        let shares =
            self.worst.iter().filter_map(|(name, worst)| Some((name.as_str(), worst.margin_share()?)));
        shares.min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

/// A name for each check: its kind, with a number from the second of a kind on.
pub(crate) fn check_names(checks: &[CheckResult]) -> Vec<String> {
    let name = |(at, check): (usize, &CheckResult)| {
        let before = checks[..at].iter().filter(|other| other.check == check.check).count();
        let kind = check.check.word();
        if before == 0 { kind.to_owned() } else { format!("{kind}_{}", before + 1) }
    };
    checks.iter().enumerate().map(name).collect()
}

/// A name for a quantity of a check, with its unit: `clearance.distance_m`.
pub(crate) fn measure_name(check: &str, quantity: Quantity, unit: SiUnit) -> String {
    let unit = unit.symbol().replace('/', "_").replace(['^', ' '], "");
    let quantity = quantity.name().replace(' ', "_");
    if unit.is_empty() { format!("{check}.{quantity}") } else { format!("{check}.{quantity}_{unit}") }
}

/// The end of the name of a distance that is the smallest one of the pairs whose distance changes.
pub(crate) const OF_CHANGING_PAIRS: &str = ".changing";

fn worst(names: &[String], checks: &[CheckResult]) -> BTreeMap<String, WorstValue> {
    let mut worst: BTreeMap<String, WorstValue> = BTreeMap::new();
    for (name, check) in names.iter().zip(checks) {
        for measure in &check.measures {
            let Some(moment) = &measure.worst else { continue };
            let found = worst_value(measure, moment.value);
            // A check that fails may have a measure for each pair or link: the worst of them is the check's.
            let known = worst.entry(measure_name(name, measure.quantity, measure.unit)).or_insert(found);
            if measure.bound.is_worse(found.value.unwrap_or(f64::NAN), known.value.unwrap_or(f64::NAN)) {
                *known = found;
            }
        }
        if let (Some(measure), Some(changing)) = (check.measures.first(), &check.nearest_that_changes) {
            // Beside a pair that keeps its distance, which says nothing about the case.
            let name = measure_name(name, measure.quantity, measure.unit) + OF_CHANGING_PAIRS;
            worst.insert(name, worst_value(measure, changing.value));
        }
    }
    worst
}

fn worst_value(measure: &Measure, value: f64) -> WorstValue {
    let margin = match measure.bound {
        Bound::AtMost => measure.limit - value,
        Bound::AtLeast | Bound::Above => value - measure.limit,
    };
    let finite = |value: f64| value.is_finite().then_some(value);
    WorstValue {
        value: finite(value),
        margin: finite(margin),
        limit: measure.limit,
        is_outside: !measure.bound.holds(value, measure.limit),
    }
}
