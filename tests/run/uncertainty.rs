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
    assert_eq!(distance["quantile_bound"], distance["worst"], "none of 300 may be left out");
    let junit = fs::read_to_string(scratch.path().join("out/ur5e_uncertain/junit.xml")).unwrap();
    assert!(junit.contains("1_clearance_in_cases") && junit.contains("4_effort_default_in_cases"), "{junit}");
    let table = fs::read_to_string(scratch.path().join("out/ur5e_uncertain/cases.csv")).unwrap();
    assert_eq!(table.lines().count(), 301, "a header and a row for each case");
    let counts = distance["histogram"]["counts"].as_array().unwrap();
    assert_eq!(counts.iter().filter_map(Value::as_u64).sum::<u64>(), 300);
    let tracking = &cases["checks"][1]["quantities"][0]["deciding"];
    // The controller compensates 2 kg: what is more than that pulls the arm off its path.
    let payload =
        tracking.as_array().unwrap().iter().find(|of| of["key"] == "payload.gripper.mass_kg").unwrap();
    assert!(payload["rank_correlation"].as_f64().unwrap() > 0.3, "{tracking}");
}

#[test]
fn too_few_cases_are_an_answer_of_their_own() {
    let scratch = ScratchFolder::new();
    let wide = run(&scratch, &["uncertainty.cases=100", "check.clearance.minimum_mm=5"]);
    assert_eq!(wide.code, 4, "{wide:?}");
    assert!(
        wide.stdout.contains(
            "NOT ENOUGH CASES: clearance passes in 100 of 100 cases, required 99 %; 299 cases are needed, if none fails"
        ),
        "{wide:?}"
    );
    assert!(wide.stderr.contains("at least 299 are needed"), "{wide:?}");
    assert!(
        wide.stdout.contains("what would answer: congruent run")
            && wide.stdout.contains("uncertainty.cases=299"),
        "{wide:?}"
    );
    let near = run(&scratch, &["uncertainty.cases=100", "check.clearance.minimum_mm=33"]);
    assert_eq!(near.code, 1, "{near:?}");
    assert!(near.stdout.contains("the first case that fails: congruent run"), "{near:?}");
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

/// The scenario of a small arm, with these sections.
fn small(scratch: &ScratchFolder, robot: &str, sections: &str) -> (Answer, Value) {
    let robot = text(&workspace().join("robots").join(robot));
    let head = format!(
        "schema_version = 1\nname = \"small\"\nrobot = {robot:?}\n[controller]\nkind = \"kinematic\"\n"
    );
    let file = scratch.write("small.toml", &(head + sections));
    let answer = congruent(&["run", &file, "--out", &text(&scratch.path().join("out")), "--no-recording"]);
    let report = read_json(&scratch.path().join("out/small/report.json"));
    (answer, report["uncertainty"].clone())
}

#[test]
fn inverse_kinematics_does_not_know_the_geometry_of_the_case() {
    let scratch = ScratchFolder::new();
    let sections = "[start]\njoints_deg = { joint_1 = 20.0, joint_2 = -35.0 }\n[[motion]]\nmove_tcp = { xyz_m = [0.7, 0.2, 0.0] }\n\
        duration_s = 0.8\n[[check]]\nkind = \"goal\"\ntcp = { xyz_m = [0.7, 0.2, 0.0] }\nposition_mm = 1.0\n[[check]]\nkind = \"tracking\"\n\
        path_tcp_mm = 5.0\n[uncertainty]\ncases = 60\n[[uncertainty.vary]]\nkey = \"robot.joint.joint_2.xyz_m.1\"\nplus_minus = 0.002\n";
    let (answer, cases) = small(&scratch, "planar_2r", sections);
    assert_eq!(answer.code, 1, "{answer:?}");
    // A link that is longer by so much moves the tool by as much: uniform up to 2 mm, of which a half is within 1 mm.
    let goal = &cases["checks"][0];
    let worst = goal["quantities"][0]["worst"].as_f64().unwrap();
    assert!((1.9e-3..=2e-3 + 1e-9).contains(&worst), "{worst}");
    let passed = goal["requirement"]["passed"].as_u64().unwrap();
    assert!((18..=42).contains(&passed), "{passed}");
    let path = cases["checks"][1]["quantities"][0]["worst"].as_f64().unwrap();
    assert!((path - worst).abs() < 1e-9, "the path is that of the link as it is written: {path} {worst}");
}

#[test]
fn a_quantity_that_fails_in_every_case_is_shown() {
    let scratch = ScratchFolder::new();
    let sections = "[simulation]\nduration_s = 0.002\n[start]\njoints_deg = { joint_1 = 0.0 }\njoints_mm = { joint_2 = 100.0, joint_3 = 50.0 }\n\
        [[check]]\nkind = \"limits\"\nmargin_mm = 20.0\n[uncertainty]\ncases = 3\n[[uncertainty.vary]]\nkey = \"start.joints_deg.joint_1\"\n\
        plus_minus = 5\n[[uncertainty.vary]]\nkey = \"start.joints_mm.joint_3\"\nvalues = [10.0]\n";
    let (answer, _) = small(&scratch, "cylindrical_rpp", sections);
    assert!(answer.stdout.contains("margin 10 mm in every case, required margin >= 20 mm"), "{answer:?}");
}

/// A wall near an arm at rest, moved so that its overlap refuses some cases.
const NEAR_WALL: &str = "[simulation]\nduration_s = 0.002\n[start]\njoints_deg = { joint_1 = 0.0, joint_2 = 0.0 }\n[[obstacle]]\nname = \"wall\"\n\
    box_m = [0.1, 0.4, 0.4]\nxyz_m = [1.086, 0.0, 0.0]\n[uncertainty]\ncases = 60\n[[uncertainty.vary]]\nkey = \"obstacle.wall.xyz_m.1\"\n\
    plus_minus = 0.0115\n[[check]]\nkind = \"clearance\"\nminimum_m = 0.001\npairs = [[\"link_2\", \"wall\"]]\npassing = 0.6\n";

#[test]
fn a_case_without_a_result_has_passed_no_check_that_was_asked_for() {
    let scratch = ScratchFolder::new();
    let controller = "kind = \"gravity_compensation\"\nstiffness = 2000.0\ndamping = 120.0\n";
    let robot = text(&workspace().join("robots/planar_2r"));
    let head = format!("schema_version = 1\nname = \"small\"\nrobot = {robot:?}\n[controller]\n{controller}");
    let file = scratch.write("wall.toml", &(head + NEAR_WALL));
    let answer = congruent(&["run", &file, "--out", &text(&scratch.path().join("out")), "--no-recording"]);
    assert_eq!(answer.code, 0, "{answer:?}");
    let report = read_json(&scratch.path().join("out/small/report.json"));
    let (cases, checks) = (&report["uncertainty"], report["uncertainty"]["checks"].as_array().unwrap());
    let lost = cases["without_result"].as_u64().unwrap();
    assert!(lost > 0, "{cases}");
    let counted = |check: &Value| check["requirement"]["counted"].as_u64().unwrap();
    assert_eq!(counted(&checks[0]), 60, "the check of the file");
    for of_program in &checks[1..] {
        assert_eq!(counted(of_program), 60 - lost, "{of_program}");
        assert_eq!(of_program["requirement"]["verdict"], "met");
    }
}

#[test]
fn draws_do_not_depend_on_the_order_of_a_table() {
    let worst = |joints: &str| {
        let scratch = ScratchFolder::new();
        let sections = format!(
            "[simulation]\nduration_s = 0.002\n[start]\njoints_deg = {{ {joints} }}\n[[check]]\nkind = \"limits\"\n[uncertainty]\ncases = 5\n\
             [[uncertainty.vary]]\nkey = \"start.joints_deg\"\nplus_minus = 3\n"
        );
        small(&scratch, "planar_2r", &sections).1["checks"].clone()
    };
    assert_eq!(worst("joint_1 = 100.0, joint_2 = 20.0"), worst("joint_2 = 20.0, joint_1 = 100.0"));
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
    refused(&with(&format!("{vary}plus_minus = 0.1\n")), "the file has no number \"joints.friction\"");
    refused(&with(&format!("{vary}uniform = [0.0, 1.0]\nplus_minus = 1.0\n")), "2 distributions are given");
    refused(&with(&format!("case = 3\n{vary}uniform = [0.0, 1.0]\n")), "case = 3, and the cases are 0 to 2");
    refused(
        &with(&format!("{vary}uniform = [0.0, 1.0]\n[expect]\nverdict = \"fail\"\n")),
        "[uncertainty] cannot be combined with [expect]",
    );
    let grid = format!("sampling = \"grid\"\n{vary}values = [0.0, 1.0]\n");
    refused(&with(&grid), "cases = 3, and the grid has 2 combinations");
    let keys: Vec<String> = (0..41).map(|key| format!("\"joints.damping.j{key}\"")).collect();
    let each = |key: &String| format!("[[uncertainty.vary]]\nkey = {key}\nuniform = [0.0, 1.0]\n");
    let many: String = keys.iter().map(each).collect();
    refused(&with(&format!("sampling = \"sobol\"\n{many}")), "3 Sobol points of 41 keys");
    refused(
        &with("[[uncertainty.vary]]\nkey = \"robot\"\nvalues = [\"a\", \"b\"]\n"),
        "the robot cannot vary",
    );
    refused(
        &with("[[uncertainty.vary]]\nkey = \"check.1.margin_deg\"\nuniform = [0.0, 1.0]\n"),
        "\"check\" cannot vary",
    );
    refused(
        &with("[[uncertainty.vary]]\nkey = \"joints.friction\"\nuniform = [-1.0, 3.0]\n"),
        "key \"joints.friction\" = -1.0: expected a finite number, 0 or above",
    );
    refused(
        &with(
            "[[uncertainty.vary]]\nkey = \"robot.link.forearm_link.mass_kg\"\nnormal = { mean = 2.0, deviation = 1.0 }\n",
        ),
        "is negative",
    );
    refused(
        &with("[[uncertainty.vary]]\nkey = \"start.joints_deg\"\nnormal = { mean = 2.0, deviation = 1.0 }\n"),
        "must be a table of keys and values",
    );
    refused(
        &with("[[uncertainty.vary]]\nkey = \"robot.link.forearm.mass_kg\"\nplus_minus = 0.1\n"),
        "key \"robot.link.forearm.mass_kg\": the robot has no link \"forearm\"",
    );
    let misspelt = "[[uncertainty.vary]]\nkey = \"joints.frictoin\"\nuniform = [0.0, 1.0]\n";
    refused(&with(misspelt), "frictoin");
}
