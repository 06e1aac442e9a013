//! The index over the runs of one call: the worst first, each with a link to its page.

use std::path::Path;

use congruent_input::{InputFile, display::quantity, portable_path};
use congruent_monitors::verdict::{Status, Verdict};
use congruent_results::report::{RunReport, lines, quantity_words};
use maud::{Markup, html};

use crate::{
    parts::{BadgeKind, Provenance, badge, capitalised, document, provenance},
    run::{outcome, tightest},
};

/// One scenario of a call.
#[derive(Debug, Clone)]
pub struct IndexEntry<'a> {
    /// The scenario file as it was named.
    pub input: String,
    /// Its page, relative to the index; `None` if there is none.
    pub page: Option<String>,
    /// The report, or why there is none.
    pub result: Result<&'a RunReport, String>,
}

impl IndexEntry<'_> {
    fn outcome(&self) -> (BadgeKind, &'static str) {
        self.result.as_ref().map_or((BadgeKind::Bad, "DID NOT START"), |report| outcome(report))
    }

    /// Worst first: what could not run, what failed, then what is nearest to a limit.
    fn rank(&self) -> (u8, f64) {
        let Ok(report) = &self.result else { return (0, 0.0) };
        let verdict = match report.verdict {
            Verdict::Broken => 1,
            Verdict::NothingChecked => 2,
            Verdict::NotAsExpected => 3,
            Verdict::NotEnoughCases => 4,
            Verdict::AsExpected => 5,
        };
        // Negated: sorted upwards, the largest share comes first.
        (verdict, -tightest(report).map_or(0.0, |tightest| tightest.share))
    }
}

/// The page; entries keep their order if they are equally good. `command` is the call that made it.
pub fn index_page(entries: &[IndexEntry<'_>], command: &str) -> String {
    let mut order: Vec<&IndexEntry<'_>> = entries.iter().collect();
    order.sort_by(|a, b| {
        let ((a, a_share), (b, b_share)) = (a.rank(), b.rank());
        a.cmp(&b).then(a_share.total_cmp(&b_share))
    });
    let bad = entries.iter().filter(|entry| entry.outcome().0 != BadgeKind::Good).count();
    let title = format!("{} scenarios", entries.len());
    let body = html! {
        header {
            p.kind { "Runs of scenarios" }
            h1 { (title) }
            p.verdict {
                @if bad == 0 { (badge(BadgeKind::Good, "ALL PASS")) }
                @else { (badge(BadgeKind::Bad, &format!("{bad} OF {} DO NOT PASS", entries.len()))) }
            }
        }
        section {
            table.index {
                thead { tr { th { "scenario" } th { "result" } th { "what happened" } th { "nearest to its limit" } th { "robot" } } }
                tbody { @for entry in order { (row(entry)) } }
            }
        }
        (provenance(&Provenance { command: Some(command.to_owned()), ..Provenance::default() }))
        p.small { "The page of each run has its inputs with their digests." }
    };
    let inputs: Vec<InputFile> = entries
        .iter()
        .filter_map(|entry| entry.result.as_ref().ok())
        .flat_map(|report| report.inputs.iter().cloned())
        .collect();
    document(&title, &body, None, &inputs)
}

fn row(entry: &IndexEntry<'_>) -> Markup {
    let (outcome, word) = entry.outcome();
    let input = portable_path(Path::new(&entry.input)).display().to_string();
    let name = entry.result.as_ref().map_or(input.as_str(), |report| report.scenario.as_str());
    html! {
        tr {
            th scope="row" {
                @match &entry.page { Some(page) => a href=(page) { (name) }, None => (name) }
            }
            td { (badge(outcome, word)) }
            @match &entry.result {
                Ok(report) => {
                    td data-label="what happened" { (happened(report)) }
                    td data-label="nearest to its limit" { (nearest(report)) }
                    td data-label="robot" { bdi { (report.robot) } span.small { ", " (quantity(report.simulation.duration_s, "s")) } }
                }
                Err(reason) => { td colspan="3" { (reason) } }
            }
        }
    }
}

/// The verdict, and the first thing that failed.
fn happened(report: &RunReport) -> Markup {
    let failed = report.checks_failed_first().into_iter().find(|check| check.status == Status::Fail);
    let fails = report.verdict == Verdict::NotAsExpected && failed.is_some();
    let line = failed.and_then(|check| lines(check).into_iter().next());
    html! {
        (capitalised(&report.sentence())) @if fails { " failed" } "."
        @if let Some(error) = &report.error { p.small { (error) } }
        @else if let Some(line) = line { p.small { (line) } }
    }
}

/// The share of a limit that a run without violations used most of.
fn nearest(report: &RunReport) -> Markup {
    let has_failed = report.checks.iter().any(|check| check.status == Status::Fail);
    html! {
        @if let Some(nearest) = tightest(report).filter(|_| !has_failed) {
            (nearest.check) ": " (quantity_words(nearest.measure.quantity)) ", " (nearest.words())
            p.small { (nearest.worst.subject) }
        }
    }
}
