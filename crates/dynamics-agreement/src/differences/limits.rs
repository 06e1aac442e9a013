//! Joint limits, compared by value: they have no effect on torques.

use congruent_description::{JointLimit, PlaceElsewhere};
use congruent_input::{ChangedLines, SiUnit};

use crate::{
    model::{DynamicsModel, frames::JointPlace},
    thresholds::SAME_VALUE,
};

/// A joint limit in which two descriptions differ.
#[derive(Debug, Clone, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct LimitDifference {
    /// Name of the joint.
    pub joint: String,
    /// Which kind of limit differs.
    pub cause: LimitCause,
    /// `degrees`, `rpm` or `N mm` if the factor, or its inverse, is that of this unit, `degrees` also for a range of more than four
    /// turns; the larger value is probably in it. `exchanged` if the candidate has the value at another place of the same
    /// `<limit>`: speed and effort, or both ends of the range with their signs. `uniform` or `uniform_there` if the candidate or the
    /// reference has one speed or effort for all joints, and the other file has not. Otherwise empty.
    pub detail: String,
    /// `velocity`, `effort`, `lower`, `upper`, `acceleration`, `deceleration`, `jerk`.
    #[serde(rename = "figure")]
    pub parameter: String,
    /// The candidate's value in `unit`; `null` if it does not state the limit.
    pub found: Option<f64>,
    /// The reference's value in `unit`; `null` if it does not state the limit.
    pub expected: Option<f64>,
    /// The reference's value as its file writes it, if the joint has another direction or zero there.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub expected_as_written: Option<f64>,
    /// `found / expected`; `null` if one of them is not stated, or if `expected` is 0.
    pub factor: Option<f64>,
    /// Whether this difference makes the verdict `disagree`; a limit of speed or effort that only one of the two states does
    /// not.
    pub decides: bool,
    /// SI unit of `found` and `expected`: `rad`, `m`, `rad/s`, `m/s`, `N m`, `N`, or `rad/s^2`, `rad/s^3`, `m/s^2`, `m/s^3`.
    #[schemars(with = "String")]
    pub unit: SiUnit,
    /// Line of the limit in the candidate's file; `null` if it is not known.
    pub line: Option<usize>,
    /// Line of the limit in the reference's file; `null` if it is not known.
    pub expected_line: Option<usize>,
    /// Where the candidate's value is written if its element does not write it in the candidate's file.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub elsewhere: Option<PlaceElsewhere>,
    /// The same of the reference.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub expected_elsewhere: Option<PlaceElsewhere>,
    /// Path of the candidate's file; `null` if it is not known.
    pub file: Option<String>,
    /// The lines of the candidate's file with all limits of the joint set to the reference's values; empty if the reference
    /// does not state the limit, or if the file format cannot express it.
    pub changes: Vec<ChangedLines>,
}

/// The kind of limit that differs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LimitCause {
    /// The largest speed, rad/s or m/s.
    VelocityLimit,
    /// The largest torque or force, N m or N.
    EffortLimit,
    /// The smallest or largest position, rad or m.
    PositionLimit,
    /// The largest acceleration or deceleration, rad/s^2 or m/s^2.
    AccelerationLimit,
    /// The largest jerk, rad/s^3 or m/s^3.
    JerkLimit,
}

/// `detail` of limits whose values have changed places.
pub(crate) const EXCHANGED: &str = "exchanged";
/// `detail` of limits of speed or effort that the candidate has for all joints alike, as a placeholder is written.
pub(crate) const UNIFORM: &str = "uniform";
/// The same of the reference.
pub(crate) const UNIFORM_THERE: &str = "uniform_there";
/// A value that fewer joints have is none for all of them. Kind: choice.
const FEWEST_UNIFORM: usize = 3;
/// `detail` of limits that differ by the factor of degrees.
pub(crate) const DEGREES_DETAIL: &str = "degrees";
const DEGREES: f64 = 180.0 / std::f64::consts::PI;
const N_MM: f64 = 1000.0;
/// No cable survives more; a URDF with such a range is warned of, too. Unit: rad.
pub(crate) const FOUR_TURNS: f64 = 4.0 * std::f64::consts::TAU;
const RPM: f64 = 30.0 / std::f64::consts::PI;
/// Relative tolerance of a factor that names a unit. No unit; kind: digits of a file, which rounds a limit to three; the
/// factors of degrees and rpm differ by a factor of six.
const FACTOR: f64 = 5e-3;

/// The limits that differ. A speed or an effort of 0 counts as not stated, and so does the infinite range of a continuous
/// joint.
pub(crate) fn differences(
    candidate: &DynamicsModel,
    reference: &DynamicsModel,
    joints: &[usize],
) -> Vec<LimitDifference> {
    let mut differences: Vec<LimitDifference> = Vec::new();
    let uniform = LIMITS.map(|limit| uniform(limit, [candidate, reference], joints));
    for (joint, &other) in joints.iter().enumerate() {
        let first = differences.len();
        for ((cause, parameter, value), uniform) in LIMITS.into_iter().zip(uniform) {
            let stated = |limit: Option<&JointLimit>| {
                let value = limit.and_then(value).filter(|value| value.is_finite());
                // A position limit of 0 is a value; a speed or effort of 0 is what exporters write for an unknown
                // one.
                value.filter(|value| cause == LimitCause::PositionLimit || *value != 0.0)
            };
            let (found, expected) =
                (stated(candidate.limits[joint].as_ref()), stated(reference.limits[other].as_ref()));
            let is_equal = match (found, expected) {
                (Some(found), Some(expected)) => {
                    // An end at 0 is rounding away from 0 in another variable.
                    let is_rounding = (found - expected).abs() <= SAME_VALUE;
                    is_same(found, expected) || (cause == LimitCause::PositionLimit && is_rounding)
                }
                (None, None) => true,
                _ => false,
            };
            if is_equal {
                continue;
            }
            let both = found.zip(expected);
            let factor = both.filter(|of| of.1 != 0.0).map(|(found, expected)| found / expected);
            differences.push(LimitDifference {
                joint: candidate.frames.joint_name(joint).to_owned(),
                cause,
                detail: uniform
                    .filter(|_| both.is_some())
                    .unwrap_or_else(|| detail(cause, both, &candidate.frames.joints[joint]))
                    .to_owned(),
                parameter: parameter.to_owned(),
                found,
                expected,
                expected_as_written: None,
                factor,
                // A missing range changes where the robot may go; a missing speed or effort is usually just not
                // given.
                decides: both.is_some() || cause == LimitCause::PositionLimit,
                unit: unit(cause, &candidate.frames.joints[joint]),
                line: None,
                expected_line: None,
                elsewhere: None,
                expected_elsewhere: None,
                file: None,
                changes: Vec::new(),
            });
        }
        mark_exchanged(&mut differences[first..]);
    }
    differences
}

/// Which of two models has one speed or effort for all joints, and another one than the other model for most of them, as the `detail`
/// of a difference; `None` if neither or both have.
fn uniform(
    (cause, _, value): LimitEntry,
    models: [&DynamicsModel; 2],
    joints: &[usize],
) -> Option<&'static str> {
    let stated = |limit: &Option<JointLimit>| limit.as_ref().and_then(value);
    let is_uniform = |model: &DynamicsModel| {
        let values: Vec<f64> = model.limits.iter().filter_map(stated).collect();
        let is_first = |value: &f64| is_same(*value, values[0]);
        values.len() >= FEWEST_UNIFORM && values[0] != 0.0 && values.iter().all(is_first)
    };
    let differ = |(joint, other): (usize, &usize)| {
        let both = stated(&models[0].limits[joint]).zip(stated(&models[1].limits[*other]));
        both.is_some_and(|(found, expected)| !is_same(found, expected))
    };
    let differing = joints.iter().enumerate().filter(|of| differ(*of)).count();
    match models.map(is_uniform) {
        _ if !matches!(cause, LimitCause::VelocityLimit | LimitCause::EffortLimit) => None,
        _ if 2 * differing <= joints.len() => None,
        [true, false] => Some(UNIFORM),
        [false, true] => Some(UNIFORM_THERE),
        _ => None,
    }
}

/// Marks two differences of one joint whose values have changed places: speed and effort as they are, the ends of the range with
/// the other sign.
fn mark_exchanged(differences: &mut [LimitDifference]) {
    for ([a, b], sign) in [(["velocity", "effort"], 1.0), (["lower", "upper"], -1.0)] {
        let at = [a, b].map(|name| differences.iter().position(|of| of.parameter == name));
        let [Some(a), Some(b)] = at else { continue };
        let is_other = |found: Option<f64>, expected: Option<f64>| {
            let both = found.zip(expected);
            both.is_some_and(|(found, expected)| is_same(found, sign * expected))
        };
        if is_other(differences[a].found, differences[b].expected)
            && is_other(differences[b].found, differences[a].expected)
        {
            for index in [a, b] {
                EXCHANGED.clone_into(&mut differences[index].detail);
            }
        }
    }
}

fn is_same(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME_VALUE * a.abs().max(b.abs())
}

fn unit(cause: LimitCause, joint: &JointPlace) -> SiUnit {
    match (cause, joint.is_angular) {
        (LimitCause::VelocityLimit, true) => SiUnit::RadianPerSecond,
        (LimitCause::VelocityLimit, false) => SiUnit::MetrePerSecond,
        (LimitCause::EffortLimit, _) => joint.effort_unit(),
        (LimitCause::PositionLimit, true) => SiUnit::Radian,
        (LimitCause::PositionLimit, false) => SiUnit::Metre,
        (LimitCause::AccelerationLimit, true) => SiUnit::RadianPerSecondSquared,
        (LimitCause::AccelerationLimit, false) => SiUnit::MetrePerSecondSquared,
        (LimitCause::JerkLimit, true) => SiUnit::RadianPerSecondCubed,
        (LimitCause::JerkLimit, false) => SiUnit::MetrePerSecondCubed,
    }
}

type LimitEntry = (LimitCause, &'static str, fn(&JointLimit) -> Option<f64>);

const LIMITS: [LimitEntry; 7] = [
    (LimitCause::VelocityLimit, "velocity", |limit| limit.velocity),
    (LimitCause::EffortLimit, "effort", |limit| limit.effort),
    (LimitCause::PositionLimit, "lower", |limit| Some(limit.lower)),
    (LimitCause::PositionLimit, "upper", |limit| Some(limit.upper)),
    (LimitCause::AccelerationLimit, "acceleration", |limit| limit.acceleration),
    (LimitCause::AccelerationLimit, "deceleration", |limit| limit.deceleration),
    (LimitCause::JerkLimit, "jerk", |limit| limit.jerk),
];

fn detail(cause: LimitCause, both: Option<(f64, f64)>, joint: &JointPlace) -> &'static str {
    let Some((found, expected)) = both.filter(|_| joint.is_angular) else { return "" };
    // Either of the two may be the one in another unit.
    let is = |unit: f64| {
        [found / expected, expected / found].iter().any(|factor| (factor / unit - 1.0).abs() <= FACTOR)
    };
    match cause {
        // Neither degrees nor rpm are units of an effort, whatever its factor is.
        LimitCause::EffortLimit if is(N_MM) => "N mm",
        LimitCause::EffortLimit => "",
        _ if is(DEGREES) => DEGREES_DETAIL,
        LimitCause::PositionLimit if found.abs().max(expected.abs()) > FOUR_TURNS => DEGREES_DETAIL,
        LimitCause::VelocityLimit if is(RPM) => "rpm",
        _ => "",
    }
}
