//! Energies and momentum of a moving robot.

use congruent_description::RobotQ;
use congruent_kinematics::{Pose, Twist, Wrench};

use crate::{body_tree::BodyTree, error::DynamicsError, spatial_inertia::SpatialInertia};

/// Energy of all bodies that a joint moves, in J. Links that are fixed to the root have no part in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Energy {
    /// Kinetic energy, armature included, J.
    pub kinetic_j: f64,
    /// Potential energy of gravity, J; zero if the centre of mass is at the height of the root's origin.
    pub potential_j: f64,
}

/// A body in motion, in the root's frame.
struct BodyInRoot {
    inertia_in_root: SpatialInertia,
    twist_in_root: Twist,
}

impl BodyTree {
    /// Kinetic and potential energy.
    ///
    /// Source: Featherstone, *Rigid Body Dynamics Algorithms* (2008), eq. 2.67: `v' I v / 2`, body by body.
    ///
    /// # Errors
    /// [`DynamicsError::Length`] if a vector is another robot's.
    pub fn energy(&self, q: &RobotQ, qd: &[f64]) -> Result<Energy, DynamicsError> {
        let mut energy = Energy { kinetic_j: 0.0, potential_j: 0.0 };
        for BodyInRoot { inertia_in_root, twist_in_root } in self.moving_bodies(q, qd)? {
            // Half the power of momentum and twist.
            energy.kinetic_j += inertia_in_root.momentum(&twist_in_root).power(&twist_in_root) / 2.0;
            // Mass times position of the centre of mass is the first moment about the root's origin: V = -g . (m
            // c).
            energy.potential_j -= self.gravity_in_root.dot(&inertia_in_root.first_moment_kg_m);
        }
        let armature = self.resistances.iter().zip(qd).map(|(resistance, qd)| resistance.armature * qd * qd);
        energy.kinetic_j += armature.sum::<f64>() / 2.0;
        Ok(energy)
    }

    /// Angular momentum about the root's origin and linear momentum of all bodies, in the axes of the root:
    /// N m s and N s.
    ///
    /// # Errors
    /// [`DynamicsError::Length`] if a vector is another robot's.
    pub fn momentum_in_root(&self, q: &RobotQ, qd: &[f64]) -> Result<Wrench, DynamicsError> {
        let mut sum = Wrench::zero();
        for BodyInRoot { inertia_in_root, twist_in_root } in self.moving_bodies(q, qd)? {
            let momentum = inertia_in_root.momentum(&twist_in_root);
            sum.moment += momentum.moment;
            sum.force += momentum.force;
        }
        Ok(sum)
    }

    /// Each body in the root's frame, parents first.
    fn moving_bodies(&self, q: &RobotQ, qd: &[f64]) -> Result<Vec<BodyInRoot>, DynamicsError> {
        DynamicsError::check("positions", self.dof(), q)?;
        DynamicsError::check("speeds", self.dof(), qd)?;
        let mut root_from_bodies: Vec<Pose> = Vec::with_capacity(self.dof());
        let mut moving: Vec<BodyInRoot> = Vec::with_capacity(self.dof());
        for (joint, body) in self.bodies.iter().enumerate() {
            let (root_from_parent, parent) =
                body.parent.map_or((Pose::identity(), Twist::zero()), |parent| {
                    (root_from_bodies[parent], moving[parent].twist_in_root)
                });
            let root_from_body = root_from_parent * body.parent_from_body_at(q[joint]);
            let axis_in_root = body.axis().transformed_by(&root_from_body);
            moving.push(BodyInRoot {
                inertia_in_root: body.spatial_inertia.transformed_by(&root_from_body),
                twist_in_root: Twist {
                    angular: parent.angular + axis_in_root.angular * qd[joint],
                    linear: parent.linear + axis_in_root.linear * qd[joint],
                },
            });
            root_from_bodies.push(root_from_body);
        }
        Ok(moving)
    }
}
