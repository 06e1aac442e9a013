//! A question is stopped by what it needs and by nothing else.

use std::{fs, path::PathBuf, process::Command};

use serde_json::Value;

use crate::support::command::{Answer, congruent, congruent_json, text};

/// Two links that move, with what other programs read past: no material name, no texture file, no effort, an
/// inertia that no body has, and meshes of a package that is not there.
const ARM: &str = r#"<robot name="arm">
<link name="base"/>
<link name="upper">
  <visual><geometry><mesh filename="package://arm_description/upper.stl"/></geometry>
    <material><color rgba="1 1 1 1"/></material></visual>
  <visual><geometry><sphere radius="0.1"/></geometry><material name="m"><texture/></material></visual>
  <collision><geometry><mesh filename="package://arm_description/upper.stl"/></geometry></collision>
  <inertial><mass value="1"/><inertia ixx="0.3" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
</link>
<link name="fore">
  <inertial><mass value="1"/><inertia ixx="0.3" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
</link>
<joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
  <limit lower="-1" upper="1"/></joint>
<joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/><origin xyz="0.5 0 0"/>
  <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="9" velocity="9"/></joint>
</robot>"#;

const TABLE: &str = "[dh]\nconvention = 'standard'\n\
                     [[dh.row]]\njoint = 'shoulder'\nkind = 'revolute'\na_m = 0.5\nalpha_deg = 0\nd_m = 0\n\
                     [[dh.row]]\njoint = 'elbow'\nkind = 'revolute'\na_m = 0\nalpha_deg = 0\nd_m = 0\n";

const REPAIR: &str = "[inertia]\nupper = 'repair'\nfore = 'repair'\n";

const SCENARIO: &str = "schema_version = 1\nname = \"still\"\nrobot = \".\"\n[simulation]\nduration_s = 0.01\n\
                        [controller]\nkind = \"passive\"\n[[check]]\nkind = \"agreement\"\n";

/// A folder with the arm, a robot file and a scenario.
struct ArmFolder(tempfile::TempDir);

impl ArmFolder {
    fn new(robot_file: &str) -> Self {
        let bench = Self(tempfile::tempdir().unwrap());
        bench.write("arm.urdf", ARM);
        bench.write("robot.toml", &format!("urdf = 'arm.urdf'\n{robot_file}"));
        bench.write("scenario.toml", SCENARIO);
        bench
    }

    fn path(&self, name: &str) -> String {
        text(&self.0.path().join(name))
    }

    fn write(&self, name: &str, contents: &str) {
        fs::write(self.0.path().join(name), contents).unwrap();
    }

    fn run(&self) -> Answer {
        congruent(&["run", &self.path("scenario.toml"), "--no-recording", "--out", &self.path("out")])
    }
}

#[track_caller]
fn ends_with(answer: &Answer, code: i32, words: &[&str]) {
    let printed = format!("{}{}", answer.stdout, answer.stderr);
    // Lines are broken at 100 columns.
    let flowing = printed.replace('│', " ").split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(answer.code, code, "{printed}");
    for word in words {
        assert!(flowing.contains(word), "no {word:?} in:\n{printed}");
    }
}

#[test]
fn kinematics_goes_on_with_each_warning_once() {
    let bench = ArmFolder::new("");
    let robot = bench.path("arm.urdf");
    let words = [
        "2 links have an inertia that breaks the triangle inequality: upper, fore (needed only for physics)",
        "mesh file \"package://arm_description/upper.stl\" not found (needed only for clearance)",
        "packages = { arm_description =",
        "--package arm_description=DIR",
        "<texture> has no filename",
        "<material> has no name",
        "<limit> has no effort",
    ];
    for command in ["fk", "jacobian", "workspace", "manipulability", "sensitivity"] {
        let answer = congruent(&[command, &robot]);
        ends_with(&answer, 0, &words);
        assert_eq!(answer.stderr.matches("triangle").count(), 1, "{command}: {}", answer.stderr);
    }
    let document = congruent_json(&["fk", &robot]).json();
    assert_eq!(document["warnings"].as_array().map(Vec::len), Some(7), "{document:#}");
    ends_with(&congruent(&["convert", &robot, "--to", "urdf"]), 0, &words);
    ends_with(&congruent(&["convert", &robot, "--from", "urdf", "--to", "standard"]), 0, &words);
}

#[test]
fn of_several_inputs_a_warning_is_shown_once_and_then_named_in_one_line() {
    let bench = ArmFolder::new(REPAIR);
    for name in ["one", "two", "three"] {
        bench.write(&format!("{name}.toml"), &SCENARIO.replace("still", name));
    }
    let scenarios = ["one", "two", "three"].map(|name| bench.path(&format!("{name}.toml")));
    let [one, two, three] = scenarios.each_ref().map(String::as_str);
    let answer = congruent(&["run", one, two, three, "--no-recording", "--out", &bench.path("out")]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    // Of the mesh as visual and as collision shape.
    assert_eq!(answer.stderr.matches("packages = {").count(), 2, "{}", answer.stderr);
    let named = |scenario: &str| {
        let head = format!("{scenario}.toml: warning, as above: link \"upper\": mesh file");
        answer.stderr.lines().filter(|line| line.contains(&head)).count()
    };
    assert_eq!(["one", "two", "three"].map(named), [0, 2, 2], "{}", answer.stderr);
}

#[test]
fn the_name_of_the_robot_file_is_the_name_in_every_report() {
    let bench = ArmFolder::new(&format!("name = 'cell_7'\n{REPAIR}{TABLE}"));
    bench.write("targets.json", r#"[{"translation_m": [0.4, 0.2, 0]}]"#);
    let (robot, targets) = (bench.path("robot.toml"), bench.path("targets.json"));
    for arguments in [
        &["check", &robot][..],
        &["fk", &robot],
        &["jacobian", &robot],
        &["manipulability", &robot],
        &["sensitivity", &robot],
        &["tolerances", &robot, "--a=1mm"],
        &["workspace", &robot, "--samples", "10"],
        &["dynamics", &robot],
        &["ik", &robot, "--targets", &targets],
    ] {
        assert_eq!(congruent_json(arguments).json()["robot"], "cell_7", "{arguments:?}");
    }
    bench.run();
    let report = fs::read_to_string(bench.path("out/still/report.json")).unwrap();
    assert_eq!(serde_json::from_str::<Value>(&report).unwrap()["robot"], "cell_7");
}

#[test]
fn what_needs_the_part_is_refused_with_what_to_do() {
    let bench = ArmFolder::new("");
    let robot = bench.path("arm.urdf");
    let answer = congruent(&["fk", &robot, "--source", "simulation"]);
    ends_with(
        &answer,
        2,
        &["2 links have an inertia that breaks", "[inertia] upper = \"repair\" fore = \"repair\""],
    );
    assert!(!answer.stderr.contains("not found"), "{}", answer.stderr);
    let answer = congruent(&["clearance", &robot]);
    ends_with(&answer, 2, &["upper.stl\" not found", "packages = {"]);
    assert!(!answer.stderr.contains("triangle"), "{}", answer.stderr);
    ends_with(&bench.run(), 2, &["[inertia] upper = \"repair\" fore = \"repair\""]);
}

#[test]
fn a_run_needs_shapes_only_if_something_can_touch() {
    let bench = ArmFolder::new(REPAIR);
    ends_with(&bench.run(), 0, &["inertia repaired", "pass"]);
    let obstacle = "[[obstacle]]\nname = \"ball\"\nsphere_radius_m = 0.1\nxyz_m = [5, 0, 0]\n";
    bench.write("scenario.toml", &format!("{SCENARIO}{obstacle}"));
    ends_with(&bench.run(), 2, &["upper.stl\" not found"]);
    bench.write("scenario.toml", &SCENARIO.replace("agreement", "clearance\"\nminimum_m = 0.0 #"));
    ends_with(&bench.run(), 2, &["upper.stl\" not found"]);
}

fn not_compared(answer: &Answer) -> Value {
    answer.json()["not_asked"].clone()
}

#[test]
fn a_check_says_which_source_it_could_not_ask() {
    // Table and URDF agree; the physics is not part of the verdict.
    let bench = ArmFolder::new(TABLE);
    let robot = bench.path("robot.toml");
    let answer = congruent(&["check", &robot]);
    ends_with(&answer, 0, &["agree", "not compared: physics: 2 links have an inertia that breaks"]);
    assert!(!answer.stdout.contains("and physics agree"), "{}", answer.stdout);
    let document = congruent_json(&["check", &robot]);
    let asked = not_compared(&document);
    assert_eq!(asked[0]["source"], "simulation");
    assert_eq!(asked[0]["findings"][0]["code"], "urdf::inertia");
    assert_eq!(asked[0]["findings"][0]["places"][1]["name"], "fore");
    assert_eq!(document.json()["comparisons"].as_array().unwrap().len(), 2);
    let warnings = document.json()["warnings"].clone();
    let stops: Vec<&Value> =
        warnings.as_array().unwrap().iter().filter_map(|found| found.get("stops")).collect();
    assert_eq!(stops, ["clearance", "physics"]);
    // A wrong table is diagnosed without the physics.
    bench.write("robot.toml", &format!("urdf = 'arm.urdf'\n{}", TABLE.replace("a_m = 0.5", "a_m = 0.6")));
    ends_with(&congruent(&["check", &robot]), 1, &["disagree", "not compared: physics", "expected"]);
    // Without a table nothing is left to compare, which is no success.
    let bare = congruent(&["check", &bench.path("arm.urdf")]);
    ends_with(&bare, 4, &["NOTHING COMPARED: there is no [dh] table, and the physics was not compared"]);
    let document = congruent_json(&["check", &bench.path("arm.urdf")]);
    assert_eq!((document.code, document.json()["verdict"].clone()), (4, "nothing_compared".into()));
    // Repaired, all are asked.
    bench.write("robot.toml", &format!("urdf = 'arm.urdf'\n{REPAIR}{TABLE}"));
    let document = congruent_json(&["check", &robot]);
    // Its masses are stated once.
    let left = not_compared(&document);
    assert_eq!((document.code, left.as_array().map(Vec::len)), (0, Some(1)), "{}", document.stdout);
    assert_eq!(left[0]["source"], "dynamics");
}

#[test]
fn packages_of_ros_are_found_and_behind_a_fence_only_if_asked_for() {
    let bench = ArmFolder::new(REPAIR);
    let workspace = tempfile::tempdir().unwrap();
    let package: PathBuf = workspace.path().join("src/arm_description");
    fs::create_dir_all(&package).unwrap();
    fs::write(package.join("package.xml"), "<package/>").unwrap();
    let corners = "0 0 0\nvertex 1 0 0\nvertex 0 1 0";
    let facet = format!("facet normal 0 0 1\nouter loop\nvertex {corners}\nendloop\nendfacet\n");
    let tip = facet.replace("0 0 0", "0 0 1");
    fs::write(package.join("upper.stl"), format!("solid a\n{facet}{tip}endsolid a\n")).unwrap();
    let code = |flag: &[&str], variable: &str, value: PathBuf| {
        let arguments = ["clearance", &bench.path("robot.toml"), "--all-pairs"].map(str::to_owned);
        let answer = Command::new(env!("CARGO_BIN_EXE_congruent"))
            .args(arguments)
            .args(flag)
            .env(variable, value)
            .output()
            .unwrap();
        answer.status.code()
    };
    let (fence, ask) = (&["--fence"][..], &["--fence", "--ros-packages"][..]);
    let path = workspace.path().to_owned();
    assert_eq!(code(fence, "ROS_PACKAGE_PATH", path.clone()), Some(2));
    // The mesh is found; with it alone there is no pair to measure.
    for found in [&[], ask] {
        assert_eq!(code(found, "ROS_PACKAGE_PATH", path.clone()), Some(4));
    }
    assert_eq!(code(ask, "AMENT_PREFIX_PATH", path.clone()), Some(2));
    fs::rename(path.join("src"), path.join("share")).unwrap();
    assert_eq!(code(fence, "AMENT_PREFIX_PATH", path.clone()), Some(2));
    assert_eq!(code(&[], "AMENT_PREFIX_PATH", path), Some(4));
}
