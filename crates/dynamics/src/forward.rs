//! Forward dynamics: the accelerations that torques give, by the articulated body algorithm.

use congruent_description::RobotQ;
use congruent_kinematics::{Pose, Twist, Wrench};
use nalgebra::DMatrix;

use crate::{
    body_tree::BodyTree,
    buffer::{BodyMotion, DynamicsBuffer, Release},
    error::DynamicsError,
    inverse::add,
    spatial_inertia::ArticulatedInertia,
};

/// Positions, speeds and torques of all moving joints.
///
/// | field | shape | unit |
/// |---|---|---|
/// | `q` | the robot's dof | rad, m |
/// | `qd` | the robot's dof | rad/s, m/s |
/// | `tau` | the robot's dof | N m, N |
#[derive(Debug, Clone, Copy)]
pub struct DrivenState<'a> {
    /// Positions.
    pub q: &'a RobotQ,
    /// Speeds.
    pub qd: &'a [f64],
    /// Torques of the actuators.
    pub tau: &'a [f64],
}

impl BodyTree {
    /// Accelerations under torques, gravity, damping, dry friction and armature. Mimic joints keep their ratio
    /// rigidly: their own torque acts on their master.
    ///
    /// Dry friction acts against the speed; at rest it is zero and does not hold.
    ///
    /// Source: Featherstone, *Rigid Body Dynamics Algorithms* (2008), table 7.1; with mimic joints the mass matrix
    /// is reduced to the independent joints (section 3.5, explicit constraints) and factored.
    ///
    /// # Errors
    /// [`DynamicsError::Length`] if a vector or the buffer is another robot's; [`DynamicsError::NoInertia`] if a joint
    /// carries nothing that resists its acceleration.
    ///
    /// # Examples
    /// See [`BodyTree::inverse_into`]; the same rod falls freely:
    /// ```
    /// # use congruent_description::{RobotQ, parse_urdf};
    /// # let robot = parse_urdf(
    /// #     r#"<robot name="rod"><link name="base"/>
    /// #     <link name="rod"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
    /// #       <inertia ixx="0.01" iyy="0.2" izz="0.2" ixy="0" ixz="0" iyz="0"/></inertial></link>
    /// #     <joint name="hinge" type="continuous"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/></joint>
    /// #   </robot>"#,
    /// # ).unwrap();
    /// use congruent_dynamics::{BodyTree, DrivenState};
    /// let tree = BodyTree::new(&robot);
    /// let mut qdd = [0.0];
    /// let free = DrivenState { q: &RobotQ::zeros(1), qd: &[0.0], tau: &[0.0] };
    /// tree.forward_into(&free, &mut tree.buffer(), &mut qdd)?;
    /// assert!((qdd[0] - 2.0 * 9.81 * 0.5 / (0.2 + 2.0 * 0.25)).abs() < 1e-13);
    /// # Ok::<(), congruent_dynamics::DynamicsError>(())
    /// ```
    pub fn forward_into(
        &self,
        state: &DrivenState<'_>,
        buffer: &mut DynamicsBuffer,
        qdd: &mut [f64],
    ) -> Result<(), DynamicsError> {
        let n = self.dof();
        DynamicsError::check("positions", n, state.q)?;
        DynamicsError::check("speeds", n, state.qd)?;
        DynamicsError::check("torques", n, state.tau)?;
        DynamicsError::check("accelerations", n, qdd)?;
        DynamicsError::check("buffer", n, &buffer.angles_rad)?;
        if self.has_mimics() {
            self.forward_reduced_into(state, buffer, qdd)
        } else {
            self.articulated_into(state, buffer, qdd)
        }
    }

    /// Every joint independent: outwards velocities, inwards inertias, outwards accelerations.
    fn articulated_into(
        &self,
        state: &DrivenState<'_>,
        buffer: &mut DynamicsBuffer,
        qdd: &mut [f64],
    ) -> Result<(), DynamicsError> {
        self.place(state.q, buffer);
        // At zero acceleration of the joints, `acceleration` holds the velocity products of this joint alone.
        let still = BodyMotion::zero();
        for (joint, body) in self.bodies.iter().enumerate() {
            let parent = body.parent.map_or(&still, |parent| &buffer.motions[parent]);
            let parent = BodyMotion { velocity: parent.velocity, acceleration: Twist::zero() };
            let moved = body.moved(&parent, &buffer.parent_from_bodies[joint], (state.qd[joint], 0.0));
            buffer.wrenches[joint] = body.inertia.velocity_wrench(&moved.velocity.angular);
            buffer.articulated[joint] = ArticulatedInertia::of_rigid(&body.inertia);
            buffer.motions[joint] = moved;
        }
        for (joint, body) in self.bodies.iter().enumerate().rev() {
            self.release(joint, state, buffer)?;
            let Some(parent) = body.parent else { continue };
            let Release { along, inertia, torque } = buffer.releases[joint];
            let yielding = buffer.articulated[joint].released(&along, inertia);
            let mut wrench = yielding.wrench(&buffer.motions[joint].acceleration);
            add(&mut wrench, &buffer.wrenches[joint]);
            add(&mut wrench, &scaled(&along, torque / inertia));
            let parent_from_body = &buffer.parent_from_bodies[joint];
            buffer.articulated[parent] += yielding.transformed_by(parent_from_body);
            add(&mut buffer.wrenches[parent], &wrench.transformed_by(parent_from_body));
        }
        self.accelerate(buffer, qdd);
        Ok(())
    }

    /// The joint's inertia and the torque that bias wrenches leave to it.
    #[inline]
    fn release(
        &self,
        joint: usize,
        state: &DrivenState<'_>,
        buffer: &mut DynamicsBuffer,
    ) -> Result<(), DynamicsError> {
        let (body, resistance) = (&self.bodies[joint], &self.resistances[joint]);
        let along = buffer.articulated[joint].wrench(&body.axis());
        let inertia = body.along_axis(&along) + resistance.armature;
        if !(inertia.is_finite() && inertia > 0.0) {
            return Err(self.no_inertia(joint));
        }
        let driving = state.tau[joint] - resistance.against_speed(state.qd[joint]);
        let torque = driving - body.along_axis(&buffer.wrenches[joint]);
        buffer.releases[joint] = Release { along, inertia, torque };
        Ok(())
    }

    /// Outwards: each joint's acceleration from its parent's.
    fn accelerate(&self, buffer: &mut DynamicsBuffer, qdd: &mut [f64]) {
        let root = self.root_motion();
        for (joint, body) in self.bodies.iter().enumerate() {
            let parent = body.parent.map_or(&root, |parent| &buffer.motions[parent]).acceleration;
            let Pose { rotation, translation } = &buffer.parent_from_bodies[joint];
            let linear = parent.linear + parent.angular.cross(translation);
            let mut own = buffer.motions[joint].acceleration;
            own.angular += rotation.tr_mul(&parent.angular);
            own.linear += rotation.tr_mul(&linear);
            let Release { along, inertia, torque } = &buffer.releases[joint];
            qdd[joint] = (torque - along.power(&own)) / inertia;
            if body.turns {
                own.angular.z += qdd[joint];
            } else {
                own.linear.z += qdd[joint];
            }
            buffer.motions[joint].acceleration = own;
        }
    }

    /// Mimic joints follow: `G' M G ydd = G' (tau - bias)` for the independent joints `y`, `q = G y + offset`.
    fn forward_reduced_into(
        &self,
        state: &DrivenState<'_>,
        buffer: &mut DynamicsBuffer,
        qdd: &mut [f64],
    ) -> Result<(), DynamicsError> {
        let mut bias = std::mem::take(&mut buffer.bias);
        let mut mass_matrix = std::mem::replace(&mut buffer.mass_matrix, DMatrix::zeros(0, 0));
        let computed = self
            .bias_into(state.q, state.qd, buffer, &mut bias)
            .and_then(|()| self.mass_matrix_into(state.q, buffer, &mut mass_matrix));
        (buffer.bias, buffer.mass_matrix) = (bias, mass_matrix);
        computed?;
        buffer.reduced.fill(0.0);
        buffer.reduced_mass_matrix.fill(0.0);
        for joint in 0..self.dof() {
            let (row, ratio) = self.independent(joint, buffer);
            let resisting = self.resistances[joint].against_speed(state.qd[joint]);
            buffer.reduced[row] += ratio * (state.tau[joint] - buffer.bias[joint] - resisting);
            for other in 0..self.dof() {
                let (column, other_ratio) = self.independent(other, buffer);
                let entry = ratio * other_ratio * buffer.mass_matrix[(joint, other)];
                buffer.reduced_mass_matrix[(row, column)] += entry;
            }
        }
        self.solve_reduced(buffer)?;
        for (joint, qdd) in qdd.iter_mut().enumerate() {
            let (row, ratio) = self.independent(joint, buffer);
            *qdd = ratio * buffer.reduced[row];
        }
        Ok(())
    }

    /// The independent coordinate that moves a joint, and by which ratio.
    fn independent(&self, joint: usize, buffer: &DynamicsBuffer) -> (usize, f64) {
        let (master, ratio) = self.mimics[joint].map_or((joint, 1.0), |mimic| (mimic.master, mimic.ratio));
        let row = buffer.independent.iter().position(|&independent| independent == master);
        (row.expect("a mimicked joint is independent"), ratio)
    }

    /// Solves in place by Cholesky's factors, which are written over the reduced mass matrix.
    fn solve_reduced(&self, buffer: &mut DynamicsBuffer) -> Result<(), DynamicsError> {
        let (matrix, vector) = (&mut buffer.reduced_mass_matrix, &mut buffer.reduced);
        let m = vector.len();
        for column in 0..m {
            for row in column..m {
                let known: f64 = (0..column).map(|k| matrix[(row, k)] * matrix[(column, k)]).sum();
                let rest = matrix[(row, column)] - known;
                if row > column {
                    matrix[(row, column)] = rest / matrix[(column, column)];
                } else if rest.is_finite() && rest > 0.0 {
                    matrix[(column, column)] = rest.sqrt();
                } else {
                    return Err(self.no_inertia(buffer.independent[column]));
                }
            }
        }
        for row in 0..m {
            let known: f64 = (0..row).map(|k| matrix[(row, k)] * vector[k]).sum();
            vector[row] = (vector[row] - known) / matrix[(row, row)];
        }
        for row in (0..m).rev() {
            let known: f64 = (row + 1..m).map(|k| matrix[(k, row)] * vector[k]).sum();
            vector[row] = (vector[row] - known) / matrix[(row, row)];
        }
        Ok(())
    }
}

fn scaled(wrench: &Wrench, by: f64) -> Wrench {
    Wrench { moment: wrench.moment * by, force: wrench.force * by }
}
