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
    /// The mass matrix with armature on the diagonal: symmetric, dof x dof; kg m^2, kg m or kg.
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
        mass_matrix.as_mut_slice().fill(0.0);
        Arch::new().dispatch(CompositeBodies { tree: self, q, buffer, mass_matrix });
        Ok(())
    }
}

/// The composite rigid body algorithm, compiled for the widest vector instructions of the machine.
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
            let parent_axes = body.parent.map(|parent| &buffer.values[parent].rooted.axes);
            let rooted = body.frame.rooted(parent_axes, q[joint], &buffer.turns[joint]);
            let values = &mut buffer.values[joint];
            (values.rooted, values.composite) = (rooted, body.inertia.turned(&rooted.axes));
        }
        // From the tip: the composite inertia of a body is complete only after all that it carries were added.
        for (joint, body) in tree.bodies.iter().enumerate().rev() {
            let BodyValues { composite, rooted, .. } = buffer.values[joint];
            let own = composite.accelerated_along(rooted.axis(), &body.frame);
            buffer.values[joint].wrench = own;
            // Column-major: the entries of a column are contiguous.
            let column = &mut mass_matrix.as_mut_slice()[joint * tree.dof()..];
            column[joint] = body.frame.along(rooted.axis(), &own) + tree.resistances[joint].armature;
            let Some(parent) = body.parent else { continue };
            let above = &mut buffer.values[parent];
            above.composite = above.composite.with_child(&composite, rooted.offset);
            // The wrenches of all joints in the subtree are moved to the parent in one loop without dependences, so that the
            // processor overlaps them.
            let (frame, axis) = (&tree.bodies[parent].frame, above.rooted.axis());
            let carried = &mut buffer.values[joint..body.subtree_end];
            let column = &mut mass_matrix.as_mut_slice()[parent * tree.dof()..];
            for (values, entry) in carried.iter_mut().zip(&mut column[joint..body.subtree_end]) {
                values.wrench = rooted.wrench_on_parent(&values.wrench);
                *entry = frame.along(axis, &values.wrench);
            }
        }
        // Only joints of one branch are coupled; their entries were written below the diagonal.
        mass_matrix.fill_upper_triangle_with_lower_triangle();
    }
}
