//! One parameter of a corrected chain: a twist between two joints, with its name and unit.

use std::fmt;

use congruent_kinematics::Twist;
use schemars::JsonSchema;
use serde::Serialize;

/// What a correction changes.
///
/// The order is that of preference: if the measurements cannot distinguish two corrections, the one that
/// comes first here is estimated, and the other is fixed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum CorrectionEntry {
    /// The zero of a joint: what its coordinate reads at the model's zero.
    Zero,
    /// The table's entry that the joint's coordinate is added to: `theta` of a revolute row, `d` of a
    /// prismatic one.
    JointEntry,
    /// The other entry about the z axis: `d` of a revolute row, `theta` of a prismatic one.
    ConstantEntry,
    /// The link length `a` of a table's row.
    A,
    /// The link twist `alpha` of a table's row.
    Alpha,
    /// A rotation about y beside `alpha`, for axes so nearly parallel that `theta`, `d` and `a` cannot
    /// express it. Source: Hayati, *Robot arm geometric link parameter estimation* (1983).
    Beta,
    /// A shift of a joint's axis across itself.
    AxisShift,
    /// A tilt of a joint's axis.
    AxisTilt,
    /// Pose of the tool in the last link.
    Tool,
    /// Pose of the base.
    Base,
}

impl CorrectionEntry {
    /// Whether it is of base or tool, and not of the arm.
    pub fn is_of_frame(self) -> bool {
        matches!(self, Self::Base | Self::Tool)
    }
}

/// A twist with less rotation per unit counts as a pure translation. Unit: rad per unit; kind: rounding; an identified sliding
/// joint rotates by less than 1e-15.
const ROTATES_ABOVE: f64 = 1e-9;

/// Whether a twist rotates; otherwise it is a pure translation.
pub(super) fn rotates(twist: &Twist) -> bool {
    twist.angular.norm() > ROTATES_ABOVE
}

/// The unit of a correction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub enum ParameterUnit {
    /// An angle, in radians.
    #[serde(rename = "rad")]
    Angle,
    /// A length, in metres.
    #[serde(rename = "m")]
    Length,
}

impl ParameterUnit {
    /// A value in degrees or millimetres, as people read it and as a robot file may have it.
    pub fn for_people(self, value: f64) -> f64 {
        match self {
            Self::Angle => value * 1_f64.to_degrees(),
            Self::Length => value * 1e3,
        }
    }

    /// The name of the unit of [`ParameterUnit::for_people`], also the suffix of its keys in a robot file.
    pub fn name_for_people(self) -> &'static str {
        match self {
            Self::Angle => "deg",
            Self::Length => "mm",
        }
    }
}

impl fmt::Display for ParameterUnit {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(formatter)
    }
}

/// One parameter of a corrected chain.
///
/// | field | shape | unit | frame |
/// |---|---|---|---|
/// | `slot` | 1 | | 0 before the first joint, k behind joint k |
/// | `generator_in_base` | 6 | 1 per unit of the correction | base, at configuration zero |
#[derive(Debug, Clone, PartialEq)]
pub struct CorrectionParameter {
    /// Unique, `<joint>.<entry>` or `base.<axis>` or `tool.<axis>`.
    pub name: String,
    /// The quantity of the model that it changes.
    pub entry: CorrectionEntry,
    /// Index in the chain of the joint whose zero, table row or axis it changes; `None` for base and tool.
    pub joint: Option<usize>,
    /// Between which joints it is inserted.
    pub slot: usize,
    /// Twist of everything behind it per unit of the correction.
    pub generator_in_base: Twist,
}

impl CorrectionParameter {
    /// The unit of the correction: an angle if its twist rotates, otherwise a length.
    pub fn unit(&self) -> ParameterUnit {
        if rotates(&self.generator_in_base) { ParameterUnit::Angle } else { ParameterUnit::Length }
    }
}
