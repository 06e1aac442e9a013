//! The mass matrix, by the composite rigid body algorithm.

use congruent_description::RobotQ;
use nalgebra::DMatrix;

use crate::{body_tree::BodyTree, buffer::DynamicsBuffer, error::DynamicsError};

impl BodyTree {
    /// Torques of unit accelerations, armature on the diagonal: symmetric, dof x dof, kg m^2 (kg m, kg).
    ///
    /// Source: Walker, Orin (1982); Featherstone, *Rigid Body Dynamics Algorithms* (2008), table 6.2.
    ///
    /// # Errors
    /// [`DynamicsError::Length`] if a vector, the matrix or the buffer is another robot's.
    pub fn mass_matrix_into(
        &self,
        q: &RobotQ,
        buffer: &mut DynamicsBuffer,
        mass_matrix: &mut DMatrix<f64>,
    ) -> Result<(), DynamicsError> {
        let n = self.dof();
        DynamicsError::check("positions", n, q)?;
        DynamicsError::check("buffer", n, &buffer.angles_rad)?;
        if mass_matrix.shape() != (n, n) {
            let found = mass_matrix.nrows();
            return Err(DynamicsError::Length { what: "mass matrix", expected: n, found });
        }
        self.place(q, buffer);
        for (composite, body) in buffer.composites.iter_mut().zip(&self.bodies) {
            *composite = body.inertia;
        }
        mass_matrix.fill(0.0);
        for (joint, body) in self.bodies.iter().enumerate().rev() {
            let composite = buffer.composites[joint];
            let mut wrench = composite.momentum(&body.axis());
            mass_matrix[(joint, joint)] = body.along_axis(&wrench) + self.resistances[joint].armature;
            let (mut below, mut above) = (joint, body.parent);
            if let Some(parent) = above {
                buffer.composites[parent] += composite.transformed_by(&buffer.parent_from_bodies[joint]);
            }
            while let Some(ancestor) = above {
                wrench = wrench.transformed_by(&buffer.parent_from_bodies[below]);
                let entry = self.bodies[ancestor].along_axis(&wrench);
                (mass_matrix[(joint, ancestor)], mass_matrix[(ancestor, joint)]) = (entry, entry);
                (below, above) = (ancestor, self.bodies[ancestor].parent);
            }
        }
        Ok(())
    }
}
