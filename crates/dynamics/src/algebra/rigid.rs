//! Motions, wrenches and inertias of one body in the frame of its joint, and their transforms to the parent's frame.

#![expect(clippy::inline_always, reason = "what is not inlined is compiled for the narrowest vectors")]

use congruent_kinematics::SinCos;

use crate::{
    algebra::columns::{Block, PaddedVector},
    spatial_inertia::SpatialInertia,
};

/// An angular and a linear acceleration (of the point at the frame's origin); or both velocities.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BodyTwist {
    pub(crate) angular: PaddedVector,
    pub(crate) linear: PaddedVector,
}

/// Angular velocity and acceleration of a body.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BodyMotion {
    pub(crate) angular_velocity: PaddedVector,
    pub(crate) acceleration: BodyTwist,
}

/// The wrench on a body: moment about the frame's origin, and force.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BodyWrench {
    pub(crate) moment: PaddedVector,
    pub(crate) force: PaddedVector,
}

/// Pose of a body in its parent.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Placement {
    pub(crate) rotation: Block,
    pub(crate) origin: PaddedVector,
}

/// A [`SpatialInertia`] in padded columns, for vector instructions.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BodyInertia {
    pub(crate) mass_kg: f64,
    pub(crate) first_moment: PaddedVector,
    pub(crate) tensor: Block,
}

/// The frame of a joint: pose of its body in the parent at position zero, and the kind of motion.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JointFrame {
    pub(crate) turns: bool,
    /// Axes of the body in the parent at position zero.
    pub(crate) parent_from_body: Block,
    /// Inverse of `parent_from_body`: axes of the parent in the body.
    pub(crate) body_from_parent: Block,
    /// Origin in the parent at position zero.
    pub(crate) origin: PaddedVector,
}

impl BodyTwist {
    pub(crate) const ZERO: Self = Self { angular: PaddedVector::ZERO, linear: PaddedVector::ZERO };

    #[inline(always)]
    pub(crate) fn plus(self, other: Self) -> Self {
        Self { angular: self.angular + other.angular, linear: self.linear + other.linear }
    }
}

impl BodyMotion {
    pub(crate) const ZERO: Self =
        Self { angular_velocity: PaddedVector::ZERO, acceleration: BodyTwist::ZERO };
}

impl BodyWrench {
    pub(crate) const ZERO: Self = Self { moment: PaddedVector::ZERO, force: PaddedVector::ZERO };

    #[inline(always)]
    pub(crate) fn plus(self, other: Self) -> Self {
        Self { moment: self.moment + other.moment, force: self.force + other.force }
    }

    #[inline(always)]
    pub(crate) fn times(self, by: f64) -> Self {
        Self { moment: self.moment * by, force: self.force * by }
    }

    #[inline(always)]
    pub(crate) fn power(self, twist: &BodyTwist) -> f64 {
        self.moment.dot(twist.angular) + self.force.dot(twist.linear)
    }
}

impl JointFrame {
    #[inline(always)]
    pub(crate) fn placement(&self, q: f64, turn: &SinCos) -> Placement {
        let [x, y, z] = self.parent_from_body.0;
        // R_0 R_z(q) by columns: a rotation about z mixes only the first two.
        let rotation = Block([x * turn.cos + y * turn.sin, y * turn.cos - x * turn.sin, z]);
        let origin = if self.turns { self.origin } else { self.origin + z * q };
        Placement { rotation, origin }
    }

    /// The body's motion from its parent's, with the velocity products of its joint but without its acceleration.
    ///
    /// Source: Luh, Walker, Paul (1980), with the acceleration of the point at the frame's origin.
    #[inline(always)]
    pub(crate) fn carried(
        &self,
        parent: &BodyMotion,
        origin: PaddedVector,
        turn: &SinCos,
        qd: f64,
    ) -> BodyMotion {
        let BodyMotion { angular_velocity: turning, acceleration } = *parent;
        let linear =
            acceleration.linear + acceleration.angular.cross(origin) + turning.cross(turning.cross(origin));
        // The inverse of `R_0 R_z(q)`, factor by factor.
        let to_body = |v: PaddedVector| (self.body_from_parent * v).turned_about_z(-turn.sin, turn.cos);
        let mut angular_velocity = to_body(turning);
        let mut acceleration = BodyTwist { angular: to_body(acceleration.angular), linear: to_body(linear) };
        // The angular velocity times the joint's own motion, which is along z.
        let crossed = PaddedVector::new(angular_velocity[1] * qd, -angular_velocity[0] * qd, 0.0);
        if self.turns {
            acceleration.angular += crossed;
            angular_velocity = angular_velocity.plus_z(qd);
        } else {
            // Coriolis: a sliding joint contributes w x v twice, once by the moving axis and once by the moving
            // point.
            acceleration.linear += crossed * 2.0;
        }
        BodyMotion { angular_velocity, acceleration }
    }

    /// The acceleration of the body with the joint's own acceleration added.
    #[inline(always)]
    pub(crate) fn accelerated(&self, twist: BodyTwist, qdd: f64) -> BodyTwist {
        if self.turns {
            BodyTwist { angular: twist.angular.plus_z(qdd), ..twist }
        } else {
            BodyTwist { linear: twist.linear.plus_z(qdd), ..twist }
        }
    }

    /// The component of a wrench along the joint's motion: its torque or force.
    #[inline(always)]
    pub(crate) fn along_axis(&self, wrench: &BodyWrench) -> f64 {
        if self.turns { wrench.moment[2] } else { wrench.force[2] }
    }
}

impl Placement {
    pub(crate) const NONE: Self = Self { rotation: Block::ZERO, origin: PaddedVector::ZERO };

    /// A wrench in the parent's frame.
    #[inline(always)]
    pub(crate) fn wrench(&self, in_body: &BodyWrench) -> BodyWrench {
        let force = self.rotation * in_body.force;
        BodyWrench { moment: self.rotation * in_body.moment + self.origin.cross(force), force }
    }
}

impl BodyInertia {
    pub(crate) const ZERO: Self =
        Self { mass_kg: 0.0, first_moment: PaddedVector::ZERO, tensor: Block::ZERO };

    /// The wrench that gives the body this motion.
    ///
    /// Source: Newton's and Euler's equations about a point that is not the centre of mass: Featherstone, *Rigid Body
    /// Dynamics Algorithms* (2008), eq. 2.72, in classical accelerations.
    #[inline(always)]
    pub(crate) fn wrench(&self, motion: &BodyMotion) -> BodyWrench {
        let BodyTwist { angular, linear } = motion.acceleration;
        let h = self.first_moment;
        let accelerating = BodyWrench {
            moment: self.tensor * angular + h.cross(linear),
            force: linear * self.mass_kg - h.cross(angular),
        };
        accelerating.plus(self.velocity_wrench(motion.angular_velocity))
    }

    /// The part of this wrench that depends on the angular velocity.
    #[inline(always)]
    pub(crate) fn velocity_wrench(&self, turning: PaddedVector) -> BodyWrench {
        BodyWrench {
            moment: turning.cross(self.tensor * turning),
            force: turning.cross(turning.cross(self.first_moment)),
        }
    }
}

impl From<&SpatialInertia> for BodyInertia {
    fn from(inertia: &SpatialInertia) -> Self {
        Self {
            mass_kg: inertia.mass_kg,
            first_moment: inertia.first_moment_kg_m.into(),
            tensor: inertia.tensor_kg_m2.into(),
        }
    }
}
