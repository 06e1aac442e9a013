//! Values of a robot that replace those of its files.

#![expect(clippy::unwrap_used, reason = "a helper that fails fails its test")]

use std::path::PathBuf;

use congruent_description::{Inertia, RobotDescription, load_robot_set};
use congruent_input::{FileAccess, Findings, Override};
use nalgebra::Vector3;

fn loaded(changes: &[&str]) -> Result<RobotDescription, Findings> {
    let robot = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/ur5e"));
    let changes: Vec<Override> = changes.iter().map(|change| change.parse().unwrap()).collect();
    load_robot_set(&robot, &changes, &FileAccess::default())
}

/// To the last bit: values are read and not computed.
#[track_caller]
fn are_same<const N: usize>(found: [f64; N], wanted: [f64; N]) {
    assert_eq!(found.map(f64::to_bits), wanted.map(f64::to_bits), "{found:?} for {wanted:?}");
}

#[track_caller]
fn refused(change: &str, message: &str) {
    let found = loaded(&[change]).unwrap_err();
    let text = format!("{} {}", found[0].message, found[0].help.clone().unwrap_or_default());
    assert!(text.contains(message), "{text}");
}

#[test]
fn values_of_the_robot_file_are_replaced_and_added() {
    let changes = ["dh.row.elbow_joint.d_m=0.002", "dh.row.2.a_m=-0.43", "tcp.xyz_m.3=0.06"];
    let set = loaded(&changes).unwrap();
    let rows = &set.dh.as_ref().unwrap().rows;
    are_same([rows[2].d_m, rows[1].a_m, set.tip_from_tcp.unwrap().translation.z], [0.002, -0.43, 0.06]);
    // A value that the file does not have yet.
    are_same([loaded(&["dh.row.4.d_m=0.1334"]).unwrap().dh.unwrap().rows[3].d_m], [0.1334]);
}

#[test]
fn a_link_is_heavier_and_as_wide() {
    let [before, after] = [&[][..], &["link.forearm_link.mass_kg=4.532", "link.forearm_link.com_m.1=0.1"]]
        .map(|changes| loaded(changes).unwrap().robot);
    let link = before.find_link("forearm_link").unwrap();
    let [before, after] = [&before, &after].map(|robot| robot.link(link).inertia.unwrap());
    are_same([after.mass_kg], [4.532]);
    let radius = |of: &Inertia| of.tensor_kg_m2[(0, 0)] / of.mass_kg;
    assert!((radius(&before) - radius(&after)).abs() < 1e-15);
    are_same([after.link_from_inertial.translation.x], [0.1]);
}

#[test]
fn a_joint_has_other_losses_and_another_origin() {
    let set = loaded(&["joint.elbow_joint.friction=2", "joint.elbow_joint.rpy_deg=[0, 90, 0]"]).unwrap();
    let joint = set.robot.joint(set.robot.find_joint("elbow_joint").unwrap());
    are_same([joint.friction], [2.0]);
    let x = joint.parent_from_joint.rotation * Vector3::x();
    assert!((x + Vector3::z()).norm() < 1e-12, "a quarter turn about y takes x to -z: {x}");
}

#[test]
fn what_cannot_be_set_is_refused_with_what_can() {
    refused("joint.elbow.friction=3", "no joint \"elbow\"");
    refused("joint.elbow.friction=3", "elbow_joint");
    refused("link.forearm_link.mass=3", "mass_kg");
    refused("link.forearm_link.mass_kg=-3", "negative");
    refused("link.forearm_link.mass_kg=heavy", "not a number");
    refused("link.forearm_link.com_m.4=1", "no entry from 1 to 3");
    refused("link.forearm_link.com_m=[0, 1]", "three numbers");
    refused("dh.row.elbow.d_m=1", "elbow_joint");
    refused("dh.rows.1.d_m=1", "no such key");
    refused("dh.row.1.d_m=nan", "NaN");
}
