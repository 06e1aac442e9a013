//! Inverse dynamics: the joint torques of a motion, by the recursive Newton-Euler algorithm.

use congruent_description::RobotQ;
use congruent_kinematics::{Pose, Twist, Wrench};
use nalgebra::Vector3;

use crate::{
    body_tree::{Body, BodyTree, JointMotion, JointResistance},
    buffer::{BodyMotion, DynamicsBuffer},
    error::DynamicsError,
    spatial_inertia::SpatialInertia,
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
    /// use congruent_dynamics::{BodyTree, JointMotion};
    /// let robot = parse_urdf(
    ///     r#"<robot name="rod"><link name="base"/>
    ///     <link name="rod"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
    ///       <inertia ixx="0.01" iyy="0.2" izz="0.2" ixy="0" ixz="0" iyz="0"/></inertial></link>
    ///     <joint name="hinge" type="continuous"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/></joint>
    ///   </robot>"#,
    /// ).unwrap();
    /// let tree = BodyTree::new(&robot);
    /// let mut tau = [0.0];
    /// let held = JointMotion { q: &RobotQ::zeros(1), qd: &[0.0], qdd: &[0.0] };
    /// tree.inverse_into(&held, &mut tree.buffer(), &mut tau)?;
    /// assert!((tau[0] + 2.0 * 9.81 * 0.5).abs() < 1e-14);
    /// # Ok::<(), congruent_dynamics::DynamicsError>(())
    /// ```
    pub fn inverse_into(
        &self,
        motion: &JointMotion<'_>,
        buffer: &mut DynamicsBuffer,
        tau: &mut [f64],
    ) -> Result<(), DynamicsError> {
        self.rigid_inverse_into(motion, buffer, tau)?;
        for (((tau, resistance), &qd), &qdd) in
            tau.iter_mut().zip(&self.resistances).zip(motion.qd).zip(motion.qdd)
        {
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
        let zeros = std::mem::take(&mut buffer.zeros);
        let result = self.rigid_inverse_into(&JointMotion { q, qd: &zeros, qdd: &zeros }, buffer, tau);
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
        let result = self.rigid_inverse_into(&JointMotion { q, qd, qdd: &zeros }, buffer, tau);
        buffer.zeros = zeros;
        result
    }

    /// Inverse dynamics of the rigid bodies alone.
    fn rigid_inverse_into(
        &self,
        motion: &JointMotion<'_>,
        buffer: &mut DynamicsBuffer,
        tau: &mut [f64],
    ) -> Result<(), DynamicsError> {
        self.check(motion, buffer)?;
        DynamicsError::check("torques", self.dof(), tau)?;
        self.move_bodies(motion.q, |joint| (motion.qd[joint], motion.qdd[joint]), buffer);
        for (joint, body) in self.bodies.iter().enumerate() {
            buffer.wrenches[joint] = body.inertia.wrench_of(&buffer.motions[joint]);
        }
        for (joint, body) in self.bodies.iter().enumerate().rev() {
            let wrench = buffer.wrenches[joint];
            tau[joint] = body.along_axis(&wrench);
            if let Some(parent) = body.parent {
                add(&mut buffer.wrenches[parent], &wrench.transformed_by(&buffer.parent_from_bodies[joint]));
            }
        }
        Ok(())
    }

    /// Where each body is in its parent and how it moves, from the joints' speeds and accelerations.
    #[inline]
    pub(crate) fn move_bodies(
        &self,
        q: &RobotQ,
        of_joint: impl Fn(usize) -> (f64, f64),
        buffer: &mut DynamicsBuffer,
    ) {
        self.place(q, buffer);
        let root = self.root_motion();
        for (joint, body) in self.bodies.iter().enumerate() {
            let parent = body.parent.map_or(&root, |parent| &buffer.motions[parent]);
            buffer.motions[joint] = body.moved(parent, &buffer.parent_from_bodies[joint], of_joint(joint));
        }
    }

    /// The root does not move; that it accelerates upwards is gravity for all that it carries.
    pub(crate) fn root_motion(&self) -> BodyMotion {
        let acceleration = Twist { angular: Vector3::zeros(), linear: -self.gravity_in_root };
        BodyMotion { velocity: Twist::zero(), acceleration }
    }
}

impl JointResistance {
    /// Damping and dry friction at a speed.
    #[inline]
    pub(crate) fn against_speed(&self, qd: f64) -> f64 {
        // `signum` of zero is one: at rest nothing rubs.
        let direction = if qd == 0.0 { 0.0 } else { qd.signum() };
        self.damping * qd + self.friction * direction
    }
}

impl Body {
    /// The motion of the body from its parent's and its joint's speed and acceleration.
    #[inline]
    pub(crate) fn moved(
        &self,
        parent: &BodyMotion,
        parent_from_body: &Pose,
        (qd, qdd): (f64, f64),
    ) -> BodyMotion {
        let (rotation, origin) = (&parent_from_body.rotation, &parent_from_body.translation);
        let (turning, turning_up) = (&parent.velocity.angular, &parent.acceleration.angular);
        let swept = turning.cross(origin);
        let linear = parent.acceleration.linear + turning_up.cross(origin) + turning.cross(&swept);
        let mut velocity = Twist {
            angular: rotation.tr_mul(turning),
            linear: rotation.tr_mul(&(parent.velocity.linear + swept)),
        };
        let mut acceleration =
            Twist { angular: rotation.tr_mul(turning_up), linear: rotation.tr_mul(&linear) };
        // The angular velocity times the joint's own, which is along z.
        let crossed = Vector3::new(velocity.angular.y * qd, -velocity.angular.x * qd, 0.0);
        if self.turns {
            acceleration.angular += crossed;
            acceleration.angular.z += qdd;
            velocity.angular.z += qd;
        } else {
            acceleration.linear += crossed * 2.0;
            acceleration.linear.z += qdd;
            velocity.linear.z += qd;
        }
        BodyMotion { velocity, acceleration }
    }

    /// The part of a wrench that the joint takes up.
    #[inline]
    pub(crate) fn along_axis(&self, wrench: &Wrench) -> f64 {
        if self.turns { wrench.moment.z } else { wrench.force.z }
    }

    /// A unit of the joint's motion, in the body's frame.
    #[inline]
    pub(crate) fn axis(&self) -> Twist {
        if self.turns {
            Twist { angular: Vector3::z(), linear: Vector3::zeros() }
        } else {
            Twist { angular: Vector3::zeros(), linear: Vector3::z() }
        }
    }
}

impl SpatialInertia {
    /// The wrench that makes the body move so.
    ///
    /// Source: Newton's and Euler's equations about a point that is not the centre of mass: Featherstone, *Rigid Body
    /// Dynamics Algorithms* (2008), eq. 2.72, in classical accelerations.
    #[inline]
    pub(crate) fn wrench_of(&self, motion: &BodyMotion) -> Wrench {
        let mut wrench = self.velocity_wrench(&motion.velocity.angular);
        add(&mut wrench, &self.momentum(&motion.acceleration));
        wrench
    }

    /// The part of it that is owed to turning.
    #[inline]
    pub(crate) fn velocity_wrench(&self, turning: &Vector3<f64>) -> Wrench {
        Wrench {
            moment: turning.cross(&(self.tensor_kg_m2 * turning)),
            force: turning.cross(&turning.cross(&self.first_moment_kg_m)),
        }
    }
}

#[inline]
pub(crate) fn add(sum: &mut Wrench, wrench: &Wrench) {
    sum.moment += wrench.moment;
    sum.force += wrench.force;
}
