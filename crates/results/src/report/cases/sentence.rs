//! The cases of a run in words, for all that show them: the terminal, the page and JUnit.

use std::fmt;

use congruent_input::{
    Quantity, SiUnit,
    display::{compared_quantities, quantity, quantity_with_digits},
};
use congruent_monitors::verdict::{Bound, Measure, Verdict};
use congruent_scenario::CaseSampling;

use super::{
    key_importance::KeyImportance,
    requirement::{RequirementResult, RequirementVerdict},
    uncertainty_report::{CheckInCases, QuantityInCases, UncertaintyReport},
};
use crate::report::{limit_words, quantity_words, value_and_margin};

/// Whether enough cases pass: `requirement MET: at least 94.43 % of all cases pass (confidence 95 %), required 90 %`.
pub fn requirement_sentence(requirement: &RequirementResult) -> String {
    let RequirementResult { passing, confidence, interval: [lower, upper], .. } = requirement;
    let (wanted, known) = (percent(*passing), percent(*confidence));
    let (lower, upper) = (percent_of_bound(*lower, f64::floor), percent_of_bound(*upper, f64::ceil));
    match requirement.verdict {
        RequirementVerdict::Met => {
            format!(
                "requirement MET: at least {lower} of all cases pass (confidence {known}), required {wanted}"
            )
        }
        RequirementVerdict::NotMet => {
            format!(
                "requirement NOT MET: at most {upper} of all cases pass (confidence {known}), required {wanted}"
            )
        }
        RequirementVerdict::NotEnoughCases => format!(
            "NOT ENOUGH CASES: {lower} to {upper} of all cases pass (confidence {known} of each bound), required {wanted}{}",
            cases_needed(requirement)
        ),
    }
}

/// A share in per cent as it was written: `99.95 %`.
fn percent(share: f64) -> String {
    /// More digits are rounding of the factor of 100.
    const DIGITS: usize = 15;
    quantity_with_digits(100.0 * share, "%", DIGITS)
}

/// A bound in per cent with two decimals, rounded away from what is known: 98.9997 % is no 99 %.
fn percent_of_bound(share: f64, round: fn(f64) -> f64) -> String {
    format!("{} %", round(1e4 * share) / 100.0)
}

fn cases_needed(requirement: &RequirementResult) -> String {
    let RequirementResult { passed, counted, .. } = requirement;
    match requirement.cases_needed {
        None => String::new(),
        Some(cases) if passed == counted => format!("; {cases} cases are needed, if none fails"),
        Some(cases) => format!("; about {cases} cases are needed, if as large a share passes"),
    }
}

/// What ran: `in 300 cases (random, seed 0)`.
pub fn cases_title(cases: &UncertaintyReport) -> String {
    let UncertaintyReport { ran, seed, .. } = cases;
    match cases.sampling {
        CaseSampling::Random => format!("in {ran} cases (random, seed {seed})"),
        CaseSampling::Grid => format!("in {ran} cases (every combination of a grid)"),
        CaseSampling::LatinHypercube | CaseSampling::Sobol => {
            let name = if cases.sampling == CaseSampling::Sobol { "Sobol points" } else { "Latin hypercube" };
            format!("in {ran} cases ({name}, seed {seed}; confidence as of random cases)")
        }
    }
}

/// The first cases without a result, and how many there are.
pub fn unfinished_words(cases: &UncertaintyReport) -> Vec<String> {
    /// The report has more of them.
    const LISTED: usize = 3;
    let listed = cases.unfinished.iter().take(LISTED);
    let further = cases.without_result.saturating_sub(listed.len() as u64);
    let listed = listed.map(|of| format!("case {} has no result: {}", of.case, of.error));
    listed.chain((further > 0).then(|| format!("{further} further cases have no result"))).collect()
}

/// The lines of a check in all cases: in how many it passes, then its quantities.
pub fn case_lines(cases: &UncertaintyReport, check: &CheckInCases) -> Vec<String> {
    // What passes in every case, as it must, needs no cause.
    let is_in_question =
        check.requirement.passing < 1.0 || check.requirement.verdict != RequirementVerdict::Met;
    let words = |of: &QuantityInCases| {
        let words = QuantityWords::new(of, check.requirement.passing).to_string();
        std::iter::once(words).chain(decided_by(of).filter(|_| is_in_question))
    };
    let mut first = passes_in(cases, check);
    if check.is_default {
        first += " (default)";
    }
    std::iter::once(first).chain(check.quantities.iter().flat_map(words)).collect()
}

/// Which varied values decide a quantity: `variance: 62 % (55 to 69 %) from joints.friction (more makes it larger)`. `None` if none alone
/// does.
pub fn decided_by(of: &QuantityInCases) -> Option<String> {
    /// The report has more of them.
    const LISTED: usize = 3;
    // Of a margin the report has the opposite, the distance beyond the limit.
    let sign = if margin_words(of, 0.0).is_some() { -1.0 } else { 1.0 };
    let words = |key: &KeyImportance| {
        let shown = KeyImportance { rank_correlation: sign * key.rank_correlation, ..key.clone() };
        let direction = shown.direction().map_or_else(String::new, |direction| format!(" ({direction})"));
        let [from, to] = key.interval.map(|share| 100.0 * share.clamp(0.0, 1.0));
        format!("{} ({from:.0} to {to:.0} %) from {}{direction}", key.percent(), key.key)
    };
    let listed: Vec<String> = of.deciding.iter().take(LISTED).map(words).collect();
    (!listed.is_empty()).then(|| format!("variance: {}", listed.join(", ")))
}

/// A value of a quantity that is shown by its margin alone; `None` for others. A required margin is that of the check; it is written
/// once, as its limit.
fn margin_words(of: &QuantityInCases, value: f64) -> Option<String> {
    value_and_margin(of.quantity, of.unit, of.bound, [value, of.limit.max(0.0)])
}

/// `passes in 297 of 300 cases: at least 97.43 % of all possible cases would (confidence 95 %; required 95 %)`.
pub fn passes_in(cases: &UncertaintyReport, check: &CheckInCases) -> String {
    let RequirementResult { passing, confidence, passed, counted, interval: [lower, upper], verdict, .. } =
        check.requirement;
    let lost = match cases.without_result {
        0 => String::new(),
        lost if check.is_default => format!(" with a result ({lost} have none)"),
        lost => format!(" ({lost} without a result)"),
    };
    let first = check.first_failing.map_or_else(String::new, |case| format!(", not in case {case}"));
    let (lower, upper) = (percent_of_bound(lower, f64::floor), percent_of_bound(upper, f64::ceil));
    let known = format!("confidence {}", percent(confidence));
    let of_all = if check.is_default && cases.without_result > 0 {
        "of all possible cases with a result would"
    } else {
        "of all possible cases would"
    };
    let required = if passing < 1.0 { percent(passing) } else { "every case of the run".to_owned() };
    let share = match verdict {
        // The cases of a grid are no sample.
        _ if cases.sampling == CaseSampling::Grid => format!("; required: {required}"),
        RequirementVerdict::NotEnoughCases if passing < 1.0 => {
            format!(": {lower} to {upper} {of_all} ({known} of each bound; required: {required})")
        }
        RequirementVerdict::NotMet => {
            format!(": at most {upper} {of_all} ({known}; required: {required})")
        }
        _ => format!(": at least {lower} {of_all} ({known}; required: {required})"),
    };
    format!("passes in {passed} of {counted} cases{lost}{first}{share}{}", cases_needed(&check.requirement))
}

/// A quantity of a check in all cases, in words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct QuantityWords {
    /// Which quantity: `distance`.
    pub what: String,
    /// What the required share of all possible cases keeps: `at least 23.2 mm in 99 %`; `None` if that is not known, or not required.
    pub kept: Option<String>,
    /// The worst value and its case: `23.2 mm (case 229)`.
    pub worst: String,
    /// The median; `None` if all cases have the worst value.
    pub median: Option<String>,
    /// The limit, with its direction; `None` for a margin that only must be positive.
    pub limit: Option<String>,
}

impl QuantityWords {
    /// The words of a quantity of a check of which this share of cases must pass.
    pub fn new(of: &QuantityInCases, passing: f64) -> Self {
        let measure = Measure {
            quantity: of.quantity,
            unit: of.unit,
            limit: of.limit,
            bound: of.bound,
            worst: None,
            first_violation: None,
        };
        let required =
            (of.limit < 0.0).then(|| format!("required margin >= {}", quantity(-of.limit, of.unit.symbol())));
        let shown = |value: Option<f64>| match value {
            None if of.unit == SiUnit::Second => "not reached".to_owned(),
            None => "not finite".to_owned(),
            Some(value) if of.quantity == Quantity::Distance && value < 0.0 => {
                format!("overlap {}", quantity(-value, of.unit.symbol()))
            }
            Some(value) => margin_words(of, value).unwrap_or_else(|| {
                let [value, _] = compared_quantities([value, of.limit], of.unit.symbol());
                value
            }),
        };
        let is_margin = margin_words(of, 0.0).is_some();
        let what = if is_margin { "joint limit".to_owned() } else { quantity_words(of.quantity) };
        let pairs = if of.of_changing_pairs { " of pairs that move" } else { "" };
        let side = if of.bound == Bound::AtMost && !is_margin { "at most" } else { "at least" };
        let kept = |value| format!("{side} {} in {}", shown(Some(value)), percent(passing));
        let varies = of.worst != of.median;
        let worst = shown(of.worst);
        Self {
            what: format!("{what}{pairs}"),
            kept: of.quantile_bound.filter(|_| varies).map(kept),
            worst: if varies { format!("{worst} (case {})", of.worst_case) } else { worst },
            median: varies.then(|| shown(of.median)),
            limit: if is_margin { required } else { Some(limit_words(&measure)) },
        }
    }
}

impl fmt::Display for QuantityWords {
    /// `distance: at least 23.2 mm in 99 % of all cases, worst 23.2 mm (case 229), median 35.6 mm, limit >= 20 mm`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { what, kept, worst, median, limit } = self;
        write!(f, "{what}: ")?;
        if let Some(kept) = kept {
            write!(f, "{kept} of all cases, ")?;
        }
        match median {
            Some(median) => write!(f, "worst {worst}, median {median}")?,
            None => write!(f, "{worst} in every case")?,
        }
        limit.as_ref().map_or(Ok(()), |limit| write!(f, ", {limit}"))
    }
}

/// The reason for the verdict of a run with cases, whose run with nominal values had this verdict and sentence.
pub(crate) fn uncertainty_sentence(own: Verdict, sentence: &str, cases: &UncertaintyReport) -> String {
    let UncertaintyReport { cases: asked, ran, without_result, checks, .. } = cases;
    let lost = match without_result {
        0 => String::new(),
        lost => format!("{lost} of {asked} cases have no result; "),
    };
    let named = || match cases.verdict {
        RequirementVerdict::Met => format!("in {asked} cases each check passes as often as it must"),
        verdict => format!("{lost}{}", with_verdict(cases, verdict)),
    };
    match own {
        Verdict::AsExpected if !cases.is_whole() => format!("interrupted after {ran} of {asked} cases"),
        Verdict::AsExpected if cases.verdict != RequirementVerdict::Met => named(),
        Verdict::AsExpected => {
            let is_in_all = checks.iter().all(|check| check.requirement.passed == check.requirement.counted);
            if is_in_all {
                format!("{sentence}, and in all {asked} cases")
            } else {
                format!("{sentence}, and in as many of {asked} cases as required")
            }
        }
        Verdict::NotAsExpected if cases.is_whole() => {
            format!("with nominal values: {sentence}; in the cases: {}", named())
        }
        _ => sentence.to_owned(),
    }
}

/// The checks with a verdict: `clearance passes in 271 of 300 cases, required 99 %`.
fn with_verdict(cases: &UncertaintyReport, verdict: RequirementVerdict) -> String {
    let checks = cases.checks.iter().filter(|check| check.requirement.verdict == verdict);
    let named = checks.map(|check| {
        let RequirementResult { passed, counted, passing, .. } = check.requirement;
        let required = if passing < 1.0 { format!(", required {}", percent(passing)) } else { String::new() };
        let needed = cases_needed(&check.requirement);
        format!("{} passes in {passed} of {counted} cases{required}{needed}", check.check)
    });
    named.collect::<Vec<_>>().join("; ")
}
