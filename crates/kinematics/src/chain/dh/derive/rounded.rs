//! Axes that are parallel, intersecting or coincident except for the digits of a file: replaced by axes that are exactly so, with
//! the deviation.
//!
//! A quarter turn that is written with few digits makes axes nearly parallel, whose common normal then lies kilometres away.
//! The table of such axes is exact but useless.

use nalgebra::Vector3;

use super::{
    axis::{self, AxisLine, DeriveError, MotionAxis},
    derivation::PARALLEL_PART,
    normal::AxisRelation,
};
use crate::{chain::screws::chain::ScrewChain, spatial::twist::Twist};

/// Largest angle that is taken as rounding. Kind: digits of a file; a quarter turn written 1.5707 is 9.6e-5 rad
/// off, and two of them add up to 1.9e-4.
pub const ROUNDED_RAD: f64 = 2e-4;
/// Largest distance that is taken as rounding. Kind: digits of a file; half of 0.1 mm, the last digit of data
/// sheets, and 1.5707 for a quarter turn displaces an axis by less over 0.5 m.
pub const ROUNDED_M: f64 = 5e-5;
/// Distances up to this are left in the table. Kind: rounding of a dozen products in double precision, 6e-13 m in
/// the worst of the public robots; unlike a small angle, a small distance makes no value of the table large.
const NOISE_M: f64 = 1e-11;

/// Two consecutive axes that were replaced by exactly parallel, intersecting or coincident ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoundedPair {
    /// Index of the joint of the first axis, from 0; the axis of the next joint was moved.
    pub joint: usize,
    /// The exact relation that they have now.
    pub relation: AxisRelation,
    /// Angle by which they deviated from it, rad.
    pub angle_rad: f64,
    /// Distance by which they deviated from it, m.
    pub distance_m: f64,
}

/// The chain in which consecutive axes that are nearly parallel, intersecting or coincident are exactly so, and the pairs that
/// were changed. Each axis is moved to match the one before it, about its joint's origin.
///
/// | value | shape | unit | frame |
/// |---|---|---|---|
/// | `chain` | n screws | | base |
/// | `origins_in_base` | n points | m | base; one on each axis, which stays where it is if the axis is turned |
/// | `accuracy` | 1 | rad, m | as of [`derive_dh`](super::derive_dh): what is within a tenth of it is not moved |
///
/// # Errors
/// [`DeriveError`] for a joint that fits no row, and for a chain without a moving joint.
pub fn without_rounding(
    chain: &ScrewChain,
    origins_in_base: &[Vector3<f64>],
    accuracy: f64,
) -> Result<(ScrewChain, Vec<RoundedPair>), DeriveError> {
    let mut axes = axis::axes(chain, accuracy)?;
    let (mut twists, mut pairs) = (chain.twists_in_base.clone(), Vec::new());
    for joint in 1..axes.len() {
        if let (MotionAxis::Turn(line), Some(origin)) = (&mut axes[joint], origins_in_base.get(joint)) {
            // About a point far from its joint even a small turn would displace the axis where the robot is.
            line.point = line.nearest_to(origin);
        }
        let found = Deviation::between(&axes[joint - 1], &axes[joint]);
        let smallest = accuracy * PARALLEL_PART;
        if found.angle_rad > smallest || found.distance_m > smallest.max(NOISE_M) {
            // The next axis is compared with this one as corrected: of three nearly parallel axes all become
            // parallel.
            axes[joint] = found.corrected;
            twists[joint] = twist(&found.corrected);
            let Deviation { relation, angle_rad, distance_m, .. } = found;
            pairs.push(RoundedPair { joint: joint - 1, relation, angle_rad, distance_m });
        }
    }
    Ok((ScrewChain { twists_in_base: twists, ..chain.clone() }, pairs))
}

/// Deviation of an axis from an exact relation to the axis before (0 if it is near none), and the corrected axis.
struct Deviation {
    relation: AxisRelation,
    angle_rad: f64,
    distance_m: f64,
    corrected: MotionAxis,
}

impl Deviation {
    fn between(before: &MotionAxis, axis: &MotionAxis) -> Self {
        // The angle is removed first: for parallel axes the offset is measured across them, for others along their common
        // normal, so its meaning depends on that decision.
        let (z, direction) = (before.direction(), axis.direction());
        let (across, cosine) = (z.cross(&direction), z.dot(&direction));
        let angle_rad = across.norm();
        let is_parallel = angle_rad <= ROUNDED_RAD;
        let direction = if is_parallel { z * cosine.signum() } else { direction };
        let by_sense = if cosine > 0.0 { AxisRelation::Parallel } else { AxisRelation::AntiParallel };
        let relation = if is_parallel { by_sense } else { AxisRelation::Skew };
        let angle_rad = if is_parallel { angle_rad } else { 0.0 };
        // Of a shift only the direction counts: there is no distance to measure.
        let (MotionAxis::Turn(first), MotionAxis::Turn(second)) = (before, axis) else {
            let corrected = match axis {
                MotionAxis::Turn(line) => MotionAxis::Turn(AxisLine { direction, ..*line }),
                MotionAxis::Slide(_) => MotionAxis::Slide(direction),
            };
            return Self { relation, angle_rad, distance_m: 0.0, corrected };
        };
        let point = second.point;
        let apart = point - first.point;
        let offset = if is_parallel {
            apart - z * apart.dot(&z)
        } else {
            across * (apart.dot(&across) / across.norm_squared())
        };
        let distance_m = offset.norm();
        // Two lines apart: only the direction was rounded.
        if distance_m > ROUNDED_M {
            let corrected = MotionAxis::Turn(AxisLine { point, direction });
            return Self { relation, angle_rad, distance_m: 0.0, corrected };
        }
        let relation = if is_parallel { AxisRelation::Coincident } else { AxisRelation::Intersecting };
        let corrected = MotionAxis::Turn(AxisLine { point: point - offset, direction });
        Self { relation, angle_rad, distance_m, corrected }
    }
}

fn twist(axis: &MotionAxis) -> Twist {
    match axis {
        MotionAxis::Turn(line) => {
            Twist { angular: line.direction, linear: line.point.cross(&line.direction) }
        }
        MotionAxis::Slide(direction) => Twist { angular: Vector3::zeros(), linear: *direction },
    }
}
