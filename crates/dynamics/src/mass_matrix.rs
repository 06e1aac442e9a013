//! The mass matrix, by the composite rigid body algorithm.

#![expect(clippy::inline_always, reason = "what is not inlined is compiled for the narrowest vectors")]

use congruent_description::RobotQ;
use nalgebra::DMatrix;
use pulp::{Arch, Simd, WithSimd};

use crate::{
    body_tree::BodyTree,
    buffer::{BodyValues, DynamicsBuffer},
    error::DynamicsError,
};

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
        self.check_buffer(buffer)?;
        if mass_matrix.shape() != (n, n) {
            let found = mass_matrix.nrows();
            return Err(DynamicsError::Length { what: "mass matrix", expected: n, found });
        }
        self.turn(q, buffer);
        mass_matrix.fill(0.0);
        Arch::new().dispatch(CompositeBodies { tree: self, q, buffer, mass_matrix });
        Ok(())
    }
}

/// The algorithm in the widest vectors that the machine has.
struct CompositeBodies<'a> {
    tree: &'a BodyTree,
    q: &'a RobotQ,
    buffer: &'a mut DynamicsBuffer,
    mass_matrix: &'a mut DMatrix<f64>,
}

impl WithSimd for CompositeBodies<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { tree, q, buffer, mass_matrix } = self;
        for (joint, body) in tree.bodies.iter().enumerate() {
            let values = &mut buffer.values[joint];
            values.placement = body.frame.placement(q[joint], &buffer.turns[joint]);
            values.composite = body.inertia;
        }
        for (joint, body) in tree.bodies.iter().enumerate().rev() {
            let BodyValues { composite, placement, .. } = buffer.values[joint];
            let own = composite.along_axis(&body.frame);
            buffer.values[joint].wrench = own;
            mass_matrix[(joint, joint)] = body.frame.along_axis(&own) + tree.resistances[joint].armature;
            let Some(parent) = body.parent else { continue };
            let above = &mut buffer.values[parent];
            above.composite = above.composite.with_child(&composite, &placement);
            // The wrenches of all joints that this one carries go on together: none waits for another.
            let frame = &tree.bodies[parent].frame;
            for (carried, values) in (joint..body.subtree_end).zip(&mut buffer.values[joint..]) {
                values.wrench = placement.wrench(&values.wrench);
                mass_matrix[(carried, parent)] = frame.along_axis(&values.wrench);
            }
        }
        mass_matrix.fill_upper_triangle_with_lower_triangle();
    }
}
