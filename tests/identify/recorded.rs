//! `identify` on logs whose efforts were made by other programs, with known parameters.

use crate::support::{
    command::{congruent, congruent_json, text},
    corpus::corpus,
    golden::number,
    scratch_folder::ScratchFolder,
};

const EFFORTS: &str = "docs/examples/log/efforts.csv";

/// A term of each joint that was estimated.
fn terms<'a>(report: &'a serde_json::Value, term: &str) -> Vec<&'a serde_json::Value> {
    let joints = report["joints"].as_array().unwrap();
    let of = joints.iter().flat_map(|joint| joint["terms"].as_array().unwrap());
    of.filter(|of| of["term"] == term).collect()
}

/// Logs of MuJoCo: inverse dynamics, 0.4 N m tanh(qd / 0.02), 0.6 N m s/rad and 0.05 kg m^2 at each joint; exact positions, positions of
/// an encoder of 19 bits with messages that lack joints, stamps that jitter, degrees.
#[test]
fn friction_and_armature_of_a_simulator_are_found_whatever_the_log_lacks() {
    let Some(corpus) = corpus() else { return };
    let logs = [
        ("ur5e", "p1_ur5e_clean_500hz.mcap", &[][..], 0.01_f64),
        ("ur5e", "p2_ur5e_order_missing_nan.mcap", &[], 0.01),
        ("panda", "p4_panda_two_clocks.mcap", &[], 0.02),
        ("ur5e", "p5_ur5e_degrees_prefix.mcap", &["--degrees"], 0.05),
    ];
    for (robot, log, more, worst) in logs {
        let (robot, log) = (format!("robots/{robot}"), text(&corpus.join("logs/synthetic").join(log)));
        let answer = congruent_json(&[&["identify", &robot, &log], more].concat());
        assert_eq!(answer.code, 0, "{log}: {}", answer.stderr);
        let report = answer.json();
        assert_eq!(
            (&report["verdict"], &report["effort"]["kind"]),
            (&"better".into(), &"torque".into()),
            "{log}"
        );
        for (term, truth) in [("viscous", 0.6), ("coulomb", 0.4)] {
            let found = terms(&report, term);
            assert!(found.len() >= 6, "{log}");
            for of in found {
                let off = (number(&of["value"]) - truth).abs();
                assert!(off < worst.max(4.0 * number(&of["standard_error"])), "{log}: {of}");
            }
        }
        for of in terms(&report, "armature") {
            let off = (number(&of["value"]) - 0.05).abs();
            assert!(off < 0.002_f64.max(4.0 * number(&of["standard_error"])), "{log}: {of}");
        }
        for joint in report["joints"].as_array().unwrap().iter().filter(|joint| joint["instants"] != 0) {
            assert!(number(&joint["after_rms"]) < 0.3 * number(&joint["before_rms"]), "{log}: {joint}");
        }
    }
}

/// The physics with a payload of 1.2 kg at (5, -10, 60) mm; its efforts are those of the step before.
#[test]
fn a_payload_and_the_delay_of_efforts_are_found() {
    let report =
        congruent_json(&["identify", "robots/ur5e", EFFORTS, "--free", "friction,armature,payload"]).json();
    assert!((number(&report["effort_delay_s"]) - 0.001).abs() < 1e-4, "{}", report["effort_delay_s"]);
    let payload = &report["payload"];
    assert!((number(&payload["mass"]["value"]) - 1.2).abs() < 0.01, "{payload}");
    for (axis, truth_m) in [0.005, -0.010, 0.060].into_iter().enumerate() {
        assert!((number(&payload["center_m"][axis]) - truth_m).abs() < 1e-3, "{payload}");
    }
    let lines = report["lines"]["of_scenario"].as_str().unwrap();
    assert!(lines.contains("[[payload]]") && lines.contains("mass_kg = 1.20"), "{lines}");
}

#[test]
fn the_written_urdf_has_the_friction_and_needs_none_more() {
    let scratch = ScratchFolder::new();
    let out = text(&scratch.path().join("identified.urdf"));
    let free = ["--free", "friction"];
    let first = congruent(&[&["identify", "robots/ur5e", EFFORTS, "--out", &out], &free[..]].concat());
    assert_eq!(first.code, 0, "{}{}", first.stdout, first.stderr);
    let again = congruent_json(&[&["identify", &out, EFFORTS], &free[..]].concat()).json();
    let written = |of: &&serde_json::Value| number(&of["nominal"]) > 0.0;
    let terms: Vec<_> =
        ["viscous", "coulomb"].into_iter().flat_map(|term| terms(&again, term)).filter(written).collect();
    assert!(terms.len() >= 4, "{terms:?}");
    for of in terms {
        // Written to a hundredth of the standard error.
        let moved = (number(&of["value"]) - number(&of["nominal"])).abs();
        assert!(moved < 0.02 * number(&of["standard_error"]), "{of}");
    }
    let refused = congruent(&[&["identify", "robots/ur5e", EFFORTS, "--out", &out], &free[..]].concat());
    assert_eq!(refused.code, 2, "{}", refused.stdout);
}

#[test]
fn what_cannot_be_identified_is_refused_with_what_to_write() {
    let refused = |more: &[&str], code: &str, words: &str| {
        let answer = congruent(&[&["identify", "robots/ur5e"], more].concat());
        assert_eq!(answer.code, 2, "{more:?}: {}", answer.stdout);
        assert!(answer.stderr.contains(code) && answer.stderr.contains(words), "{more:?}: {}", answer.stderr);
    };
    refused(&["docs/examples/log/joints.csv"], "CGR-COMMAND-101", "no efforts");
    refused(&[EFFORTS, "--free", "payload", "--payload-at", "tool1"], "CGR-COMMAND-103", "tool0");
    refused(&[EFFORTS, "--free", "payload,links"], "CGR-COMMAND-103", "sum alone");
    refused(&[EFFORTS, "--effort", "current", "--free", "links"], "CGR-COMMAND-103", "--torque-constant");
    refused(&[EFFORTS, "--torque-constant", "elbow=9.2"], "CGR-COMMAND-103", "elbow_joint");
    refused(&[EFFORTS, "--still"], "CGR-COMMAND-102", "at rest");
}
