//! Results of checks and the verdict: one type for every check, so that all reports and exit codes agree.

use congruent_description::{JointValues, serde_name};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    scenario::{CheckKind, Expectation},
    words::{Word, known_word},
};

/// The outcome of one check.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// Every value was within its limit.
    Pass,
    /// A value was outside its limit.
    Fail,
    /// The run failed before the check could finish.
    Error,
    /// There was nothing to check.
    Skipped,
}

impl Status {
    /// The word that reports use.
    pub fn word(self) -> &'static str {
        serde_name(&self)
    }
}

/// One value of a run, with its time and configuration.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Moment {
    /// Simulated time.
    pub time_s: f64,
    /// The link, joint or pair that it is about.
    pub subject: String,
    /// The value, in the unit of its [`Measure`]; `null` in JSON if it is infinite, as a time that has not come.
    #[schemars(with = "Option<f64>")]
    pub value: f64,
    /// Position of every movable joint, rad or m.
    pub q: JointValues,
}

/// One quantity that a check holds against a limit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Measure {
    /// What it is: `position`, `orientation`, `distance`.
    #[serde(deserialize_with = "known_word")]
    pub quantity: Word,
    /// Unit of limit and values.
    #[serde(deserialize_with = "known_word")]
    pub unit: Word,
    /// The limit.
    pub limit: f64,
    /// Whether values must be at most the limit (`at_most`), at least the limit (`at_least`), or above it
    /// (`above`).
    pub bound: Bound,
    /// The worst value; `None` if there was none.
    pub worst: Option<Moment>,
    /// The first value outside the limit.
    pub first_violation: Option<Moment>,
}

/// The worst value of one quantity at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InstantValue {
    /// What it is, as in the [`Measure`].
    pub quantity: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// The side of the limit on which it must be.
    pub bound: Bound,
    /// The limit.
    pub limit: f64,
    /// The value.
    pub value: f64,
    /// The index of what has it: of a joint, a link or a pair, by the kind of check.
    pub subject: usize,
}

/// The same with the number of the check in the scenario, from 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CheckValue {
    /// The check.
    pub check: usize,
    /// Its kind.
    pub kind: CheckKind,
    /// The value.
    pub of: InstantValue,
}

/// The side of a limit on which values must be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Bound {
    /// At most the limit.
    AtMost,
    /// At least the limit.
    AtLeast,
    /// Above the limit, not at it.
    Above,
}

impl Bound {
    /// The words before the limit in a sentence.
    pub fn words(self) -> &'static str {
        match self {
            Self::AtMost => "at most",
            Self::AtLeast => "at least",
            Self::Above => "above",
        }
    }

    /// Whether `value` is within the limit; NaN never is.
    pub fn holds(self, value: f64, limit: f64) -> bool {
        match self {
            Self::AtMost => value <= limit,
            Self::AtLeast => value >= limit,
            Self::Above => value > limit,
        }
    }

    /// Whether `value` is worse than `known`; NaN is worst of all.
    pub fn is_worse(self, value: f64, known: f64) -> bool {
        match self {
            _ if known.is_nan() => false,
            _ if value.is_nan() => true,
            Self::AtMost => value > known,
            Self::AtLeast | Self::Above => value < known,
        }
    }
}

/// The result of one check of a scenario.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CheckResult {
    /// The kind of check, as the scenario names it.
    pub check: CheckKind,
    /// Line of the check in the scenario file, from 1.
    pub line: Option<usize>,
    /// Whether the scenario has no check of this kind, so that it was checked by default limits.
    #[serde(rename = "default", default, skip_serializing_if = "std::ops::Not::not")]
    pub is_default: bool,
    /// The outcome.
    pub status: Status,
    /// Number of instants that were checked.
    pub samples: u64,
    /// The quantities with their limits.
    pub measures: Vec<Measure>,
    /// The pairs that touched, each from when to when, by a check `contact`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub contacts: Vec<Contact>,
    /// Remarks on the values.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

/// Two shapes that touched for a time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Contact {
    /// The link, and the link or obstacle that it touched.
    pub pair: [String; 2],
    /// The first instant of the contact.
    pub from_s: f64,
    /// The last instant of the contact.
    pub until_s: f64,
    /// How deep their convex hulls overlapped at most; 0 if they only touched.
    pub depth_m: f64,
}

/// The early end of a run by a check with `on_violation = "stop"`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Stop {
    /// The kind of check that was violated.
    pub check: CheckKind,
    /// Its line in the scenario file, from 1.
    pub line: Option<usize>,
    /// Steps taken until then: the last of them shows the violation.
    pub step: u64,
    /// Simulated time of the violation.
    pub time_s: f64,
    /// Position of every movable joint at the violation, rad or m.
    pub q: JointValues,
    /// The way to rest; `None` if the source of joint states drives nothing, and the run ended at once.
    pub rest: Option<WayToRest>,
}

/// How an arm came to rest: its setpoint slowed down within the acceleration limits and stayed, and the run went on until
/// the arm was at rest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WayToRest {
    /// Whether every joint is slower than 1e-3 rad/s or m/s for the last 50 ms; the run does not wait for more than 5 s.
    pub is_at_rest: bool,
    /// Time from the violation to rest.
    pub duration_s: f64,
    /// How far each joint has gone in that time, rad or m.
    pub joints: JointValues,
    /// Length of the path of the twin's TCP in that time.
    pub tcp_path_m: f64,
    /// The acceleration with which each joint may slow down: the joint that needs the longest to stop uses its own, the
    /// others slow down alike.
    pub accelerations: Vec<StopAcceleration>,
}

/// The acceleration with which a joint may slow down in a stop.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StopAcceleration {
    /// The joint.
    pub joint: String,
    /// The acceleration, rad/s^2 or m/s^2.
    pub limit: f64,
    /// Where it is from.
    pub source: StopLimit,
    /// The speed, rad/s or m/s, that its setpoint lost at once where it came to the end of the joint's range in the stop, beyond
    /// this acceleration; absent if it did not come there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lost_at_end_of_range: Option<f64>,
}

/// Where the acceleration of a stop is from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StopLimit {
    /// It is declared under `[limits]` of the scenario or of the robot file.
    Declared,
    /// None is declared: it stops from the velocity limit of the joint in 0.25 s.
    FromVelocity,
    /// The joint has neither: 7.5 rad/s^2 or m/s^2.
    Assumed,
}

/// The verdict of a run over all checks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// All as the scenario expects.
    AsExpected,
    /// Not as the scenario expects.
    NotAsExpected,
    /// Nothing was checked, which is never success.
    NothingChecked,
    /// The simulation failed.
    Broken,
}

impl Verdict {
    /// The exit code that stands for it.
    pub fn exit_code(self) -> u8 {
        match self {
            Self::AsExpected => 0,
            Self::NotAsExpected => 1,
            Self::Broken => 3,
            Self::NothingChecked => 4,
        }
    }
}

/// Judges the results of all checks by what the scenario expects.
pub fn judge(expected: &Expectation, results: &[CheckResult]) -> Verdict {
    // A default check may fail a run, but a scenario that asks for nothing is no success because of it.
    let looked_at = |result: &CheckResult| {
        result.status != Status::Skipped && (!result.is_default || result.status != Status::Pass)
    };
    if !results.iter().any(looked_at) {
        return Verdict::NothingChecked;
    }
    if results.iter().any(|result| result.status == Status::Error) {
        return Verdict::Broken;
    }
    let failed =
        |kind: CheckKind| results.iter().any(|result| result.check == kind && result.status == Status::Fail);
    let mut failing = results.iter().filter(|result| result.status == Status::Fail);
    let as_expected = match expected {
        Expectation::Pass => failing.next().is_none(),
        // A default check that is not named was not meant.
        Expectation::Fail { checks } if checks.is_empty() => failing.any(|result| !result.is_default),
        Expectation::Fail { checks } => {
            let others_pass =
                results.iter().all(|result| result.status != Status::Fail || checks.contains(&result.check));
            checks.iter().all(|&kind| failed(kind)) && others_pass
        }
    };
    if as_expected { Verdict::AsExpected } else { Verdict::NotAsExpected }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn result(check: CheckKind, status: Status) -> CheckResult {
        CheckResult {
            check,
            line: Some(1),
            is_default: false,
            status,
            samples: 1,
            measures: Vec::new(),
            contacts: Vec::new(),
            notes: Vec::new(),
        }
    }

    #[track_caller]
    fn judged(expected: &Expectation, results: &[CheckResult], verdict: Verdict) {
        assert_eq!(judge(expected, results), verdict);
    }

    fn fail(checks: &[CheckKind]) -> Expectation {
        Expectation::Fail { checks: checks.to_vec() }
    }

    #[test]
    fn nothing_checked_is_no_success() {
        judged(&Expectation::Pass, &[], Verdict::NothingChecked);
        judged(&Expectation::Pass, &[result(CheckKind::Limits, Status::Skipped)], Verdict::NothingChecked);
        judged(&fail(&[]), &[], Verdict::NothingChecked);
    }

    #[test]
    fn a_default_check_can_fail_a_run_but_is_no_success() {
        let by_default = |status| CheckResult { is_default: true, ..result(CheckKind::Limits, status) };
        let agreement = |status| result(CheckKind::Agreement, status);
        judged(&Expectation::Pass, &[by_default(Status::Pass)], Verdict::NothingChecked);
        judged(&Expectation::Pass, &[by_default(Status::Fail)], Verdict::NotAsExpected);
        let [passes, fails] = [Status::Pass, Status::Fail].map(by_default);
        judged(&Expectation::Pass, &[agreement(Status::Pass), passes], Verdict::AsExpected);
        judged(&Expectation::Pass, &[agreement(Status::Pass), fails.clone()], Verdict::NotAsExpected);
        let expected = fail(&[CheckKind::Agreement]);
        judged(&expected, &[agreement(Status::Fail), fails.clone()], Verdict::NotAsExpected);
        let expected = fail(&[CheckKind::Agreement, CheckKind::Limits]);
        judged(&expected, &[agreement(Status::Fail), fails.clone()], Verdict::AsExpected);
        judged(&fail(&[]), &[agreement(Status::Pass), fails.clone()], Verdict::NotAsExpected);
        judged(&fail(&[]), &[agreement(Status::Fail), fails], Verdict::AsExpected);
    }

    #[test]
    fn a_negative_control_fails_for_its_own_reason_only() {
        let agreement = result(CheckKind::Agreement, Status::Fail);
        let clearance = result(CheckKind::Clearance, Status::Fail);
        let passing = result(CheckKind::Limits, Status::Pass);
        judged(&fail(&[CheckKind::Agreement]), &[agreement.clone(), passing.clone()], Verdict::AsExpected);
        judged(
            &fail(&[CheckKind::Agreement]),
            &[agreement.clone(), clearance.clone()],
            Verdict::NotAsExpected,
        );
        judged(&fail(&[CheckKind::Agreement]), &[clearance], Verdict::NotAsExpected);
        judged(&fail(&[CheckKind::Agreement]), &[passing], Verdict::NotAsExpected);
        judged(&fail(&[]), &[agreement], Verdict::AsExpected);
    }

    #[test]
    fn a_broken_run_is_neither() {
        judged(&Expectation::Pass, &[result(CheckKind::Agreement, Status::Error)], Verdict::Broken);
    }

    #[test]
    fn at_the_limit() {
        let holds = [Bound::AtMost, Bound::AtLeast, Bound::Above].map(|bound| bound.holds(0.5, 0.5));
        assert_eq!(holds, [true, true, false]);
        assert!(Bound::Above.holds(0.6, 0.5) && Bound::Above.is_worse(0.1, 0.2));
    }

    #[test]
    fn not_a_number_is_outside_every_limit_and_worst_of_all() {
        assert!(!Bound::AtMost.holds(f64::NAN, 1.0) && !Bound::AtLeast.holds(f64::NAN, 1.0));
        assert!(!Bound::Above.holds(f64::NAN, 1.0) && Bound::Above.is_worse(f64::NAN, 5.0));
        assert!(Bound::AtMost.is_worse(f64::NAN, 5.0) && !Bound::AtMost.is_worse(5.0, f64::NAN));
    }
}
