//! What a finished run adds over time: the status of each check, and events.

use congruent_monitors::{
    RecordingError,
    verdict::{CheckResult, Status},
};
use congruent_results::report::{RunReport, sentence_at};
use congruent_scenario::Scenario;
use re_log_types::EntityPath;
use re_sdk_types::{
    archetypes::{StateChange, StateConfiguration, TextLog},
    components::{Color, TextLogLevel},
};

use super::measures::first_violation;
use crate::{
    rrd::{paths, times::SampleTime, writer::RrdWriter},
    scene::palette,
};

/// Writes statuses and events.
pub(crate) fn write(
    writer: &mut RrdWriter,
    report: &RunReport,
    carried: &[CarriedFor],
) -> Result<(), RecordingError> {
    for (check, name) in report.checks.iter().zip(status_names(report)) {
        write_status(writer, report, check, &paths::status(check.status.word(), &name))?;
    }
    write_events(writer, report, carried)
}

/// A time of the run.
pub(crate) fn time(report: &RunReport, time_s: f64) -> SampleTime {
    let steps = (time_s / report.simulation.step_s).round();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the cast of floats saturates, and times are not negative"
    )]
    SampleTime::new(time_s, steps as u64)
}

/// The kind of each check; a kind that appeared before is followed by the check's line in the scenario.
fn status_names(report: &RunReport) -> impl Iterator<Item = String> + '_ {
    report.checks.iter().enumerate().map(|(index, check)| {
        let is_repeated = report.checks[..index].iter().any(|before| before.check == check.check);
        match check.line {
            Some(line) if is_repeated => format!("{} (line {line})", check.check),
            _ => check.check.to_string(),
        }
    })
}

/// Writes the status of a check over time: pass until the first violation, or until the run stops with an
/// error.
fn write_status(
    writer: &mut RrdWriter,
    report: &RunReport,
    check: &CheckResult,
    path: &EntityPath,
) -> Result<(), RecordingError> {
    let style =
        StateConfiguration::new().with_values(palette::STATUS_WORDS).with_colors(palette::STATUS_COLORS);
    writer.log_static(path, &style)?;
    let start = if check.status.is_conclusive() { Status::Pass } else { check.status };
    let change = match check.status {
        Status::Fail => first_violation(check).map(|(_, moment)| (moment.time_s, Status::Fail)),
        Status::Error => Some((report.simulation.duration_s, Status::Error)),
        Status::Pass | Status::Skipped | Status::Inconclusive => None,
    };
    let has_start = change.is_none_or(|(time_s, _)| time_s > 0.0);
    for (time_s, status) in has_start.then_some((0.0, start)).into_iter().chain(change) {
        let state = StateChange::single(status.word());
        writer.log_at(path, time(report, time_s).point(), &state)?;
    }
    Ok(())
}

/// A body that is carried for a time: a grasp or a payload.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CarriedFor {
    words: String,
    from_s: f64,
    until_s: Option<f64>,
}

impl CarriedFor {
    /// The grasps and payloads of a scenario.
    pub(crate) fn of_scenario(scenario: &Scenario) -> Vec<Self> {
        let grasps = scenario.grasp.iter().map(|of| Self {
            words: format!("grasp of {}", of.body),
            from_s: of.from_s,
            until_s: of.until_s,
        });
        let payloads = scenario.payload.iter().map(|of| Self {
            words: format!("payload {}", of.name),
            from_s: of.from_s,
            until_s: of.until_s,
        });
        grasps.chain(payloads).collect()
    }
}

type RunEvent = (f64, &'static str, String);

/// What the scenario makes happen, as far as the run went: motions, grasps, payloads and faults, where they begin and end.
fn planned_events(report: &RunReport, carried: &[CarriedFor]) -> Vec<RunEvent> {
    let motions = (1..).zip(&report.motions).map(|(number, motion)| {
        (motion.starts_s, TextLogLevel::INFO, format!("motion {number}, {}, begins", motion.kind))
    });
    let faults = report.faults.iter().map(|of| (of.words(), of.from_s, of.until_s, TextLogLevel::WARN));
    let carried = carried.iter().map(|of| (of.words.clone(), of.from_s, of.until_s, TextLogLevel::INFO));
    let lasting = faults.chain(carried).flat_map(|(words, from_s, until_s, level)| {
        let begins = (from_s, level, format!("{words}: begins"));
        std::iter::once(begins).chain(until_s.map(|until_s| (until_s, level, format!("{words}: ends"))))
    });
    let is_in_run = |(time_s, ..): &RunEvent| *time_s <= report.simulation.duration_s;
    motions.chain(lasting).filter(is_in_run).collect()
}

/// Writes the events in order of time: start, what the scenario makes happen, first violation of each check, stop or error,
/// verdict.
fn write_events(
    writer: &mut RrdWriter,
    report: &RunReport,
    carried: &[CarriedFor],
) -> Result<(), RecordingError> {
    let end_s = report.simulation.duration_s;
    let start = format!("{} starts, seed {}", report.scenario, report.seed);
    let mut events = vec![(0.0, TextLogLevel::INFO, start)];
    events.extend(planned_events(report, carried));
    for check in &report.checks {
        if let Some((measure, moment)) = first_violation(check) {
            // The subject comes first: a narrow table cuts off the rest.
            let text = format!("{}, {}: {}", check.check, moment.subject, sentence_at(measure, moment));
            events.push((moment.time_s, TextLogLevel::ERROR, text));
        }
    }
    if let Some(stop) = &report.stopped {
        let text = format!("check {} stops the run", stop.check);
        events.push((stop.time_s, TextLogLevel::ERROR, text));
        if let Some(rest) = &stop.rest {
            let text = if rest.is_at_rest { "the arm is at rest" } else { "the arm is not at rest" };
            events.push((end_s, TextLogLevel::INFO, text.to_owned()));
        }
    }
    if let Some(error) = &report.error {
        events.push((end_s, TextLogLevel::CRITICAL, error.clone()));
    }
    let verdict = report.sentence();
    let level = if report.exit_code == 0 { TextLogLevel::INFO } else { TextLogLevel::ERROR };
    events.push((end_s, level, verdict));
    events.sort_by(|(a, ..), (b, ..)| a.total_cmp(b));
    for (time_s, level, text) in events {
        let event = TextLog::new(text).with_level(level).with_color(color(level));
        writer.log_at(&paths::log(), time(report, time_s).point(), &event)?;
    }
    Ok(())
}

fn color(level: &str) -> Color {
    match level {
        TextLogLevel::INFO => palette::NEUTRAL,
        TextLogLevel::WARN => palette::TOLERANCES[1],
        _ => palette::LIMIT,
    }
}
