//! Motion under torques, integrated by the classical Runge-Kutta method.

use congruent_description::RobotQ;

use crate::{body_tree::BodyTree, buffer::DynamicsBuffer, error::DynamicsError, forward::DrivenState};

/// Positions and speeds of all moving joints at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct RolloutState {
    /// Time since the start of the rollout, s.
    pub time_s: f64,
    /// Positions of all moving joints, rad or m.
    pub q: RobotQ,
    /// Speeds of all moving joints, rad/s or m/s.
    pub qd: Vec<f64>,
}

/// A robot in motion: one state that steps advance without allocation.
#[derive(Debug, Clone)]
pub struct Rollout<'a> {
    tree: &'a BodyTree,
    state: RolloutState,
    buffer: DynamicsBuffer,
    stage_q: RobotQ,
    stage_qd: Vec<f64>,
    tau: Vec<f64>,
    accelerations: [Vec<f64>; 4],
    speeds: [Vec<f64>; 4],
}

/// Each stage of a step: its time as a share of the step, and its weight in the final sum.
const STAGES: [(f64, f64); 4] = [(0.0, 1.0 / 6.0), (0.5, 1.0 / 3.0), (0.5, 1.0 / 3.0), (1.0, 1.0 / 6.0)];

impl<'a> Rollout<'a> {
    /// Starts from a state; positions and speeds of mimic joints have to follow their masters.
    ///
    /// # Errors
    /// [`DynamicsError::Length`] if a vector is another robot's.
    pub fn new(tree: &'a BodyTree, q: RobotQ, qd: Vec<f64>) -> Result<Self, DynamicsError> {
        let n = tree.dof();
        DynamicsError::check("positions", n, &q)?;
        DynamicsError::check("speeds", n, &qd)?;
        let vectors = || std::array::from_fn(|_| vec![0.0; n]);
        Ok(Self {
            tree,
            state: RolloutState { time_s: 0.0, q, qd },
            buffer: tree.buffer(),
            stage_q: RobotQ::zeros(n),
            stage_qd: vec![0.0; n],
            tau: vec![0.0; n],
            accelerations: vectors(),
            speeds: vectors(),
        })
    }

    /// The state after the last step.
    pub fn state(&self) -> &RolloutState {
        &self.state
    }

    /// One step under torques: `torque(time_s, q, qd, tau)` writes them into `tau`.
    ///
    /// Source: Hairer, Norsett, Wanner, *Solving Ordinary Differential Equations I* (1993), table 1.2; error of a
    /// step `O(step^5)`.
    ///
    /// # Errors
    /// [`DynamicsError::NoInertia`] if a joint carries nothing that resists its acceleration.
    pub fn step(
        &mut self,
        step_s: f64,
        mut torque: impl FnMut(f64, &RobotQ, &[f64], &mut [f64]),
    ) -> Result<(), DynamicsError> {
        for (stage, (share, _)) in STAGES.into_iter().enumerate() {
            for joint in 0..self.tree.dof() {
                // The first stage is the state itself; each later one starts from the stage before.
                let before = stage.saturating_sub(1);
                let by = share * step_s;
                self.stage_q[joint] = self.state.q[joint] + by * self.speeds[before][joint];
                self.stage_qd[joint] = self.state.qd[joint] + by * self.accelerations[before][joint];
            }
            torque(self.state.time_s + share * step_s, &self.stage_q, &self.stage_qd, &mut self.tau);
            let driven = DrivenState { q: &self.stage_q, qd: &self.stage_qd, tau: &self.tau };
            self.tree.forward_into(&driven, &mut self.buffer, &mut self.accelerations[stage])?;
            self.speeds[stage].copy_from_slice(&self.stage_qd);
        }
        for (stage, (_, weight)) in STAGES.into_iter().enumerate() {
            for joint in 0..self.tree.dof() {
                self.state.q[joint] += weight * step_s * self.speeds[stage][joint];
                self.state.qd[joint] += weight * step_s * self.accelerations[stage][joint];
            }
        }
        self.state.time_s += step_s;
        Ok(())
    }
}
