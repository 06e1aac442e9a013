//! `congruent check` of robots whose joints have damping and dry friction: the physics is not reported to be another robot.

use std::fs;

use serde_json::Value;

use crate::support::{command::congruent_json, corpus::workspace, scratch_folder::ScratchFolder};

/// The planar arm with these losses at every joint and its inertias times a factor, against its physics.
fn checked(damping: f64, friction: f64, lighter: f64) -> (i32, Value) {
    let scratch = ScratchFolder::new();
    let urdf = fs::read_to_string(workspace().join("robots/planar_2r/planar_2r.urdf")).unwrap();
    let dynamics = format!("<dynamics damping=\"{damping}\" friction=\"{friction}\"/></joint>");
    let mass = format!("<mass value=\"{}\"/>", 2.0 * lighter);
    let inertia = format!(
        "ixx=\"{0}\" ixy=\"0\" ixz=\"0\" iyy=\"{1}\" iyz=\"0\" izz=\"{1}\"",
        6.25e-4 * lighter,
        6.03125e-2 * lighter
    );
    let changed = urdf.replace("</joint>", &dynamics).replace("<mass value=\"2\"/>", &mass).replace(
        "ixx=\"0.000625\" ixy=\"0\" ixz=\"0\" iyy=\"0.0603125\" iyz=\"0\" izz=\"0.0603125\"",
        &inertia,
    );
    let urdf = scratch.write("arm.urdf", &changed);
    let answer = congruent_json(&["check", &urdf]);
    (answer.code, answer.json())
}

#[test]
fn damping_and_friction_of_any_size_agree_with_the_physics() {
    for damping in [0.0, 0.02, 0.5, 10.0, 300.0] {
        for friction in [0.0, 10.0] {
            let (code, report) = checked(damping, friction, 1.0);
            assert_eq!(code, 0, "damping {damping}, friction {friction}: {}", report["dynamics"]);
            assert!(
                report["dynamics"].is_object(),
                "damping {damping}, friction {friction}: {}",
                report["not_asked"]
            );
        }
    }
}
