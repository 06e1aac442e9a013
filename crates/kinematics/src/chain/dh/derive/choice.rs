//! The properties of a table that the axes do not determine, and how they are chosen.

use std::fmt;

use schemars::JsonSchema;
use serde::Serialize;

use super::{
    axis::MotionAxis,
    normal::{AxisRelation, CommonNormal},
};

/// A property of a table that the axes of a chain do not determine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Choice {
    /// Origin and x axis of frame 0.
    FirstFrame,
    /// Position of the common normal of parallel axes.
    ParallelOrigin,
    /// Sense of the x axis if two axes meet.
    NormalSense,
    /// Origin and x axis if two axes are one line.
    CoincidentFrame,
    /// Position of the line of a prismatic joint.
    PrismaticLine,
    /// Origin and x axis of the frame of the last row.
    LastFrame,
}

impl fmt::Display for Choice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::FirstFrame => {
                "frame 0 is on the first axis, its origin nearest to the base's origin and its x axis nearest to the base's \
                 x axis; shifting or turning it along the axis changes d and theta of the first row"
            }
            Self::ParallelOrigin => {
                "the axes are parallel, so the position of their common normal is free: it is put at the previous origin \
                 (d = 0), and the next row whose d is determined gets the sum"
            }
            Self::NormalSense => {
                "the axes intersect, so the sense of x is free: the sense nearer to the previous x axis is chosen; the \
                 other one adds 180 deg to theta and to the next theta, and changes the sign of alpha"
            }
            Self::CoincidentFrame => {
                "the axes coincide, so origin and x axis are free: the previous ones are kept (d = 0, theta = 0)"
            }
            Self::PrismaticLine => {
                "only the direction of a prismatic joint counts, so the position of its line is free: it is put on a \
                 parallel revolute axis (or tip) that follows, otherwise through the previous origin"
            }
            Self::LastFrame => {
                "the position of the last frame along its axis is free: its x axis is put on the common normal to the tip's \
                 z axis, and dhn_from_tip holds the rest"
            }
        })
    }
}

/// A property that was chosen for a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FreeChoice {
    /// The joint whose row (and the next one's) it touches, from 0.
    pub joint: usize,
    /// The property that was chosen.
    pub choice: Choice,
}

/// The properties that are not determined between the axis of `joint` and the next one.
pub(super) fn undetermined(joint: usize, normal: &CommonNormal, next: &MotionAxis) -> Vec<FreeChoice> {
    // Only skew axes have a unique common normal with a unique sense.
    let by_relation = match normal.relation {
        AxisRelation::Skew => None,
        AxisRelation::Intersecting => Some(Choice::NormalSense),
        AxisRelation::Parallel | AxisRelation::AntiParallel => Some(Choice::ParallelOrigin),
        AxisRelation::Coincident => Some(Choice::CoincidentFrame),
    };
    let by_kind = matches!(next, MotionAxis::Slide(_))
        .then_some(FreeChoice { joint: joint + 1, choice: Choice::PrismaticLine });
    by_relation.map(|choice| FreeChoice { joint, choice }).into_iter().chain(by_kind).collect()
}
