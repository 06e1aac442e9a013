//! Tables of what happened in a run: their columns, their numbers, and what becomes of them if a run breaks.

use std::{collections::BTreeMap, fs, path::Path};

use crate::support::{
    command::{congruent, text},
    corpus::workspace,
    scratch_folder::ScratchFolder,
};

/// A run of the UR5e over a box with these lines under `[output]`.
fn scenario(scratch: &ScratchFolder, name: &str, output: &str) -> String {
    let robot = text(&workspace().join("robots/ur5e"));
    let text = format!(
        r#"schema_version = 1
name = "{name}"
robot = {robot:?}
[start]
joints_deg = {{ shoulder_lift_joint = -90.0, elbow_joint = 90.0, wrist_1_joint = -90.0, wrist_2_joint = -90.0 }}
[controller]
kind = "gravity_compensation"
stiffness = 2000.0
damping = 120.0
[[motion]]
move_joints_deg = {{ shoulder_pan_joint = 9, elbow_joint = 98 }}
duration_s = 0.1
[[obstacle]]
name = "box, red"
box_m = [0.1, 0.1, 0.1]
xyz_m = [0.5, 0.1, 0.05]
[[check]]
kind = "agreement"
[output]
{output}
"#
    );
    scratch.write(&format!("{name}.toml"), &text)
}

fn run(scratch: &ScratchFolder, file: &str) -> std::path::PathBuf {
    let out = scratch.path().join("out");
    let answer = congruent(&["run", file, "--out", &text(&out)]);
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
    out.join(Path::new(file).file_stem().unwrap())
}

/// The cells of each column.
fn columns(path: &Path) -> BTreeMap<String, Vec<String>> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let names: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let mut columns: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for record in reader.records() {
        for (name, cell) in names.iter().zip(record.unwrap().iter()) {
            columns.entry(name.clone()).or_default().push(cell.to_owned());
        }
    }
    columns
}

#[test]
fn a_table_has_what_happened() {
    let scratch = ScratchFolder::new();
    let folder = run(&scratch, &scenario(&scratch, "table", "trajectory = \"csv\""));
    let columns = columns(&folder.join("trajectory.csv"));
    assert_eq!(columns["step"], (0..=100).map(|step| step.to_string()).collect::<Vec<_>>());
    let numbers = |name: &str| -> Vec<f64> {
        let cells = columns.get(name).unwrap_or_else(|| panic!("no {name} in {:?}", columns.keys()));
        cells.iter().map(|cell| cell.parse().unwrap()).collect()
    };
    assert!((numbers("time_s")[100] - 0.1).abs() < 1e-15);
    // 9 degrees further, and the twin on its path there behind the reference.
    let reference = numbers("shoulder_pan_joint.reference_q_rad");
    assert!((reference[100] - 9_f64.to_radians()).abs() < 1e-12, "{}", reference[100]);
    let q = numbers("shoulder_pan_joint.q_rad");
    assert!(q[50] > 0.0 && q[50] < reference[50], "{} {}", q[50], reference[50]);
    assert_eq!(q, numbers("shoulder_pan_joint.measured_q_rad"), "encoders without faults");
    // The speed is the change of the position, of a step that is integrated semi-implicitly.
    let qd = numbers("shoulder_pan_joint.qd_rad_s");
    let by_difference = (q[61] - q[60]) / 1e-3;
    assert!((by_difference - qd[61]).abs() < 1e-3 * qd[61], "{by_difference} {}", qd[61]);
    // Before the first step no torque was exerted; afterwards the arm is held up.
    let effort = numbers("shoulder_lift_joint.effort_n_m");
    assert!(effort[0] == 0.0 && effort[1].abs() > 1.0, "{} {}", effort[0], effort[1]);
    let distance = |source: &str, at: usize| numbers(&format!("{source}.x_m"))[at];
    assert!((distance("twin_tcp", 80) - distance("model_tcp", 80)).abs() < 1e-12);
    let length: f64 =
        ["w", "x", "y", "z"].iter().map(|c| numbers(&format!("twin_tcp.quaternion_{c}"))[80].powi(2)).sum();
    assert!((length - 1.0).abs() < 1e-12, "{length}");
    assert!(numbers("position_error_m").iter().all(|&error| error < 1e-12));
    assert!(numbers("clearance_m").iter().all(|&distance| distance > 0.0));
    assert!(
        columns["clearance_pair"].iter().all(|pair| pair.contains("--")),
        "{:?}",
        columns["clearance_pair"]
    );
    assert!(columns["orientation_error_link"].iter().all(|link| !link.is_empty()));
    assert!(!folder.join("trajectory.csv.partial").exists());
}

#[test]
fn a_period_thins_the_rows_and_keeps_the_last() {
    let scratch = ScratchFolder::new();
    let file = scenario(&scratch, "thin", "trajectory = \"csv\"\ntrajectory_period_s = 0.03");
    let steps = columns(&run(&scratch, &file).join("trajectory.csv")).remove("step").unwrap();
    assert_eq!(steps, ["0", "30", "60", "90", "100"]);
}

#[test]
fn a_log_has_the_positions_of_the_table_and_the_robot() {
    use congruent::logs::{LogEvent, LogOptions, open_log};
    let scratch = ScratchFolder::new();
    let mut table =
        columns(&run(&scratch, &scenario(&scratch, "table", "trajectory = \"csv\"")).join("trajectory.csv"));
    let measured = table.remove("elbow_joint.measured_q_rad").unwrap();
    let log = run(&scratch, &scenario(&scratch, "log", "trajectory = \"mcap\"")).join("trajectory.mcap");
    let mut reader = open_log(&log, &LogOptions::default()).unwrap();
    let mut rows = Vec::new();
    while let Some(event) = reader.next_event().unwrap() {
        let LogEvent::Joints(joints) = event else { continue };
        if reader.topics()[joints.topic].name == "/joint_states" {
            let elbow = joints.names.iter().position(|name| name == "elbow_joint").unwrap();
            rows.push(joints.position[elbow]);
        }
    }
    let measured: Vec<f64> = measured.iter().map(|cell| cell.parse().unwrap()).collect();
    // Equal to the last bit: both are written from the same sample.
    assert_eq!(rows, measured);
    let robot = text(&workspace().join("robots/ur5e"));
    let answer = congruent(&["check", &robot, "--against", &text(&log), "-q"]);
    assert!(answer.code == 0 && answer.stdout.contains("SAME ROBOT"), "{}{}", answer.stdout, answer.stderr);
}

#[test]
fn both_formats_hold_the_same_numbers() {
    use congruent::results::trajectory_file::open;
    let scratch = ScratchFolder::new();
    let csv = run(&scratch, &scenario(&scratch, "as_csv", "trajectory = \"csv\"")).join("trajectory.csv");
    let parquet = run(&scratch, &scenario(&scratch, "as_parquet", "trajectory = \"parquet\""))
        .join("trajectory.parquet");
    let [mut csv, mut parquet] = [csv, parquet].map(|path| open(&path).unwrap());
    assert_eq!(csv.columns(), parquet.columns());
    let (mut a, mut b, mut rows) = (Vec::new(), Vec::new(), 0);
    while csv.next_row(&mut a).unwrap() {
        assert!(parquet.next_row(&mut b).unwrap());
        // Equal numbers: the text of a number is read back as the same number.
        assert_eq!(a, b);
        rows += 1;
    }
    assert!(!parquet.next_row(&mut b).unwrap());
    assert_eq!(rows, 101);
}

#[test]
fn the_rows_so_far_remain_of_a_run_that_breaks() {
    let scratch = ScratchFolder::new();
    let robot = text(&workspace().join("robots/ur5e"));
    // Gravity that no number can follow.
    let text_of_file = format!(
        "schema_version = 1\nname = \"broken\"\nrobot = {robot:?}\n[simulation]\nduration_s = 1.0\n\
         gravity_m_s2 = [0.0, 0.0, -1e60]\n[controller]\nkind = \"passive\"\n[[check]]\nkind = \"agreement\"\n\
         [output]\ntrajectory = \"csv\"\n"
    );
    let file = scratch.write("broken.toml", &text_of_file);
    let out = scratch.path().join("out");
    let answer = congruent(&["run", &file, "--out", &text(&out), "--no-recording"]);
    assert_eq!(answer.code, 3, "{}{}", answer.stdout, answer.stderr);
    let steps = columns(&out.join("broken/trajectory.csv")).remove("step").unwrap();
    assert!(steps.first().is_some_and(|step| step == "0") && steps.len() < 1000, "{} rows", steps.len());
    assert!(out.join("broken/report.json").exists());
}

#[test]
fn wrong_periods_are_refused_at_their_line() {
    let scratch = ScratchFolder::new();
    for (output, message) in [
        ("trajectory = \"csv\"\ntrajectory_period_s = 0.0015", "not a multiple of step_s"),
        ("trajectory = \"csv\"\ntrajectory_period_s = 0.0001", "not a multiple of step_s"),
        ("trajectory_period_s = 0.01", "no trajectory is written"),
        ("trajectory = \"xlsx\"", "xlsx"),
        ("trajectroy = \"csv\"", "trajectory"),
        ("trajectory = \"csv\"\ntrajectory_period_s = nan", "finite"),
    ] {
        let file = scenario(&scratch, "refused", output);
        let answer = congruent(&["run", &file, "--out", &text(&scratch.path().join("out"))]);
        assert_eq!(answer.code, 2, "{output}: {}{}", answer.stdout, answer.stderr);
        assert!(answer.stderr.contains(message), "{output}: {}", answer.stderr);
        assert!(!fs::exists(scratch.path().join("out/refused/trajectory.csv")).unwrap());
    }
}

#[test]
fn a_table_that_a_run_has_written_is_played_back() {
    let scratch = ScratchFolder::new();
    let table = run(&scratch, &scenario(&scratch, "first", "trajectory = \"csv\"")).join("trajectory.csv");
    let parquet =
        run(&scratch, &scenario(&scratch, "parquet", "trajectory = \"parquet\"")).join("trajectory.parquet");
    let written = columns(&table);
    // A name with a comma, as of "box, red", is in quotes.
    let plain = fs::read_to_string(&table).unwrap();
    let quoted = plain.replace("wrist_1_link--wrist_3_link", "\"wrist_1_link--box, red\"");
    assert_ne!(plain, quoted);
    fs::write(&table, quoted).unwrap();
    for (name, table) in [("from_csv", &table), ("from_parquet", &parquet)] {
        let file = scratch.write(&format!("{name}.toml"), &playing(name, table));
        let played = columns(&run(&scratch, &file).join("trajectory.csv"));
        for name in ["shoulder_pan_joint.q_rad", "elbow_joint.q_rad"] {
            let numbers =
                |cells: &[String]| -> Vec<f64> { cells.iter().map(|cell| cell.parse().unwrap()).collect() };
            let [first, again] = [&written, &played].map(|columns| numbers(&columns[name]));
            assert_eq!(first.len(), again.len());
            for (first, again) in first.iter().zip(&again) {
                assert!((first - again).abs() < 1e-9, "{name}: {first} and {again}");
            }
        }
    }
}

/// A scenario of the UR5e that follows a table.
fn playing(name: &str, table: &Path) -> String {
    let robot = text(&workspace().join("robots/ur5e"));
    format!(
        r#"schema_version = 1
name = {name:?}
robot = {robot:?}
[start]
joints_deg = {{ shoulder_lift_joint = -90.0, elbow_joint = 90.0, wrist_1_joint = -90.0, wrist_2_joint = -90.0 }}
[controller]
kind = "kinematic"
[[motion]]
play_csv = {:?}
between = "linear"
[[check]]
kind = "agreement"
[output]
trajectory = "csv"
"#,
        text(table)
    )
}
