//! The trait of sources of joint torques and accelerations: the equations of this crate, a physics engine, or another program.

use congruent_description::{Robot, RobotQ};
use nalgebra::{DMatrix, DVectorView, DVectorViewMut};

use crate::{
    body_tree::{BodyTree, JointMotionState},
    buffer::DynamicsBuffer,
    error::DynamicsError,
    forward::DrivenState,
};

/// A source of the dynamics of a robot.
///
/// Vectors have one entry for each moving joint. Mimic joints are independent, except in [`JointDynamics::forward_into`].
pub trait JointDynamics {
    /// Torques that hold the robot still against gravity.
    ///
    /// # Errors
    /// [`JointDynamicsError`] if the source refuses the configuration.
    fn gravity_into(&mut self, q: &RobotQ, tau: &mut [f64]) -> Result<(), JointDynamicsError>;

    /// The mass matrix, dof x dof.
    ///
    /// # Errors
    /// [`JointDynamicsError`] if the source refuses the configuration.
    fn mass_matrix_into(&mut self, q: &RobotQ, matrix: &mut DMatrix<f64>) -> Result<(), JointDynamicsError>;

    /// Accelerations under torques, each joint independent.
    ///
    /// # Errors
    /// [`JointDynamicsError`] if the source refuses the state.
    fn independent_forward_into(
        &mut self,
        state: &DrivenState<'_>,
        qdd: &mut [f64],
    ) -> Result<(), JointDynamicsError>;

    /// Accelerations under torques; mimic joints keep their ratio.
    ///
    /// # Errors
    /// [`JointDynamicsError`] if the source refuses the state.
    fn forward_into(&mut self, state: &DrivenState<'_>, qdd: &mut [f64]) -> Result<(), JointDynamicsError>;

    /// Torques of a motion. By default: gravity torques, plus the mass matrix times the difference between the wanted
    /// accelerations and those under the gravity torques.
    ///
    /// # Errors
    /// [`JointDynamicsError`] if the source refuses the state.
    fn inverse_into(
        &mut self,
        motion: &JointMotionState<'_>,
        tau: &mut [f64],
    ) -> Result<(), JointDynamicsError> {
        let n = motion.qdd.len();
        let (mut matrix, mut found) = (DMatrix::zeros(n, n), vec![0.0; n]);
        self.gravity_into(motion.q, tau)?;
        self.mass_matrix_into(motion.q, &mut matrix)?;
        let state = DrivenState { q: motion.q, qd: motion.qd, tau };
        self.independent_forward_into(&state, &mut found)?;
        // Forward dynamics is affine in the torque, with the inverse of the mass matrix: `tau = g + M (qdd -
        // qdd(g))`.
        for (found, wanted) in found.iter_mut().zip(motion.qdd) {
            *found = wanted - *found;
        }
        DVectorViewMut::from_slice(tau, n).gemv(1.0, &matrix, &DVectorView::from_slice(&found, n), 1.0);
        Ok(())
    }
}

/// Why a source cannot compute torques or accelerations.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum JointDynamicsError {
    /// An error of the equations of this crate.
    #[error(transparent)]
    Dynamics(#[from] DynamicsError),
    /// An error of a source outside this crate.
    #[error(transparent)]
    Source(Box<dyn std::error::Error + Send + Sync>),
}

impl JointDynamicsError {
    /// The error of a source outside this crate.
    pub fn source(error: impl std::error::Error + Send + Sync + 'static) -> Self {
        Self::Source(Box::new(error))
    }
}

/// The equations of this crate as a source.
#[derive(Debug, Clone)]
pub struct TreeDynamics {
    tree: BodyTree,
    independent: BodyTree,
    buffer: DynamicsBuffer,
}

impl TreeDynamics {
    /// The dynamics of a robot, with the damping and dry friction of its description.
    pub fn new(robot: &Robot) -> Self {
        let tree = BodyTree::new(robot);
        Self { buffer: tree.buffer(), independent: tree.clone().with_independent_mimics(), tree }
    }
}

impl JointDynamics for TreeDynamics {
    fn gravity_into(&mut self, q: &RobotQ, tau: &mut [f64]) -> Result<(), JointDynamicsError> {
        Ok(self.tree.gravity_into(q, &mut self.buffer, tau)?)
    }

    fn mass_matrix_into(&mut self, q: &RobotQ, matrix: &mut DMatrix<f64>) -> Result<(), JointDynamicsError> {
        Ok(self.tree.mass_matrix_into(q, &mut self.buffer, matrix)?)
    }

    fn independent_forward_into(
        &mut self,
        state: &DrivenState<'_>,
        qdd: &mut [f64],
    ) -> Result<(), JointDynamicsError> {
        Ok(self.independent.forward_into(state, &mut self.buffer, qdd)?)
    }

    fn forward_into(&mut self, state: &DrivenState<'_>, qdd: &mut [f64]) -> Result<(), JointDynamicsError> {
        Ok(self.tree.forward_into(state, &mut self.buffer, qdd)?)
    }

    fn inverse_into(
        &mut self,
        motion: &JointMotionState<'_>,
        tau: &mut [f64],
    ) -> Result<(), JointDynamicsError> {
        Ok(self.tree.inverse_into(motion, &mut self.buffer, tau)?)
    }
}
