//! The scenario of a log as the text of a file.

use std::fmt::Write;

use congruent_scenario::Scenario;

/// The text of a scenario file; `taken` says what of the log it takes, `command` is the call that wrote it.
pub fn replay_text(scenario: &Scenario, taken: &[String], command: &str) -> String {
    let mut text = format!("# Written by `{command}`.\n");
    for line in taken {
        let _ = writeln!(text, "# {line}");
    }
    text.push('\n');
    text + &scenario.source_to_toml()
}
