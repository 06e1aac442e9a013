//! A recording as a test suite: its checks as in the JUnit file of the run, and its verdict.

use congruent::{
    recording::{Recheck, RecordingSummary},
    results::report::{Reason, TestCase, TestResult, TestSuite, judged},
    text::rechecked_text,
};

use crate::failure::{BAD_INPUT, FAILED};

/// A case for each check, as it is by the recording if that was evaluated again, and one for the whole. The checks of
/// a damaged file are left out: nothing says that they are those of the run.
pub(super) fn suite(summary: &RecordingSummary, input: &str) -> TestSuite {
    let reason = Reason { kind: "recording".to_owned(), message: summary.reason.clone() };
    let verdict = match summary.exit_code {
        0 => TestResult::Passed,
        FAILED => TestResult::Failed(reason),
        _ => TestResult::Error(reason),
    };
    let mut suite = TestSuite::with_case(input, "verdict", verdict);
    let run = summary.run.as_ref().filter(|_| summary.exit_code != BAD_INPUT);
    let mut cases = run.map(|run| run.test_suite().cases).unwrap_or_default();
    if let Some(recheck) = &summary.recheck {
        evaluate_again(&mut cases, recheck);
    }
    suite.cases.splice(..0, cases);
    suite
}

/// The cases with the results on the recording; both are in the order of the scenario.
fn evaluate_again(cases: &mut [TestCase], recheck: &Recheck) {
    for (case, check) in cases.iter_mut().zip(&recheck.checks) {
        rechecked_text(check).trim().clone_into(&mut case.output);
        case.result =
            judged(check.check, check.status, &recheck.expected, recheck.verdict, case.output.clone());
    }
}
