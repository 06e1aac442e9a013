//! The common normal of two axes in every case: skew, intersecting, parallel, anti-parallel, coincident.

use std::f64::consts::PI;

use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::Serialize;

use super::axis::AxisLine;
use crate::spatial::pose::Pose;

/// Below this offset the sense of the normal is chosen as if the axes met: smaller offsets come
/// from the digits of a file (1.5708 for a quarter turn is 3.7e-6 rad off), and their sign is noise.
/// The offset itself is kept.
const SENSE_M: f64 = 1e-6;

/// The relation of two axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum AxisRelation {
    /// Neither parallel nor meeting.
    Skew,
    /// They meet in one point.
    Intersecting,
    /// Parallel, with the same sense.
    Parallel,
    /// Parallel, with opposite senses.
    AntiParallel,
    /// One line, with the same or with opposite senses.
    Coincident,
}

/// The common normal from one axis to the next, with the four parameters that it gives.
#[derive(Debug, Clone, Copy)]
pub(super) struct CommonNormal {
    pub(super) relation: AxisRelation,
    pub(super) theta_rad: f64,
    pub(super) d_m: f64,
    pub(super) a_m: f64,
    pub(super) alpha_rad: f64,
}

/// The normal from the z axis of `base_from_here` to `next`.
///
/// | value | shape | unit | frame |
/// |---|---|---|---|
/// | `base_from_here` | SE(3) | m | frame on the axis, its x axis along the normal before |
/// | `next` | line | m | base |
/// | `parallel_rad` | 1 | rad, m | sine of the angle, and offset, below which axes count as parallel, as one |
///
/// Source: Spong, Hutchinson & Vidyasagar, *Robot Modeling and Control* (1st edition, 2006), section 3.2.2.
pub(super) fn between(base_from_here: &Pose, next: &AxisLine, parallel_rad: f64) -> CommonNormal {
    // Expressed in the frame itself the axis is z and the normal before is x, which removes half of the terms.
    let here_from_base = base_from_here.inverse();
    let direction = here_from_base.transform_vector(&next.direction);
    let point = here_from_base.rotation * next.point + here_from_base.translation;
    let across = Vector3::z().cross(&direction);
    let sine = across.norm();
    // First, since all below divides by the sine.
    if sine <= parallel_rad {
        return parallel(&direction, &point, parallel_rad);
    }
    let unit = across / sine;
    let offset_m = point.dot(&unit);
    // x points towards the next axis, so that a >= 0; if the axes meet, to the side of the x axis before, so that theta stays
    // within a quarter turn.
    let outward = if offset_m.abs() > SENSE_M { offset_m } else { unit.x };
    let sense = if outward < -SENSE_M { -1.0 } else { 1.0 };
    let x = unit * sense;
    let relation =
        if offset_m.abs() <= parallel_rad { AxisRelation::Intersecting } else { AxisRelation::Skew };
    CommonNormal {
        relation,
        theta_rad: libm::atan2(x.y, x.x),
        // Foot of the common normal on z: (p x w) . (z x w) / |z x w|^2, from p + t w = d z + a x.
        d_m: point.cross(&direction).dot(&across) / (sine * sine),
        a_m: offset_m * sense,
        alpha_rad: sense * libm::atan2(sine, direction.z),
    }
}

/// Every normal of parallel axes is common: the one at the origin is taken, so that `d = 0`.
fn parallel(direction: &Vector3<f64>, point: &Vector3<f64>, parallel_m: f64) -> CommonNormal {
    let is_same_sense = direction.z > 0.0;
    let alpha_rad = if is_same_sense { 0.0 } else { PI };
    let a_m = libm::hypot(point.x, point.y);
    if a_m <= parallel_m {
        return CommonNormal {
            relation: AxisRelation::Coincident,
            theta_rad: 0.0,
            d_m: 0.0,
            a_m: 0.0,
            alpha_rad,
        };
    }
    let relation = if is_same_sense { AxisRelation::Parallel } else { AxisRelation::AntiParallel };
    CommonNormal { relation, theta_rad: libm::atan2(point.y, point.x), d_m: 0.0, a_m, alpha_rad }
}
