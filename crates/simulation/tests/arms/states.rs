//! One state at a time, against the crates `kinematics` and `dynamics`, which share nothing with the engine (`gates.rs` has
//! the same against numbers from other programs).

use congruent_description::{Robot, RobotQ};
use congruent_dynamics::{BodyTree, DrivenState};
use congruent_kinematics::{Pose, PoseError, UrdfTree};
use congruent_simulation::{Torque, World, WorldSettings};
use nalgebra::{DMatrix, DVector, Isometry3};

use crate::{
    ARMS, free, q0,
    support::{at, rebuilt, run, with_step, worst},
};

/// Without limits and resistances, all joints independent, at the state of the table and with speeds.
fn independent(name: &str) -> (Robot, RobotQ, Vec<f64>) {
    let robot = rebuilt(&free(name), |_| {});
    let q0 = q0(&robot);
    let qd = q0.iter().map(|q| 0.5 - q).collect();
    (robot, q0, qd)
}

/// Largest position, m, and angle, rad; rounding of ten products.
const POSE: f64 = 1e-12;

#[test]
fn a01_link_poses() {
    for name in ARMS {
        let (robot, q0, _) = independent(name);
        let world = at(&robot, &WorldSettings::default(), &q0);
        let mut twin = vec![Isometry3::identity(); robot.links().len()];
        world.root_from_links_into(&mut twin);
        let mut analysis = vec![Pose::identity(); twin.len()];
        UrdfTree::new(&robot).root_from_links_into(&q0, &mut analysis).unwrap();
        let errors = analysis.iter().zip(&twin).map(|(pose, twin)| PoseError::to_isometry(pose, twin));
        let off = errors.fold(0.0_f64, |off, error| off.max(error.position_m).max(error.orientation_rad));
        println!("a01 {name}: {off:e}");
        assert!(off < POSE, "{name}: {off:e}");
    }
}

/// Part of the largest entry; rounding.
const RELATIVE: f64 = 1e-11;

#[test]
fn a02_mass_matrix_and_a03_gravity_torque() {
    for name in ARMS {
        let (robot, q0, qd) = independent(name);
        let mut world = World::new(&robot, &WorldSettings::default()).unwrap();
        world.set_state(&q0, &qd).unwrap();
        let tree = BodyTree::new(&robot);
        let (mut matrix, mut gravity) = (DMatrix::zeros(tree.dof(), tree.dof()), vec![0.0; tree.dof()]);
        tree.mass_matrix_into(&q0, &mut tree.buffer(), &mut matrix).unwrap();
        tree.gravity_into(&q0, &mut tree.buffer(), &mut gravity).unwrap();
        let mass = (world.mass_matrix() - &matrix).amax() / matrix.amax();
        let largest = gravity.iter().fold(0.0_f64, |largest, torque| largest.max(torque.abs()));
        let torque = worst(world.gravity_torque().as_slice(), &gravity) / largest;
        println!("a02 {name}: {mass:e}, a03: {torque:e} of {largest} N m");
        assert!(mass < RELATIVE && torque < RELATIVE, "{name}: {mass:e}, {torque:e}");
    }
}

/// Of the largest acceleration, at a step of 1 us; truncation, first order in the step.
const ACCELERATION: f64 = 1e-5;

#[test]
fn a04_one_step_acceleration_with_speeds_and_torques() {
    for name in ARMS {
        let (robot, q0, qd) = independent(name);
        let tree = BodyTree::new(&robot);
        let tau: Vec<f64> =
            (0..tree.dof()).map(|joint| if joint < 6 { 3.0 - q0[joint] } else { 0.1 }).collect();
        let mut expected = vec![0.0; tree.dof()];
        let state = DrivenState { q: &q0, qd: &qd, tau: &tau };
        tree.forward_into(&state, &mut tree.buffer(), &mut expected).unwrap();
        let expected = DVector::from_vec(expected);
        let off = [1e-6, 5e-7].map(|step_s| {
            let mut world = World::new(&robot, &with_step(step_s)).unwrap();
            world.set_state(&q0, &qd).unwrap();
            run(&mut world, &mut Torque(tau.clone()), &q0, 1);
            let gained = DVector::from_row_slice(world.qd()) - DVector::from_row_slice(&qd);
            (gained / step_s - &expected).amax() / expected.amax()
        });
        println!("a04 {name}: {off:?} of {}", expected.amax());
        assert!(off[0] < ACCELERATION, "{name}: {off:?}");
        assert!((1.8..2.2).contains(&(off[0] / off[1])), "{name}: first order, {off:?}");
    }
}
