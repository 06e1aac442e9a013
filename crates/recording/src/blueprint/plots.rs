//! What all plots have in common: their ranges, and a legend in a free strip on the right, where no curve is.

use re_sdk_types::{
    blueprint::{
        archetypes::{PlotLegend, ScalarAxis, TimeAxis},
        components::{Corner2D, LinkAxis, TimeRange},
    },
    components::Range1D,
    datatypes::{TimeInt, TimeRange as Range, TimeRangeBoundary},
};

use super::tree::{LayoutNode, View};
use crate::rrd::times::nanoseconds;

/// Width of a plot in a window of 1600 pixels, in characters of a legend.
const PLOT_CHARACTERS: f64 = 105.0;
/// Width that a legend needs beside its longest name, in characters.
const LEGEND_CHARACTERS: f64 = 7.0;
/// The most of a plot that its legend takes.
const LARGEST_LEGEND: f64 = 0.45;
/// Free space around the curves, as a fraction of their range.
const MARGIN: f64 = 0.06;

/// The time axis of all plots: their times stand one above the other.
#[derive(Debug, Clone, Copy)]
pub(super) struct PlotFrame {
    duration_s: f64,
    /// The fraction of a plot's width that its legend needs.
    legend: f64,
}

impl PlotFrame {
    /// For a run of this duration and these names of curves.
    pub(super) fn new<'a>(duration_s: f64, names: impl Iterator<Item = &'a str>) -> Self {
        let longest = names.map(|name| name.chars().count()).max().unwrap_or(0);
        let longest = f64::from(u32::try_from(longest).unwrap_or(u32::MAX));
        let legend = ((longest + LEGEND_CHARACTERS) / PLOT_CHARACTERS).min(LARGEST_LEGEND);
        Self { duration_s, legend }
    }

    /// A plot of this range of values with a margin above and below; of whatever the curves need without one.
    pub(super) fn plot(&self, view: View, range: Option<(f64, f64)>) -> LayoutNode {
        let mut view = view.with("PlotLegend", &PlotLegend::new().with_corner(Corner2D::RightTop));
        let is_range = |&(low, high): &(f64, f64)| low.is_finite() && high.is_finite() && low < high;
        if let Some((low, high)) = range.filter(is_range) {
            let margin = MARGIN * (high - low);
            let axis = ScalarAxis::new().with_range(Range1D::new(low - margin, high + margin));
            view = view.with("ScalarAxis", &axis);
        }
        if self.duration_s > 0.0 {
            let boundary = |time_s: f64| TimeRangeBoundary::Absolute(TimeInt(nanoseconds(time_s)));
            // The axis goes on beyond the run by the width of the legend, which then covers no curve.
            let end_s = self.duration_s / (1.0 - self.legend);
            let range = Range { start: boundary(-0.01 * end_s), end: boundary(end_s) };
            let axis = TimeAxis::new().with_link(LinkAxis::Independent).with_view_range(TimeRange(range));
            view = view.with("TimeAxis", &axis);
        }
        view.into()
    }
}
