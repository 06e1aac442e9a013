//! Laws that tie the algorithms to each other, on the project's own robots: no corpus is needed.

#[path = "../../../tests/support/corpus.rs"]
mod corpus;

use congruent_description::{Robot, RobotQ, load_robot};
use congruent_dynamics::{BodyTree, DrivenState, JointMotionState, JointMotions, JointResistance, Rollout};
use congruent_kinematics::{JacobianKind, UrdfTree, random_configurations};
use nalgebra::{DMatrix, DVector, Vector3};

/// Rounding relative to the largest torque of the robot; worst seen 6e-14.
const ROUNDING: f64 = 1e-12;

const ROBOTS: [&str; 7] =
    ["cylindrical_rpp", "panda", "planar_2r", "rrr_arm", "spatial_3r", "spherical_wrist", "ur5e"];

const SAMPLES: usize = 20;

fn load(name: &str) -> Robot {
    let path = corpus::workspace().join("robots").join(name);
    load_robot(&path).unwrap_or_else(|findings| panic!("{findings:#?}")).robot
}

/// Values between -1 and 1 that no law singles out.
fn values(count: usize, seed: usize) -> Vec<f64> {
    let number = |index: usize| f64::from(u32::try_from(index + 17 * seed + 1).expect("a small number"));
    (0..count).map(|index| (12.9898 * number(index)).sin()).collect()
}

/// Resistances of any size, so that no term is forgotten.
fn resisting(robot: &Robot) -> BodyTree {
    let tree = BodyTree::new(robot);
    let resistance = |joint: usize| {
        let values = values(3, joint + 5);
        let [damping, friction, armature] = [0, 1, 2].map(|index| 0.5 + 0.4 * values[index]);
        JointResistance { damping, friction, armature }
    };
    let resistances = (0..tree.dof()).map(resistance).collect();
    tree.with_resistances(resistances).expect("one for each joint")
}

/// A robot in several states, with a tree of it.
fn each_state(mut law: impl FnMut(&str, &Robot, &BodyTree, [&[f64]; 2], &RobotQ)) {
    for name in ROBOTS {
        let robot = load(name);
        let tree = resisting(&robot);
        for (sample, q) in random_configurations(&robot, 7, SAMPLES).iter().enumerate() {
            let (mut qd, mut qdd) = (values(tree.dof(), sample), values(tree.dof(), sample + 100));
            robot.apply_mimic_to_speeds(&mut qd);
            robot.apply_mimic_to_speeds(&mut qdd);
            law(name, &robot, &tree, [&qd, &qdd], q);
        }
    }
}

#[track_caller]
fn assert_near(name: &str, found: &[f64], expected: &[f64]) {
    let size = expected.iter().fold(1e-3_f64, |size, value| size.max(value.abs()));
    for (joint, (found, expected)) in found.iter().zip(expected).enumerate() {
        let error = (found - expected).abs() / size;
        assert!(error < ROUNDING, "{name} joint {joint}: {found} for {expected}, {error:e}");
    }
}

fn inverse(tree: &BodyTree, q: &RobotQ, [qd, qdd]: [&[f64]; 2]) -> Vec<f64> {
    let mut tau = vec![0.0; tree.dof()];
    let motion = JointMotionState { q, qd, qdd };
    tree.inverse_into(&motion, &mut tree.buffer(), &mut tau).expect("lengths agree");
    tau
}

#[test]
fn forward_undoes_inverse() {
    each_state(|name, _, tree, [qd, qdd], q| {
        let tau = inverse(tree, q, [qd, qdd]);
        let mut found = vec![0.0; tree.dof()];
        let state = DrivenState { q, qd, tau: &tau };
        tree.clone().with_independent_mimics().forward_into(&state, &mut tree.buffer(), &mut found).unwrap();
        assert_near(name, &found, qdd);
        // These accelerations keep the ratios, so that the coupled robot has the same.
        tree.forward_into(&state, &mut tree.buffer(), &mut found).unwrap();
        assert_near(name, &found, qdd);
    });
}

/// Full groups, the rest of a group, and none; no joint of the project's robots is left out.
#[test]
fn a_batch_is_its_motions_one_by_one() {
    for name in ROBOTS {
        let robot = load(name);
        let tree = resisting(&robot).with_gravity(Vector3::new(1.0, -2.0, -9.0));
        let n = tree.dof();
        let mut buffer = tree.batch_buffer();
        for count in [0, 1, 8, 19] {
            let q: Vec<f64> =
                random_configurations(&robot, 7, count).iter().flat_map(|q| q.to_vec()).collect();
            let (mut qd, qdd) = (values(n * count, 3), values(n * count, 4));
            qd.iter_mut().step_by(5).for_each(|qd| *qd = 0.0);
            let mut tau = vec![f64::NAN; n * count];
            let motions = JointMotions { q: &q, qd: &qd, qdd: &qdd };
            tree.inverse_many_into(&motions, &mut buffer, &mut tau).expect("lengths agree");
            for sample in 0..count {
                let of = |all: &[f64]| all[sample * n..][..n].to_vec();
                let alone = inverse(&tree, &RobotQ::from(of(&q)), [&of(&qd), &of(&qdd)]);
                assert_near(name, &of(&tau), &alone);
            }
        }
    }
    let tree = BodyTree::new(&load("ur5e"));
    let six = [0.0; 6];
    let refused = |q: &[f64], tau: &mut [f64]| {
        let motions = JointMotions { q, qd: &six, qdd: &six };
        tree.inverse_many_into(&motions, &mut tree.batch_buffer(), tau).is_err()
    };
    assert!(
        refused(&six[..5], &mut [0.0; 6]) && refused(&six, &mut [0.0; 7]) && refused(&six, &mut [0.0; 12])
    );
    let motions = JointMotions { q: &six, qd: &six, qdd: &six };
    let mut of_another = BodyTree::new(&load("panda")).batch_buffer();
    assert!(tree.inverse_many_into(&motions, &mut of_another, &mut [0.0; 6]).is_err());
}

#[test]
fn mass_matrix_and_bias_are_inverse_dynamics() {
    each_state(|name, _, tree, [qd, qdd], q| {
        let n = tree.dof();
        let (mut bias, mut matrix) = (vec![0.0; n], DMatrix::zeros(n, n));
        tree.bias_into(q, qd, &mut tree.buffer(), &mut bias).unwrap();
        tree.mass_matrix_into(q, &mut tree.buffer(), &mut matrix).unwrap();
        let mut sum = &matrix * DVector::from_column_slice(qdd) + DVector::from_vec(bias);
        for ((sum, resistance), qd) in sum.iter_mut().zip(tree.resistances()).zip(qd) {
            *sum += resistance.damping * qd + resistance.friction * qd.signum();
        }
        assert_near(name, sum.as_slice(), &inverse(tree, q, [qd, qdd]));
        let qd = DVector::from_column_slice(qd);
        let kinetic_j = tree.energy(q, qd.as_slice()).unwrap().kinetic_j;
        assert_near(name, &[(qd.transpose() * &matrix * &qd)[0] / 2.0], &[kinetic_j]);
    });
}

#[test]
fn torques_are_linear_in_the_parameters() {
    each_state(|name, _, tree, [qd, qdd], q| {
        let bare = tree.clone().without_resistances();
        let mut regressor = DMatrix::zeros(tree.dof(), 10 * tree.dof());
        let motion = JointMotionState { q, qd, qdd };
        bare.regressor_into(&motion, &mut bare.buffer(), &mut regressor).unwrap();
        let tau = regressor * bare.all_parameters();
        assert_near(name, tau.as_slice(), &inverse(&bare, q, [qd, qdd]));
    });
}

/// Shifting value between the parameters of a group changes no torque, and the group's value determines the torques.
#[test]
fn base_parameters_say_the_same_as_all_parameters() {
    for name in ROBOTS {
        let robot = load(name);
        let tree = BodyTree::new(&robot).without_resistances();
        let n = tree.dof();
        let positions = random_configurations(&robot, 3, 40);
        let speeds: Vec<[Vec<f64>; 2]> = (0..40).map(|at| [values(n, at), values(n, at + 300)]).collect();
        let motions: Vec<JointMotionState<'_>> =
            positions.iter().zip(&speeds).map(|(q, [qd, qdd])| JointMotionState { q, qd, qdd }).collect();
        let base = tree.base_parameters(&motions).unwrap();
        let stacked = tree.stacked_regressor(&motions).unwrap();
        let mut by_groups = DVector::zeros(stacked.nrows());
        for group in &base.groups {
            let column = 10 * group.parameter.joint + group.parameter.parameter;
            by_groups += stacked.column(column) * group.value;
        }
        assert_near(name, by_groups.as_slice(), (stacked * tree.all_parameters()).as_slice());
        assert!(!base.groups.is_empty() && base.groups.len() < 10 * n, "{name}");
    }
}

#[test]
fn gravity_is_the_slope_of_potential_energy() {
    /// Central differences of a function with second derivatives up to 100 J: error of step squared and of rounding.
    const STEP: f64 = 1e-5;
    each_state(|name, _, tree, _, q| {
        let mut gravity = vec![0.0; tree.dof()];
        let mut buffer = tree.buffer();
        tree.gravity_into(q, &mut buffer, &mut gravity).unwrap();
        let still = vec![0.0; tree.dof()];
        let size = gravity.iter().fold(1.0_f64, |size, value| size.max(value.abs()));
        for joint in 0..tree.dof() {
            let height = |by: f64| {
                let mut q = q.clone();
                q[joint] += by;
                tree.energy(&q, &still).unwrap().potential_j
            };
            let slope = (height(STEP) - height(-STEP)) / (2.0 * STEP);
            assert!((slope - gravity[joint]).abs() < 1e-8 * size, "{name}: {slope} for {}", gravity[joint]);
        }
    });
}

/// With constant torques and without friction, energy changes by the work of the torques alone.
#[test]
fn a_rollout_conserves_energy() {
    for name in ROBOTS {
        let robot = load(name);
        let tree = BodyTree::new(&robot).without_resistances();
        let torque: Vec<f64> = values(tree.dof(), 9);
        let start = random_configurations(&robot, 11, 1).remove(0);
        let mut rollout = Rollout::new(&tree, start.clone(), vec![0.0; tree.dof()]).unwrap();
        let total = |rollout: &Rollout<'_>| {
            let state = rollout.state();
            let energy = tree.energy(&state.q, &state.qd).unwrap();
            let work: f64 =
                (0..tree.dof()).map(|joint| torque[joint] * (state.q[joint] - start[joint])).sum();
            energy.kinetic_j + energy.potential_j - work
        };
        let before = total(&rollout);
        for _ in 0..2000 {
            rollout.step(1e-4, |_, _, _, tau| tau.copy_from_slice(&torque)).unwrap();
        }
        let lost_j = (total(&rollout) - before).abs();
        assert!(lost_j < 1e-8, "{name}: {lost_j:e} J");
        assert!((rollout.state().time_s - 0.2).abs() < 1e-12);
    }
}

/// Linear momentum is mass times the velocity of each link's centre of mass, by the kinematics' Jacobians.
#[test]
fn momentum_is_that_of_the_links() {
    each_state(|name, robot, tree, [qd, _], q| {
        let kinematics = UrdfTree::new(robot);
        let mut expected = Vector3::zeros();
        for link in robot.link_indices().filter(|&link| robot.body(link) != robot.root()) {
            let Some(inertia) = robot.link(link).inertia else { continue };
            let jacobian = kinematics.jacobian(q, link, JacobianKind::Geometric).unwrap();
            let velocity = jacobian.times(qd).unwrap();
            let root_from_link = kinematics.root_from_link(q, link).unwrap();
            let center = root_from_link.transform_vector(&inertia.link_from_inertial.translation.vector);
            expected += (velocity.linear + velocity.angular.cross(&center)) * inertia.mass_kg;
        }
        let found = tree.momentum_in_root(q, qd).unwrap().force;
        assert_near(name, found.as_slice(), expected.as_slice());
    });
}

#[test]
fn wrong_lengths_and_weightless_joints_are_refused() {
    let tree = BodyTree::new(&load("ur5e"));
    let (q, short) = (RobotQ::zeros(6), [0.0; 5]);
    let state = DrivenState { q: &q, qd: &short, tau: &[0.0; 6] };
    let refused = tree.forward_into(&state, &mut tree.buffer(), &mut [0.0; 6]).unwrap_err();
    assert_eq!(refused.to_string(), "speeds: 5 values for 6 moving joints");
    let weightless =
        tree.clone().with_inertias_in_links(&[congruent_dynamics::SpatialInertia::zero(); 6]).unwrap();
    let state = DrivenState { qd: &[0.0; 6], ..state };
    let refused = weightless.forward_into(&state, &mut tree.buffer(), &mut [0.0; 6]).unwrap_err();
    assert!(refused.to_string().contains("joint \"wrist_3_joint\" moves no inertia"), "{refused}");
}
