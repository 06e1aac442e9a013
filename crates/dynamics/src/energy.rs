//! Energies and momentum of a moving robot.

use congruent_description::RobotQ;
use congruent_kinematics::{Pose, Wrench};

use crate::{
    body_tree::{BodyTree, JointMotion},
    buffer::DynamicsBuffer,
    error::DynamicsError,
    inverse::add,
};

/// Energy of all bodies that a joint moves, in J. Links that are fixed to the root have no part in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Energy {
    /// Of motion, armature included.
    pub kinetic_j: f64,
    /// Of gravity; zero if the centre of mass is at the height of the root's origin.
    pub potential_j: f64,
}

impl BodyTree {
    /// Kinetic and potential energy.
    ///
    /// Source: Featherstone, *Rigid Body Dynamics Algorithms* (2008), eq. 2.67: `v' I v / 2`, body by body.
    ///
    /// # Errors
    /// [`DynamicsError::Length`] if a vector or the buffer is another robot's.
    pub fn energy(
        &self,
        q: &RobotQ,
        qd: &[f64],
        buffer: &mut DynamicsBuffer,
    ) -> Result<Energy, DynamicsError> {
        let mut energy = Energy { kinetic_j: 0.0, potential_j: 0.0 };
        self.visit_bodies(q, qd, buffer, |tree, joint, root_from_body, buffer| {
            let inertia = &tree.bodies[joint].inertia;
            let velocity = &buffer.motions[joint].velocity;
            energy.kinetic_j += inertia.momentum(velocity).power(velocity) / 2.0;
            let first_moment = root_from_body.rotation * inertia.first_moment_kg_m
                + root_from_body.translation * inertia.mass_kg;
            energy.potential_j -= tree.gravity_in_root.dot(&first_moment);
        })?;
        let armature = self.resistances.iter().zip(qd).map(|(resistance, qd)| resistance.armature * qd * qd);
        energy.kinetic_j += armature.sum::<f64>() / 2.0;
        Ok(energy)
    }

    /// Angular momentum about the root's origin and linear momentum of all bodies, in the axes of the root:
    /// N m s and N s.
    ///
    /// # Errors
    /// [`DynamicsError::Length`] if a vector or the buffer is another robot's.
    pub fn momentum_in_root(
        &self,
        q: &RobotQ,
        qd: &[f64],
        buffer: &mut DynamicsBuffer,
    ) -> Result<Wrench, DynamicsError> {
        let mut momentum = Wrench::zero();
        self.visit_bodies(q, qd, buffer, |tree, joint, root_from_body, buffer| {
            let in_body = tree.bodies[joint].inertia.momentum(&buffer.motions[joint].velocity);
            add(&mut momentum, &in_body.transformed_by(root_from_body));
        })?;
        Ok(momentum)
    }

    /// Shows each body with its pose in the root, its velocity computed.
    fn visit_bodies(
        &self,
        q: &RobotQ,
        qd: &[f64],
        buffer: &mut DynamicsBuffer,
        mut each: impl FnMut(&Self, usize, &Pose, &DynamicsBuffer),
    ) -> Result<(), DynamicsError> {
        let zeros = std::mem::take(&mut buffer.zeros);
        let motion = JointMotion { q, qd, qdd: &zeros };
        let checked = self.check(&motion, buffer);
        buffer.zeros = zeros;
        checked?;
        self.move_bodies(q, |joint| (qd[joint], 0.0), buffer);
        for joint in 0..self.dof() {
            // From here on poses in the root: a parent's is known before its children's.
            if let Some(parent) = self.bodies[joint].parent {
                buffer.parent_from_bodies[joint] =
                    buffer.parent_from_bodies[parent] * buffer.parent_from_bodies[joint];
            }
            each(self, joint, &buffer.parent_from_bodies[joint], buffer);
        }
        Ok(())
    }
}
