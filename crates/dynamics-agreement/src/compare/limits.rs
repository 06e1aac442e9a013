//! Limits of joints, compared directly: no torque shows them.

use congruent_description::{ChangedLines, JointLimit};

use crate::{
    side::{Side, frames::JointPlace},
    thresholds::SAME_VALUE,
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
    #[serde(rename = "figure")]
    pub parameter: String,
    /// What the candidate says, SI units; `null` if it does not state the limit.
    pub found: Option<f64>,
    /// What the reference says, SI units; `null` if it does not state the limit.
    pub expected: Option<f64>,
    /// Found over expected; `null` if one of them is not stated, or 0 is expected.
    pub factor: Option<f64>,
    /// Whether the two disagree by it; a limit of speed or effort that one of the two does not state is a remark.
    pub decides: bool,
    /// Unit of both.
    pub unit: String,
    /// Where the candidate's file says it; `null` if the place is not known.
    pub line: Option<usize>,
    /// Where the reference's file says it.
    pub expected_line: Option<usize>,
    /// The candidate's file; `null` if the place is not known.
    pub file: Option<String>,
    /// The lines of the candidate's file with all limits of the joint as the reference has them; empty if the reference
    /// does not state the limit, or if the file cannot say it.
    pub changes: Vec<ChangedLines>,
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
/// A factor is that of a unit within this share. No unit; kind: digits of a file, which rounds a limit to three; the
/// nearest two units are a factor of six apart.
const FACTOR: f64 = 5e-3;

/// The limits that differ; a speed or an effort of 0 is not stated, and neither is the range of a joint that turns on
/// and on.
pub(crate) fn differences(candidate: &Side, reference: &Side, joints: &[usize]) -> Vec<LimitDifference> {
    let mut differences = Vec::new();
    for (joint, &other) in joints.iter().enumerate() {
        for (cause, parameter, value) in LIMITS {
            let stated = |limit: Option<&JointLimit>| {
                let value = limit.and_then(value).filter(|value| value.is_finite());
                value.filter(|value| cause == LimitCause::PositionLimit || *value != 0.0)
            };
            let (found, expected) =
                (stated(candidate.limits[joint].as_ref()), stated(reference.limits[other].as_ref()));
            let is_same = match (found, expected) {
                (Some(found), Some(expected)) => {
                    (found - expected).abs() <= SAME_VALUE * found.abs().max(expected.abs())
                }
                (None, None) => true,
                _ => false,
            };
            if is_same {
                continue;
            }
            let both = found.zip(expected);
            let factor = both.filter(|of| of.1 != 0.0).map(|(found, expected)| found / expected);
            differences.push(LimitDifference {
                joint: candidate.frames.joint_name(joint).to_owned(),
                cause,
                detail: detail(cause, factor).to_owned(),
                parameter: parameter.to_owned(),
                found,
                expected,
                factor,
                decides: both.is_some() || cause == LimitCause::PositionLimit,
                unit: unit(cause, &candidate.frames.joints[joint]).to_owned(),
                line: None,
                expected_line: None,
                file: None,
                changes: Vec::new(),
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
