//! The quantities and SI units that reports of runs name: checks, faults and actuators use the same words.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::written::name::serde_name;

/// What a value of a report is; its unit is a [`SiUnit`] beside it. Reports write the name in snake case.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Distance between two origins, m.
    Position,
    /// Angle between two orientations, rad.
    Orientation,
    /// Distance between two shapes, m; negative for an overlap.
    Distance,
    /// Normal force between a link and an obstacle, N.
    ContactForce,
    /// How far an angular joint is beyond its range, rad; negative inside.
    AngleBeyondLimit,
    /// How far a prismatic joint is beyond its range, m; negative inside.
    ShiftBeyondLimit,
    /// How far an angular joint that rests on its stop is beyond its range, rad.
    AngleIntoStop,
    /// How far a prismatic joint that rests on its stop is beyond its range, m.
    ShiftIntoStop,
    /// How far the setpoint of an angular joint that is held by its stop is beyond the range, rad.
    AngleOfSetpointBeyondLimit,
    /// How far the setpoint of a prismatic joint that is held by its stop is beyond the range, m.
    ShiftOfSetpointBeyondLimit,
    /// Speed of a joint as a share of its velocity limit.
    ShareOfVelocityLimit,
    /// Effort of a joint as a share of its effort limit.
    ShareOfEffortLimit,
    /// Deviation of an angular joint from its setpoint at any time, rad.
    PathErrorOfAngle,
    /// Deviation of a prismatic joint from its setpoint at any time, m.
    PathErrorOfShift,
    /// Deviation of the TCP from its setpoint at any time, m.
    PathErrorOfTcp,
    /// Deviation of an angular joint from its setpoint at the end, rad.
    GoalErrorOfAngle,
    /// Deviation of a prismatic joint from its setpoint at the end, m.
    GoalErrorOfShift,
    /// Deviation of the TCP from its setpoint at the end, m.
    GoalErrorOfTcp,
    /// Travel of a joint as a share of the travel of its setpoint.
    ShareOfTravel,
    /// How far an angular joint passes its goal, rad.
    OvershootOfAngle,
    /// How far a prismatic joint passes its goal, m.
    OvershootOfShift,
    /// Time from the end of a motion to rest, s.
    SettlingTime,
    /// Time from the start to the end of all motions, s.
    CycleTime,
    /// Speed of a point, m/s.
    Velocity,
    /// Angular speed of a link, rad/s.
    AngularVelocity,
    /// Distance of the two frames of a joint in a direction in which it cannot move, m.
    JointOffset,
    /// Angle between the two frames of a joint about a direction in which it cannot turn, rad.
    JointTilt,
    /// Deviation of a rotation matrix from orthonormal columns.
    OrthonormalityError,
    /// Deviation of the determinant of a rotation matrix from 1.
    DeterminantError,
    /// Number of values that are NaN or infinite.
    NotFiniteValues,
    /// Deviation of the accelerations from the equation of motion, relative to the largest ones.
    AccelerationError,
    /// Deviation of the energy from the power of the actuators, relative to the largest one.
    EnergyError,
    /// Difference of delivered and commanded effort, relative to the commanded one.
    EffortError,
    /// Part of the variance of recorded efforts that the description does not explain.
    UnexplainedShare,
    /// Distance of a point from the mean of its places, m.
    PointSpread,
    /// Share of the instants of a log at which every joint is known.
    UsedShare,
    /// Longest time between two samples of a log, s.
    LongestGap,
    /// Difference from 1 of the factor between reported velocities and the change of the positions.
    VelocityFactorError,
    /// Jump of the zero of an angular joint, rad.
    JumpOfAngle,
    /// Jump of the zero of a prismatic joint, m.
    JumpOfShift,
    /// A constant error of an encoder, rad or m.
    Offset,
    /// An error of an encoder that grows with time, rad/s or m/s.
    Rate,
    /// A factor or a probability.
    Share,
    /// A delay, s.
    Time,
    /// Dry friction of a joint, N m or N.
    Dry,
    /// Viscous friction of a joint, N m s/rad or N s/m.
    Viscous,
    /// Mass, kg.
    Mass,
    /// First coordinate of a position, m.
    X,
    /// Second coordinate of a position, m.
    Y,
    /// Third coordinate of a position, m.
    Z,
    /// Turn about the fixed x axis, rad.
    Roll,
    /// Turn about the fixed y axis, rad.
    Pitch,
    /// Turn about the fixed z axis, rad.
    Yaw,
}

impl Quantity {
    /// The name in reports.
    pub fn name(self) -> &'static str {
        serde_name(&self)
    }

    /// Whether the quantity is of the TCP, so that its subject is a link and not a joint.
    pub fn is_of_tcp(self) -> bool {
        matches!(self, Self::PathErrorOfTcp | Self::GoalErrorOfTcp)
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// An SI unit of a value in a report.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum SiUnit {
    /// No unit: a ratio or a count.
    #[serde(rename = "")]
    Ratio,
    /// Metre.
    #[serde(rename = "m")]
    Metre,
    /// Radian.
    #[serde(rename = "rad")]
    Radian,
    /// Second.
    #[serde(rename = "s")]
    Second,
    /// Kilogram.
    #[serde(rename = "kg")]
    Kilogram,
    /// Metre per second.
    #[serde(rename = "m/s")]
    MetrePerSecond,
    /// Radian per second.
    #[serde(rename = "rad/s")]
    RadianPerSecond,
    /// Metre per second squared.
    #[serde(rename = "m/s^2")]
    MetrePerSecondSquared,
    /// Radian per second squared.
    #[serde(rename = "rad/s^2")]
    RadianPerSecondSquared,
    /// Metre per second cubed.
    #[serde(rename = "m/s^3")]
    MetrePerSecondCubed,
    /// Radian per second cubed.
    #[serde(rename = "rad/s^3")]
    RadianPerSecondCubed,
    /// Kilogram square metre.
    #[serde(rename = "kg m^2")]
    KilogramSquareMetre,
    /// Newton.
    #[serde(rename = "N")]
    Newton,
    /// Newton metre.
    #[serde(rename = "N m")]
    NewtonMetre,
    /// Newton second per metre.
    #[serde(rename = "N s/m")]
    NewtonSecondPerMetre,
    /// Newton metre second per radian.
    #[serde(rename = "N m s/rad")]
    NewtonMetreSecondPerRadian,
}

impl SiUnit {
    /// The symbol in reports; empty for a ratio.
    pub fn symbol(self) -> &'static str {
        serde_name(&self)
    }
}

impl fmt::Display for SiUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.symbol())
    }
}

#[cfg(test)]
mod tests {
    use serde::de::{IntoDeserializer, value::Error};

    use super::*;

    fn read<'de, T: Deserialize<'de>>(word: &'de str) -> Result<T, Error> {
        T::deserialize(word.into_deserializer())
    }

    #[test]
    fn words_are_read_as_they_are_written() {
        assert_eq!(read(Quantity::PathErrorOfTcp.name()), Ok(Quantity::PathErrorOfTcp));
        assert_eq!([Quantity::X.name(), Quantity::ShareOfEffortLimit.name()], ["x", "share_of_effort_limit"]);
        assert_eq!([SiUnit::Ratio, SiUnit::NewtonMetre].map(SiUnit::symbol), ["", "N m"]);
        assert_eq!(read(""), Ok(SiUnit::Ratio));
    }

    #[test]
    fn an_unknown_word_is_refused_by_name() {
        let message = read::<Quantity>("posture").unwrap_err().to_string();
        assert!(message.contains("`posture`"), "{message}");
        let message = read::<SiUnit>("furlong").unwrap_err().to_string();
        assert!(message.contains("`furlong`"), "{message}");
    }
}
