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

#[test]
fn a_robot_file_names_files_of_its_project() {
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
            refused(&congruent_alone(&["clearance", project.path("project").as_str()]));
        } else {
            refused(&project.check(line, &[]));
        }
    }
    let outside = project.path("outside");
    let allowed = project.check("urdf = '../outside/r.urdf'", &["--allow", &outside]);
    assert_ne!(allowed.code, 2, "{}", allowed.stderr);
    assert_eq!(project.check("urdf = 'r.urdf'", &["--allow", &project.path("nowhere")]).code, 2);
}

#[cfg(unix)]
#[test]
fn links_are_resolved() {
    let project = Project::new();
    let link = project.0.path().join("project/link.urdf");
    std::os::unix::fs::symlink(project.0.path().join("outside/r.urdf"), link).unwrap();
    refused(&project.check("urdf = 'link.urdf'", &[]));
}

#[test]
fn a_scenario_names_files_of_its_project() {
    let project = Project::new();
    let out = project.path("out");
    let check = |lines: &str| {
        project.write("project/scenarios/s.toml", &format!("schema_version = 1\nname = 's'\n{lines}\n"));
        congruent_alone(&["run", &project.path("project/scenarios/s.toml"), "--no-recording", "--out", &out])
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
