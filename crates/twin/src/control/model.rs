//! The declared dynamics as a controller uses them: torques of the actuators, which mimic joints do not have.

use congruent_description::{Robot, RobotQ};
use congruent_dynamics::JointMotionState;
use congruent_monitors::{RunDynamics, SameInput};
use congruent_simulation::JointsView;

use crate::setup::RunSetup;

/// A mimic joint, in coordinates.
#[derive(Debug, Clone, Copy)]
struct MimicFollower {
    coordinate: usize,
    master: usize,
    ratio: f64,
}

/// The declared robot with memory for torques.
#[derive(Debug, Clone)]
pub(super) struct DeclaredModel<'a> {
    dynamics: RunDynamics<'a>,
    followers: Vec<MimicFollower>,
    /// Torques of the actuators, of the last motion or against gravity.
    torque: Vec<f64>,
    /// The positions of the latter.
    held: SameInput,
}

impl<'a> DeclaredModel<'a> {
    pub(super) fn new(setup: &'a RunSetup) -> Self {
        let robot = &setup.description.robot;
        Self {
            dynamics: setup.known_dynamics(),
            followers: followers(robot),
            torque: vec![0.0; robot.dof()],
            held: SameInput::default(),
        }
    }

    /// Adds the torques that hold the robot against gravity.
    pub(super) fn add_gravity(&mut self, time_s: f64, q: &RobotQ, torque: &mut [f64]) {
        // The declared tree of this instant: payloads come and go.
        if !self.held.repeats(self.dynamics.revision_at(time_s), [q]) {
            let (tree, buffer) = self.dynamics.at(time_s);
            tree.gravity_into(q, buffer, &mut self.torque).expect("a state of this robot");
            self.shift_to_masters();
        }
        self.add_to(torque);
    }

    /// Adds the torques of a motion. The accelerations of mimic joints are replaced by those that they follow with.
    pub(super) fn add_inverse(&mut self, joints: &JointsView<'_>, qdd: &mut [f64], torque: &mut [f64]) {
        // Followers have no gains, so their own entries lack the feedback of their masters.
        for follower in &self.followers {
            qdd[follower.coordinate] = follower.ratio * qdd[follower.master];
        }
        let (tree, buffer) = self.dynamics.at(joints.time_s());
        let motion = JointMotionState { q: joints.q(), qd: joints.qd(), qdd };
        tree.inverse_into(&motion, buffer, &mut self.torque).expect("a state of this robot");
        self.held.forget();
        self.shift_to_masters();
        self.add_to(torque);
    }

    /// The master of a mimic joint exerts its torque as well.
    fn shift_to_masters(&mut self) {
        for follower in &self.followers {
            // By virtual work: the master's torque does the follower's work, `ratio` times its speed. A follower has
            // no actuator, so its entry becomes zero.
            let own = std::mem::take(&mut self.torque[follower.coordinate]);
            self.torque[follower.master] += follower.ratio * own;
        }
    }

    fn add_to(&self, torque: &mut [f64]) {
        for (torque, added) in torque.iter_mut().zip(&self.torque) {
            *torque += added;
        }
    }
}

fn followers(robot: &Robot) -> Vec<MimicFollower> {
    let joints = robot.movable_joints().iter().map(|&joint| robot.joint(joint)).enumerate();
    let follower = |(coordinate, joint): (usize, &congruent_description::Joint)| {
        let mimic = joint.mimic?;
        Some(MimicFollower { coordinate, master: robot.coordinate(mimic.master)?, ratio: mimic.multiplier })
    };
    joints.filter_map(follower).collect()
}
