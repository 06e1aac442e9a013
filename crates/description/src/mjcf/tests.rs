//! Small models, a construct or two each.

use std::sync::Arc;

use congruent_input::{Capability, Diagnostics, Severity, SourceFile};
use congruent_robot::{Geometry, JointKind};
use nalgebra::{Isometry3, Vector3};

use super::*;

/// A robot from the content of its `<worldbody>` and what follows it, with its findings.
fn read(text: &str) -> (Option<Robot>, Vec<Diagnostic>) {
    let text = format!("<mujoco model='m'>{text}</mujoco>");
    let source = Arc::new(SourceFile { path: "m.xml".into(), text, is_foreign: false });
    let mut diagnostics = Diagnostics::default();
    let mut include = |_: &str| unreachable!();
    let inputs = MjcfInputs { include: &mut include, find_mesh: &mut crate::urdf::no_mesh };
    let read = parse(&source, &mut { inputs }, &mut diagnostics);
    (read.map(|read| read.robot), diagnostics.into_vec())
}

const MASS: &str = "<inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>";

#[track_caller]
fn robot(text: &str) -> Robot {
    let (robot, found) = read(text);
    robot.unwrap_or_else(|| panic!("{found:#?}"))
}

fn link_names(robot: &Robot) -> Vec<&str> {
    robot.links().iter().map(|link| link.name.as_str()).collect()
}

#[test]
fn the_root_element_decides() {
    for text in
        ["<mujoco/>", "\u{feff} <?xml version='1.0'?>\n<!-- <robot> -->\n<mujoco model='a'>", "<mujoco>"]
    {
        assert!(is_mjcf(text), "{text}");
    }
    for text in ["", "<robot name='mujoco'/>", "<mujocoinclude/>", "<!-- <mujoco>", "<mujoco"] {
        assert!(!is_mjcf(text), "{text}");
    }
}

#[test]
fn joints_in_one_body_get_links_between_them() {
    let robot = robot(&format!(
        "<worldbody><body name='b' pos='0 0 1'>{MASS}<joint name='x' axis='1 0 0'/>\
         <joint name='y' axis='0 1 0' pos='0.1 0 0'/><site name='b'/></body></worldbody>"
    ));
    assert_eq!(link_names(&robot), ["world", "b (before y)", "b (axis of y)", "b", "site:b"]);
    assert_eq!(robot.movable_joint_names().collect::<Vec<_>>(), ["x", "y"]);
    let back = &robot.joints()[2];
    assert_eq!((back.kind, back.parent_from_joint.translation.x), (JointKind::Fixed, -0.1));
    assert!((robot.links()[3].inertia.unwrap().mass_kg - 1.0).abs() < 1e-15);
}

#[test]
fn at_its_ref_a_body_is_where_it_is_written() {
    let robot = robot(&format!(
        "<compiler angle='radian'/><worldbody><body name='b' pos='0 0 1'>{MASS}\
         <joint name='s' type='slide' ref='0.5' range='0 1'/></body></worldbody>"
    ));
    let joint = &robot.joints()[0];
    assert_eq!(joint.position_range(), Some((0.0, 1.0)));
    assert!((joint.parent_from_joint.translation.z - 0.5).abs() < 1e-15);
}

#[test]
fn a_free_body_is_fixed_and_a_ball_joint_only_where_nothing_follows() {
    let (robot, found) = read(&format!("<worldbody><body name='b'>{MASS}<freejoint/></body></worldbody>"));
    assert_eq!(robot.map(|robot| robot.dof()), Some(0));
    assert_eq!((found[0].code.name, found[0].stops), ("mjcf::free", None));

    let ball = |inner: &str| {
        read(&format!(
            "<worldbody><body name='b'>{MASS}<joint name='j' type='ball'/>{inner}</body></worldbody>"
        ))
    };
    let (robot, found) = ball("");
    assert!(robot.is_some());
    assert_eq!((found[0].code.name, found[0].stops), ("mjcf::ball", Some(Capability::Physics)));
    let (robot, found) = ball(&format!("<body name='c'>{MASS}<joint/></body>"));
    assert!(robot.is_none());
    assert_eq!((found[0].code.name, found[0].severity), ("mjcf::ball", Severity::Error));
    assert!(found[0].message.contains("\"j\""), "{found:?}");
}

#[test]
fn couplings_are_followers_if_they_are_linear() {
    let coupled = |polycoef: &str| {
        read(&format!(
            "<worldbody><body>{MASS}<joint name='a' type='slide' ref='1'/></body>\
             <body>{MASS}<joint name='b' type='slide' ref='2'/></body></worldbody>\
             <equality><joint joint1='b' joint2='a' polycoef='{polycoef}'/></equality>"
        ))
    };
    let (robot, _) = coupled("0.5 3 0 0 0");
    let robot = robot.unwrap();
    let mimic = robot.joints()[1].mimic.unwrap();
    // b - 2 = 0.5 + 3 (a - 1)
    assert_eq!((mimic.multiplier, mimic.offset), (3.0, -0.5));
    for polycoef in ["0 1 1 0 0", "1 0 0 0 0"] {
        let (robot, found) = coupled(polycoef);
        assert!(robot.unwrap().joints()[1].mimic.is_none());
        assert_eq!((found[0].code.name, found[0].stops), ("mjcf::coupling", Some(Capability::Physics)));
    }
}

#[test]
fn geoms_are_shapes_that_collide_or_are_drawn() {
    let (robot, found) = read(&format!(
        "<worldbody><geom type='plane' size='1 1 1'/><body name='b'>{MASS}<joint/>\
         <geom type='capsule' size='0.1 0.2' group='3'/><geom type='box' size='1 2 3' contype='0' conaffinity='0'/>\
         <geom type='ellipsoid' size='1 2 3' pos='0 0 4'/></body>\
         <body name='hill'><geom type='hfield' hfield='h'/></body></worldbody>\
         <asset><hfield name='h' nrow='2' ncol='2' size='1 1 1 1'/></asset>"
    ));
    let robot = robot.unwrap();
    let [world, body, hill] = robot.links() else { panic!("{:?}", link_names(&robot)) };
    assert_eq!((world.collisions.len(), body.collisions.len(), body.visuals.len()), (0, 4, 2));
    let ellipsoid = &body.collisions[3];
    assert_eq!(ellipsoid.geometry, Geometry::Ellipsoid { semi_axes_m: Vector3::new(1.0, 2.0, 3.0) });
    assert_eq!(ellipsoid.link_from_shape, Isometry3::translation(0.0, 0.0, 4.0));
    assert_eq!((hill.collisions.len(), found.len()), (0, 1), "{found:#?}");
    assert_eq!(found[0].stops, Some(Capability::Clearance), "{found:#?}");
}

#[test]
fn what_forces_leave_out_is_named_with_its_value() {
    let (_, found) = read(&format!(
        "<option gravity='0 0 -1.62'/><worldbody><body name='b' gravcomp='1'>{MASS}\
         <joint name='j' armature='0.1' stiffness='2' damping='3'/></body></worldbody>"
    ));
    let messages: Vec<&str> = found.iter().map(|found| found.message.as_str()).collect();
    assert!(messages.iter().any(|of| of.contains("spring of 2 N m/rad")), "{messages:#?}");
    // It is in the mass matrix.
    assert!(!messages.iter().any(|of| of.contains("armature")), "{messages:#?}");
    assert_eq!(found.iter().filter(|of| of.code.name == "mjcf::gravity").count(), 2, "{messages:#?}");
}
