//! Reads files of configurations, entry by entry.

use std::{collections::BTreeMap, ops::Range, path::Path};

use congruent_description::{Robot, RobotQ, RobotQList};
use congruent_input::{Diagnostic, Findings, InputFile, TextLines, known_names};
use congruent_tables::{JsonList, is_csv};
use schemars::{Schema, schema_for};

use crate::{
    beyond_limits::{OutsideLimits, outside_limits},
    codes,
    states::{JointState, JointStateList},
    table::read_rows,
    written::WrittenConfiguration,
};

/// How far a given mimic position (rad, m) or speed may be from the value that follows from its master. Kind: digits of the
/// file.
const MIMIC_DIGITS: f64 = 1e-9;
/// The words and codes of messages about files of configurations.
pub(super) const LIST: JsonList = JsonList {
    entry: "configuration",
    code: codes::configurations::JSON,
    help: r#"expected one configuration per line (JSON Lines), {"q": {"joint name": 0.1}}, or an array of them in [ ]"#,
};
/// Size limit of a file of configurations, bytes.
pub(super) const MOST_BYTES: u64 = 256 << 20;

impl WrittenConfiguration {
    /// The state; joints of all groups must be known, also of those that a command does not use.
    pub(super) fn state(&self, robot: &Robot) -> Result<JointState, Diagnostic> {
        let in_ratio = |values: &BTreeMap<String, f64>| {
            followed(values, robot, |robot, rates| robot.apply_mimic_to_speeds(rates))
                .map(|rates| rates.to_vec())
        };
        let (q, tau) = (configuration(&self.q, robot)?, place(&self.tau, robot)?.to_vec());
        Ok(JointState { q, qd: in_ratio(&self.v)?, qdd: in_ratio(&self.a)?, tau })
    }
}

/// The JSON schema of files of configurations.
pub fn configurations_schema() -> Schema {
    schema_for!(Vec<WrittenConfiguration>)
}

/// The contents of a file of configurations.
#[derive(Debug, Clone, PartialEq)]
pub struct Configurations<List> {
    /// The entries in the order of the file, at least one.
    pub entries: List,
    /// A warning of positions outside the joint limits; `None` if there are none.
    pub warning: Option<Diagnostic>,
    /// The file that was read; `None` if the configurations were given otherwise.
    pub input: Option<InputFile>,
}

/// Reads a file of configurations in rad and m, missing joints 0: `{"q": {joint: value}, ...}` on each line (JSON Lines), or
/// a JSON array of at most 100,000 of them. Lines are read once and not kept: memory is taken by the values alone. A file whose
/// name ends in .csv is a table, with columns such as `elbow_deg` or those of a run's table.
///
/// # Errors
/// The file cannot be read, is no such list, is empty, or names an unknown joint.
pub fn read_configurations(path: &Path, robot: &Robot) -> Result<Configurations<RobotQList>, Findings> {
    read_configurations_from(TextLines::open(path, MOST_BYTES)?, robot)
}

/// [`read_configurations`] of a file that is open.
///
/// # Errors
/// As [`read_configurations`].
pub fn read_configurations_from(
    lines: TextLines,
    robot: &Robot,
) -> Result<Configurations<RobotQList>, Findings> {
    let mut list = RobotQList::new(robot.dof());
    let add = |written: &WrittenConfiguration| {
        list.push(&configuration(&written.q, robot)?);
        Ok(())
    };
    let (warning, input) = read(lines, robot, add)?;
    Ok(Configurations { entries: list, warning, input: Some(input) })
}

/// The same with the speeds `"v"`, the accelerations `"a"` and the torques `"tau"`, missing ones 0; mimic joints
/// have the speeds and accelerations that their masters imply.
///
/// # Errors
/// As [`read_configurations`], or a mimic joint has another speed or acceleration than its master implies.
pub fn read_states(path: &Path, robot: &Robot) -> Result<Configurations<JointStateList>, Findings> {
    read_states_from(TextLines::open(path, MOST_BYTES)?, robot)
}

/// [`read_states`] of a file that is open.
///
/// # Errors
/// As [`read_states`].
pub fn read_states_from(lines: TextLines, robot: &Robot) -> Result<Configurations<JointStateList>, Findings> {
    let mut list = JointStateList::new(robot.dof());
    let add = |written: &WrittenConfiguration| {
        list.push(&written.state(robot)?);
        Ok(())
    };
    let (warning, input) = read(lines, robot, add)?;
    Ok(Configurations { entries: list, warning, input: Some(input) })
}

/// Reads a file whose entries are added to a list; the warning about positions outside the limits.
fn read(
    lines: TextLines,
    robot: &Robot,
    mut add: impl FnMut(&WrittenConfiguration) -> Result<(), Diagnostic>,
) -> Result<(Option<Diagnostic>, InputFile), Findings> {
    let (mut index, mut outside, mut first_outside) = (0, OutsideLimits::default(), None);
    let entry = |written: WrittenConfiguration, place: &mut dyn FnMut() -> Range<usize>| {
        index += 1;
        for group in [&written.v, &written.tau, &written.a] {
            self::place(group, robot)?;
        }
        let found = outside_limits(&written.q, robot);
        if !found.is_empty() {
            first_outside.get_or_insert_with(place);
        }
        for what in found {
            outside.add(|| format!("configuration {index}: {what}"));
        }
        add(&written)
    };
    let (input, source) = if is_csv(lines.path()) {
        let (input, source) = lines.whole()?;
        let in_file = |fault: Diagnostic| fault.in_file(&source);
        read_rows(&source.text, robot, entry)
            .map_err(|faults| faults.into_iter().map(in_file).collect::<Findings>())?;
        (input, source)
    } else {
        LIST.read_file(lines, entry)?
    };
    if index == 0 {
        return Err(no_entry().in_file(&source).into());
    }
    let warning = outside.warning();
    Ok((warning.map(|warning| warning.at(first_outside.unwrap_or_default()).in_file(&source)), input))
}

fn no_entry() -> Diagnostic {
    Diagnostic::error(codes::configurations::NONE, "the list has no configurations")
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
            return Err(Diagnostic::error(codes::configurations::MIMIC, message).with_help(
                "leave mimic joints out, or give the value that follows from the mimicked joint",
            ));
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
            return Err(Diagnostic::error(codes::configurations::UNKNOWN_JOINT, message)
                .with_help(known_names(name, "joints", joints)));
        };
        vector[coordinate] = value;
    }
    Ok(vector)
}
