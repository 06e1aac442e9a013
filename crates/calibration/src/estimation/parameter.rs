//! One correction: a twist between two joints, and what people call it.

use congruent_kinematics::Twist;

/// What a correction changes.
///
/// The order is that of preference: where measurements cannot tell two corrections apart, the one
/// that comes first here is estimated, and the other is fixed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Entry {
    /// The zero of a joint: what its coordinate reads where it should read nothing.
    Zero,
    /// A table's `theta`, by the table's sign.
    Theta,
    /// A table's `d`.
    D,
    /// A table's `a`.
    A,
    /// A table's `alpha`.
    Alpha,
    /// A turn about y beside `alpha`, for axes so nearly parallel that `theta`, `d` and `a` cannot
    /// express it. Source: Hayati, *Robot arm geometric link parameter estimation* (1983).
    Beta,
    /// A shift of a joint's axis across itself.
    AxisShift,
    /// A tilt of a joint's axis.
    AxisTilt,
    /// The tool in the tip.
    Tool,
    /// The base.
    Base,
}

/// A twist that turns less per unit is a shift whose turn is rounding. Kind: rounding; a probed
/// sliding joint turns by less than 1e-15.
const TURNS_ABOVE: f64 = 1e-9;

/// Whether a twist turns; otherwise it shifts.
pub(super) fn turns(twist: &Twist) -> bool {
    twist.angular.norm() > TURNS_ABOVE
}

/// The unit of a correction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ParameterUnit {
    /// Radians.
    Angle,
    /// Metres.
    Length,
}

/// One correction of a chain.
///
/// | field | shape | unit | frame |
/// |---|---|---|---|
/// | `slot` | 1 | | 0 before the first joint, k behind joint k |
/// | `generator_in_base` | 6 | 1 per unit of the correction | base, at configuration zero |
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Unique, `<joint>.<entry>` or `base.<axis>` or `tool.<axis>`.
    pub name: String,
    /// What it changes.
    pub entry: Entry,
    /// Between which joints it is inserted.
    pub slot: usize,
    /// What one unit of it does.
    pub generator_in_base: Twist,
}

impl Parameter {
    /// The unit of the correction: that of a shift where nothing turns.
    pub fn unit(&self) -> ParameterUnit {
        if turns(&self.generator_in_base) { ParameterUnit::Angle } else { ParameterUnit::Length }
    }
}
