//! What every command prints for people: results, help and errors, held against the files in `tests/snapshots/`.
//! `INSTA_UPDATE=always cargo test --release snapshots` writes them anew after a change that is meant; the change
//! is then read in the diff. What machines may disagree on, the last digits, is replaced by a word in brackets.

use std::{fmt::Write, fs, path::Path};

use insta::{Settings, assert_snapshot};

use crate::{
    calibration::{Bench, CASE_04},
    command::{Answer, congruent, text},
    corpus::workspace,
};

const COMMANDS: [&str; 18] = [
    "run",
    "check",
    "describe",
    "fk",
    "dynamics",
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
    "view",
    "completions",
    "man",
];

/// A pattern, and what stands for it in the snapshot.
type Filter<'a> = (&'a str, &'a str);

/// What rounding decides, in everything that is printed.
const ROUNDING: [Filter; 4] = [
    // A residual has decimals; a tolerance, 1e-12, has none and remains.
    (r"\b\d\.\d+e-[123]\d\b", "<rounding>"),
    // The link or sample at which a residual of rounding is largest.
    (r"(<rounding> (?:m|rad) +at )[A-Za-z]\w+\b(?: \((?:[\d.]+|<any>) s\))?", "$1<place>"),
    // The sign of zero, first after the name of a joint and then in columns.
    (r"\b([A-Za-z]\w*) -(0\.0+)\b", "$1 $2"),
    (r"-(0\.0+)\b", " $1"),
];

/// A residual that is exactly 0 here need not be on another machine; in a column it is two characters shorter.
const NO_RESIDUAL: Filter = (r"(?:  )?\b0\.0+e0\b", "<rounding>");

/// The configuration of an extreme: several are equal but for rounding, which chooses one of them.
const CONFIGURATION: Filter = (r"( at\n)(?: +\w+ -?[\d.]+ (?:deg|mm)[^\n]*\n)+", "$1    <configuration>\n");

/// The sample of the extreme distance of a run: the links often move together for long.
const SAMPLE: Filter = (r"((?:distance|position) [1-9]\S* mm at \S+ \()[\d.]+ s\)", "$1<any> s)");

/// What follows from each bit of a trajectory: hashes, the size of the compressed file, the logarithm of a residual.
const RECORDING: [Filter; 4] = [
    (r"\b(?:[0-9a-f]{64}|[0-9a-f]{16})\b", "<hash>"),
    (r"file: \d+ bytes", "file: <size> bytes"),
    (r"(/agreement/worst/orientation +\d+) .*", "$1 <rounding>"),
    (r#"(congruent/congruent:) ".*""#, "$1 <version>"),
];

/// What a command printed, and with which code it ended, against the snapshot `name`.
#[track_caller]
fn matches(name: &str, answer: &Answer, filters: &[Filter]) {
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
fn prints(name: &str, arguments: &str, filters: &[Filter]) {
    matches(name, &congruent(&words(arguments)), filters);
}

/// The same with files of the test: `FOLDER` in the arguments is their folder.
#[track_caller]
fn prints_in(folder: &Path, name: &str, arguments: &str, filters: &[Filter]) {
    let folder = text(folder);
    let arguments: Vec<String> =
        words(arguments).iter().map(|word| word.replace("FOLDER", &folder)).collect();
    let filters: Vec<Filter> =
        [(folder.as_str(), "FOLDER")].into_iter().chain(filters.iter().copied()).collect();
    matches(name, &congruent(&arguments), &filters);
}

fn words(arguments: &str) -> Vec<&str> {
    arguments.split_whitespace().collect()
}

#[test]
fn help() {
    prints("help", "--help", &[]);
    for command in COMMANDS {
        prints(&format!("help_{command}"), &format!("{command} --help"), &[]);
    }
}

#[test]
fn run() {
    let folder = tempfile::tempdir().unwrap();
    let run = |name: &str, arguments: &str| {
        let arguments = format!("run {arguments} --no-recording --out FOLDER/out");
        prints_in(folder.path(), name, &arguments, &[SAMPLE]);
    };
    run("run_passes", "scenarios/ur5e_pick.toml");
    run("run_fails_as_expected", "scenarios/ur5e_into_table.toml");
    run("run_stops_as_expected", "scenarios/ur5e_into_zone.toml");
    run("run_fails", "scenarios/ur5e_pick.toml --set check.2.minimum_m=0.05");
    run("run_does_not_fail_as_expected", "scenarios/ur5e_pick.toml --set expect.verdict=fail");
    // One after another: which ends first is told first.
    run("run_several", "scenarios/rrr_arm_wave.toml scenarios/ur5e_tool_5mm_off.toml --jobs 1");
}

#[test]
fn check() {
    const FILTERS: [Filter; 2] = [NO_RESIDUAL, CONFIGURATION];
    prints("check_agrees", "check robots/ur5e", &FILTERS);
    prints("check_basics", "check robots/planar_2r --basics", &FILTERS);
    prints("check_wrong_convention", "check robots/ur5e/wrong_convention.toml", &FILTERS);
    let changed = |name: &str, changes: &[(&str, &str)]| {
        let bench = Bench::new();
        bench.robot("ur5e", changes);
        prints_in(bench.path(), name, "check FOLDER/ur5e", &FILTERS);
    };
    changed("check_one_parameter", &[("d_m = 0.0997", "d_m = 0.1027")]);
    // Only the sum of the offsets along three parallel axes matters.
    changed("check_parallel_axes", &[("d_m = 0.1333", "d_m = 0.1363")]);
    changed("check_two_parameters", &[("alpha_deg = -90.0", "alpha_deg = -88.0"), ("0.3922", "0.3952")]);
}

#[test]
fn describe() {
    prints("describe", "describe robots/rrr_arm", &[]);
}

#[test]
fn acm_suggest() {
    prints("acm_suggest", "acm suggest robots/ur5e --samples 1000", &[]);
}

#[test]
fn new_files() {
    // Measured values are those of a run, whose last digits are not the same on every machine.
    const MEASURED: Filter = (r"(?s)  pass agreement.*?(--- )", "  <checks>\n$1");
    let bench = Bench::new();
    let robot = "new robot robots/planar_2r/planar_2r.urdf --out FOLDER/planar";
    prints_in(bench.path(), "new_robot", robot, &[]);
    prints_in(
        bench.path(),
        "new_scenario",
        "new scenario FOLDER/planar --out FOLDER/first.toml",
        &[MEASURED],
    );
    let bad = "new scenario robots/ur5e/wrong_convention.toml --out FOLDER/no.toml";
    prints_in(bench.path(), "error_new_scenario", bad, &[SAMPLE]);
}

#[test]
fn fk() {
    prints("fk_urdf", "fk robots/ur5e --at elbow_joint=1.2", &[]);
    prints("fk_between", "fk robots/ur5e --from tool0 --to forearm_link --at elbow_joint=1.2", &[]);
    prints("fk_dh", "fk robots/ur5e --source dh --at elbow_joint=1.2", &[]);
}

#[test]
fn dynamics() {
    prints("dynamics", "dynamics robots/ur5e --at elbow_joint=1.2 --payload 2.5", &[]);
}

#[test]
fn jacobian() {
    prints("jacobian", "jacobian robots/ur5e --at elbow_joint=1.2 --at wrist_2_joint=0.5", &[]);
}

#[test]
fn ik() {
    let bench = Bench::new();
    bench.write("near.json", r#"[{"translation_m": [0.7, 0.2, 0]}]"#);
    bench.write("far.json", r#"[{"translation_m": [0.7, 0.2, 0]}, {"translation_m": [1.5, 0, 0]}]"#);
    let ik = |name: &str, file: &str| {
        let arguments = format!("ik robots/planar_2r --targets FOLDER/{file}");
        prints_in(bench.path(), name, &arguments, &[NO_RESIDUAL]);
    };
    ik("ik_reached", "near.json");
    ik("ik_out_of_reach", "far.json");
}

#[test]
fn manipulability() {
    prints("manipulability", "manipulability robots/ur5e --at elbow_joint=1.2 --at wrist_2_joint=0.5", &[]);
}

#[test]
fn workspace_of_an_arm() {
    prints("workspace", "workspace robots/planar_2r --samples 20000", &[CONFIGURATION]);
}

#[test]
fn sensitivity() {
    prints("sensitivity", "sensitivity robots/spatial_3r", &[CONFIGURATION]);
}

#[test]
fn clearance() {
    prints("clearance", "clearance robots/ur5e --at elbow_joint=1.2", &[]);
}

/// Points of the planar arm, whose joints stand 1 and -2 degrees off their readings; rounded to 0.1 mm.
fn points() -> String {
    let mut csv = "joint_1_deg,joint_2_deg,x_m,y_m\n".to_owned();
    for (first, second) in (0_i32..12).map(|row| (25 * row - 130, 55 * row % 220 - 110)) {
        let one = (f64::from(first) + 1.0).to_radians();
        let both = one + (f64::from(second) - 2.0).to_radians();
        let (x_m, y_m) = (0.6 * one.cos() + 0.4 * both.cos(), 0.6 * one.sin() + 0.4 * both.sin());
        writeln!(csv, "{first},{second},{x_m:.4},{y_m:.4}").unwrap();
    }
    csv
}

#[test]
fn calibrate() {
    let bench = Bench::new();
    bench.write("points.csv", &points());
    bench.write("outlier.csv", &points().replacen(",0.", ",0.1", 1));
    bench.write("lecture.csv", CASE_04);
    let calibrate = |name: &str, arguments: &str| {
        let arguments = format!("calibrate robots/planar_2r FOLDER/{arguments}");
        prints_in(bench.path(), name, &arguments, &[CONFIGURATION]);
    };
    calibrate("calibrate", "points.csv");
    calibrate("calibrate_outlier", "outlier.csv");
    calibrate("calibrate_not_explained", "lecture.csv");
}

#[test]
fn derive() {
    prints("derive", "derive robots/ur5e --convention modified", &[NO_RESIDUAL]);
}

#[test]
fn convert() {
    for to in ["modified", "poe", "urdf"] {
        prints(&format!("convert_{to}"), &format!("convert robots/planar_2r --to {to}"), &[NO_RESIDUAL]);
    }
}

#[cfg(feature = "recording")]
#[test]
fn inspect() {
    let folder = tempfile::tempdir().unwrap();
    let out = text(folder.path());
    let answer = congruent(&["run", "scenarios/ur5e_tool_5mm_off.toml", "--out", &out]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    let filters: Vec<Filter> = RECORDING.into_iter().chain([NO_RESIDUAL, SAMPLE]).collect();
    prints_in(folder.path(), "inspect", "inspect FOLDER/ur5e_tool_5mm_off/recording.rrd", &filters);
}

#[test]
fn errors() {
    prints("error_unknown_joint", "fk robots/ur5e --at elbow=1.2", &[]);
    prints("error_missing_robot", "check robots/ur5", &[]);
    prints("error_missing_scenario", "run scenarios/ur5e_pik.toml", &[]);
    prints("error_unknown_command", "chek robots/ur5e", &[]);
    prints("error_unknown_option", "check robots/ur5e --sed 3", &[]);
    prints("error_no_such_key", "run scenarios/ur5e_pick.toml --set simulation.step=0.01", &[]);
    let bench = Bench::new();
    let scenario = fs::read_to_string(workspace().join("scenarios/ur5e_pick.toml")).unwrap();
    let robots = text(&workspace().join("robots"));
    bench.write("typing_error.toml", &scenario.replace("../robots", &robots).replace("step_s", "steps_s"));
    prints_in(bench.path(), "error_scenario_key", "run FOLDER/typing_error.toml --out FOLDER/out", &[]);
    bench.write("points.csv", &CASE_04.replace("0.640", "oops"));
    prints_in(bench.path(), "error_measurement", "calibrate robots/planar_2r FOLDER/points.csv", &[]);
}
