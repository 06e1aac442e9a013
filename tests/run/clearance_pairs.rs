//! Clearance, pair by pair: a ball on a slide goes past balls beside its path, so that every distance is a
//! closed form. Every pair below the limit is listed with its least distance and its time; pairs are chosen and
//! left out by name. And the tolerance of the check of joint limits, on the same slide.

use std::fs;

use congruent::input::display::quantity;
use serde_json::Value;

use crate::support::{
    command::{Answer, congruent, congruent_json, text},
    corpus::workspace,
    golden::{number, read_json},
};

/// Kind: solver stop of the distance query, as in `clearance.rs`.
const DISTANCE_M: f64 = 1e-7;
/// Radius of the balls on the robot.
const BALL_M: f64 = 0.05;
/// Balls beside the path: name, place, radius.
const STANDING: [(&str, [f64; 3], f64); 3] =
    [("lamp", [0.1, 0.2, 0.0], 0.1), ("post", [0.35, 0.25, 0.0], 0.12), ("wall", [0.2, 0.5, 0.0], 0.05)];
/// Travel of the slide, m, and its time, s.
const TRAVEL: (f64, f64) = (0.5, 1.0);

/// A foot with a ball 0.3 m above its origin, a cart on a slide, and a mast on the cart that does not move.
const URDF: &str = r#"<robot name="slide">
  <link name="foot"><collision><origin xyz="0 0 -0.3"/><geometry><sphere radius="0.05"/></geometry></collision></link>
  <link name="cart">
    <inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><sphere radius="0.05"/></geometry></collision></link>
  <link name="mast">
    <inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><origin xyz="0 0 0.4"/><geometry><sphere radius="0.05"/></geometry></collision></link>
  <joint name="slide" type="prismatic"><parent link="foot"/><child link="cart"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="0.4999995" velocity="9" effort="99"/></joint>
  <joint name="turn" type="continuous"><parent link="cart"/><child link="mast"/><axis xyz="0 0 1"/></joint>
</robot>"#;

struct Slide(tempfile::TempDir);

impl Slide {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("slide.urdf"), URDF).unwrap();
        Self(folder)
    }

    fn robot(&self) -> String {
        text(&self.0.path().join("slide.urdf"))
    }

    /// Runs the motion, with these lines under the check of a kind.
    fn run(&self, check: &str, format: &str) -> Answer {
        self.run_with(check, &["--no-recording", "--format", format])
    }

    fn run_with(&self, check: &str, options: &[&str]) -> Answer {
        let obstacle = |(name, [x, y, z], radius): (&str, [f64; 3], f64)| {
            format!("[[obstacle]]\nname = \"{name}\"\nsphere_radius_m = {radius}\nxyz_m = [{x}, {y}, {z}]\n")
        };
        let (travel_m, travel_s) = TRAVEL;
        let scenario = format!(
            "schema_version = 1\nname = \"past\"\nrobot = \"slide.urdf\"\n[controller]\nkind = \"kinematic\"\n\
             [[motion]]\nmove_joints_m = {{ slide = {travel_m} }}\nduration_s = {travel_s}\nprofile = \"linear\"\n\
             {}[[check]]\n{check}\n",
            STANDING.map(obstacle).concat()
        );
        let path = self.0.path().join("scenario.toml");
        fs::write(&path, scenario).unwrap();
        let out = text(&self.0.path().join("out"));
        congruent(&[&["run", &text(&path), "--out", &out], options].concat())
    }

    fn check(&self, check: &str) -> Value {
        let answer = self.run(check, "json");
        assert!(answer.code < 2, "{}", answer.stderr);
        answer.json()["checks"][0].clone()
    }
}

/// Of the cart and a standing ball where it passes it.
fn least_m((_, [_, y, _], radius): (&str, [f64; 3], f64)) -> f64 {
    y - radius - BALL_M
}

/// The pairs that the check lists, each with its least distance at its place.
#[track_caller]
fn lists(check: &Value, expected: &[usize]) {
    let measures = check["measures"].as_array().unwrap();
    assert_eq!(measures.len(), expected.len(), "{check:#}");
    for (measure, &ball) in measures.iter().zip(expected) {
        let (name, [x, ..], _) = STANDING[ball];
        let worst = &measure["worst"];
        assert_eq!(worst["subject"], format!("cart--{name}"), "{check:#}");
        // A step is 0.5 mm, and a quarter of one off the nearest place changes the distance by far less.
        assert!((number(&worst["q"]["slide"]) - x).abs() < 3e-4, "{worst}");
        assert!((number(&worst["time_s"]) - x / TRAVEL.0 * TRAVEL.1).abs() < 1e-3, "{worst}");
        assert!((number(&worst["value"]) - least_m(STANDING[ball])).abs() < 10.0 * DISTANCE_M, "{worst}");
    }
}

#[test]
fn every_pair_below_the_limit_is_listed() {
    let slide = Slide::new();
    // 50 mm to the lamp, 80 mm to the post, 400 mm to the wall; mast and foot are 600 mm apart at the start.
    let check = slide.check("kind = \"clearance\"\nminimum_m = 0.1");
    assert_eq!(check["status"], "fail");
    lists(&check, &[0, 1]);
    // The cart starts sqrt(0.1^2 + 0.2^2) - 0.15 = 74 mm from the lamp; the post comes below 0.1 m at
    // sqrt(0.27^2 - 0.25^2) before it.
    let [lamp, post] = [0, 1].map(|at| check["measures"][at]["first_violation"].clone());
    assert_eq!((&lamp["time_s"], &lamp["subject"]), (&Value::from(0.0), &Value::from("cart--lamp")));
    let before_m = 0.35 - (0.27_f64.powi(2) - 0.25_f64.powi(2)).sqrt();
    assert!((number(&post["q"]["slide"]) - before_m).abs() < 6e-4, "{post}");
    let passing = slide.check("kind = \"clearance\"\nminimum_m = 0.04");
    assert_eq!(passing["status"], "pass");
    lists(&passing, &[0]);
    let human = slide.run("kind = \"clearance\"\nminimum_m = 0.1", "human");
    assert!(human.stdout.contains("cart--lamp") && human.stdout.contains("cart--post"), "{}", human.stdout);
}

/// Two checks of distances with limits of their own: a line for each limit in the recording, and from the start the distance
/// of the nearest pair of each.
#[test]
#[cfg(feature = "recording")]
fn each_of_two_checks_has_its_limit_and_its_nearest_pair() {
    let slide = Slide::new();
    let ran = slide.run_with(
        "kind = \"clearance\"\nminimum_m = 0.04\npairs = [[\"cart\", \"lamp\"]]\n\
         [[check]]\nkind = \"clearance\"\nminimum_m = 0.3\npairs = [[\"cart\", \"wall\"]]",
        &[],
    );
    assert_eq!(ran.code, 0, "{}{}", ran.stdout, ran.stderr);
    let recording = text(&slide.0.path().join("out/past/recording.rrd"));
    let inspected = congruent_json(&["inspect", &recording]);
    assert_eq!(inspected.code, 0, "{}", inspected.stdout);
    let report = inspected.json();
    let scalars = report["scalars"].as_array().unwrap();
    let scalar = |name: &str| scalars.iter().find(|scalar| scalar["path"] == format!("/clearance/{name}"));
    for (name, limit_m) in [("limit", 0.04), ("limit_2", 0.3)] {
        assert_eq!(scalar(name).unwrap()["max"], limit_m, "{name}");
    }
    let count = |name: &str| scalar(name).unwrap()["count"].as_u64().unwrap();
    assert_eq!(count("cart--wall"), count("minimum"), "{scalars:#?}");
}

/// The hand points down while the arm turns: both fingers of a Panda are as far from the floor as at the start, up to
/// rounding, and which of them is nearer changes.
const FINGERS: &str = r#"
schema_version = 1
name = "fingers"
simulation = { duration_s = 1.2 }
controller = { kind = "kinematic" }
[start]
joints_deg = { panda_joint1 = 66.93, panda_joint2 = -16.1, panda_joint4 = -134.35, panda_joint6 = 118.25, panda_joint7 = 45.0 }
joints_m = { panda_finger_joint1 = 0.03 }
[[motion]]
move_joints_deg = { panda_joint1 = 0.0 }
duration_s = 1.2
[[obstacle]]
name = "floor"
box_m = [2.6, 2.5, 0.02]
xyz_m = [0.35, 0.0, -0.01]
[[check]]
kind = "clearance"
minimum_m = 1.0
pairs = [["panda_leftfinger", "floor"], ["panda_rightfinger", "floor"]]
"#;

#[test]
fn each_pair_is_printed_once_at_its_worst() {
    let folder = tempfile::tempdir().unwrap();
    let scenario = text(&folder.path().join("fingers.toml"));
    fs::write(&scenario, format!("robot = {:?}{FINGERS}", workspace().join("robots/panda"))).unwrap();
    let answer = congruent(&["run", &scenario, "--no-recording", "--out", &text(folder.path())]);
    assert_eq!(answer.code, 1, "{}{}", answer.stdout, answer.stderr);
    let report = read_json(&folder.path().join("fingers/report.json"));
    let measures = report["checks"][0]["measures"].as_array().unwrap();
    assert_eq!(measures.len(), 2, "{measures:#?}");
    for measure in measures {
        let worst = &measure["worst"];
        let (subject, time_s) = (worst["subject"].as_str().unwrap(), number(&worst["time_s"]));
        let printed = format!("at {subject} ({})", quantity(time_s, "s"));
        assert_eq!(answer.stdout.matches(&printed).count(), 1, "{printed}: {}", answer.stdout);
        assert_eq!(answer.stdout.matches(&format!("at {subject} (")).count(), 1, "{}", answer.stdout);
    }
}

#[test]
fn pairs_are_chosen_and_left_out_by_name() {
    let slide = Slide::new();
    let with = |lines: &str| slide.check(&format!("kind = \"clearance\"\nminimum_m = 0.1\n{lines}"));
    let ignored = with("ignore = [[\"lamp\", \"cart\"], [\"foot\", \"cart\"]]");
    lists(&ignored, &[1]);
    let notes = ignored["notes"].to_string();
    assert!(notes.contains("ignored, as the scenario says: cart--lamp"), "{notes}");
    assert!(notes.contains("`ignore` of foot--cart has no effect"), "{notes}");
    let chosen = with("pairs = [[\"*\", \"wall\"], [\"mast\", \"lamp\"]]");
    assert_eq!(chosen["status"], "pass");
    // The mast is 0.4 m above the path, the lamp beside it.
    let to_lamp_m = 0.4_f64.hypot(0.2) - BALL_M - 0.1;
    let worst = &chosen["measures"][0]["worst"];
    assert_eq!(worst["subject"], "mast--lamp");
    assert!((number(&worst["value"]) - to_lamp_m).abs() < 10.0 * DISTANCE_M, "{worst}");
    let notes = chosen["notes"].to_string();
    assert!(notes.contains("only these pairs are checked: cart--wall, mast--lamp, mast--wall"), "{notes}");
    let both = with("pairs = [[\"cart\", \"*\"]]\nignore = [[\"cart\", \"l*\"]]");
    lists(&both, &[1]);
}

#[test]
fn names_that_cannot_be_meant_are_refused() {
    let slide = Slide::new();
    for (lines, line, mention) in [
        ("ignore = [[\"crat\", \"lamp\"]]", 25, "did you mean \"cart\""),
        ("pairs = [[\"cart\", \"lamp\"],\n  [\"cart\", \"lmap\"]]", 26, "did you mean \"lamp\""),
        (
            "pairs = [[\"cart\", \"lamp\"]]\nignore = [[\"lamp\", \"cart\"]]",
            25,
            "is in `pairs` and in `ignore`",
        ),
        ("pairs = [[\"cart\", \"foot\"]]", 25, "neighbouring"),
        ("pairs = [[\"cart\"]]", 25, "length"),
    ] {
        let answer = slide.run(&format!("kind = \"clearance\"\nminimum_m = 0.1\n{lines}"), "json");
        // Beside it is the target outside of the range.
        let findings = answer.json()["findings"].as_array().unwrap().clone();
        let finding = findings.iter().find(|finding| finding["severity"] == "error").unwrap();
        assert_eq!(answer.code, 2, "{finding}");
        assert!(finding.to_string().contains(&mention.replace('"', "\\\"")), "{finding}");
        assert_eq!(finding["line"], line, "{finding}");
    }
}

#[test]
fn the_command_has_a_limit_and_names_too() {
    let slide = Slide::new();
    let robot = slide.robot();
    let clearance = |more: &[&str]| {
        let arguments = ["clearance", &robot, "--at", "slide=0.3"];
        congruent_json(&[&arguments, more].concat())
    };
    let apart_m = 0.7_f64.hypot(0.3) - 2.0 * BALL_M;
    let below = clearance(&["--limit", "700mm"]);
    let document = below.json();
    assert_eq!((below.code, document["pairs"].as_array().unwrap().len()), (1, 1), "{document}");
    let found = &document["below"][0];
    assert_eq!((&found["configuration"], &found["pair"][0]), (&Value::from(1), &Value::from("foot")));
    assert!((number(&found["distance_m"]) - apart_m).abs() < DISTANCE_M, "{found}");
    assert_eq!(clearance(&["--limit", "0.6m"]).code, 0);
    let ignored = clearance(&["--limit", "700mm", "--ignore", "mast,foot"]);
    assert!(
        ignored.code == 2 && ignored.stderr.contains("excludes every measured pair"),
        "{}",
        ignored.stderr
    );
    assert_eq!(clearance(&["--pair", "f*,mast"]).code, 0);
    for wrong in [["--pair", "foot,cart"], ["--ignore", "foot,masd"], ["--limit", "-3mm"], ["--pair", "foot"]]
    {
        assert_eq!(clearance(&wrong).code, 2, "{wrong:?}");
    }
}

#[test]
fn a_joint_is_within_its_limit_by_a_tolerance() {
    let slide = Slide::new();
    // The motion ends 0.5 um beyond the joint's limit.
    let check = slide.check("kind = \"limits\"");
    let measure = &check["measures"][0];
    assert_eq!(
        (&check["status"], &measure["limit"]),
        (&Value::from("pass"), &Value::from(1e-6)),
        "{check:#}"
    );
    assert_eq!(measure["quantity"], "shift_beyond_limit");
    assert!((number(&measure["worst"]["value"]) - 5e-7).abs() < 1e-12, "{measure}");
    let resolved = fs::read_to_string(slide.0.path().join("out/past/scenario.resolved.toml")).unwrap();
    assert!(
        resolved.contains("tolerance_m = 0.000001") || resolved.contains("tolerance_m = 1e-6"),
        "{resolved}"
    );
    let strict = slide.check("kind = \"limits\"\ntolerance_m = 0.0");
    assert_eq!(strict["status"], "fail");
    let stated = slide.check("kind = \"limits\"\ntolerance_mm = 2\ntolerance_deg = 1.0");
    assert_eq!(stated["measures"][0]["limit"], 2e-3);
    let twice = slide.run("kind = \"limits\"\ntolerance_mm = 2.0\ntolerance_m = 1.0", "json");
    assert!(twice.code == 2 && twice.stdout.contains("tolerance_mm"), "{}", twice.stdout);
}

/// The box is far away at first, and links beside each other are always nearer: it is the nearest pair that changes all the same.
#[test]
fn a_pair_that_comes_near_from_afar_is_the_nearest_that_changes() {
    let scratch = tempfile::tempdir().unwrap();
    let pick = text(&workspace().join("scenarios/ur5e_pick.toml"));
    let answer = congruent_json(&["run", &pick, "--no-recording", "--out", &text(scratch.path())]);
    let report = answer.json();
    let checks = report["checks"].as_array().unwrap();
    let nearest = &checks.iter().find(|check| check["check"] == "clearance").unwrap()["nearest_that_changes"];
    assert_eq!(nearest["subject"], "wrist_3_link--box", "{nearest}");
    // The smallest distance of this pair alone is 47.3 mm.
    let distance_m = nearest["value"].as_f64().unwrap();
    assert!((distance_m - 0.0473).abs() < 1e-4, "{nearest}");
}
