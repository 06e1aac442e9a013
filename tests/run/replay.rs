//! `congruent replay`: logs whose defects are known, as tables of a UR5e whose tool poses are computed here from the published
//! parameters, and logs of the corpus with their truth.

use std::{f64::consts::PI, fmt::Write};

use serde_json::Value;

use crate::support::{
    command::{Answer, congruent, text},
    corpus::corpus,
    golden::{number, read_json},
    scratch_folder::ScratchFolder,
};

type Matrix = [[f64; 4]; 4];

/// Published parameters of the UR5e, in m and rad: a, alpha, d (standard convention).
const UR5E: [[f64; 3]; 6] = [
    [0.0, PI / 2.0, 0.1625],
    [-0.425, 0.0, 0.0],
    [-0.3922, 0.0, 0.0],
    [0.0, PI / 2.0, 0.1333],
    [0.0, -PI / 2.0, 0.0997],
    [0.0, 0.0, 0.0996],
];

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|row| std::array::from_fn(|column| (0..4).map(|k| a[row][k] * b[k][column]).sum()))
}

/// Pose of the flange in the frame `base`, moved by `tool_m` along its z axis: position and rotation vector.
fn tool_pose(q: &[f64; 6], tool_m: f64) -> [f64; 6] {
    let mut pose: Matrix =
        std::array::from_fn(|row| std::array::from_fn(|column| f64::from(u8::from(row == column))));
    for ([a, alpha, d], q) in UR5E.iter().zip(q) {
        let (s, c, sa, ca) = (q.sin(), q.cos(), alpha.sin(), alpha.cos());
        let link = [
            [c, -s * ca, s * sa, a * c],
            [s, c * ca, -c * sa, a * s],
            [0.0, sa, ca, *d],
            [0.0, 0.0, 0.0, 1.0],
        ];
        pose = product(&pose, &link);
    }
    let position: [f64; 3] = std::array::from_fn(|row| pose[row][3] + tool_m * pose[row][2]);
    let angle = ((pose[0][0] + pose[1][1] + pose[2][2] - 1.0) / 2.0).clamp(-1.0, 1.0).acos();
    let factor = if angle < 1e-9 { 0.5 } else { angle / (2.0 * angle.sin()) };
    let vector =
        [pose[2][1] - pose[1][2], pose[0][2] - pose[2][0], pose[1][0] - pose[0][1]].map(|part| part * factor);
    [position[0], position[1], position[2], vector[0], vector[1], vector[2]]
}

/// The joints swing about a bent arm.
fn swing(time_s: f64) -> [[f64; 6]; 2] {
    let q = std::array::from_fn(|joint| {
        let (rate, phase) = (
            0.6 + 0.1 * f64::from(u8::try_from(joint).unwrap()),
            0.7 * f64::from(u8::try_from(joint).unwrap()),
        );
        [0.3, -1.2, 1.4, -0.9, 1.1, 0.2][joint] + 0.4 * (rate * time_s + phase).sin()
    });
    let qd = std::array::from_fn(|joint| {
        let (rate, phase) = (
            0.6 + 0.1 * f64::from(u8::try_from(joint).unwrap()),
            0.7 * f64::from(u8::try_from(joint).unwrap()),
        );
        0.4 * rate * (rate * time_s + phase).cos()
    });
    [q, qd]
}

/// What is wrong with a log.
#[derive(Clone, Copy)]
struct Defect {
    /// Added to the elbow's reading from 4 s on, rad.
    elbow_jump_rad: f64,
    velocity_factor: f64,
    velocity_late_s: f64,
    /// How late the pose is.
    pose_late_s: f64,
    tool_m: f64,
    /// Rows between these times are missing.
    missing_s: [f64; 2],
}

const CLEAN: Defect = Defect {
    elbow_jump_rad: 0.0,
    velocity_factor: 1.0,
    velocity_late_s: 0.0,
    pose_late_s: 0.0,
    tool_m: 0.0,
    missing_s: [1e9; 2],
};

/// 8 s at 125 Hz, as the client library of Universal Robots writes them.
fn table(defect: Defect) -> String {
    let mut rows = "timestamp".to_owned();
    for name in ["actual_q", "actual_qd", "actual_TCP_pose"] {
        (0..6).for_each(|at| write!(rows, " {name}_{at}").unwrap());
    }
    for row in 0..1000 {
        let time_s = f64::from(row) * 0.008;
        if (defect.missing_s[0]..defect.missing_s[1]).contains(&time_s) {
            continue;
        }
        let [mut q, _] = swing(time_s);
        if time_s >= 4.0 {
            q[2] += defect.elbow_jump_rad;
        }
        let qd = swing(time_s - defect.velocity_late_s)[1].map(|qd| qd * defect.velocity_factor);
        let pose = tool_pose(&swing(time_s - defect.pose_late_s)[0], defect.tool_m);
        write!(rows, "\n{time_s:.6}").unwrap();
        q.iter().chain(&qd).chain(&pose).for_each(|value| write!(rows, " {value:.12}").unwrap());
    }
    rows + "\n"
}

/// The answer to a table, and the report.
fn replayed(defect: Defect, options: &[&str]) -> (Answer, Value, String) {
    let scratch = ScratchFolder::new();
    let log = scratch.write("log.csv", &table(defect));
    let out = text(&scratch.path().join("out"));
    let call = [&["replay", "robots/ur5e", &log, "--out", &out, "--no-recording"], options].concat();
    let answer = congruent(&call);
    let report = read_json(&scratch.path().join("out/log/report.json"));
    let scenario = std::fs::read_to_string(scratch.path().join("out/log.toml")).unwrap();
    (answer, report, scenario)
}

#[track_caller]
fn check<'a>(report: &'a Value, kind: &str) -> &'a Value {
    report["checks"].as_array().unwrap().iter().find(|check| check["check"] == kind).unwrap()
}

/// The worst value of a check's first measure.
#[track_caller]
fn worst<'a>(report: &'a Value, kind: &str) -> (f64, &'a Value) {
    let worst = &check(report, kind)["measures"][0]["worst"];
    (number(&worst["value"]), worst)
}

#[test]
fn a_clean_log_is_the_robot_and_its_joint_states_are_those_of_the_table() {
    let (answer, report, scenario) = replayed(CLEAN, &[]);
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
    // Between two rows the joints are interpolated: 125 Hz and 0.4 rad at 1 rad/s leave nothing, since poses are at the rows.
    assert!(worst(&report, "pose").0 < 1e-9, "{report:#}");
    assert!(worst(&report, "velocity").0 < 1e-3);
    assert_eq!(report["simulation"]["steps"], 999);
    assert!((number(&report["simulation"]["duration_s"]) - 7.992).abs() < 1e-9);
    assert!(scenario.contains("origin = \"controller\"") && !scenario.contains("offset_s"), "{scenario}");
    assert_eq!(report["source"]["joints"][0]["joints"][2], "elbow_joint");
}

#[test]
fn a_jump_of_a_zero_has_its_joint_time_and_size() {
    let jump_rad = 0.3_f64.to_radians();
    let defect = Defect { elbow_jump_rad: jump_rad, ..CLEAN };
    let (answer, report, _) = replayed(defect, &["--measured-pose", "actual_TCP_pose"]);
    assert_eq!(answer.code, 1, "{}", answer.stdout);
    let (size_rad, at) = worst(&report, "step");
    assert_eq!(at["subject"], "elbow_joint");
    assert!((size_rad - jump_rad).abs() < 2e-5, "{size_rad}");
    assert!((number(&at["time_s"]) - 4.0).abs() < 0.017, "{at}");
    // The controller would compute its pose from the same encoder: such poses show no jump, and the check is not there.
    let (_, report, _) = replayed(defect, &[]);
    assert!(report["checks"].as_array().unwrap().iter().all(|check| check["check"] != "step"));
}

#[test]
fn velocities_have_their_factor_sign_and_lag() {
    for (factor, late_s, expected) in
        [(180.0 / PI, 0.0, 180.0 / PI - 1.0), (-1.0, 0.0, 2.0), (1.0, 0.16, 0.0)]
    {
        let defect = Defect { velocity_factor: factor, velocity_late_s: late_s, ..CLEAN };
        let (answer, report, _) = replayed(defect, &[]);
        let (error, _) = worst(&report, "velocity");
        assert!((error - expected).abs() < 0.01 * (1.0 + expected), "{factor} {late_s}: {error}");
        assert_eq!(check(&report, "velocity")["status"] == "fail", expected > 0.2, "{}", answer.stdout);
        let notes = check(&report, "velocity")["notes"].to_string();
        assert_eq!(notes.contains("late"), late_s > 0.0, "{notes}");
    }
}

#[test]
fn the_clock_of_the_poses_is_estimated() {
    let (answer, report, scenario) = replayed(Defect { pose_late_s: 0.03, ..CLEAN }, &[]);
    assert_eq!(answer.code, 0, "{}", answer.stdout);
    let offset_s = number(&report["source"]["poses"][0]["offset_s"]);
    assert!((offset_s + 0.03).abs() < 1e-4, "{scenario}");
    // Linear between rows of 8 ms: 0.4 rad at 1.1 rad/s bend by 4e-6 rad.
    assert!(worst(&report, "pose").0 < 5e-5, "{report:#}");
}

#[test]
fn another_tool_is_the_cause() {
    let (answer, report, _) = replayed(Defect { tool_m: 0.012, ..CLEAN }, &[]);
    assert_eq!(answer.code, 1, "{}", answer.stdout);
    assert!((worst(&report, "pose").0 - 0.012).abs() < 1e-6);
    let note = check(&report, "pose")["notes"][0].as_str().unwrap();
    assert!(note.contains("the tool, with the correction tool.z 12 mm"), "{note}");
}

#[test]
fn nothing_is_judged_in_a_gap() {
    let (answer, report, _) = replayed(Defect { missing_s: [2.0, 2.6], ..CLEAN }, &[]);
    assert_eq!(answer.code, 0, "{}", answer.stdout);
    let notes = check(&report, "recording")["notes"].to_string();
    assert!(notes.contains("1 gap of 0.608 s"), "{notes}");
    assert_eq!(report["simulation"]["steps"], 999 - 75);
    assert!(worst(&report, "velocity").0 < 1e-3);
}

/// The same log, the same robot: the written scenario gives the same report, and the same hash.
#[test]
fn the_written_scenario_runs_again() {
    let scratch = ScratchFolder::new();
    let log = scratch.write("log.csv", &table(CLEAN));
    let [first, again] = ["first", "again"].map(|name| text(&scratch.path().join(name)));
    assert_eq!(congruent(&["replay", "robots/ur5e", &log, "--out", &first, "--no-recording"]).code, 0);
    let file = format!("{first}/log.toml");
    let answer = congruent(&["run", &file, "--out", &again, "--no-recording"]);
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
    let report = |out: &str| read_json(&scratch.path().join(out).join("log/report.json"));
    assert_eq!(report("first"), report("again"));
    // A file of somebody else is not replaced.
    std::fs::write(&file, "name = \"mine\"").unwrap();
    let refused = congruent(&["replay", "robots/ur5e", &log, "--out", &first]);
    assert!(refused.code == 2 && refused.stderr.contains("CGR-COMMAND-014"), "{}", refused.stderr);
}

#[test]
fn what_is_not_in_the_log_is_refused_with_what_is() {
    let scratch = ScratchFolder::new();
    let log = scratch.write("log.csv", &table(CLEAN));
    let refused = |robot: &str, options: &[&str], code: &str, words: &str| {
        let out = text(&scratch.path().join("out"));
        let answer = congruent(&[&["replay", robot, &log, "--out", &out], options].concat());
        assert_eq!(answer.code, 2, "{}{}", answer.stdout, answer.stderr);
        assert!(answer.stderr.contains(code) && answer.stderr.contains(words), "{}", answer.stderr);
    };
    refused("robots/panda", &[], "CGR-SCENARIO-092", "shoulder_pan_joint");
    refused("robots/ur5e", &["--measured-pose", "actual_TCP"], "CGR-COMMAND-087", "actual_TCP_pose");
    refused("robots/ur5e", &["--joints", "/joint_states"], "CGR-SCENARIO-094", "log.csv");
    let scenario = "schema_version = 1\nname = \"a\"\nrobot = \"x\"\n[source]\nlog = \"log.csv\"\n[controller]\nkind = \"pd\"\n";
    let answer = congruent(&["run", &scratch.write("a.toml", scenario)]);
    assert!(answer.code == 2 && answer.stderr.contains("CGR-SCENARIO-091"), "{}", answer.stderr);
}

/// A log with a payload that the description does not have: torques, of which friction and a factor explain nearly all.
#[test]
fn recorded_efforts_are_recognised_as_torques() {
    let scratch = ScratchFolder::new();
    let out = text(&scratch.path().join("out"));
    let log = "docs/examples/log/efforts.csv";
    let answer = congruent(&["replay", "robots/ur5e", log, "--out", &out, "--no-recording"]);
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
    assert!(answer.stdout.contains("efforts are torques"), "{}", answer.stdout);
    // Efforts of other joints are no torques of these.
    let shuffled = std::fs::read_to_string(crate::support::corpus::workspace().join(log)).unwrap();
    let shuffled = shuffled
        .replace("elbow_joint_effort", "x")
        .replace("shoulder_lift_joint_effort", "elbow_joint_effort");
    let log = scratch.write("shuffled.csv", &shuffled.replace(",x,", ",shoulder_lift_joint_effort,"));
    let answer = congruent(&["replay", "robots/ur5e", &log, "--out", &out, "--no-recording"]);
    assert_eq!(answer.code, 1, "{}{}", answer.stdout, answer.stderr);
    assert!(answer.stdout.contains("effort     fail"), "{}", answer.stdout);
}

/// A joint that is lost and does not come back: what follows is not a log that nobody has seen.
#[test]
fn instants_behind_the_last_whole_one_count() {
    let scratch = ScratchFolder::new();
    let line = |row: u32| {
        let elbow = if row < 100 { "1.4" } else { "null" };
        let others = r#""shoulder_pan_joint": 0, "shoulder_lift_joint": -1.2, "wrist_1_joint": -1.6, "wrist_2_joint": -1.57, "wrist_3_joint": 0"#;
        format!("{{\"time_s\": {}, \"q\": {{\"elbow_joint\": {elbow}, {others}}}}}\n", 0.01 * f64::from(row))
    };
    let lines: Vec<String> = (0..300).map(line).collect();
    let log = scratch.write("lost.jsonl", &lines.concat());
    let out = text(&scratch.path().join("out"));
    let answer = congruent(&["replay", "robots/ur5e", &log, "--out", &out, "--no-recording"]);
    assert_eq!(answer.code, 1, "{}{}", answer.stdout, answer.stderr);
    assert!(answer.stdout.contains("200 of 300 instants left out"), "{}", answer.stdout);
}

/// Two configurations at rest, whose tool points are 1 and 100 mm apart by the model.
#[test]
fn a_touched_point_has_one_place() {
    let scratch = ScratchFolder::new();
    let run = |second: f64| {
        let head = "time_s,shoulder_pan_joint,shoulder_lift_joint,elbow_joint,wrist_1_joint,wrist_2_joint,wrist_3_joint\n";
        let row = |row: u32| {
            let pan = if row < 100 { 0.0 } else { second };
            format!("{},{pan},-1.2,1.4,-1.6,-1.57,0\n", 0.01 * f64::from(row))
        };
        let rows: Vec<String> = std::iter::once(head.to_owned()).chain((0..200).map(row)).collect();
        scratch.write("log.csv", &rows.concat());
        let check = "[[check]]\nkind = \"same_point\"\nspread_mm = 1\n";
        let robot = text(&crate::support::corpus::workspace().join("robots/ur5e"));
        let scenario = format!(
            "schema_version = 1\nname = \"a\"\nrobot = \"{robot}\"\n[source]\nlog = \"log.csv\"\n{check}"
        );
        let out = text(&scratch.path().join("out"));
        congruent(&["run", &scratch.write("a.toml", &scenario), "--out", &out, "--no-recording"])
    };
    let same = run(0.002);
    assert!(same.code == 0 && same.stdout.contains("the arm stood"), "{}{}", same.stdout, same.stderr);
    let other = run(0.2);
    assert!(other.code == 1 && other.stdout.contains("same_point fail"), "{}{}", other.stdout, other.stderr);
}

/// Logs of the corpus: orders that change, missing joints, NaN; two clocks with drift; degrees and prefixes.
#[test]
fn logs_of_the_corpus_have_their_known_defects() {
    let Some(corpus) = corpus() else { return };
    let scratch = ScratchFolder::new();
    let replay = |robot: &str, name: &str, options: &[&str]| {
        let log = text(&corpus.join("logs/synthetic").join(format!("{name}.mcap")));
        let out = text(&scratch.path().join("out"));
        let robot = format!("robots/{robot}");
        let call = [&["replay", &robot, &log, "--out", &out, "--no-recording"], options].concat();
        let answer = congruent(&call);
        assert_eq!(answer.code, 0, "{name}: {}{}", answer.stdout, answer.stderr);
        read_json(&scratch.path().join("out").join(name).join("report.json"))
    };
    let clean = replay("ur5e", "p1_ur5e_clean_500hz", &[]);
    assert!(worst(&clean, "pose").0 < 1e-9, "{clean:#}");
    let nan = replay("ur5e", "p2_ur5e_order_missing_nan", &[]);
    assert!(worst(&nan, "pose").0 < 8e-6, "{nan:#}");
    let degrees = replay("ur5e", "p5_ur5e_degrees_prefix", &["--degrees"]);
    assert!(worst(&degrees, "pose").0 < 8e-6, "{degrees:#}");
    let clocks = replay("panda", "p4_panda_two_clocks", &[]);
    let poses = &clocks["source"]["poses"][0];
    assert!((number(&poses["offset_s"]) + 0.035).abs() < 2e-5, "{poses}");
    assert!((number(&poses["drift"]) + 2e-4).abs() < 5e-6, "{poses}");
    assert!(worst(&clocks, "pose").0 < 6e-4, "{clocks:#}");
}
