//! The regressor: joint torques are linear in the inertial parameters of the bodies.

use congruent_kinematics::{Pose, Twist, Wrench};
use nalgebra::{DMatrix, Vector3};

use crate::{
    body_tree::{BodyTree, JointMotion},
    buffer::{BodyMotion, DynamicsBuffer},
    error::DynamicsError,
    spatial_inertia::{PARAMETERS, SpatialInertia},
};

impl BodyTree {
    /// The matrix `Y` with `tau = Y p`, for the rigid bodies alone: `p` stacks
    /// [`SpatialInertia::parameters`] of the bodies, each in the frame of [`BodyTree::link`].
    ///
    /// | value | shape | unit |
    /// |---|---|---|
    /// | `motion` | dof each | rad, m and s |
    /// | `regressor` | dof x 10 dof | torque for a unit of each parameter |
    ///
    /// Source: Atkeson, An, Hollerbach, *Estimation of inertial parameters of manipulator loads and links* (1986).
    ///
    /// # Errors
    /// [`DynamicsError::Length`] if a vector, the matrix or the buffer is another robot's.
    pub fn regressor_into(
        &self,
        motion: &JointMotion<'_>,
        buffer: &mut DynamicsBuffer,
        regressor: &mut DMatrix<f64>,
    ) -> Result<(), DynamicsError> {
        let n = self.dof();
        self.check(motion, buffer)?;
        if regressor.shape() != (n, PARAMETERS * n) {
            let found = regressor.nrows();
            return Err(DynamicsError::Length { what: "regressor", expected: n, found });
        }
        self.move_bodies(motion.q, |joint| (motion.qd[joint], motion.qdd[joint]), buffer);
        regressor.fill(0.0);
        for (joint, body) in self.bodies.iter().enumerate() {
            let link_from_body = Pose::from_parts(body.body_from_link.transpose(), Vector3::zeros());
            let in_link = buffer.motions[joint].transformed_by(&link_from_body);
            for parameter in 0..PARAMETERS {
                let wrench = SpatialInertia::unit(parameter).wrench_of(&in_link);
                let wrench = wrench.transformed_by(&link_from_body.inverse());
                self.project(joint, wrench, buffer, |row, torque| {
                    regressor[(row, PARAMETERS * joint + parameter)] = torque;
                });
            }
        }
        Ok(())
    }

    /// What each joint above a body takes up of a wrench on it.
    fn project(
        &self,
        body: usize,
        mut wrench: Wrench,
        buffer: &DynamicsBuffer,
        mut each: impl FnMut(usize, f64),
    ) {
        let mut next = Some(body);
        while let Some(joint) = next {
            each(joint, self.bodies[joint].along_axis(&wrench));
            wrench = wrench.transformed_by(&buffer.parent_from_bodies[joint]);
            next = self.bodies[joint].parent;
        }
    }
}

impl SpatialInertia {
    /// One parameter is 1, the others 0.
    fn unit(parameter: usize) -> Self {
        let mut parameters = [0.0; PARAMETERS];
        parameters[parameter] = 1.0;
        Self::from_parameters(parameters)
    }
}

impl BodyMotion {
    /// The same motion in the axes of a frame with the same origin.
    fn transformed_by(&self, a_from_b: &Pose) -> Self {
        let turned = |twist: &Twist| Twist {
            angular: a_from_b.rotation * twist.angular,
            linear: a_from_b.rotation * twist.linear,
        };
        Self { velocity: turned(&self.velocity), acceleration: turned(&self.acceleration) }
    }
}
