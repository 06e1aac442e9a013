//! Reported velocities of logs at low and at high rates: a velocity is that of an instant, a change of position that of a period.

use std::fmt::Write;

use crate::support::{
    command::congruent, golden::read_json, published_table::UR5E_JOINTS, scratch_folder::ScratchFolder,
};

/// What is wrong with reported velocities.
#[derive(Clone, Copy)]
struct Reported {
    factor: f64,
    late_s: f64,
}

/// Swings of 1.1 rad/s and more, with a half period that a search for a lag must not reach at 8 Hz.
fn log(rate_hz: u32, fastest_rad_s: f64, reported: Reported) -> String {
    let mut lines = String::new();
    for at in 0..(60 * rate_hz).max(300) {
        let time_s = f64::from(at) / f64::from(rate_hz);
        let (mut q, mut v) = (String::new(), String::new());
        for (joint, name) in (0_u8..).zip(UR5E_JOINTS) {
            let frequency = fastest_rad_s - 0.08 * f64::from(joint);
            let late_s = time_s - reported.late_s;
            let mean = [0.3, -1.2, 1.4, -0.9, 1.1, 0.2][usize::from(joint)];
            let _ = write!(q, ", \"{name}\": {}", mean + 0.3 * (frequency * time_s).sin());
            let rate = reported.factor * 0.3 * frequency * (frequency * late_s).cos();
            let _ = write!(v, ", \"{name}\": {rate}");
        }
        let [q, v] = [&q, &v].map(|values| values.trim_start_matches(", "));
        let _ = writeln!(lines, "{{\"time_s\": {time_s}, \"q\": {{{q}}}, \"v\": {{{v}}}}}");
    }
    lines
}

/// The check `velocity` of a log.
fn velocity(log: &str) -> serde_json::Value {
    let folder = ScratchFolder::new();
    let path = folder.write("log.jsonl", log);
    let out = folder.path().join("out");
    let answer =
        congruent(&["replay", "robots/ur5e", &path, "--out", out.to_str().unwrap(), "--no-recording"]);
    let report = read_json(&out.join("log/report.json"));
    let checks = report["checks"].as_array().unwrap();
    let found = checks.iter().find(|check| check["check"] == "velocity");
    found.unwrap_or_else(|| panic!("{}{}", answer.stdout, answer.stderr)).clone()
}

fn error(check: &serde_json::Value) -> f64 {
    check["measures"][0]["worst"]["value"].as_f64().unwrap_or_else(|| panic!("{check}"))
}

#[test]
fn a_factor_is_found_at_every_rate_and_a_correct_log_has_none() {
    for rate_hz in [2, 5, 8, 50, 500] {
        let found = |factor: f64, late_s: f64| velocity(&log(rate_hz, 1.1, Reported { factor, late_s }));
        for (factor, late_s) in [(1.0, 0.0), (1.0, 0.02), (1.05, 0.0), (-1.0, 0.0)] {
            let check = found(factor, late_s);
            assert!((error(&check) - (factor - 1.0).abs()).abs() < 2e-3, "{rate_hz} Hz, {factor}: {check}");
            assert_eq!(check["status"] == "fail", factor < 0.0, "{rate_hz} Hz, {factor}: {check}");
            let notes = check["notes"].to_string();
            assert_eq!(notes.contains("late"), late_s > 0.0, "{rate_hz} Hz, {late_s} s: {check}");
        }
    }
}

#[test]
fn a_motion_between_the_samples_is_not_judged_except_for_its_sign() {
    let found = |factor: f64| velocity(&log(2, 4.0, Reported { factor, late_s: 0.0 }));
    let check = found(1.0);
    assert_eq!(check["status"], "skipped", "{check}");
    assert!(check["notes"].to_string().contains("too far apart"), "{check}");
    assert_eq!(found(-1.0)["status"], "fail");
}
