//! What the axes do not determine, and what was taken.

use std::fmt;

use schemars::JsonSchema;
use serde::Serialize;

use super::{
    axis::MotionAxis,
    normal::{AxisRelation, CommonNormal},
};

/// One thing that the axes of a chain do not determine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Choice {
    /// Origin and x axis of frame 0.
    FirstFrame,
    /// Where the common normal of parallel axes lies.
    ParallelOrigin,
    /// The sense of the x axis if axes meet.
    NormalSense,
    /// Origin and x axis if two axes are one line.
    CoincidentFrame,
    /// Where the line of a prismatic joint lies.
    PrismaticLine,
    /// The frame of the last row.
    LastFrame,
}

impl fmt::Display for Choice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::FirstFrame => {
                "frame 0 stands on the first axis, origin nearest to the base's, x as near to the base's x \
                 as the axis allows; shifting or turning it along the axis moves d and theta of the first row"
            }
            Self::ParallelOrigin => {
                "the axes are parallel, every normal is common: the one at the origin before is taken (d = 0), \
                 the next row that is not free takes the sum of d"
            }
            Self::NormalSense => {
                "the axes meet, x may point either way: the sense nearer to the x axis before is taken; the \
                 other adds 180 deg to theta and to the next theta, and flips alpha"
            }
            Self::CoincidentFrame => {
                "the axes are one line, origin and x axis are free: those before are kept (d = 0, theta = 0)"
            }
            Self::PrismaticLine => {
                "only the direction of a prismatic joint counts, its line may lie anywhere: it is laid along \
                 the turning axis or tip that follows in its direction, otherwise through the origin before"
            }
            Self::LastFrame => {
                "the last frame is free up to its axis: it is laid along the normal to the tip's z axis, \
                 dhn_from_tip holds the rest"
            }
        })
    }
}

/// A choice at a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FreeChoice {
    /// The joint whose row (and the next one's) it touches, from 0.
    pub joint: usize,
    /// What was free.
    pub choice: Choice,
}

/// What is not determined between the axis of `joint` and the next one.
pub(super) fn undetermined(joint: usize, normal: &CommonNormal, next: &MotionAxis) -> Vec<FreeChoice> {
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
