//! Whole robots.

use congruent_mjcf::{MjEffort, MjModel};
use serde_json::Value;

use crate::{
    kinematics::{difference, pose, world_from_bodies},
    shared::{goldens, left_out, numbers, pairs, read},
};

const ROBOTS: [&str; 5] = ["ur5e", "wx250s", "so_arm100", "panda", "piper"];
/// Poses, m and rad. Kind: golden digits, 1e-15, along ten bodies. Worst seen 2e-15.
const POSE: f64 = 1e-12;

#[test]
fn robots_are_read_as_mujoco_reads_them() {
    if pairs().is_none() {
        return left_out("robots");
    }
    for robot in ROBOTS {
        let (folder, golden) = goldens(robot).unwrap();
        let (model, found) = read(&folder.join("robot.xml"));
        let model = model.unwrap_or_else(|| panic!("{robot} is refused: {found:?}"));
        check_poses(robot, &model, &golden);
        check_joints(robot, &model, &golden);
    }
}

fn check_poses(robot: &str, model: &MjModel, golden: &Value) {
    let links: Vec<&str> =
        golden["links"].as_array().unwrap().iter().map(|link| link.as_str().unwrap()).collect();
    let configurations = golden["configurations"].as_array().or(golden["configs"].as_array());
    let configurations = configurations.unwrap_or_else(|| panic!("{robot}: {:?}", keys(golden)));
    assert!(!configurations.is_empty());
    for configuration in configurations {
        let q = numbers(&configuration["q"]);
        let poses = world_from_bodies(model, &q);
        let expected =
            configuration["poses"].as_array().unwrap_or_else(|| panic!("{:?}", keys(configuration)));
        for (link, expected) in links.iter().zip(expected) {
            let index = model.bodies.iter().position(|body| body.name.text == *link).unwrap();
            let off = difference(&poses[index], &pose(&numbers(expected)));
            assert!(off <= POSE, "{robot}, {link}: off by {off}");
        }
    }
}

fn keys(value: &Value) -> Vec<&String> {
    value.as_object().map(|object| object.keys().collect()).unwrap_or_default()
}

fn check_joints(robot: &str, model: &MjModel, golden: &Value) {
    let joints = golden["joints"].as_array().unwrap();
    assert_eq!(model.joints.len(), joints.len(), "{robot}");
    for (found, expected) in model.joints.iter().zip(joints) {
        assert_eq!(expected["name"].as_str(), Some(found.name.text.as_str()));
        let effort = match &found.effort {
            MjEffort::Within { range: [low, high], .. } => Some(high.max(-low)),
            _ => None,
        };
        let golden = expected["effort"].as_f64();
        // The golden takes the limit of a tendon's actuator for that of its joints.
        if !matches!(found.effort, MjEffort::ThroughTendon) {
            assert_eq!(effort, golden, "{robot}, {}", found.name);
        }
        for (found, key) in [(&found.armature, "armature"), (&found.friction_loss, "frictionloss")] {
            if let Some(golden) = expected[key].as_f64() {
                assert!(
                    (found.value - golden).abs() < 1e-12,
                    "{robot}: {key} is {} instead of {golden}",
                    found.value
                );
            }
        }
    }
}
