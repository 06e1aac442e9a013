//! Each line is answered at once; bad lines, gaps and unknown joints are said and counted.

use serde_json::Value;

use super::{documents, line, of_kind, swing, times};
use crate::support::{
    command::{congruent_with_input, text},
    live::Live,
    published_table::UR5E_JOINTS,
    scratch_folder::ScratchFolder,
};

/// Rounding of a pose: written and read as decimal numbers.
const POSE_M: f64 = 1e-9;

#[test]
fn each_line_is_answered_before_the_next_is_written() {
    let mut live = Live::begin(&[
        "watch",
        "robots/ur5e",
        "--poses",
        "--rate-hz",
        "50",
        "--until-violation",
        "--format",
        "json",
    ]);
    for (number, time_s) in times(1.25, 50, 20).enumerate() {
        live.write(&line(time_s, swing(time_s)));
        if number == 0 {
            let started = live.next();
            assert_eq!(started["kind"], "started", "{started}");
            assert_eq!(started["joints"].as_array().unwrap().len(), UR5E_JOINTS.len(), "{started}");
        }
        let pose = live.next();
        assert_eq!((&pose["kind"], &pose["time_s"]), (&"pose".into(), &time_s.into()), "{pose}");
    }
    // Beyond the range of the elbow, which is half a turn.
    let mut q = swing(1.65);
    q[2] = 4.0;
    live.write(&line(1.65, q));
    assert_eq!(live.next()["kind"], "pose");
    let violation = live.next();
    assert_eq!((&violation["kind"], &violation["check"]), (&"violation".into(), &"limits".into()));
    assert_eq!((&violation["where"], &violation["time_s"]), (&"elbow_joint".into(), &1.65.into()));
    let finished = live.next();
    assert_eq!((&finished["kind"], &finished["exit_code"]), (&"finished".into(), &1.into()), "{finished}");
    assert_eq!(finished["counts"]["samples"], 21);
    // Standard input is still open.
    assert_eq!(live.code(), 1);
}

#[test]
fn the_poses_are_those_of_forward_kinematics() {
    let lines: String = times(0.0, 100, 60).map(|time_s| line(time_s, swing(time_s)) + "\n").collect();
    let arguments =
        ["watch", "robots/ur5e/ur5e.urdf", "--poses", "--output-rate-hz", "10", "--format", "json"];
    let answer = congruent_with_input(&arguments, &lines);
    let documents = documents(&answer.stdout);
    let poses = of_kind(&documents, "pose");
    assert_eq!(poses.len(), 6, "{}", answer.stderr);
    for pose in poses {
        let arguments =
            ["fk", "robots/ur5e/ur5e.urdf", "--to", "tool0", "--configurations", "-", "--format", "json"];
        let q = line(0.0, swing(pose["time_s"].as_f64().unwrap())).replace("\"time_s\": 0, ", "");
        let expected = congruent_with_input(&arguments, &q).json();
        let expected = &expected["results"][0]["links"]["tool0"]["translation_m"];
        for axis in 0..3 {
            let difference = pose["translation_m"][axis].as_f64().unwrap() - expected[axis].as_f64().unwrap();
            assert!(difference.abs() < POSE_M, "{pose} {expected}");
        }
    }
}

#[test]
fn bad_lines_gaps_and_unknown_joints_are_said_and_counted() {
    let mut lines: Vec<String> = times(10.0, 100, 100).map(|time_s| line(time_s, swing(time_s))).collect();
    lines.extend(times(12.0, 100, 100).map(|time_s| line(time_s, swing(time_s))));
    // Unknown at three instants: between known ones it is interpolated.
    for at in [60, 61, 62] {
        lines[at] = lines[at].replace("\"elbow_joint\": ", "\"elbow_joint\": null, \"of_another\": ");
    }
    // Its clock goes back: a new part.
    lines.extend(times(3.0, 100, 100).map(|time_s| line(time_s, swing(time_s))));
    lines.insert(70, "{\"time_s\": 1, ".to_owned());
    lines.insert(71, String::new());
    let answer = congruent_with_input(&["watch", "robots/ur5e", "--format", "json"], &lines.join("\n"));
    let documents = documents(&answer.stdout);
    let [bad] = of_kind(&documents, "bad_line")[..] else { panic!("{}", answer.stdout) };
    assert_eq!((&bad["line"], &bad["text"]), (&71.into(), &"{\"time_s\": 1, ".into()), "{bad}");
    let [gap, restart] = of_kind(&documents, "gap")[..] else { panic!("{}", answer.stdout) };
    assert_eq!(
        (&gap["from_s"], &gap["to_s"], &gap["cause"]),
        (&10.99.into(), &12.0.into(), &"no_samples".into())
    );
    assert_eq!((&restart["to_s"], &restart["cause"]), (&3.0.into(), &"clock_went_back".into()));
    let [finished] = of_kind(&documents, "finished")[..] else { panic!("{}", answer.stdout) };
    let counts = &finished["counts"];
    let count = |name: &str| counts[name].as_u64().unwrap();
    assert_eq!((count("samples"), count("left_out"), count("bad_lines")), (300, 0, 1), "{counts}");
    assert_eq!((count("gaps"), count("restarts")), (2, 1), "{counts}");
}

#[test]
fn the_results_are_those_of_a_replay_of_the_same_lines() {
    let folder = ScratchFolder::new();
    let lines: String = times(0.0, 100, 200).map(|time_s| line(time_s, swing(time_s)) + "\n").collect();
    let log = folder.write("watch.jsonl", &lines);
    let [watched, replayed] = ["watched", "replayed"].map(|name| text(&folder.path().join(name)));
    let answer = congruent_with_input(&["watch", "robots/ur5e", "--out", &watched], &lines);
    let replay = crate::support::command::congruent(&[
        "replay",
        "robots/ur5e",
        &log,
        "--out",
        &replayed,
        "--no-recording",
    ]);
    assert_eq!((answer.code, replay.code), (0, 0), "{}\n{}{}", answer.stdout, replay.stdout, replay.stderr);
    let report =
        |out: &str| crate::support::golden::read_json(&std::path::Path::new(out).join("watch/report.json"));
    let (watched_report, replayed_report) = (report(&watched), report(&replayed));
    assert_eq!(watched_report["trajectory_sha256"], replayed_report["trajectory_sha256"]);
    let checks = |mut report: Value| {
        // The checks of a replay have lines in its scenario.
        report["checks"].as_array_mut().unwrap().iter_mut().for_each(|check| check["line"] = Value::Null);
        report["checks"].clone()
    };
    assert_eq!(checks(watched_report), checks(replayed_report));
    let page = std::fs::read_to_string(std::path::Path::new(&watched).join("watch/report.html")).unwrap();
    // There was no physics.
    assert!(!page.contains("twin (physics)") && page.contains("Model and log where"));
}

#[test]
fn what_cannot_be_used_of_a_stream_counts_against_it_as_in_a_replay() {
    let whole = || times(0.0, 100, 200).map(|time_s| line(time_s, swing(time_s)));
    let every_second = |instead: &dyn Fn(String) -> String| -> Vec<String> {
        whole().enumerate().map(|(at, line)| if at % 2 == 1 { instead(line) } else { line }).collect()
    };
    let damaged = every_second(&|line| line[..30].to_owned());
    let without_joints = every_second(&|line| line[..line.find("\"q\"").unwrap()].to_owned() + "\"q\": {}}");
    let stopped: Vec<String> =
        times(0.0, 100, 200).map(|time_s| line(time_s.min(0.99), swing(time_s))).collect();
    let folder = ScratchFolder::new();
    for (name, lines) in [("damaged", damaged), ("without_joints", without_joints), ("stopped", stopped)] {
        let lines = lines.join("\n");
        let log = folder.write(&format!("{name}.jsonl"), &lines);
        let out = text(&folder.path().join(name));
        let arguments = ["watch", "robots/ur5e", "--out", &out, "--format", "json"];
        let watched = congruent_with_input(&arguments, &lines);
        let replayed =
            crate::support::command::congruent(&["replay", "robots/ur5e", &log, "--out", &out, "--force"]);
        assert_eq!((watched.code, replayed.code), (1, 1), "{name}: {}{}", watched.stdout, replayed.stdout);
        assert!(replayed.stdout.contains("used share 0.5 at the log"), "{name}: {}", replayed.stdout);
        assert!(watched.stdout.contains("100 of 200 messages not used"), "{name}: {}", watched.stdout);
    }
}

#[test]
fn what_is_no_stream_of_the_robot_is_refused() {
    for (input, part) in [
        ("", "ended before its first message"),
        ("{\"time_s\": 0, \"q\": {\"a\": 1}}\n", "the log has no joint of robot"),
        ("{\"time_s\": 0}\n", "ended before its first message"),
    ] {
        let answer = congruent_with_input(&["watch", "robots/ur5e"], input);
        assert_eq!(answer.code, 2, "{}", answer.stdout);
        assert!(answer.stderr.contains(part), "{}", answer.stderr);
    }
}

#[test]
#[cfg(unix)]
fn a_signal_ends_the_run_in_order_while_the_stream_is_open() {
    let mut live = Live::begin(&["watch", "robots/ur5e", "--rate-hz", "100", "--format", "json"]);
    times(0.0, 100, 50).for_each(|time_s| live.write(&line(time_s, swing(time_s))));
    assert_eq!(live.next()["kind"], "started");
    live.signal("INT");
    let finished = live.next();
    assert_eq!(
        (&finished["kind"], &finished["verdict"]),
        (&"finished".into(), &"as_expected".into()),
        "{finished}"
    );
    assert_eq!(live.code(), 0);
}

#[test]
fn a_joint_of_the_chain_that_never_comes_is_no_pass() {
    // The log of an arm with fewer joints: what the last two did nobody knows.
    let shorter = |lines: String| lines.replace("wrist_2_joint", "a").replace("wrist_3_joint", "b");
    let lines: String = times(0.0, 100, 200).map(|time_s| line(time_s, swing(time_s)) + "\n").collect();
    let lines = shorter(lines);
    let folder = ScratchFolder::new();
    let log = folder.write("short.jsonl", &lines);
    let out = text(&folder.path().join("out"));
    let watched = congruent_with_input(&["watch", "robots/ur5e"], &lines);
    let run = |arguments: &[&str]| {
        crate::support::command::congruent(&[arguments, &["--out", &out, "--no-recording"]].concat())
    };
    let replayed = run(&["replay", "robots/ur5e", &log]);
    for answer in [&watched, &replayed] {
        assert_eq!(answer.code, 1, "{}{}", answer.stdout, answer.stderr);
        assert!(answer.stdout.contains("never in the log"), "{}", answer.stdout);
    }
    // Who knows that they stood still says so.
    let scenario = folder.path().join("out/short.toml");
    let written = std::fs::read_to_string(&scenario).unwrap();
    let held = |names: &str| {
        std::fs::write(&scenario, written.replace("[source]\n", &format!("[source]\nheld = {names}\n")))
            .unwrap();
        run(&["run", scenario.to_str().unwrap()])
    };
    let known = held("[\"wrist_2_joint\", \"wrist_3_joint\"]");
    assert_eq!(known.code, 0, "{}{}", known.stdout, known.stderr);
    let wrong = held("[\"elbow_joint\"]");
    assert_eq!(wrong.code, 2, "{}", wrong.stdout);
    assert!(wrong.stderr.contains("it lacks wrist_2_joint, wrist_3_joint"), "{}", wrong.stderr);
}

#[test]
fn late_lines_of_a_stream_are_lost_and_a_replay_puts_them_in_order() {
    // Each third line is of a time between the two before it.
    let late = |at: usize, time_s: f64| if at % 3 == 2 { time_s - 0.015 } else { time_s };
    let lines: String = times(0.0, 100, 201)
        .enumerate()
        .map(|(at, time_s)| line(late(at, time_s), swing(late(at, time_s))) + "\n")
        .collect();
    let watched = congruent_with_input(&["watch", "robots/ur5e"], &lines);
    assert_eq!(watched.code, 1, "{}", watched.stdout);
    assert!(watched.stdout.contains("67 of 201 messages not used"), "{}", watched.stdout);
    assert!(watched.stdout.contains("134 samples judged, 67 late"), "{}", watched.stdout);
    let folder = ScratchFolder::new();
    let log = folder.write("late.jsonl", &lines);
    let out = text(&folder.path().join("out"));
    let replayed = crate::support::command::congruent(&["replay", "robots/ur5e", &log, "--out", &out]);
    assert_eq!(replayed.code, 0, "{}", replayed.stdout);
}

#[test]
fn times_in_milliseconds_are_said() {
    let lines: String = times(0.0, 100, 100).map(|time_s| line(1e3 * time_s, swing(time_s)) + "\n").collect();
    let answer = congruent_with_input(&["watch", "robots/ur5e"], &lines);
    assert!(answer.stderr.contains("10 s apart: as ms they would be those of 100 Hz"), "{}", answer.stderr);
}
