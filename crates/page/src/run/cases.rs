//! The cases of `[uncertainty]`: in how many of them each check holds, and the worst values.

use congruent_results::report::{
    CaseOfRun, CheckInCases, QuantityWords, RequirementVerdict, RunReport, UncertaintyReport, cases_title,
    decided_by, passes_in, unfinished_words,
};
use maud::{Markup, html};

use super::histogram::histogram;
use crate::parts::{BadgeKind, badge, capitalised};

/// What varies, and the table of checks, those first that do not pass in enough cases; nothing for a scenario without cases. A case that
/// ran alone has its values here.
pub(super) fn cases(report: &RunReport) -> Markup {
    if let Some(case) = &report.case {
        return one_case(case);
    }
    let Some(cases) = &report.uncertainty else { return html! {} };
    html! {
        section {
            h2 { (capitalised(&cases_title(cases))) }
            table {
                thead { tr { th { "what varies" } th { "values" } } }
                @for varied in &cases.varied {
                    tr { th scope="row" { code { (varied.keys.join(", ")) } } td { (varied.distribution) } }
                }
            }
            table.checks {
                thead { tr { th { "check" } th { "result" } th { "quantity" } th { "of all cases" } th { "worst" } th { "median" } th { "limit" } th { "cases" } } }
                @for check in cases.checks_failed_first() { (rows(cases, check)) }
            }
            @for line in unfinished_words(cases) { p { (line) } }
            @if let Some((what, command)) = report.command_of_cases() { p { (capitalised(what)) ": " code { (command) } } }
            p.small { "Small pictures show how the values of the cases are distributed; the line is the limit, if it is that near. Everything else on this page is the run with nominal values: those of the file and of --set." }
        }
    }
}

fn one_case(case: &CaseOfRun) -> Markup {
    html! {
        section {
            h2 { "Case " (case.case) }
            p { "The run has these values. Controllers and planner know nominal masses, frictions and geometry." }
            table {
                thead { tr { th { "key" } th { "value" } th { "nominal" } } }
                @for of in &case.values {
                    tr { th scope="row" { code { (of.key) } } td { (of.shown()) } td { @if let Some(value) = of.nominal { (value) } } }
                }
            }
        }
    }
}

fn rows(cases: &UncertaintyReport, check: &CheckInCases) -> Markup {
    let outcome = match check.requirement.verdict {
        RequirementVerdict::Met => BadgeKind::Good,
        RequirementVerdict::NotMet => BadgeKind::Bad,
        RequirementVerdict::NotEnoughCases => BadgeKind::Unclear,
    };
    let words = |of| QuantityWords::new(of, check.requirement.passing);
    html! {
        tbody {
            tr {
                th scope="row" { (check.check) @if check.is_default { span.small { " (default)" } } @if let Some(line) = check.line { span.small { " line " (line) } } }
                td { (badge(outcome, check.requirement.verdict.status_word())) }
                td colspan="6" { (passes_in(cases, check)) }
            }
            @for (of, QuantityWords { what, kept, worst, median, limit }) in check.quantities.iter().map(|of| (of, words(of))) {
                tr {
                    td.again {} td.again {}
                    td data-label="quantity" { (what) }
                    td data-label="of all cases" { (kept.unwrap_or_default()) }
                    td data-label="worst" { (worst) }
                    td data-label="median" { (median.unwrap_or_else(|| "the same".to_owned())) }
                    td data-label="limit" { (limit.unwrap_or_default()) }
                    td data-label="cases" { (histogram(of)) }
                }
                @if let Some(deciding) = decided_by(of) {
                    tr.notes { td.again {} td.again {} td colspan="6" { (deciding) } }
                }
            }
        }
    }
}
