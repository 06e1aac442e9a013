//! Laws that hold for every robot: three forward kinematics of one robot agree, and what does not
//! change the robot does not change its poses.

#[path = "support/mod.rs"]
mod support;

use congruent_description::{DhTable, Robot, RobotQ};
use congruent_kinematics::{DhChain, KinematicsError, Pose, ScrewTree, Twist, UrdfTree};
use nalgebra::Isometry3;
use proptest::prelude::*;
use support::{Carried, within};

/// Rounding: up to nine products within 25 m of reach (prismatic joints move by pi), eps each;
/// worst seen 4.3e-14.
const ROUNDING_M: f64 = 2e-13;
/// Rounding: up to nine products of rotations, eight eps each; worst seen 8.4e-15.
const ROUNDING_RAD: f64 = 3e-14;

fn urdf_links(robot: &Robot, q: &RobotQ) -> Vec<Pose> {
    let mut links = vec![Pose::identity(); robot.links().len()];
    UrdfTree::new(robot).root_from_links_into(q, &mut links).expect("lengths are right");
    links
}

fn screw_links(robot: &Robot, q: &RobotQ) -> Vec<Pose> {
    let mut links = vec![Pose::identity(); robot.links().len()];
    ScrewTree::new(robot).root_from_links_into(q, &mut links).expect("lengths are right");
    links
}

fn is_same(a: &Pose, b: &Pose) -> bool {
    let is_near = within(a.distance_m(b), ROUNDING_M);
    is_near && within(a.angle_rad(b), ROUNDING_RAD)
}

proptest! {
    #![proptest_config(support::cases())]

    #[test]
    fn dh_equals_poe_equals_urdf(figures in support::table_figures(), q in support::positions()) {
        let robot = figures.robot();
        let q = &q.of_robot(&robot);
        let by_table = DhChain::new(&figures.table(&robot), &robot).base_from_tip(q).unwrap();
        let tip = robot.find_link("tip").unwrap();
        prop_assert!(is_same(&ScrewTree::new(&robot).root_from_link(q, tip).unwrap(), &by_table));
        prop_assert!(is_same(&UrdfTree::new(&robot).root_from_link(q, tip).unwrap(), &by_table));
    }

    #[test]
    fn poe_equals_urdf_on_trees(joints in support::tree(), q in support::positions()) {
        let robot = support::robot(joints);
        let q = &q.of_robot(&robot);
        for (by_screws, by_joints) in screw_links(&robot, q).iter().zip(&urdf_links(&robot, q)) {
            prop_assert!(is_same(by_screws, by_joints));
        }
    }

    #[test]
    fn one_link_is_that_link_of_all(joints in support::tree(), q in support::positions()) {
        let robot = support::robot(joints);
        let q = &q.of_robot(&robot);
        let (tree, screws) = (UrdfTree::new(&robot), ScrewTree::new(&robot));
        let (by_joints, by_screws) = (urdf_links(&robot, q), screw_links(&robot, q));
        for link in robot.link_indices() {
            prop_assert!(is_same(&tree.root_from_link(q, link).unwrap(), &by_joints[link.get()]));
            prop_assert!(is_same(&screws.root_from_link(q, link).unwrap(), &by_screws[link.get()]));
        }
    }

    #[test]
    fn moving_the_base_moves_everything(
        joints in support::tree(), moved in support::isometry(), q in support::positions()
    ) {
        let robot = support::robot(joints.clone());
        let q = &q.of_robot(&robot);
        let lifted = support::robot(lift(joints, moved));
        for all_links in [urdf_links, screw_links] {
            let (before, after) = (all_links(&robot, q), all_links(&lifted, q));
            for link in robot.link_indices() {
                let name = if link == robot.root() { "pedestal" } else { robot.link(link).name.as_str() };
                let after = &after[lifted.find_link(name).unwrap().get()];
                prop_assert!(is_same(after, &(Pose::from(moved) * before[link.get()])));
            }
        }
    }

    #[test]
    fn moving_the_base_of_a_table_moves_its_frames(
        figures in support::table_figures(), moved in support::isometry(), q in support::positions()
    ) {
        let robot = figures.robot();
        let q = &q.of_robot(&robot);
        let mut table = figures.table(&robot);
        let frames = |table: &DhTable| {
            let chain = DhChain::new(table, &robot);
            let mut frames = vec![Pose::identity(); chain.joint_count() + 1];
            chain.dh_frames_into(q, &mut frames).map(|()| frames)
        };
        let before = frames(&table).unwrap();
        table.base_from_dh0 = moved * table.base_from_dh0;
        for (before, after) in before.iter().zip(&frames(&table).unwrap()) {
            prop_assert!(is_same(after, &(Pose::from(moved) * *before)));
        }
    }

    #[test]
    fn splitting_a_link_with_a_fixed_joint_changes_nothing(
        joints in support::tree(),
        which in any::<prop::sample::Index>(),
        middle in support::isometry(),
        q in support::positions(),
    ) {
        let robot = support::robot(joints.clone());
        let q = &q.of_robot(&robot);
        let split = support::robot(split(joints, which, middle));
        for all_links in [urdf_links, screw_links] {
            let (before, after) = (all_links(&robot, q), all_links(&split, q));
            for link in robot.link_indices() {
                let in_split = split.find_link(&robot.link(link).name).unwrap();
                prop_assert!(is_same(&after[in_split.get()], &before[link.get()]));
            }
        }
    }

    #[test]
    fn each_screw_is_found_by_moving_its_joint_alone(
        joints in support::tree(), step in 0.1..1.0
    ) {
        let robot = support::robot(joints);
        let (tree, screws) = (UrdfTree::new(&robot), ScrewTree::new(&robot));
        for (coordinate, &joint) in robot.movable_joints().iter().enumerate() {
            let child = robot.joint(joint).child;
            let mut q = RobotQ::zeros(robot.dof());
            let home = tree.root_from_link(&q, child).unwrap();
            q[coordinate] = step;
            let moved = tree.root_from_link(&q, child).unwrap();
            let (found, screw) = (Twist::log(&(moved * home.inverse())), screws.screw(joint).unwrap().twist());
            prop_assert!(within((found.angular / step - screw.angular).norm(), ROUNDING_RAD / step));
            prop_assert!(within((found.linear / step - screw.linear).norm(), ROUNDING_M / step));
        }
    }
}

/// A new root below which the old one, now `pedestal`, is fixed.
fn lift(joints: Vec<Carried>, root_from_pedestal: Isometry3<f64>) -> Vec<Carried> {
    let mut lifted = vec![Carried::fixed("pedestal", "base", root_from_pedestal)];
    lifted.extend(joints.into_iter().map(|joint| {
        let parent = if joint.parent == "base" { "pedestal".into() } else { joint.parent };
        Carried { parent, ..joint }
    }));
    lifted
}

/// One joint hung on a new link that is fixed to its old parent.
fn split(
    mut joints: Vec<Carried>,
    which: prop::sample::Index,
    parent_from_middle: Isometry3<f64>,
) -> Vec<Carried> {
    let which = which.index(joints.len());
    let joint = &mut joints[which];
    let middle = Carried::fixed("middle", &joint.parent, parent_from_middle);
    joint.parent.clone_from(&middle.name);
    joint.parent_from_joint = parent_from_middle.inverse() * joint.parent_from_joint;
    joints.insert(which, middle); // where the joint was, so that the order of coordinates stays
    joints
}

#[test]
fn wrong_lengths_are_refused() {
    let figures = support::TableFigures::new(
        congruent_description::DhConvention::Standard,
        &[support::RowFigures::revolute(0.5, 0.0, 0.0)],
    );
    let robot = figures.robot();
    let (tree, screws) = (UrdfTree::new(&robot), ScrewTree::new(&robot));
    let chain = DhChain::new(&figures.table(&robot), &robot);
    let joints = KinematicsError::JointCount { expected: 1, found: 2 };
    let root = robot.root();
    let q = RobotQ::zeros(2);
    let poses = &mut [Pose::identity(); 3];
    assert_eq!(chain.base_from_tip(&q), Err(joints.clone()));
    assert_eq!(chain.base_from_tcp(&q, &Pose::identity()), Err(joints.clone()));
    assert_eq!(chain.dh_frames_into(&q, &mut poses[..2]), Err(joints.clone()));
    assert_eq!(tree.root_from_links_into(&q, poses), Err(joints.clone()));
    assert_eq!(screws.root_from_links_into(&q, poses), Err(joints.clone()));
    assert_eq!(tree.root_from_link(&q, root), Err(joints.clone()));
    assert_eq!(screws.root_from_link(&q, root), Err(joints));
    let too_many = |expected| Err(KinematicsError::PoseCount { expected, found: 4 });
    let (q, poses) = (RobotQ::zeros(1), &mut [Pose::identity(); 4]);
    assert_eq!(chain.dh_frames_into(&q, poses), too_many(2));
    assert_eq!(tree.root_from_links_into(&q, poses), too_many(3));
    assert_eq!(screws.root_from_links_into(&q, poses), too_many(3));
    let frames = congruent_kinematics::DhFrames { transformed_by: 0, of: 2 };
    assert_eq!(chain.dhi_from_dhj(&q, frames), Err(KinematicsError::FrameIndex { index: 2, last: 1 }));
}
