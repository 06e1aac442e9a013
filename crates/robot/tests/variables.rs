//! A robot in other variables, with locked joints, and with other frames.

use std::collections::BTreeSet;

use congruent_description::parse_urdf;
use congruent_robot::{MappedJoint, Robot, RobotQ};
use nalgebra::{Isometry3, Translation3, Unit, UnitQuaternion};

/// A slide that follows a hinge, and a hinge on it.
const URDF: &str = r#"<robot name="r">
  <link name="base"/><link name="arm"><inertial><mass value="2"/><origin xyz="0.1 0 0"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="slide"/><link name="hand"/>
  <joint name="a" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="0 0 0.3" rpy="0.4 0 0"/>
    <axis xyz="0 1 0"/><limit lower="-1" upper="2" effort="1" velocity="1"/></joint>
  <joint name="b" type="prismatic"><parent link="arm"/><child link="slide"/><origin xyz="0.2 0 0"/>
    <axis xyz="1 0 0"/><limit lower="0" upper="0.5" effort="1" velocity="1"/><mimic joint="a" multiplier="0.2" offset="0.1"/></joint>
  <joint name="c" type="continuous"><parent link="slide"/><child link="hand"/><origin rpy="0 0.7 0"/></joint>
</robot>"#;

/// Pose of the hand in the base at the positions of a and c.
fn base_from_hand(robot: &Robot, a: f64, c: f64) -> Isometry3<f64> {
    let mut q = RobotQ::from([a, 0.0, c]);
    robot.apply_mimic(&mut q);
    let joints = robot.joints().iter().map(|joint| {
        let at = robot.coordinate(robot.find_joint(&joint.name).expect("it is its own joint"));
        joint.parent_from_joint * joint.motion(at.map_or(0.0, |at| q[at]))
    });
    joints.fold(Isometry3::identity(), |before, joint| before * joint)
}

#[track_caller]
fn assert_same(found: &Isometry3<f64>, expected: &Isometry3<f64>) {
    let off = found.to_homogeneous() - expected.to_homogeneous();
    assert!(off.amax() < 1e-15, "{off}");
}

#[test]
fn the_same_positions_in_other_variables_give_the_same_poses() {
    let robot = parse_urdf(URDF).unwrap();
    let [a, b, c] = [0, 1, 2].map(|at| robot.movable_joints()[at]);
    let mapped =
        |joint, name: &str, is_flipped, offset| MappedJoint { joint, name: name.into(), is_flipped, offset };
    let mapping = [mapped(a, "b", true, 0.3), mapped(b, "x", true, -0.05), mapped(c, "c", false, 1.0)];
    let there = robot.in_variables(&mapping);
    assert_eq!(there.movable_joint_names().collect::<Vec<_>>(), ["b", "x", "c"]);
    for (q_a, q_c) in [(0.0, 0.0), (0.7, -0.4), (-1.2, 2.0)] {
        let found = base_from_hand(&there, mapping[0].there(q_a), mapping[2].there(q_c));
        assert_same(&found, &base_from_hand(&robot, q_a, q_c));
    }
    let (lower, upper) = there.joints()[0].position_range().unwrap();
    assert!((lower + 1.7).abs() < 1e-15 && (upper - 1.3).abs() < 1e-15, "{lower} {upper}");
}

#[test]
fn a_locked_joint_stays_at_zero_and_its_follower_at_its_offset() {
    let robot = parse_urdf(URDF).unwrap();
    let locked = robot.locked(&BTreeSet::from([robot.movable_joints()[0]]));
    assert_eq!(locked.movable_joint_names().collect::<Vec<_>>(), ["c"]);
    assert!((locked.joints()[1].parent_from_joint.translation.vector.x - 0.3).abs() < 1e-15);
}

#[test]
fn frames_that_lie_elsewhere_carry_inertia_and_children_along() {
    let robot = parse_urdf(URDF).unwrap();
    let axis = Unit::new_normalize(robot.joints()[0].axis_in_joint.into_inner());
    let along = Translation3::from(axis.into_inner() * 0.2);
    let mut frames = vec![Isometry3::identity(); 4];
    frames[1] = along * UnitQuaternion::from_euler_angles(0.2, 0.5, -0.3);
    let there = robot.with_link_frames(&frames);
    for (q_a, q_c) in [(0.0, 0.0), (0.7, -0.4)] {
        assert_same(&base_from_hand(&there, q_a, q_c), &base_from_hand(&robot, q_a, q_c));
    }
    let com = |robot: &Robot| {
        let joint = &robot.joints()[0];
        let link = robot.link(joint.child).inertia.unwrap().link_from_inertial;
        joint.parent_from_joint * joint.motion(0.9) * link
    };
    assert_same(&com(&there), &com(&robot));
}
