//! What is wrong with a stream is said when it comes: a jump of an encoder, poses off, a scenario's own limits.

use serde_json::Value;

use super::{documents, line, of_kind, swing, times};
use crate::support::{command::congruent_with_input, scratch_folder::ScratchFolder};

/// Jump of the encoder of the elbow, rad.
const JUMP: f64 = 0.02;

/// The swing with measured poses of the tool at each sample; from the middle on the encoder of the elbow is off.
fn with_jump(rate_hz: u32, count: u32) -> Vec<String> {
    let clean: String = times(0.0, rate_hz, count).map(|time_s| line(time_s, swing(time_s)) + "\n").collect();
    let answer = congruent_with_input(&["watch", "robots/ur5e", "--poses", "--format", "json"], &clean);
    let documents = documents(&answer.stdout);
    let poses = of_kind(&documents, "pose");
    assert_eq!(poses.len(), count as usize, "{}", answer.stderr);
    let with_pose = |(at, pose): (usize, &Value)| {
        let time_s = pose["time_s"].as_f64().unwrap();
        let mut q = swing(time_s);
        q[2] += if 2 * at >= count as usize { JUMP } else { 0.0 };
        let measured = serde_json::json!({
            "frame": pose["frame"], "child": pose["child"],
            "translation_m": pose["translation_m"], "quaternion_wxyz": pose["quaternion_wxyz"],
        });
        let joints = line(time_s, q);
        format!(
            "{}, \"pose\": {measured}, \"origin\": \"measured\"}}",
            joints.trim_end_matches('}').to_owned() + "}"
        )
    };
    poses.into_iter().enumerate().map(with_pose).collect()
}

#[test]
fn a_jump_of_an_encoder_is_said_with_its_joint_while_the_stream_goes_on() {
    let lines = with_jump(100, 800).join("\n");
    let answer = congruent_with_input(&["watch", "robots/ur5e", "--format", "json"], &lines);
    let documents = documents(&answer.stdout);
    let violations = of_kind(&documents, "violation");
    let find = |check: &str| violations.iter().find(|violation| violation["check"] == check);
    let jump = find("step").unwrap_or_else(|| panic!("{}", answer.stdout));
    assert_eq!(jump["where"], "elbow_joint", "{jump}");
    let near =
        |value: &Value, expected: f64, within: f64| (value.as_f64().unwrap() - expected).abs() < within;
    // Within three samples, and a tenth.
    assert!(near(&jump["time_s"], 4.0, 0.03) && near(&jump["value"], JUMP, 0.1 * JUMP), "{jump}");
    let pose = find("pose").unwrap_or_else(|| panic!("{}", answer.stdout));
    assert!(near(&pose["time_s"], 4.0, 0.01), "{pose}");
    assert_eq!(answer.code, 1);
}

#[test]
fn until_the_first_violation() {
    let lines = with_jump(100, 800).join("\n");
    let arguments = ["watch", "robots/ur5e", "--until-violation", "--format", "json"];
    let answer = congruent_with_input(&arguments, &lines);
    let documents = documents(&answer.stdout);
    let [finished] = of_kind(&documents, "finished")[..] else { panic!("{}", answer.stdout) };
    assert_eq!((answer.code, &finished["counts"]["samples"]), (1, &401.into()), "{finished}");
    assert_eq!(finished["report"]["stopped"]["check"], "pose", "{finished}");
}

#[test]
fn a_value_that_comes_back_within_its_limit_is_said_and_the_verdict_stays() {
    let mut lines: Vec<String> = times(0.0, 100, 100).map(|time_s| line(time_s, swing(time_s))).collect();
    for (at, line_of) in lines.iter_mut().enumerate().skip(70).take(5) {
        let time_s = f64::from(u32::try_from(at).unwrap()) / 100.0;
        let mut q = swing(time_s);
        q[2] = 3.5;
        *line_of = line(time_s, q);
    }
    let answer = congruent_with_input(&["watch", "robots/ur5e"], &lines.join("\n"));
    let shown: Vec<&str> = answer.stdout.lines().filter(|line| line.contains("limits:")).collect();
    let [violation, recovered] = shown[..] else { panic!("{}", answer.stdout) };
    assert!(
        violation.starts_with("0.7 s  VIOLATION") && violation.ends_with("at elbow_joint"),
        "{violation}"
    );
    assert!(recovered.starts_with("0.75 s  recovered"), "{recovered}");
    assert!(answer.stdout.contains("FAIL: limits") && answer.code == 1, "{}", answer.stdout);
}

#[test]
fn a_scenario_has_limits_of_its_own() {
    let folder = ScratchFolder::new();
    let scenario = |check: &str| {
        format!(
            "schema_version = 1\nname = \"cell\"\nrobot = \"nowhere\"\n\n[source]\nlog = \"stream\"\n\n[[check]]\n{check}\n"
        )
    };
    let file = folder.write("cell.toml", &scenario("kind = \"limits\"\nmargin_deg = 150"));
    let lines: String = times(0.0, 100, 60).map(|time_s| line(time_s, swing(time_s)) + "\n").collect();
    let answer = congruent_with_input(&["watch", "robots/ur5e", "--scenario", &file], &lines);
    assert!(
        answer.code == 1 && answer.stdout.contains("VIOLATION  limits"),
        "{}{}",
        answer.stdout,
        answer.stderr
    );
    // A wrong key is named with its line.
    let file = folder.write("wrong.toml", &scenario("kind = \"limits\"\nmargin = 5"));
    let answer = congruent_with_input(&["watch", "robots/ur5e", "--scenario", &file], &lines);
    assert!(answer.code == 2 && answer.stderr.contains("wrong.toml"), "{}", answer.stderr);
}
