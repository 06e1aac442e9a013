//! What was suspicious in the input.

use congruent_input::Finding;
use maud::{Markup, html};

/// The findings; nothing if there are none.
pub(crate) fn warnings(findings: &[Finding]) -> Markup {
    html! {
        @if !findings.is_empty() {
            details {
                summary { (findings.len()) " " @if findings.len() == 1 { "warning" } @else { "warnings" } " about the input" }
                ul { @for finding in findings { li { (finding.to_string()) } } }
            }
        }
    }
}
