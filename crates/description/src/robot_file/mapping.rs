//! `[mapping]` and `[[reference]]` of a robot file: other descriptions of the robot, and how their joints are called and
//! counted there.

use std::{
    collections::{BTreeMap, BTreeSet},
    fmt,
    path::PathBuf,
};

use congruent_input::{
    Diagnostic, Diagnostics, known_names,
    units::{Unit, WrittenUnit},
};
use congruent_robot::{Joint, Robot};
use schemars::JsonSchema;
use serde::{
    Deserialize, Deserializer,
    de::{self, MapAccess, Visitor, value::MapAccessDeserializer},
};
use toml::Spanned;

use crate::codes;

/// How joints are called and counted in another description. Joints that are not named here have the same name and the same
/// variable there.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Mapping")]
pub(crate) struct WrittenMapping {
    /// "fitted" if the root frame of the other description lies elsewhere: its pose is then fitted to the axes and reported.
    #[serde(default)]
    #[schemars(with = "MappingBase")]
    base: Option<MappingBase>,
    /// Joints that move in only one of the two descriptions. One that the other file fixes is held at 0; behind every other one nothing is
    /// compared.
    #[serde(default)]
    left_out: Vec<String>,
    /// For each joint of this robot that is called or counted otherwise there: its name there, or a table with `joint`, `sign`
    /// and an offset.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, WrittenMappedJoint>")]
    joints: BTreeMap<Spanned<String>, Spanned<WrittenMappedJoint>>,
}

/// Where the root frame of another description lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum MappingBase {
    /// Where the axes of the joints agree best.
    Fitted,
}

/// A joint in another description.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(untagged)]
pub(crate) enum WrittenMappedJoint {
    /// Its name there; the variable is the same.
    Name(String),
    /// Its name and variable there.
    Variable(WrittenVariable),
}

/// As written, and not as an untagged enum, whose message would not name a wrong key.
impl<'de> Deserialize<'de> for WrittenMappedJoint {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(MappedJointVisitor)
    }
}

struct MappedJointVisitor;

impl<'de> Visitor<'de> for MappedJointVisitor {
    type Value = WrittenMappedJoint;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(
            "the name of the joint there, or { joint = \"NAME\", sign = -1, offset_deg = 90 }, of which an offset names its unit: \
             offset_deg, offset_rad, offset_mm or offset_m",
        )
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<Self::Value, E> {
        Ok(WrittenMappedJoint::Name(name.to_owned()))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
        WrittenVariable::deserialize(MapAccessDeserializer::new(map)).map(WrittenMappedJoint::Variable)
    }
}

/// The variable of a joint there: `q_there = sign * q_here + offset`.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "MappedVariable")]
pub(crate) struct WrittenVariable {
    /// Its name there; by default the same.
    joint: Option<String>,
    /// 1, or -1 if it moves in the opposite direction there.
    #[serde(default = "same_way")]
    sign: i64,
    /// Its position there if it is at 0 here, in radians.
    offset_rad: Option<f64>,
    /// The same in degrees.
    offset_deg: Option<f64>,
    /// The same of a slide, in metres.
    offset_m: Option<f64>,
    /// The same in millimetres.
    offset_mm: Option<f64>,
}

fn same_way() -> i64 {
    1
}

/// Another description of this robot.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Reference")]
pub(crate) struct WrittenReference {
    /// Its folder, robot file or URDF, relative to this file.
    #[schemars(with = "String")]
    pub(crate) file: Spanned<PathBuf>,
    /// How its joints are called and counted; `[mapping]` of this file if it is left out.
    #[serde(default)]
    #[schemars(with = "WrittenMapping")]
    pub(crate) mapping: Option<WrittenMapping>,
}

/// How joints are called and counted in another description, as a robot file declares it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DeclaredMapping {
    /// The joints that are called or counted otherwise.
    pub joints: Vec<DeclaredVariable>,
    /// Joints that move in only one of the two descriptions.
    pub left_out: BTreeSet<String>,
    /// Whether the pose of the other root is to be fitted.
    pub has_fitted_base: bool,
}

/// A joint of a robot in another description: `q_there = sign * q_here + offset`.
#[derive(Debug, Clone, PartialEq)]
pub struct DeclaredVariable {
    /// Its name here.
    pub joint: String,
    /// Its name there.
    pub there: String,
    /// Whether `sign` is -1.
    pub is_flipped: bool,
    /// rad or m.
    pub offset: f64,
}

/// Another description that a robot file names.
#[derive(Debug, Clone, PartialEq)]
pub struct DeclaredReference {
    /// Path of its folder, robot file or URDF.
    pub path: PathBuf,
    /// How its joints are called and counted.
    pub mapping: Option<DeclaredMapping>,
}

/// Checks a mapping against the joints of the robot.
pub(super) fn mapping(
    written: &WrittenMapping,
    robot: &Robot,
    diagnostics: &mut Diagnostics,
) -> DeclaredMapping {
    let mut joints = Vec::new();
    for (name, value) in &written.joints {
        joints.extend(diagnostics.keep(variable(name, value, robot)));
    }
    DeclaredMapping {
        joints,
        left_out: written.left_out.iter().cloned().collect(),
        has_fitted_base: written.base == Some(MappingBase::Fitted),
    }
}

fn variable(
    name: &Spanned<String>,
    value: &Spanned<WrittenMappedJoint>,
    robot: &Robot,
) -> Result<DeclaredVariable, Diagnostic> {
    let joint = robot.find_joint(name.get_ref()).map(|index| robot.joint(index));
    let Some(joint) = joint.filter(|joint| joint.kind.is_movable()) else {
        let message = format!("[mapping.joints]: the robot has no moving joint \"{}\"", name.get_ref());
        let known = known_names(name.get_ref(), "moving joints", robot.movable_joint_names());
        let fault = Diagnostic::error(codes::robot_file::UNKNOWN_JOINT, message);
        return Err(fault.at(name.span()).with_help(known));
    };
    match value.get_ref() {
        WrittenMappedJoint::Name(there) => Ok(DeclaredVariable {
            joint: joint.name.clone(),
            there: there.clone(),
            is_flipped: false,
            offset: 0.0,
        }),
        WrittenMappedJoint::Variable(written) => {
            let refused = |fault: Diagnostic| fault.at(value.span());
            if written.sign.abs() != 1 {
                let message = format!("sign of \"{}\" must be 1 or -1, it is {}", joint.name, written.sign);
                return Err(refused(Diagnostic::error(codes::robot_file::SIGN, message)));
            }
            Ok(DeclaredVariable {
                joint: joint.name.clone(),
                there: written.joint.clone().unwrap_or_else(|| joint.name.clone()),
                is_flipped: written.sign < 0,
                offset: offset(written, joint).map_err(refused)?,
            })
        }
    }
}

/// The offset in rad or m, in a unit of the joint.
fn offset(written: &WrittenVariable, joint: &Joint) -> Result<f64, Diagnostic> {
    /// No joint is counted from farther away, rad or m.
    const FARTHEST: f64 = 1e3;
    let given = [
        ("offset_rad", written.offset_rad),
        ("offset_deg", written.offset_deg),
        ("offset_m", written.offset_m),
        ("offset_mm", written.offset_mm),
    ];
    let mut given = given.into_iter().filter_map(|(key, value)| Some((key, value?)));
    let Some((key, value)) = given.next() else { return Ok(0.0) };
    let unit = WrittenUnit::of_key(key);
    let fault = |message: String| Diagnostic::error(codes::robot_file::MAPPING, message);
    if let Some((second, _)) = given.next() {
        return Err(fault(format!("the offset of \"{}\" is given by {key} and by {second}", joint.name)));
    }
    if joint.kind.is_angular() != (unit.unit == Unit::Angle) {
        let does = if joint.kind.is_angular() { "turns" } else { "slides" };
        return Err(fault(format!("{key}: joint \"{}\" {does}", joint.name)));
    }
    let offset = unit.to_si(value);
    // NaN is not in the range either.
    if !(-FARTHEST..=FARTHEST).contains(&offset) {
        return Err(fault(format!("{key} of \"{}\" is {value}, which no joint has", joint.name)));
    }
    Ok(offset)
}
