//! Memory of the algorithms, allocated once and used for every sample.

use congruent_kinematics::SinCos;
use nalgebra::{DMatrix, DVector};

use crate::{
    algebra::{
        rigid::{BodyInertia, BodyMotion, BodyWrench, Placement},
        rooted::{ArticulatedInertia, RootedBody},
    },
    body_tree::BodyTree,
    error::DynamicsError,
};

/// Intermediate values of one robot's algorithms: [`BodyTree::buffer`] makes it, and no call allocates after that.
#[derive(Debug, Clone)]
pub struct DynamicsBuffer {
    pub(crate) angles_rad: Vec<f64>,
    pub(crate) turns: Vec<SinCos>,
    pub(crate) values: Vec<BodyValues>,
    pub(crate) zeros: Vec<f64>,
    pub(crate) bias: Vec<f64>,
    pub(crate) mass_matrix: DMatrix<f64>,
    pub(crate) reduced_mass_matrix: DMatrix<f64>,
    pub(crate) reduced: DVector<f64>,
}

/// Intermediate values of one body.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BodyValues {
    pub(crate) placement: Placement,
    pub(crate) motion: BodyMotion,
    pub(crate) wrench: BodyWrench,
    pub(crate) rooted: RootedBody,
    /// The body with all that it carries, as if rigid.
    pub(crate) composite: BodyInertia,
    pub(crate) articulated: ArticulatedInertia,
    pub(crate) release: Release,
}

/// The response of an articulated body to its joint: inertia, and the torque that accelerates it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Release {
    /// Wrench for a unit acceleration of the joint.
    pub(crate) along: BodyWrench,
    /// One over the inertia against the joint's own motion.
    pub(crate) mobility: f64,
    /// Torque of the joint minus that of the bias wrench.
    pub(crate) torque: f64,
}

impl BodyValues {
    const NONE: Self = Self {
        placement: Placement::NONE,
        motion: BodyMotion::ZERO,
        wrench: BodyWrench::ZERO,
        rooted: RootedBody::NONE,
        composite: BodyInertia::ZERO,
        articulated: ArticulatedInertia::ZERO,
        release: Release { along: BodyWrench::ZERO, mobility: 0.0, torque: 0.0 },
    };
}

impl BodyTree {
    /// A buffer for this robot.
    pub fn buffer(&self) -> DynamicsBuffer {
        let n = self.dof();
        let m = self.independent.len();
        DynamicsBuffer {
            angles_rad: vec![0.0; n],
            turns: vec![SinCos::from_angle(0.0); n],
            values: vec![BodyValues::NONE; n],
            zeros: vec![0.0; n],
            bias: vec![0.0; n],
            mass_matrix: DMatrix::zeros(n, n),
            reduced_mass_matrix: DMatrix::zeros(m, m),
            reduced: DVector::zeros(m),
        }
    }

    pub(crate) fn check_buffer(&self, buffer: &DynamicsBuffer) -> Result<(), DynamicsError> {
        DynamicsError::check("buffer", self.dof(), &buffer.angles_rad)
    }

    /// Sine and cosine of every turning joint.
    pub(crate) fn turn(&self, q: &[f64], buffer: &mut DynamicsBuffer) {
        for ((angle_rad, body), &q) in buffer.angles_rad.iter_mut().zip(&self.bodies).zip(q) {
            // Sliding joints turn by 0, so that all sines are computed in one pass without a branch.
            *angle_rad = if body.frame.turns { q } else { 0.0 };
        }
        SinCos::from_angles_into(&buffer.angles_rad, &mut buffer.turns);
    }
}
