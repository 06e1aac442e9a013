//! Results of checks and the verdict: one type for every check, so that all reports and exit codes agree.

use congruent_description::JointValues;
use congruent_input::{Quantity, SiUnit, serde_name};
use congruent_scenario::{CheckKind, Expectation};
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize};

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
    /// Too few samples could be evaluated: the values within their limits say nothing about the run.
    Inconclusive,
}

impl Status {
    /// Whether the check says something about the run.
    pub fn is_conclusive(self) -> bool {
        !matches!(self, Self::Skipped | Self::Inconclusive)
    }

    /// The name of the status in reports.
    pub fn word(self) -> &'static str {
        serde_name(&self)
    }
}

/// One value of a run, with its time and configuration.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Moment {
    /// Simulated time from the start of the run.
    pub time_s: f64,
    /// Name of the link, joint or pair that has the value.
    pub subject: String,
    /// The value, in the unit of its [`Measure`]; `null` in JSON if it is infinite, such as a time that was not reached.
    #[serde(deserialize_with = "number_or_null")]
    #[schemars(with = "Option<f64>")]
    pub value: f64,
    /// Position of every movable joint, rad or m.
    pub q: JointValues,
}

/// JSON has neither infinity nor NaN: both are `null`, which is read as NaN.
fn number_or_null<'de, D: Deserializer<'de>>(value: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(value)?.unwrap_or(f64::NAN))
}

/// One quantity that a check compares with a limit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Measure {
    /// Name of the quantity: `position`, `orientation`, `distance`.
    #[schemars(with = "String")]
    pub quantity: Quantity,
    /// Unit of limit and values; empty for a ratio.
    #[schemars(with = "String")]
    pub unit: SiUnit,
    /// The limit, in that unit.
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
    /// Name of the quantity, as in the [`Measure`].
    pub quantity: Quantity,
    /// Unit of value and limit; empty for a ratio.
    pub unit: SiUnit,
    /// The side of the limit on which the value must be.
    pub bound: Bound,
    /// The limit, in that unit.
    pub limit: f64,
    /// The value, in that unit.
    pub value: f64,
    /// Index of the joint, link or pair that has the value, depending on the kind of check.
    pub subject: usize,
}

/// A value with the check that it belongs to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CheckValue {
    /// Index of the check in the scenario, from 0.
    pub check: usize,
    /// Kind of the check.
    pub kind: CheckKind,
    /// The worst value of one of its quantities at one instant.
    pub of: InstantValue,
}

/// The side of a limit on which values must be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Bound {
    /// Values must be at most the limit.
    AtMost,
    /// Values must be at least the limit.
    AtLeast,
    /// Values must be above the limit, not at it.
    Above,
}

impl Bound {
    /// The words before the limit in a sentence: `limit <=` for values that must be at most the limit.
    pub fn words(self) -> &'static str {
        match self {
            Self::AtMost => "limit <=",
            Self::AtLeast => "limit >=",
            Self::Above => "limit >",
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
            // First, so that a NaN stays the worst: nothing that comes later may make the result look better.
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
    /// Whether the check is a default one: the scenario has no check of this kind.
    #[serde(rename = "default", default, skip_serializing_if = "std::ops::Not::not")]
    pub is_default: bool,
    /// Outcome of the check.
    pub status: Status,
    /// Number of instants that were checked.
    pub samples: u64,
    /// The quantities with their limits and worst values.
    pub measures: Vec<Measure>,
    /// Of a check `clearance` that passed: the nearest pair whose distance changes in the run, in the unit of the first
    /// measure, if the pair of that measure keeps its distance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub nearest_that_changes: Option<Moment>,
    /// The pairs that touched, with begin and end of each contact; of a check `contact` alone.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub contacts: Vec<Contact>,
    /// Remarks on the values.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

/// A contact of two shapes from its first to its last instant.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Contact {
    /// Names of the link, and of the link or obstacle that it touched.
    pub pair: [String; 2],
    /// The first instant of the contact.
    pub from_s: f64,
    /// The last instant of the contact.
    pub until_s: f64,
    /// Largest penetration depth of their convex hulls; 0 if they only touched.
    pub depth_m: f64,
    /// The normal force; absent between links, and if the source of joint states knows no forces.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub force: Option<ContactLoad>,
}

/// The normal force of a contact, without friction: the mean of each step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ContactLoad {
    /// Largest force.
    pub peak_n: f64,
    /// The instant of the largest force.
    pub peak_s: f64,
    /// Sum of the forces of all steps, each multiplied by the length of a step.
    pub impulse_n_s: f64,
}

/// The early end of a run by a check with `on_violation = "stop"`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RunStop {
    /// The kind of check that was violated.
    pub check: CheckKind,
    /// Line of that check in the scenario file, from 1.
    pub line: Option<usize>,
    /// Number of steps until the violation: the last of them shows it.
    pub step: u64,
    /// Simulated time of the violation.
    pub time_s: f64,
    /// Position of every movable joint at the violation, rad or m.
    pub q: JointValues,
    /// The motion to rest; `None` if the source of joint states drives nothing, so that the run ended at once.
    pub rest: Option<MotionToRest>,
}

/// How an arm came to rest: its setpoint slowed down within the acceleration limits and stayed, and the run went on until
/// the arm was at rest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MotionToRest {
    /// Whether every joint was slower than 1e-3 rad/s or m/s for the last 50 ms; the run waits for at most 5 s.
    pub is_at_rest: bool,
    /// Time from the violation to rest.
    pub duration_s: f64,
    /// Displacement of each joint in that time, rad or m.
    pub joints: JointValues,
    /// Length of the path of the twin's TCP in that time.
    pub tcp_path_m: f64,
    /// The acceleration limit of each joint in the stop: the joint that needs the longest time uses its limit, the others
    /// slow down in the same time.
    pub accelerations: Vec<StopAcceleration>,
}

/// The acceleration limit of a joint in a stop.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StopAcceleration {
    /// Name of the joint.
    pub joint: String,
    /// The acceleration limit, rad/s^2 or m/s^2.
    pub limit: f64,
    /// Origin of the limit.
    pub source: StopLimit,
    /// Speed, rad/s or m/s, that the setpoint lost at once because it reached the end of the joint's range in the stop; absent
    /// if it did not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lost_at_end_of_range: Option<f64>,
}

/// Origin of the acceleration limit of a stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StopLimit {
    /// Declared under `[limits]` of the scenario or of the robot file.
    Declared,
    /// No acceleration is declared: the velocity limit of the joint, divided by 0.25 s.
    FromVelocity,
    /// Neither acceleration nor velocity limit is declared: 7.5 rad/s^2 or m/s^2.
    Assumed,
}

/// The verdict of a run over all checks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Every check has the result that the scenario expects.
    AsExpected,
    /// At least one check has another result than the scenario expects.
    NotAsExpected,
    /// Nothing was checked, which is never success.
    NothingChecked,
    /// The scenario passes as it is written, and the cases of `[uncertainty]` are too few to say whether enough of them pass.
    NotEnoughCases,
    /// The simulation failed before the end of the run.
    Broken,
}

impl Verdict {
    /// Exit code of the program for this verdict.
    pub fn exit_code(self) -> u8 {
        match self {
            Self::AsExpected => 0,
            Self::NotAsExpected => 1,
            Self::Broken => 3,
            Self::NothingChecked | Self::NotEnoughCases => 4,
        }
    }
}

/// Judges the results of all checks by what the scenario expects.
pub fn judge(expected: &Expectation, results: &[CheckResult]) -> Verdict {
    // A default check may fail a run, but passing default checks alone do not make a scenario without checks a success.
    let looked_at = |result: &CheckResult| {
        result.status.is_conclusive() && (!result.is_default || result.status != Status::Pass)
    };
    // Before the comparison with what is expected: a run without a checked value must never be a success.
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
        // Without names, a failing default check is not the failure that the scenario is about.
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
            nearest_that_changes: None,
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
        let few = result(CheckKind::Dynamics, Status::Inconclusive);
        judged(&Expectation::Pass, std::slice::from_ref(&few), Verdict::NothingChecked);
        let passing = result(CheckKind::Limits, Status::Pass);
        judged(&Expectation::Pass, &[few, passing], Verdict::AsExpected);
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
