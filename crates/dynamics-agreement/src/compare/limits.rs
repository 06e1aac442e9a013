//! Limits of joints, compared directly: no torque shows them.

use congruent_description::JointLimit;

use crate::{
    side::{Side, frames::JointPlace},
    thresholds::SAME_FIGURE,
};

/// A limit that differs.
#[derive(Debug, Clone, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct LimitDifference {
    /// The joint.
    pub joint: String,
    /// Which limit, as a cause.
    pub cause: LimitCause,
    /// `degrees` or `rpm` if that is what the factor says.
    pub detail: String,
    /// `velocity`, `effort`, `lower`, `upper`.
    pub figure: String,
    /// What the candidate says, SI units.
    pub found: f64,
    /// What the reference says, SI units.
    pub expected: f64,
    /// Found over expected; `null` if nothing is expected.
    pub factor: Option<f64>,
    /// Unit of both.
    pub unit: String,
    /// Where the candidate's file says it; `null` if the place is not known.
    pub line: Option<usize>,
    /// Where the reference's file says it.
    pub expected_line: Option<usize>,
}

/// Which limit differs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LimitCause {
    /// Of speed.
    VelocityLimit,
    /// Of torque or force.
    EffortLimit,
    /// Of position.
    PositionLimit,
}

const DEGREES: f64 = 180.0 / std::f64::consts::PI;
const RPM: f64 = 30.0 / std::f64::consts::PI;
/// A factor is that of a unit within this share. No unit; kind: digits of a file, which rounds a limit to three.
const FACTOR: f64 = 1e-3;

/// The limits that differ; 0 and what is left out are not stated, and differ from nothing.
pub(crate) fn differences(candidate: &Side, reference: &Side, joints: &[usize]) -> Vec<LimitDifference> {
    let mut differences = Vec::new();
    for (joint, &other) in joints.iter().enumerate() {
        let (Some(found), Some(expected)) = (candidate.limits[joint], reference.limits[other]) else {
            continue;
        };
        for (cause, figure, value) in LIMITS {
            let (Some(found), Some(expected)) = (value(&found), value(&expected)) else { continue };
            let states =
                |value: f64| value.is_finite() && (cause == LimitCause::PositionLimit || value != 0.0);
            if !states(found) || !states(expected) {
                continue;
            }
            if (found - expected).abs() <= SAME_FIGURE * found.abs().max(expected.abs()) {
                continue;
            }
            let factor = (expected != 0.0).then(|| found / expected);
            differences.push(LimitDifference {
                joint: candidate.frames.joint_name(joint).to_owned(),
                cause,
                detail: detail(cause, factor).to_owned(),
                figure: figure.to_owned(),
                found,
                expected,
                factor,
                unit: unit(cause, &candidate.frames.joints[joint]).to_owned(),
                line: None,
                expected_line: None,
            });
        }
    }
    differences
}

fn unit(cause: LimitCause, joint: &JointPlace) -> &'static str {
    match (cause, joint.is_angular) {
        (LimitCause::VelocityLimit, true) => "rad/s",
        (LimitCause::VelocityLimit, false) => "m/s",
        (LimitCause::EffortLimit, true) => "N m",
        (LimitCause::EffortLimit, false) => "N",
        (LimitCause::PositionLimit, true) => "rad",
        (LimitCause::PositionLimit, false) => "m",
    }
}

type Limit = (LimitCause, &'static str, fn(&JointLimit) -> Option<f64>);

const LIMITS: [Limit; 4] = [
    (LimitCause::VelocityLimit, "velocity", |limit| limit.velocity),
    (LimitCause::EffortLimit, "effort", |limit| limit.effort),
    (LimitCause::PositionLimit, "lower", |limit| Some(limit.lower)),
    (LimitCause::PositionLimit, "upper", |limit| Some(limit.upper)),
];

fn detail(cause: LimitCause, factor: Option<f64>) -> &'static str {
    let is = |unit: f64| factor.is_some_and(|factor| (factor / unit - 1.0).abs() <= FACTOR);
    match cause {
        LimitCause::EffortLimit => "",
        _ if is(DEGREES) => "degrees",
        LimitCause::VelocityLimit if is(RPM) => "rpm",
        _ => "",
    }
}
