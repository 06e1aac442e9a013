//! `[uncertainty]`: cases around a scenario, judged by shares with confidence.

use std::fs;

use serde_json::Value;

use crate::support::{
    command::{Answer, congruent, text},
    corpus::workspace,
    golden::read_json,
    scratch_folder::ScratchFolder,
};

fn scenario() -> String {
    text(&workspace().join("scenarios/ur5e_uncertain.toml"))
}

/// Runs the scenario with these values.
fn run(scratch: &ScratchFolder, set: &[&str]) -> Answer {
    let (scenario, out) = (scenario(), text(&scratch.path().join("out")));
    let mut arguments = vec!["run", &scenario, "--out", &out, "--no-recording"];
    arguments.extend(set.iter().flat_map(|set| ["--set", set]));
    congruent(&arguments)
}

fn report(scratch: &ScratchFolder) -> Value {
    read_json(&scratch.path().join("out/ur5e_uncertain/report.json"))
}

#[test]
fn enough_cases_pass() {
    let scratch = ScratchFolder::new();
    let answer = run(&scratch, &[]);
    assert_eq!(answer.code, 0, "{answer:?}");
    let report = report(&scratch);
    let cases = &report["uncertainty"];
    assert_eq!(cases["ran"], 300);
    assert_eq!(cases["varied"].as_array().map(Vec::len), Some(4));
    let clearance = &cases["checks"][0];
    // 299 cases without a failure show 99 % with confidence 95 %.
    let lower = clearance["requirement"]["interval"][0].as_f64().unwrap();
    assert!((lower - 0.05_f64.powf(1.0 / 300.0)).abs() < 1e-9, "{lower}");
    let distance = &clearance["quantities"][0];
    assert_eq!(distance["quantile"], distance["worst"], "none of 300 may be left out");
    let junit = fs::read_to_string(scratch.path().join("out/ur5e_uncertain/junit.xml")).unwrap();
    assert!(junit.contains("1_clearance_in_cases"), "{junit}");
}

#[test]
fn too_few_cases_are_an_answer_of_their_own() {
    let scratch = ScratchFolder::new();
    let wide = run(&scratch, &["uncertainty.cases=100", "check.clearance.minimum_mm=5"]);
    assert_eq!(wide.code, 4, "{wide:?}");
    assert!(wide.stdout.contains("NOT ENOUGH CASES: clearance holds in 100 of 100 cases"), "{wide:?}");
    assert!(wide.stderr.contains("cases = 299"), "{wide:?}");
    let near = run(&scratch, &["uncertainty.cases=100", "check.clearance.minimum_mm=33"]);
    assert_eq!(near.code, 1, "{near:?}");
    assert!(near.stdout.contains("to see the first case that fails: congruent run"), "{near:?}");
}

#[test]
fn controllers_know_the_file_and_the_arm_has_the_case() {
    let scratch = ScratchFolder::new();
    let alone = run(&scratch, &["uncertainty.case=16"]);
    assert_eq!(alone.code, 0, "{alone:?}");
    let report = read_json(&scratch.path().join("out/ur5e_uncertain_case_16/report.json"));
    let error = |report: &Value| {
        let check = report["checks"].as_array().unwrap().iter().find(|check| check["check"] == "tracking");
        check.unwrap()["measures"][0]["worst"]["value"].as_f64().unwrap()
    };
    let values = report["case"]["values"].as_array().unwrap();
    assert_eq!(values.len(), 11, "mass, friction, six joints and three coordinates");
    // The same values, known to the controller: what it compensates does not lead the arm off its path.
    let set: Vec<String> = values
        .iter()
        .map(|of| format!("{}={}", of["key"].as_str().unwrap(), of["value"].as_str().unwrap()))
        .collect();
    let mut known: Vec<&str> = set.iter().map(String::as_str).collect();
    known.push("uncertainty.cases=1");
    run(&scratch, &known);
    let known = read_json(&scratch.path().join("out/ur5e_uncertain/report.json"));
    assert!(error(&report) > 1.05 * error(&known), "{} {}", error(&report), error(&known));
}

#[test]
fn the_cases_do_not_depend_on_the_threads() {
    let scratch = ScratchFolder::new();
    let few = ["uncertainty.cases=12"];
    run(&scratch, &few);
    let first = report(&scratch)["uncertainty"].clone();
    let (scenario, out) = (scenario(), text(&scratch.path().join("out")));
    congruent(&["run", &scenario, "--out", &out, "--no-recording", "--jobs", "1", "--set", few[0]]);
    assert_eq!(report(&scratch)["uncertainty"], first);
}

#[track_caller]
fn refused(with: &str, sentence: &str) {
    let scratch = ScratchFolder::new();
    let robot = text(&workspace().join("robots/ur5e"));
    let head = format!(
        "schema_version = 1\nname = \"u\"\nrobot = {robot:?}\n[controller]\nkind = \"kinematic\"\n[[motion]]\n\
         move_joints_deg = {{ elbow_joint = 20 }}\n"
    );
    let file = scratch.write("u.toml", &(head + with));
    let answer = congruent(&["run", &file, "--out", &text(&scratch.path().join("out"))]);
    assert_eq!(answer.code, 2, "{answer:?}");
    let printed: String =
        answer.stderr.split_whitespace().filter(|word| *word != "│").collect::<Vec<_>>().join(" ");
    assert!(printed.contains(sentence), "{printed}");
}

#[test]
fn what_is_no_uncertainty_is_refused() {
    let check = "[[check]]\nkind = \"limits\"\n";
    let vary = "[[uncertainty.vary]]\nkey = \"joints.friction\"\n";
    let with = |more: &str| format!("{check}[uncertainty]\ncases = 3\n{more}");
    refused(&format!("{check}passing = 0.9\n"), "the scenario has no [uncertainty]");
    refused(&with("vary = []\n"), "nothing varies");
    refused(&with(&format!("{vary}plus_minus = 0.1\n")), "the file has no value \"joints.friction\"");
    refused(&with(&format!("{vary}uniform = [0.0, 1.0]\nplus_minus = 1.0\n")), "2 distributions are given");
    refused(&with(&format!("case = 3\n{vary}uniform = [0.0, 1.0]\n")), "case = 3, and the cases are 0 to 2");
    refused(
        &with(&format!("{vary}uniform = [0.0, 1.0]\n[expect]\nverdict = \"fail\"\n")),
        "[uncertainty] is beside [expect]",
    );
    let grid = format!("sampling = \"grid\"\n{vary}values = [0.0, 1.0]\n");
    refused(&with(&grid), "cases = 3, and the grid has 2 combinations");
    let keys: Vec<String> = (0..41).map(|key| format!("\"joints.damping.j{key}\"")).collect();
    let each = |key: &String| format!("[[uncertainty.vary]]\nkey = {key}\nuniform = [0.0, 1.0]\n");
    let many: String = keys.iter().map(each).collect();
    refused(&with(&format!("sampling = \"sobol\"\n{many}")), "3 Sobol points of 41 keys");
    let misspelt = "[[uncertainty.vary]]\nkey = \"joints.frictoin\"\nuniform = [0.0, 1.0]\n";
    refused(&with(misspelt), "frictoin");
}
