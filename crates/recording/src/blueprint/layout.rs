//! The layout of the viewer: the three-dimensional view on the left with the statuses of the checks below it;
//! on the right the plots, and the summary and the events below them.

use congruent_description::{JointKind, RobotDescription};
use congruent_twin::{monitor::Names, recorder::RecordingError, report::RunReport};
use re_sdk_types::{
    blueprint::{
        archetypes::{
            Background, EyeControls3D, LineGrid3D, PanelBlueprint, PlotLegend, ScalarAxis, TextLogColumns,
            TimePanelBlueprint, ViewportBlueprint,
        },
        components::{
            AbsoluteTimeRange, AutoLayout, AutoViews, BackgroundKind, Corner2D, PanelState, PlayState,
            RootContainer, TextLogColumn,
        },
        datatypes::{TextLogColumn as Column, TextLogColumnKind},
    },
    components::Range1D,
    datatypes::{AbsoluteTimeRange as Range, TimeInt},
};

use super::tree::{BlueprintWriter, LayoutNode, View};
use crate::{
    outcome::measures::{first_violation_s, of_kind},
    rrd::{
        convert::vector,
        paths,
        times::{SIM_TIME, nanoseconds},
        writer::RrdWriter,
    },
    scene::{camera::Camera, palette},
};

/// Spacing of the grid lines.
const GRID_M: f32 = 0.1;
/// Upper end of the clearance plot, as a multiple of the limit or of the largest minimum distance.
const CLEARANCE_RANGE: f64 = 3.0;
/// Duration of the tool's trail.
const TRAIL_S: f64 = 2.0;

/// What the viewer's layout depends on.
#[derive(Debug)]
pub(crate) struct ViewerLayout<'a> {
    /// The robot.
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
        let mut time = TimePanelBlueprint::new()
            .with_timeline(SIM_TIME)
            .with_state(PanelState::Collapsed)
            .with_play_state(PlayState::Paused);
        if let Some(violation_s) = first_violation_s(self.report) {
            time = time.with_time_selection(selection(violation_s, self.report.simulation.duration_s));
        }
        layout.log("time_panel", &time)?;
        for panel in ["blueprint_panel", "selection_panel"] {
            layout.log(panel, &PanelBlueprint::new().with_state(PanelState::Hidden))?;
        }
        Ok(())
    }

    fn root(&self) -> LayoutNode {
        let left = LayoutNode::Rows(vec![(5.0, self.scene()), (self.status_height(), statuses())]);
        let mut right = vec![(2.6, self.agreement())];
        if self.has_clearance() {
            right.push((2.2, self.clearance()));
        }
        if let Some(joints) = self.joints() {
            right.push((2.0, joints));
        }
        let summary = View::new("TextDocument", "Summary", paths::summary());
        right.push((3.2, LayoutNode::Columns(vec![(3.0, summary.into()), (2.0, events())])));
        LayoutNode::Columns(vec![(1.0, left), (1.0, LayoutNode::Rows(right))])
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
            .into()
    }

    /// Height of the status lanes in units in which the three-dimensional view has 5.
    fn status_height(&self) -> f32 {
        let lanes = u8::try_from(self.report.checks.len()).unwrap_or(u8::MAX);
        0.5 + 0.25 * f32::from(lanes.min(8))
    }

    /// Plots of errors in tabs: in front the plot with a violated limit, or the logarithms of the largest
    /// errors.
    fn agreement(&self) -> LayoutNode {
        let of = |quantity: &'static str| {
            of_kind(self.report, "agreement").find(move |measure| measure.quantity == quantity)
        };
        let view = |quantity: &'static str, name: &str, fallback: f64| {
            let limit = of(quantity).map_or(fallback, |measure| measure.limit);
            let worst =
                of(quantity).and_then(|measure| measure.worst.as_ref()).map_or(0.0, |worst| worst.value);
            let view = View::new("TimeSeries", name, paths::path(&["agreement", quantity]));
            plot(view, (0.0, limit.max(worst)))
        };
        let worst =
            View::new("TimeSeries", "Largest errors [power of ten]", paths::path(&["agreement", "worst"]));
        let tolerance = self.description.tolerance;
        let mut tabs = vec![
            worst.with("PlotLegend", &legend()).into(),
            view("position", "Position errors [m]", tolerance.position_m),
            view("orientation", "Orientation errors [rad]", tolerance.orientation_rad),
        ];
        let violated = ["position", "orientation"]
            .into_iter()
            .position(|quantity| of(quantity).is_some_and(|measure| measure.first_violation.is_some()));
        if let Some(violated) = violated {
            tabs[..=violated + 1].rotate_right(1);
        }
        LayoutNode::Tabs(tabs)
    }

    /// Whether to show the clearance plot: distances were recorded, and there is a limit or an obstacle.
    fn has_clearance(&self) -> bool {
        let is_checked = of_kind(self.report, "clearance").next().is_some();
        self.clearance_m.is_some() && (is_checked || self.has_obstacles)
    }

    fn clearance(&self) -> LayoutNode {
        let (low, high) = self.clearance_m.unwrap_or((0.0, 1.0));
        let limit = of_kind(self.report, "clearance").map(|measure| measure.limit).fold(0.0, f64::max);
        let view = View::new("TimeSeries", "Clearance [m]", paths::path(&["clearance"]));
        plot(view, (low.min(0.0), CLEARANCE_RANGE * high.max(limit)))
    }

    /// Joint positions, with one plot for each unit; `None` without joints.
    fn joints(&self) -> Option<LayoutNode> {
        let robot = &self.description.robot;
        let of_unit = |is_length: bool| {
            let movable = self.names.joints.iter().zip(robot.movable_joints());
            movable
                .filter(|&(_, &joint)| (robot.joint(joint).kind == JointKind::Prismatic) == is_length)
                .map(|(name, _)| paths::joint_position(name))
                .collect::<Vec<_>>()
        };
        let view = |unit: &str, joints: Vec<_>| {
            let title = format!("Joint positions [{unit}]");
            let view = View::new("TimeSeries", title, paths::path(&["joint", "position"])).only(joints);
            view.with("PlotLegend", &legend()).into()
        };
        let mut views: Vec<LayoutNode> = [("rad", of_unit(false)), ("m", of_unit(true))]
            .into_iter()
            .filter(|(_, joints)| !joints.is_empty())
            .map(|(unit, joints)| view(unit, joints))
            .collect();
        match views.len() {
            0 => None,
            1 => views.pop(),
            _ => Some(LayoutNode::Tabs(views)),
        }
    }
}

fn statuses() -> LayoutNode {
    View::new("StateTimeline", "Checks", paths::path(&["status"])).into()
}

fn events() -> LayoutNode {
    let column = |kind: TextLogColumnKind, is_visible: bool| {
        TextLogColumn(Column { visible: is_visible.into(), kind })
    };
    let columns = TextLogColumns::new().with_text_log_columns([
        column(TextLogColumnKind::EntityPath, false),
        column(TextLogColumnKind::LogLevel, false),
        column(TextLogColumnKind::Body, true),
    ]);
    View::new("TextLog", "Events", paths::log()).with("TextLogColumns", &columns).into()
}

/// A legend on the left, since the values change least at the start of a run.
fn legend() -> PlotLegend {
    PlotLegend::new().with_corner(Corner2D::LeftTop)
}

/// A plot of this range with a margin above and below.
fn plot(view: View, (low, high): (f64, f64)) -> LayoutNode {
    let margin = 0.06 * (high - low);
    let range = if margin.is_finite() && margin > 0.0 {
        Range1D::new(low - margin, high + margin)
    } else {
        Range1D::new(0.0, 1.0)
    };
    view.with("ScalarAxis", &ScalarAxis::new().with_range(range)).with("PlotLegend", &legend()).into()
}

/// The time range from the first violation to the end. A layout cannot set the time cursor.
fn selection(from_s: f64, to_s: f64) -> AbsoluteTimeRange {
    let time = |time_s: f64| TimeInt(nanoseconds(time_s));
    AbsoluteTimeRange(Range { min: time(from_s), max: time(to_s) })
}
