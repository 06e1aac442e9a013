//! `congruent replay` of SQLite bags of the corpus, against the truth beside them.

use serde_json::Value;

use crate::support::{
    command::{congruent, text},
    corpus::{corpus, workspace},
    golden::{number, read_json},
    scratch_folder::ScratchFolder,
};

/// The worst value of the first measure of a check.
fn worst<'a>(report: &'a Value, kind: &str) -> &'a Value {
    let checks = report["checks"].as_array().unwrap();
    &checks.iter().find(|check| check["check"] == kind).unwrap()["measures"][0]["worst"]
}

/// An encoder whose zero jumps by 0.4 deg while a tracker measures the tool.
#[test]
fn a_step_of_an_encoder_is_found() {
    /// Of the time and of the angle, as the truth says them.
    const WITHIN_S: f64 = 0.008;
    const WITHIN_RAD: f64 = 5e-5;
    let Some(corpus) = corpus() else { return };
    let (scratch, name) = (ScratchFolder::new(), "p3_ur5e_encoder_step");
    let synthetic = corpus.join("logs/synthetic");
    let log = text(&synthetic.join(name));
    let out = text(&scratch.path().join("out"));
    let answer = congruent(&["replay", "robots/ur5e", &log, "--out", &out, "--no-recording"]);
    assert_eq!(answer.code, 1, "{}{}", answer.stdout, answer.stderr);
    let report = read_json(&scratch.path().join("out").join(name).join("report.json"));
    let truth = read_json(&synthetic.join(format!("{name}.truth.json")));
    let (step, truth) = (worst(&report, "step"), &truth["expected"]["change_point"]);
    assert_eq!(step["subject"], truth["joint"]);
    assert!((number(&step["value"]) - number(&truth["value_rad"])).abs() < WITHIN_RAD, "{step}");
    // The truth counts from the first joint state, the report from the first message, which is half a second before.
    assert!((number(&step["time_s"]) - 0.5 - number(&truth["t_s"])).abs() < WITHIN_S, "{step}");
}

/// Joints on three topics, with gaps: the poses of the arm are compared beside them, and nothing in them.
#[test]
fn poses_of_an_arm_whose_joints_are_on_three_topics() {
    let Some(corpus) = corpus() else { return };
    let scratch = ScratchFolder::new();
    let log = text(&corpus.join("logs/synthetic/p6_panda_split_gaps"));
    let robot = text(&workspace().join("robots/panda"));
    let scenario = format!(
        "schema_version = 1\nname = \"arm\"\nrobot = \"{robot}\"\n[source]\nlog = \"{log}\"\n\
         [[source.pose]]\ntopic = \"/franka/ee_pose\"\norigin = \"controller\"\nframe = \"panda_link0\"\n\
         [[check]]\nkind = \"agreement\"\non_violation = \"continue\"\n"
    );
    let out = text(&scratch.path().join("out"));
    let scenario = scratch.write("arm.toml", &scenario);
    let answer = congruent(&["run", &scenario, "--out", &out, "--no-recording"]);
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
    let report = read_json(&scratch.path().join("out/arm/report.json"));
    // 11.6 um: what linear interpolation over 8 ms costs.
    assert!(number(&worst(&report, "pose")["value"]) < 1.2e-5, "{report:#}");
}
