//! What every command prints for people: results, help and errors, held against the files in `tests/snapshots/`.
//! `INSTA_UPDATE=always cargo test --release snapshots` writes them anew after a change that is meant; the change
//! is then read in the diff. What machines may disagree on, the last digits, is replaced by a word in brackets.

use std::{fmt::Write, fs, path::Path};

use insta::{Settings, assert_snapshot};

use crate::{
    calibration::Bench,
    command::{Answer, congruent, text},
    corpus::workspace,
};

const COMMANDS: [&str; 13] = [
    "run",
    "check",
    "fk",
    "jacobian",
    "ik",
    "manipulability",
    "workspace",
    "sensitivity",
    "clearance",
    "calibrate",
    "derive",
    "convert",
    "inspect",
];

/// Patterns of what is rounding, and what stands for it.
const ROUNDING: [(&str, &str); 4] = [
    // A residual has decimals; a tolerance, 1e-12, has none and stays.
    (r"( ?) *\b\d\.\d+e(?:-[123]\d|0)\b", "$1<rounding>"),
    // Which link or sample a residual of rounding is largest at.
    (r"(<rounding>(?: m| rad)?) +at \w+(?: \(\d+\.\d+ s\))?", "$1 at <place>"),
    // The sign of zero, first after the name of a joint and then in columns.
    (r"\b([A-Za-z]\w*) -(0\.0+)\b", "$1 $2"),
    (r"-(0\.0+)\b", " $1"),
];

/// The configuration of an extreme: many are as far, and rounding chooses one of them.
const CONFIGURATION: (&str, &str) = (r"(joint(?:_\d+)?) -?\d+\.\d+\b", "$1 <any>");

/// What a command printed, and with which code it ended, against the snapshot `name`.
#[track_caller]
fn matches(name: &str, answer: &Answer, filters: &[(&str, &str)]) {
    let mut printed = answer.stdout.clone();
    if !answer.stderr.is_empty() {
        write!(printed, "--- standard error ---\n{}", answer.stderr).unwrap();
    }
    writeln!(printed, "--- exit code {} ---", answer.code).unwrap();
    let mut settings = Settings::new();
    settings.set_snapshot_path(workspace().join("tests/snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.set_filters(filters.iter().chain(&ROUNDING).copied().collect::<Vec<_>>());
    settings.bind(|| assert_snapshot!(name, printed));
}

/// Runs a command whose arguments hold no space.
#[track_caller]
fn prints(name: &str, arguments: &str) {
    matches(name, &congruent(&words(arguments)), &[]);
}

/// The same, without the configurations of extremes.
#[track_caller]
fn prints_extremes(name: &str, arguments: &str) {
    matches(name, &congruent(&words(arguments)), &[CONFIGURATION]);
}

/// The same with files of the test: `FOLDER` in the arguments is their folder.
#[track_caller]
fn prints_in(name: &str, folder: &Path, arguments: &str) {
    let folder = text(folder);
    let arguments: Vec<String> =
        words(arguments).iter().map(|word| word.replace("FOLDER", &folder)).collect();
    matches(name, &congruent(&arguments), &[(&folder, "FOLDER"), CONFIGURATION]);
}

fn words(arguments: &str) -> Vec<&str> {
    arguments.split_whitespace().collect()
}

#[test]
fn help() {
    prints("help", "--help");
    for command in COMMANDS {
        prints(&format!("help_{command}"), &format!("{command} --help"));
    }
}

#[test]
fn run() {
    let folder = tempfile::tempdir().unwrap();
    let run = |name: &str, arguments: &str| {
        prints_in(name, folder.path(), &format!("run {arguments} --no-recording --out FOLDER/out"));
    };
    run("run_passes", "scenarios/ur5e_pick.toml");
    run("run_fails_as_expected", "scenarios/ur5e_into_table.toml");
    run("run_stops_as_expected", "scenarios/ur5e_into_zone.toml");
    run("run_fails", "scenarios/ur5e_pick.toml --set check.2.minimum_m=0.05");
    run("run_does_not_fail_as_expected", "scenarios/ur5e_pick.toml --set expect.verdict=fail");
    run("run_several", "scenarios/rrr_arm_wave.toml scenarios/ur5e_tool_5mm_off.toml");
}

#[test]
fn check() {
    prints_extremes("check_agrees", "check robots/ur5e");
    prints_extremes("check_agrees_basics", "check robots/planar_2r --basics");
    prints_extremes("check_wrong_convention", "check robots/ur5e/wrong_convention.toml");
    let bench = Bench::new();
    // 2 degrees and 3 mm, of two joints.
    bench.robot("ur5e", &[("d_m = 0.1333", "d_m = 0.1363")]);
    prints_in("check_one_parameter", bench.path(), "check FOLDER/ur5e");
}

#[test]
fn fk() {
    prints("fk_urdf", "fk robots/ur5e --at elbow_joint=1.2");
    prints("fk_dh", "fk robots/ur5e --source dh --at elbow_joint=1.2");
}

#[test]
fn jacobian() {
    prints("jacobian", "jacobian robots/ur5e --at elbow_joint=1.2 --at wrist_2_joint=0.5");
}

#[test]
fn ik() {
    let bench = Bench::new();
    bench.write("near.json", r#"[{"translation_m": [0.7, 0.2, 0]}]"#);
    bench.write("far.json", r#"[{"translation_m": [0.7, 0.2, 0]}, {"translation_m": [1.5, 0, 0]}]"#);
    prints_in("ik_reached", bench.path(), "ik robots/planar_2r --targets FOLDER/near.json");
    prints_in("ik_out_of_reach", bench.path(), "ik robots/planar_2r --targets FOLDER/far.json");
}

#[test]
fn manipulability() {
    prints("manipulability", "manipulability robots/ur5e --at elbow_joint=1.2 --at wrist_2_joint=0.5");
}

#[test]
fn workspace_of_an_arm() {
    prints_extremes("workspace", "workspace robots/planar_2r --samples 20000");
}

#[test]
fn sensitivity() {
    prints_extremes("sensitivity", "sensitivity robots/spatial_3r");
}

#[test]
fn clearance() {
    prints("clearance", "clearance robots/ur5e --at elbow_joint=1.2");
}

#[test]
fn calibrate() {
    let bench = Bench::new();
    bench.write("points.csv", POINTS);
    bench.write("outlier.csv", &POINTS.replace("0.640,0.735", "0.640,0.835"));
    prints_in("calibrate", bench.path(), "calibrate robots/planar_2r FOLDER/points.csv");
    prints_in(
        "calibrate_outlier",
        bench.path(),
        "calibrate robots/planar_2r FOLDER/outlier.csv --noise-mm 5",
    );
}

/// Five points of the planar arm, from a lecture.
const POINTS: &str = "\
joint_1_deg,joint_2_deg,x_m,y_m
0,0,1.000,0.015
30,-45,0.900,0.210
60,-30,0.640,0.735
-20,10,0.956,-0.322
10,40,0.735,0.456
";

#[test]
fn derive() {
    prints("derive", "derive robots/ur5e --convention modified");
}

#[test]
fn convert() {
    prints("convert_modified", "convert robots/planar_2r --to modified");
    prints("convert_poe", "convert robots/planar_2r --to poe");
    prints("convert_urdf", "convert robots/planar_2r --to urdf");
}

#[cfg(feature = "recording")]
#[test]
fn inspect() {
    let folder = tempfile::tempdir().unwrap();
    let out = text(folder.path());
    let answer = congruent(&["run", "scenarios/ur5e_tool_5mm_off.toml", "--out", &out]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    prints_in("inspect", folder.path(), "inspect FOLDER/ur5e_tool_5mm_off/recording.rrd");
}

#[test]
fn errors() {
    prints("error_unknown_joint", "fk robots/ur5e --at elbow=1.2");
    prints("error_missing_robot", "check robots/ur5");
    prints("error_missing_scenario", "run scenarios/ur5e_pik.toml");
    prints("error_unknown_command", "chek robots/ur5e");
    prints("error_unknown_option", "check robots/ur5e --sed 3");
    prints("error_no_such_key", "run scenarios/ur5e_pick.toml --set simulation.step=0.01");
    let bench = Bench::new();
    let scenario = fs::read_to_string(workspace().join("scenarios/ur5e_pick.toml")).unwrap();
    bench.write("typing_error.toml", &scenario.replace("step_s", "steps_s"));
    prints_in("error_scenario_key", bench.path(), "run FOLDER/typing_error.toml --out FOLDER/out");
    bench.write("points.csv", &POINTS.replace("0.640", "oops"));
    prints_in("error_measurement", bench.path(), "calibrate robots/planar_2r FOLDER/points.csv");
}
