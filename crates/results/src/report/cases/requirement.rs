//! Whether a share of all possible cases passes, from those that ran: with an interval, and "not enough cases" as an answer.

use congruent_scenario::least_cases;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Halvings of the interval in which a bound is searched: to the digits of a double.
const HALVINGS: u32 = 60;
/// Most cases that are suggested.
const MOST_CASES: u64 = 1_000_000_000;

/// A share of all possible cases that must pass, and the confidence with which that must be known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PassingShare {
    /// The share, between 0 and 1; 1 is every case that runs.
    pub passing: f64,
    /// The confidence, between 0 and 1.
    pub confidence: f64,
}

/// The answer to a required share.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RequirementResult {
    /// The share of all possible cases that must pass; 1 if every case of the run must.
    pub passing: f64,
    /// The confidence with which that must be known.
    pub confidence: f64,
    /// Number of cases that passed.
    pub passed: u64,
    /// Number of cases that ended, one way or another: a case that broke or could not be run has not passed.
    pub counted: u64,
    /// Bounds of the share that passes: each holds with the confidence.
    pub interval: [f64; 2],
    /// The answer.
    pub verdict: RequirementVerdict,
    /// Number of cases with which the share that was found would be known well enough; left out if it is, or if none would do.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cases_needed: Option<u64>,
}

/// Whether a requirement is met.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RequirementVerdict {
    /// At least the required share passes, with the confidence.
    Met,
    /// Less than the required share passes, with the confidence.
    NotMet,
    /// The cases that ran leave both possible.
    NotEnoughCases,
}

impl RequirementVerdict {
    /// The word in the place of the status of a check.
    pub fn status_word(self) -> &'static str {
        match self {
            Self::Met => "pass",
            Self::NotMet => "fail",
            Self::NotEnoughCases => "unclear",
        }
    }
}

impl RequirementResult {
    /// The answer from the number of cases that passed, of those that are counted.
    pub fn new(requirement: PassingShare, passed: u64, counted: u64) -> Self {
        let PassingShare { passing, confidence } = requirement;
        let interval = [lower_bound(passed, counted, confidence), upper_bound(passed, counted, confidence)];
        let verdict = match interval {
            // That all possible cases pass is shown by no number of them: it is judged by those that ran.
            _ if passing >= 1.0 && counted == 0 => RequirementVerdict::NotEnoughCases,
            _ if passing >= 1.0 && passed == counted => RequirementVerdict::Met,
            [lower, _] if lower >= passing => RequirementVerdict::Met,
            [_, upper] if upper < passing => RequirementVerdict::NotMet,
            _ => RequirementVerdict::NotEnoughCases,
        };
        // That every case passes is no share that a number of cases would show.
        let is_open = verdict == RequirementVerdict::NotEnoughCases && passing < 1.0;
        let cases_needed = is_open.then(|| needed(requirement, passed, counted)).flatten();
        Self { passing, confidence, passed, counted, interval, verdict, cases_needed }
    }
}

/// How many of the worst of these values may be worse than what a share of all possible values keeps, with a confidence; `None` if the
/// values are too few. The share of values beyond the one at this place is known in the same way as that of passing cases.
pub(super) fn worst_left_out(requirement: PassingShare, counted: u64) -> Option<u64> {
    let PassingShare { passing, confidence } = requirement;
    // With one more left out the share would not be known well enough.
    let is_known = |left_out: u64| at_most(left_out, counted, 1.0 - passing) <= 1.0 - confidence;
    (0..counted).take_while(|&left_out| is_known(left_out)).last()
}

/// The share above which the share of passing cases is, with a confidence.
///
/// Source: Clopper & Pearson, *The use of confidence or fiducial limits illustrated in the case of the binomial*, Biometrika 26 (1934).
fn lower_bound(passed: u64, counted: u64, confidence: f64) -> f64 {
    if passed == 0 {
        return 0.0;
    }
    // The share at which as many passes, or more, would be seen with the remaining probability alone.
    bisected(|share| at_most(counted - passed, counted, 1.0 - share) <= 1.0 - confidence)
}

/// The share below which the share of passing cases is, with a confidence.
fn upper_bound(passed: u64, counted: u64, confidence: f64) -> f64 {
    if passed == counted {
        return 1.0;
    }
    bisected(|share| at_most(passed, counted, share) > 1.0 - confidence)
}

/// The largest share below which a condition holds.
fn bisected(holds: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        if holds(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Probability of at most `most` of `count` events, each with this probability.
#[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 cases")]
fn at_most(most: u64, count: u64, probability: f64) -> f64 {
    if probability <= 0.0 {
        return 1.0;
    }
    if probability >= 1.0 {
        return if most >= count { 1.0 } else { 0.0 };
    }
    let (event, other) = (libm::log(probability), libm::log1p(-probability));
    let choices = |of: u64| {
        libm::lgamma(count as f64 + 1.0)
            - libm::lgamma(of as f64 + 1.0)
            - libm::lgamma((count - of) as f64 + 1.0)
    };
    (0..=most)
        .map(|of| libm::exp(choices(of) + of as f64 * event + (count - of) as f64 * other))
        .sum::<f64>()
        .min(1.0)
}

/// The number of cases with which the share that was found would answer, to about a hundredth.
#[expect(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "fewer than 2^53 cases"
)]
fn needed(requirement: PassingShare, passed: u64, counted: u64) -> Option<u64> {
    let PassingShare { passing, confidence } = requirement;
    if counted == 0 || passed == counted {
        return Some(least_cases(passing, confidence) as u64);
    }
    let failing = (counted - passed) as f64 / counted as f64;
    let answers = |cases: u64| {
        let passed = cases - (failing * cases as f64).round() as u64;
        lower_bound(passed, cases, confidence) >= passing || upper_bound(passed, cases, confidence) < passing
    };
    let doubled = (0..).map(|doublings: u32| counted << doublings);
    let largest = MOST_CASES.min(counted.saturating_mul(4096));
    let mut most = doubled.skip(1).take_while(|cases| *cases < 2 * largest).find(|cases| answers(*cases))?;
    let mut least = most / 2;
    while most - least > most / 100 + 1 {
        let middle = u64::midpoint(least, most);
        if answers(middle) { most = middle } else { least = middle }
    }
    // Whole cases fail, so that somewhat fewer may answer as well.
    let mut fewer = (1..=20).map(|percent| most - most * percent / 100).filter(|cases| *cases > counted);
    fewer.rfind(|cases| answers(*cases)).or(Some(most))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bounds of `scipy.stats.binomtest(k, n, alternative=...).proportion_ci(0.95)` (`SciPy` 1.17.1).
    #[test]
    fn bounds_are_those_of_another_program() {
        for (passed, counted, lower, upper) in [
            (299, 299, 0.990_030_9, 1.0),
            (248, 256, 0.944_322_3, 0.984_357_1),
            (0, 10, 0.0, 0.258_865_6),
            (5, 10, 0.222_441_1, 0.777_558_9),
        ] {
            let found = [lower_bound(passed, counted, 0.95), upper_bound(passed, counted, 0.95)];
            assert!(
                (found[0] - lower).abs() < 1e-7 && (found[1] - upper).abs() < 1e-7,
                "{passed}/{counted}: {found:?}"
            );
        }
    }

    #[test]
    fn without_a_failure_299_cases_show_99_per_cent() {
        let requirement = PassingShare { passing: 0.99, confidence: 0.95 };
        assert_eq!(needed(requirement, 100, 100), Some(299));
        assert!(lower_bound(299, 299, 0.95) >= 0.99 && lower_bound(298, 298, 0.95) < 0.99);
        let more = needed(requirement, 998, 1000);
        assert!(more.is_some_and(|more| more > 1000), "{more:?}");
        // By trying every number of cases in steps of 5 %: 316 and 1332.
        let needed =
            |passed, passing| needed(PassingShare { passing, confidence: 0.95 }, passed, 300).unwrap();
        assert!((300..=320).contains(&needed(291, 0.95)), "{}", needed(291, 0.95));
        assert!((1250..=1360).contains(&needed(288, 0.95)), "{}", needed(288, 0.95));
    }

    #[test]
    fn order_statistics_bound_a_quantile() {
        let requirement = PassingShare { passing: 0.99, confidence: 0.95 };
        // Tables of tolerance limits: 299 values for the worst of them, 473 for the second worst.
        assert_eq!(worst_left_out(requirement, 298), None);
        assert_eq!(worst_left_out(requirement, 299), Some(0));
        assert_eq!(worst_left_out(requirement, 472), Some(0));
        assert_eq!(worst_left_out(requirement, 473), Some(1));
    }

    #[test]
    fn every_case_that_runs() {
        let verdict = |passed, counted| {
            RequirementResult::new(PassingShare { passing: 1.0, confidence: 0.95 }, passed, counted).verdict
        };
        assert_eq!(verdict(30, 30), RequirementVerdict::Met);
        assert_eq!(verdict(29, 30), RequirementVerdict::NotMet);
        assert_eq!(verdict(0, 0), RequirementVerdict::NotEnoughCases);
    }
}
