//! The range of motion that certificates are about.

use congruent_description::JointLimit;

use crate::{side::Side, thresholds::LARGEST_SPEED};

/// Positions, speeds and accelerations of one joint that a certificate covers.
#[derive(Debug, Clone, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct CoveredMotion {
    /// The joint.
    pub joint: String,
    /// Smallest position, rad or m: of a joint without limits one turn is covered.
    pub lower: f64,
    /// Largest position, rad or m.
    pub upper: f64,
    /// Largest speed in either direction, rad/s or m/s.
    pub speed: f64,
    /// Whether a description states the speed; else it is 2 rad/s or m/s.
    pub speed_is_stated: bool,
    /// Largest acceleration in either direction, rad/s^2 or m/s^2.
    pub acceleration: f64,
}

/// The range of motion of each joint of a candidate. If both descriptions state a speed it is the smaller one: a limit
/// in degrees is not a speed.
pub(crate) fn covered_motions(candidate: &Side, reference: &Side) -> Vec<CoveredMotion> {
    let stated = |limit: &Option<JointLimit>| {
        limit.and_then(|limit| limit.velocity).filter(|speed| speed.is_finite() && *speed > 0.0)
    };
    let covered = |joint: usize| {
        let place = &candidate.frames.joints[joint];
        let speeds = [candidate, reference].map(|side| stated(&side.limits[joint]));
        let speed = speeds.into_iter().flatten().reduce(f64::min);
        CoveredMotion {
            joint: place.name.clone(),
            lower: place.range.0,
            upper: place.range.1,
            speed: speed.unwrap_or(LARGEST_SPEED),
            speed_is_stated: speed.is_some(),
            acceleration: candidate.largest_accelerations[joint].abs(),
        }
    };
    (0..candidate.frames.dof()).map(covered).collect()
}
