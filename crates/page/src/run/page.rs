//! The page of a run, section after section.

use std::path::Path;

use congruent_results::report::RunReport;
use maud::html;

use super::{
    actuators::actuators,
    checks::checks,
    content::RunContent,
    faults::what_is_wrong,
    header::{header, reproduction},
    joints::joints,
    over_time::{charts, over_time},
    scene::scene,
};
use crate::parts::{document, warnings};

/// The whole page. Other results of the run are in `folder`.
pub(super) fn run_page(report: &RunReport, run: &RunContent, folder: &Path) -> String {
    let plots = charts(report, run);
    let body = html! {
        (header(report, folder))
        (what_is_wrong(report))
        (checks(report))
        (scene(report, run))
        (over_time(&plots))
        (joints(run, &plots))
        (actuators(report))
        (reproduction(report))
        (warnings(&report.warnings))
    };
    document(&format!("{}: {}", report.scenario, report.sentence()), &body, Some(&plots))
}
