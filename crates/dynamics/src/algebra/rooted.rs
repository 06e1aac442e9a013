//! Bodies in the axes of the root, each about its own origin: inertias and wrenches of a subtree add up without rotations, and
//! only a shift along the arm is needed between a body and its parent.

#![expect(clippy::inline_always, reason = "what is not inlined is compiled for the narrowest vectors")]

use congruent_kinematics::SinCos;

use crate::algebra::{
    columns::{Block, PaddedVector},
    rigid::{BodyInertia, BodyTwist, BodyWrench, JointFrame, Placement},
};

/// Pose of a body: axes, and the offset from its parent, in the axes of the root.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RootedBody {
    /// Axes of the body.
    pub(crate) axes: Block,
    /// Origin of the body, from that of its parent.
    pub(crate) offset: PaddedVector,
}

/// Inertia of a body whose moving children are free to accelerate: wrench for an acceleration, as three blocks of a
/// symmetric 6 x 6 matrix.
///
/// Source: Featherstone, *Rigid Body Dynamics Algorithms* (2008), section 7.2.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ArticulatedInertia {
    /// Moment for an angular acceleration.
    angular: Block,
    /// Force for an angular acceleration; its transpose is moment for a linear acceleration.
    coupling: Block,
    /// Force for a linear acceleration.
    linear: Block,
}

impl RootedBody {
    pub(crate) const NONE: Self = Self { axes: Block::ZERO, offset: PaddedVector::ZERO };

    /// The axis of the body's joint.
    #[inline(always)]
    pub(crate) fn axis(&self) -> PaddedVector {
        self.axes.0[2]
    }

    /// A wrench about the origin of the parent.
    #[inline(always)]
    pub(crate) fn wrench_on_parent(&self, wrench: &BodyWrench) -> BodyWrench {
        BodyWrench { moment: wrench.moment + self.offset.cross(wrench.force), force: wrench.force }
    }

    /// The acceleration of the body's origin by the motion of its parent.
    #[inline(always)]
    pub(crate) fn carried(&self, parent: &BodyTwist) -> BodyTwist {
        BodyTwist { angular: parent.angular, linear: parent.linear + parent.angular.cross(self.offset) }
    }
}

impl JointFrame {
    /// The joint's body in the axes of the root, from the axes of its parent.
    #[inline(always)]
    pub(crate) fn rooted(&self, parent_axes: Option<&Block>, q: f64, turn: &SinCos) -> RootedBody {
        // The turn first: it waits for no parent. A closure would be compiled for the narrowest vectors.
        let Placement { rotation, origin } = self.placement(q, turn);
        if let Some(parent) = parent_axes {
            RootedBody { axes: parent.times(&rotation), offset: *parent * origin }
        } else {
            RootedBody { axes: rotation, offset: origin }
        }
    }

    /// The component of a wrench along the joint's motion, for a given axis.
    #[inline(always)]
    pub(crate) fn along(&self, axis: PaddedVector, wrench: &BodyWrench) -> f64 {
        axis.dot(if self.turns { wrench.moment } else { wrench.force })
    }

    /// The velocity products of the joint, by the angular velocity of its parent.
    ///
    /// Source: Luh, Walker, Paul (1980), with the acceleration of the point at the frame's origin.
    #[inline(always)]
    pub(crate) fn velocity_products(
        &self,
        body: &RootedBody,
        parent_turning: PaddedVector,
        qd: f64,
    ) -> BodyTwist {
        let turning = parent_turning;
        let centripetal = turning.cross(turning.cross(body.offset));
        let crossed = turning.cross(body.axis() * qd);
        if self.turns {
            BodyTwist { angular: crossed, linear: centripetal }
        } else {
            BodyTwist { angular: PaddedVector::ZERO, linear: centripetal + crossed * 2.0 }
        }
    }
}

impl BodyInertia {
    /// In other axes: those of the root, if `axes` are the body's.
    #[inline(always)]
    pub(crate) fn turned(&self, axes: &Block) -> Self {
        Self {
            mass_kg: self.mass_kg,
            first_moment: *axes * self.first_moment,
            tensor: self.tensor.turned(axes),
        }
    }

    /// The wrench of a unit acceleration of a joint along its axis.
    #[inline(always)]
    pub(crate) fn accelerated_along(&self, axis: PaddedVector, joint: &JointFrame) -> BodyWrench {
        let h = self.first_moment;
        if joint.turns {
            BodyWrench { moment: self.tensor * axis, force: axis.cross(h) }
        } else {
            BodyWrench { moment: h.cross(axis), force: axis * self.mass_kg }
        }
    }

    /// The same body with a child whose origin is `offset` away.
    #[inline(always)]
    pub(crate) fn with_child(&self, child: &Self, offset: PaddedVector) -> Self {
        let by_mass = offset * child.mass_kg;
        // `-[p][b] - [b][p]` for `b = h + m p / 2`, as in `SpatialInertia::transformed_by`.
        let b = child.first_moment + by_mass * 0.5;
        let shifted = Block::diagonal(2.0 * offset.dot(b)).minus_outer(offset, b).minus_outer(b, offset);
        Self {
            mass_kg: self.mass_kg + child.mass_kg,
            first_moment: self.first_moment + child.first_moment + by_mass,
            tensor: self.tensor + child.tensor + shifted,
        }
    }
}

impl ArticulatedInertia {
    pub(crate) const ZERO: Self = Self { angular: Block::ZERO, coupling: Block::ZERO, linear: Block::ZERO };

    #[inline(always)]
    pub(crate) fn from_rigid(inertia: &BodyInertia) -> Self {
        Self {
            angular: inertia.tensor,
            // f = m v - h x w, so the block that takes w to forces is -[h].
            coupling: Block::cross_matrix(-inertia.first_moment),
            linear: Block::diagonal(inertia.mass_kg),
        }
    }

    /// The wrench that gives a body this acceleration.
    #[inline(always)]
    pub(crate) fn wrench(&self, acceleration: &BodyTwist) -> BodyWrench {
        let BodyTwist { angular, linear } = *acceleration;
        BodyWrench {
            moment: self.angular * angular + self.coupling.transposed() * linear,
            force: self.coupling * angular + self.linear * linear,
        }
    }

    /// The wrench of a unit acceleration of a joint along its axis.
    #[inline(always)]
    pub(crate) fn accelerated_along(&self, axis: PaddedVector, joint: &JointFrame) -> BodyWrench {
        if joint.turns {
            BodyWrench { moment: self.angular * axis, force: self.coupling * axis }
        } else {
            BodyWrench { moment: self.coupling.transposed() * axis, force: self.linear * axis }
        }
    }

    /// Without the direction in which a joint yields: `I - U U' / d`; `scaled` is `U / d`.
    #[inline(always)]
    pub(crate) fn yielding(&self, along: &BodyWrench, scaled: &BodyWrench) -> Self {
        Self {
            angular: self.angular.minus_outer(along.moment, scaled.moment),
            coupling: self.coupling.minus_outer(along.force, scaled.moment),
            linear: self.linear.minus_outer(along.force, scaled.force),
        }
    }

    /// The same body with a child whose origin is `offset` away.
    #[inline(always)]
    pub(crate) fn with_child(&self, child: &Self, offset: PaddedVector) -> Self {
        // `K' = K - C [p]` and `A' = A + ([p] K)' + [p] K'`, as `[p]' = -[p]`.
        let coupling = child.coupling - child.linear.times_cross(offset);
        let shifted = child.coupling.crossed_by(offset).transposed() + coupling.crossed_by(offset);
        Self {
            angular: self.angular + (child.angular + shifted),
            coupling: self.coupling + coupling,
            linear: self.linear + child.linear,
        }
    }
}
