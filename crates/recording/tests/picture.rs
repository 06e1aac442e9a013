//! What a recording shows, read back from real runs: what turns red and when, the labels beside it, which plots there are,
//! and how large the file is.

#![expect(clippy::unwrap_used, reason = "a test stops if a value is missing")]

use std::{
    fs::File,
    io::BufReader,
    path::{Path, PathBuf},
};

use congruent_input::{Override, display::length};
use congruent_recording::{RerunFormat, scalars};
use congruent_results::{Options, execute, report::RunReport};
use congruent_twin::RunSetup;
use re_chunk::{
    Chunk,
    external::arrow::{
        array::{Array as _, ArrayRef, AsArray as _},
        datatypes::{Float32Type, UInt8Type, UInt32Type},
    },
};
use re_log_encoding::{CachingApplicationIdInjector, DecoderTransport, ToApplication as _};
use re_log_types::LogMsg;
use tempfile::TempDir;

/// Red, as a number.
const RED: u32 = 0xff2d_2dff;

/// The values of one component of one entity in one row.
struct Cell {
    is_layout: bool,
    path: String,
    component: String,
    /// `None` if it holds at all times.
    time_ns: Option<i64>,
    values: ArrayRef,
}

/// A run with all that its recording holds.
struct Recorded {
    report: RunReport,
    file: PathBuf,
    cells: Vec<Cell>,
    _folder: TempDir,
}

impl Recorded {
    fn of(setup: &RunSetup) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let options =
            Options { out: folder.path().to_owned(), recordings: vec![&RerunFormat], interrupt: None };
        let (report, results) = execute(setup, &options, |_| ()).unwrap();
        let file = results.file("recording.rrd");
        let cells = cells(&file);
        Self { report, file, cells, _folder: folder }
    }

    /// A run of one of the project's scenarios.
    fn of_scenario(name: &str, overrides: &[&str]) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../scenarios/{name}.toml"));
        let overrides: Vec<Override> = overrides.iter().map(|text| text.parse().unwrap()).collect();
        Self::of(&RunSetup::load(&path, &overrides).unwrap())
    }

    /// The rows of a component, in the order of time.
    #[track_caller]
    fn rows(&self, path: &str, component: &str) -> Vec<(Option<i64>, &ArrayRef)> {
        let is_it = |cell: &&Cell| cell.path == path && cell.component == component;
        let mut rows: Vec<_> =
            self.cells.iter().filter(is_it).map(|cell| (cell.time_ns, &cell.values)).collect();
        assert!(!rows.is_empty(), "no {component} at {path}");
        rows.sort_by_key(|(time_ns, _)| *time_ns);
        rows
    }

    #[track_caller]
    fn texts(&self, path: &str, component: &str) -> Vec<String> {
        self.rows(path, component).into_iter().flat_map(|(_, values)| strings(values)).collect()
    }

    /// The colours of a body with their times.
    #[track_caller]
    fn colors(&self, body: &str) -> Vec<(f64, u32)> {
        let kinds = ["Mesh3D:albedo_factor", "Cylinders3D:colors", "Boxes3D:colors"];
        let is_color = |cell: &&Cell| {
            let is_own = cell.path == body || cell.path == format!("{body}/mesh_0");
            is_own && kinds.contains(&cell.component.as_str())
        };
        let Some(first) = self.cells.iter().find(is_color) else { panic!("{body} has no colour") };
        let rows = self.rows(&first.path, &first.component).into_iter();
        let color = |values: &ArrayRef| values.as_primitive::<UInt32Type>().value(0);
        rows.map(|(time_ns, values)| (seconds(time_ns.unwrap()), color(values))).collect()
    }

    /// Names of all views, in the order in which the layout has them.
    fn views(&self) -> Vec<String> {
        let names = self.cells.iter().filter(|cell| cell.component == "ViewBlueprint:display_name");
        names.flat_map(|cell| strings(&cell.values)).collect()
    }

    /// What the view with this name shows.
    #[track_caller]
    fn contents(&self, view: &str) -> Vec<String> {
        let is_named =
            |cell: &&Cell| cell.component == "ViewBlueprint:display_name" && strings(&cell.values) == [view];
        let Some(cell) = self.cells.iter().find(is_named) else {
            panic!("no view {view} among {:?}", self.views())
        };
        self.texts(&format!("{}/ViewContents", cell.path), "ViewContents:query")
    }
}

fn seconds(nanoseconds: i64) -> f64 {
    std::time::Duration::from_nanos(u64::try_from(nanoseconds).unwrap()).as_secs_f64()
}

fn strings(values: &ArrayRef) -> Vec<String> {
    values.as_string::<i32>().iter().flatten().map(str::to_owned).collect()
}

fn cells(file: &Path) -> Vec<Cell> {
    let mut applications = CachingApplicationIdInjector::default();
    let mut cells = Vec::new();
    for message in DecoderTransport::decode_lazy(BufReader::new(File::open(file).unwrap())) {
        let message = message.unwrap().to_application((&mut applications, None)).unwrap();
        let LogMsg::ArrowMsg(store, message) = message else { continue };
        let chunk = Chunk::from_arrow_msg(&message).unwrap();
        let times = chunk.timelines().iter().find(|(name, _)| name.as_str() == "sim_time");
        let times = times.map(|(_, column)| column.times_raw());
        for column in chunk.components().values() {
            for row in (0..column.list_array.len()).filter(|&row| column.list_array.is_valid(row)) {
                cells.push(Cell {
                    is_layout: store.is_blueprint(),
                    path: chunk.entity_path().to_string(),
                    component: column.descriptor.component.to_string(),
                    time_ns: times.map(|times| times[row]),
                    values: column.list_array.value(row),
                });
            }
        }
    }
    cells
}

#[track_caller]
fn first_violation_s(report: &RunReport, kind: &str) -> f64 {
    let check = report.checks.iter().find(|check| check.check.word() == kind).unwrap();
    check.measures.iter().find_map(|measure| measure.first_violation.as_ref()).unwrap().time_s
}

#[test]
fn a_pair_that_is_too_close_turns_red_at_the_first_violation() {
    let run = Recorded::of_scenario("ur5e_into_table", &[]);
    let first_s = first_violation_s(&run.report, "clearance");
    let link = run.colors("/world/twin/wrist_3_link");
    assert!(link.len() == 2 && link[0].1 != RED && link[1].1 == RED, "{link:x?}");
    assert!((link[1].0 - first_s).abs() < 1e-9, "{link:x?}, {first_s}");
    let table = run.colors("/world/obstacle/table");
    assert!((table[1].0 - first_s).abs() < 1e-9 && table[0].1 != table[1].1, "{table:x?}");
    let shoulder = run.colors("/world/twin/shoulder_link");
    assert_eq!(shoulder.len(), 1, "it never comes close: {shoulder:x?}");
}

/// Kind: single precision of positions in a recording, 6e-8 at 1 m for each of two points; worst seen 1e-7 m.
const SINGLE_PRECISION_M: f64 = 5e-7;

#[test]
fn a_line_between_the_nearest_points_has_their_distance_for_a_label() {
    let run = Recorded::of_scenario("ur5e_into_table", &[]);
    let (_, series) = scalars(&run.file).unwrap();
    let distances = &series["/clearance/wrist_3_link--table"];
    let lines = run.rows("/world/nearest", "LineStrips3D:strips");
    let labels = run.rows("/world/nearest", "Points3D:labels");
    let mut compared = 0;
    for ((time_ns, strips), (_, labels)) in lines.iter().zip(&labels) {
        let time_ns = time_ns.expect("lines are drawn at times");
        let labels = strings(labels);
        let is_own = |label: &String| label.starts_with("wrist_3_link--table: ");
        let Some(own) = labels.iter().position(is_own) else { continue };
        let is_now = |(time_s, _): &&(f64, f64)| (time_s - seconds(time_ns)).abs() < 1e-9;
        let distance_m = distances.iter().find(is_now).unwrap().1;
        if distance_m > 0.0 {
            assert_eq!(labels[own], format!("wrist_3_link--table: {}", length(distance_m)));
            let points = strips.as_list::<i32>().value(own);
            let points = points.as_fixed_size_list().values().as_primitive::<Float32Type>().clone();
            let square = |axis: usize| f64::from(points.value(axis) - points.value(axis + 3)).powi(2);
            let drawn_m = (square(0) + square(1) + square(2)).sqrt();
            assert!((drawn_m - distance_m).abs() < SINGLE_PRECISION_M, "{drawn_m} is not {distance_m}");
            compared += 1;
        } else {
            assert!(labels[own].contains("overlap"), "{labels:?}");
        }
    }
    assert!(compared > 5, "{compared}");
    let first = run.report.checks[1].measures[0].first_violation.as_ref().unwrap();
    let is_first = |(time_s, _): &&(f64, f64)| (time_s - first.time_s).abs() < 1e-9;
    let plotted_m = series["/clearance/minimum"].iter().find(is_first).unwrap().1;
    assert_eq!(plotted_m.to_bits(), first.value.to_bits(), "the report and the plot have the same distance");
}

#[test]
fn a_zone_has_a_name_and_a_distance_and_turns_red_with_the_link_in_it() {
    let run = Recorded::of_scenario("ur5e_into_zone", &[]);
    let first_s = first_violation_s(&run.report, "zone");
    let zone = run.colors("/world/zone/operator");
    assert!(zone.len() == 2 && (zone[1].0 - first_s).abs() < 1e-9, "{zone:x?}");
    let link = run.colors("/world/twin/wrist_2_link");
    assert!((link[1].0 - first_s).abs() < 1e-9 && link[1].1 == RED, "{link:x?}");
    assert_eq!(run.texts("/world/zone/operator/name", "Points3D:labels"), ["operator"]);
    let (_, series) = scalars(&run.file).unwrap();
    let distances = &series["/zone/distance/operator"];
    assert!(distances[0].1 > 0.1 && distances.last().unwrap().1 == 0.0, "{distances:?}");
    // At a distance there is no line, and near the zone one with its distance.
    let labels = run.texts("/world/nearest", "Points3D:labels");
    assert!(labels[0].contains("--operator: 9"), "{:?}", labels[0]);
    assert!(labels.last().unwrap().contains("overlap"), "{:?}", labels.last());
    assert!(run.views().contains(&"Distances from zones [m]".to_owned()), "{:?}", run.views());
}

#[test]
fn a_joint_that_sags_turns_red_and_its_plots_explain_it() {
    let run = Recorded::of_scenario("ur5e_soft_servos", &[]);
    let first_s = first_violation_s(&run.report, "tracking");
    let red = |link: &str| run.colors(&format!("/world/twin/{link}"));
    let any_at_first = ["upper_arm_link", "forearm_link"]
        .iter()
        .any(|link| red(link).iter().any(|&(at, color)| color == RED && (at - first_s).abs() < 1e-9));
    assert!(any_at_first, "{first_s}");
    assert_eq!(red("wrist_3_link").len(), 1, "it follows");
    let views = run.views();
    let place = |name: &str| views.iter().position(|view| view == name);
    let tracking = place("tracking: path error of angle [rad]").unwrap();
    let positions = place("Positions and commands (thin) [rad]").unwrap();
    assert!(tracking < positions, "{views:?}");
    assert!(
        place("Deviations from commands [rad]").is_some() && place("Torques [N m]").is_some(),
        "{views:?}"
    );
    let shown = run.contents("Positions and commands (thin) [rad]");
    for path in ["+ /joint/position/elbow_joint", "+ /joint/reference_position/elbow_joint"] {
        assert!(shown.contains(&path.to_owned()), "{path}: {shown:?}");
    }
    let (_, series) = scalars(&run.file).unwrap();
    let [true_q, commanded, deviation] = ["position", "reference_position", "deviation"]
        .map(|of| &series[&format!("/joint/{of}/elbow_joint")]);
    for ((q, commanded), deviation) in true_q.iter().zip(commanded).zip(deviation) {
        assert_eq!((q.1 - commanded.1).to_bits(), deviation.1.to_bits());
    }
    let play = run.rows("/time_panel", "TimePanelBlueprint:play_state");
    assert_eq!(play[0].1.as_primitive::<UInt8Type>().value(0), 3, "opens at the end, where it still sags");
}

#[test]
fn what_failed_first_is_the_first_plot() {
    for (scenario, plot) in [
        ("ur5e_soft_servos", "tracking: path error of angle [rad]"),
        ("ur5e_into_table", "Clearance [m]"),
        ("ur5e_wrong_convention", "Position errors [m]"),
    ] {
        let views = Recorded::of_scenario(scenario, &[]).views();
        let after = views.iter().position(|view| view == "Checks").unwrap() + 1;
        assert_eq!(views[after], plot, "{views:?}");
    }
}

#[test]
fn grasps_and_motions_are_events() {
    let run = Recorded::of_scenario("ur5e_grasp", &[]);
    let events = run.texts("/log", "TextLog:text");
    for event in ["motion 4, path_tcp, begins", "grasp of part: begins", "grasp of part: ends"] {
        assert!(events.contains(&event.to_owned()), "{event}: {events:?}");
    }
    let names = run.texts("/clearance/wrist_1_link--wrist_3_link", "SeriesLines:names");
    assert_eq!(names.last().unwrap(), "wrist_1_link--wrist_3_link (constant in this run)");
}

#[test]
fn lanes_of_failed_checks_come_first() {
    let run = Recorded::of_scenario("ur5e_soft_servos", &[]);
    let mut lanes: Vec<&str> =
        run.cells.iter().map(|cell| cell.path.as_str()).filter(|path| path.starts_with("/status/")).collect();
    lanes.sort_unstable();
    lanes.dedup();
    assert_eq!(
        lanes,
        [
            "/status/fail/tracking",
            "/status/pass/agreement",
            "/status/pass/dynamics",
            "/status/pass/effort",
            "/status/pass/limits",
            "/status/pass/power"
        ],
        "the viewer orders lanes by path"
    );
    let summary = &run.texts("/summary", "TextDocument:text")[0];
    assert!(summary.starts_with("### ur5e_soft_servos on ur5e: expected failure: tracking"), "{summary}");
    let [tracking, agreement] = ["**tracking fail**", "**agreement pass**"].map(|line| summary.find(line));
    assert!(tracking.unwrap() < agreement.unwrap(), "{summary}");
}

#[test]
fn tolerances_have_colours_of_their_own_and_frames_are_hidden() {
    let run = Recorded::of_scenario("ur5e_pick", &["simulation.duration_s=0.05"]);
    let color = |path: &str| {
        let rows = run.rows(path, "SeriesLines:colors");
        rows[0].1.as_primitive::<UInt32Type>().value(0)
    };
    let worst = ["position", "position tolerance", "orientation", "orientation tolerance"];
    let mut colors: Vec<u32> =
        worst.iter().map(|name| color(&format!("/agreement/worst/{}", name.replace(' ', "\\ ")))).collect();
    colors.sort_unstable();
    colors.dedup();
    assert_eq!(colors.len(), 4);
    for (frame, label) in [("dh/dh0", "dh0"), ("dh/dh6", "dh6"), ("tool/tcp", "tcp"), ("link/tool0", "tool0")]
    {
        assert_eq!(run.texts(&format!("/world/frame/{frame}"), "Arrows3D:labels"), [label]);
    }
    let hidden = run.cells.iter().find(|cell| cell.is_layout && cell.component == "EntityBehavior:visible");
    let hidden = hidden.expect("the layout hides the frames");
    assert!(hidden.path.ends_with("/overrides/world/frame/visualizers"), "{}", hidden.path);
    assert!(!hidden.values.as_boolean().value(0));
    for obstacle in ["table", "box", "wall"] {
        let path = format!("/world/obstacle/{obstacle}/name");
        assert_eq!(run.texts(&path, "Points3D:labels"), [obstacle]);
    }
}

/// A chain of many joints of which few move: only those are plotted.
#[test]
fn of_many_joints_those_that_move_are_plotted() {
    let folder = tempfile::tempdir().unwrap();
    let body =
        "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>";
    let link = |joint: u32| {
        format!(
            "<link name='l{joint}'>{body}</link><joint name='j{joint}' type='revolute'><parent link='l{}'/>\
             <child link='l{joint}'/><origin xyz='0 0 0.1'/><axis xyz='0 1 0'/>\
             <limit lower='-3' upper='3' velocity='2' effort='500'/></joint>",
            joint - 1
        )
    };
    let links: String = (1..=14).map(link).collect();
    let urdf = format!("<robot name='long'><link name='l0'>{body}</link>{links}</robot>");
    std::fs::write(folder.path().join("long.urdf"), urdf).unwrap();
    let scenario = folder.path().join("long.toml");
    let text = "schema_version = 1\nname = 'long'\nrobot = 'long.urdf'\ncontroller = { kind = 'kinematic' }\n\
                simulation = { step_s = 0.001, duration_s = 0.5 }\n\
                motion = [{ move_joints_rad = { j3 = 0.2, j9 = 0.3 }, duration_s = 0.5 }]\n\
                check = [{ kind = 'agreement' }]\n";
    std::fs::write(&scenario, text).unwrap();
    let run = Recorded::of(&RunSetup::load(&scenario, &[]).unwrap());
    let shown = run.contents("Positions and commands (thin) [rad]");
    let positions: Vec<_> = shown.iter().filter(|query| query.starts_with("+ /joint/position/")).collect();
    assert_eq!(positions, ["+ /joint/position/j3", "+ /joint/position/j9"]);
    // A link without a material is not painted in the colour of its curve.
    assert!(!run.views().iter().any(|view| view.starts_with("Clearance")), "nothing is near");
}

/// Ten seconds of an arm of six joints at 1 kHz. Measured: 4.1 MB.
#[test]
fn ten_seconds_are_less_than_six_megabytes() {
    let run = Recorded::of_scenario("ur5e_pick", &["simulation.duration_s=10.0"]);
    assert_eq!(run.report.simulation.steps, 10_000);
    let bytes = std::fs::metadata(&run.file).unwrap().len();
    assert!(bytes < 6_000_000, "{bytes}");
}
