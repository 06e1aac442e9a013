//! Forward dynamics: the accelerations that torques give, by the articulated body algorithm.

#![expect(clippy::inline_always, reason = "what is not inlined is compiled for the narrowest vectors")]

use congruent_description::RobotQ;
use nalgebra::DMatrix;
use pulp::{Arch, Simd, WithSimd};

use crate::{
    algebra::{
        columns::PaddedVector,
        rigid::{BodyMotion, BodyTwist},
        rooted::ArticulatedInertia,
    },
    body_tree::BodyTree,
    buffer::{BodyValues, DynamicsBuffer, Release},
    error::DynamicsError,
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
    /// Joint positions, rad or m.
    pub q: &'a RobotQ,
    /// Joint speeds, rad/s or m/s.
    pub qd: &'a [f64],
    /// Torques of the actuators, N m or N.
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
        self.check_buffer(buffer)?;
        if self.has_mimics() {
            self.forward_reduced_into(state, buffer, qdd)
        } else {
            self.turn(state.q, buffer);
            Arch::new().dispatch(ArticulatedBodies { tree: self, state, buffer, qdd })
        }
    }

    /// Accelerations with mimic joints: `G' M G ydd = G' (tau - bias)` for the independent joints `y`, `q = G y + offset`.
    fn forward_reduced_into(
        &self,
        state: &DrivenState<'_>,
        buffer: &mut DynamicsBuffer,
        qdd: &mut [f64],
    ) -> Result<(), DynamicsError> {
        // Taken out, because `bias_into` needs the buffer mutably as well; put back even if one of the calls
        // fails.
        let mut bias = std::mem::take(&mut buffer.bias);
        let mut mass_matrix = std::mem::replace(&mut buffer.mass_matrix, DMatrix::zeros(0, 0));
        let computed = self
            .bias_into(state.q, state.qd, buffer, &mut bias)
            .and_then(|()| self.mass_matrix_into(state.q, buffer, &mut mass_matrix));
        // Before the error is returned, so that the buffer stays usable.
        (buffer.bias, buffer.mass_matrix) = (bias, mass_matrix);
        computed?;
        buffer.reduced.fill(0.0);
        buffer.reduced_mass_matrix.fill(0.0);
        for joint in 0..self.dof() {
            let (row, ratio) = self.driver(joint);
            let resisting = self.resistances[joint].against_speed(state.qd[joint]);
            // Principle of virtual work: a follower moves `ratio` times as fast, so its torque counts `ratio` times
            // at the master.
            buffer.reduced[row] += ratio * (state.tau[joint] - buffer.bias[joint] - resisting);
            for other in 0..self.dof() {
                let (column, other_ratio) = self.driver(other);
                let entry = ratio * other_ratio * buffer.mass_matrix[(joint, other)];
                buffer.reduced_mass_matrix[(row, column)] += entry;
            }
        }
        self.solve_reduced(buffer)?;
        for (joint, qdd) in qdd.iter_mut().enumerate() {
            let (row, ratio) = self.driver(joint);
            *qdd = ratio * buffer.reduced[row];
        }
        Ok(())
    }

    /// Which of the driven joints ([`BodyTree::driven_joints`]) moves a joint, and by which ratio: itself with the ratio 1, unless it
    /// follows another.
    ///
    /// # Panics
    /// If there is no such joint.
    pub fn driver(&self, joint: usize) -> (usize, f64) {
        let (master, ratio) = self.mimics[joint].map_or((joint, 1.0), |mimic| (mimic.master, mimic.ratio));
        let row = self.independent.iter().position(|&independent| independent == master);
        (row.expect("a mimicked joint is independent"), ratio)
    }

    /// Solves in place by a Cholesky decomposition, which overwrites the reduced mass matrix.
    fn solve_reduced(&self, buffer: &mut DynamicsBuffer) -> Result<(), DynamicsError> {
        let (matrix, vector) = (&mut buffer.reduced_mass_matrix, &mut buffer.reduced);
        let m = vector.len();
        // Cholesky in place, by columns, below the diagonal: nalgebra's would allocate.
        for column in 0..m {
            for row in column..m {
                let known: f64 = (0..column).map(|k| matrix[(row, k)] * matrix[(column, k)]).sum();
                let rest = matrix[(row, column)] - known;
                if row > column {
                    matrix[(row, column)] = rest / matrix[(column, column)];
                } else if rest.is_finite() && rest > 0.0 {
                    matrix[(column, column)] = rest.sqrt();
                } else {
                    return Err(self.no_inertia(self.independent[column]));
                }
            }
        }
        // L y = b, then L' x = y.
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

/// The articulated body algorithm, compiled for the widest vector instructions of the machine; every joint is independent.
struct ArticulatedBodies<'a> {
    tree: &'a BodyTree,
    state: &'a DrivenState<'a>,
    buffer: &'a mut DynamicsBuffer,
    qdd: &'a mut [f64],
}

impl WithSimd for ArticulatedBodies<'_> {
    type Output = Result<(), DynamicsError>;

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, _: S) -> Self::Output {
        self.velocities();
        for joint in (0..self.tree.dof()).rev() {
            self.release(joint)?;
        }
        self.accelerate();
        Ok(())
    }
}

impl ArticulatedBodies<'_> {
    /// Outwards: velocities. An acceleration holds the velocity products of its own joint for now.
    #[inline(always)]
    fn velocities(&mut self) {
        for (joint, body) in self.tree.bodies.iter().enumerate() {
            let (q, qd) = (self.state.q[joint], self.state.qd[joint]);
            let (axes, turning) = match body.parent.map(|parent| &self.buffer.values[parent]) {
                Some(parent) => (Some(&parent.rooted.axes), parent.motion.angular_velocity),
                None => (None, PaddedVector::ZERO),
            };
            let rooted = body.frame.rooted(axes, q, &self.buffer.turns[joint]);
            // Only the products: the accelerations of joints are not known before the last pass.
            let acceleration = body.frame.velocity_products(&rooted, turning, qd);
            let angular_velocity = if body.frame.turns { turning + rooted.axis() * qd } else { turning };
            let inertia = body.inertia.turned(&rooted.axes);
            let values = &mut self.buffer.values[joint];
            values.rooted = rooted;
            values.motion = BodyMotion { angular_velocity, acceleration };
            values.wrench = inertia.velocity_wrench(angular_velocity);
            values.articulated = ArticulatedInertia::from_rigid(&inertia);
        }
    }

    /// Inwards: releases a joint, and adds the articulated inertia and bias force of its body to the parent.
    #[inline(always)]
    fn release(&mut self, joint: usize) -> Result<(), DynamicsError> {
        let (body, resistance) = (&self.tree.bodies[joint], &self.tree.resistances[joint]);
        let values = &mut self.buffer.values[joint];
        let (rooted, frame) = (values.rooted, &body.frame);
        let along = values.articulated.accelerated_along(rooted.axis(), frame);
        // D = S' I_A S + armature (Featherstone 2008, table 7.1): inertia of the whole subtree against this
        // joint.
        let inertia = frame.along(rooted.axis(), &along) + resistance.armature;
        if !(inertia.is_finite() && inertia > 0.0) {
            return Err(self.tree.no_inertia(joint));
        }
        let driving = self.state.tau[joint] - resistance.against_speed(self.state.qd[joint]);
        let torque = driving - frame.along(rooted.axis(), &values.wrench);
        let mobility = 1.0 / inertia;
        values.release = Release { along, mobility, torque };
        let Some(parent) = body.parent else { return Ok(()) };
        let scaled = along.times(mobility);
        let yielding = values.articulated.yielding(&along, &scaled);
        // At this time `acceleration` holds the velocity products c of the joint: p_a = p_A + I_a c + U u / D.
        let bias = yielding.wrench(&values.motion.acceleration);
        let wrench = values.wrench.plus(bias).plus(scaled.times(torque));
        let parent = &mut self.buffer.values[parent];
        parent.articulated = parent.articulated.with_child(&yielding, rooted.offset);
        parent.wrench = parent.wrench.plus(rooted.wrench_on_parent(&wrench));
        Ok(())
    }

    /// Outwards: each joint's acceleration from its parent's.
    #[inline(always)]
    fn accelerate(&mut self) {
        for (joint, body) in self.tree.bodies.iter().enumerate() {
            let parent = match body.parent {
                Some(parent) => self.buffer.values[parent].motion.acceleration,
                None => self.tree.root_acceleration(),
            };
            let BodyValues { rooted, motion, release, .. } = &mut self.buffer.values[joint];
            let own = motion.acceleration.plus(rooted.carried(&parent));
            // qdd = (u - U' a') / D, with a' the acceleration that the parent gives the body.
            let qdd = (release.torque - release.along.power(&own)) * release.mobility;
            self.qdd[joint] = qdd;
            let by_joint = rooted.axis() * qdd;
            motion.acceleration = if body.frame.turns {
                BodyTwist { angular: own.angular + by_joint, ..own }
            } else {
                BodyTwist { linear: own.linear + by_joint, ..own }
            };
        }
    }
}
