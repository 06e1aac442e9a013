//! The scenarios that come with the project, run as a user runs them.

use std::{fs, path::Path};

use serde_json::Value;

use crate::support::{
    command::{Answer, congruent, congruent_json, text},
    corpus::workspace,
    golden::read_json,
    scenario_files::scenario_files,
};

/// Runs one scenario without a recording and gives its report.
#[track_caller]
fn report(scenario: &str, out: &Path) -> Value {
    let path = format!("scenarios/{scenario}.toml");
    let answer = congruent_json(&["run", &path, "--no-recording", "--out", &text(out)]);
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
    let report = read_json(&out.join(scenario).join("report.json"));
    assert_eq!(report, answer.json(), "standard output and report.json differ");
    report
}

fn check<'a>(report: &'a Value, kind: &str) -> &'a Value {
    let checks = report["checks"].as_array().unwrap();
    checks.iter().find(|check| check["check"] == kind).unwrap_or_else(|| panic!("no check {kind}"))
}

#[track_caller]
fn passes(scenario: &str) {
    let out = tempfile::tempdir().unwrap();
    let report = report(scenario, out.path());
    assert_eq!(report["verdict"], "as_expected");
    assert!(report["stopped"].is_null());
    for check in report["checks"].as_array().unwrap() {
        assert_eq!(check["status"], "pass", "{check:#}");
    }
    for kind in ["agreement", "clearance", "limits"] {
        assert_eq!(check(&report, kind)["samples"], report["simulation"]["steps"].as_u64().unwrap() + 1);
    }
}

/// A negative control: the named check fails at the named place.
#[track_caller]
fn fails(scenario: &str, kind: &str, subject: &str) -> Value {
    let out = tempfile::tempdir().unwrap();
    let report = report(scenario, out.path());
    assert_eq!(report["verdict"], "as_expected");
    let failed = check(&report, kind).clone();
    assert_eq!(failed["status"], "fail");
    let violation = &failed["measures"][0]["first_violation"];
    assert!(violation["subject"].as_str().unwrap().contains(subject), "{violation}");
    assert!(!violation["q"].as_object().unwrap().is_empty());
    failed
}

#[test]
fn ur5e_pick_passes() {
    passes("ur5e_pick");
}

#[test]
fn ur5e_grasp_and_ur5e_weld_pass() {
    passes("ur5e_grasp");
    passes("ur5e_weld");
}

#[test]
fn panda_reach_passes() {
    passes("panda_reach");
}

#[test]
fn case_13_beside_a_zone_nothing_stops() {
    passes("ur5e_beside_zone");
}

#[test]
fn rrr_arm_wave_passes() {
    passes("rrr_arm_wave");
}

#[test]
fn a_table_read_under_the_wrong_convention_fails() {
    fails("ur5e_wrong_convention", "agreement", "link");
    fails("panda_wrong_convention", "agreement", "panda_link");
}

#[test]
fn a_tool_5_mm_off_fails_by_5_mm() {
    let failed = fails("ur5e_tool_5mm_off", "agreement", "tool0");
    let worst_m = failed["measures"][0]["worst"]["value"].as_f64().unwrap();
    assert!((worst_m - 0.005).abs() < 1e-12, "{worst_m}");
    assert!(failed["measures"][1]["first_violation"].is_null(), "the orientation is right");
}

/// The servos are at fault, and neither the model nor the physics.
#[test]
fn soft_servos_fail_to_track() {
    let failed = fails("ur5e_soft_servos", "tracking", "elbow_joint");
    // Of gravity over stiffness: some 26 N m by 400 N m/rad.
    let goal = &failed["measures"][1];
    assert_eq!(goal["quantity"], "goal_error_of_angle");
    assert_eq!(goal["worst"]["subject"], "shoulder_lift_joint");
    assert!((0.05..0.08).contains(&goal["worst"]["value"].as_f64().unwrap()), "{goal:#}");
}

#[test]
fn an_arm_driven_into_a_table_fails() {
    let failed = fails("ur5e_into_table", "clearance", "table");
    assert_eq!(failed["measures"][0]["worst"]["value"], 0.0);
}

#[test]
fn a_negative_control_that_passes_is_a_failure() {
    let folder = tempfile::tempdir().unwrap();
    let wrong = fs::read_to_string(workspace().join("scenarios/ur5e_tool_5mm_off.toml")).unwrap();
    let right = wrong.lines().map(|line| match line.split_once('=') {
        Some(("robot ", _)) => format!("robot = {:?}", workspace().join("robots/ur5e")),
        _ => line.to_owned(),
    });
    let path = folder.path().join("scenario.toml");
    fs::write(&path, right.collect::<Vec<_>>().join("\n")).unwrap();
    let answer = congruent(&["run", &text(&path), "--no-recording", "--out", &text(folder.path())]);
    assert_eq!(answer.code, 1, "{}{}", answer.stdout, answer.stderr);
}

#[test]
fn the_same_scenario_gives_the_same_bytes_at_any_number_of_jobs() {
    let out = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    for (folder, jobs) in out.iter().zip(["1", "2"]) {
        let folder = text(folder.path());
        let scenarios = ["scenarios/rrr_arm_wave.toml", "scenarios/ur5e_tool_5mm_off.toml"];
        let arguments =
            ["run", scenarios[0], scenarios[1], "--jobs", jobs, "--no-recording", "--out", &folder];
        assert_eq!(congruent(&arguments).code, 0);
    }
    for scenario in ["rrr_arm_wave", "ur5e_tool_5mm_off"] {
        for file in ["report.json", "junit.xml", "scenario.resolved.toml"] {
            let [a, b] = out.each_ref().map(|out| fs::read(out.path().join(scenario).join(file)).unwrap());
            assert!(a == b, "{scenario}/{file} differs");
        }
    }
}

#[test]
fn the_resolved_scenario_runs_to_the_same_end() {
    let out = tempfile::tempdir().unwrap();
    let first = report("ur5e_pick", out.path());
    let path = out.path().join("ur5e_pick/scenario.resolved.toml");
    let answer =
        congruent_json(&["run", &text(&path), "--no-recording", "--out", &text(&out.path().join("again"))]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    assert_eq!(answer.json()["trajectory_sha256"], first["trajectory_sha256"]);
}

#[test]
#[cfg(feature = "recording")]
fn a_recording_holds_the_verdict_of_its_report() {
    let out = tempfile::tempdir().unwrap();
    let answer = congruent(&["run", "scenarios/ur5e_into_table.toml", "--out", &text(out.path())]);
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
    let folder = out.path().join("ur5e_into_table");
    for file in ["report.json", "junit.xml", "recording.rrd", "scenario.resolved.toml"] {
        assert!(folder.join(file).is_file(), "no {file}");
    }
    let inspected = congruent_json(&["inspect", &text(&folder.join("recording.rrd"))]);
    assert_eq!(inspected.code, 0, "{}", inspected.stderr);
    let summary = inspected.json();
    assert_eq!(summary["verdict"], "as_expected");
    let entities: Vec<&str> =
        summary["entities"].as_array().unwrap().iter().filter_map(|entity| entity["path"].as_str()).collect();
    for entity in ["/summary", "/status/fail/clearance", "/agreement/position/tool0", "/clearance/minimum"] {
        assert!(entities.contains(&entity), "no {entity} in {entities:?}");
    }
}

/// Runs a UR5e with values set; gives the answer.
fn run_set(out: &tempfile::TempDir, values: &[&str]) -> Answer {
    let out = text(out.path());
    let mut arguments = vec!["run", "scenarios/ur5e_pick.toml", "--no-recording", "--out", &out];
    arguments.extend(values.iter().flat_map(|value| ["--set", value]));
    congruent_json(&arguments)
}

#[test]
fn values_are_set_in_tables_and_in_lists_and_the_report_has_them() {
    let out = tempfile::tempdir().unwrap();
    let values =
        ["controller.stiffness=1500", "check.1={ kind = \"agreement\", position_m = 1e-6 }", "seed=9"];
    let answer = run_set(&out, &values);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    let report = answer.json();
    assert_eq!(report["overrides"], serde_json::json!(values));
    assert_eq!(report["seed"], 9);
    assert_eq!(report["checks"][0]["measures"][0]["limit"], 1e-6);
}

#[test]
fn a_target_outside_its_range_is_named_before_what_it_makes_fail() {
    let out = tempfile::tempdir().unwrap();
    let pick = fs::read_to_string(workspace().join("scenarios/ur5e_pick.toml")).unwrap();
    let head = &pick[..pick.find("[[motion]]").unwrap()];
    let robot = format!("robot = \"{}\"", text(&workspace().join("robots/ur5e")));
    let head = head.replace("robot = \"../robots/ur5e\"", &robot);
    let motions =
        "[[motion]]\nmove_joints_deg = { elbow_joint = 190 }\n[[motion]]\nline_tcp = { xyz_m = [9, 0, 0] }\n";
    let file = out.path().join("far.toml");
    fs::write(&file, format!("{head}{motions}[[check]]\nkind = \"limits\"\n")).unwrap();
    let answer = congruent(&["run", &text(&file), "--out", &text(out.path())]);
    assert_eq!(answer.code, 2, "{}{}", answer.stdout, answer.stderr);
    let range = answer.stderr.find("target 190 deg is outside its range [-180, 180] deg");
    let reach = answer.stderr.find("reach").unwrap_or(usize::MAX);
    assert!(range.is_some_and(|range| range < reach), "{}", answer.stderr);
}

#[test]
fn values_that_cannot_be_set_are_refused_with_the_reason() {
    let out = tempfile::tempdir().unwrap();
    for (values, reason) in [
        (&["check.99.position_m=1"][..], "\"check\" has entries 1 to"),
        (&["controller.stiffness.x=1"], "\"stiffness\" is a value, not a table"),
        (&["seed=1", "seed=2"], "the same value is set by seed=1"),
        (&["controller.stifness=1"], "did you mean \"stiffness\"?"),
    ] {
        let answer = run_set(&out, values);
        assert_eq!(answer.code, 2, "{values:?}");
        let findings = answer.json()["findings"].clone();
        let said = |key: &str| findings[0][key].as_str().unwrap_or_default().to_owned();
        let said = format!("{} {}", said("message"), said("help"));
        assert!(said.contains(reason), "{values:?}: {said}");
    }
    let answer = run_set(&out, &["name=\"a"]);
    assert!(answer.code == 2 && answer.stderr.contains("neither TOML nor a word"), "{}", answer.stderr);
}

/// What was run can be run again from its results, wherever they are: motions that only wait and meshes beside the
/// scenario are in it.
#[test]
fn every_resolved_scenario_runs_again_with_the_same_hash() {
    let out = tempfile::tempdir().unwrap();
    let run = |path: &str, out: &Path| {
        let answer = congruent_json(&["run", path, "--no-recording", "--out", &text(out)]);
        assert_eq!(answer.code, 0, "{path}: {}{}", answer.stdout, answer.stderr);
        let report = answer.json();
        let resolved = out.join(report["scenario"].as_str().unwrap()).join("scenario.resolved.toml");
        (report["trajectory_sha256"].clone(), resolved)
    };
    let mut compared = 0;
    for path in scenario_files("scenarios") {
        let (hash, resolved) = run(&text(&path), &out.path().join("first"));
        let (hash_again, resolved_again) = run(&text(&resolved), &out.path().join("again"));
        assert!(hash.is_string());
        assert_eq!(hash, hash_again, "{}", path.display());
        let [first, again] = [resolved, resolved_again].map(|path| fs::read_to_string(path).unwrap());
        assert_eq!(first, again, "{}", path.display());
        compared += 1;
    }
    assert!(compared >= 13, "{compared} scenarios");
}
