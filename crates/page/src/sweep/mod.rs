//! The page of a sweep: verdicts, which value matters, all cases as points and lines, and the worst of them with links.

mod axis;
mod lines;
mod points;
mod tables;

use congruent_input::{InputFile, display::number, serde_name};
use congruent_sweep::{run::CaseVerdict, store::MergedTable, summary::SweepSummary};
use maud::{Markup, html};

use crate::parts::{BadgeKind, Pointer, Provenance, badge, count, document, provenance};

/// The page of all rows of a sweep. `command` is the call that made it.
pub fn sweep_page(summary: &SweepSummary, table: &MergedTable, command: &str) -> String {
    let inputs: Vec<InputFile> = Vec::new();
    let body = html! {
        (header(summary))
        (tables::importance(summary))
        (tables::worst(summary))
        (points::scatter(summary, table))
        (lines::parallel(summary, table))
        (tables::refused(summary))
        (provenance(&Provenance { command: Some(command.to_owned()), ..Provenance::default() }))
        p.small {
            "The page of each of the worst cases has its inputs with their digests. SHA-256 of the rows, the same however the sweep was \
             cut: " code { (summary.table_sha256) }
        }
    };
    document(&format!("{}: sweep", summary.header.name), &body, None, &inputs)
}

/// The class of a verdict in the style sheet.
fn class(verdict: CaseVerdict) -> &'static str {
    match verdict {
        CaseVerdict::Pass => "good",
        CaseVerdict::Fail | CaseVerdict::Broken => "bad",
        CaseVerdict::NothingChecked | CaseVerdict::Refused => "unclear",
    }
}

/// A share in per cent.
fn percent(share: f64) -> String {
    format!("{} %", number(100.0 * share))
}

fn header(summary: &SweepSummary) -> Markup {
    let of = |word: &str| summary.verdicts.get(word).copied().unwrap_or(0);
    let (passed, rows) = (of("pass"), summary.rows);
    let kind = if passed == rows && summary.missing == 0 {
        BadgeKind::Good
    } else if of("fail") + of("broken") > 0 {
        BadgeKind::Bad
    } else {
        BadgeKind::Unclear
    };
    let word = if passed == rows {
        format!("ALL {rows} CASES PASS")
    } else {
        format!("{passed} OF {rows} CASES PASS")
    };
    let root = Pointer::root();
    html! {
        header {
            p.kind { "Sweep of a scenario" }
            h1 { (summary.header.name) }
            p.verdict { (badge(kind, &word)) }
            dl.facts {
                dt { "scenario" } dd { (summary.header.scenario) ", robot " (summary.header.robot) }
                dt { "cases" }
                dd {
                    (count(&root.key("rows"), rows)) " of " (summary.header.cases)
                    ", sampling " (serde_name(&summary.header.sampling)) ", seed " (summary.header.seed)
                }
                dt { "verdicts" }
                dd {
                    @for (at, (word, cases)) in summary.verdicts.iter().enumerate() {
                        @if at > 0 { ", " }
                        (count(&root.key("verdicts").key(word), cases)) " " (word.replace('_', " "))
                    }
                }
                @if let Some(requirement) = &summary.requirement {
                    dt { "required" }
                    dd {
                        "at least " (percent(requirement.passing)) " of all cases pass: "
                        b { (serde_name(&requirement.verdict).replace('_', " ")) }
                        ", between " (percent(requirement.interval[0])) " and " (percent(requirement.interval[1]))
                        ", each bound with confidence " (percent(requirement.confidence))
                    }
                }
                dt { "varied" } dd { @for (at, key) in summary.header.keys.iter().enumerate() { @if at > 0 { ", " } code { (key) } } }
            }
        }
    }
}
