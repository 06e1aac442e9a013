//! The plots of a run: those of what failed, those of everything else, and sentences instead of plots of rounding.

use congruent_input::{Quantity, SiUnit, display::length};
use congruent_monitors::verdict::{CheckResult, Status};
use congruent_results::report::RunReport;
use maud::{Markup, html};

use super::{
    content::RunContent,
    curves::{PlottedCurve, clearance, errors, tracking, zones},
    failures::{FailedPlot, failed_plots},
    figures::FIGURES,
    joints,
};
use crate::{
    parts::plot,
    series::{Chart, ConstantPair, PlotMark, Plots},
};

/// All plots of a run, and which of them come first.
pub(super) struct RunPlots {
    pub(super) plots: Plots,
    /// The plots of what failed, the first violation first.
    pub(super) failed: Vec<FailedPlot>,
    /// What is not plotted, since it is rounding or never changes.
    unplotted: Vec<String>,
}

impl RunPlots {
    /// The plots, each once: what failed, then the others.
    pub(super) fn new(report: &RunReport, run: &RunContent) -> Self {
        let curves = [
            errors(Quantity::Position, report, run),
            errors(Quantity::Orientation, report, run),
            clearance(report, run).map(PlottedCurve::Plot),
            zones(report, run).map(PlottedCurve::Plot),
            tracking(SiUnit::Radian, report, run),
            tracking(SiUnit::Metre, report, run),
        ];
        let (mut charts, mut unplotted) = (Vec::<Chart>::new(), Vec::new());
        for curve in curves.into_iter().flatten() {
            match curve {
                PlottedCurve::Plot(chart) => charts.push(chart),
                PlottedCurve::Text(text) => unplotted.push(text),
            }
        }
        unplotted.extend(constant(run));
        let failed = failed_plots(report, run, &mut charts);
        charts.extend(joints::charts(run));
        charts.retain(|chart| !chart.lines.is_empty());
        let plots = Plots { times_s: run.series.times_s(), charts, marks: marks(report, run) };
        Self { plots, failed, unplotted }
    }

    fn has(&self, id: &str) -> bool {
        self.plots.charts.iter().any(|chart| chart.id == id)
    }

    /// Figures of the plots that are neither of single joints nor of what failed.
    pub(super) fn others(&self) -> Markup {
        let is_failed = |id: &str| self.failed.iter().any(|failed| failed.id == id);
        html! {
            @for (id, caption) in FIGURES {
                @if self.has(id) && !is_failed(id) { (plot(id, caption)) }
            }
            @if !self.unplotted.is_empty() {
                ul.unplotted { @for text in &self.unplotted { li { (text) } } }
            }
        }
    }
}

/// What a reader without the script sees instead of plots.
pub(super) fn without_script() -> Markup {
    html! {
        noscript { p.error { "The plots need JavaScript. All values of the tables are here without it." } }
        p #script-error hidden {}
    }
}

/// Pairs that are near and keep their distance: what comes near is plotted, they are not.
fn constant(run: &RunContent) -> Vec<String> {
    let nearest = &run.series.nearest;
    let constant = nearest.links.constant().into_iter().chain(nearest.obstacles.constant());
    let words = |of: ConstantPair| {
        let (pair, why) = (run.names.pairs.get(of.pair)?, nearest.why_constant(of.pair)?);
        Some(format!("{pair}: {}, {why}, not plotted.", length(of.distance_m)))
    };
    constant.filter_map(words).collect()
}

/// First violations, the stop, faults, grasps and payloads, and the starts of the motions.
fn marks(report: &RunReport, run: &RunContent) -> Vec<PlotMark> {
    let unnamed = |time_s: f64, kind: &'static str| PlotMark { time_s, text: String::new(), kind };
    let motions = report.motions.iter().map(|motion| unnamed(motion.starts_s, "motion"));
    let failed = report.checks.iter().filter(|check| check.status == Status::Fail);
    let violations = failed.filter_map(violation_s).map(|time_s| unnamed(time_s, "violation"));
    let stop = report.stopped.iter().map(|stop| PlotMark {
        time_s: stop.time_s,
        text: "stop".to_owned(),
        kind: "stop",
    });
    motions.chain(run.events.marks(report)).chain(violations).chain(stop).collect()
}

fn violation_s(check: &CheckResult) -> Option<f64> {
    let first = check.measures.iter().filter_map(|measure| measure.first_violation.as_ref());
    first.map(|moment| moment.time_s).min_by(f64::total_cmp)
}
