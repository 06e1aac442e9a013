//! `congruent explain CODE`.

use std::fmt::Write;

use congruent::{
    agreement::diagnosis::Cause,
    dynamics_agreement::DynamicsCause,
    input::{Code, Diagnostic, nearest},
};
use serde::Serialize;

use crate::{
    codes,
    failure::Failure,
    terminal::{layout::paragraph, print::Printer},
};

/// An explanation as programs read it.
#[derive(Serialize)]
struct CodeExplanation {
    id: String,
    code: &'static str,
    about: String,
}

/// Explains the code of a message, or a cause that `check` names, and says what to do.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// A code by its number (CGR-URDF-005) or its name (`urdf::tree`), or a cause (`axis_flipped`).
    pub(crate) code: String,
}

pub(crate) fn run(word: &str, printer: &Printer) -> Result<u8, Failure> {
    let known = codes::all_codes();
    let explanation = explained(word, &known).ok_or_else(|| {
        let message = format!("unknown code or cause \"{word}\"");
        let unknown = Diagnostic::error(codes::lint::CODE, message);
        let name = word.to_lowercase();
        let numbered = codes_with_number(&name, &known);
        if !numbered.is_empty() {
            return unknown.with_help(format!("codes of this number: {}", numbered.join(", ")));
        }
        // Codes of findings have an area, `urdf::axis`; causes have none, or `check`.
        let near = Some(cause_name(&name)).filter(|name| !name.contains("::"));
        let near = near.and_then(|name| nearest(name, cause_names())).map(str::to_owned);
        match near.or_else(|| {
            Code::nearest(word, &known).map(|code| format!("{}, {}", code.id_or_name(), code.name))
        }) {
            Some(near) => unknown.with_help(format!("did you mean {near}?")),
            None if word.chars().all(|c| !c.is_lowercase()) => {
                unknown.with_help("the words of an answer are explained in docs/concepts.md")
            }
            None => unknown.with_help(
                "give the code of a finding (CGR-URDF-018, urdf::axis) or a cause of `check` (axis_flipped)",
            ),
        }
    })?;
    printer.result(&explanation, text)?;
    Ok(0)
}

/// The codes that end with a number, each with its name.
fn codes_with_number(number: &str, known: &[&'static Code]) -> Vec<String> {
    let Ok(number) = number.parse::<u16>() else { return Vec::new() };
    let ending = format!("-{number:03}");
    let has_number = |code: &&&Code| code.id.is_some_and(|id| id.ends_with(&ending));
    known.iter().filter(has_number).map(|code| format!("{} ({})", code.id_or_name(), code.name)).collect()
}

fn explained(word: &str, known: &[&'static Code]) -> Option<CodeExplanation> {
    let of_code = |code: &'static Code| CodeExplanation {
        id: code.id_or_name().to_owned(),
        code: code.name,
        about: code.about.to_owned(),
    };
    Code::find(word, known).map(of_code).or_else(|| cause(cause_name(&word.to_lowercase())))
}

/// The cause of a difference in poses, in dynamics, or of both that have this name.
fn cause(name: &str) -> Option<CodeExplanation> {
    let poses = Cause::ALL.iter().find(|cause| cause_name(cause.code().name) == name);
    let dynamics = DynamicsCause::ALL.iter().find(|cause| cause.name() == name);
    let of_poses = poses.map(|cause| cause.code().about.to_owned());
    let of_dynamics =
        dynamics.map(|cause| format!("A difference in dynamics: {}. {}", cause.text(), cause.advice()));
    let about: Vec<String> = of_poses.into_iter().chain(of_dynamics).collect();
    let code = poses.map(|cause| cause.code().name).or_else(|| dynamics.map(|cause| cause.name()))?;
    Some(CodeExplanation { id: code.to_owned(), code, about: about.join(" ") })
}

/// The name of a cause without the `check::` of its code.
fn cause_name(code: &str) -> &str {
    code.strip_prefix("check::").unwrap_or(code)
}

fn cause_names() -> impl Iterator<Item = &'static str> {
    let of_poses = Cause::ALL.iter().map(|cause| cause_name(cause.code().name));
    of_poses.chain(DynamicsCause::ALL.iter().map(|cause| cause.name()))
}

fn text(code: &CodeExplanation) -> String {
    let mut lines = code.about.lines();
    // A cause has a name, and no number.
    let name = if code.id == code.code { String::new() } else { format!(" {}", code.code) };
    let mut text = format!("{}{name}\n\n", code.id);
    text += &paragraph(lines.next().unwrap_or_default(), 2, 2);
    for (at, example) in lines.enumerate() {
        let _ = writeln!(text, "{}{example}", if at == 0 { "\n" } else { "" });
    }
    text
}
