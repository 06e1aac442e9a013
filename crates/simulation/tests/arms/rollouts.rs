//! Motions without a servo: free swings, pendulums, and joints that mimic another.

use congruent_description::{JointKind, Robot, RobotQ};
use congruent_dynamics::{BodyTree, Rollout};
use congruent_simulation::{World, WorldSettings};
use nalgebra::{DVector, Isometry3, Vector3};

use crate::{
    ARMS, free, q0,
    support::{at, make, rebuilt, run, steps, with_step, worst},
};

/// Kinetic and potential energy, J; the potential from the poses of links and their masses.
fn energy_j(robot: &Robot, world: &World) -> f64 {
    let mut root_from_links = vec![Isometry3::identity(); robot.links().len()];
    world.root_from_links_into(&mut root_from_links);
    let weights = robot.links().iter().zip(&root_from_links).filter_map(|(link, root_from_link)| {
        let inertia = link.inertia?;
        let height_m = (root_from_link * inertia.link_from_inertial).translation.vector.z;
        Some(inertia.mass_kg * 9.81 * height_m)
    });
    let qd = DVector::from_row_slice(world.qd());
    weights.sum::<f64>() + 0.5 * qd.dot(&(world.mass_matrix() * &qd))
}

/// Ratio of the errors at h and h/2, physics (first order): 2 + O(h).
const FIRST_ORDER: std::ops::Range<f64> = 1.9..2.1;
/// Steps of the rollouts, s.
const STEPS_S: [f64; 3] = [5e-4, 2.5e-4, 1.25e-4];
/// For how long a free swing is of first order, s. The UR5e's for the 1 s of the table; the Panda's motion is chaotic
/// from 0.45 s on, with its light wrist at 38 rad/s: after 1 s, 9.5, 6.5 and 8.1 rad are between it and the truth at
/// these three steps, after 0.4 s 0.025, 0.013 and 0.0064 rad.
const SWINGS_S: [(&str, f64); 2] = [("ur5e", 1.0), ("panda", 0.4)];

#[track_caller]
fn assert_first_order(name: &str, errors: [f64; 3]) {
    for pair in errors.windows(2) {
        assert!(FIRST_ORDER.contains(&(pair[0] / pair[1])), "{name}: {errors:?}");
    }
}

/// Released at rest: the largest error after a time, rad or m, against the Runge-Kutta method of the crate `dynamics`
/// with the same step, which shares nothing with the engine; its own error is 1e-9 of that.
fn swing_error(robot: &Robot, q0: &RobotQ, (duration_s, step_s): (f64, f64)) -> f64 {
    let tree = BodyTree::new(robot);
    let mut truth = Rollout::new(&tree, q0.clone(), vec![0.0; q0.len()]).expect("a state");
    for _ in 0..steps(duration_s, step_s) {
        truth.step(step_s, |_, _, _, torque| torque.fill(0.0)).expect("it has inertia");
    }
    let mut world = at(robot, &with_step(step_s), q0);
    run(&mut world, make("passive", 0.0, 0.0).as_mut(), q0, steps(duration_s, step_s));
    worst(world.q(), &truth.state().q)
}

/// A robot without limits and resistances, and where it is released.
fn released(name: &str) -> (Robot, RobotQ) {
    let robot = free(name);
    let mut q0 = q0(&robot);
    robot.apply_mimic(&mut q0);
    (robot, q0)
}

#[test]
fn a05_free_swing_error_halves_with_the_step() {
    for (name, duration_s) in SWINGS_S {
        let (robot, q0) = released(name);
        let errors = STEPS_S.map(|step_s| swing_error(&robot, &q0, (duration_s, step_s)));
        println!("a05 {name}: {errors:?} rad");
        assert_first_order(name, errors);
    }
}

/// Energy that a swing has gained after a time, J.
fn gained_j(robot: &Robot, q0: &RobotQ, (duration_s, step_s): (f64, f64)) -> f64 {
    let mut world = at(robot, &with_step(step_s), q0);
    let before_j = energy_j(robot, &world);
    run(&mut world, make("passive", 0.0, 0.0).as_mut(), q0, steps(duration_s, step_s));
    energy_j(robot, &world) - before_j
}

/// Of the same swings: what is lost is proportional to the step as long as the motion is not chaotic, and after 1 s
/// energy is lost in both, at 1 ms too. It is not so at every instant: at 1 ms the UR5e has 0.209 J more than at the start
/// after 0.5 s (0.103 J at half the step) and 0.606 J less after 1 s.
#[test]
fn a05b_a_free_swing_loses_energy_in_proportion_to_the_step() {
    for (name, duration_s) in SWINGS_S {
        let (robot, q0) = released(name);
        let gained = STEPS_S.map(|step_s| gained_j(&robot, &q0, (duration_s, step_s)));
        println!("a05b {name}: {gained:?} J after {duration_s} s");
        assert_first_order(name, gained);
        let gained = [1e-3, 5e-4, 2.5e-4, 1.25e-4].map(|step_s| gained_j(&robot, &q0, (1.0, step_s)));
        println!("a05b {name}: {gained:?} J after 1 s");
        assert!(gained.iter().all(|&gained_j| gained_j < 0.0), "{name}: {gained:?} J");
    }
}

/// An arm whose second joint alone can turn, about a horizontal axis: a pendulum of known period.
struct ArmPendulum {
    robot: Robot,
    /// The position in which it hangs, rad.
    hangs: f64,
    /// Gravity torque per sine of the angle, by inertia about the axis, 1/s^2.
    gravity_by_inertia: f64,
    inertia_kg_m2: f64,
}

impl ArmPendulum {
    fn new(name: &str) -> Self {
        let free = free(name);
        let hinge = free.joint(free.movable_joints()[1]).name.clone();
        let robot = rebuilt(&free, |parts| {
            if parts.joint.name != hinge {
                parts.joint.kind = JointKind::Fixed;
            }
        });
        let world = at(&robot, &WorldSettings::default(), &RobotQ::zeros(1));
        let mut root_from_links = vec![Isometry3::identity(); robot.links().len()];
        world.root_from_links_into(&mut root_from_links);
        let joint = robot.joint(robot.movable_joints()[0]);
        let root_from_hinge = root_from_links[joint.child.get()];
        let axis = root_from_hinge.rotation * joint.axis_in_joint;
        assert!(axis.z.abs() < 1e-9, "{name}: the axis is horizontal");
        let (mut moment_kg_m, mut inertia_kg_m2) = (Vector3::zeros(), 0.0);
        for (link, root_from_link) in robot.links().iter().zip(&root_from_links) {
            let link = robot.find_link(&link.name).expect("a link of it");
            let moves = robot.chain(robot.root(), link).expect("below").contains(&robot.movable_joints()[0]);
            let Some(inertia) = robot.link(link).inertia.filter(|_| moves) else { continue };
            let com = root_from_link * inertia.link_from_inertial;
            let arm = com.translation.vector - root_from_hinge.translation.vector;
            let arm = arm - axis.into_inner() * axis.dot(&arm);
            let own_axis = com.rotation.inverse() * axis;
            moment_kg_m += inertia.mass_kg * arm;
            inertia_kg_m2 += inertia.mass_kg * arm.norm_squared()
                + own_axis.dot(&(inertia.tensor_kg_m2 * own_axis.into_inner()));
        }
        let down = -Vector3::z();
        let angle = moment_kg_m.dot(&axis.cross(&down)).atan2(moment_kg_m.dot(&down));
        let gravity_by_inertia = 9.81 * moment_kg_m.norm() / inertia_kg_m2;
        Self { robot, hangs: -angle, gravity_by_inertia, inertia_kg_m2 }
    }

    /// Angles from the hanging position every 10 ms, released at 0.3 rad; Runge-Kutta of fourth order with 0.1 ms.
    fn truth_rad(&self, samples: usize) -> Vec<f64> {
        let h = 1e-4;
        let rate = |[q, v]: [f64; 2]| [v, -self.gravity_by_inertia * q.sin()];
        let add = |[a, b]: [f64; 2], [c, d]: [f64; 2], h: f64| [a + h * c, b + h * d];
        let mut x = [0.3, 0.0];
        let sample = |_| {
            for _ in 0..100 {
                let k1 = rate(x);
                let k2 = rate(add(x, k1, h / 2.0));
                let k3 = rate(add(x, k2, h / 2.0));
                let k4 = rate(add(x, k3, h));
                x = add(add(add(add(x, k1, h / 6.0), k2, h / 3.0), k3, h / 3.0), k4, h / 6.0);
            }
            x[0]
        };
        (0..samples).map(sample).collect()
    }

    /// Largest error of the angle, rad, and largest changes of energy in the first and the last 2 s, J.
    fn errors(&self, truth_rad: &[f64], step_s: f64) -> (f64, [f64; 2]) {
        let q0 = RobotQ::from([self.hangs + 0.3]);
        let mut world = at(&self.robot, &with_step(step_s), &q0);
        let mut passive = make("passive", 0.0, 0.0);
        let energy =
            |q: f64, qd: f64| self.inertia_kg_m2 * (0.5 * qd * qd - self.gravity_by_inertia * q.cos());
        let (mut error, mut changes_j) = (0.0_f64, Vec::new());
        for truth_rad in truth_rad {
            run(&mut world, passive.as_mut(), &q0, steps(0.01, step_s));
            let angle = world.q()[0] - self.hangs;
            error = error.max((angle - truth_rad).abs());
            changes_j.push((energy(angle, world.qd()[0]) - energy(0.3, 0.0)).abs());
        }
        let largest = |changes_j: &[f64]| changes_j.iter().copied().fold(0.0, f64::max);
        (error, [largest(&changes_j[..200]), largest(&changes_j[changes_j.len() - 200..])])
    }
}

/// Growth of the largest change of energy from the first 2 s to the last of 10 s; physics, bounded if the scheme is
/// symplectic: explicit Euler at 1 ms gains several times as much; worst seen 1.000.
const ENERGY_GROWTH: f64 = 1.1;

/// A whole arm is no pendulum, and two joints of it are chaotic: all but the second are locked here. Measured at 1 ms:
/// 6.0e-4 rad and 5.2e-3 J (UR5e), 6.4e-4 rad and 4.8e-3 J (Panda).
#[test]
fn a06_an_arm_as_a_pendulum_for_10_s() {
    for name in ARMS {
        let pendulum = ArmPendulum::new(name);
        let truth_rad = pendulum.truth_rad(1000);
        let runs = [1e-3, 5e-4, 2.5e-4].map(|step_s| pendulum.errors(&truth_rad, step_s));
        println!("a06 {name}: {runs:?} rad, J");
        assert_first_order(name, runs.map(|(error, _)| error));
        assert_first_order(name, runs.map(|(_, [first_j, _])| first_j));
        for (_, [first_j, last_j]) in runs {
            assert!(last_j < ENERGY_GROWTH * first_j, "{name}: {runs:?}");
        }
    }
}
