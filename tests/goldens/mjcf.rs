//! `congruent fk` and `congruent dynamics` of MJCF files against MuJoCo.

use serde_json::Value;

use super::dynamics::worst;
use crate::support::{
    command::{congruent_json, text},
    corpus::corpus,
    golden::{Golden, angle_rad, distance_m, numbers},
};

const ROBOTS: [&str; 5] = ["ur5e", "wx250s", "so_arm100", "panda", "piper"];
const KINDS: [&str; 4] = ["zero", "axis", "random", "home"];

/// Kind: rounding, along ten bodies. Worst seen: 2e-15 m.
const POSITION_M: f64 = 1e-12;
/// Kind: rounding. Worst seen: 2e-15 rad.
const ORIENTATION_RAD: f64 = 1e-12;
/// Relative to the largest entry of a vector. Kind: rounding.
const DYNAMICS: f64 = 1e-9;
/// Relative to the largest entry; extrapolation of the step of a scheme of first order.
const SIMULATION: f64 = 1e-7;

#[test]
fn poses_of_mjcf_files_agree_with_mujoco() {
    let Some(corpus) = corpus() else { return };
    let folder = tempfile::tempdir().unwrap();
    for name in ROBOTS {
        let robot = corpus.join("pairs").join(name);
        let golden = Golden::load(&robot);
        let configurations = golden.configurations(&KINDS);
        assert!(configurations.len() > 20, "{name}: too few configurations");
        let batch = folder.path().join("batch.json");
        golden.write_batch(&configurations, &batch);
        let mjcf = text(&robot.join("robot.xml"));
        let answer = congruent_json(&["fk", &mjcf, "--configurations", &text(&batch)]);
        assert_eq!(answer.code, 0, "{name}: {}", answer.stderr);
        let report = answer.json();
        for (index, configuration) in configurations.iter().enumerate() {
            for (link, golden) in golden.links().iter().zip(configuration["poses"].as_array().unwrap()) {
                check(&format!("{name} {link}, {index}"), &report["results"][index]["links"][link], golden);
            }
        }
    }
}

fn check(place: &str, found: &Value, golden: &Value) {
    let golden = numbers(golden);
    let apart_m = distance_m(&numbers(&found["translation_m"]), &golden[..3]);
    assert!(apart_m <= POSITION_M, "{place}: {apart_m:e} m");
    let turned_rad = angle_rad(&numbers(&found["quaternion_wxyz"]), &golden[3..]);
    assert!(turned_rad <= ORIENTATION_RAD, "{place}: {turned_rad:e} rad");
}

#[test]
fn dynamics_of_mjcf_files_agree_with_mujoco() {
    let Some(corpus) = corpus() else { return };
    let folder = tempfile::tempdir().unwrap();
    for name in ROBOTS {
        let robot = corpus.join("pairs").join(name);
        // The dynamics of the golden is without armature, which these robots have at every joint.
        let golden = Golden::load(&robot).with_armature();
        let batch = text(&folder.path().join("batch.json"));
        golden.write_batch(&golden.configurations(&["zero", "random"]), batch.as_ref());
        for (source, limit) in [("model", DYNAMICS), ("simulation", SIMULATION)] {
            let worst = worst(&text(&robot.join("robot.xml")), &batch, &golden, source);
            assert!(worst < limit, "{name} by {source}: {worst:e}");
        }
    }
}

/// The partner of each pair is the same robot in URDF: the check ends with an answer, whatever it is.
#[test]
fn a_urdf_is_compared_with_an_mjcf() {
    let Some(corpus) = corpus() else { return };
    for name in ROBOTS {
        let folder = corpus.join("pairs").join(name);
        let [urdf, mjcf] = ["partner.urdf", "robot.xml"].map(|file| text(&folder.join(file)));
        for files in [[&urdf, &mjcf], [&mjcf, &urdf]] {
            let answer = congruent_json(&["check", files[0], "--against", files[1]]);
            assert!([0, 1].contains(&answer.code), "{name}: {} {}", answer.code, answer.stderr);
            assert!(answer.json()["against"].is_object(), "{name}");
        }
    }
}
