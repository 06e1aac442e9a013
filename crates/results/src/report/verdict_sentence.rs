//! The verdict of a run in words, for all that show one: `run`, `inspect`, the page and the recording.

use congruent_input::display::listed;
use congruent_monitors::verdict::{Status, Verdict};
use congruent_scenario::{CheckKind, Expectation};

/// The verdict as the headline of a run begins.
pub fn verdict_word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::AsExpected => "pass",
        Verdict::NotAsExpected => "FAIL",
        Verdict::NothingChecked => "NOTHING CHECKED",
        Verdict::NotEnoughCases => "NOT ENOUGH CASES",
        Verdict::Broken => "BROKEN",
    }
}

/// Verdict and reason in one line: `pass: every check passes, as expected`, `pass (expected failure: agreement)`, `FAIL: clearance`.
pub fn verdict_line(verdict: Verdict, sentence: &str) -> String {
    let word = verdict_word(verdict);
    if sentence.starts_with(EXPECTED_FAILURE) {
        format!("{word} ({sentence})")
    } else {
        format!("{word}: {sentence}")
    }
}

/// How the sentence of a run begins that failed as its scenario expects.
const EXPECTED_FAILURE: &str = "expected failure: ";

/// Why a run with these results has its verdict, without a full stop.
pub fn verdict_sentence(
    verdict: Verdict,
    expected: &Expectation,
    results: impl IntoIterator<Item = (CheckKind, Status)>,
) -> String {
    let mut failed: Vec<CheckKind> = Vec::new();
    let mut is_inconclusive = false;
    let mut count = Count::default();
    for (kind, status) in results {
        is_inconclusive |= status == Status::Inconclusive;
        count.passed += usize::from(status == Status::Pass);
        count.not_evaluated += usize::from(!status.is_conclusive());
        if status == Status::Fail && !failed.contains(&kind) {
            failed.push(kind);
        }
    }
    match verdict {
        Verdict::NothingChecked if is_inconclusive => "no check could evaluate enough samples".to_owned(),
        Verdict::NothingChecked if count.passed > 0 => {
            "only the default checks were evaluated, and pass: add a [[check]]".to_owned()
        }
        Verdict::NothingChecked => "no check of the scenario was evaluated: add a [[check]]".to_owned(),
        Verdict::Broken => "the run ended with an error".to_owned(),
        Verdict::AsExpected | Verdict::NotEnoughCases if failed.is_empty() => {
            count.passing("every check passes, as expected")
        }
        Verdict::AsExpected | Verdict::NotEnoughCases => format!("{EXPECTED_FAILURE}{}", words(&failed)),
        Verdict::NotAsExpected if failed.is_empty() => {
            format!("unexpected pass: {}", count.passing("every check passed"))
        }
        // A scenario that expects nothing else expects that every check passes.
        Verdict::NotAsExpected if *expected == Expectation::Pass => words(&failed),
        Verdict::NotAsExpected => against_expectation(expected, failed),
    }
}

/// Numbers of checks of a run of which none failed.
#[derive(Default)]
struct Count {
    passed: usize,
    /// With too few samples, or with nothing to check.
    not_evaluated: usize,
}

impl Count {
    /// `all` if every check passes, or else how many do: a check that was not evaluated says nothing about the run.
    fn passing(&self, all: &str) -> String {
        let Self { passed, not_evaluated } = *self;
        if not_evaluated == 0 {
            return all.to_owned();
        }
        let passes = if passed == 1 { "passes" } else { "pass" };
        format!(
            "{passed} of {} checks {passes}, {not_evaluated} could not be evaluated",
            passed + not_evaluated
        )
    }
}

/// Checks that failed although they should not, and checks that did not fail although they should.
fn against_expectation(expected: &Expectation, mut failed: Vec<CheckKind>) -> String {
    let mut missing = match expected {
        Expectation::Pass => Vec::new(),
        Expectation::Fail { checks } => checks.clone(),
    };
    let expected = missing.clone();
    missing.retain(|kind| !failed.contains(kind));
    failed.retain(|kind| !expected.contains(kind));
    let failed = (!failed.is_empty()).then(|| format!("{}, against expectation", failing(&failed)));
    let missing = (!missing.is_empty()).then(|| format!("expected to fail but did not: {}", words(&missing)));
    failed.into_iter().chain(missing).collect::<Vec<_>>().join("; ")
}

/// The kinds of checks that failed: `clearance and limits fail`.
fn failing(kinds: &[CheckKind]) -> String {
    format!("{} {}", words(kinds), if kinds.len() == 1 { "fails" } else { "fail" })
}

fn words(kinds: &[CheckKind]) -> String {
    listed(&kinds.iter().map(|kind| kind.word()).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checks_that_were_not_evaluated_are_counted() {
        use CheckKind::{Dynamics, Limits, Power, Tracking};
        let sentence = |verdict, statuses: &[(CheckKind, Status)]| {
            verdict_sentence(verdict, &Expectation::Pass, statuses.iter().copied())
        };
        let few = [(Dynamics, Status::Inconclusive), (Power, Status::Skipped), (Limits, Status::Pass)];
        assert_eq!(sentence(Verdict::AsExpected, &few), "1 of 3 checks passes, 2 could not be evaluated");
        assert_eq!(
            sentence(Verdict::NotAsExpected, &few),
            "unexpected pass: 1 of 3 checks passes, 2 could not be evaluated"
        );
        let all = [(Tracking, Status::Pass), (Limits, Status::Pass)];
        assert_eq!(sentence(Verdict::AsExpected, &all), "every check passes, as expected");
    }

    #[test]
    fn the_sentence_names_what_was_not_expected() {
        use CheckKind::{Agreement, Clearance, Limits};
        let check = |expected: &[CheckKind], failed: &[CheckKind], sentence: &str| {
            let expected = Expectation::Fail { checks: expected.to_vec() };
            let results = failed.iter().map(|&kind| (kind, Status::Fail)).chain([(Agreement, Status::Pass)]);
            assert_eq!(verdict_sentence(Verdict::NotAsExpected, &expected, results), sentence);
        };
        check(&[Clearance], &[], "unexpected pass: every check passed");
        check(&[], &[Limits], "limits fails, against expectation");
        check(&[Clearance], &[Clearance, Limits, Limits], "limits fails, against expectation");
        let instead = "limits fails, against expectation; expected to fail but did not: clearance";
        check(&[Clearance], &[Limits], instead);
        let missing = "expected to fail but did not: limits";
        check(&[Clearance, Limits], &[Clearance], missing);
        let both = [Clearance, Limits].map(|kind| (kind, Status::Fail));
        let sentence = |verdict| verdict_sentence(verdict, &Expectation::Pass, both);
        assert_eq!(sentence(Verdict::NotAsExpected), "clearance and limits");
        assert_eq!(sentence(Verdict::AsExpected), "expected failure: clearance and limits");
        let line = |verdict| verdict_line(verdict, &sentence(verdict));
        assert_eq!(line(Verdict::NotAsExpected), "FAIL: clearance and limits");
        assert_eq!(line(Verdict::AsExpected), "pass (expected failure: clearance and limits)");
    }
}
