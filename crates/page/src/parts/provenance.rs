//! Where a page comes from: the inputs with their digests, the version, and the command that repeats it.

use congruent_input::InputFile;
use maud::{Markup, html};

/// The revision of the source that the program was built from, if the build knew it.
const REVISION: Option<&str> = option_env!("CONGRUENT_REVISION");

/// What a page was made from.
#[derive(Debug, Clone, Default)]
pub(crate) struct Provenance<'a> {
    /// The command that makes the same again, if it is known.
    pub(crate) command: Option<String>,
    /// The files that were read.
    pub(crate) inputs: Vec<&'a InputFile>,
    /// What else says that a repetition is the same, as sentences.
    pub(crate) remarks: Vec<Markup>,
}

/// The section at the end of a page.
pub(crate) fn provenance(of: &Provenance<'_>) -> Markup {
    html! {
        section.provenance {
            h2 { "Where this comes from" }
            @if let Some(command) = &of.command { p.small { "the command that repeats it" } pre.command { (command) } }
            @if !of.inputs.is_empty() {
                details {
                    summary { "inputs with their SHA-256 (" (of.inputs.len()) ")" }
                    ul.inputs { @for input in &of.inputs { li { code { (input.file) } " " code.hash { (input.sha256) } } } }
                }
            }
            p.small {
                "congruent " (env!("CARGO_PKG_VERSION"))
                @if let Some(revision) = REVISION { ", revision " code { (revision) } }
                @for remark in &of.remarks { "; " (remark) }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_names_its_inputs_and_its_command() {
        let input = InputFile {
            file: "robot.toml".to_owned(),
            sha256: "ab12".to_owned(),
            path: "/home/ann/robot.toml".into(),
        };
        let of = Provenance {
            command: Some("congruent check robot.toml".to_owned()),
            inputs: vec![&input],
            remarks: Vec::new(),
        };
        let html = provenance(&of).into_string();
        for shown in ["robot.toml", "ab12", "congruent check robot.toml", env!("CARGO_PKG_VERSION")] {
            assert!(html.contains(shown), "{shown}");
        }
        assert!(!html.contains("/home/ann"), "{html}");
    }
}
