//! The page of a run, section after section: of a run in which a check failed, that comes first and the rest is folded.

use std::path::Path;

use congruent_monitors::verdict::Status;
use congruent_results::report::RunReport;
use maud::{Markup, html};

use super::{
    actuators::actuators,
    cases::cases,
    checks::checks,
    content::RunContent,
    failures::what_failed,
    faults::causes,
    header::{header, provenance_of},
    joints::joints,
    over_time::{RunPlots, without_script},
    scene::scene,
};
use crate::parts::{document, warnings};

/// The whole page. Other results of the run are in `folder`.
pub(super) fn run_page(report: &RunReport, run: &RunContent, folder: &Path) -> String {
    let plots = RunPlots::new(report, run);
    let has_failed = report.checks.iter().any(|check| check.status == Status::Fail);
    let body = html! {
        (header(report, folder))
        (without_script())
        @if has_failed {
            (what_failed(report, run, &plots.failed))
            (causes(report))
            (checks(report, run))
            (cases(report))
            (run.events.section(report))
            (folded("Everything else over time", &plots.others()))
            (folded("All joints", &joints(run, &plots.plots)))
        } @else {
            (cases(report))
            (checks(report, run))
            (causes(report))
            section { h2 { "The arm" } (scene(report, run)) }
            (run.events.section(report))
            section { h2 { "Over time" } (plots.others()) }
            section { h2 { "Joints" } (joints(run, &plots.plots)) }
        }
        (actuators(report))
        (provenance_of(report))
        (warnings(&report.warnings))
    };
    let title = format!("{}: {}", report.scenario, report.sentence());
    document(&title, &body, Some(&plots.plots), &report.inputs)
}

/// A part of the page that a reader opens.
fn folded(title: &str, content: &Markup) -> Markup {
    html! { details.part { summary { h2 { (title) } } (content) } }
}
