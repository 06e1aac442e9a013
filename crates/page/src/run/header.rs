//! The top of the page, verdict and files, and its end: how to run the same again.

use std::{fmt::Write, path::Path};

use congruent_input::{
    display::{counted, listed, quantity},
    serde_name,
};
use congruent_monitors::verdict::{Status, Verdict};
use congruent_results::{
    files::CASES,
    report::{RunReport, SourceReport, lines, quantity_words, verdict_word},
};
use maud::{Markup, html};

use super::tightest::{Tightest, tightest};
use crate::parts::{BadgeKind, Pointer, Provenance, badge, capitalised, count, provenance, value};

/// Files of the results that may be there, with what they are. The first two are written before the page.
const FILES: [(&str, &str); 8] = [
    ("recording.rrd", "recording for the rerun viewer"),
    ("trajectory.csv", "every sample as a table"),
    ("trajectory.parquet", "every sample as a table"),
    ("trajectory.mcap", "every sample as a log of ROS 2"),
    (CASES, "a row for each case"),
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
        Verdict::NothingChecked | Verdict::NotEnoughCases => BadgeKind::Unclear,
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
            p.kind { (if report.source.is_some() { "Log of a robot" } else { "Run of a scenario" }) }
            h1 { (report.scenario) }
            p.verdict { (badge(outcome, word)) " " span.sentence { (sentence(report)) "." } }
            @if let Some(error) = &report.error { p.error { (error) } }
            @if let Some(proved) = proved(report) { p { (proved) } }
            dl.facts {
                dt { "robot" } dd { (report.robot) }
                @if let Some(file) = &report.scenario_file { dt { "scenario file" } dd { code { (file) } } }
                @if let Some(source) = &report.source { (log(source)) }
                dt { (if report.source.is_some() { "recorded" } else { "simulated" }) }
                dd {
                    (value(&at.key("duration_s"), clock.duration_s, &quantity(clock.duration_s, "s"))) " in "
                    (count(&at.key("steps"), clock.steps)) " steps of "
                    (value(&at.key("step_s"), clock.step_s, &quantity(clock.step_s, "s")))
                    @if report.source.is_some() { " as a rule" }
                }
                @if report.source.is_none() {
                    dt { "seed" } dd { (count(&Pointer::root().key("seed"), report.seed)) }
                }
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

/// What was taken of a log, and how its poses were corrected before they were compared.
fn log(source: &SourceReport) -> Markup {
    let topics = source.joints.iter().map(|topic| {
        let what = if topic.is_setpoint { "commanded" } else { "measured" };
        format!("{} ({what}, {} joints)", topic.topic, topic.joints.len())
    });
    let poses = source.poses.iter().map(|poses| {
        let fitted = if poses.frames_are_fitted { ", frames fitted to the log" } else { "" };
        let offset = quantity(poses.offset_s * 1e3, "ms");
        let clock =
            if poses.offset_s == 0.0 { String::new() } else { format!(", times corrected by {offset}") };
        format!("{} ({}{fitted}{clock})", poses.name, serde_name(&poses.origin))
    });
    html! {
        dt { "log" } dd { code { (source.log) } }
        dt { "joint states" } dd { (topics.collect::<Vec<_>>().join("; ")) }
        @if !source.held.is_empty() { dt { "not in the log" } dd { (source.held.join(", ")) } }
        @if !source.poses.is_empty() { dt { "poses" } dd { (poses.collect::<Vec<_>>().join("; ")) } }
    }
}

/// The verdict in a sentence: of checks that failed which they are, and what the first one has found.
pub(crate) fn sentence(report: &RunReport) -> String {
    if report.uncertainty.is_some() {
        return capitalised(&report.sentence());
    }
    let failed = report.checks_failed_first().into_iter().filter(|check| check.status == Status::Fail);
    let failed: Vec<_> = failed.collect();
    let found = failed.first().and_then(|first| Some((first.check, lines(first).into_iter().next()?)));
    let Some((first, found)) = found else { return capitalised(&report.sentence()) };
    match &failed[..] {
        _ if report.verdict != Verdict::NotAsExpected => {
            format!("{}: {found}", capitalised(&report.sentence()))
        }
        [_] => format!("The check {first} fails: {found}"),
        several => {
            let names: Vec<String> = several.iter().map(|check| check.check.to_string()).collect();
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            format!("The checks {} fail; {first}: {found}", listed(&names))
        }
    }
}

/// What a run without a violation shows, in two sentences: how much was checked, and what is nearest to its limit.
fn proved(report: &RunReport) -> Option<String> {
    let conclusive = || report.checks.iter().filter(|check| check.status.is_conclusive());
    if conclusive().next().is_none() || conclusive().any(|check| check.status != Status::Pass) {
        return None;
    }
    let measures = conclusive().map(|check| check.measures.len()).sum::<usize>();
    let samples = conclusive().map(|check| check.samples).max().unwrap_or_default();
    let quantities = if measures == 1 { "quantity is" } else { "quantities are" };
    // What the run with nominal values shows is no comfort if its cases fail.
    if report.uncertainty.is_some() && report.verdict != Verdict::AsExpected {
        return None;
    }
    let with = if report.uncertainty.is_some() { "With nominal values " } else { "" };
    let mut text = format!(
        "{with}{measures} {quantities} within the limits, in {} at {samples} samples.",
        counted(conclusive().count(), "check")
    );
    if let Some(nearest) = tightest(report) {
        let Tightest { check, measure, worst, .. } = &nearest;
        let (subject, what) = (&worst.subject, quantity_words(measure.quantity));
        let _ = write!(text, " Nearest to its limit: {what} of {subject} ({check}), {}.", nearest.words());
    }
    Some(text)
}

/// The command that repeats the run, the inputs with their digests, the versions, and the hash of the trajectory.
pub(super) fn provenance_of(report: &RunReport) -> Markup {
    provenance(&Provenance {
        command: Some(report.command()),
        inputs: report.inputs.iter().collect(),
        remarks: vec![
            html! { "physics " (report.versions.physics) },
            html! { "a repeated run gives the same trajectory, SHA-256 " code.hash { (report.trajectory_sha256) } },
        ],
    })
}
