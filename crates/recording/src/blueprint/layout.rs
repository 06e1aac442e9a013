//! The layout of the viewer: the three-dimensional view on the left with the statuses of the checks below it;
//! on the right the plots, that of what failed first, and the summary and the events below them.

use congruent_agreement::compare::PoseSource;
use congruent_description::RobotDescription;
use congruent_input::{Quantity, SiUnit};
use congruent_kinematics::PoseError;
use congruent_monitors::{
    Names, RecordingError,
    verdict::{CheckResult, Measure, Status},
};
use congruent_results::report::{RunReport, quantity_words};
use congruent_scenario::CheckKind;
use re_sdk_types::{
    blueprint::{
        archetypes::{
            Background, EyeControls3D, LineGrid3D, PanelBlueprint, TimePanelBlueprint, ViewportBlueprint,
        },
        components::{
            AbsoluteTimeRange, AutoLayout, AutoViews, BackgroundKind, LoopMode, PanelState, PlayState,
            RootContainer,
        },
    },
    datatypes::{AbsoluteTimeRange as Range, TimeInt},
};

use super::{
    joints::JointPlots,
    plots::PlotFrame,
    texts::{events, statuses},
    tree::{BlueprintWriter, LayoutNode, View},
};
use crate::{
    outcome::{
        joint_limits::NearLimit,
        measures::{first_violation, first_violation_s, measures_of_kind},
    },
    rrd::{
        convert::vector,
        paths,
        times::{SIM_TIME, nanoseconds},
        writer::RrdWriter,
    },
    scene::{camera::Camera, palette},
    series::{checks::path_parts, extents::Extents},
};

/// Spacing of the grid lines.
const GRID_M: f32 = 0.1;
/// Upper end of the clearance plot, as a multiple of the limit or of the largest minimum distance.
const CLEARANCE_RANGE: f64 = 3.0;
/// Duration of the tool's trail.
const TRAIL_S: f64 = 2.0;
/// Height of a window of 1600 x 900 pixels without its bars, and of the lanes of the checks in it.
const WINDOW_PIXELS: f32 = 840.0;
const LANE_PIXELS: f32 = 40.0;
const LANES_HEAD_PIXELS: f32 = 66.0;
/// Height of the summary.
const SUMMARY_PIXELS: f32 = 235.0;
/// Heights of a line of a legend, and of a plot without one.
const LEGEND_LINE_PIXELS: f32 = 23.0;
const PLOT_PIXELS: f32 = 80.0;
/// The fewest and the most curves for which there is room.
const CURVES: (usize, usize) = (4, 7);
/// The fewest and the most lanes that are in the picture.
const LANES: (usize, usize) = (3, 9);
/// Height of the plots of what failed, at the top.
const FAILED_PIXELS: f32 = 240.0;
/// The most links with a curve of their own: the worst, as in the page.
const MAX_LINKS: usize = 5;
/// Time that is played before and after a violation.
const AROUND_VIOLATION_S: f64 = 0.5;

/// Inputs of the viewer's layout.
#[derive(Debug)]
pub(crate) struct ViewerLayout<'a> {
    /// The robot of the run, whose table decides which links have curves.
    pub(crate) description: &'a RobotDescription,
    /// The names of its links, joints and pairs.
    pub(crate) names: &'a Names,
    /// The results of the run.
    pub(crate) report: &'a RunReport,
    /// Whether the scene has obstacles.
    pub(crate) has_obstacles: bool,
    /// The camera of the three-dimensional view.
    pub(crate) camera: Camera,
    /// The smallest and the largest minimum distance; `None` if there is no pair.
    pub(crate) clearance_m: Option<(f64, f64)>,
    /// Smallest and largest distance from the zones; `None` without zones.
    pub(crate) zones_m: Option<(f64, f64)>,
    /// Names of the curves of distances.
    pub(crate) distance_curves: &'a [String],
    /// Ranges of the values of all joints, and the largest errors of all links.
    pub(crate) extents: &'a Extents,
    /// Limits of joints that their values came near to.
    pub(crate) near_limits: &'a [NearLimit],
    /// The quantities of checks that are recorded, by the parts of their paths.
    pub(crate) recorded: &'a [[String; 2]],
    /// Whether a limit is violated at the end of the run.
    pub(crate) ends_in_violation: bool,
}

impl ViewerLayout<'_> {
    /// Writes the layout into the open store.
    pub(crate) fn write(&self, writer: &mut RrdWriter) -> Result<(), RecordingError> {
        let mut layout = BlueprintWriter::new(writer);
        let root = layout.node(&self.root())?;
        let viewport = ViewportBlueprint::new()
            .with_root_container(RootContainer(root.into()))
            .with_auto_layout(AutoLayout(false.into()))
            .with_auto_views(AutoViews(false.into()));
        layout.log("viewport", &viewport)?;
        let time = self.time_panel();
        layout.log("time_panel", &time)?;
        for panel in ["blueprint_panel", "selection_panel"] {
            layout.log(panel, &PanelBlueprint::new().with_state(PanelState::Hidden))?;
        }
        Ok(())
    }

    /// Opens a failed run where its violation is: at the end if it lasts until then, otherwise playing around it. A layout
    /// cannot set the time cursor.
    fn time_panel(&self) -> TimePanelBlueprint {
        let panel = TimePanelBlueprint::new().with_timeline(SIM_TIME).with_state(PanelState::Collapsed);
        let end_s = self.report.simulation.duration_s;
        let Some(violation_s) = first_violation_s(self.report) else {
            let state = if self.report.error.is_some() { PlayState::Following } else { PlayState::Paused };
            return panel.with_play_state(state);
        };
        if self.ends_in_violation || self.report.error.is_some() {
            return panel
                .with_time_selection(selection(violation_s, end_s))
                .with_play_state(PlayState::Following);
        }
        let (from_s, to_s) = (violation_s - AROUND_VIOLATION_S, violation_s + AROUND_VIOLATION_S);
        panel
            .with_time_selection(selection(from_s.max(0.0), to_s.min(end_s)))
            .with_loop_mode(LoopMode::Selection)
            .with_play_state(PlayState::Playing)
    }

    fn root(&self) -> LayoutNode {
        let lanes = self.lanes_pixels();
        let left = LayoutNode::Rows(vec![(WINDOW_PIXELS - lanes, self.scene()), (lanes, statuses())]);
        let mut right = self.plots();
        let summary = View::new("TextDocument", "Summary", paths::summary());
        right.push((SUMMARY_PIXELS, LayoutNode::Columns(vec![(1.0, summary.into()), (1.0, events())])));
        LayoutNode::Columns(vec![(1.0, left), (1.0, LayoutNode::Rows(right))])
    }

    /// The plots from top to bottom, with their heights: what was violated first is at the top. Errors within their tolerance,
    /// most often rounding, are behind the distances.
    fn plots(&self) -> Vec<(f32, LayoutNode)> {
        let (mut failed, mut agreement) = (self.failed_plots(), self.agreement());
        let (mut behind, mut distance_row) = (Vec::new(), self.distances());
        let first = self.first_violated();
        let mut rows = Vec::new();
        if !first.is_some_and(has_own_plot) {
            rows.extend(in_tabs(std::mem::take(&mut failed)).map(|tabs| (FAILED_PIXELS, tabs)));
        }
        if self.is_violated(CheckKind::Agreement) {
            rows.extend(in_tabs(agreement).map(|tabs| (self.agreement_pixels(), tabs)));
        } else if distance_row.is_empty() {
            behind.append(&mut agreement);
        } else {
            distance_row.append(&mut agreement);
        }
        rows.extend(in_tabs(distance_row).map(|tabs| (self.distances_pixels(), tabs)));
        if first.is_some_and(|kind| kind != CheckKind::Agreement && has_own_plot(kind)) {
            // The distances, above errors that came outside their tolerance later.
            rows.rotate_right(1);
        }
        let joints = failed.into_iter().chain(self.joints()).chain(behind).collect();
        if let Some(joints) = in_tabs(joints) {
            // The joints get the height that errors, distances and summary do not need.
            let others: f32 = rows.iter().map(|(pixels, _)| pixels).sum();
            rows.push((WINDOW_PIXELS - SUMMARY_PIXELS - others, joints));
        }
        rows
    }

    /// The kind of the check that was violated first.
    fn first_violated(&self) -> Option<CheckKind> {
        let violated =
            self.report.checks.iter().filter_map(|check| Some((check.check, first_violation(check)?.1)));
        violated.min_by(|(_, a), (_, b)| a.time_s.total_cmp(&b.time_s)).map(|(kind, _)| kind)
    }

    fn is_violated(&self, kind: CheckKind) -> bool {
        measures_of_kind(self.report, kind).any(|measure| measure.first_violation.is_some())
    }

    /// Height of the plot of errors: with a curve for each link if they are outside their tolerance.
    fn agreement_pixels(&self) -> f32 {
        plot_pixels(if self.is_violated(CheckKind::Agreement) { self.shown_links().count() + 1 } else { 0 })
    }

    /// Height of the plot of distances.
    fn distances_pixels(&self) -> f32 {
        plot_pixels(self.distance_curves.len())
    }

    /// The axes of all plots.
    fn frame(&self) -> PlotFrame {
        let names = self.names.joints.iter().map(String::as_str);
        let links = self.shown_links().map(|link| self.names.links[link].as_str());
        let names = names.chain(links).chain(self.distance_curves.iter().map(String::as_str));
        PlotFrame::new(self.report.simulation.duration_s, names.chain(["orientation tolerance"]))
    }

    fn scene(&self) -> LayoutNode {
        let eye = EyeControls3D::new()
            .with_position(vector(&self.camera.eye_in_world.coords))
            .with_look_target(vector(&self.camera.target_in_world.coords))
            .with_eye_up([0.0, 0.0, 1.0]);
        let [r, g, b] = palette::BACKGROUND;
        let background = Background::new(BackgroundKind::SolidColor).with_color([r, g, b]);
        let grid = LineGrid3D::new().with_visible(true).with_spacing(GRID_M);
        View::new("3D", "Twin, with the model as a ghost", paths::world())
            .with("EyeControls3D", &eye)
            .with("Background", &background)
            .with("LineGrid3D", &grid)
            .with_trail(paths::trail(), TRAIL_S)
            .hiding(paths::frames())
            .into()
    }

    /// Height of the status lanes: all that failed are in the picture, in front of the others.
    fn lanes_pixels(&self) -> f32 {
        let failed = self.report.checks.iter().filter(|check| has_failed(check)).count();
        let (fewest, most) = LANES;
        let lanes = self.report.checks.len().min(failed.max(fewest)).min(most);
        LANES_HEAD_PIXELS + LANE_PIXELS * f32::from(u8::try_from(lanes.max(1)).unwrap_or(u8::MAX))
    }

    /// Plots of errors in tabs: in front the plot with a violated limit, or the logarithms of the largest
    /// errors.
    fn agreement(&self) -> Vec<LayoutNode> {
        let of = |quantity: Quantity| {
            measures_of_kind(self.report, CheckKind::Agreement)
                .find(move |measure| measure.quantity == quantity)
        };
        let frame = self.frame();
        let view = |quantity: Quantity, name: &str, fallback: f64| {
            let limit = of(quantity).map_or(fallback, |measure| measure.limit);
            let worst =
                of(quantity).and_then(|measure| measure.worst.as_ref()).map_or(0.0, |worst| worst.value);
            let links = self
                .shown_links()
                .map(|link| paths::path(&["agreement", quantity.name(), &self.names.links[link]]));
            let tolerance = paths::path(&["agreement", quantity.name(), "tolerance"]);
            let view = View::new("TimeSeries", name, paths::path(&["agreement", quantity.name()]));
            frame.plot(view.only(links.chain([tolerance])), Some((0.0, limit.max(worst))))
        };
        let worst =
            View::new("TimeSeries", "Largest errors [power of ten]", paths::path(&["agreement", "worst"]));
        let tolerance = self.description.tolerance;
        let mut tabs = vec![
            frame.plot(worst, None),
            view(Quantity::Position, "Position errors [m]", tolerance.position_m),
            view(Quantity::Orientation, "Orientation errors [rad]", tolerance.orientation_rad),
        ];
        let violated = [Quantity::Position, Quantity::Orientation]
            .into_iter()
            .position(|quantity| of(quantity).is_some_and(|measure| measure.first_violation.is_some()));
        if let Some(violated) = violated {
            // The violated plot to the front; the others keep their order behind it.
            tabs[..=violated + 1].rotate_right(1);
        }
        tabs
    }

    /// The links with the largest errors, in the robot's order: of those that the table moves, if there is one.
    fn shown_links(&self) -> impl Iterator<Item = usize> {
        let limits = self.description.tolerance;
        let ratio = |error: &PoseError| {
            (error.position_m / limits.position_m).max(error.orientation_rad / limits.orientation_rad)
        };
        let errors = &self.extents.links;
        let is_of_table = |link: &usize| self.report.links[*link].source != PoseSource::Urdf;
        let mut links: Vec<usize> = (0..errors.len()).filter(is_of_table).collect();
        if links.is_empty() {
            links = (0..errors.len()).collect();
        }
        // The largest relative to their tolerance, then in the order of the robot again, which the colours follow.
        links.sort_by(|&a, &b| ratio(&errors[b]).total_cmp(&ratio(&errors[a])));
        links.truncate(MAX_LINKS);
        links.sort_unstable();
        links.into_iter()
    }

    /// Plots of distances, a violated one in front; none if there is nothing to be near to.
    fn distances(&self) -> Vec<LayoutNode> {
        let frame = self.frame();
        let is_checked = [CheckKind::Clearance, CheckKind::Contact]
            .into_iter()
            .any(|kind| measures_of_kind(self.report, kind).next().is_some());
        let clearance = self.clearance_m.filter(|_| is_checked || self.has_obstacles).map(|(low, high)| {
            let limit = measures_of_kind(self.report, CheckKind::Clearance)
                .map(|measure| measure.limit)
                .fold(0.0, f64::max);
            let view = View::new("TimeSeries", "Clearance [m]", paths::path(&["clearance"]));
            // From 0 or the deepest overlap to somewhat above what matters: distances of metres would flatten the
            // curve at the limit.
            frame.plot(view, Some((low.min(0.0), CLEARANCE_RANGE * high.max(limit))))
        });
        let zones = self.zones_m.map(|(low, high)| {
            let view = View::new("TimeSeries", "Distances from zones [m]", paths::path(&["zone"]));
            frame.plot(view, Some((low.min(0.0), high)))
        });
        let mut tabs: Vec<LayoutNode> = clearance.into_iter().chain(zones).collect();
        if self.is_violated(CheckKind::Zone) && !self.is_violated(CheckKind::Clearance) {
            tabs.reverse();
        }
        tabs
    }

    /// Plots of the joints.
    fn joints(&self) -> Vec<LayoutNode> {
        let plots = JointPlots {
            robot: &self.description.robot,
            names: self.names,
            extents: &self.extents.joints,
            limits: self.near_limits,
            frame: self.frame(),
        };
        plots.all()
    }

    /// What checks without a plot of their own have measured outside a limit, the first violation first.
    fn failed_plots(&self) -> Vec<LayoutNode> {
        let checks = self.report.checks.iter().enumerate().filter(|(_, check)| !has_own_plot(check.check));
        let violated = checks.flat_map(|(number, check)| {
            check.measures.iter().filter_map(move |measure| {
                Some((measure.first_violation.as_ref()?.time_s, number, check.check, measure))
            })
        });
        let mut violated: Vec<(f64, usize, CheckKind, &Measure)> = violated.collect();
        violated.sort_by(|(a, ..), (b, ..)| a.total_cmp(b));
        // Pairs of a check share one plot; sorted by time, so that the first of each is kept.
        violated.dedup_by_key(|&mut (_, number, _, measure)| (number, measure.quantity));
        let frame = self.frame();
        let plot = |(_, number, kind, measure): (f64, usize, CheckKind, &Measure)| {
            let parts = path_parts(number, kind, measure.quantity, measure.unit);
            // A quantity that is known only at the end of the run has no series to plot.
            if !self.recorded.contains(&parts) {
                return None;
            }
            let [check, quantity] = parts;
            let unit = if measure.unit == SiUnit::Ratio { "1" } else { measure.unit.symbol() };
            let title = format!("{kind}: {} [{unit}]", quantity_words(measure.quantity));
            let entities = [paths::check(&check, &quantity), paths::check_limit(&check, &quantity)];
            Some(frame.plot(View::new("TimeSeries", title, paths::path(&[])).only(entities), None))
        };
        violated.into_iter().filter_map(plot).collect()
    }
}

/// Whether a check is in the plots of errors or of distances, whatever its result is.
fn has_own_plot(kind: CheckKind) -> bool {
    matches!(kind, CheckKind::Agreement | CheckKind::Clearance | CheckKind::Contact | CheckKind::Zone)
}

/// Nodes one behind another; `None` if there is none.
fn in_tabs(mut nodes: Vec<LayoutNode>) -> Option<LayoutNode> {
    if nodes.len() > 1 { Some(LayoutNode::Tabs(nodes)) } else { nodes.pop() }
}

/// Height of a plot with this number of curves, so that its whole legend is visible.
fn plot_pixels(curves: usize) -> f32 {
    let (fewest, most) = CURVES;
    let curves = u8::try_from(curves.clamp(fewest, most)).unwrap_or(u8::MAX);
    PLOT_PIXELS + LEGEND_LINE_PIXELS * f32::from(curves)
}

fn has_failed(check: &CheckResult) -> bool {
    matches!(check.status, Status::Fail | Status::Error)
}

/// A range of time.
fn selection(from_s: f64, to_s: f64) -> AbsoluteTimeRange {
    let time = |time_s: f64| TimeInt(nanoseconds(time_s));
    AbsoluteTimeRange(Range { min: time(from_s), max: time(to_s) })
}
