//! What every command prints for people: results, help and errors, held against the files in `tests/snapshots/`.
//! `INSTA_UPDATE=always cargo test --release snapshots` writes them anew after a change that is meant; the change
//! is then read in the diff. What machines may disagree on, the last digits, is replaced by a word in brackets.

use std::{fmt::Write, fs, path::Path};

use insta::{Settings, assert_snapshot};

use crate::support::{
    command::{Answer, commands_in, congruent, text},
    corpus::workspace,
    measurements::CASE_04,
    scratch_folder::ScratchFolder,
};

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

/// The configuration of an extreme: several are equal up to rounding, which chooses one of them.
const CONFIGURATION: Filter = (r"( at\n)(?: +\w+ -?[\d.]+ (?:deg|mm)[^\n]*\n)+", "$1    <configuration>\n");

/// The sample of the extreme distance of a run, or of a residual: the links often move together for long.
const SAMPLE: Filter =
    (r"((?:(?:distance|position) [1-9]\S* mm(?: at \S+)?|\d\.\d+e-1\d rad) \()[\d.]+ s\)", "$1<any> s)");

/// A number that is printed with all its digits.
const ALL_DIGITS: Filter = (r"\b\d+\.\d{9,}\b", "<number>");

/// How long this machine took.
const WALL_TIME: [Filter; 2] =
    [(r"[\d.]+ m?s of this machine", "<time> of this machine"), (r": took [\d.e-]+ m?s", ": took <time>")];

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

/// The help of a command and of all commands below it.
fn matches_help(command: &str) {
    let answer = congruent(&words(&format!("{command} --help")));
    matches(&format!("help {command}").trim_end().replace(' ', "_"), &answer, &[]);
    for name in commands_in(&answer.stdout) {
        matches_help(format!("{command} {name}").trim_start());
    }
}

#[test]
fn help() {
    matches_help("");
}

/// Calls on files of the project: the snapshot, the command line, and what differs between machines.
const CALLS: [(&str, &str, &[Filter]); 27] = [
    ("describe", "describe robots/rrr_arm", &[]),
    ("lint_passes", "lint docs/examples/arm robots/ur5e", &[]),
    ("lint_explain", "explain CGR-URDF-018", &[]),
    ("fk_urdf", "fk robots/ur5e --at elbow_joint=1.2rad", &[]),
    ("fk_between", "fk robots/ur5e --from tool0 --to forearm_link --at elbow_joint=1.2rad", &[]),
    ("fk_dh", "fk robots/ur5e --source dh --at elbow_joint=1.2rad", &[]),
    ("dynamics", "dynamics robots/ur5e --at elbow_joint=1.2rad --payload 2.5kg", &[]),
    ("jacobian", "jacobian robots/ur5e --at elbow_joint=1.2rad --at wrist_2_joint=0.5rad", &[]),
    ("manipulability", "manipulability robots/ur5e --at elbow_joint=1.2rad --at wrist_2_joint=0.5rad", &[]),
    ("workspace", "workspace robots/planar_2r --samples 20000", &[CONFIGURATION]),
    ("sensitivity", "sensitivity robots/spatial_3r", &[CONFIGURATION]),
    (
        "tolerances",
        "tolerances robots/spatial_3r --a 0.05mm --d 0.05mm --alpha 0.02deg --theta 0.02deg --at joint_2=60deg --tolerance 1mm",
        &[],
    ),
    ("clearance", "clearance robots/ur5e --at elbow_joint=1.2rad", &[]),
    ("disabled_pairs", "clearance robots/ur5e --samples 1000 --write-srdf -", &[]),
    ("convert_dh", "convert robots/ur5e --from urdf --to modified", &[NO_RESIDUAL]),
    ("base_parameters", "dynamics robots/planar_2r --base-parameters", &[NO_RESIDUAL]),
    ("convert_modified", "convert robots/planar_2r --to modified", &[NO_RESIDUAL]),
    ("convert_poe", "convert robots/planar_2r --to poe", &[NO_RESIDUAL]),
    ("convert_urdf", "convert robots/planar_2r --to urdf", &[NO_RESIDUAL]),
    ("faults", "run --faults scenarios/faults/stuck_joint.toml scenarios/faults/none.toml", &[]),
    ("schema", "schema", &[]),
    ("error_unknown_joint", "fk robots/ur5e --at elbow=1.2rad", &[]),
    ("error_missing_robot", "check robots/ur5", &[]),
    ("error_missing_scenario", "run scenarios/ur5e_pik.toml", &[]),
    ("error_unknown_command", "chek robots/ur5e", &[]),
    ("error_unknown_option", "check robots/ur5e --sed 3", &[]),
    ("error_no_such_key", "run scenarios/ur5e_pick.toml --set simulation.step=0.01", &[]),
];

#[test]
fn calls_on_files_of_the_project() {
    for (name, arguments, filters) in CALLS {
        prints(name, arguments, filters);
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
    // One after another: which ends first is reported first.
    run("run_several", "scenarios/rrr_arm_wave.toml scenarios/ur5e_tool_5mm_off.toml --jobs 1");
}

#[test]
fn check() {
    const FILTERS: [Filter; 2] = [NO_RESIDUAL, CONFIGURATION];
    prints("check_agrees", "check robots/ur5e", &FILTERS);
    prints("check_basics", "check robots/planar_2r --basics", &FILTERS);
    prints("check_wrong_convention", "check robots/ur5e/wrong_convention.toml", &FILTERS);
    let changed = |name: &str, changes: &[(&str, &str)]| {
        let scratch = ScratchFolder::new();
        scratch.robot("ur5e", changes);
        prints_in(scratch.path(), name, "check FOLDER/ur5e", &FILTERS);
    };
    changed("check_one_parameter", &[("d_m = 0.0997", "d_m = 0.1027")]);
    // Only the sum of the offsets along three parallel axes matters.
    changed("check_parallel_axes", &[("d_m = 0.1333", "d_m = 0.1363")]);
    changed("check_two_parameters", &[("alpha_deg = -90.0", "alpha_deg = -88.0"), ("0.3922", "0.3952")]);
}

#[test]
fn new_files() {
    // Measured values are those of a run, whose last digits are not the same on every machine.
    const MEASURED: Filter = (r"(?s)  pass agreement.*?(--- )", "  <checks>\n$1");
    let scratch = ScratchFolder::new();
    let robot = "new robot robots/planar_2r/planar_2r.urdf --out FOLDER/planar";
    prints_in(scratch.path(), "new_robot", robot, &[]);
    prints_in(
        scratch.path(),
        "new_scenario",
        "new scenario FOLDER/planar --to FOLDER/first.toml",
        &[MEASURED],
    );
    let bad = "new scenario robots/ur5e/wrong_convention.toml --to FOLDER/no.toml";
    prints_in(scratch.path(), "error_new_scenario", bad, &[SAMPLE]);
}

#[test]
fn lint() {
    let scratch = ScratchFolder::new();
    let urdf = r#"<robot name="arm"><link name="base"/>
  <link name="tool"><inertial><mass value="-1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="tool"/><axis xyz="0 0 2"/></joint>
</robot>"#;
    scratch.write("arm.urdf", urdf);
    prints_in(scratch.path(), "lint", "lint FOLDER/arm.urdf", &[]);
}

#[test]
fn ik() {
    let scratch = ScratchFolder::new();
    scratch.write("near.json", r#"[{"translation_m": [0.7, 0.2, 0]}]"#);
    scratch.write("far.json", r#"[{"translation_m": [0.7, 0.2, 0]}, {"translation_m": [1.5, 0, 0]}]"#);
    let ik = |name: &str, file: &str| {
        let arguments = format!("ik robots/planar_2r --targets FOLDER/{file}");
        prints_in(scratch.path(), name, &arguments, &[NO_RESIDUAL]);
    };
    ik("ik_reached", "near.json");
    ik("ik_out_of_reach", "far.json");
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
    let scratch = ScratchFolder::new();
    scratch.write("points.csv", &points());
    scratch.write("outlier.csv", &points().replacen(",0.", ",0.1", 1));
    scratch.write("lecture.csv", CASE_04);
    let calibrate = |name: &str, arguments: &str| {
        let arguments = format!("calibrate robots/planar_2r FOLDER/{arguments}");
        prints_in(scratch.path(), name, &arguments, &[CONFIGURATION]);
    };
    calibrate("calibrate", "points.csv");
    calibrate("calibrate_outlier", "outlier.csv");
    calibrate("calibrate_not_explained", "lecture.csv");
}

#[cfg(feature = "recording")]
#[test]
fn inspect() {
    let folder = tempfile::tempdir().unwrap();
    let out = text(folder.path());
    let scenario = "scenarios/ur5e_tool_5mm_off.toml";
    let answer = congruent(&["run", scenario, "--out", &out]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    let filters: Vec<Filter> = RECORDING.into_iter().chain([NO_RESIDUAL, SAMPLE]).chain(WALL_TIME).collect();
    let recording = "FOLDER/ur5e_tool_5mm_off/recording.rrd";
    for (name, options) in [("inspect", ""), ("inspect_verbose", "--verbose"), ("inspect_check", "--check")] {
        let scenario = if options == "--check" { scenario } else { "" };
        prints_in(folder.path(), name, &format!("inspect {recording} {options} {scenario}"), &filters);
    }
}

#[cfg(feature = "recording")]
#[test]
fn view() {
    let folder = tempfile::tempdir().unwrap();
    prints_in(folder.path(), "view", "view robots/planar_2r --no-viewer --out FOLDER", &[]);
}

#[test]
fn compare() {
    let folder = tempfile::tempdir().unwrap();
    for (name, stiffness) in [("stiff", "2000"), ("soft", "1900")] {
        let arguments = format!(
            "run scenarios/rrr_arm_wave.toml --no-recording --out {}/{name} --set output.trajectory=csv \
             --set controller.stiffness={stiffness}",
            text(folder.path())
        );
        let answer = congruent(&words(&arguments));
        assert_eq!(answer.code, 0, "{}", answer.stderr);
    }
    let arguments = "compare FOLDER/stiff/rrr_arm_wave FOLDER/soft/rrr_arm_wave --tolerance 1e-4";
    prints_in(folder.path(), "compare", arguments, &[ALL_DIGITS]);
}

#[test]
fn man() {
    let folder = tempfile::tempdir().unwrap();
    prints_in(folder.path(), "man", "man --out FOLDER", &[]);
}

#[test]
fn errors() {
    let scratch = ScratchFolder::new();
    let scenario = fs::read_to_string(workspace().join("scenarios/ur5e_pick.toml")).unwrap();
    let robots = text(&workspace().join("robots"));
    scratch.write("typing_error.toml", &scenario.replace("../robots", &robots).replace("step_s", "steps_s"));
    prints_in(scratch.path(), "error_scenario_key", "run FOLDER/typing_error.toml --out FOLDER/out", &[]);
    scratch.write("points.csv", &CASE_04.replace("0.640", "oops"));
    prints_in(scratch.path(), "error_measurement", "calibrate robots/planar_2r FOLDER/points.csv", &[]);
}
