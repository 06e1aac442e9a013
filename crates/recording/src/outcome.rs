//! What a finished run adds to its recording: lines at the limits, lanes of verdicts, events.

use congruent_twin::{
    recorder::RecordingError,
    report::RunReport,
    verdict::{CheckResult, Measure, Moment, Status},
};
use re_log_types::EntityPath;
use re_sdk_types::{
    archetypes::{Scalars, SeriesLines, StateChange, StateConfiguration, TextLog},
    components::{Color, TextLogLevel},
};

use crate::{batch::exponent, palette, paths, times::Instant, units, writer::RrdWriter};

/// All quantities of all checks of one kind.
pub(super) fn measures<'a>(report: &'a RunReport, kind: &'a str) -> impl Iterator<Item = &'a Measure> {
    report.checks.iter().filter(move |check| check.check == kind).flat_map(|check| &check.measures)
}

/// When something was outside its limit first.
pub(super) fn first_violation_s(report: &RunReport) -> Option<f64> {
    report.checks.iter().filter_map(first_violation).map(|(_, moment)| moment.time_s).min_by(f64::total_cmp)
}

/// Where a check was violated first.
fn first_violation(check: &CheckResult) -> Option<(&Measure, &Moment)> {
    check
        .measures
        .iter()
        .filter_map(|measure| Some((measure, measure.first_violation.as_ref()?)))
        .min_by(|(_, a), (_, b)| a.time_s.total_cmp(&b.time_s))
}

/// Writes all of it.
pub(super) fn write(writer: &mut RrdWriter, report: &RunReport) -> Result<(), RecordingError> {
    write_limits(writer, report)?;
    for (check, lane) in report.checks.iter().zip(lane_names(report)) {
        write_lane(writer, report, check, &paths::status(&lane))?;
    }
    write_events(writer, report)
}

fn instant(report: &RunReport, time_s: f64) -> Instant {
    let steps = (time_s / report.simulation.step_s).round();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the cast of floats saturates, and times are not negative"
    )]
    Instant::new(time_s, steps as u64)
}

/// A line at every limit that a plot shows, from the start to the end.
fn write_limits(writer: &mut RrdWriter, report: &RunReport) -> Result<(), RecordingError> {
    let plotted = |kind: &str, quantity: &str| match (kind, quantity) {
        ("agreement", "position") => Some((paths::position_error("tolerance"), "tolerance")),
        ("agreement", "orientation") => Some((paths::orientation_error("tolerance"), "tolerance")),
        ("clearance", _) => Some((paths::clearance("limit"), "limit")),
        _ => None,
    };
    for check in &report.checks {
        for measure in &check.measures {
            if let Some((path, name)) = plotted(check.check, measure.quantity) {
                write_line(writer, report, &path, (name, measure.limit))?;
            }
            if check.check == "agreement" {
                let name = format!("{} tolerance", measure.quantity);
                let path = paths::worst_of_links(&name);
                write_line(writer, report, &path, (&name, exponent(measure.limit)))?;
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
        writer.log_at(path, instant(report, time_s).point(), &Scalars::new([value]))?;
    }
    Ok(())
}

/// The kind of each check; where a kind appears again, with its line in the file.
fn lane_names(report: &RunReport) -> impl Iterator<Item = String> + '_ {
    report.checks.iter().enumerate().map(|(index, check)| {
        let is_again = report.checks[..index].iter().any(|before| before.check == check.check);
        if is_again { format!("{} (line {})", check.check, check.line) } else { check.check.to_owned() }
    })
}

/// A check's verdict as it changes: it passes until it is violated, or the run breaks.
fn write_lane(
    writer: &mut RrdWriter,
    report: &RunReport,
    check: &CheckResult,
    path: &EntityPath,
) -> Result<(), RecordingError> {
    let style = StateConfiguration::new().with_values(palette::LANES).with_colors(palette::LANE_COLORS);
    writer.log_static(path, &style)?;
    let start = if check.status == Status::Skipped { Status::Skipped } else { Status::Pass };
    let change = match check.status {
        Status::Fail => first_violation(check).map(|(_, moment)| (moment.time_s, Status::Fail)),
        Status::Error => Some((report.simulation.duration_s, Status::Error)),
        Status::Pass | Status::Skipped => None,
    };
    let starts_so = change.is_none_or(|(time_s, _)| time_s > 0.0);
    for (time_s, status) in starts_so.then_some((0.0, start)).into_iter().chain(change) {
        let state = StateChange::single(status.word());
        writer.log_at(path, instant(report, time_s).point(), &state)?;
    }
    Ok(())
}

/// Start, first violation of each check, end: changes only, in the order of time.
fn write_events(writer: &mut RrdWriter, report: &RunReport) -> Result<(), RecordingError> {
    let end_s = report.simulation.duration_s;
    let start = format!("{} starts, seed {}", report.scenario, report.seed);
    let mut events = vec![(0.0, TextLogLevel::INFO, start)];
    for check in &report.checks {
        if let Some((measure, moment)) = first_violation(check) {
            let text = format!(
                "{}: {} of {} is {}, limit {}",
                check.check,
                measure.quantity,
                moment.subject,
                units::quantity(moment.value, measure.unit),
                units::limit(measure),
            );
            events.push((moment.time_s, TextLogLevel::ERROR, text));
        }
    }
    if let Some(stop) = &report.stopped {
        let text = format!("check {} stops the run", stop.check);
        events.push((end_s, TextLogLevel::ERROR, text));
    }
    if let Some(error) = &report.error {
        events.push((end_s, TextLogLevel::CRITICAL, error.clone()));
    }
    let verdict = super::summary::verdict(report);
    let level = if report.exit_code == 0 { TextLogLevel::INFO } else { TextLogLevel::ERROR };
    events.push((end_s, level, verdict));
    events.sort_by(|(a, ..), (b, ..)| a.total_cmp(b));
    for (time_s, level, text) in events {
        let event = TextLog::new(text).with_level(level).with_color(color(level));
        writer.log_at(&paths::log(), instant(report, time_s).point(), &event)?;
    }
    Ok(())
}

fn color(level: &str) -> Color {
    if level == TextLogLevel::INFO { palette::MINIMUM } else { palette::LIMIT }
}
