//! How a recording looks when it is opened: the robot on the left with the lanes of verdicts
//! below, the plots on the right, below them what came out.

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

use crate::{
    body::vector,
    camera::Camera,
    node::{LayoutWriter, Node, View},
    outcome::{first_violation_s, measures},
    palette, paths,
    times::{SIM_TIME, nanoseconds},
    writer::RrdWriter,
};

/// Lines of the grid, m.
const GRID_M: f32 = 0.1;
/// Distances are plotted up to so many times the largest that counts: above, nothing is near.
const PLOTTED: f64 = 3.0;
/// Length of the tool's trail, s.
const TRAIL_S: f64 = 2.0;

/// What the layout depends on.
#[derive(Debug)]
pub(super) struct Layout<'a> {
    /// The robot.
    pub(super) description: &'a RobotDescription,
    /// Its names.
    pub(super) names: &'a Names,
    /// What came out.
    pub(super) report: &'a RunReport,
    /// Whether anything stands around.
    pub(super) has_obstacles: bool,
    /// Where the camera stands.
    pub(super) camera: Camera,
    /// The smallest and the largest minimum distance; `None` where there is no pair.
    pub(super) clearance_m: Option<(f64, f64)>,
}

impl Layout<'_> {
    /// Writes the layout into the store that is open.
    pub(super) fn write(&self, writer: &mut RrdWriter) -> Result<(), RecordingError> {
        let mut layout = LayoutWriter::new(writer);
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

    fn root(&self) -> Node {
        let left = Node::Rows(vec![(5.0, self.scene()), (self.lanes_share(), lanes())]);
        let mut right = vec![(2.6, self.agreement())];
        if self.has_clearance() {
            right.push((2.2, self.clearance()));
        }
        if let Some(joints) = self.joints() {
            right.push((2.0, joints));
        }
        let summary = View::new("TextDocument", "Summary", paths::summary());
        right.push((3.2, Node::Columns(vec![(3.0, summary.into()), (2.0, events())])));
        Node::Columns(vec![(1.0, left), (1.0, Node::Rows(right))])
    }

    fn scene(&self) -> Node {
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

    /// Height of the lanes, in which the scene has 5.
    fn lanes_share(&self) -> f32 {
        let lanes = u8::try_from(self.report.checks.len()).unwrap_or(u8::MAX);
        0.5 + 0.25 * f32::from(lanes.min(8))
    }

    /// Errors behind each other: in front the one that is outside its limit, or all in decades.
    fn agreement(&self) -> Node {
        let of = |quantity: &'static str| {
            measures(self.report, "agreement").find(move |measure| measure.quantity == quantity)
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
        Node::Tabs(tabs)
    }

    /// Whether distances say anything: some are watched, and there is a limit or an obstacle.
    fn has_clearance(&self) -> bool {
        let is_checked = measures(self.report, "clearance").next().is_some();
        self.clearance_m.is_some() && (is_checked || self.has_obstacles)
    }

    fn clearance(&self) -> Node {
        let (low, high) = self.clearance_m.unwrap_or((0.0, 1.0));
        let limit = measures(self.report, "clearance").map(|measure| measure.limit).fold(0.0, f64::max);
        let view = View::new("TimeSeries", "Clearance [m]", paths::path(&["clearance"]));
        plot(view, (low.min(0.0), PLOTTED * high.max(limit)))
    }

    /// Joint positions, those in radians behind or before those in metres; `None` without joints.
    fn joints(&self) -> Option<Node> {
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
        let mut views: Vec<Node> = [("rad", of_unit(false)), ("m", of_unit(true))]
            .into_iter()
            .filter(|(_, joints)| !joints.is_empty())
            .map(|(unit, joints)| view(unit, joints))
            .collect();
        match views.len() {
            0 => None,
            1 => views.pop(),
            _ => Some(Node::Tabs(views)),
        }
    }
}

fn lanes() -> Node {
    View::new("StateTimeline", "Checks", paths::path(&["status"])).into()
}

fn events() -> Node {
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

/// On the left, where runs begin and least happens.
fn legend() -> PlotLegend {
    PlotLegend::new().with_corner(Corner2D::LeftTop)
}

/// A plot that shows this range, with some air.
fn plot(view: View, (low, high): (f64, f64)) -> Node {
    let air = 0.06 * (high - low);
    let range = if air.is_finite() && air > 0.0 {
        Range1D::new(low - air, high + air)
    } else {
        Range1D::new(0.0, 1.0)
    };
    view.with("ScalarAxis", &ScalarAxis::new().with_range(range)).with("PlotLegend", &legend()).into()
}

/// The time from the first violation on: layouts cannot place the cursor, but playing it is a key.
fn selection(from_s: f64, to_s: f64) -> AbsoluteTimeRange {
    let time = |time_s: f64| TimeInt(nanoseconds(time_s));
    AbsoluteTimeRange(Range { min: time(from_s), max: time(to_s) })
}
