//! The regressor: joint torques are linear in the inertial parameters of the bodies.

use nalgebra::DMatrix;

use crate::{
    algebra::rigid::{BodyInertia, BodyWrench},
    body_tree::{BodyTree, JointMotionState},
    buffer::DynamicsBuffer,
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
        motion: &JointMotionState<'_>,
        buffer: &mut DynamicsBuffer,
        regressor: &mut DMatrix<f64>,
    ) -> Result<(), DynamicsError> {
        let n = self.dof();
        self.check_motion(motion, buffer)?;
        if regressor.shape() != (n, PARAMETERS * n) {
            let found = regressor.nrows();
            return Err(DynamicsError::Length { what: "regressor", expected: n, found });
        }
        self.turn(motion.q, buffer);
        self.move_bodies(motion, buffer);
        regressor.fill(0.0);
        for (joint, body) in self.bodies.iter().enumerate() {
            for parameter in 0..PARAMETERS {
                // Torques are linear in the parameters: a unit parameter's torque is its column.
                let in_body = unit(parameter).transformed_by(&body.link_from_body().inverse());
                let wrench = BodyInertia::from(&in_body).wrench(&buffer.values[joint].motion);
                self.project(joint, wrench, buffer, |row, torque| {
                    regressor[(row, PARAMETERS * joint + parameter)] = torque;
                });
            }
        }
        Ok(())
    }

    /// The torque of each joint from a body up to the root that balances a wrench on the body.
    fn project(
        &self,
        body: usize,
        mut wrench: BodyWrench,
        buffer: &DynamicsBuffer,
        mut each: impl FnMut(usize, f64),
    ) {
        let mut next = Some(body);
        while let Some(joint) = next {
            // Only joints above a body feel it, so the columns are zero elsewhere.
            let body = &self.bodies[joint];
            each(joint, body.frame.along_axis(&wrench));
            wrench = buffer.values[joint].placement.wrench(&wrench);
            next = body.parent;
        }
    }
}

/// The inertia with one parameter 1 and the others 0.
fn unit(parameter: usize) -> SpatialInertia {
    let mut parameters = [0.0; PARAMETERS];
    parameters[parameter] = 1.0;
    SpatialInertia::from_parameters(parameters)
}
