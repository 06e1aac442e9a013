//! What a finished run adds over time: the status of each check, and events.

use congruent_monitors::{
    RecordingError,
    verdict::{CheckResult, Status},
};
use congruent_results::report::{RunReport, sentence_at};
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
pub(crate) fn write(writer: &mut RrdWriter, report: &RunReport) -> Result<(), RecordingError> {
    for (check, name) in report.checks.iter().zip(status_names(report)) {
        write_status(writer, report, check, &paths::status(check.status.word(), &name))?;
    }
    write_events(writer, report)
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

/// Writes the events in order of time: start, first violation of each check, stop or error, verdict.
fn write_events(writer: &mut RrdWriter, report: &RunReport) -> Result<(), RecordingError> {
    let end_s = report.simulation.duration_s;
    let start = format!("{} starts, seed {}", report.scenario, report.seed);
    let mut events = vec![(0.0, TextLogLevel::INFO, start)];
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
    if level == TextLogLevel::INFO { palette::NEUTRAL } else { palette::LIMIT }
}
