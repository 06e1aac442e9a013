//! `lint --explain CODE`.

use std::fmt::Write;

use congruent::input::{Code, Diagnostic};
use serde::Serialize;

use crate::{
    failure::Failure,
    terminal::{layout::paragraph, print::Printer},
};

/// An explanation as programs read it.
#[derive(Serialize)]
struct Explanation {
    id: String,
    code: &'static str,
    about: &'static str,
}

pub(super) fn run(word: &str, printer: &Printer) -> Result<u8, Failure> {
    let code = Code::find(word).ok_or_else(|| {
        let unknown = Diagnostic::error("lint::code", format!("no finding has the code \"{word}\""));
        match Code::nearest(word) {
            Some(near) => unknown.with_help(format!("did you mean {near}, {}?", near.name)),
            None => unknown,
        }
    })?;
    let explanation = Explanation { id: code.to_string(), code: code.name, about: code.about };
    printer.result(&explanation, text)?;
    Ok(0)
}

fn text(code: &Explanation) -> String {
    let mut lines = code.about.lines();
    let mut text = format!("{} {}\n\n", code.id, code.code);
    text += &paragraph(lines.next().unwrap_or_default(), 2, 2);
    for (at, example) in lines.enumerate() {
        let _ = writeln!(text, "{}{example}", if at == 0 { "\n" } else { "" });
    }
    text
}
