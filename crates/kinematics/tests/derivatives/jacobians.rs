//! Jacobians, their derivatives by each coordinate and in time, and the acceleration.

use std::ops::Deref;

use congruent_description::{LinkIndex, Robot, RobotQ};
use congruent_kinematics::{Jacobian, JacobianKind, KinematicsError, SerialChain, Twist, UrdfTree};
use num_dual::{Dual, Dual64};
use proptest::prelude::*;

use crate::{
    apart,
    duals::{Second, inverse, root_from_link, velocity_and_change},
    numbers, robots,
    support::{self, within},
};

/// Rounding, ours and the dual numbers', of chains of up to fifteen joints within 10 m; of second
/// derivatives and of speeds of up to 3 rad/s and 3 m/s for each joint; worst seen 1.4e-13.
const ROUNDING: f64 = 1e-12;

const KINDS: [JacobianKind; 3] = [JacobianKind::Space, JacobianKind::Body, JacobianKind::Geometric];

/// `q` and `qd` at one instant, and how both change from there.
fn moving(q: f64, qd: f64, (q_rate, qd_rate): (f64, f64)) -> Second {
    Dual::new(Dual64::new(q, q_rate), Dual64::new(qd, qd_rate))
}

fn unit(at: usize, coordinate: usize) -> f64 {
    if at == coordinate { 1.0 } else { 0.0 }
}

/// A motion of a chain: positions, speeds, accelerations.
struct State<'a, Q> {
    q: &'a Q,
    qd: &'a [f64],
    qdd: &'a [f64],
}

impl<Q: Deref<Target = [f64]>> State<'_, Q> {
    /// The pose along one coordinate, changing along a direction.
    fn column(&self, coordinate: usize, direction: impl Fn(usize) -> f64) -> Vec<Second> {
        let number = |(at, &q): (usize, &f64)| moving(q, unit(at, coordinate), (direction(at), 0.0));
        self.q.iter().enumerate().map(number).collect()
    }

    /// The pose along the motion itself.
    fn motion(&self) -> Vec<Second> {
        let number = |at: usize| moving(self.q[at], self.qd[at], (self.qd[at], self.qdd[at]));
        (0..self.q.len()).map(number).collect()
    }

    /// Holds a Jacobian and everything that follows from it against a pose on dual numbers.
    #[track_caller]
    fn hold(&self, jacobian: &Jacobian, pose: impl Fn(&[Second]) -> crate::duals::DualPose<Second>) {
        let kind = jacobian.kind();
        let near = |found: &Twist, expected: &Twist| {
            assert!(within(apart(found, expected), ROUNDING), "{kind:?}: {found:?} {expected:?}");
        };
        let rate = jacobian.rate(self.qd).unwrap();
        for coordinate in 0..self.q.len() {
            let numbers = self.column(coordinate, |at| self.qd[at]);
            let (column, in_time) = velocity_and_change(kind, &pose(&numbers));
            near(&jacobian.columns()[coordinate], &column);
            near(&rate.columns()[coordinate], &in_time);
            for by in 0..self.q.len() {
                let numbers = self.column(coordinate, |at| unit(at, by));
                let (_, change) = velocity_and_change(kind, &pose(&numbers));
                near(&jacobian.derivative(by).unwrap().columns()[coordinate], &change);
            }
        }
        let (velocity, acceleration) = velocity_and_change(kind, &pose(&self.motion()));
        near(&jacobian.times(self.qd).unwrap(), &velocity);
        near(&jacobian.acceleration(self.qd, self.qdd).unwrap(), &acceleration);
    }
}

/// Every link of a tree, by every kind.
fn hold_tree(robot: &Robot, links: impl Iterator<Item = LinkIndex>, state: &State<'_, RobotQ>) {
    let tree = UrdfTree::new(robot);
    for link in links {
        for kind in KINDS {
            let jacobian = tree.jacobian(state.q, link, kind).unwrap();
            state.hold(&jacobian, |q| root_from_link(robot, link, q));
        }
    }
}

#[test]
fn case_12_jacobians_of_real_robots_and_their_derivatives() {
    for (seed, description) in (0..).zip(robots()) {
        let robot = &description.robot;
        let [q, qd, qdd] = [0, 100, 200].map(|group| numbers(robot.dof(), group + seed));
        // One link of each moving body: the others only stand elsewhere in it.
        let moved = robot.movable_joints().iter().map(|&joint| robot.joint(joint).child);
        let links = moved.chain([description.tip]);
        hold_tree(robot, links, &State { q: &q.into(), qd: &qd, qdd: &qdd });
    }
}

proptest! {
    #![proptest_config(support::cases())]

    #[test]
    fn jacobians_of_trees_and_their_derivatives(
        joints in support::tree(),
        q in support::positions(), qd in support::positions(), qdd in support::positions(),
    ) {
        let robot = support::robot(joints);
        let n = robot.dof();
        let state = State { q: &q.of_robot(&robot), qd: qd.of_joints(n), qdd: qdd.of_joints(n) };
        hold_tree(&robot, robot.link_indices(), &state);
    }

    #[test]
    fn jacobians_between_any_two_links_and_their_derivatives(
        joints in support::tree(), ends in any::<[prop::sample::Index; 2]>(),
        q in support::positions(), qd in support::positions(), qdd in support::positions(),
    ) {
        let robot = support::robot(joints);
        let links: Vec<LinkIndex> = robot.link_indices().collect();
        let [base, tip] = ends.map(|end| links[end.index(links.len())]);
        let chain = SerialChain::from_urdf(&robot, base, tip);
        let n = chain.joint_count();
        let state = State { q: &q.of_chain(n), qd: qd.of_joints(n), qdd: qdd.of_joints(n) };
        for kind in KINDS {
            let mut columns = vec![Twist::zero(); n];
            chain.pose_and_jacobian_into(state.q, kind, &mut columns).unwrap();
            state.hold(&Jacobian::from_columns(kind, columns), |of_chain| {
                let mut q = vec![Second::from_re(Dual64::from_re(0.0)); robot.dof()];
                for (&coordinate, &position) in chain.coordinates().iter().zip(of_chain) {
                    q[coordinate] = position;
                }
                inverse(&root_from_link(&robot, base, &q)) * root_from_link(&robot, tip, &q)
            });
        }
    }
}

#[test]
fn wrong_lengths_are_refused() {
    let jacobian = Jacobian::from_columns(JacobianKind::Space, vec![Twist::zero(); 2]);
    let joints = KinematicsError::JointCount { expected: 2, found: 1 };
    assert_eq!(jacobian.rate(&[0.0]).unwrap_err(), joints);
    assert_eq!(jacobian.acceleration(&[0.0], &[0.0; 2]).unwrap_err(), joints);
    assert_eq!(jacobian.acceleration(&[0.0; 2], &[0.0]).unwrap_err(), joints);
    assert_eq!(jacobian.derivative(2), Err(KinematicsError::ColumnIndex { index: 2, count: 2 }));
    let room = &mut [Twist::zero()];
    let columns = Err(KinematicsError::ColumnCount { expected: 2, found: 1 });
    assert_eq!(jacobian.kind().rate_into(jacobian.columns(), &[0.0; 2], room), columns);
    assert_eq!(jacobian.kind().derivative_into(jacobian.columns(), 0, room), columns);
}
