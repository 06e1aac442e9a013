//! Inverse dynamics: the joint torques of a motion, by the recursive Newton-Euler algorithm.

#![expect(clippy::inline_always, reason = "what is not inlined is compiled for the narrowest vectors")]

use congruent_description::RobotQ;
use pulp::{Arch, Simd, WithSimd};

use crate::{
    algebra::columns::PaddedVector,
    algebra::rigid::{BodyMotion, BodyTwist},
    body_tree::{BodyTree, JointMotionState},
    buffer::{BodyValues, DynamicsBuffer},
    error::DynamicsError,
};

impl BodyTree {
    /// Torques (forces of prismatic joints) that give the robot a motion, against gravity, damping, dry friction and
    /// armature.
    ///
    /// | value | shape | unit |
    /// |---|---|---|
    /// | `motion` | dof each | rad, m and s |
    /// | `tau` | dof | N m, N |
    ///
    /// Source: Luh, Walker, Paul, *On-line computational scheme for mechanical manipulators* (1980); in the form of
    /// Featherstone, *Rigid Body Dynamics Algorithms* (2008), table 5.1.
    ///
    /// # Errors
    /// [`DynamicsError::Length`] if a vector or the buffer is another robot's.
    ///
    /// # Examples
    /// A rod of 2 kg with its centre 0.5 m out on a hinge about y, which is held still:
    /// ```
    /// use congruent_description::{RobotQ, parse_urdf};
    /// use congruent_dynamics::{BodyTree, JointMotionState};
    /// let robot = parse_urdf(
    ///     r#"<robot name="rod"><link name="base"/>
    ///     <link name="rod"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
    ///       <inertia ixx="0.01" iyy="0.2" izz="0.2" ixy="0" ixz="0" iyz="0"/></inertial></link>
    ///     <joint name="hinge" type="continuous"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/></joint>
    ///   </robot>"#,
    /// ).unwrap();
    /// let tree = BodyTree::new(&robot);
    /// let mut tau = [0.0];
    /// let held = JointMotionState { q: &RobotQ::zeros(1), qd: &[0.0], qdd: &[0.0] };
    /// tree.inverse_into(&held, &mut tree.buffer(), &mut tau)?;
    /// assert!((tau[0] + 2.0 * 9.81 * 0.5).abs() < 1e-14);
    /// # Ok::<(), congruent_dynamics::DynamicsError>(())
    /// ```
    pub fn inverse_into(
        &self,
        motion: &JointMotionState<'_>,
        buffer: &mut DynamicsBuffer,
        tau: &mut [f64],
    ) -> Result<(), DynamicsError> {
        self.rigid_inverse_into(motion, buffer, tau)?;
        for (((tau, resistance), &qd), &qdd) in
            tau.iter_mut().zip(&self.resistances).zip(motion.qd).zip(motion.qdd)
        {
            // These act at the joint itself; no other joint feels them.
            *tau += resistance.against_speed(qd) + resistance.armature * qdd;
        }
        Ok(())
    }

    /// Torques that hold the robot still against gravity.
    ///
    /// # Errors
    /// [`DynamicsError::Length`] if a vector or the buffer is another robot's.
    pub fn gravity_into(
        &self,
        q: &RobotQ,
        buffer: &mut DynamicsBuffer,
        tau: &mut [f64],
    ) -> Result<(), DynamicsError> {
        // Taken out to be passed beside the mutable buffer, without an allocation.
        let zeros = std::mem::take(&mut buffer.zeros);
        let result = self.rigid_inverse_into(&JointMotionState { q, qd: &zeros, qdd: &zeros }, buffer, tau);
        buffer.zeros = zeros;
        result
    }

    /// Torques of a motion without acceleration: gravity and the velocity products, without damping and friction.
    ///
    /// # Errors
    /// [`DynamicsError::Length`] if a vector or the buffer is another robot's.
    pub fn bias_into(
        &self,
        q: &RobotQ,
        qd: &[f64],
        buffer: &mut DynamicsBuffer,
        tau: &mut [f64],
    ) -> Result<(), DynamicsError> {
        let zeros = std::mem::take(&mut buffer.zeros);
        let result = self.rigid_inverse_into(&JointMotionState { q, qd, qdd: &zeros }, buffer, tau);
        buffer.zeros = zeros;
        result
    }

    /// Inverse dynamics of the rigid bodies alone.
    fn rigid_inverse_into(
        &self,
        motion: &JointMotionState<'_>,
        buffer: &mut DynamicsBuffer,
        tau: &mut [f64],
    ) -> Result<(), DynamicsError> {
        self.check_motion(motion, buffer)?;
        DynamicsError::check("torques", self.dof(), tau)?;
        self.turn(motion.q, buffer);
        Arch::new().dispatch(NewtonEuler { tree: self, motion, buffer, tau });
        Ok(())
    }

    /// Compares the lengths of a motion and of the buffer.
    pub(crate) fn check_motion(
        &self,
        motion: &JointMotionState<'_>,
        buffer: &DynamicsBuffer,
    ) -> Result<(), DynamicsError> {
        DynamicsError::check("positions", self.dof(), motion.q)?;
        DynamicsError::check("speeds", self.dof(), motion.qd)?;
        DynamicsError::check("accelerations", self.dof(), motion.qdd)?;
        self.check_buffer(buffer)
    }

    /// How each body moves, outwards from the root.
    #[inline(always)]
    pub(crate) fn move_bodies(&self, motion: &JointMotionState<'_>, buffer: &mut DynamicsBuffer) {
        // The root accelerates upwards instead of gravity acting on each body (Featherstone 2008, sec. 5.3).
        let root = BodyMotion { acceleration: self.root_acceleration(), ..BodyMotion::ZERO };
        for (joint, body) in self.bodies.iter().enumerate() {
            let parent = body.parent.map_or(root, |parent| buffer.values[parent].motion);
            let turn = &buffer.turns[joint];
            let placement = body.frame.placement(motion.q[joint], turn);
            let mut moved = body.frame.carried(&parent, placement.origin, turn, motion.qd[joint]);
            moved.acceleration = body.frame.accelerated(moved.acceleration, motion.qdd[joint]);
            let values = &mut buffer.values[joint];
            (values.placement, values.motion) = (placement, moved);
        }
    }

    /// Acceleration of the root: gravity acts on all bodies like an upward acceleration of a root that does not move.
    #[inline(always)]
    pub(crate) fn root_acceleration(&self) -> BodyTwist {
        BodyTwist { angular: PaddedVector::ZERO, linear: PaddedVector::from(-self.gravity_in_root) }
    }
}

/// The recursive Newton-Euler algorithm, compiled for the widest vector instructions of the machine.
struct NewtonEuler<'a> {
    tree: &'a BodyTree,
    motion: &'a JointMotionState<'a>,
    buffer: &'a mut DynamicsBuffer,
    tau: &'a mut [f64],
}

impl WithSimd for NewtonEuler<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { tree, motion, buffer, tau } = self;
        tree.move_bodies(motion, buffer);
        for (body, values) in tree.bodies.iter().zip(&mut buffer.values) {
            values.wrench = body.inertia.wrench(&values.motion);
        }
        // From the tips: the wrench on a body is complete only after those of all its children.
        for (joint, body) in tree.bodies.iter().enumerate().rev() {
            let BodyValues { placement, wrench, .. } = &buffer.values[joint];
            tau[joint] = body.frame.along_axis(wrench);
            if let Some(parent) = body.parent {
                let carried = placement.wrench(wrench);
                let values = &mut buffer.values[parent];
                values.wrench = values.wrench.plus(carried);
            }
        }
    }
}
