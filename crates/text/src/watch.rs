//! The lines about a stream as text for people.

use std::fmt::Write;

use congruent_input::display::{counted, listed, quantity};
use congruent_live_report::{
    BadLineFound, CheckChange, GapCause, LeftOutLater, RecordingFull, StreamGap, StreamLoss, WatchEnd,
    WatchLine, WatchStart, WatchedPose,
};
use congruent_results::report::{quantity_words, share_in_full, value_and_margin};

use crate::run::run_text;

/// A line as text, with its end.
pub fn watch_text(line: &WatchLine) -> String {
    match line {
        WatchLine::Started(start) => started(start),
        WatchLine::Pose(WatchedPose {
            time_s,
            frame,
            child,
            translation_m: [x, y, z],
            quaternion_wxyz: q,
        }) => {
            let [w, i, j, k] = q;
            format!(
                "{time_s} s  {child} in {frame}: {x:.6} {y:.6} {z:.6} m, wxyz {w:.6} {i:.6} {j:.6} {k:.6}\n"
            )
        }
        WatchLine::Violation(change) => changed("VIOLATION", change),
        WatchLine::Recovered(change) => changed("recovered", change),
        WatchLine::Gap(StreamGap { from_s, to_s, cause: GapCause::NoSamples }) => {
            format!(
                "{to_s} s  gap: no sample for {}, nothing is judged in it\n",
                quantity(to_s - from_s, "s")
            )
        }
        WatchLine::Gap(StreamGap { from_s, to_s, cause: GapCause::ClockWentBack }) => {
            format!("{to_s} s  gap: the clock went back from {from_s} s, a new part begins\n")
        }
        WatchLine::Lost(StreamLoss { message, samples: 0, .. }) => format!("lost: {message}; trying again\n"),
        WatchLine::Lost(StreamLoss { message, samples, .. }) => {
            format!("lost: {samples} samples were not judged: {message}\n")
        }
        WatchLine::ConnectedAgain(again) => format!("connected again, attempt {}\n", again.attempts),
        WatchLine::BadLine(BadLineFound { line, message, text }) => {
            format!("line {line} is left out: {message}: {text}\n")
        }
        WatchLine::LeftOut(LeftOutLater { message }) => format!("left out: {message}\n"),
        WatchLine::RecordingFull(RecordingFull { file, time_s, limit_mb }) => {
            format!("{time_s} s  {file} is full (limit {limit_mb} MB) and takes no further sample\n")
        }
        WatchLine::Finished(end) => finished(end),
    }
}

/// How a line begins that says what of the stream is not judged, and why.
const LEFT_OUT: &str = "left out: ";

fn started(start: &WatchStart) -> String {
    let WatchStart { source, robot, joints, rate_hz, checks, taken, .. } = start;
    let rate = rate_hz.map_or_else(String::new, |rate| format!(" at {}", quantity(rate, "Hz")));
    let checks: Vec<&str> = checks.iter().map(|check| check.word()).collect();
    let mut text = format!(
        "watching {source}: {robot}, {}{rate}; checks: {}\n",
        counted(joints.len(), "joint"),
        if checks.is_empty() { "none".to_owned() } else { listed(&checks) }
    );
    for left_out in taken.iter().filter_map(|line| line.strip_prefix(LEFT_OUT)) {
        let _ = writeln!(text, "  not judged: {left_out}");
    }
    text
}

fn changed(word: &str, change: &CheckChange) -> String {
    let CheckChange { time_s, check, quantity: of, value, limit, unit, bound, subject, .. } = change;
    let at = subject.as_ref().map_or_else(String::new, |subject| format!(" at {subject}"));
    let shown = |value: f64| quantity(value, unit.symbol());
    let found = value_and_margin(*of, *unit, *bound, [*value, *limit]).unwrap_or_else(|| {
        format!(
            "{} {}, {} {}",
            quantity_words(*of),
            shown(*value),
            bound.words(),
            share_in_full(*limit, *unit)
        )
    });
    format!("{time_s} s  {word}  {check}: {found}{at}\n")
}

fn finished(end: &WatchEnd) -> String {
    let WatchEnd { counts, latency, report, .. } = end;
    let others = [
        (counts.left_out, "instant left out", "instants left out"),
        (counts.gaps, "gap", "gaps"),
        (counts.bad_lines, "bad line", "bad lines"),
        (counts.repeated, "repeated", "repeated"),
        (counts.late, "late", "late"),
        (counts.lost_samples, "sample lost", "samples lost"),
        (counts.lost_connections, "connection lost", "connections lost"),
    ];
    let mut text = String::new();
    for (count, one, many) in others.into_iter().filter(|(count, ..)| *count > 0) {
        let _ = write!(text, ", {count} {}", if count == 1 { one } else { many });
    }
    let samples = if counts.samples == 1 { "sample" } else { "samples" };
    let latency = latency.map_or_else(String::new, |latency| {
        let shown = |value: f64| quantity(1e3 * value, "ms");
        let [median, p99, largest] = [latency.median_s, latency.p99_s, latency.largest_s].map(shown);
        format!("  answered within {median} (median), {p99} (99 %), {largest} (longest)\n")
    });
    format!("{}  {} {samples} judged{text}\n{latency}", run_text(report), counts.samples)
}
