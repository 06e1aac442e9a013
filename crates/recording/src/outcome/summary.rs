//! The results of a run: a document for people, and properties of the recording for programs.

use std::{fmt::Write, sync::Arc};

use congruent_input::visible;
use congruent_monitors::{RecordingError, verdict::CheckResult};
use congruent_results::report::{RunReport, lines};
use re_chunk::external::arrow::array::{ArrayRef, Float64Array, StringArray, UInt64Array};
use re_sdk_types::{
    AnyValues,
    archetypes::{RecordingInfo, TextDocument},
};

use crate::rrd::{paths, writer::RrdWriter};

/// Writes the document and the properties.
pub(crate) fn write(writer: &mut RrdWriter, report: &RunReport) -> Result<(), RecordingError> {
    writer.log_static(&paths::summary(), &TextDocument::from_markdown(markdown(report)))?;
    let info = RecordingInfo::new().with_name(report.scenario.as_str());
    writer.log_static(&re_log_types::EntityPath::properties(), &info)?;
    writer.log_static(&paths::properties(), &properties(report))
}

fn properties(report: &RunReport) -> AnyValues {
    let text = |text: &str| -> ArrayRef { Arc::new(StringArray::from(vec![text])) };
    let number = |number: u64| -> ArrayRef { Arc::new(UInt64Array::from(vec![number])) };
    let json = report.portable(&serde_json::to_string(report).expect("every report can be written as JSON"));
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
        .with_component_from_data("congruent", text(&report.versions.congruent))
        .with_component_from_data("physics", text(&report.versions.physics))
        .with_component_from_data("command", text(&report.command()))
        .with_component_from_data("report", text(&json))
}

fn markdown(report: &RunReport) -> String {
    let (scenario, robot) = (escaped(&report.scenario), escaped(&report.robot));
    let mut text = format!("### {scenario} on {robot}: {}\n\n", escaped(&report.sentence()));
    if let Some(error) = &report.error {
        let _ = writeln!(text, "{}\n", escaped(error));
    }
    for servo in &report.servos {
        let _ = writeln!(text, "- motion {}: {}", servo.motion, escaped(&servo.to_string()));
    }
    for check in report.checks_failed_first() {
        push_check(&mut text, check);
    }
    let (clock, versions) = (report.simulation, &report.versions);
    let _ = writeln!(
        text,
        "\n{}, {} steps of {} s, seed {}, trajectory `{}`, by congruent {} on {}\n",
        escaped(&report.robot),
        clock.steps,
        clock.step_s,
        report.seed,
        report.trajectory_sha256.get(..12).unwrap_or_default(),
        escaped(&versions.congruent),
        escaped(&versions.physics),
    );
    let _ = writeln!(text, "```\n{}\n```", report.command().replace("```", ""));
    text
}

/// Adds a check with its worst values, as a list, since the viewer cuts off wide tables.
fn push_check(text: &mut String, check: &CheckResult) {
    let _ = writeln!(text, "- **{} {}**", check.check, check.status.word());
    for line in lines(check) {
        let _ = writeln!(text, "  - {}", escaped(&line));
    }
}

/// Text from files, escaped so that Markdown shows it unchanged.
fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in visible(text).chars() {
        match c {
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
    fn names_from_files_are_escaped() {
        assert_eq!(escaped("wrist_1_link--table"), "wrist_1_link--table");
        assert_eq!(escaped("a|b\n<img>`x`"), r"a\|b\\n\<img\>\`x\`");
    }
}
