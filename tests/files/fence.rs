//! What a file may name: files of its project, and folders that the command line allows. And what no result replaces.

use std::fs;

use tempfile::TempDir;

use crate::support::{
    command::{Answer, congruent_alone, text},
    corpus::workspace,
};

/// `project/robot.toml` and `project/scenarios/s.toml` beside `outside`, which has a URDF, an SRDF, a mesh and a secret.
struct Project(TempDir);

const URDF: &str = "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='continuous'>\
                    <parent link='a'/><child link='b'/></joint></robot>";

impl Project {
    fn new() -> Self {
        let top = tempfile::tempdir().unwrap();
        for folder in ["project/scenarios", "outside"] {
            fs::create_dir_all(top.path().join(folder)).unwrap();
        }
        fs::create_dir(top.path().join("project/.git")).unwrap();
        let project = Self(top);
        project.write("outside/r.urdf", URDF);
        project.write("outside/secret", "root:x:0:0\nsecond line\n");
        project.write("project/r.urdf", URDF);
        project
    }

    fn path(&self, name: &str) -> String {
        text(&self.0.path().join(name))
    }

    fn write(&self, name: &str, contents: &str) {
        fs::write(self.0.path().join(name), contents).unwrap();
    }

    fn check(&self, robot_file: &str, allow: &[&str]) -> Answer {
        self.write("project/robot.toml", robot_file);
        let robot = self.path("project/robot.toml");
        congruent_alone(&[&["check", robot.as_str()], allow].concat())
    }
}

#[track_caller]
fn refused(answer: &Answer) {
    assert_eq!(answer.code, 2, "{}{}", answer.stdout, answer.stderr);
    // Messages are wrapped by the length of the temporary path.
    let said = answer.stderr.replace("\n  │ ", " ");
    assert!(said.contains("outside of the project folder"), "{}", answer.stderr);
    assert!(!answer.stderr.contains("root:x"), "nothing of it is shown: {}", answer.stderr);
}

const FENCE: &[&str] = &["--fence"];

#[test]
fn behind_a_fence_a_robot_file_names_files_of_its_project() {
    let project = Project::new();
    for line in [
        "urdf = '../outside/r.urdf'",
        "urdf = '/etc/passwd'",
        "urdf = 'r.urdf'\nsrdf = '/etc/passwd'",
        "urdf = 'r.urdf'\nsrdf = '../outside/secret'",
        "urdf = 'r.urdf'\npackages = { root = '/' }",
        "urdf = '../outside/is/not/there.urdf'",
    ] {
        if line.contains("srdf") {
            // Kinematics can do without it, clearance cannot.
            project.write("project/robot.toml", line);
            refused(&congruent_alone(&["clearance", project.path("project").as_str(), "--fence"]));
        } else {
            refused(&project.check(line, FENCE));
        }
    }
    let outside = project.path("outside");
    let allowed = project.check("urdf = '../outside/r.urdf'", &["--fence", "--allow", &outside]);
    assert_ne!(allowed.code, 2, "{}", allowed.stderr);
    assert_eq!(project.check("urdf = 'r.urdf'", &["--allow", &project.path("nowhere")]).code, 2);
}

#[cfg(unix)]
#[test]
fn links_are_resolved() {
    let project = Project::new();
    let link = project.0.path().join("project/link.urdf");
    std::os::unix::fs::symlink(project.0.path().join("outside/r.urdf"), link).unwrap();
    refused(&project.check("urdf = 'link.urdf'", FENCE));
    assert_ne!(project.check("urdf = 'link.urdf'", &[]).code, 2);
}

#[test]
fn behind_a_fence_a_scenario_names_files_of_its_project() {
    let project = Project::new();
    let out = project.path("out");
    let check = |lines: &str| {
        project.write("project/scenarios/s.toml", &format!("schema_version = 1\nname = 's'\n{lines}\n"));
        let scenario = project.path("project/scenarios/s.toml");
        congruent_alone(&["run", &scenario, "--no-recording", "--out", &out, "--fence"])
    };
    let workspace_robot = text(&workspace().join("robots/ur5e"));
    for robot in ["../../outside/r.urdf", "/etc/passwd", &workspace_robot] {
        refused(&check(&format!("robot = '{robot}'\n[controller]\nkind = 'kinematic'")));
    }
    for section in [
        "kind = 'kinematic'\n[[motion]]\nplay_csv = '/etc/passwd'",
        "kind = 'torque'\ntorque_file = '/etc/passwd'",
        "kind = 'kinematic'\n[[obstacle]]\nname = 'o'\nmesh = '../../../../../../../etc/passwd'",
    ] {
        let answer =
            check(&format!("robot = '../r.urdf'\n[simulation]\nduration_s = 1.0\n[controller]\n{section}"));
        assert_eq!(answer.code, 2, "{}", answer.stderr);
        let reason = ["outside of the project", "leaves the project"];
        assert!(reason.iter().any(|reason| answer.stderr.contains(reason)), "{}", answer.stderr);
        assert!(!answer.stderr.contains("root:x"), "{}", answer.stderr);
    }
}

/// Nothing of a file that is not what is expected is on either stream.
#[track_caller]
fn refused_unread(answer: &Answer) {
    let printed = format!("{}{}", answer.stdout, answer.stderr);
    assert_eq!(answer.code, 2, "{printed}");
    assert!(!printed.contains("root:x") && !printed.contains("second line"), "{printed}");
}

#[test]
fn without_a_fence_what_is_expected_is_opened_and_nothing_else_is_shown() {
    let project = Project::new();
    let opened = project.check("urdf = '../outside/r.urdf'", &[]);
    assert_ne!(opened.code, 2, "{}", opened.stderr);
    for line in ["urdf = '../outside/secret'", "urdf = '/etc/passwd'", "urdf = '/dev/zero'"] {
        refused_unread(&project.check(line, &[]));
    }
    project.write("project/robot.toml", "urdf = 'r.urdf'\nsrdf = '../outside/secret'");
    for format in ["text", "json"] {
        refused_unread(&congruent_alone(&["clearance", &project.path("project"), "--format", format]));
    }
    let lint = congruent_alone(&["lint", &project.path("project"), "--format", "sarif"]);
    assert!(!lint.stdout.contains("root:x"), "{}", lint.stdout);
    // A URDF outside with a fault: its place is named, its line is not quoted.
    project
        .write("outside/bad.urdf", "<robot name='r'>\n<link name='a'/><link name='secret_link'/>\n</robot>");
    let bad = project.check("urdf = '../outside/bad.urdf'", &[]);
    assert!(bad.code == 2 && !bad.stderr.contains("<link"), "{}", bad.stderr);
    assert!(bad.stderr.contains("bad.urdf:"), "{}", bad.stderr);
    let allowed = project.check("urdf = '../outside/bad.urdf'", &["--allow", &project.path("outside")]);
    assert!(allowed.stderr.contains("<link name='secret_link'/>"), "{}", allowed.stderr);
}

#[test]
fn without_a_fence_a_scenario_opens_what_is_expected() {
    let project = Project::new();
    let out = project.path("out");
    let run = |lines: &str| {
        project.write("project/scenarios/s.toml", &format!("schema_version = 1\nname = 's'\n{lines}\n"));
        let scenario = project.path("project/scenarios/s.toml");
        congruent_alone(&["run", &scenario, "--no-recording", "--out", &out])
    };
    let rest =
        "[simulation]\nduration_s = 0.01\n[controller]\nkind = 'kinematic'\n[[check]]\nkind = 'agreement'";
    let ran = run(&format!("robot = '../../outside/r.urdf'\n{rest}"));
    assert_eq!(ran.code, 0, "{}{}", ran.stdout, ran.stderr);
    project.write("outside/robot.toml", "token = 'root:x:0:0'\n");
    for robot in ["../../outside/robot.toml", "../../outside/secret", "/etc/passwd", "/dev/zero"] {
        refused_unread(&run(&format!("robot = '{robot}'\n{rest}")));
    }
    for section in [
        "kind = 'kinematic'\n[[motion]]\nplay_csv = '../../outside/secret'",
        "kind = 'torque'\ntorque_file = '../../outside/secret'",
        "kind = 'kinematic'\n[[obstacle]]\nname = 'o'\nmesh = '../../outside/secret'",
    ] {
        refused_unread(&run(&format!(
            "robot = '../r.urdf'\n[simulation]\nduration_s = 1.0\n[controller]\n{section}"
        )));
    }
}

/// An installed package, as those below `/opt/ros`: the URDF in one folder, its meshes in another package.
#[test]
fn a_robot_file_for_an_installed_urdf_is_read_again() {
    let project = Project::new();
    for folder in ["opt/share/arm/urdf", "opt/share/parts/meshes"] {
        fs::create_dir_all(project.0.path().join(folder)).unwrap();
    }
    for package in ["arm", "parts"] {
        project.write(&format!("opt/share/{package}/package.xml"), "<package/>");
    }
    project.write("opt/share/parts/meshes/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n");
    let mesh = "<link name='b'><collision><geometry><mesh filename='package://parts/meshes/a.obj'/></geometry></collision></link>";
    project.write("opt/share/arm/urdf/r.urdf", &URDF.replace("<link name='b'/>", mesh));
    let urdf = project.path("opt/share/arm/urdf/r.urdf");
    let package = format!("parts={}", project.path("opt/share/parts"));
    let new = project.path("project/new");
    let made = congruent_alone(&["new", "robot", &urdf, "--out", &new, "--package", &package]);
    assert_ne!(made.code, 2, "{}", made.stderr);
    for command in ["check", "lint"] {
        let read = congruent_alone(&[command, new.as_str()]);
        assert_ne!(read.code, 2, "{}{}", read.stdout, read.stderr);
        assert!(!read.stderr.contains("not found"), "{}", read.stderr);
    }
    refused(&congruent_alone(&["check", &new, "--fence"]));
}

#[test]
fn no_result_replaces_a_file_that_is_read() {
    let project = Project::new();
    let urdf = project.path("project/r.urdf");
    project.write("project/robot.toml", "urdf = 'r.urdf'");
    let robot = project.path("project/robot.toml");
    project.write("q.json", r#"[{"q": {}}]"#);
    let configurations = project.path("q.json");
    let calls: [&[&str]; 7] = [
        &["check", &robot, "--html", &urdf],
        &["check", &robot, "--html", &robot],
        &["check", &robot, "--junit", &robot],
        &["check", &robot, "--junit", &urdf],
        &["check", &robot, "--summary", &urdf],
        &["check", &robot, "--configurations", &configurations, "--plot", &configurations],
        &["workspace", &robot, "--plot", &urdf],
    ];
    let inputs = [&urdf, &robot, &configurations];
    let before = inputs.map(|input| fs::read(input).unwrap());
    for call in calls {
        let answer = congruent_alone(call);
        assert_eq!(answer.code, 2, "{call:?}: {}", answer.stderr);
        assert!(answer.stderr.contains("output::refused"), "{call:?}: {}", answer.stderr);
        assert_eq!(inputs.map(|input| fs::read(input).unwrap()), before, "{call:?}");
    }
}

#[cfg(feature = "recording")]
#[test]
fn no_output_replaces_what_a_recording_is_compared_with_or_another_output() {
    let project = Project::new();
    project.write("project/robot.toml", "urdf = 'r.urdf'");
    let scenario = "schema_version = 1\nname = 's'\nrobot = '../robot.toml'\n[simulation]\nduration_s = 0.01\n\
                    [controller]\nkind = 'kinematic'\n[[check]]\nkind = 'agreement'\nposition_m = 1e-6\norientation_rad = 1e-6\n";
    project.write("project/scenarios/s.toml", scenario);
    let [robot, urdf, scenario, out, both] = ["robot.toml", "r.urdf", "scenarios/s.toml", "out", "both"]
        .map(|name| project.path(&format!("project/{name}")));
    let ran = congruent_alone(&["run", &scenario, "--out", &out]);
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    let [recording, report, junit, digests] =
        ["recording.rrd", "report.json", "junit.xml", "SHA256SUMS"].map(|name| format!("{out}/s/{name}"));
    let inputs = [&robot, &urdf, &scenario, &recording, &report, &junit, &digests];
    let before = inputs.map(|input| fs::read(input).unwrap());
    let refused = |call: &[&str]| {
        let answer = congruent_alone(call);
        assert_eq!(answer.code, 2, "{call:?}: {}", answer.stderr);
        assert!(answer.stderr.contains("output::refused"), "{call:?}: {}", answer.stderr);
        assert!(inputs.map(|input| fs::read(input).unwrap()) == before, "{call:?}");
    };
    for input in inputs {
        refused(&["inspect", &recording, "--csv", input]);
        refused(&["inspect", &recording, "--summary", input]);
        refused(&["lint", &scenario, "--summary", if input == &urdf { input } else { &robot }]);
    }
    refused(&["inspect", &recording, "--junit", &junit]);
    for call in [
        &["check", &robot, "--html", &both, "--junit", &both][..],
        &["check", &robot, "--summary", &both, "--junit", &both],
        &["run", &scenario, "--out", &out, "--summary", &both, "--junit", &both],
        &["inspect", &recording, "--csv", &both, "--junit", &both],
    ] {
        refused(call);
    }
    // Its own results would replace it.
    let answer = congruent_alone(&["run", &scenario, "--out", &out, "--junit", &junit]);
    assert!((answer.code, answer.stderr.contains("output::refused")) == (2, true), "{}", answer.stderr);
}
