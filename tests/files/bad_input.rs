//! Bad input ends with exit code 2, the file, the line where there is one, and what to do.

use std::{fs, path::PathBuf};

use crate::support::{
    command::{congruent, congruent_json, text},
    corpus::workspace,
};

/// A folder with a copy of a small robot and a scenario for it.
struct Workbench {
    folder: tempfile::TempDir,
}

const SCENARIO: &str = "\
schema_version = 1
name = \"bench\"
robot = \"robot\"
[simulation]
duration_s = 0.01
[controller]
kind = \"passive\"
[[motion]]
move_joints_deg = { joint_1 = 0.05 }
duration_s = 0.01
[[check]]
kind = \"agreement\"
";

impl Workbench {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let robot = folder.path().join("robot");
        fs::create_dir(&robot).unwrap();
        for file in ["robot.toml", "planar_2r.urdf"] {
            fs::copy(workspace().join("robots/planar_2r").join(file), robot.join(file)).unwrap();
        }
        let bench = Self { folder };
        bench.write("scenario.toml", SCENARIO);
        bench
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, contents: &str) {
        fs::write(self.path(name), contents).unwrap();
    }

    /// Replaces one piece of a file.
    #[track_caller]
    fn edit(&self, name: &str, from: &str, to: &str) {
        let before = fs::read_to_string(self.path(name)).unwrap();
        assert!(before.contains(from), "{name} has no {from:?}:\n{before}");
        self.write(name, &before.replacen(from, to, 1));
    }

    /// Runs the scenario and expects a refusal whose text has all of `words`, and, where `line` is
    /// not 0, a finding of `file` at that line.
    #[track_caller]
    fn refused(&self, file: &str, line: u64, words: &[&str]) {
        let (scenario, out) = (text(&self.path("scenario.toml")), text(&self.path("out")));
        let arguments = ["run", &scenario, "--no-recording", "--out", &out];
        let answer = congruent(&arguments);
        assert_eq!(answer.code, 2, "{}{}", answer.stdout, answer.stderr);
        for word in words.iter().chain(&[file]) {
            assert!(answer.stderr.contains(word), "no {word:?} in:\n{}", answer.stderr);
        }
        let document = congruent_json(&arguments).json();
        let findings = document["findings"].as_array().unwrap();
        let here = |finding: &&serde_json::Value| {
            finding["file"].as_str().is_some_and(|path| path.ends_with(file)) && finding["line"] == line
        };
        assert!(
            line == 0 || findings.iter().any(|finding| here(&finding)),
            "{file}:{line} not in {document:#}"
        );
    }
}

#[test]
fn the_bench_itself_is_fine() {
    let bench = Workbench::new();
    let (scenario, out) = (text(&bench.path("scenario.toml")), text(&bench.path("out")));
    let answer = congruent(&["run", &scenario, "--no-recording", "--out", &out]);
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
}

#[test]
fn an_unknown_key() {
    let bench = Workbench::new();
    bench.edit("scenario.toml", "[simulation]\nduration_s", "[simulation]\ndurration_s");
    bench.refused("scenario.toml", 5, &["durration_s", "did you mean \"duration_s\"?"]);
}

#[test]
fn every_unknown_key_in_one_run() {
    let bench = Workbench::new();
    bench.edit("scenario.toml", "[simulation]\nduration_s", "sed = 1\n[simulation]\ndurration_s");
    bench.edit("scenario.toml", "kind = \"passive\"", "kind = \"passive\"\nstifness = 1.0");
    bench.edit("scenario.toml", "kind = \"agreement\"", "kind = \"agreement\"\nposition = 1.0");
    let words = ["\"sed\"", "\"durration_s\"", "\"stifness\"", "\"position\""];
    for line in [4, 6, 9, 15] {
        bench.refused("scenario.toml", line, &words);
    }
}

#[test]
fn an_array_with_an_entry_too_many() {
    let bench = Workbench::new();
    bench.edit("scenario.toml", "[controller]", "gravity_m_s2 = [0, 0, 0, -9.81]\n[controller]");
    bench.refused("scenario.toml", 6, &["an array of 3, found 4"]);
}

#[test]
fn an_obstacle_that_cannot_be() {
    for (keys, words) in [
        ("name = \"a\"\ncylinder = [1, 2]", "`cylinder` is a table"),
        ("name = \"a\"\nbox_m = [1, 1, 1e308]", "size or coordinate is 1e308 m"),
        ("name = \"a\"\nsphere_radius_m = 1\nxyz_m = [0, 5e5, 0]", "size or coordinate is 5e5 m"),
        ("name = \"a\"\nsphere_radius_m = 1\nxyz_m = [0, 1e9, 0]", "xyz_m is 1.0e9 m, limit <= 1e6 m"),
        ("name = \"\"\nsphere_radius_m = 1", "name is empty"),
        ("name = \"link_1\"\nsphere_radius_m = 1", "the name of a link"),
        ("name = \"a\"", "exactly one shape"),
    ] {
        let bench = Workbench::new();
        bench.edit("scenario.toml", "[[check]]", &format!("[[obstacle]]\n{keys}\n[[check]]"));
        bench.refused("scenario.toml", 0, &[words]);
    }
}

const ZONE: &str = "[[check]]\nkind = \"zone\"\n[[zone]]\nname = \"a\"\n";

#[test]
fn case_13_a_zone_that_cannot_be() {
    for (keys, words) in [
        ("links = [\"*\"]", ["zone \"a\" must have exactly one shape", "box_m"]),
        ("links = [\"*\"]\nbox_m = [1, -1, 1]", ["above 0", "-1"]),
        ("links = [\"*\"]\nbox_m = [1, 1, 1]\nxyz_m = [0, 5e5, 0]", ["zone \"a\"", "size or coordinate"]),
        ("links = [\"link_11\"]\nbox_m = [1, 1, 1]", ["no link \"link_11\"", "did you mean \"link_1\"?"]),
        ("links = [\"l*9\"]\nbox_m = [1, 1, 1]", ["no moving link with a collision shape \"l*9\"", "link_2"]),
        ("links = [\"tip\"]\nbox_m = [1, 1, 1]", ["\"tip\" has no collision shape", "link_1"]),
        ("links = [\"base*\"]\nbox_m = [1, 1, 1]", ["no moving link", "base_link"]),
        ("links = \"link_1\"\nbox_m = [1, 1, 1]", ["must be an array of strings", "not the text \"link_1\""]),
        ("links = [1]\nbox_m = [1, 1, 1]", ["must be a text in quotes", "not 1"]),
        ("links = []\nbox_m = [1, 1, 1]", ["no link is forbidden", "links = [\"*\"]"]),
        ("link = [\"*\"]\nbox_m = [1, 1, 1]", ["no link is forbidden", "unknown key \"link\""]),
    ] {
        let bench = Workbench::new();
        bench.edit("scenario.toml", "[[check]]", &format!("{ZONE}{keys}\n[[check]]"));
        bench.refused("scenario.toml", 0, &words);
    }
    let bench = Workbench::new();
    let two = format!("{ZONE}links = [\"*\"]\nbox_m = [1, 1, 1]\n{}", &ZONE[ZONE.find("[[z").unwrap()..]);
    bench.edit("scenario.toml", "[[check]]", &format!("{two}links = [\"*\"]\nbox_m = [1, 1, 1]\n[[check]]"));
    bench.refused("scenario.toml", 17, &["two zones are named \"a\""]);
}

#[test]
fn case_13_zones_and_their_check_go_together() {
    let bench = Workbench::new();
    bench.edit("scenario.toml", "kind = \"agreement\"", "kind = \"zone\"");
    bench.refused("scenario.toml", 11, &["nothing to check", "[[zone]]"]);
    let bench = Workbench::new();
    let zone = &ZONE[ZONE.find("[[z").unwrap()..];
    bench.edit("scenario.toml", "[[check]]", &format!("{zone}links = [\"*\"]\nbox_m = [1, 1, 1]\n[[check]]"));
    bench.refused("scenario.toml", 11, &["no check covers the zones", "kind = \"zone\""]);
}

#[test]
fn case_13_an_answer_to_a_violation_that_is_none() {
    for (key, words) in [
        ("on_violation = \"halt\"", ["unknown value \"halt\"", "continue, stop"]),
        ("on_violation = true", ["must be a text in quotes", "not true"]),
        (
            "on_violaton = \"stop\"",
            ["unknown key \"on_violaton\"", "known keys: position_m, position_mm, orientation_rad,"],
        ),
    ] {
        let bench = Workbench::new();
        bench.edit("scenario.toml", "kind = \"agreement\"", &format!("kind = \"agreement\"\n{key}"));
        bench.refused("scenario.toml", 13, &words);
    }
}

#[test]
fn case_23_a_servo_that_cannot_be() {
    for (keys, words) in [
        (
            "servo_tcp = { xyz_m = [1, 0, 0] }\nmethod = \"inverse\"",
            ["\"inverse\"", "pseudo_inverse, transpose"],
        ),
        ("servo_tcp = { xyz_m = [1, 0, 0] }\ngain_per_s = -1", ["above 0", "-1"]),
        ("servo_tcp = { xyz_m = [1, 0, nan] }", ["xyz_m", "NaN"]),
        ("servo_tcp = { xyz = [1, 0, 0] }", ["\"xyz\" needs a unit", "xyz_m or xyz_mm"]),
        ("servo_tcp = { xyz_m = [1, 0, 0] }\nprofile = \"cubic\"", ["unknown key \"profile\"", "gain_per_s"]),
    ] {
        let bench = Workbench::new();
        bench.edit("scenario.toml", "move_joints_deg = { joint_1 = 0.05 }", keys);
        bench.refused("scenario.toml", 0, &words);
    }
    let bench = Workbench::new();
    let servo = "[[motion]]\nservo_tcp = { xyz_m = [1, 0, 0] }\nduration_s = 0.01\n[[motion]]";
    bench.edit("scenario.toml", "[[motion]]", servo);
    bench.edit(
        "scenario.toml",
        "move_joints_deg = { joint_1 = 0.05 }\nduration_s = 0.01",
        "move_joints_deg = { joint_1 = 10 }",
    );
    bench.refused("scenario.toml", 11, &["at the end of a servo_tcp", "`duration_s`"]);
}

#[test]
fn case_23_a_goal_that_cannot_be() {
    for (keys, words) in [
        ("position_m = 1e-6", ["missing key \"tcp\"", "tcp"]),
        ("tcp = { xyz_m = [1, 0, 0] }", ["the check has no `position_m`", "`position_mm`"]),
        (
            "tcp = { xyz_m = [1, 0, 0], rpy_deg = [1, 0, 0] }\nposition_m = 1e-6",
            ["no tolerance `orientation_rad`", "the goal has a rotation"],
        ),
        (
            "tcp = { xyz_m = [1, 0, 0] }\nposition_m = 1\norientation_rad = 1",
            ["the tolerance of a rotation", "for a position give"],
        ),
    ] {
        let bench = Workbench::new();
        bench.edit("scenario.toml", "kind = \"agreement\"", &format!("kind = \"goal\"\n{keys}"));
        bench.refused("scenario.toml", 0, &words);
    }
}

#[test]
fn an_expectation_of_a_check_that_is_not_there() {
    let bench = Workbench::new();
    let scenario = format!("{SCENARIO}[expect]\nverdict = \"fail\"\nchecks = [\"clearance\"]\n");
    bench.write("scenario.toml", &scenario);
    bench.refused("scenario.toml", 15, &["clearance", "has no such check"]);
}

#[test]
fn an_unknown_section() {
    let bench = Workbench::new();
    bench.edit("scenario.toml", "[simulation]", "[simulaton]");
    bench.refused("scenario.toml", 4, &["simulaton", "[simulation]"]);
}

#[test]
fn an_unknown_joint() {
    let bench = Workbench::new();
    bench.edit("scenario.toml", "joint_1", "joint_11");
    bench.refused("scenario.toml", 9, &["joint_11", "did you mean \"joint_1\"?", "joint_2"]);
}

#[test]
fn an_unknown_check() {
    let bench = Workbench::new();
    bench.edit("scenario.toml", "agreement", "agrement");
    bench.refused("scenario.toml", 12, &["agrement", "did you mean \"agreement\"?", "clearance"]);
}

#[test]
fn a_step_of_zero_and_a_tolerance_that_is_not_a_number() {
    let bench = Workbench::new();
    bench.edit("scenario.toml", "duration_s = 0.01", "step_s = 0\nduration_s = 0.01");
    bench.edit("scenario.toml", "kind = \"agreement\"", "kind = \"agreement\"\nposition_m = nan");
    bench.refused("scenario.toml", 5, &["above 0", "NaN"]);
}

#[test]
fn more_steps_than_anyone_waits_for() {
    let bench = Workbench::new();
    bench.edit("scenario.toml", "duration_s = 0.01", "step_s = 1e-6\nduration_s = 1e6");
    bench.refused("scenario.toml", 5, &["1e12 steps"]);
}

#[test]
fn a_start_beyond_a_limit() {
    let bench = Workbench::new();
    bench.edit("scenario.toml", "[controller]", "[start]\njoints_deg = { joint_1 = 1000 }\n[controller]");
    bench.refused("scenario.toml", 7, &["joint \"joint_1\"", "outside"]);
}

#[test]
fn a_malformed_urdf() {
    let bench = Workbench::new();
    bench.edit("robot/planar_2r.urdf", "</robot>", "");
    bench.refused("planar_2r.urdf", 0, &["robot"]);
}

/// The mesh is only drawn, so the run goes on.
#[test]
fn a_missing_mesh_of_a_visual_is_a_warning() {
    let bench = Workbench::new();
    let urdf = fs::read_to_string(bench.path("robot/planar_2r.urdf")).unwrap();
    let start = urdf.find("<geometry>").unwrap();
    let end = urdf.find("</geometry>").unwrap();
    let line = urdf[..start].matches('\n').count() as u64 + 1;
    let mesh = "<geometry><mesh filename=\"nowhere.stl\"/>";
    bench.write("robot/planar_2r.urdf", &format!("{}{mesh}{}", &urdf[..start], &urdf[end..]));
    let arguments =
        ["run", &text(&bench.path("scenario.toml")), "--no-recording", "--out", &text(&bench.path("out"))];
    let answer = congruent_json(&arguments);
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
    let warning = &answer.json()["warnings"][0];
    assert_eq!((warning["code"].as_str(), warning["line"].as_u64()), (Some("mesh::not_found"), Some(line)));
    assert!(congruent(&arguments).stderr.contains("nowhere.stl"));
}

#[test]
fn a_table_with_a_row_too_few() {
    let bench = Workbench::new();
    let file = fs::read_to_string(bench.path("robot/robot.toml")).unwrap();
    let second = file.rfind("[[dh.row]]").unwrap();
    let rest = file[second + 2..].find("\n[").map_or("", |next| &file[second + 2 + next..]);
    bench.write("robot/robot.toml", &format!("{}{rest}", &file[..second]));
    bench.refused("robot.toml", 0, &["joint_2", "row"]);
}

#[test]
fn a_table_without_a_convention() {
    let bench = Workbench::new();
    bench.edit("robot/robot.toml", "convention = \"standard\"", "");
    bench.refused("robot.toml", 0, &["convention", "standard", "modified"]);
}

#[test]
fn a_scenario_that_does_not_exist() {
    let answer = congruent(&["run", "scenarios/nowhere.toml"]);
    assert_eq!(answer.code, 2, "{}", answer.stderr);
    assert!(
        answer.stderr.contains("nowhere.toml") && answer.stderr.contains("not exist"),
        "{}",
        answer.stderr
    );
}

#[test]
fn an_output_folder_that_cannot_be_written() {
    let bench = Workbench::new();
    bench.write("out", "a file where a folder should be");
    bench.refused("out", 0, &["cannot write", "--out"]);
}

#[test]
fn one_that_cannot_run_is_in_one_document_with_the_others() {
    let bench = Workbench::new();
    bench.write("other.toml", &SCENARIO.replacen("bench", "other", 1));
    fs::create_dir(bench.path("out")).unwrap();
    bench.write("out/other", "a file where a folder should be");
    let [a, b, out, junit] =
        ["scenario.toml", "other.toml", "out", "new/folder/junit.xml"].map(|name| text(&bench.path(name)));
    let answer =
        congruent_json(&["run", &a, &b, "--jobs", "2", "--no-recording", "--out", &out, "--junit", &junit]);
    assert_eq!(answer.code, 2, "{}{}", answer.stdout, answer.stderr);
    let document = answer.json();
    assert_eq!(document[0]["verdict"], "as_expected");
    assert_eq!(document[1]["findings"][0]["code"], "run::output");
    assert!(fs::read_to_string(&junit).unwrap().contains("testsuite name=\"bench\""));
}

#[test]
fn a_run_that_ends_before_its_motions_says_so() {
    let bench = Workbench::new();
    bench.edit("scenario.toml", "duration_s = 0.01\n[controller]", "duration_s = 0.005\n[controller]");
    let (scenario, out) = (text(&bench.path("scenario.toml")), text(&bench.path("out")));
    let answer = congruent_json(&["run", &scenario, "--no-recording", "--out", &out]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    assert_eq!(answer.json()["warnings"][0]["code"], "scenario::cut_short");
}

#[test]
fn a_joint_that_is_given_twice() {
    let answer = congruent(&["fk", "robots/ur5e", "--at", "elbow_joint=1rad", "--at", "elbow_joint=2rad"]);
    assert_eq!(answer.code, 2);
    assert!(answer.stderr.contains("given already, by --at elbow_joint=1rad"), "{}", answer.stderr);
}

#[test]
fn a_scenario_without_checks_is_no_success() {
    let bench = Workbench::new();
    bench.edit("scenario.toml", "[[check]]\nkind = \"agreement\"\n", "");
    let (scenario, out) = (text(&bench.path("scenario.toml")), text(&bench.path("out")));
    let answer = congruent(&["run", &scenario, "--no-recording", "--out", &out]);
    assert_eq!(answer.code, 4, "{}{}", answer.stdout, answer.stderr);
}

#[test]
fn a_configuration_with_an_unknown_joint() {
    let answer = congruent(&["fk", "robots/ur5e", "--at", "elbow=1rad"]);
    assert_eq!(answer.code, 2);
    assert!(answer.stderr.contains("did you mean \"elbow_joint\"?"), "{}", answer.stderr);
}
