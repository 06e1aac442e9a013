//! The checks of a scenario once more, on a recording alone: does it show what its report says?
//!
//! A recording keeps one sample in 10 ms. There are three origins of evidence on a check, and each has its limits:
//! the worst values that the check itself measured between two recorded samples (every step, but measured by the
//! run); the joint states at the recorded samples, which the checks of the scenario see again (nothing of the run is
//! believed, but steps between are missing); and the report in the recording, which decides alone only where the
//! others are silent.

mod instants;
mod replay;
mod states;

use std::collections::BTreeSet;

use congruent_input::{Quantity, SiUnit, serde_name};
use congruent_monitors::verdict::{CheckResult, Status, Verdict, judge};
use congruent_results::{comparison::Scalars, report::RunReport};
use congruent_scenario::CheckKind;
use congruent_twin::{RunError, RunSetup};

use self::{
    replay::Replay,
    states::{RecordedUntil, steps},
};
use super::{
    evidence::{Evidence, LimitedQuantity, TimedValue, merged},
    rechecked::{Basis, Disagreement, Recheck, RecheckedCheck, RecheckedQuantity},
    summary::RecordingSummary,
};
use crate::{rrd::paths, series::checks::path_parts};

/// Why a recording cannot be compared with a scenario.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RecheckError {
    /// There is nothing to compare with.
    #[error("the recording has no report of a run, so there is no verdict to compare with")]
    NoReport,
    /// The scenario has other checks than the run.
    #[error("the recording is of another scenario: it has the checks {recorded}, and this one has {given}")]
    OtherScenario {
        /// The kinds of checks in the recording.
        recorded: String,
        /// The kinds of checks in the scenario.
        given: String,
    },
    /// The scenario has another robot than the run.
    #[error(
        "the recording is of robot \"{recorded}\", and this scenario is of robot \"{given}\", which has other links or joints"
    )]
    OtherRobot {
        /// The robot of the run.
        recorded: String,
        /// The robot of the scenario.
        given: String,
    },
    /// The checks cannot start.
    #[error(transparent)]
    Run(#[from] RunError),
}

/// By how much a value that is computed again from joint positions may be worse than that of the run. Kind: rounding of
/// the physics; the poses of the run are those of its bodies, these follow from the URDF. In the unit of the value.
const COMPUTED_AGAIN: f64 = 1e-6;
/// The same for a share of travel, whose ends may lie between two recorded samples. Kind: judgement; joints are slow where they turn
/// round or stop.
const BETWEEN_SAMPLES: f64 = 0.05;

/// Evaluates the checks of a scenario on a recording, and compares the results with the report in it.
///
/// `summary` and `scalars` are those of [`scalars`](super::scalars). The limits are those of the scenario; if they are
/// not those of the run, its verdict may be another.
///
/// # Errors
/// [`RecheckError`] if the recording has no report, or one of other checks.
pub fn recheck(
    summary: &RecordingSummary,
    scalars: &Scalars,
    setup: &RunSetup,
) -> Result<Recheck, RecheckError> {
    let report = summary.run.as_ref().ok_or(RecheckError::NoReport)?;
    // Checks are matched by their position below: another list would compare the values of different checks.
    is_of_scenario(report, setup)?;
    is_of_robot(report, scalars, setup)?;
    let left_out = left_out(report);
    let until = if is_early(report) { RecordedUntil::Early } else { RecordedUntil::End };
    let replay = Replay::evaluate(scalars, setup, until, &left_out)?;
    let checks = setup.checks();
    let lines = checks.iter().map(|check| check.line).collect();
    let are_default = checks.iter().map(|check| check.is_default).collect();
    let is_broken = report.error.is_some();
    let mut context = Context { scalars, setup, lines, are_default, replay, is_broken, gap_s: 0.0 };
    // After the context is made, since the gap follows from the instants that its replay has found.
    context.gap_s = context.longest_gap_s();
    let mut disagreements = Vec::new();
    let recorded = report.checks.iter().enumerate();
    let checks: Vec<RecheckedCheck> =
        recorded.map(|(at, recorded)| context.check(at, recorded, &mut disagreements)).collect();
    let same_limits =
        setup.scenario.expect == report.expected && checks.iter().all(RecheckedCheck::has_same_limits);
    let verdict = if is_broken { Verdict::Broken } else { context.verdict(&checks) };
    Ok(Recheck {
        scenario: setup.path.as_ref().map(|path| path.display().to_string()),
        same_limits,
        instants: context.replay.times_s.len(),
        gap_s: context.gap_s,
        step_s: setup.clock.step_s,
        expected: setup.scenario.expect.clone(),
        verdict,
        same_verdict: verdict == report.verdict,
        recorded_verdict: serde_name(&report.verdict).to_owned(),
        checks,
        disagreements,
        samples: instants::problems(scalars, report, setup),
    })
}

/// Whether the checks are of the same kinds in the same order.
fn is_of_scenario(report: &RunReport, setup: &RunSetup) -> Result<(), RecheckError> {
    let kinds: Vec<&str> = report.checks.iter().map(|check| check.check.word()).collect();
    let given: Vec<&str> = setup.scenario.check.iter().map(|check| check.kind().word()).collect();
    if kinds == given {
        return Ok(());
    }
    let listed = |kinds: &[&str]| if kinds.is_empty() { "none".to_owned() } else { kinds.join(", ") };
    Err(RecheckError::OtherScenario { recorded: listed(&kinds), given: listed(&given) })
}

/// Where the positions of joints are.
const JOINT_POSITIONS: &str = "/joint/position/";

/// Whether the robot has the links of the run, and the joints whose positions are recorded.
fn is_of_robot(report: &RunReport, scalars: &Scalars, setup: &RunSetup) -> Result<(), RecheckError> {
    let links = report.links.iter().map(|link| link.link.as_str());
    let robot = &setup.description.robot;
    let joints: BTreeSet<String> =
        robot.movable_joint_names().map(|joint| paths::joint_position(joint).to_string()).collect();
    let mut recorded_joints = scalars.keys().filter(|path| path.starts_with(JOINT_POSITIONS));
    let has_joints = recorded_joints.all(|path| joints.contains(path));
    if has_joints && links.eq(robot.links().iter().map(|link| link.name.as_str())) {
        return Ok(());
    }
    Err(RecheckError::OtherRobot { recorded: report.robot.clone(), given: setup.description.name.clone() })
}

/// Whether the run ended before its time: it broke, or a check stopped it.
fn is_early(report: &RunReport) -> bool {
    report.error.is_some() || report.stopped.is_some()
}

/// Checks that depend on what a recording does not hold: when the motions end if the run was delayed, and what follows
/// once it has ended early.
fn left_out(report: &RunReport) -> Vec<CheckKind> {
    let is_slowed = report.motions.iter().any(|motion| motion.slowed.is_some());
    match (is_early(report), is_slowed) {
        (true, _) => vec![CheckKind::CycleTime, CheckKind::Goal],
        (false, true) => vec![CheckKind::CycleTime],
        (false, false) => Vec::new(),
    }
}

/// Whether a difference is above a limit; NaN is.
fn exceeds(difference: f64, limit: f64) -> bool {
    difference > limit || difference.is_nan()
}

/// Data that the evaluation of every check needs.
struct Context<'a> {
    scalars: &'a Scalars,
    setup: &'a RunSetup,
    /// Lines of the checks.
    lines: Vec<Option<usize>>,
    /// Whether they were added to those of the scenario.
    are_default: Vec<bool>,
    replay: Replay,
    is_broken: bool,
    gap_s: f64,
}

impl Context<'_> {
    /// The longest time between two recorded samples.
    fn longest_gap_s(&self) -> f64 {
        let gaps = self.replay.times_s.windows(2).map(|pair| pair[1] - pair[0]);
        // In whole steps: a difference of two times has their rounding.
        let clock = &self.setup.clock;
        clock.time_s(steps(gaps.fold(0.0, f64::max), clock.step_s))
    }

    /// How much worse than in the run a value at recorded instants may be: rounding, and for a time the gap between
    /// samples.
    fn slack(&self, kind: CheckKind, of: LimitedQuantity) -> f64 {
        match of.unit {
            _ if kind == CheckKind::Agreement => 0.0, // recorded, not computed again
            _ if of.name == Quantity::ShareOfTravel => BETWEEN_SAMPLES,
            SiUnit::Second => self.gap_s,
            _ => COMPUTED_AGAIN,
        }
    }

    fn check(
        &self,
        at: usize,
        recorded: &CheckResult,
        disagreements: &mut Vec<Disagreement>,
    ) -> RecheckedCheck {
        let kind = self.setup.scenario.check[at].kind();
        let line = self.lines[at];
        let reported = merged(recorded.measures.iter().filter_map(Evidence::from_measure));
        let mut quantities = Vec::new();
        let mut found_here = Vec::new();
        // Each quantity of the report has a limit and a worst value, which series and samples are compared with.
        for reported in &reported {
            let quantity = self.quantity(at, kind, reported, &mut found_here);
            quantities.push(quantity);
        }
        // A violation at a sample that the report lacks: a report from which a quantity was removed must not pass.
        let unreported = self.replay.found[at]
            .iter()
            .filter(|evidence| !reported.iter().any(|known| known.of.is(evidence.of.name, evidence.of.unit)));
        for evidence in unreported
            .filter(|evidence| exceeds(evidence.beyond(evidence.of.limit), self.slack(kind, evidence.of)))
        {
            let at = evidence.first_violation.unwrap_or(evidence.worst);
            let problem =
                "violates the limit at a recorded sample, and the report has no such value".to_owned();
            found_here.push(Disagreement::new(kind, line, evidence, at, problem));
        }
        let basis = Basis::worst(quantities.iter().map(|quantity| quantity.basis));
        let is_violated = quantities.iter().any(|quantity| quantity.violation_s.is_some());
        let is_same = quantities.iter().all(RecheckedQuantity::has_same_limit);
        // Without a quantity in the report, a contradiction found above is the only violation there can be.
        let status = match recorded.status {
            Status::Skipped if quantities.is_empty() => Status::Skipped,
            _ if is_violated || !found_here.is_empty() && quantities.is_empty() => Status::Fail,
            Status::Error | Status::Inconclusive => recorded.status,
            _ => Status::Pass,
        };
        // With limits other than those of the run, another status is the answer and no contradiction.
        if is_same && found_here.is_empty() && status != recorded.status {
            found_here.push(Disagreement::contradicted_status(kind, line, status, recorded.status));
        }
        disagreements.append(&mut found_here);
        RecheckedCheck {
            check: kind,
            line,
            status,
            recorded_status: recorded.status.word().to_owned(),
            basis,
            quantities,
        }
    }

    /// One quantity of a check, from all origins.
    fn quantity(
        &self,
        at: usize,
        kind: CheckKind,
        reported: &Evidence,
        disagreements: &mut Vec<Disagreement>,
    ) -> RecheckedQuantity {
        let LimitedQuantity { name, unit, .. } = reported.of;
        let limit = self.replay.limit(at, name, unit).unwrap_or(reported.of.limit);
        let of = LimitedQuantity { limit, ..reported.of };
        let [kind_part, quantity_part] = path_parts(at, kind, name, unit);
        let series = self.scalars.get(&paths::check(&kind_part, &quantity_part).to_string());
        // A row of the series is the worst value since the row before, so that no step is missing; but the run
        // measured it.
        let every_step = series.and_then(|values| Evidence::from_values(of, values));
        let sampled = self.replay.found[at].iter().find(|evidence| evidence.of.is(name, unit));
        let line = self.lines[at];
        if let Some((at, evidence, problem)) = self.problem(kind, reported, every_step.as_ref(), sampled) {
            disagreements.push(Disagreement::new(kind, line, evidence, at, problem));
        }
        let slack = self.slack(kind, of);
        // Shapes that touch are at the limit exactly: the run has found it, too.
        let is_known = reported.violation_of(limit).is_some();
        // A new violation must exceed the slack: rounding of recomputed poses would fail a run that passed at its
        // limit.
        let sampled_violation = sampled.filter(|sampled| is_known || exceeds(sampled.beyond(limit), slack));
        // The origins in order of their steps: every step, then the samples, then the report.
        let violation = every_step.as_ref().and_then(|found| found.first_violation);
        let violation = violation.or_else(|| sampled_violation?.violation_of(limit));
        let violation = violation.or_else(|| reported.violation_of(limit));
        // Samples can show a violation. They cannot refute one that the report has between two of them.
        let basis = match (&every_step, sampled) {
            (Some(_), _) => Basis::EveryStep,
            (None, Some(_)) if violation.is_some() || violation.is_none() => Basis::RecordedSamples,
            _ => Basis::Report,
        };
        let worst = every_step.as_ref().or(sampled).unwrap_or(reported);
        let subject =
            sampled.and_then(|sampled| sampled.subject.clone()).or_else(|| reported.subject.clone());
        RecheckedQuantity {
            quantity: name,
            unit,
            bound: of.bound,
            limit,
            recorded_limit: reported.of.limit,
            worst: worst.worst.value,
            worst_s: worst.worst.time_s,
            subject,
            recorded_worst: reported.worst.value,
            violation_s: violation.map(|at| at.time_s),
            basis,
        }
    }

    /// Where the series and the report contradict each other: the value of the series, and why.
    fn problem<'e>(
        &self,
        kind: CheckKind,
        reported: &'e Evidence,
        every_step: Option<&'e Evidence>,
        sampled: Option<&'e Evidence>,
    ) -> Option<(TimedValue, &'e Evidence, String)> {
        // Infinity is `null` in the report.
        let is_same = |a: f64, b: f64| a.to_bits() == b.to_bits() || !a.is_finite() && b.is_nan();
        // A run that broke has not written the values of its last steps.
        if let Some(found) = every_step.filter(|_| !self.is_broken)
            && !is_same(found.worst.value, reported.worst.value)
        {
            let problem = "is the worst value of the check's series, and the report has another".to_owned();
            return Some((found.worst, found, problem));
        }
        // Samples are some of the steps: they may be better than the worst value of the run, and worse by rounding
        // only.
        let sampled = sampled?;
        let slack = self.slack(kind, reported.of);
        let difference = sampled.beyond(reported.worst.value);
        if exceeds(difference, slack)
            && !is_same(sampled.worst.value, reported.worst.value)
            && !reported.worst.value.is_nan()
        {
            let problem =
                "follows from the recorded series, and is worse than the report's worst value".to_owned();
            return Some((sampled.worst, sampled, problem));
        }
        let first = reported.first_violation?;
        // In contact the physics keeps bodies apart: no joint position shows it.
        let is_shown = kind != CheckKind::Contact
            && self.is_recorded(first.time_s)
            && reported.of.unit != SiUnit::Second;
        // So near to its limit, a violation can vanish when it is computed again.
        let is_near = (first.value - reported.of.limit).abs() <= slack;
        if is_shown && !is_near && sampled.violation_of(reported.of.limit).is_none() {
            let problem = format!(
                "is the worst value that follows from the recorded series, and the report has a violation at {}",
                congruent_input::display::quantity(first.time_s, "s")
            );
            return Some((sampled.worst, sampled, problem));
        }
        None
    }

    /// Whether there is a sample at this time.
    fn is_recorded(&self, time_s: f64) -> bool {
        let step_s = self.setup.clock.step_s;
        // Half a step: recorded times are rounded to nanoseconds, and the next sample is at least a step away.
        self.replay.times_s.iter().any(|&at_s| (at_s - time_s).abs() < step_s / 2.0)
    }

    /// The verdict of these results, by what the scenario expects.
    fn verdict(&self, checks: &[RecheckedCheck]) -> Verdict {
        let results = checks.iter().zip(&self.are_default).map(|(check, &is_default)| CheckResult {
            check: check.check,
            line: check.line,
            is_default,
            status: check.status,
            samples: 0,
            measures: Vec::new(),
            nearest_that_changes: None,
            contacts: Vec::new(),
            notes: Vec::new(),
        });
        judge(&self.setup.scenario.expect, &results.collect::<Vec<_>>())
    }
}
