//! What all cases of `[uncertainty]` show of each check.

use congruent_input::{Quantity, SiUnit};
use congruent_monitors::verdict::{Bound, CheckResult, Status};
use congruent_scenario::{CaseSampling, CheckKind, Scenario};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    case_checks::{CaseChecks, CheckOfCase, ValueOfCase},
    key_importance::KeyImportance,
    requirement::{PassingShare, RequirementResult, RequirementVerdict, worst_left_out},
};

/// Most cases without a result that are listed.
const MOST_UNFINISHED: usize = 10;
/// Values that differ by less are one, relative. Kind: rounding.
const ROUNDING: f64 = 1e-9;

/// The cases of a scenario.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct UncertaintyReport {
    /// Number of cases that the scenario asks for.
    pub cases: u64,
    /// Number of cases that ran, those without a result among them; fewer if the run was interrupted.
    pub ran: u64,
    /// How the values of the cases were chosen.
    pub sampling: CaseSampling,
    /// Seed of the cases, that of the scenario.
    pub seed: u64,
    /// What varies.
    pub varied: Vec<VariedValue>,
    /// The answer of all checks together.
    pub verdict: RequirementVerdict,
    /// Each check that was evaluated, in the order of the scenario; default checks last.
    pub checks: Vec<CheckInCases>,
    /// Number of cases without a result: their runs broke, or could not begin. They count as cases in which no check passes.
    pub without_result: u64,
    /// The first of these, with the reason.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub unfinished: Vec<UnfinishedCase>,
}

/// A value that varies.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct VariedValue {
    /// The keys that get it, as of --set.
    pub keys: Vec<String>,
    /// Its distribution, in words, with the value of the file where it is relative to that: `2 +- 0.5`.
    pub distribution: String,
}

impl VariedValue {
    /// `payload.gripper.mass_kg 2 +- 0.5`.
    pub fn words(&self) -> String {
        format!("{} {}", self.keys.join(", "), self.distribution)
    }
}

/// A case without a result.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct UnfinishedCase {
    /// Number of the case, from 0.
    pub case: u64,
    /// Why there is no result.
    pub error: String,
}

/// One check in all cases.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CheckInCases {
    /// The kind of check.
    pub check: CheckKind,
    /// Line of the check in the scenario file, from 1.
    pub line: Option<usize>,
    /// Number of the check in the scenario, from 1.
    pub number: usize,
    /// Whether it is checked without being in the scenario.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_default: bool,
    /// Whether it passes in as many cases as it must.
    pub requirement: RequirementResult,
    /// The first case in which it does not pass; left out if it always does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub first_failing: Option<u64>,
    /// Its quantities.
    pub quantities: Vec<QuantityInCases>,
}

/// One quantity of a check in all cases.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct QuantityInCases {
    /// Name of the quantity.
    #[schemars(with = "String")]
    pub quantity: Quantity,
    /// Unit of limit and values; empty for a ratio.
    #[schemars(with = "String")]
    pub unit: SiUnit,
    /// The limit, in that unit.
    pub limit: f64,
    /// Whether values must be at most the limit (`at_most`), at least the limit (`at_least`), or above it (`above`).
    pub bound: Bound,
    /// Whether it is the smallest distance of the pairs whose distance changes in the run.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub of_changing_pairs: bool,
    /// The worst value of the cases with a result; `null` if it is infinite.
    pub worst: Option<f64>,
    /// The case that has it.
    pub worst_case: u64,
    /// The median of these values, of the cases with a result; `null` if it is infinite.
    pub median: Option<f64>,
    /// The value that the required share of all possible cases keeps, with the confidence; `null` if the cases are too few, or if every case
    /// must pass.
    pub quantile_bound: Option<f64>,
    /// How the values are distributed; left out if they are all the same, or one is infinite.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub histogram: Option<CaseHistogram>,
    /// The varied keys of which one alone decides a part of the variance, the one that decides most first; none for fewer than 40 cases.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub deciding: Vec<KeyImportance>,
}

/// Number of cases in equal parts of the range of their values.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CaseHistogram {
    /// The least and the largest value.
    pub range: [f64; 2],
    /// Number of cases in each part, from the least value on.
    pub counts: Vec<u64>,
}

impl UncertaintyReport {
    /// What cases show of a scenario, whose own run had these checks.
    ///
    /// # Panics
    /// If the scenario has no `[uncertainty]`.
    pub fn new(
        scenario: &Scenario,
        varied: Vec<VariedValue>,
        own: &[CheckResult],
        mut cases: Vec<CaseChecks>,
    ) -> Self {
        let settings = scenario.uncertainty.as_ref().expect("a scenario with cases has [uncertainty]");
        cases.sort_by_key(|case| case.case);
        let ran = cases.len() as u64;
        let of_check = |(at, check): (usize, &CheckResult)| {
            let passing = scenario.check.get(at).and_then(congruent_scenario::Check::passing).unwrap_or(1.0);
            let share = PassingShare { passing, confidence: settings.confidence };
            check_in_cases(check, at, share, &cases)
        };
        let mut checks: Vec<CheckInCases> = own.iter().enumerate().filter_map(of_check).collect();
        if ran < settings.cases {
            // What did not run may fail.
            for check in checks.iter_mut().filter(|check| check.requirement.passing >= 1.0) {
                if check.requirement.verdict == RequirementVerdict::Met {
                    check.requirement.verdict = RequirementVerdict::NotEnoughCases;
                }
            }
        }
        let errors = || cases.iter().filter_map(|case| Some((case.case, case.checks.as_ref().err()?)));
        let unfinished = errors().map(|(case, error)| UnfinishedCase { case, error: error.clone() });
        Self {
            cases: settings.cases,
            ran,
            sampling: settings.sampling,
            seed: scenario.seed,
            varied,
            verdict: together(&checks),
            checks,
            without_result: errors().count() as u64,
            unfinished: unfinished.take(MOST_UNFINISHED).collect(),
        }
    }

    /// The checks, those first that do not hold in as many cases as they must.
    pub fn checks_failed_first(&self) -> Vec<&CheckInCases> {
        let mut checks: Vec<&CheckInCases> = self.checks.iter().collect();
        checks.sort_by_key(|check| check.requirement.verdict == RequirementVerdict::Met);
        checks
    }

    /// Whether every case has run.
    pub fn is_whole(&self) -> bool {
        self.ran == self.cases
    }
}

/// The answer of all checks: the worst of theirs. Without a check there is none.
fn together(checks: &[CheckInCases]) -> RequirementVerdict {
    let has = |verdict| checks.iter().any(|check| check.requirement.verdict == verdict);
    if has(RequirementVerdict::NotMet) {
        RequirementVerdict::NotMet
    } else if has(RequirementVerdict::NotEnoughCases) || checks.is_empty() {
        RequirementVerdict::NotEnoughCases
    } else {
        RequirementVerdict::Met
    }
}

/// What a case has of a check.
#[derive(Debug, Clone, Copy)]
enum FoundInCase<'a> {
    /// Its outcome.
    Checked(&'a CheckOfCase),
    /// Nothing to check in this case.
    NothingToCheck,
    /// The case has no result.
    Lost,
}

impl<'a> FoundInCase<'a> {
    fn new(case: &'a CaseChecks, own: &CheckResult, at: usize) -> Self {
        let Ok(checks) = &case.checks else { return Self::Lost };
        // Which default checks there are follows from the values of the case.
        let found = if own.is_default {
            checks.iter().find(|check| check.is_default && check.kind == own.check)
        } else {
            checks.get(at)
        };
        match found {
            Some(check) if check.status != Status::Skipped => Self::Checked(check),
            _ => Self::NothingToCheck,
        }
    }

    fn passes(self) -> bool {
        match self {
            Self::Checked(check) => check.status == Status::Pass,
            Self::NothingToCheck => true,
            Self::Lost => false,
        }
    }
}

/// A check in all cases; `None` if there is nothing to check in any of them. A case without a result has not passed, except by a default
/// check: nobody has asked for that, and it says nothing of a run that did not begin.
fn check_in_cases(
    own: &CheckResult,
    at: usize,
    share: PassingShare,
    cases: &[CaseChecks],
) -> Option<CheckInCases> {
    let found: Vec<(u64, FoundInCase<'_>)> = cases
        .iter()
        .map(|case| (case.case, FoundInCase::new(case, own, at)))
        .filter(|(_, found)| !(own.is_default && matches!(found, FoundInCase::Lost)))
        .collect();
    let is_checked = found.iter().any(|(_, found)| matches!(found, FoundInCase::Checked(_)));
    if !is_checked && own.status == Status::Skipped {
        return None;
    }
    let passed = found.iter().filter(|(_, found)| found.passes()).count() as u64;
    Some(CheckInCases {
        check: own.check,
        line: own.line,
        number: at + 1,
        is_default: own.is_default,
        requirement: RequirementResult::new(share, passed, found.len() as u64),
        first_failing: found.iter().find(|(_, found)| !found.passes()).map(|(case, _)| *case),
        quantities: quantities(&found, share),
    })
}

fn quantities(found: &[(u64, FoundInCase<'_>)], share: PassingShare) -> Vec<QuantityInCases> {
    let checked = |found: &FoundInCase<'_>| match *found {
        FoundInCase::Checked(check) => check.values.clone(),
        _ => Vec::new(),
    };
    let mut kinds: Vec<ValueOfCase> = Vec::new();
    for value in found.iter().flat_map(|(_, found)| checked(found)) {
        if !kinds.iter().any(|kind| is_same(kind, &value)) {
            kinds.push(value);
        }
    }
    let quantity = |kind: &ValueOfCase| {
        // A case without a result is worse than any with one.
        let of_case = |&(case, found): &(u64, FoundInCase<'_>)| match found {
            FoundInCase::Checked(check) => {
                check.values.iter().find(|value| is_same(kind, value)).map(|value| (case, value.value))
            }
            FoundInCase::NothingToCheck => None,
            FoundInCase::Lost => Some((case, f64::NAN)),
        };
        let mut sorted: Vec<(u64, f64)> = found.iter().filter_map(of_case).collect();
        sorted.sort_by(|a, b| worse_first(kind.bound, a.1, b.1).then(a.0.cmp(&b.0)));
        in_cases(kind, &sorted, share)
    };
    let all: Vec<QuantityInCases> = kinds.iter().filter_map(quantity).collect();
    // What is the same in all cases says nothing about them, as the distance of a pair that nothing moves; unless it is why they fail.
    let says_something = |quantity: &&QuantityInCases| varies(quantity) || !is_kept(quantity);
    let telling: Vec<QuantityInCases> = all.iter().filter(says_something).cloned().collect();
    if telling.is_empty() { all.into_iter().take(1).collect() } else { telling }
}

/// Whether every case keeps the limit.
fn is_kept(quantity: &QuantityInCases) -> bool {
    quantity.worst.is_some_and(|worst| quantity.bound.holds(worst, quantity.limit))
}

fn is_same(a: &ValueOfCase, b: &ValueOfCase) -> bool {
    a.quantity == b.quantity && a.is_of_changing_pairs == b.is_of_changing_pairs
}

fn worse_first(bound: Bound, a: f64, b: f64) -> std::cmp::Ordering {
    match (bound.is_worse(a, b), bound.is_worse(b, a)) {
        (true, _) => std::cmp::Ordering::Less,
        (_, true) => std::cmp::Ordering::Greater,
        _ => std::cmp::Ordering::Equal,
    }
}

/// A quantity from its value in each case, the worst first; cases without a result before all of them, as NaN.
fn in_cases(kind: &ValueOfCase, worst_first: &[(u64, f64)], share: PassingShare) -> Option<QuantityInCases> {
    let lost = worst_first.iter().take_while(|(_, value)| value.is_nan()).count();
    let known = &worst_first[lost..];
    let &(worst_case, worst) = known.first().or(worst_first.first())?;
    let finite = |value: f64| value.is_finite().then_some(value);
    let left_out = worst_left_out(share, worst_first.len() as u64).filter(|_| share.passing < 1.0);
    let quantile = left_out.and_then(|left_out| worst_first.get(usize::try_from(left_out).ok()?));
    Some(QuantityInCases {
        quantity: kind.quantity,
        unit: kind.unit,
        limit: kind.limit,
        bound: kind.bound,
        of_changing_pairs: kind.is_of_changing_pairs,
        worst: finite(worst),
        worst_case,
        median: median(known).and_then(finite),
        quantile_bound: quantile.and_then(|of| finite(of.1)),
        histogram: CaseHistogram::new(known.iter().map(|of| of.1)),
        deciding: Vec::new(),
    })
}

impl CaseHistogram {
    /// Number of parts. Kind: choice; as many as are seen in a small picture.
    const PARTS: usize = 24;

    fn new(values: impl Iterator<Item = f64> + Clone) -> Option<Self> {
        let ends = |[least, most]: [f64; 2], value: f64| [least.min(value), most.max(value)];
        let range = values.clone().fold([f64::INFINITY, f64::NEG_INFINITY], ends);
        let width = range[1] - range[0];
        if !width.is_finite() || width <= ROUNDING * range[0].abs().max(range[1].abs()) {
            return None;
        }
        let mut counts = vec![0; Self::PARTS];
        for value in values {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                clippy::cast_precision_loss,
                reason = "from 0 to the number of parts"
            )]
            let part = ((value - range[0]) / width * Self::PARTS as f64) as usize;
            counts[part.min(Self::PARTS - 1)] += 1;
        }
        Some(Self { range, counts })
    }
}

/// The median of sorted values: of an even number the mean of the two in the middle.
fn median(sorted: &[(u64, f64)]) -> Option<f64> {
    let above = sorted.get(sorted.len() / 2)?.1;
    let below = sorted[(sorted.len() - 1) / 2].1;
    Some(f64::midpoint(below, above))
}

fn varies(quantity: &QuantityInCases) -> bool {
    match (quantity.worst, quantity.median) {
        (Some(worst), Some(median)) => {
            (worst - median).abs() > ROUNDING * worst.abs().max(median.abs())
                || quantity.quantile_bound.is_some()
        }
        _ => true,
    }
}
