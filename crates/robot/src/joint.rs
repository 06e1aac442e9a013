//! Joints: kind of motion, axis, limits. `tree.rs` builds the tree of them.

use congruent_input::{SiUnit, serde_name};
use nalgebra::{Isometry3, Unit, Vector3};
use schemars::JsonSchema;
use serde::Serialize;

use super::{
    joint_limit::JointLimit,
    link::LinkIndex,
    rounding::{JointRounding, JointValueRounding},
};

/// How much faster than its limit an actuator may drive a joint, as a share of the limit.
pub const SPEED_MARGIN: f64 = 1e-3;

/// Position of a joint in [`Robot::joints`](crate::Robot::joints).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct JointIndex(pub(crate) usize);

impl JointIndex {
    /// The index as a number, for addressing arrays laid out like [`Robot::joints`](crate::Robot::joints).
    pub fn get(self) -> usize {
        self.0
    }
}

/// How a joint moves its child link.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum JointKind {
    /// The child does not move against the parent.
    Fixed,
    /// A turn about the axis, within limits; its coordinate is in radians.
    Revolute,
    /// A turn about the axis without limits; its coordinate is in radians.
    Continuous,
    /// A shift along the axis, within limits; its coordinate is in metres.
    Prismatic,
}

impl JointKind {
    /// The name in URDF.
    pub fn name(self) -> &'static str {
        serde_name(&self)
    }

    /// Whether the joint has a coordinate.
    pub fn is_movable(self) -> bool {
        self != Self::Fixed
    }

    /// Whether the coordinate is an angle.
    pub fn is_angular(self) -> bool {
        matches!(self, Self::Revolute | Self::Continuous)
    }

    /// The unit of the coordinate: `rad` or `m`, empty for a fixed joint.
    pub fn unit(self) -> &'static str {
        self.si_unit().symbol()
    }

    /// The same as a type; a fixed joint has a ratio.
    pub fn si_unit(self) -> SiUnit {
        match self {
            Self::Fixed => SiUnit::Ratio,
            Self::Revolute | Self::Continuous => SiUnit::Radian,
            Self::Prismatic => SiUnit::Metre,
        }
    }
}

/// A joint whose position follows another: `q = multiplier * q_master + offset`.
///
/// Chains of mimic joints are resolved when the robot is built, so `master` never mimics.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mimic {
    /// The joint that is followed.
    pub master: JointIndex,
    /// Ratio of this joint's position to the master's.
    pub multiplier: f64,
    /// Position of this joint if the master is at zero.
    pub offset: f64,
}

/// One joint of a [`Robot`](crate::Robot).
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Name, unique in the robot.
    pub name: String,
    /// The kind of motion between parent and child.
    pub kind: JointKind,
    /// The link nearer to the root.
    pub parent: LinkIndex,
    /// The link that it carries.
    pub child: LinkIndex,
    /// Pose of the joint frame (and of the child link at position zero) in the parent link.
    pub parent_from_joint: Isometry3<f64>,
    /// Axis of motion in the joint frame; of no meaning for a fixed joint.
    pub axis_in_joint: Unit<Vector3<f64>>,
    /// Limits, if the description gives them.
    pub limit: Option<JointLimit>,
    /// Viscous damping, N m s/rad or N s/m.
    pub damping: f64,
    /// Dry friction, N m or N.
    pub friction: f64,
    /// Inertia of motor and gear as the joint feels it, kg m^2 or kg; `None` if the format cannot state it, as URDF, which is
    /// not zero.
    pub armature: Option<f64>,
    /// Set if the joint follows another.
    pub mimic: Option<Mimic>,
    /// How far origin and axis may be from the truth because of the digits that they are written with.
    pub rounding: JointRounding,
    /// The same of its limits and losses.
    pub value_rounding: JointValueRounding,
}

impl Joint {
    /// The closed range of positions, if the joint has one.
    pub fn position_range(&self) -> Option<(f64, f64)> {
        let limit = self.limit.filter(|_| matches!(self.kind, JointKind::Revolute | JointKind::Prismatic))?;
        Some((limit.lower, limit.upper))
    }

    /// The largest distance from its position 0 to which a joint slides, m: 0 if it does not, infinite without a range.
    pub fn largest_shift_m(&self) -> f64 {
        match (self.kind, self.position_range()) {
            (JointKind::Prismatic, Some((lower, upper))) => lower.abs().max(upper.abs()),
            (JointKind::Prismatic, None) => f64::INFINITY,
            _ => 0.0,
        }
    }
}

/// A joint before its robot exists: links and mimicked joint by name, the rest as in [`Joint`].
#[derive(Debug, Clone)]
pub struct JointParts {
    /// All that needs no other joint or link; its `parent`, `child` and `mimic` are overwritten.
    pub joint: Joint,
    /// Name of the parent link.
    pub parent: String,
    /// Name of the child link.
    pub child: String,
    /// Name of the mimicked joint, multiplier, offset.
    pub mimic: Option<(String, f64, f64)>,
}

impl JointParts {
    /// A joint between two links, about or along the z axis of its frame, without limits and losses.
    ///
    /// # Examples
    /// ```
    /// use congruent_description::{JointKind, JointParts, Link, Robot};
    /// use nalgebra::Isometry3;
    ///
    /// let link = |name: &str| Link { name: name.into(), ..Link::default() };
    /// let flange = JointParts::new("flange", JointKind::Fixed, "arm", "tool", Isometry3::translation(0.0, 0.0, 0.1));
    /// assert_eq!(Robot::new("short", vec![link("arm"), link("tool")], vec![flange])?.dof(), 0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(
        name: &str,
        kind: JointKind,
        parent: &str,
        child: &str,
        parent_from_joint: Isometry3<f64>,
    ) -> Self {
        let joint = Joint {
            name: name.to_owned(),
            kind,
            // Overwritten when the tree is built.
            parent: LinkIndex(0),
            child: LinkIndex(0),
            parent_from_joint,
            axis_in_joint: Vector3::z_axis(),
            limit: None,
            damping: 0.0,
            friction: 0.0,
            armature: None,
            mimic: None,
            rounding: JointRounding::default(),
            value_rounding: JointValueRounding::default(),
        };
        Self { joint, parent: parent.to_owned(), child: child.to_owned(), mimic: None }
    }
}
