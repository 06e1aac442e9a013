//! The axes of a chain as lines or directions, and the errors of joints that fit no row.

use nalgebra::Vector3;

use crate::{chain::screws::chain::ScrewChain, spatial::twist::Twist};

/// The reason why a chain has no Denavit-Hartenberg table. Joints are counted from 0, base to tip.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DeriveError {
    /// A table has at least one row.
    #[error("the chain has no moving joint")]
    NoJoint,
    /// A joint moves nothing.
    #[error("the variable of joint {joint} moves nothing")]
    Motionless {
        /// Index of the joint, from 0.
        joint: usize,
    },
    /// A joint moves more or less than its variable says, which no row can express.
    #[error(
        "joint {joint} moves by {ratio} units per unit of its variable, but a DH row can only express a ratio of 1"
    )]
    Ratio {
        /// Index of the joint, from 0.
        joint: usize,
        /// Motion per unit of the variable.
        ratio: f64,
    },
    /// A joint turns and shifts at once.
    #[error("joint {joint} is a screw of pitch {pitch_m_per_rad} m/rad, but a row either turns or shifts")]
    Helical {
        /// Index of the joint, from 0.
        joint: usize,
        /// Shift along the axis per turn.
        pitch_m_per_rad: f64,
    },
}

impl DeriveError {
    /// The joint at fault, if it is a joint.
    pub fn joint(&self) -> Option<usize> {
        match *self {
            Self::NoJoint => None,
            Self::Motionless { joint } | Self::Ratio { joint, .. } | Self::Helical { joint, .. } => {
                Some(joint)
            }
        }
    }
}

/// A directed line in the base frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct AxisLine {
    pub(super) point: Vector3<f64>,
    pub(super) direction: Vector3<f64>,
}

impl AxisLine {
    /// The point of the line nearest to another one.
    pub(super) fn nearest_to(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.point + self.direction * (point - self.point).dot(&self.direction)
    }
}

/// The motion of a joint, as an axis in the base frame.
#[derive(Debug, Clone, Copy)]
pub(super) enum MotionAxis {
    /// A turn about a line.
    Turn(AxisLine),
    /// A shift along a direction; its line may lie anywhere.
    Slide(Vector3<f64>),
}

impl MotionAxis {
    pub(super) fn direction(&self) -> Vector3<f64> {
        match self {
            Self::Turn(line) => line.direction,
            Self::Slide(direction) => *direction,
        }
    }
}

/// All axes of a chain at position zero; `accuracy` is how far a joint may be from a plain turn or shift.
pub(super) fn axes(chain: &ScrewChain, accuracy: f64) -> Result<Vec<MotionAxis>, DeriveError> {
    if chain.twists_in_base.is_empty() {
        return Err(DeriveError::NoJoint);
    }
    chain.twists_in_base.iter().enumerate().map(|(joint, twist)| axis(joint, twist, accuracy)).collect()
}

fn axis(joint: usize, twist: &Twist, accuracy: f64) -> Result<MotionAxis, DeriveError> {
    // A zero angular part is a pure shift. Otherwise the pitch w . v / w^2 must be zero, and the point of the axis nearest to
    // the origin is w x v / w^2 (Lynch & Park, sec. 3.3.2).
    let (turn, shift) = (twist.angular.norm(), twist.linear.norm());
    let ratio = if turn > accuracy { turn } else { shift };
    if ratio <= accuracy {
        return Err(DeriveError::Motionless { joint });
    }
    if (ratio - 1.0).abs() > accuracy {
        return Err(DeriveError::Ratio { joint, ratio });
    }
    if turn <= accuracy {
        return Ok(MotionAxis::Slide(twist.linear / shift));
    }
    let direction = twist.angular / turn;
    let pitch_m_per_rad = direction.dot(&twist.linear) / turn;
    if pitch_m_per_rad.abs() > accuracy {
        return Err(DeriveError::Helical { joint, pitch_m_per_rad });
    }
    Ok(MotionAxis::Turn(AxisLine { point: direction.cross(&twist.linear) / turn, direction }))
}
