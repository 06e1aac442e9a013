//! Memory of the algorithms, made once and used for every sample.

use congruent_kinematics::{Pose, SinCos, Twist, Wrench};
use nalgebra::{DMatrix, DVector};

use crate::{
    body_tree::{BodyTree, JointMotion},
    error::DynamicsError,
    spatial_inertia::{ArticulatedInertia, SpatialInertia},
};

/// Intermediate values of one robot's algorithms: [`BodyTree::buffer`] makes it, and no call allocates after that.
#[derive(Debug, Clone)]
pub struct DynamicsBuffer {
    pub(crate) angles_rad: Vec<f64>,
    pub(crate) turns: Vec<SinCos>,
    pub(crate) parent_from_bodies: Vec<Pose>,
    /// Angular velocity, and angular and linear acceleration, of each body in its own frame.
    pub(crate) motions: Vec<BodyMotion>,
    pub(crate) wrenches: Vec<Wrench>,
    pub(crate) composites: Vec<SpatialInertia>,
    pub(crate) articulated: Vec<ArticulatedInertia>,
    pub(crate) releases: Vec<Release>,
    pub(crate) zeros: Vec<f64>,
    pub(crate) bias: Vec<f64>,
    pub(crate) mass_matrix: DMatrix<f64>,
    pub(crate) independent: Vec<usize>,
    pub(crate) reduced_mass_matrix: DMatrix<f64>,
    pub(crate) reduced: DVector<f64>,
}

/// How a body moves, in its own frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BodyMotion {
    /// Angular velocity, and linear velocity of the frame's origin.
    pub(crate) velocity: Twist,
    /// Angular acceleration, and acceleration of the point at the frame's origin.
    pub(crate) acceleration: Twist,
}

impl BodyMotion {
    pub(crate) fn zero() -> Self {
        Self { velocity: Twist::zero(), acceleration: Twist::zero() }
    }
}

/// How an articulated body yields at its joint.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Release {
    /// Wrench for a unit acceleration of the joint.
    pub(crate) along: Wrench,
    /// Inertia against the joint's own motion.
    pub(crate) inertia: f64,
    /// What is left of the joint's torque.
    pub(crate) torque: f64,
}

impl BodyTree {
    /// A buffer for this robot.
    pub fn buffer(&self) -> DynamicsBuffer {
        let n = self.dof();
        let independent: Vec<usize> = (0..n).filter(|&joint| self.mimics[joint].is_none()).collect();
        let m = independent.len();
        let rigid = ArticulatedInertia::of_rigid(&SpatialInertia::zero());
        DynamicsBuffer {
            angles_rad: vec![0.0; n],
            turns: vec![SinCos::of(0.0); n],
            parent_from_bodies: vec![Pose::identity(); n],
            motions: vec![BodyMotion::zero(); n],
            wrenches: vec![Wrench::zero(); n],
            composites: vec![SpatialInertia::zero(); n],
            articulated: vec![rigid; n],
            releases: vec![Release { along: Wrench::zero(), inertia: 0.0, torque: 0.0 }; n],
            zeros: vec![0.0; n],
            bias: vec![0.0; n],
            mass_matrix: DMatrix::zeros(n, n),
            independent,
            reduced_mass_matrix: DMatrix::zeros(m, m),
            reduced: DVector::zeros(m),
        }
    }

    /// Compares the lengths of a motion and of the buffer.
    pub(crate) fn check(
        &self,
        motion: &JointMotion<'_>,
        buffer: &DynamicsBuffer,
    ) -> Result<(), DynamicsError> {
        DynamicsError::check("positions", self.dof(), motion.q)?;
        DynamicsError::check("speeds", self.dof(), motion.qd)?;
        DynamicsError::check("accelerations", self.dof(), motion.qdd)?;
        DynamicsError::check("buffer", self.dof(), &buffer.angles_rad)
    }

    /// Where each body is in its parent.
    pub(crate) fn place(&self, q: &[f64], buffer: &mut DynamicsBuffer) {
        for ((angle_rad, body), &q) in buffer.angles_rad.iter_mut().zip(&self.bodies).zip(q) {
            *angle_rad = if body.turns { q } else { 0.0 };
        }
        SinCos::of_many_into(&buffer.angles_rad, &mut buffer.turns);
        for (((body, &q), turn), place) in
            self.bodies.iter().zip(q).zip(&buffer.turns).zip(&mut buffer.parent_from_bodies)
        {
            *place = body.parent_from_body_at(q, turn);
        }
    }
}
