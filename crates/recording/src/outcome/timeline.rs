//! What a finished run adds over time: lines at the limits, the status of each check, and events.

use congruent_twin::{
    recorder::RecordingError,
    report::{RunReport, sentence_at},
    scenario::CheckKind,
    verdict::{CheckResult, Status},
};
use re_log_types::EntityPath;
use re_sdk_types::{
    archetypes::{Scalars, SeriesLines, StateChange, StateConfiguration, TextLog},
    components::{Color, TextLogLevel},
};

use super::measures::first_violation;
use crate::{
    rrd::{paths, times::SampleTime, writer::RrdWriter},
    scene::palette,
    series::scalars::log10,
};

/// Writes limits, statuses and events.
pub(crate) fn write(writer: &mut RrdWriter, report: &RunReport) -> Result<(), RecordingError> {
    write_limits(writer, report)?;
    for (check, name) in report.checks.iter().zip(status_names(report)) {
        write_status(writer, report, check, &paths::status(check.status.word(), &name))?;
    }
    write_events(writer, report)
}

fn time(report: &RunReport, time_s: f64) -> SampleTime {
    let steps = (time_s / report.simulation.step_s).round();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the cast of floats saturates, and times are not negative"
    )]
    SampleTime::new(time_s, steps as u64)
}

/// Writes a line at every limit in a plot, from the start to the end of the run.
fn write_limits(writer: &mut RrdWriter, report: &RunReport) -> Result<(), RecordingError> {
    let plotted = |kind: &str, quantity: &str| match (kind, quantity) {
        ("agreement", "position") => Some((paths::position_error("tolerance"), "tolerance")),
        ("agreement", "orientation") => Some((paths::orientation_error("tolerance"), "tolerance")),
        ("clearance", _) => Some((paths::clearance("limit"), "limit")),
        _ => None,
    };
    for check in &report.checks {
        for (at, measure) in check.measures.iter().enumerate() {
            // Further pairs of a clearance check have the same limit.
            if check.measures[..at].iter().any(|before| before.quantity == measure.quantity) {
                continue;
            }
            if let Some((path, name)) = plotted(check.check.word(), measure.quantity) {
                write_line(writer, report, &path, (name, measure.limit))?;
            }
            if check.check == CheckKind::Agreement {
                let name = format!("{} tolerance", measure.quantity);
                let path = paths::worst_of_links(&name);
                write_line(writer, report, &path, (&name, log10(measure.limit)))?;
            }
        }
    }
    Ok(())
}

fn write_line(
    writer: &mut RrdWriter,
    report: &RunReport,
    path: &EntityPath,
    (name, value): (&str, f64),
) -> Result<(), RecordingError> {
    let style = SeriesLines::new().with_names([name]).with_colors([palette::LIMIT]).with_widths([1.5]);
    writer.log_static(path, &style)?;
    for time_s in [0.0, report.simulation.duration_s] {
        writer.log_at(path, time(report, time_s).point(), &Scalars::new([value]))?;
    }
    Ok(())
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
    let start = if check.status == Status::Skipped { Status::Skipped } else { Status::Pass };
    let change = match check.status {
        Status::Fail => first_violation(check).map(|(_, moment)| (moment.time_s, Status::Fail)),
        Status::Error => Some((report.simulation.duration_s, Status::Error)),
        Status::Pass | Status::Skipped => None,
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
            let text = format!("{}: {}", check.check, sentence_at(measure, moment));
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
