//! Analytical dynamics of robots: the source of torques that is computed from the description alone, independently of the
//! physics engine.
//!
//! | question | call |
//! |---|---|
//! | torques of a motion | [`BodyTree::inverse_into`], [`BodyTree::gravity_into`], [`BodyTree::bias_into`] |
//! | torques of many motions at once | [`BodyTree::inverse_many_into`] |
//! | mass matrix | [`BodyTree::mass_matrix_into`] |
//! | accelerations under torques | [`BodyTree::forward_into`] |
//! | energies, momentum | [`BodyTree::energy`], [`BodyTree::momentum_in_root`] |
//! | which parameters are identifiable | [`BodyTree::regressor_into`], [`BodyTree::base_parameters`] |
//! | motion under torques | [`Rollout`] |
//!
//! Units are SI and radians. Nothing here reads a file, a clock or a random number, and calls for one sample allocate nothing:
//! [`BodyTree::buffer`] allocates their memory once.

mod algebra;
mod body_tree;
mod buffer;
mod energy;
mod error;
mod forward;
mod inverse;
mod inverse_batch;
mod joint_dynamics;
mod mass_matrix;
mod parameters;
mod rollout;
mod spatial_inertia;

pub use body_tree::{BodyTree, GRAVITY_M_S2, JointMotionState};
pub use buffer::DynamicsBuffer;
pub use congruent_description::JointResistance;
pub use energy::Energy;
pub use error::DynamicsError;
pub use forward::DrivenState;
pub use inverse_batch::{BatchBuffer, JointMotions};
pub use joint_dynamics::{JointDynamics, JointDynamicsError, TreeDynamics};
pub use parameters::{BaseParameter, BaseParameters, InertialParameter};
pub use rollout::{Rollout, RolloutState};
pub use spatial_inertia::{PARAMETER_NAMES, PARAMETERS, SpatialInertia};
