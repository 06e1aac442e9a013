//! `[limits]` of a robot file: the largest accelerations of joints, which a URDF does not state.

use std::collections::BTreeMap;

use congruent_input::{
    Diagnostic, Diagnostics,
    display::number,
    known_names,
    units::{Unit, UnitSystem, WrittenUnit, check_finite},
};
use congruent_robot::{Joint, Robot};
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use crate::codes;

/// Values by joint name; `*` means every joint of this kind (revolute or prismatic) that is not named.
type SpannedByJoint = BTreeMap<Spanned<String>, Spanned<f64>>;

/// The name that means every joint of a kind.
const EVERY: &str = "*";
/// Larger accelerations, rad/s^2, are taken as degrees: joints of arms reach 100, those of legs some hundred.
const FASTEST_RAD_S2: f64 = 500.0;

/// The largest accelerations of joints, up to which the certificates of `congruent check` hold. A joint that is not named is
/// assumed to accelerate with at most 10 rad/s^2 or m/s^2.
#[derive(Debug, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "RobotLimits")]
#[expect(clippy::struct_field_names, reason = "the keys of the file")]
pub(crate) struct WrittenLimits {
    /// Accelerations by joint, in radians per second squared.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, f64>")]
    pub(crate) acceleration_rad_s2: SpannedByJoint,
    /// Accelerations by joint, in degrees per second squared.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, f64>")]
    pub(crate) acceleration_deg_s2: SpannedByJoint,
    /// Accelerations by joint, in metres per second squared.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, f64>")]
    pub(crate) acceleration_m_s2: SpannedByJoint,
    /// Accelerations by joint, in millimetres per second squared.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, f64>")]
    pub(crate) acceleration_mm_s2: SpannedByJoint,
}

/// The declared acceleration of each moving joint, in rad/s^2 or m/s^2; `None` for those without one.
pub(super) fn accelerations(
    written: Option<&WrittenLimits>,
    robot: &Robot,
    diagnostics: &mut Diagnostics,
) -> Vec<Option<f64>> {
    let mut accelerations = vec![None; robot.dof()];
    let Some(written) = written else { return accelerations };
    // Entries for `*` come first, so that entries for a joint by name overwrite them.
    for is_every in [true, false] {
        let mut given_by: Vec<Option<&str>> = vec![None; robot.dof()];
        for (key, by_joint) in written.keys() {
            for (name, value) in by_joint.iter().filter(|(name, _)| (name.get_ref() == EVERY) == is_every) {
                diagnostics.extend(in_degrees(key, name, value));
                let Some((joints, acceleration)) = diagnostics.keep(read(key, name, value, robot)) else {
                    continue;
                };
                for joint in joints {
                    accelerations[joint] = Some(acceleration);
                    let twice = given_by[joint].replace(key).map(|first| twice(first, name));
                    diagnostics.extend(twice);
                }
            }
        }
    }
    accelerations
}

impl WrittenLimits {
    fn keys(&self) -> [(&'static str, &SpannedByJoint); 4] {
        [
            ("acceleration_rad_s2", &self.acceleration_rad_s2),
            ("acceleration_deg_s2", &self.acceleration_deg_s2),
            ("acceleration_m_s2", &self.acceleration_m_s2),
            ("acceleration_mm_s2", &self.acceleration_mm_s2),
        ]
    }
}

fn twice(first: &str, name: &Spanned<String>) -> Diagnostic {
    let message = format!("the acceleration of \"{}\" is already given by {first}", name.get_ref());
    Diagnostic::error(codes::robot_file::LIMITS, message)
        .at(name.span())
        .with_help("keep exactly one of the two")
}

/// A warning of an acceleration in radians that is plausible only in degrees.
fn in_degrees(key: &'static str, name: &Spanned<String>, value: &Spanned<f64>) -> Option<Diagnostic> {
    let is_in_rad = WrittenUnit::of_key(key) == WrittenUnit { unit: Unit::Angle, system: UnitSystem::Si };
    let is_fast = value.get_ref().is_finite() && *value.get_ref() > FASTEST_RAD_S2;
    (is_in_rad && is_fast).then(|| {
        let message = format!(
            "{key} of \"{}\" is {}, which is implausible in rad/s^2",
            name.get_ref(),
            number(*value.get_ref())
        );
        Diagnostic::warning(codes::robot_file::FAST, message)
            .at(value.span())
            .with_help("if the value is in degrees, the key is acceleration_deg_s2")
    })
}

/// The joints of an entry, as indices in `Robot::movable_joints` order, and its value in SI units.
fn read(
    key: &'static str,
    name: &Spanned<String>,
    value: &Spanned<f64>,
    robot: &Robot,
) -> Result<(Vec<usize>, f64), Diagnostic> {
    let value = positive(key, name.get_ref(), value)?;
    let unit = WrittenUnit::of_key(key);
    Ok((named(key, name, unit.unit, robot)?, unit.to_si(value)))
}

fn positive(key: &str, name: &str, value: &Spanned<f64>) -> Result<f64, Diagnostic> {
    let quantity = format!("{key} of \"{name}\"");
    check_finite(&quantity, *value.get_ref(), value.span())?;
    if *value.get_ref() > 0.0 {
        return Ok(*value.get_ref());
    }
    let message = format!("{quantity} must be greater than 0, it is {}", value.get_ref());
    Err(Diagnostic::error(codes::robot_file::LIMITS, message).at(value.span()))
}

/// The moving joints that a name means, as indices in `Robot::movable_joints` order.
fn named(key: &str, name: &Spanned<String>, unit: Unit, robot: &Robot) -> Result<Vec<usize>, Diagnostic> {
    let turns = matches!(unit, Unit::Angle);
    let of_kind = |joint: &Joint| joint.kind.is_angular() == turns;
    let moving = || robot.movable_joints().iter().map(|&joint| robot.joint(joint)).enumerate();
    if name.get_ref() == EVERY {
        return Ok(moving().filter(|(_, joint)| of_kind(joint)).map(|(at, _)| at).collect());
    }
    let Some((at, joint)) = moving().find(|(_, joint)| joint.name == *name.get_ref()) else {
        let message = format!("{key}: the robot has no moving joint \"{}\"", name.get_ref());
        let known = known_names(name.get_ref(), "moving joints", robot.movable_joint_names());
        return Err(Diagnostic::error(codes::robot_file::UNKNOWN_JOINT, message)
            .at(name.span())
            .with_help(known));
    };
    if of_kind(joint) {
        return Ok(vec![at]);
    }
    let (moves, right) = if turns { ("slides", "m_s2") } else { ("turns", "rad_s2") };
    let message = format!("{key} does not fit joint \"{}\", which {moves}", joint.name);
    let refused = Diagnostic::error(codes::robot_file::LIMITS, message).at(name.span());
    Err(refused.with_help(format!("the key for this joint is acceleration_{right}")))
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use crate::parse_robot;
    use congruent_input::{Findings, SourceFile};

    const URDF: &str = "<robot name='r'><link name='base'/>\
        <link name='one'/><joint name='turn' type='continuous'><parent link='base'/><child link='one'/></joint>\
        <link name='two'/><joint name='next' type='continuous'><parent link='one'/><child link='two'/></joint>\
        <link name='tip'/><joint name='slide' type='prismatic'><parent link='two'/><child link='tip'/>\
        <limit lower='-1' upper='1' effort='1' velocity='1'/></joint></robot>";

    fn accelerations(limits: &str) -> Result<Vec<Option<f64>>, Findings> {
        let source = |name: &str, text: &str| {
            Arc::new(SourceFile { path: name.into(), text: text.to_owned(), is_foreign: false })
        };
        let file = source("robot.toml", &format!("[limits]\n{limits}\n"));
        Ok(parse_robot(Some(&file), &source("r.urdf", URDF))?.accelerations)
    }

    #[test]
    fn named_joints_keep_their_own_value() {
        let found =
            accelerations("acceleration_deg_s2 = { '*' = 180 }\nacceleration_rad_s2 = { next = 7 }").unwrap();
        assert_eq!(found, [Some(std::f64::consts::PI), Some(7.0), None]);
        let found = accelerations("acceleration_mm_s2 = { slide = 2500 }").unwrap();
        assert_eq!(found, [None, None, Some(2.5)]);
    }

    #[test]
    fn what_is_no_acceleration_of_a_joint_is_refused() {
        for (limits, message) in [
            ("acceleration_rad_s2 = { trun = 1 }", "no moving joint \"trun\""),
            ("acceleration_rad_s2 = { slide = 1 }", "joint \"slide\", which slides"),
            ("acceleration_m_s2 = { turn = 1 }", "joint \"turn\", which turns"),
            ("acceleration_rad_s2 = { turn = 0 }", "must be greater than 0, it is 0"),
            ("acceleration_rad_s2 = { turn = -3 }", "must be greater than 0, it is -3"),
            ("acceleration_rad_s2 = { turn = inf }", "which is not a finite number"),
            (
                "acceleration_rad_s2 = { turn = 1 }\nacceleration_deg_s2 = { turn = 1 }",
                "the acceleration of \"turn\" is already given by acceleration_rad_s2",
            ),
            ("acceleration = { turn = 1 }", "acceleration"),
        ] {
            let found = accelerations(limits).unwrap_err();
            assert!(found[0].message.contains(message), "{limits}: {found:#?}");
        }
    }
}
