//! The cases of a run in words, for all that show them: the terminal, the page and JUnit.

use congruent_input::{
    Quantity,
    display::{number, quantity},
};
use congruent_monitors::verdict::{Bound, Measure};

use super::{
    requirement::{RequirementResult, RequirementVerdict},
    uncertainty_report::{CheckInCases, QuantityInCases, UncertaintyReport, VariedValue},
};
use crate::report::{limit_words, quantity_words, value_and_margin};

/// Whether enough cases pass: `requirement MET: at least 94.4 % of all cases pass, with confidence 95 %; 90 % are required`.
pub fn requirement_sentence(requirement: &RequirementResult) -> String {
    let RequirementResult { passing, confidence, interval: [lower, upper], .. } = requirement;
    let (wanted, known) = (percent(*passing), percent(*confidence));
    match requirement.verdict {
        RequirementVerdict::Met => format!(
            "requirement MET: at least {} of all cases pass, with confidence {known}; {wanted} are required",
            percent(*lower)
        ),
        RequirementVerdict::NotMet => format!(
            "requirement NOT MET: at most {} of all cases pass, with confidence {known}; {wanted} are required",
            percent(*upper)
        ),
        RequirementVerdict::NotEnoughCases => format!(
            "NOT ENOUGH CASES: between {} and {} of all cases pass, each bound with confidence {known}; {wanted} are required{}",
            percent(*lower),
            percent(*upper),
            cases_needed(requirement)
        ),
    }
}

/// A share in per cent: `94.4 %`.
fn percent(share: f64) -> String {
    format!("{} %", number(100.0 * share))
}

fn cases_needed(requirement: &RequirementResult) -> String {
    requirement.cases_needed.map_or_else(String::new, |cases| format!("; some {cases} cases would answer"))
}

/// What ran: `in 300 cases, of payload.gripper.mass_kg +- 0.5; joints.friction +- 20 %`.
pub fn cases_title(cases: &UncertaintyReport) -> String {
    let of = |value: &VariedValue| format!("{} {}", value.keys.join(", "), value.distribution);
    let varied: Vec<String> = cases.varied.iter().map(of).collect();
    format!("in {} cases, of {}", cases.ran, varied.join("; "))
}

/// The first cases without a result, and how many there are.
pub fn unfinished_words(cases: &UncertaintyReport) -> Vec<String> {
    let listed = cases.unfinished.iter().map(|of| format!("case {} has no result: {}", of.case, of.error));
    let further = cases.without_result.saturating_sub(cases.unfinished.len() as u64);
    listed.chain((further > 0).then(|| format!("{further} further cases have no result"))).collect()
}

/// The lines of a check in all cases: in how many it holds, then its quantities.
pub fn case_lines(check: &CheckInCases) -> Vec<String> {
    let quantities = check.quantities.iter().map(|quantity| in_cases(quantity, check.requirement.passing));
    std::iter::once(holds_in(check)).chain(quantities).collect()
}

/// `holds in 297 of 300 cases: at least 97.4 % of all, with confidence 95 %; 99 % are required`.
fn holds_in(check: &CheckInCases) -> String {
    let RequirementResult { passing, confidence, passed, counted, interval: [lower, upper], .. } =
        check.requirement;
    let known = percent(confidence);
    let share = match check.requirement.verdict {
        RequirementVerdict::Met => format!("at least {} of all, with confidence {known}", percent(lower)),
        RequirementVerdict::NotMet => format!("at most {} of all, with confidence {known}", percent(upper)),
        RequirementVerdict::NotEnoughCases => {
            let (lower, upper) = (percent(lower), percent(upper));
            format!("between {lower} and {upper} of all, each bound with confidence {known}")
        }
    };
    let required = if passing < 1.0 {
        format!("; {} are required{}", percent(passing), cases_needed(&check.requirement))
    } else {
        "; each that runs must".to_owned()
    };
    let first = check.first_failing.map_or_else(String::new, |case| format!("; first not in case {case}"));
    format!("holds in {passed} of {counted} cases: {share}{required}{first}")
}

/// `distance: 21.2 mm in 99 % of all cases, worst 20.6 mm (case 117), median 25 mm, limit >= 20 mm`.
fn in_cases(of: &QuantityInCases, passing: f64) -> String {
    let measure = Measure {
        quantity: of.quantity,
        unit: of.unit,
        limit: of.limit,
        bound: of.bound,
        worst: None,
        first_violation: None,
    };
    let shown = |value: Option<f64>| match value {
        None => "not finite".to_owned(),
        Some(value) if of.quantity == Quantity::Distance && value < 0.0 => {
            format!("overlap {}", quantity(-value, of.unit.symbol()))
        }
        Some(value) => value_and_margin(of.quantity, of.unit, of.bound, [value, of.limit])
            .unwrap_or_else(|| quantity(value, of.unit.symbol())),
    };
    let is_margin = value_and_margin(of.quantity, of.unit, of.bound, [0.0; 2]).is_some();
    let side = match of.bound {
        Bound::AtMost if !is_margin => "at most",
        _ => "at least",
    };
    let kept = of
        .quantile
        .map(|value| format!("{side} {} in {} of all cases, ", shown(Some(value)), percent(passing)));
    let limit = if is_margin { String::new() } else { format!(", {}", limit_words(&measure)) };
    let what = if is_margin { "joint limit".to_owned() } else { quantity_words(of.quantity) };
    let pairs = if of.of_changing_pairs { " of pairs that move" } else { "" };
    format!(
        "{what}{pairs}: {}worst {} (case {}), median {}{limit}",
        kept.unwrap_or_default(),
        shown(of.worst),
        of.worst_case,
        shown(of.median)
    )
}

/// The reason for the verdict of a run that passes by itself: `own` is its sentence.
pub(crate) fn uncertainty_sentence(own: &str, cases: &UncertaintyReport) -> String {
    let UncertaintyReport { cases: asked, ran, .. } = cases;
    if !cases.is_whole() {
        return format!("interrupted after {ran} of {asked} cases");
    }
    let with = |verdict: RequirementVerdict| {
        let checks = cases.checks.iter().filter(move |check| check.requirement.verdict == verdict);
        let named = checks.map(|check| {
            let RequirementResult { passed, counted, passing, .. } = check.requirement;
            let required =
                if passing < 1.0 { format!(", {} required", percent(passing)) } else { String::new() };
            format!("{} holds in {passed} of {counted} cases{required}", check.check)
        });
        named.collect::<Vec<_>>().join("; ")
    };
    match cases.verdict {
        RequirementVerdict::Met => format!("{own}, and in {asked} cases"),
        verdict => with(verdict),
    }
}
