//! The size of workspaces against closed forms: the stated interval contains them, with few samples and many.

#![expect(clippy::unwrap_used, reason = "helpers of tests panic")]

use std::{
    f64::consts::{PI, TAU},
    fmt::Write,
};

use congruent_description::{Robot, parse_urdf};
use congruent_kinematics::{Arm, Pose, Sampling, WorkspaceSize};
use nalgebra::Vector3;

/// A joint: its name in URDF, axis, range, and the place of its frame in the one before.
struct Moving {
    kind: &'static str,
    axis: &'static str,
    range: [f64; 2],
    xyz: [f64; 3],
}

fn turning(axis: &'static str, range: [f64; 2], xyz: [f64; 3]) -> Moving {
    Moving { kind: "revolute", axis, range, xyz }
}

fn sliding(axis: &'static str, range: [f64; 2]) -> Moving {
    Moving { kind: "prismatic", axis, range, xyz: [0.0; 3] }
}

const X: &str = "1 0 0";
const Y: &str = "0 1 0";
const Z: &str = "0 0 1";
const WHOLE: [f64; 2] = [-PI, PI];
const ORIGIN: [f64; 3] = [0.0; 3];

fn along_x(x: f64) -> [f64; 3] {
    [x, 0.0, 0.0]
}

fn robot(joints: &[Moving]) -> Robot {
    let mut urdf = "<robot name='arm'><link name='link_0'/>".to_owned();
    for (at, Moving { kind, axis, range: [lower, upper], xyz: [x, y, z] }) in joints.iter().enumerate() {
        let link = at + 1;
        write!(
            urdf,
            "<link name='link_{link}'/><joint name='joint_{link}' type='{kind}'>\
             <parent link='link_{at}'/><child link='link_{link}'/><origin xyz='{x} {y} {z}'/>\
             <axis xyz='{axis}'/><limit lower='{lower}' upper='{upper}' velocity='1' effort='1'/></joint>"
        )
        .unwrap();
    }
    parse_urdf(&(urdf + "</robot>")).unwrap()
}

fn size(joints: &[Moving], tool_x: f64, samples: usize, seed: u64) -> WorkspaceSize {
    let robot = robot(joints);
    let tip = robot.find_link(&format!("link_{}", joints.len())).unwrap();
    let tool = Pose { translation: Vector3::new(tool_x, 0.0, 0.0), ..Pose::identity() };
    let mut arm = Arm::new(&robot, robot.root(), tip, tool).unwrap();
    arm.workspace(Sampling { samples, seed }).size.expect("the tool moves in two directions or more")
}

/// The interval holds the exact size for each number of samples, and narrows to `last_share` of it.
#[track_caller]
fn holds(joints: &[Moving], tool_x: f64, exact: f64, last_share: f64) {
    let mut share = f64::INFINITY;
    for (samples, seeds) in [(100, 5), (1_000, 3), (20_000, 1)] {
        for seed in 0..seeds {
            let found = size(joints, tool_x, samples, seed);
            assert!(
                found.lower <= exact && exact <= found.upper,
                "{exact} is not within {found:?}, {samples} samples, seed {seed}"
            );
            assert!(found.lower <= found.estimate && found.estimate <= found.upper, "{found:?}");
            share = (found.upper - found.lower) / exact;
        }
    }
    assert!(share < last_share, "the interval is {share} of the size");
}

#[test]
fn two_links_in_a_plane() {
    let inner = (0.36_f64 + 0.16 - 0.48 * (PI / 6.0).cos()).sqrt();
    let elbow = 150_f64.to_radians();
    let ring = PI * (1.0 - inner * inner);
    let arm =
        |shoulder: [f64; 2], elbow: [f64; 2]| [turning(Z, shoulder, ORIGIN), turning(Z, elbow, along_x(0.6))];
    holds(&arm(WHOLE, [-elbow, elbow]), 0.4, ring, 0.02);
    // The elbow bends to one side only, and the shoulder by half a turn: a sector of the ring, which polar
    // coordinates make half of it.
    holds(&arm([0.0, PI], [0.0, elbow]), 0.4, ring / 2.0, 0.02);
    // The plane is vertical.
    let upright = [turning(Y, WHOLE, ORIGIN), turning(Y, [-elbow, elbow], along_x(0.6))];
    holds(&upright, 0.4, ring, 0.02);
}

#[test]
fn three_links_in_a_plane() {
    let links = |first, second| {
        [turning(Z, WHOLE, ORIGIN), turning(Z, WHOLE, along_x(first)), turning(Z, WHOLE, along_x(second))]
    };
    holds(&links(0.5, 0.4), 0.3, PI * 1.2 * 1.2, 0.02);
    // 0.9 m are more than the others together: a hole of 0.4 m.
    holds(&links(0.9, 0.3), 0.2, PI * (1.4_f64.powi(2) - 0.4_f64.powi(2)), 0.02);
}

#[test]
fn shells_and_cylinders() {
    let spherical =
        [turning(Z, WHOLE, ORIGIN), turning(Y, [-PI / 2.0, PI / 2.0], ORIGIN), sliding(X, [0.3, 0.8])];
    holds(&spherical, 0.0, 4.0 / 3.0 * PI * (0.512 - 0.027), 0.05);
    let part = [turning(Z, [-1.0, 1.0], ORIGIN), turning(Y, [0.0, 0.5], ORIGIN), sliding(X, [0.3, 0.8])];
    holds(&part, 0.0, 2.0 * 0.5_f64.sin() * (0.512 - 0.027) / 3.0, 0.1);
    let cylindrical = [turning(Z, WHOLE, ORIGIN), sliding(Z, [0.0, 0.6]), sliding(X, [0.1, 0.5])];
    holds(&cylindrical, 0.0, PI * (0.25 - 0.01) * 0.6, 0.05);
    let cartesian = [sliding(X, [0.0, 0.6]), sliding(Y, [-0.2, 0.3]), sliding(Z, [0.1, 0.5])];
    holds(&cartesian, 0.0, 0.6 * 0.5 * 0.4, 0.04);
    // Nearly flat: no more points than for any other arm.
    let flat = [sliding(X, [0.0, 0.6]), sliding(Y, [-0.2, 0.3]), sliding(Z, [0.0, 1e-9])];
    holds(&flat, 0.0, 0.6 * 0.5 * 1e-9, 0.04);
    assert!(size(&flat, 0.0, 1000, 0).points <= 1000);
}

/// Yaw, shoulder and elbow, as the arms of the examples: a shell, and a ring about the yaw axis if the
/// shoulder is off it (Pappus).
#[test]
fn articulated_arms() {
    let arm = |off: f64, yaw: [f64; 2]| {
        [turning(Z, yaw, ORIGIN), turning(Y, WHOLE, along_x(off)), turning(Y, WHOLE, along_x(0.4))]
    };
    let shell = |outer: f64, inner: f64| 4.0 / 3.0 * PI * (outer.powi(3) - inner.powi(3));
    holds(&arm(0.0, WHOLE), 0.25, shell(0.65, 0.15), 0.05);
    let ring = TAU * 0.8 * PI * (0.65_f64.powi(2) - 0.15_f64.powi(2));
    holds(&arm(0.8, WHOLE), 0.25, ring, 0.05);
    holds(&arm(0.8, [0.0, PI / 2.0]), 0.25, ring / 4.0, 0.08);
    // A spherical wrist with a tool of 0.1 m: six joints, and a shell that is thicker by it.
    let mut six = arm(0.0, WHOLE).into_iter().collect::<Vec<_>>();
    six.extend([turning(X, WHOLE, along_x(0.25)), turning(Y, WHOLE, ORIGIN), turning(Z, WHOLE, ORIGIN)]);
    holds(&six, 0.1, shell(0.75, 0.05), 0.05);
}

#[test]
fn a_surface_has_no_volume_and_a_curve_no_area() {
    let found = size(&[turning(Z, WHOLE, ORIGIN), turning(Y, [-1.0, 1.0], ORIGIN)], 0.5, 1000, 0);
    assert_eq!((found.lower, found.estimate, found.upper), (0.0, 0.0, 0.0));
    let found = size(&[turning(Z, WHOLE, ORIGIN)], 0.5, 1000, 0);
    assert_eq!((found.lower, found.estimate, found.upper), (0.0, 0.0, 0.0));
}
