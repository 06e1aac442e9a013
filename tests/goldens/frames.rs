//! `congruent fk --from --to`: the pose of one frame in another, by every source; and a link that is called as the declared
//! tool centre point.

use std::fs;

use serde_json::Value;

use crate::support::{
    command::{congruent, congruent_json, text},
    corpus::workspace,
};

/// Rounding: quaternions to matrices and back, on an arm of 1 m; worst seen 4e-16.
const ROUNDING: f64 = 1e-13;
const AT: [&str; 4] = ["--at", "elbow_joint=1.2rad", "--at", "wrist_2_joint=-0.7rad"];

fn pose(document: &Value, name: &str) -> ([f64; 3], [f64; 4]) {
    let pose = &document["results"][0]["links"][name];
    let number =
        |key: &str, at: usize| pose[key][at].as_f64().unwrap_or_else(|| panic!("{name}: {document}"));
    ([0, 1, 2].map(|at| number("translation_m", at)), [0, 1, 2, 3].map(|at| number("quaternion_wxyz", at)))
}

fn rotated([w, x, y, z]: [f64; 4], v: [f64; 3]) -> [f64; 3] {
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let t = cross([x, y, z], v).map(|value| 2.0 * value);
    let u = cross([x, y, z], t);
    [0, 1, 2].map(|at| v[at] + w * t[at] + u[at])
}

fn fk(more: &[&str]) -> Value {
    let answer = congruent_json(&[&["fk", "robots/ur5e"], &AT[..], more].concat());
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    answer.json()
}

/// The position of the tip in the forearm, from the poses of both in the root, by formulas of quaternions.
#[test]
fn a_pose_in_another_frame_is_what_the_poses_in_the_root_say() {
    let all = fk(&[]);
    assert_eq!(all["from"], "base_link");
    let (tip, (origin, [w, x, y, z])) = (pose(&all, "tool0").0, pose(&all, "forearm_link"));
    let expected = rotated([w, -x, -y, -z], [0, 1, 2].map(|at| tip[at] - origin[at]));
    for source in ["urdf", "poe", "simulation"] {
        let one = fk(&["--from", "forearm_link", "--to", "tool0", "--source", source]);
        assert_eq!(one["results"][0]["links"].as_object().unwrap().len(), 1);
        let found = pose(&one, "tool0").0;
        // The physics has its own rounding.
        let limit = if source == "simulation" { 1e-11 } else { ROUNDING };
        assert!(
            (0..3).all(|at| (found[at] - expected[at]).abs() < limit),
            "{source}: {found:?} {expected:?}"
        );
    }
    let in_forearm = fk(&["--from", "forearm_link"]);
    assert_eq!(in_forearm["from"], "forearm_link");
    let (found, [w, ..]) = pose(&in_forearm, "forearm_link");
    assert!(found.iter().all(|value| value.abs() < ROUNDING) && (w - 1.0).abs() < ROUNDING);
    let printed = congruent(&[&["fk", "robots/ur5e"], &AT[..], &["--from", "forearm_link"]].concat()).stdout;
    assert!(printed.contains("configuration 1: poses in forearm_link"), "{printed}");
}

#[test]
fn frames_of_the_table_and_unknown_ones() {
    let one = fk(&["--source", "dh", "--from", "dh0", "--to", "dh6"]);
    let back = fk(&["--source", "dh", "--from", "dh6", "--to", "dh0"]);
    let ((there, [w, x, y, z]), (back, _)) = (pose(&one, "dh6"), pose(&back, "dh0"));
    let expected = rotated([w, -x, -y, -z], there.map(|value| -value));
    assert!((0..3).all(|at| (back[at] - expected[at]).abs() < ROUNDING));
    let answer = congruent(&["fk", "robots/ur5e", "--from", "forarm_link"]);
    assert_eq!(answer.code, 2);
    assert!(answer.stderr.contains("did you mean \"forearm_link\"?"), "{}", answer.stderr);
    let answer = congruent(&["fk", "robots/ur5e", "--source", "dh", "--to", "dh7"]);
    assert!(answer.code == 2 && answer.stderr.contains("known frames"), "{}", answer.stderr);
}

/// A link `tcp` at the end of an arm whose robot file declares a tool centre point 0.1 m before it.
#[test]
fn a_link_that_is_called_tcp_does_not_hide_the_declared_one() {
    let folder = tempfile::tempdir().unwrap();
    let urdf = fs::read_to_string(workspace().join("robots/planar_2r/planar_2r.urdf")).unwrap();
    let urdf = urdf.replace(
        "</robot>",
        "<link name='tcp'/><joint name='to_tcp' type='fixed'><parent link='tip'/><child link='tcp'/>\
         <origin xyz='0.5 0 0'/></joint></robot>",
    );
    fs::write(folder.path().join("planar_2r.urdf"), urdf).unwrap();
    let file = fs::read_to_string(workspace().join("robots/planar_2r/robot.toml")).unwrap();
    let (head, table) = file.split_at(file.find("[dh]").unwrap());
    let robot = folder.path().join("robot.toml");
    fs::write(&robot, format!("{head}tcp = {{ xyz_m = [0.1, 0, 0] }}\n{table}")).unwrap();
    let robot = text(&robot);
    let at_end = |name: &str| {
        let answer = congruent_json(&["fk", &robot, "--from", "tip", "--to", name]);
        assert_eq!(answer.code, 0, "{}", answer.stderr);
        pose(&answer.json(), name).0[0]
    };
    assert!((at_end("tcp") - 0.5).abs() < ROUNDING && (at_end("declared_tcp") - 0.1).abs() < ROUNDING);
    let answer = congruent(&["fk", &robot]);
    for words in ["the robot has a link \"tcp\"", "\"tip\"", "\"declared_tcp\""] {
        assert!(answer.stderr.contains(words), "no {words:?} in {}", answer.stderr);
    }
    let jacobian = congruent_json(&["jacobian", &robot, "--link", "declared_tcp"]).json();
    assert_eq!(jacobian["tcp"]["link"], "tip");
    assert_eq!(congruent_json(&["jacobian", &robot, "--link", "tcp"]).json()["tcp"], Value::Null);
}
