//! The document around a page. It carries its style and its scripts, and forbids every request.

use congruent_input::{InputFile, portable_text, visible, visible_lines};
use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::{assets, series::Plots};

/// What a browser may do with a page: show it, with its own styles and scripts. Nothing is fetched from anywhere.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:; \
                      base-uri 'none'; form-action 'none'";

/// The whole text of a page about these inputs.
pub(crate) fn document(title: &str, body: &Markup, plots: Option<&Plots>, inputs: &[InputFile]) -> String {
    // A mark that turns the direction of a text makes a name or a command look like another.
    let body = PreEscaped(portable_text(&visible_lines(&body.0), inputs));
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta name="referrer" content="no-referrer";
                title { (visible(&portable_text(title, inputs))) }
                @if plots.is_some() { style { (PreEscaped(assets::UPLOT_CSS)) } }
                style { (PreEscaped(assets::PAGE_CSS)) }
            }
            body {
                main { (body) }
                // The version is in the section that says where the page comes from.
                footer { "made by congruent" }
                @if let Some(plots) = plots {
                    script type="application/json" #plots { (PreEscaped(plots.json())) }
                    script { (PreEscaped(assets::LOCALE_JS)) }
                    script { (PreEscaped(assets::UPLOT_JS)) }
                    script { (PreEscaped(assets::PAGE_JS)) }
                }
            }
        }
    }
    .into_string()
}

/// A sentence with a capital letter.
pub(crate) fn capitalised(sentence: &str) -> String {
    // A name of a file, such as shoulder_link or the link of "forearm: the mass is off", keeps its letters.
    let first = sentence.split_whitespace().next().unwrap_or_default();
    if first.ends_with(':') || first.contains(|c: char| c == '_' || c.is_ascii_digit()) {
        return sentence.to_owned();
    }
    let mut letters = sentence.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
