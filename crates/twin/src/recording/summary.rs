//! What came out, for people as a document and for programs as properties of the recording.

use std::{fmt::Write, sync::Arc};

use rerun::{
    AnyValues, RecordingInfo, TextDocument,
    external::arrow::array::{ArrayRef, Float64Array, StringArray, UInt64Array},
};

use super::{paths, units, writer::RrdWriter};
use crate::{
    recorder::RecordingError,
    report::RunReport,
    verdict::{CheckResult, Expectation, Verdict},
};

/// Writes both.
pub(super) fn write(writer: &mut RrdWriter, report: &RunReport) -> Result<(), RecordingError> {
    writer.log_static(&paths::summary(), &TextDocument::from_markdown(markdown(report)))?;
    let info = RecordingInfo::new().with_name(report.scenario.as_str());
    writer.log_static(&rerun::EntityPath::properties(), &info)?;
    writer.log_static(&paths::properties(), &properties(report))
}

fn properties(report: &RunReport) -> AnyValues {
    let text = |text: &str| -> ArrayRef { Arc::new(StringArray::from(vec![text])) };
    let number = |number: u64| -> ArrayRef { Arc::new(UInt64Array::from(vec![number])) };
    let json = serde_json::to_string(report).expect("a report holds nothing that JSON cannot");
    let word = serde_json::to_value(report.verdict).expect("a verdict is a word");
    AnyValues::default()
        .with_component_from_data("scenario", text(&report.scenario))
        .with_component_from_data("robot", text(&report.robot))
        .with_component_from_data("verdict", text(word.as_str().unwrap_or_default()))
        .with_component_from_data("exit_code", number(report.exit_code.into()))
        .with_component_from_data("seed", number(report.seed))
        .with_component_from_data("steps", number(report.simulation.steps))
        .with_component_from_data("step_s", Arc::new(Float64Array::from(vec![report.simulation.step_s])))
        .with_component_from_data("trajectory_sha256", text(&report.trajectory_sha256))
        .with_component_from_data("congruent", text(report.versions.congruent))
        .with_component_from_data("physics", text(report.versions.physics))
        .with_component_from_data("command", text(&command(report)))
        .with_component_from_data("report", text(&json))
}

/// The verdict in a sentence.
pub(super) fn verdict(report: &RunReport) -> String {
    let failed: Vec<_> = report
        .checks
        .iter()
        .filter(|check| check.status == crate::verdict::Status::Fail)
        .map(|check| check.check)
        .collect();
    let failed = failed.join(", ");
    match (report.verdict, &report.expected) {
        (Verdict::AsExpected, Expectation::Pass) => "every check passes, as expected".to_owned(),
        (Verdict::AsExpected, Expectation::Fail { .. }) => format!("{failed} fails, as expected"),
        (Verdict::NotAsExpected, _) if failed.is_empty() => {
            "every check passes, against expectation".to_owned()
        }
        (Verdict::NotAsExpected, _) => format!("{failed} fails, against expectation"),
        (Verdict::NothingChecked, _) => "nothing was checked".to_owned(),
        (Verdict::Broken, _) => "the run broke".to_owned(),
    }
}

fn command(report: &RunReport) -> String {
    format!("congruent run {} --seed {}", report.scenario_file, report.seed)
}

fn markdown(report: &RunReport) -> String {
    let mut text = format!("# {}\n\n**{}**\n\n", escaped(&report.scenario), escaped(&verdict(report)));
    if let Some(error) = &report.error {
        let _ = writeln!(text, "{}\n", escaped(error));
    }
    text.push_str("| check | worst | limit | where | at |\n|---|---|---|---|---|\n");
    for check in &report.checks {
        push_rows(&mut text, check);
    }
    for note in report.checks.iter().flat_map(|check| &check.notes) {
        let _ = writeln!(text, "\n{}", escaped(note));
    }
    let clock = report.simulation;
    let _ = write!(
        text,
        "\n| run | |\n|---|---|\n| robot | {} |\n| time | {} steps of {} s |\n| seed | {} |\n",
        escaped(&report.robot),
        clock.steps,
        clock.step_s,
        report.seed,
    );
    let versions = report.versions;
    let by = format!("congruent {}, {}", versions.congruent, versions.physics);
    let _ = writeln!(text, "| by | {} |", escaped(&by));
    let hash = report.trajectory_sha256.get(..12).unwrap_or(&report.trajectory_sha256);
    let _ = write!(text, "| trajectory | `{hash}` |\n\n```\n{}\n```\n", command(report).replace("```", ""));
    text
}

/// One row for each quantity; the first carries the name of the check.
fn push_rows(text: &mut String, check: &CheckResult) {
    let status = check.status.word();
    if check.measures.is_empty() {
        let _ = writeln!(text, "| **{}** {status} | | | | |", check.check);
    }
    for (index, measure) in check.measures.iter().enumerate() {
        let name = if index == 0 { format!("**{}** {status}", check.check) } else { String::new() };
        let (worst, place, time) = measure.worst.as_ref().map_or_else(Default::default, |worst| {
            let value = units::quantity(worst.value, measure.unit);
            (value, escaped(&worst.subject), format!("{:.3} s", worst.time_s))
        });
        let limit = units::limit(measure);
        let quantity = measure.quantity;
        let _ = writeln!(text, "| {name} | {quantity} {worst} | {limit} | {place} | {time} |");
    }
}

/// Text that comes from files, so that Markdown takes it as it is.
fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            c if c.is_control() => safe.push(' '),
            '_' | '-' | '.' | ',' | ':' | ';' | '/' => safe.push(c),
            c if c.is_ascii_punctuation() => safe.extend(['\\', c]),
            c => safe.push(c),
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_from_files_stay_text() {
        assert_eq!(escaped("wrist_1_link--table"), "wrist_1_link--table");
        assert_eq!(escaped("a|b\n<img>`x`"), "a\\|b \\<img\\>\\`x\\`");
    }
}
