//! A log of the corpus as a stream: nothing is lost, and the values are those of its replay.

use std::fmt::Write;

use congruent::logs::{LogEvent, LogOptions, LoggedJoints, LoggedPose, open_log};
use serde_json::{Value, json};

use super::{documents, of_kind};
use crate::support::{command::congruent_with_input, corpus::corpus};

/// Poses and joints were written in double precision: the rest is rounding, m.
const POSE_M: f64 = 1e-8;

fn joints_line(joints: &LoggedJoints) -> Value {
    let named = |values: &[f64]| -> Value {
        joints.names.iter().zip(values).map(|(name, value)| (name.clone(), json!(value))).collect()
    };
    json!({
        "time_s": joints.time.stamp_s, "q": named(&joints.position), "v": named(&joints.velocity),
        "tau": named(&joints.effort),
    })
}

fn pose_line(pose: &LoggedPose) -> Value {
    json!({
        "time_s": pose.time.stamp_s, "origin": "controller",
        "pose": {
            "frame": pose.frame, "child": "tool0", "translation_m": pose.child_in_frame_m,
            "quaternion_wxyz": pose.frame_from_child_wxyz,
        },
    })
}

#[test]
fn a_clean_log_passes_as_a_stream_and_every_sample_is_judged() {
    let Some(corpus) = corpus() else { return };
    let path = corpus.join("logs/synthetic/p1_ur5e_clean_500hz.mcap");
    let mut log = open_log(&path, &LogOptions::default()).unwrap();
    let (mut lines, mut messages) = (String::new(), 0);
    while let Some(event) = log.next_event().unwrap() {
        let line = match &event {
            LogEvent::Joints(joints) => {
                messages += 1;
                joints_line(joints)
            }
            LogEvent::Pose(pose) if log.topics()[pose.topic].name.contains("tcp_pose") => pose_line(pose),
            _ => continue,
        };
        writeln!(lines, "{line}").unwrap();
    }
    let answer = congruent_with_input(&["watch", "robots/ur5e", "--format", "json"], &lines);
    let documents = documents(&answer.stdout);
    let [finished] = of_kind(&documents, "finished")[..] else {
        panic!("{}{}", answer.stdout, answer.stderr)
    };
    assert_eq!((answer.code, &finished["counts"]["samples"]), (0, &json!(messages)), "{finished:#}");
    let checks = finished["report"]["checks"].as_array().unwrap();
    let pose = checks.iter().find(|check| check["check"] == "pose").unwrap_or_else(|| panic!("{finished:#}"));
    let worst = pose["measures"][0]["worst"]["value"].as_f64().unwrap();
    assert!(worst < POSE_M && pose["samples"].as_u64().unwrap() > 900, "{pose:#}");
}
