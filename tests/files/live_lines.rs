//! Lines on standard input are answered while they come.

use serde_json::Value;

use crate::support::live::Live;

#[test]
fn each_line_is_answered_before_the_next_is_written() {
    let json = ["--configurations", "-", "--format", "json"];
    for command in ["fk", "jacobian", "dynamics"] {
        let mut live = Live::begin(&[&[command, "robots/ur5e"], &json[..]].concat());
        let mut first = None;
        for angle in [0.0, 0.5, 1.0] {
            let line = format!(r#"{{"q": {{"elbow_joint": {angle}}}}}"#);
            let answer: Value = serde_json::from_str(&live.ask(&line, "{")).expect("a document in one line");
            let result = answer["results"][0].clone();
            assert!(result.is_object() && answer["results"].as_array().unwrap().len() == 1, "{answer}");
            assert_ne!(first.replace(result.clone()), Some(result), "{command} at {angle}");
        }
        assert_eq!(live.end(), 0, "{command}");
    }
}

#[test]
fn targets_are_answered_one_by_one() {
    let mut live = Live::begin(&["ik", "robots/ur5e", "--targets", "-", "--format", "json"]);
    for (x_m, is_reached) in [(0.4, true), (9.0, false)] {
        let line = format!(r#"{{"translation_m": [{x_m}, 0.1, 0.3]}}"#);
        let answer: Value = serde_json::from_str(&live.ask(&line, "{")).expect("a document in one line");
        assert_eq!(answer["results"][0]["converged"], is_reached, "{answer}");
    }
    assert_eq!(live.end(), 1, "one target is not reached");
}

#[test]
fn for_people_the_lines_are_counted() {
    let mut live = Live::begin(&["fk", "robots/ur5e", "--to", "tool0", "--configurations", "-"]);
    for number in 1..=3 {
        live.ask(r#"{"q": {}}"#, &format!("configuration {number}: "));
    }
    assert_eq!(live.end(), 0);
    // The number of a wrong line is that of the input.
    let mut live = Live::begin(&["fk", "robots/ur5e", "--configurations", "-"]);
    live.ask(r#"{"q": {}}"#, "configuration 1: ");
    live.write(r#"{"q": {"elbo": 1}}"#);
    assert_eq!(live.end(), 2);
}
