//! Joints of a body.

use nalgebra::{Point3, Unit, Vector3};

use super::{
    actuator::MjEffort,
    written::{MjName, MjNotation, MjPlace, MjWritten},
};

/// What a joint allows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MjJointKind {
    /// Turns about an axis.
    Hinge,
    /// Shifts along an axis.
    Slide,
    /// Turns about a point; it has no axis.
    Ball,
    /// Moves freely; only in a child of the world, without another joint.
    Free,
}

impl MjJointKind {
    /// Numbers that give its position: the orientation of a ball or a free joint is a quaternion.
    pub fn positions(self) -> usize {
        match self {
            Self::Hinge | Self::Slide => 1,
            Self::Ball => 4,
            Self::Free => 7,
        }
    }

    /// Degrees of freedom.
    pub fn degrees_of_freedom(self) -> usize {
        match self {
            Self::Hinge | Self::Slide => 1,
            Self::Ball => 3,
            Self::Free => 6,
        }
    }
}

/// A joint between a body and its parent. Several joints of a body act in their order, each in the frame that those before it
/// have moved. Positions are in rad for a hinge and in m for a slide; at position `reference` the body is where the file puts it.
#[derive(Debug, Clone, PartialEq)]
pub struct MjJoint {
    /// Name; `joint 2 of forearm` if the file has none.
    pub name: MjName,
    /// Its body.
    pub body: usize,
    /// What it allows.
    pub kind: MjJointKind,
    /// A point of the axis of a hinge, or the centre of a ball joint, m, in the body, frames included.
    pub pos_in_body: MjWritten<Point3<f64>>,
    /// Axis in the body, frames included; of no meaning for ball and free joints.
    pub axis_in_body: MjWritten<Unit<Vector3<f64>>>,
    /// Limits of the position, rad or m; `None` without limits. Of a ball joint the second is the largest angle.
    pub range: Option<MjWritten<[f64; 2]>>,
    /// `ref`: the position at the written pose, rad or m.
    pub reference: MjWritten<f64>,
    /// Damping by powers of the speed: `a v + b v |v| + c v^3`, N m s/rad or N s/m for the first.
    pub damping: MjWritten<[f64; 3]>,
    /// Dry friction, N m or N.
    pub friction_loss: MjWritten<f64>,
    /// Inertia that is added to the mass matrix, kg m^2 or kg.
    pub armature: MjWritten<f64>,
    /// Stiffness by powers of the displacement: `a x + b x^2 + c x^3`, N m/rad or N/m for the first.
    pub stiffness: MjWritten<[f64; 3]>,
    /// Position at which the spring is at rest, rad or m.
    pub spring_reference: MjWritten<f64>,
    /// `actuatorfrcrange`: limits of the sum of all actuators' efforts, N m or N; `None` without limits.
    pub actuator_force_range: Option<MjWritten<[f64; 2]>>,
    /// What its actuators can do together.
    pub effort: MjEffort,
    /// How its values are written.
    pub notation: MjNotation,
    /// The opening of its tag.
    pub place: MjPlace,
}
