//! Configurations by joint name, as batch commands read them: JSON, SI units.

mod json_list;
mod outside;
mod unique;

use std::{collections::BTreeMap, ops::Range, path::Path};

use schemars::{JsonSchema, Schema, schema_for};
use serde::Deserialize;

use crate::{
    diagnostic::{Diagnostic, known_names},
    files::{FileAccess, InputFile},
    model::{Robot, RobotQ},
};

pub use self::{
    json_list::JsonList,
    outside::{outside_limits, outside_limits_warning},
    unique::unique_names,
};

/// How far a given mimic position or speed may be from what its master implies. Kind: digits of the file.
const MIMIC_DIGITS: f64 = 1e-9;
/// What a file of configurations is.
const LIST: JsonList = JsonList {
    entry: "configuration",
    code: "configurations::json",
    help: r#"expected a JSON array: [{"q": {"joint name": 0.1}}]"#,
};
/// Largest file of configurations that is read.
const MOST_BYTES: u64 = 256 << 20;

/// One entry of a batch, joints by name; joints of groups that a command does not use are checked too.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Configuration")]
struct WrittenConfiguration {
    /// Positions in rad and m; joints that are not named are at 0.
    #[serde(default, deserialize_with = "unique_names")]
    q: BTreeMap<String, f64>,
    /// Velocities in rad/s and m/s.
    #[serde(default, deserialize_with = "unique_names")]
    v: BTreeMap<String, f64>,
    /// Torques in N m and forces in N.
    #[serde(default, deserialize_with = "unique_names")]
    tau: BTreeMap<String, f64>,
    /// Accelerations in rad/s² and m/s².
    #[serde(default, deserialize_with = "unique_names")]
    a: BTreeMap<String, f64>,
}

/// The JSON schema of files of configurations.
pub fn configurations_schema() -> Schema {
    schema_for!(Vec<WrittenConfiguration>)
}

/// One entry of a batch in full: one value for each movable joint.
#[derive(Debug, Clone, PartialEq)]
pub struct JointState {
    /// Positions in rad and m.
    pub q: RobotQ,
    /// Speeds in rad/s and m/s.
    pub qd: Vec<f64>,
    /// Accelerations in rad/s^2 and m/s^2.
    pub qdd: Vec<f64>,
    /// Torques in N m and forces in N.
    pub tau: Vec<f64>,
}

/// The entries of a file of configurations.
#[derive(Debug, Clone, PartialEq)]
pub struct Configurations<T> {
    /// In the order of the file, at least one.
    pub entries: Vec<T>,
    /// Given positions outside the joint limits.
    pub warning: Option<Diagnostic>,
    /// The file; `None` if they come from none.
    pub input: Option<InputFile>,
}

/// Reads a file of configurations: a JSON array of `{"q": {joint: value}, ...}` in rad and m,
/// missing joints 0. The result holds configuration vectors of the robot.
///
/// # Errors
/// The file cannot be read, is no such array, is empty, or names an unknown joint.
pub fn read_configurations(path: &Path, robot: &Robot) -> Result<Configurations<RobotQ>, Vec<Diagnostic>> {
    read(path, robot, |written| configuration(&written.q, robot))
}

/// The same with the speeds `"v"`, the accelerations `"a"` and the torques `"tau"`, missing ones 0; mimic joints
/// have the speeds and accelerations that their masters imply.
///
/// # Errors
/// As [`read_configurations`], or a mimic joint has another speed or acceleration than its master implies.
pub fn read_states(path: &Path, robot: &Robot) -> Result<Configurations<JointState>, Vec<Diagnostic>> {
    let in_ratio = |values: &BTreeMap<String, f64>| {
        Ok::<_, Diagnostic>(
            followed(values, robot, |robot, rates| robot.apply_mimic_to_speeds(rates))?.to_vec(),
        )
    };
    let state = |written: &WrittenConfiguration| {
        let (q, tau) = (configuration(&written.q, robot)?, place(&written.tau, robot)?.to_vec());
        Ok(JointState { q, qd: in_ratio(&written.v)?, qdd: in_ratio(&written.a)?, tau })
    };
    read(path, robot, state)
}

fn read<T>(
    path: &Path,
    robot: &Robot,
    vectors: impl Fn(&WrittenConfiguration) -> Result<T, Diagnostic>,
) -> Result<Configurations<T>, Vec<Diagnostic>> {
    let access = FileAccess::default();
    let source = access.read_named_text(path, MOST_BYTES)?;
    let (mut index, mut outside, mut first_outside) = (0, Vec::new(), None);
    let entry = |written: WrittenConfiguration, place: Range<usize>| {
        index += 1;
        for group in [&written.v, &written.tau, &written.a] {
            self::place(group, robot)?;
        }
        let found = outside_limits(&written.q, robot);
        if !found.is_empty() {
            first_outside.get_or_insert(place);
        }
        outside.extend(found.into_iter().map(|what| format!("configuration {index}: {what}")));
        vectors(&written)
    };
    let entries = LIST
        .read(&source.text, entry)
        .and_then(|entries| if entries.is_empty() { Err(vec![no_entry()]) } else { Ok(entries) })
        .map_err(|faults| faults.into_iter().map(|fault| fault.in_file(&source)).collect::<Vec<_>>())?;
    let warning = outside_limits_warning(&outside)
        .map(|warning| warning.at(first_outside.unwrap_or_default()).in_file(&source));
    Ok(Configurations { entries, warning, input: access.files().pop() })
}

fn no_entry() -> Diagnostic {
    Diagnostic::error("configurations::none", "there are no configurations in the list")
        .at(0..0)
        .with_help(r#"one configuration with all joints at 0 is [{"q": {}}]"#)
}

/// The configuration vector that has these joints at these positions (rad or m), others at 0,
/// mimic joints as their masters imply.
///
/// # Errors
/// A joint is unknown, or a mimic joint has another position than its master implies.
pub fn configuration(values: &BTreeMap<String, f64>, robot: &Robot) -> Result<RobotQ, Diagnostic> {
    followed(values, robot, Robot::apply_mimic)
}

/// Values by name as a vector in which mimic joints follow their masters.
fn followed(
    values: &BTreeMap<String, f64>,
    robot: &Robot,
    apply_mimic: fn(&Robot, &mut RobotQ),
) -> Result<RobotQ, Diagnostic> {
    let mut vector = place(values, robot)?;
    let given = vector.clone();
    apply_mimic(robot, &mut vector);
    for ((&joint, implied), given) in robot.movable_joints().iter().zip(vector.iter()).zip(given.iter()) {
        let name = &robot.joint(joint).name;
        if values.contains_key(name) && (implied - given).abs() > MIMIC_DIGITS {
            let message = format!(
                "joint \"{name}\" is given as {given}, but the joint that it mimics implies {implied}"
            );
            return Err(Diagnostic::error("configurations::mimic", message)
                .with_help("leave mimic joints out, or give the value that their master implies"));
        }
    }
    Ok(vector)
}

fn place(values: &BTreeMap<String, f64>, robot: &Robot) -> Result<RobotQ, Diagnostic> {
    let mut vector = RobotQ::zeros(robot.dof());
    for (name, &value) in values {
        let coordinate = robot.find_joint(name).and_then(|joint| robot.coordinate(joint));
        let Some(coordinate) = coordinate else {
            let joints = robot.movable_joint_names();
            let message = format!("robot \"{}\" has no moving joint \"{name}\"", robot.name());
            return Err(Diagnostic::error("configurations::unknown_joint", message)
                .with_help(known_names(name, "joints", joints)));
        };
        vector[coordinate] = value;
    }
    Ok(vector)
}
