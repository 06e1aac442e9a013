//! Several inputs in one call: each is answered, whatever becomes of the others, in JSON, in text and in JUnit.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Stdio,
    time::Duration,
};

use roxmltree::{Document, Node};
use serde_json::Value;

use crate::support::{
    command::{allowing, congruent, congruent_json, text},
    corpus::workspace,
    scratch_folder::ScratchFolder,
};

/// A short run of the planar arm under this name, with these lines at the end.
fn scenario(scratch: &ScratchFolder, name: &str, more: &str) -> String {
    let robot = text(&workspace().join("robots/planar_2r"));
    let text = format!(
        r#"schema_version = 1
name = "{name}"
robot = {robot:?}
[controller]
kind = "kinematic"
[[motion]]
move_joints_deg = {{ joint_1 = 0.5 }}
duration_s = 0.01
{more}"#
    );
    scratch.write(&format!("{name}.toml"), &text)
}

const AGREEMENT: &str = "[[check]]\nkind = \"agreement\"\n";
/// A goal out of reach.
const FAR_GOAL: &str = "[[check]]\nkind = \"goal\"\ntcp = { xyz_m = [0, 0, 9] }\nposition_m = 0.1\n";
/// The tenth line of the file is wrong.
const WRONG: &str = "[[check]]\nkind = \"agreement\"\nposition_cm = 1\n";

/// The elements of this name below a node.
fn below<'a>(node: Node<'a, 'a>, name: &'static str) -> Vec<Node<'a, 'a>> {
    node.children().filter(|child| child.has_tag_name(name)).collect()
}

#[track_caller]
fn count(node: Node<'_, '_>, attribute: &str) -> usize {
    let value = node.attribute(attribute);
    let value = value.unwrap_or_else(|| panic!("no {attribute} in {}", node.tag_name().name()));
    value.parse().unwrap_or_else(|_| panic!("{attribute} = {value}"))
}

/// The time of an element, which is in seconds with three decimals.
#[track_caller]
fn milliseconds(node: Node<'_, '_>) -> usize {
    let time = node.attribute("time").unwrap_or_else(|| panic!("no time in {}", node.tag_name().name()));
    let (seconds, decimals) = time.split_once('.').unwrap();
    assert_eq!(decimals.len(), 3, "{time}");
    format!("{seconds}{decimals}").parse().unwrap()
}

/// What CI reads of a test case: suite, case, `passed` or the element that says otherwise, its message.
type Case = (String, String, String, String);

/// Reads a JUnit file as CI does and checks it: every suite has its counts and a time, every case a class and a time.
#[track_caller]
fn junit(path: &Path) -> Vec<Case> {
    let xml = fs::read_to_string(path).unwrap();
    let document = Document::parse(&xml).unwrap();
    let root = document.root_element();
    assert_eq!(root.tag_name().name(), "testsuites");
    let suites = below(root, "testsuite");
    let mut found = Vec::new();
    for attribute in ["tests", "failures", "errors", "skipped"] {
        let sum: usize = suites.iter().map(|suite| count(*suite, attribute)).sum();
        assert_eq!(count(root, attribute), sum, "{attribute} in\n{xml}");
    }
    let sum: usize = suites.iter().map(|suite| milliseconds(*suite)).sum();
    assert!(milliseconds(root).abs_diff(sum) <= suites.len(), "each is rounded:\n{xml}");
    for suite in suites {
        let cases = below(suite, "testcase");
        let with = |element| cases.iter().filter(|case| !below(**case, element).is_empty()).count();
        assert_eq!(count(suite, "tests"), cases.len());
        assert_eq!(count(suite, "failures"), with("failure"));
        assert_eq!(count(suite, "errors"), with("error"));
        assert_eq!(count(suite, "skipped"), with("skipped"));
        let sum: usize = cases.iter().map(|case| milliseconds(*case)).sum();
        assert!(milliseconds(suite).abs_diff(sum) <= cases.len(), "each is rounded:\n{xml}");
        for case in &cases {
            assert!(case.attribute("classname").is_some());
            let allowed = ["failure", "error", "skipped", "system-out"];
            let children = || case.children().filter(Node::is_element);
            assert!(children().all(|child| allowed.contains(&child.tag_name().name())), "{xml}");
            let result = case
                .children()
                .find(|child| ["failure", "error", "skipped"].contains(&child.tag_name().name()));
            let (word, message) = result.map_or(("passed", ""), |result| {
                (result.tag_name().name(), result.attribute("message").unwrap_or_default())
            });
            let name = |node: Node<'_, '_>| node.attribute("name").unwrap().to_owned();
            found.push((name(suite), name(*case), word.to_owned(), message.to_owned()));
        }
    }
    found
}

/// The words of the cases.
fn words(cases: &[Case]) -> Vec<&str> {
    cases.iter().map(|(_, _, word, _)| word.as_str()).collect()
}

/// Runs scenarios on two threads; the exit code, the JSON document, standard error and the JUnit cases.
#[track_caller]
fn run(scratch: &ScratchFolder, inputs: &[&str]) -> (i32, Value, String, Vec<Case>) {
    let (out, file) = (text(&scratch.path().join("out")), scratch.path().join("new/junit.xml"));
    let junit_file = text(&file);
    let options = ["--jobs", "2", "--no-recording", "--out", &out, "--junit", &junit_file];
    let answer = congruent_json(&[&["run"], inputs, &options].concat());
    // The checks that every run has are no matter here.
    let own = junit(&file).into_iter().filter(|(_, case, ..)| !case.ends_with("_default")).collect();
    (answer.code, answer.json(), answer.stderr, own)
}

#[test]
fn one_bad_scenario_of_three_keeps_no_other_from_running() {
    for position in 0..3 {
        let scratch = ScratchFolder::new();
        let mut inputs =
            vec![scenario(&scratch, "first", AGREEMENT), scenario(&scratch, "second", AGREEMENT)];
        let bad = scenario(&scratch, "bad", WRONG);
        inputs.insert(position, bad.clone());
        let inputs: Vec<&str> = inputs.iter().map(String::as_str).collect();
        let (code, document, stderr, cases) = run(&scratch, &inputs);
        assert_eq!(code, 2, "{stderr}");
        let entries = document.as_array().unwrap();
        assert_eq!(entries.len(), 3);
        for (index, (entry, input)) in entries.iter().zip(&inputs).enumerate() {
            assert_eq!(entry["input"], *input);
            if index == position {
                assert_eq!(entry["findings"][0]["line"], 11, "{entry}");
                assert_eq!(entry["findings"][0]["file"], *input);
            } else {
                assert_eq!(entry["verdict"], "as_expected", "{entry}");
            }
        }
        assert!(stderr.contains(&format!("{bad}: error\n")), "{stderr}");
        let mut expected = ["passed"; 3];
        expected[position] = "error";
        assert_eq!(words(&cases), expected);
        let (suite, _, _, message) = &cases[position];
        assert_eq!(suite, &bad);
        assert!(message.contains(&format!("{bad}:11: ")) && message.contains("position_cm"), "{message}");
        for name in ["first", "second"] {
            assert!(scratch.path().join("out").join(name).join("report.json").is_file(), "{name}");
        }
    }
}

#[test]
fn if_nothing_can_start_the_junit_file_is_red() {
    let scratch = ScratchFolder::new();
    let (bad, nowhere) = (scenario(&scratch, "bad", WRONG), text(&scratch.path().join("nowhere.toml")));
    let (code, document, _, cases) = run(&scratch, &[&bad, &nowhere]);
    assert_eq!((code, document.as_array().unwrap().len()), (2, 2));
    assert_eq!(words(&cases), ["error", "error"]);
    // A single input is answered by a single document.
    let (code, document, stderr, cases) = run(&scratch, &[&bad]);
    assert_eq!((code, &document["error"]), (2, &Value::from("bad input")));
    assert!(!stderr.contains("bad.toml: error"), "{stderr}");
    assert_eq!(words(&cases), ["error"]);
}

#[test]
fn of_two_scenarios_for_one_folder_the_first_runs() {
    let scratch = ScratchFolder::new();
    let first = scenario(&scratch, "same", AGREEMENT);
    let second = scratch.write("other.toml", &fs::read_to_string(&first).unwrap());
    let third = scenario(&scratch, "third", AGREEMENT);
    let (code, document, stderr, cases) = run(&scratch, &[&first, &second, &third]);
    assert_eq!(code, 2, "{stderr}");
    assert_eq!(document[0]["verdict"], "as_expected");
    assert_eq!(document[1]["findings"][0]["code"], "run::same_output");
    assert_eq!(document[2]["verdict"], "as_expected");
    assert_eq!(words(&cases), ["passed", "error", "passed"]);
    let message = &cases[1].3;
    assert!([&first, &second].iter().all(|path| message.contains(path.as_str())), "{message}");
}

#[test]
fn the_exit_code_is_the_worst() {
    let scratch = ScratchFolder::new();
    let passing = scenario(&scratch, "passing", AGREEMENT);
    let failing = scenario(&scratch, "failing", FAR_GOAL);
    let unchecked = scenario(&scratch, "unchecked", "");
    let (code, document, _, cases) = run(&scratch, &[&failing, &passing]);
    assert_eq!((code, &document[0]["exit_code"]), (1, &Value::from(1)));
    assert_eq!(words(&cases), ["failure", "passed"]);
    let (code, _, _, cases) = run(&scratch, &[&unchecked, &failing, &passing]);
    assert_eq!((code, words(&cases)), (1, vec!["error", "failure", "passed"]));
    // For people the worst come first, and each is below its file.
    let out = text(scratch.path());
    let answer = congruent(&["run", &passing, &failing, &unchecked, "--no-recording", "--out", &out]);
    let at =
        |text: String| answer.stdout.find(&text).unwrap_or_else(|| panic!("no {text}: {}", answer.stdout));
    let places = [
        at(format!("{failing}: FAILED")),
        at(format!("{unchecked}: NOT CHECKED")),
        at(format!("{passing}: passed")),
        at("3 inputs: 1 FAILED, 1 NOT CHECKED, 1 passed".to_owned()),
    ];
    assert!(places.is_sorted(), "{}", answer.stdout);
}

#[test]
fn warnings_of_several_scenarios_name_theirs() {
    let scratch = ScratchFolder::new();
    let quiet = scenario(&scratch, "quiet", AGREEMENT);
    let cut = scenario(&scratch, "cut", &format!("[simulation]\nduration_s = 0.005\n{AGREEMENT}"));
    let out = text(scratch.path());
    let answer = congruent(&["run", &quiet, &cut, "--no-recording", "--out", &out]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    assert!(
        answer.stderr.starts_with(&format!("{cut}: warning CGR-SCENARIO-021 scenario::cut_short")),
        "{}",
        answer.stderr
    );
}

#[test]
fn no_green_junit_file_remains_of_a_call_that_is_killed() {
    let scratch = ScratchFolder::new();
    let long = scenario(&scratch, "long", &format!("[simulation]\nduration_s = 50000\n{AGREEMENT}"));
    let (out, file) = (text(scratch.path()), scratch.path().join("junit.xml"));
    let mut call = allowing(&["run", &long, "--no-recording", "--out", &out, "--junit", &text(&file)])
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    while !file.exists() && call.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(1));
    }
    call.kill().unwrap();
    call.wait().unwrap();
    let cases = junit(&file);
    // Before the scenario is read it is one case, afterwards one for each check.
    assert!(!cases.is_empty() && words(&cases).iter().all(|&word| word == "error"), "{cases:?}");
    assert!([long.as_str(), "long"].contains(&cases[0].0.as_str()), "{cases:?}");
}

#[test]
fn check_answers_for_every_robot() {
    let scratch = ScratchFolder::new();
    let file = scratch.path().join("junit.xml");
    let robots = ["robots/ur5e/tool_5mm_off.toml", "robots/nowhere", "robots/planar_2r"];
    let answer = congruent_json(&[&["check"][..], &robots, &["--junit", &text(&file)]].concat());
    assert_eq!(answer.code, 2, "{}", answer.stderr);
    let document = answer.json();
    assert_eq!(document[0]["verdict"], "disagree");
    assert_eq!((&document[1]["input"], &document[1]["error"]), (&robots[1].into(), &"bad input".into()));
    assert_eq!(document[2]["verdict"], "agree");
    assert!(answer.stderr.contains("robots/nowhere: error\n"), "{}", answer.stderr);
    let cases = junit(&file);
    let of = |robot: &str| -> Vec<&Case> { cases.iter().filter(|(suite, ..)| suite == robot).collect() };
    let failed: Vec<&Case> = cases.iter().filter(|case| case.2 == "failure").collect();
    let [(suite, case, _, message)] = failed[..] else { panic!("{failed:?}") };
    assert_eq!((suite.as_str(), case.as_str()), (robots[0], "DH table against URDF chain"));
    for part in [
        "largest difference 5 mm",
        "at tool0",
        "tolerance 1",
        "tool_5mm_off.toml:12: ",
        "dhn_from_tip = { xyz_m = [0, 0, 0] }",
    ] {
        assert!(message.contains(part), "no {part} in {message}");
    }
    assert_eq!(of(robots[1]).iter().map(|case| case.2.as_str()).collect::<Vec<_>>(), ["error"]);
    let skipped = |case: &&&Case| (case.1.as_str(), case.2.as_str()) == ("dynamics", "skipped");
    assert_eq!(of(robots[2]).iter().filter(skipped).count(), 1);
    assert!(of(robots[2]).iter().filter(|case| !skipped(case)).all(|case| case.2 == "passed"));
    assert_eq!(congruent(&["check", robots[0], robots[2]]).code, 1);
    assert_eq!(congruent(&["check", robots[2], robots[2]]).code, 0);
}

#[test]
fn a_failed_agreement_names_its_cause_everywhere() {
    let scratch = ScratchFolder::new();
    let robot = scratch.robot("ur5e", &[("d_m = 0.0997", "d_m = 0.1027")]);
    let toml = fs::read_to_string(workspace().join("scenarios/ur5e_pick.toml")).unwrap();
    let path = scratch.write("wrong.toml", &toml.replace("../robots/ur5e", &robot));
    let (code, report, _, cases) = run(&scratch, &[&path]);
    assert_eq!(code, 1);
    let checked = congruent_json(&["check", &robot]).json();
    let cause = |report: &Value| report["diagnoses"][0]["causes"][0].clone();
    for key in ["cause", "joint", "parameter", "line"] {
        assert!(!cause(&report)[key].is_null(), "no {key} in {}", cause(&report));
        assert_eq!(cause(&report)[key], cause(&checked)[key], "{key}");
    }
    let line = checked["diagnosis"][0]["line"].as_u64().unwrap();
    let said = format!("robot.toml:{line}: joint \"wrist_2_joint\": d_m = 0.1027, expected d_m = 0.0997");
    assert!(report["checks"][0]["notes"][0].as_str().unwrap().contains(&said), "{}", report["checks"]);
    assert!(cases.iter().any(|case| case.2 == "failure" && case.3.contains(&said)), "{cases:?}");
    let own = fs::read_to_string(scratch.path().join("out/ur5e_pick/report.json")).unwrap();
    assert_eq!(serde_json::from_str::<Value>(&own).unwrap(), report);
    // What failed is printed first, with its cause.
    let answer = congruent(&["run", &path, "--no-recording", "--out", &text(scratch.path())]);
    let lines: Vec<&str> = answer.stdout.lines().collect();
    assert!(lines[1].starts_with("  agreement  fail "), "{}", answer.stdout);
    assert!(answer.stdout.contains(&said), "{}", answer.stdout);
}

#[test]
fn a_difference_of_rounding_has_no_cause() {
    let scratch = ScratchFolder::new();
    let input = scenario(&scratch, "tight", &format!("{AGREEMENT}position_m = 1e-30\n"));
    let (code, report, _, _) = run(&scratch, &[&input]);
    assert_eq!((code, &report["diagnoses"]), (1, &Value::Null));
    let note = report["checks"][0]["notes"][0].as_str().unwrap();
    assert!(note.contains("rounding"), "{note}");
}

#[test]
fn a_target_out_of_reach_is_the_only_finding() {
    let scratch = ScratchFolder::new();
    let input = scenario(&scratch, "far", AGREEMENT);
    let far = fs::read_to_string(&input)
        .unwrap()
        .replace("move_joints_deg = { joint_1 = 0.5 }", "move_tcp = { xyz_m = [3, 0, 0] }");
    scratch.write("far.toml", &far);
    let (code, document, _, _) = run(&scratch, &[&input]);
    let codes: Vec<&Value> =
        document["findings"].as_array().unwrap().iter().map(|finding| &finding["code"]).collect();
    assert_eq!((code, codes), (2, vec![&Value::from("scenario::out_of_reach")]));
}

#[cfg(feature = "recording")]
#[test]
fn inspect_ends_with_the_code_of_the_run_or_of_the_file() {
    let scratch = ScratchFolder::new();
    let passing = scenario(&scratch, "passing", AGREEMENT);
    let failing = scenario(&scratch, "failing", FAR_GOAL);
    congruent(&["run", &passing, &failing, "--out", &text(scratch.path())]);
    let recording = |name: &str| text(&scratch.path().join(name).join("recording.rrd"));
    let (passed, failed) = (recording("passing"), recording("failing"));
    let whole = fs::read(&passed).unwrap();
    let cut: PathBuf = scratch.path().join("cut.rrd");
    fs::write(&cut, &whole[..whole.len() / 2]).unwrap();
    let (cut, none) = (text(&cut), scratch.write("text.rrd", "no recording"));
    for (file, code, word, reason) in [
        (&passed, 0, "pass", "every check passes, as expected"),
        (&failed, 1, "FAIL", "goal"),
        (&cut, 2, "BAD RECORDING", "the file is cut off"),
    ] {
        let answer = congruent_json(&["inspect", file]);
        let document = answer.json();
        assert_eq!((answer.code, &document["exit_code"]), (code, &code.into()), "{file}");
        assert!(document["reason"].as_str().unwrap().contains(reason), "{}", document["reason"]);
        let text = congruent(&["inspect", file]).stdout;
        assert!(
            text.lines().next().is_some_and(|line| line.contains(&format!(": {word}: {reason}"))),
            "{text}"
        );
    }
    assert_eq!(congruent(&["inspect", &none]).code, 2);
    let file = scratch.path().join("inspected.xml");
    let answer = congruent_json(&["inspect", &passed, &none, &failed, &cut, "--junit", &text(&file)]);
    assert_eq!((answer.code, answer.json().as_array().unwrap().len()), (2, 4));
    let cases = junit(&file);
    // The agreement check with the default limits of either run, its verdict; what is no recording, or cut, has no checks.
    let of_runs =
        [&["passed"; 4][..], &["error"], &["failure", "passed", "passed", "failure"], &["error"]].concat();
    assert_eq!(words(&cases), of_runs);
    for name in ["passing", "failing"] {
        let of_run = junit(&scratch.path().join(name).join("junit.xml"));
        for (_, check, word, message) in of_run {
            let is_same = |case: &Case| (&case.1, &case.2, &case.3) == (&check, &word, &message);
            assert!(cases.iter().any(is_same), "{name}: {check}");
        }
    }
    assert_eq!(congruent(&["inspect", &passed, &failed]).code, 1);
}
