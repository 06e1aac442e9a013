//! Values of two descriptions that differ, one by one: limits and losses of matched joints, and inertias of links of one name.

use congruent_description::{Inertia, Joint, JointKind, Robot};
use congruent_input::{SiUnit, display::compared_quantities};
use schemars::JsonSchema;
use serde::Serialize;

/// Smaller changes are rounding, relative to the value. Kind: choice; six digits of pi.
const ROUNDED: f64 = 1e-6;
/// Smaller changes of a centre of mass are rounding. Unit: m; kind: choice.
const ROUNDED_M: f64 = 1e-9;

/// A limit or a loss of a joint that differs from what it was in another description, as one of an earlier revision.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ChangedValue {
    /// The joint.
    pub joint: String,
    /// `lower`, `upper`, `velocity`, `effort`, `acceleration`, `deceleration`, `jerk`, `damping`, `friction` or `armature`; of a
    /// row of a table `table a`, `table alpha`, `table d` or `table theta`.
    #[serde(rename = "figure")]
    pub parameter: &'static str,
    /// Its value; `null` if none is stated.
    pub found: Option<f64>,
    /// Its value in the other description.
    pub before: Option<f64>,
    /// The unit of both.
    #[schemars(with = "String")]
    pub unit: SiUnit,
}

impl ChangedValue {
    /// `elbow_joint: effort 200 N m, was 150 N m`.
    pub fn sentence(&self) -> String {
        let values = match (self.found, self.before) {
            (Some(found), Some(before)) => {
                let [found, before] = compared_quantities([found, before], self.unit.symbol());
                format!("{found}, was {before}")
            }
            (found, before) => {
                let [value, _] =
                    compared_quantities([found.or(before).unwrap_or_default(), 0.0], self.unit.symbol());
                if found.is_some() {
                    format!("{value}, was not stated")
                } else {
                    format!("not stated, was {value}")
                }
            }
        };
        format!("{}: {} {values}", self.joint, self.parameter)
    }
}

/// The range of a joint in rad or m, if it has one.
pub type JointRange = Option<(f64, f64)>;

/// The values of a joint that differ; its ranges are those in the same variable.
pub fn changed_values(joint: &Joint, before: &Joint, ranges: [JointRange; 2]) -> Vec<ChangedValue> {
    let [(lower, upper), (lower_before, upper_before)] = ranges.map(Option::unzip);
    let [limit, limit_before] = [joint.limit.unwrap_or_default(), before.limit.unwrap_or_default()];
    let loss = |value: f64| (value != 0.0).then_some(value);
    // Nothing is said of a value that only one of two formats can state.
    let (armature, armature_before) = joint.armature.zip(before.armature).unzip();
    let [position, speed, per_s2, per_s3, force, damping, inertia] = units(joint.kind);
    let values = [
        ("lower", lower, lower_before, position),
        ("upper", upper, upper_before, position),
        ("velocity", limit.velocity, limit_before.velocity, speed),
        ("effort", limit.effort, limit_before.effort, force),
        ("acceleration", limit.acceleration, limit_before.acceleration, per_s2),
        ("deceleration", limit.deceleration, limit_before.deceleration, per_s2),
        ("jerk", limit.jerk, limit_before.jerk, per_s3),
        ("damping", loss(joint.damping), loss(before.damping), damping),
        ("friction", loss(joint.friction), loss(before.friction), force),
        ("armature", armature, armature_before, inertia),
    ];
    let differs = |found: Option<f64>, before: Option<f64>| match (found, before) {
        (Some(found), Some(before)) => !is_same_value(found, before),
        (found, before) => found.is_some() != before.is_some(),
    };
    let changed = values.into_iter().filter(|(_, found, before, _)| differs(*found, *before));
    changed
        .map(|(parameter, found, before, unit)| ChangedValue {
            joint: joint.name.clone(),
            parameter,
            found,
            before,
            unit,
        })
        .collect()
}

/// Whether two values of a joint differ by rounding alone.
pub fn is_same_value(a: f64, b: f64) -> bool {
    (a - b).abs() <= ROUNDED * a.abs().max(b.abs())
}

/// The units of position, speed, acceleration, jerk, force, damping and armature.
fn units(kind: JointKind) -> [SiUnit; 7] {
    if kind.is_angular() {
        [
            SiUnit::Radian,
            SiUnit::RadianPerSecond,
            SiUnit::RadianPerSecondSquared,
            SiUnit::RadianPerSecondCubed,
            SiUnit::NewtonMetre,
            SiUnit::NewtonMetreSecondPerRadian,
            SiUnit::KilogramSquareMetre,
        ]
    } else {
        [
            SiUnit::Metre,
            SiUnit::MetrePerSecond,
            SiUnit::MetrePerSecondSquared,
            SiUnit::MetrePerSecondCubed,
            SiUnit::Newton,
            SiUnit::NewtonSecondPerMetre,
            SiUnit::Kilogram,
        ]
    }
}

/// Links of both robots with another centre of mass or another inertia about it.
pub fn changed_inertias(robot: &Robot, before: &Robot) -> Vec<String> {
    let differs = |name: &str| {
        let of = |robot: &Robot| robot.link(robot.find_link(name)?).inertia;
        of(robot).zip(of(before)).is_some_and(|(own, before)| {
            let [com, com_before] = [&own, &before].map(|of| of.link_from_inertial.translation.vector);
            let [tensor, tensor_before] = [&own, &before].map(Inertia::tensor_in_link);
            (com - com_before).norm() > ROUNDED_M
                || (tensor - tensor_before).norm() > ROUNDED * tensor.norm().max(tensor_before.norm())
        })
    };
    let names = robot.links().iter().map(|link| &link.name);
    names.filter(|name| differs(name)).cloned().collect()
}
