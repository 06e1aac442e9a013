//! The top of the page, verdict and files, and its end: how to run the same again.

use std::path::Path;

use congruent_input::display::quantity;
use congruent_monitors::verdict::Verdict;
use congruent_results::report::{RunReport, verdict_word};
use maud::{Markup, html};

use crate::parts::{BadgeKind, Pointer, badge, capitalised, count, value};

/// Files of the results that may be there, with what they are. The first two are written before the page.
const FILES: [(&str, &str); 6] = [
    ("recording.rrd", "recording for the rerun viewer"),
    ("trajectory.csv", "every sample as a table"),
    ("trajectory.parquet", "every sample as a table"),
    ("report.json", "all values of this page"),
    ("junit.xml", "the checks as test cases"),
    ("scenario.resolved.toml", "the scenario with every default written out"),
];
/// Files of the results that are written after the page.
const LATER: [&str; 2] = ["report.json", "junit.xml"];

/// Whether a run went well, in a word.
pub(crate) fn outcome(report: &RunReport) -> (BadgeKind, &'static str) {
    let outcome = match report.verdict {
        Verdict::AsExpected => BadgeKind::Good,
        Verdict::NotAsExpected | Verdict::Broken => BadgeKind::Bad,
        Verdict::NothingChecked => BadgeKind::Unclear,
    };
    (outcome, verdict_word(report.verdict))
}

/// Name, verdict, what was run, and the files beside the page.
pub(super) fn header(report: &RunReport, folder: &Path) -> Markup {
    let (outcome, word) = outcome(report);
    let (clock, at) = (report.simulation, Pointer::root().key("simulation"));
    // Those files do not exist yet, but will when the page is read.
    let is_there = |name: &str| LATER.contains(&name) || folder.join(name).exists();
    html! {
        header {
            p.kind { "Run of a scenario" }
            h1 { (report.scenario) }
            p.verdict { (badge(outcome, word)) " " span.sentence { (capitalised(&report.sentence())) "." } }
            @if let Some(error) = &report.error { p.error { (error) } }
            dl.facts {
                dt { "robot" } dd { (report.robot) }
                dt { "simulated" }
                dd {
                    (value(&at.key("duration_s"), clock.duration_s, &quantity(clock.duration_s, "s"))) " in "
                    (count(&at.key("steps"), clock.steps)) " steps of "
                    (value(&at.key("step_s"), clock.step_s, &quantity(clock.step_s, "s")))
                }
                dt { "seed" } dd { (count(&Pointer::root().key("seed"), report.seed)) }
                @if let Some(stop) = &report.stopped {
                    dt { "stopped" }
                    dd {
                        "by check " (stop.check) " after "
                        (value(&Pointer::root().keys(&["stopped", "time_s"]), stop.time_s, &quantity(stop.time_s, "s")))
                    }
                }
            }
            nav.files {
                @for (name, what) in FILES.iter().filter(|(name, _)| is_there(name)) {
                    a href=(name) title=(what) { (name) }
                }
            }
        }
    }
}

/// The command that repeats the run, the versions, and the hash of the trajectory.
pub(super) fn reproduction(report: &RunReport) -> Markup {
    html! {
        section {
            h2 { "The same again" }
            pre.command { (report.command()) }
            p.small {
                "congruent " (report.versions.congruent) ", physics " (report.versions.physics)
                "; a repeated run gives the same trajectory, SHA-256 " code.hash { (report.trajectory_sha256) }
            }
        }
    }
}
