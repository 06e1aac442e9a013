//! Reference case 13, the safety layer: joint limits, collisions and forbidden zones, each stopping
//! the motion at its first violation. When that is, is computed here once more from nothing but the
//! closed form of the moves, the screws of the robot and the extents of its shapes: no physics, no
//! distance query.

use std::{fs, path::Path};

use congruent::description::{Geometry, Link, RobotDescription, Shape, load_robot};
use serde_json::{Value, json};

use crate::support::{
    command::{congruent, congruent_json, text},
    corpus::workspace,
    golden::{numbers, read_json},
    published_table::UR5E_JOINTS,
};

/// Kind: rounding. Played-back positions against the closed form of the move, a few operations
/// below 4 rad each; worst seen 4.5e-16 rad.
const CLOSED_FORM_RAD: f64 = 1e-14;
/// Kind: solver stop. By less than this an exact distance is off, so a violation that is so near to
/// a step's end could be seen a step early or late; the bound is that of `clearance.rs`. The moves
/// here go through their limits with 1e-4 m a step.
const DISTANCE_M: f64 = 1e-7;

/// Elbow up, tool pointing down: where the scenarios start.
const START_DEG: [f64; 6] = [0.0, -90.0, 90.0, -90.0, -90.0, 0.0];

/// Share of a path after a share of its time: `10 s^3 - 15 s^4 + 6 s^5`.
fn quintic(s: f64) -> f64 {
    10.0 * s.powi(3) - 15.0 * s.powi(4) + 6.0 * s.powi(5)
}

/// Between two configurations, rad.
fn between(from_deg: [f64; 6], to_deg: [f64; 6], share: f64) -> [f64; 6] {
    std::array::from_fn(|joint| (from_deg[joint] + (to_deg[joint] - from_deg[joint]) * share).to_radians())
}

/// Writes a variant of a scenario that comes with the project, runs it, and gives exit code and report.
#[track_caller]
fn run_variant(scenario: &str, edits: &[(&str, &str)]) -> (i32, Value) {
    let folder = tempfile::tempdir().unwrap();
    let mut toml = fs::read_to_string(workspace().join("scenarios").join(scenario)).unwrap();
    let robots = format!("\"{}/", text(&workspace().join("robots")));
    for (from, to) in edits.iter().copied().chain([("\"../robots/", robots.as_str())]) {
        assert!(toml.contains(from), "{scenario} has no {from:?}");
        toml = toml.replacen(from, to, 1);
    }
    let path = folder.path().join("scenario.toml");
    fs::write(&path, toml).unwrap();
    let answer = congruent_json(&["run", &text(&path), "--no-recording", "--out", &text(folder.path())]);
    assert!(answer.code < 2, "{}{}", answer.stdout, answer.stderr);
    (answer.code, answer.json())
}

fn check<'a>(report: &'a Value, kind: &str) -> &'a Value {
    let checks = report["checks"].as_array().unwrap();
    checks.iter().find(|check| check["check"] == kind).unwrap_or_else(|| panic!("no check {kind}"))
}

/// What `kind` found first, in a run that it stopped there. The arm slows down after it, and all that is looked at ends
/// where it is at rest.
#[track_caller]
fn stopped_by<'a>(report: &'a Value, kind: &str, step: usize) -> &'a Value {
    let failed = check(report, kind);
    let violation = &failed["measures"][0]["first_violation"];
    let steps = report["simulation"]["steps"].as_u64().unwrap();
    let rest = &report["stopped"]["rest"];
    assert_eq!(rest["is_at_rest"], true, "{rest:#}");
    let slowed_steps = usize::try_from(steps).unwrap() - step;
    let slowed_s = f64::from(u32::try_from(slowed_steps).unwrap()) * 1e-3;
    assert!((rest["duration_s"].as_f64().unwrap() - slowed_s).abs() < 1e-9, "{rest:#}");
    assert_eq!(report["stopped"]["check"], kind);
    assert_eq!(report["stopped"]["step"], step);
    assert_eq!(report["stopped"]["line"], failed["line"]);
    assert_eq!(report["stopped"]["time_s"], violation["time_s"]);
    assert_eq!(violation["time_s"], f64::from(u32::try_from(step).unwrap()) * 1e-3, "steps take 1 ms");
    assert_eq!(failed["status"], "fail");
    let notes = failed["notes"].as_array().unwrap();
    assert!(notes.last().unwrap().as_str().unwrap().starts_with("stopped the run at "), "{failed:#}");
    for check in report["checks"].as_array().unwrap() {
        assert_eq!(check["samples"], steps + 1, "{check:#}");
        assert!(check["check"] == kind || check["status"] == "pass", "{check:#}");
    }
    violation
}

#[track_caller]
fn assert_at_positions(violation: &Value, expected_rad: &[f64; 6]) {
    let q = violation["q"].as_object().unwrap();
    assert!(q.keys().eq(UR5E_JOINTS.iter()), "{q:?}");
    for (joint, expected_rad) in UR5E_JOINTS.iter().zip(expected_rad) {
        let error_rad = (q[*joint].as_f64().unwrap() - expected_rad).abs();
        assert!(error_rad <= CLOSED_FORM_RAD, "{joint} is {error_rad:e} rad off");
    }
}

/// How far the shapes of a link reach from its origin along a direction of unit length, which is
/// given in the link: the support function in closed form.
fn reach_m(shapes: &[Shape], direction_in_link: [f64; 3]) -> f64 {
    let of_shape = |shape: &Shape| {
        let (turn, place) = (shape.link_from_shape.rotation, shape.link_from_shape.translation.vector);
        let mut direction = place; // for its type: three numbers
        direction.copy_from_slice(&direction_in_link);
        let in_shape = turn.inverse() * direction;
        place.dot(&direction)
            + match &shape.geometry {
                Geometry::Box { size_m } => in_shape.abs().dot(size_m) / 2.0,
                Geometry::Cylinder { radius_m, length_m } => {
                    radius_m * in_shape.x.hypot(in_shape.y) + length_m / 2.0 * in_shape.z.abs()
                }
                Geometry::Sphere { radius_m } => *radius_m,
                Geometry::Ellipsoid { semi_axes_m } => in_shape.component_mul(semi_axes_m).norm(),
                Geometry::Mesh(mesh) => {
                    let along = mesh.vertices_m.iter().map(|vertex| vertex.coords.dot(&in_shape));
                    along.fold(f64::NEG_INFINITY, f64::max)
                }
            }
    };
    shapes.iter().map(of_shape).fold(f64::NEG_INFINITY, f64::max)
}

/// One row of a rotation from its unit quaternion.
fn row(axis: usize, quaternion_wxyz: &[f64]) -> [f64; 3] {
    let [w, x, y, z] = quaternion_wxyz.try_into().unwrap();
    let rows: [[f64; 3]; 3] = [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ];
    rows[axis]
}

/// How far the links reach along one axis of the root (`sign` 1) or against it (-1) at each
/// configuration, and which link that is. The links that stand still are left out.
fn reaches(robot: &RobotDescription, joint_path: &[[f64; 6]], axis: usize, sign: f64) -> Vec<(f64, String)> {
    let folder = tempfile::tempdir().unwrap();
    let batch = folder.path().join("positions.json");
    let named = |q: &[f64; 6]| json!({ "q": UR5E_JOINTS.iter().zip(q).collect::<std::collections::BTreeMap<_, _>>() });
    fs::write(&batch, json!(joint_path.iter().map(named).collect::<Vec<_>>()).to_string()).unwrap();
    let arguments = ["fk", "robots/ur5e", "--source", "poe", "--configurations", &text(&batch)];
    let poses = congruent_json(&arguments).json();
    let links = robot.robot.links().iter().zip(robot.robot.link_indices());
    let moving: Vec<&Link> = links
        .filter(|&(_, index)| robot.robot.body(index) != robot.robot.root())
        .map(|(link, _)| link)
        .collect();
    let reach = |poses: &Value| {
        let of_link = |link: &&Link| {
            let pose = &poses["links"][&link.name];
            let direction_in_link = row(axis, &numbers(&pose["quaternion_wxyz"])).map(|entry| sign * entry);
            let origin_m = sign * pose["translation_m"][axis].as_f64().unwrap();
            (origin_m + reach_m(&link.collisions, direction_in_link), link.name.clone())
        };
        moving.iter().map(of_link).max_by(|a, b| a.0.total_cmp(&b.0)).unwrap()
    };
    poses["results"].as_array().unwrap().iter().map(reach).collect()
}

/// The first step at which the reach passes a limit, with the link that does it.
#[track_caller]
fn first_beyond(reaches: &[(f64, String)], limit_m: f64) -> (usize, String) {
    let step = reaches.iter().position(|(reach_m, _)| *reach_m >= limit_m).expect("it gets there");
    let before_m = limit_m - reaches[step - 1].0;
    let after_m = reaches[step].0 - limit_m;
    assert!(before_m > DISTANCE_M && after_m > DISTANCE_M, "too near to call: {before_m:e} {after_m:e}");
    (step, reaches[step].1.clone())
}

fn ur5e() -> RobotDescription {
    load_robot(Path::new(&workspace().join("robots/ur5e"))).unwrap()
}

/// The zone's near face is the plane y = 0.4 m, as wide as the arm is long.
const ZONE_FACE_M: f64 = 0.4;

/// A quarter turn about the first joint in 2 s.
fn path_into_zone() -> Vec<[f64; 6]> {
    let mut to_deg = START_DEG;
    to_deg[0] = 90.0;
    (0..=2000_u16).map(|step| between(START_DEG, to_deg, quintic(f64::from(step) / 2000.0))).collect()
}

#[test]
fn case_13_the_first_link_in_a_forbidden_zone_stops_the_motion() {
    let joint_path = path_into_zone();
    let (step, link) = first_beyond(&reaches(&ur5e(), &joint_path, 1, 1.0), ZONE_FACE_M);
    let (code, report) = run_variant("ur5e_into_zone.toml", &[]);
    assert_eq!((code, &report["verdict"]), (0, &json!("as_expected")));
    let violation = stopped_by(&report, "zone", step);
    assert_eq!(violation["subject"], format!("{link}--operator"));
    assert_eq!(violation["value"], 0.0);
    assert_eq!(&check(&report, "zone")["measures"][0]["worst"], violation);
    assert_at_positions(violation, &joint_path[step]);
    slows_down(&report, &joint_path[step - 1..=step], step);
}

/// One joint alone moves, by the quintic, and slows down from its velocity `v` at the violation: with the 3.14 rad/s of its
/// limit in 0.25 s, so `v^2 / 2 a` further, and the TCP along a circle about the joint.
fn slows_down(report: &Value, last_two: &[[f64; 6]], step: usize) {
    /// Kind: truncation. A step ends within 1 ms of rest, at which the arm has 1e-6 rad to go.
    const STEP_S: f64 = 1e-3;
    let s = f64::from(u32::try_from(step).unwrap()) / 2000.0;
    let velocity = 30.0 * (s * (1.0 - s)).powi(2) * std::f64::consts::FRAC_PI_2 / 2.0;
    let between = (last_two[1][0] - last_two[0][0]) / STEP_S;
    assert!((velocity - between).abs() < 2e-3, "{velocity} {between}");
    let acceleration = std::f64::consts::PI / 0.25;
    let rest = &report["stopped"]["rest"];
    let duration_s = rest["duration_s"].as_f64().unwrap();
    assert!((0.0..=STEP_S).contains(&(duration_s - velocity / acceleration)), "{rest:#}");
    let moved_rad = rest["joints"]["shoulder_pan_joint"].as_f64().unwrap();
    assert!((moved_rad - velocity * velocity / (2.0 * acceleration)).abs() < 1e-9, "{rest:#}");
    // The tool is 0.5 m from the axis of the first joint, more or less.
    let radius_m = rest["tcp_path_m"].as_f64().unwrap() / moved_rad;
    assert!((0.4..0.6).contains(&radius_m), "{radius_m}");
}

#[test]
fn case_13_without_a_stop_the_motion_goes_on() {
    let (_, stopped) = run_variant("ur5e_into_zone.toml", &[]);
    let (code, report) = run_variant("ur5e_into_zone.toml", &[("on_violation = \"stop\"\n", "")]);
    assert_eq!((code, &report["stopped"], &report["simulation"]["steps"]), (0, &Value::Null, &json!(2000)));
    let [first, went_on] = [&stopped, &report].map(|report| check(report, "zone"));
    // Further links enter at other times: the stop slows the arm down.
    assert_eq!(first["measures"][0], went_on["measures"][0]);
    assert_eq!(went_on["samples"], 2001);
    assert_eq!(went_on.get("notes"), None);
}

#[test]
fn case_13_a_stop_is_a_failure_where_none_is_expected() {
    let expectation = ("verdict = \"fail\"\nchecks = [\"zone\"]", "verdict = \"pass\"");
    let (code, report) = run_variant("ur5e_into_zone.toml", &[expectation]);
    assert_eq!((code, &report["verdict"]), (1, &json!("not_as_expected")));
    assert_eq!(report["stopped"]["check"], "zone");
}

/// The zone is forbidden to one link: the wrist goes in unseen until the forearm does.
#[test]
fn case_13_a_zone_counts_for_the_links_that_it_names() {
    let (_, all) = run_variant("ur5e_into_zone.toml", &[]);
    let (code, report) = run_variant("ur5e_into_zone.toml", &[("links = [\"*\"]", "links = [\"fore*\"]")]);
    assert_eq!(code, 0);
    let violation = &check(&report, "zone")["measures"][0]["first_violation"];
    assert_eq!(violation["subject"], "forearm_link--operator");
    assert!(violation["time_s"].as_f64().unwrap() > all["stopped"]["time_s"].as_f64().unwrap());
}

#[test]
fn case_13_a_joint_limit_stops_the_motion() {
    /// What `limits.rs` allows beyond a limit.
    const AT_THE_LIMIT_RAD: f64 = 1e-6;
    let robot = ur5e().robot;
    let elbow = robot.joint(robot.find_joint("elbow_joint").unwrap());
    let (_, upper_rad) = elbow.position_range().unwrap();
    // From 170 to 190 degrees in 2 s at a constant speed, everything else at rest.
    let (mut from_deg, mut to_deg) = (START_DEG, START_DEG);
    (from_deg[2], to_deg[2]) = (170.0, 190.0);
    let joint_path = |step: u16| between(from_deg, to_deg, f64::from(step) / 2000.0);
    let step = (0..=2000).find(|&step| joint_path(step)[2] > upper_rad + AT_THE_LIMIT_RAD).unwrap();
    let (code, report) = run_variant(
        "ur5e_into_zone.toml",
        &[
            ("elbow_joint = 90.0", "elbow_joint = 170.0"),
            ("shoulder_pan_joint = 90.0", "elbow_joint = 190.0"),
            ("\"quintic\"", "\"linear\""),
            ("checks = [\"zone\"]", "checks = [\"limits\"]"),
        ],
    );
    assert_eq!(code, 0, "{report:#}");
    let violation = stopped_by(&report, "limits", step.into());
    assert_eq!(violation["subject"], "elbow_joint");
    assert_at_positions(violation, &joint_path(step));
}

/// The arm is led down to a table, whose top is the plane z = 0: what counts is the lowest vertex.
#[test]
fn case_13_a_coming_collision_stops_the_motion() {
    const MINIMUM_M: f64 = 0.02;
    let above_deg = [-26.46, -83.68, 111.87, -118.2, -90.0, -26.46];
    let down_deg = [-26.46, -43.13, 121.02, -167.88, -90.0, -26.46];
    let joint_path: Vec<[f64; 6]> = (0..=2000_u16)
        .map(f64::from)
        .map(|step| match step {
            step if step < 800.0 => between(START_DEG, above_deg, quintic(step / 800.0)),
            step => between(above_deg, down_deg, quintic((step - 800.0) / 1200.0)),
        })
        .collect();
    let (step, link) = first_beyond(&reaches(&ur5e(), &joint_path, 2, -1.0), -MINIMUM_M);
    let stop = ("minimum_m = 0.02", "minimum_m = 0.02\non_violation = \"stop\"");
    let (code, report) = run_variant("ur5e_into_table.toml", &[stop]);
    assert_eq!(code, 0, "{report:#}");
    let violation = stopped_by(&report, "clearance", step);
    assert_eq!(violation["subject"], format!("{link}--table"));
    assert_at_positions(violation, &joint_path[step]);
}

#[test]
fn case_13_the_resolved_scenario_stops_at_the_same_place() {
    let out = tempfile::tempdir().unwrap();
    let run = |path: &str, out: &str| {
        let answer = congruent_json(&["run", path, "--no-recording", "--out", out]);
        assert_eq!(answer.code, 0, "{}", answer.stderr);
        answer.json()
    };
    for scenario in ["ur5e_into_zone", "ur5e_beside_zone"] {
        let first = run(&format!("scenarios/{scenario}.toml"), &text(out.path()));
        let resolved = text(&out.path().join(scenario).join("scenario.resolved.toml"));
        let again = run(&resolved, &text(&out.path().join("again")));
        assert_eq!(first["trajectory_sha256"], again["trajectory_sha256"], "{scenario}");
        assert_eq!(first["stopped"].is_null(), again["stopped"].is_null(), "{scenario}");
    }
}

#[test]
fn case_13_what_stopped_is_in_every_result() {
    let out = tempfile::tempdir().unwrap();
    let answer = congruent(&["run", "scenarios/ur5e_into_zone.toml", "--out", &text(out.path())]);
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
    let folder = out.path().join("ur5e_into_zone");
    let stopped = read_json(&folder.join("report.json"))["stopped"]["time_s"].as_f64().unwrap();
    let note = format!("stopped the run at {stopped:.3} s");
    assert!(answer.stdout.contains(&note), "{}", answer.stdout);
    let junit = fs::read_to_string(folder.join("junit.xml")).unwrap();
    assert!(junit.contains(&note), "{junit}");
    #[cfg(feature = "recording")]
    {
        let inspected = congruent_json(&["inspect", &text(&folder.join("recording.rrd"))]).json();
        assert_eq!(inspected["report"]["stopped"]["time_s"], stopped);
        let entities = inspected["entities"].as_array().unwrap();
        assert!(entities.iter().any(|entity| entity["path"] == "/world/zone/operator"), "{entities:#?}");
        let last_s = inspected["timelines"][0]["last"].as_f64().unwrap() * 1e-9;
        let rest_s = inspected["report"]["stopped"]["rest"]["duration_s"].as_f64().unwrap();
        assert!((last_s - stopped - rest_s).abs() < 1e-9, "the recording ends at {last_s} s");
    }
}
