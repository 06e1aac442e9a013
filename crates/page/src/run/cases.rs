//! The cases of `[uncertainty]`: in how many of them each check holds, and the worst values.

use congruent_results::report::{
    CheckInCases, RequirementVerdict, RunReport, case_lines, cases_title, unfinished_words,
};
use maud::{Markup, html};

use crate::parts::{BadgeKind, badge};

/// The table of checks, those first that do not hold in enough cases; nothing for a scenario without cases. A case that ran alone has
/// its values here.
pub(super) fn cases(report: &RunReport) -> Markup {
    if let Some(case) = &report.case {
        return html! {
            section {
                h2 { "Case " (case.case) }
                p { "The arm has these values, which its controllers do not know." }
                table {
                    thead { tr { th { "key" } th { "value" } } }
                    @for of in &case.values { tr { th scope="row" { (of.key) } td { (of.value) } } }
                }
            }
        };
    }
    let Some(cases) = &report.uncertainty else { return html! {} };
    html! {
        section {
            h2 { (cases_title(cases)) }
            table.checks {
                thead { tr { th { "check" } th { "result" } th { "holds in, and its values" } } }
                @for check in cases.checks_failed_first() { (row(check)) }
            }
            @for line in unfinished_words(cases) { p { (line) } }
            @if let Some(command) = report.command_of_case() { p { "To see the first case that fails: " code { (command) } } }
        }
    }
}

fn row(check: &CheckInCases) -> Markup {
    let outcome = match check.requirement.verdict {
        RequirementVerdict::Met => BadgeKind::Good,
        RequirementVerdict::NotMet => BadgeKind::Bad,
        RequirementVerdict::NotEnoughCases => BadgeKind::Unclear,
    };
    html! {
        tr {
            th scope="row" { (check.check) @if let Some(line) = check.line { span.small { " line " (line) } } }
            td { (badge(outcome, check.requirement.verdict.status_word())) }
            td { @for line in case_lines(check) { p { (line) } } }
        }
    }
}
