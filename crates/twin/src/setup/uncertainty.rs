//! `[uncertainty]`: what of it can be checked without drawing a case.

use congruent_input::{Diagnostic, Diagnostics};
use congruent_scenario::{Check, Expectation, FilePlace, Scenario, least_cases};

use crate::codes;

/// Most cases of a scenario. Kind: choice; a sweep keeps rows on disk and can be cut, a run cannot.
const MOST_CASES: u64 = 100_000;

/// Refuses an `[uncertainty]` that no run can answer, and a share of cases without one; the result is a warning of too few cases.
pub(super) fn check_uncertainty(
    scenario: &Scenario,
    place: FilePlace<'_>,
    found: &mut Diagnostics,
) -> Option<Diagnostic> {
    let checks = || scenario.check.iter().enumerate();
    let fault = |message: String| Diagnostic::error(codes::scenario::UNCERTAINTY, message);
    let Some(uncertainty) = &scenario.uncertainty else {
        for (at, _) in checks().filter(|(_, check)| check.passing().is_some()) {
            let error =
                fault("`passing` is a share of cases, and the scenario has no [uncertainty]".to_owned());
            let place = place.key("check").item(at).key("passing");
            found
                .push(place.mark(error.with_help("remove `passing`, or add [uncertainty] with what varies")));
        }
        return None;
    };
    let few = too_few_cases(scenario, place);
    let place = place.key("uncertainty");
    if !(1..=MOST_CASES).contains(&uncertainty.cases) {
        let error = fault(format!("cases = {} is not from 1 to {MOST_CASES}", uncertainty.cases));
        let help = if uncertainty.cases == 0 { "cases = 300" } else { "a sweep has no such limit" };
        found.push(place.key("cases").mark(error.with_help(help)));
    }
    if let Some(case) = uncertainty.case.filter(|case| *case >= uncertainty.cases) {
        let error =
            fault(format!("case = {case}, and the cases are 0 to {}", uncertainty.cases.saturating_sub(1)));
        found.push(place.key("case").mark(error));
    }
    if uncertainty.vary.is_empty() {
        let error = fault("nothing varies: [uncertainty] has no [[uncertainty.vary]]".to_owned());
        let help = "[[uncertainty.vary]]\nkey = \"payload.1.mass_kg\"\nplus_minus = 0.5";
        found.push(place.mark(error.with_help(help)));
    }
    if matches!(scenario.expect, Expectation::Fail { .. }) {
        let error = fault("[uncertainty] cannot be combined with [expect] verdict = \"fail\"".to_owned());
        let help = "a scenario that must fail is one run: remove one of the two";
        found.push(place.mark(error.with_help(help)));
    }
    let why =
        uncertainty.sampling.no_sample().filter(|_| checks().any(|(_, check)| check.passing().is_some()));
    if let Some(why) = why {
        let error = fault(why.to_owned());
        let help = "sampling = \"random\", or no `passing`";
        found.push(place.key("sampling").mark(error.with_help(help)));
    }
    few
}

/// Warns of a number of cases that cannot show what a check asks for, even if none fails.
fn too_few_cases(scenario: &Scenario, place: FilePlace<'_>) -> Option<Diagnostic> {
    let uncertainty = scenario.uncertainty.as_ref()?;
    let most = scenario.check.iter().filter_map(Check::passing).reduce(f64::max)?;
    let least = least_cases(most, uncertainty.confidence);
    #[expect(clippy::cast_precision_loss, reason = "at most a million cases")]
    let has_enough = uncertainty.cases as f64 >= least;
    (!has_enough).then(|| {
        let (share, confidence) = (most * 100.0, uncertainty.confidence * 100.0);
        let message = format!(
            "cases = {} cannot show that {share} % of all cases pass with confidence {confidence} %, even if none fails",
            uncertainty.cases
        );
        let warning = Diagnostic::warning(codes::scenario::FEW_CASES, message);
        place.key("uncertainty").key("cases").mark(warning.with_help(format!("at least {least} are needed, if none fails")))
    })
}
