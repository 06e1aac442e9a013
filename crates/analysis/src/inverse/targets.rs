//! Targets of inverse kinematics: poses of the tool in link `base`, as a person or a file gives them.

use std::{collections::BTreeMap, f64::consts::TAU, ops::Range, path::Path, sync::Arc};

use congruent_configurations::{LiveEntries, LiveInput, configuration};
use congruent_description::Robot;
use congruent_input::{
    Diagnostic, Findings, SourceFile, TextLines, display::limit_number, read_text,
    rotation_from_rpy_fixed_xyz, units::LARGEST,
};
use congruent_kinematics::{IkTarget, Pose, TargetPart};
use congruent_tables::{JsonList, is_csv};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

use super::{table::read_rows, written_target::WrittenTarget};
use crate::codes;

/// A file of targets as a list.
const LIST: JsonList = JsonList {
    entry: "target",
    code: codes::targets::JSON,
    help: r#"expected [{"translation_m": [x, y, z], "quaternion_wxyz": [w, x, y, z], "start": {"joint": 0.1}}]"#,
};
/// Largest file of targets that is read.
const MOST_BYTES: u64 = 256 << 20;
/// How far the norm of a written quaternion may be from 1. Kind: six digits in the file.
const QUATERNION_NORM: f64 = 1e-6;

/// A pose to be reached, and the start of the search.
#[derive(Debug, Clone, PartialEq)]
pub struct InverseTarget {
    /// The pose of the tool in link `base`, or its position alone.
    pub target: IkTarget,
    /// Joints with a given start, by name, in rad or m; others start at the middle of their range.
    pub start: BTreeMap<String, f64>,
}

impl InverseTarget {
    /// The tool at `tcp_in_base_m`, turned by roll, pitch and yaw about the fixed axes of the base; without them in any
    /// orientation.
    pub fn new(tcp_in_base_m: [f64; 3], rpy_fixed_xyz_rad: Option<[f64; 3]>) -> Self {
        let part = if rpy_fixed_xyz_rad.is_some() { TargetPart::Pose } else { TargetPart::Position };
        let rotation = rotation_from_rpy_fixed_xyz(rpy_fixed_xyz_rad.unwrap_or_default());
        let pose = Isometry3::from_parts(Translation3::from(tcp_in_base_m), rotation);
        Self { target: IkTarget { base_from_tcp: Pose::from(pose), part }, start: BTreeMap::new() }
    }
}

/// A file of targets.
#[derive(Debug, Clone, PartialEq)]
pub struct InverseTargets {
    /// In the order of the file.
    pub targets: Vec<InverseTarget>,
    /// Starts outside the limits: the search begins at the nearest position within.
    pub warnings: Vec<Diagnostic>,
}

/// Reads a file of targets: a table (.csv) with columns such as `x_mm` and `yaw_deg`, or a JSON array of
/// `{"translation_m": [x, y, z], "quaternion_wxyz": [...], "start": {joint: value}}`, the last two optional; poses of the tool in link `base`.
///
/// # Errors
/// The file cannot be read, is no such array, names an unknown joint or has a quaternion not of unit length.
pub fn read_targets(path: &Path, robot: &Robot) -> Result<InverseTargets, Findings> {
    read_targets_of(&read_text(path, MOST_BYTES)?, robot)
}

/// [`read_targets`] of a file that is open.
///
/// # Errors
/// As [`read_targets`].
pub fn read_targets_from(lines: TextLines, robot: &Robot) -> Result<InverseTargets, Findings> {
    read_targets_of(&lines.whole()?.1, robot)
}

fn read_targets_of(source: &Arc<SourceFile>, robot: &Robot) -> Result<InverseTargets, Findings> {
    let in_file = |found: Diagnostic| found.in_file(source);
    let (mut warnings, mut index) = (Vec::new(), 0);
    let entry = |written: WrittenTarget, place: Range<usize>| {
        index += 1;
        let target = checked(written, robot)?;
        warnings.extend(start_warnings(&target, index, robot).map(|warning| warning.at(place.clone())));
        Ok(target)
    };
    let targets = if is_csv(&source.path) {
        read_rows(&source.text, robot, entry)
    } else {
        LIST.read(&source.text, entry)
    };
    let targets = targets.map_err(|faults| faults.into_iter().map(in_file).collect::<Findings>())?;
    Ok(InverseTargets { targets, warnings: warnings.into_iter().map(in_file).collect() })
}

fn start_warnings(target: &InverseTarget, number: usize, robot: &Robot) -> impl Iterator<Item = Diagnostic> {
    let outside = target.start.iter().filter_map(|(name, &value)| outside(robot, name, value));
    outside.map(move |what| {
        Diagnostic::warning(codes::targets::START, format!("target {number}: {what}"))
            .with_help("the search begins at the nearest position within the limits")
    })
}

/// Targets that come one by one.
pub struct LiveTargets(LiveEntries);

impl LiveTargets {
    /// Opens what a person names, and waits for its first line.
    ///
    /// # Errors
    /// It cannot be read, or is empty or no text.
    pub fn open(path: &Path) -> Result<LiveInput<Self>, Diagnostic> {
        Ok(match LiveEntries::open(LIST, path, MOST_BYTES)? {
            LiveInput::Lines(entries) => LiveInput::Lines(Self(entries)),
            LiveInput::Whole(lines) => LiveInput::Whole(lines),
        })
    }

    /// The next target alone, with its number from 1; waits for its line. `None` at the end.
    ///
    /// # Errors
    /// The line is no target for the robot.
    pub fn next_target(&mut self, robot: &Robot) -> Result<Option<(usize, InverseTargets)>, Diagnostic> {
        let read = self.0.next_entry(|written: WrittenTarget| checked(written, robot))?;
        Ok(read.map(|(number, target)| {
            let warnings = start_warnings(&target, number, robot).collect();
            (number, InverseTargets { targets: vec![target], warnings })
        }))
    }
}

/// The limits that a start is outside of, unless whole turns of the joint bring it within.
fn outside(robot: &Robot, name: &str, value: f64) -> Option<String> {
    let joint = robot.joint(robot.find_joint(name)?);
    let limit = joint.limit?;
    // The solver does the same with a start, so a start one turn away is no reason for a warning.
    let turned = if joint.kind.is_angular() && value > limit.upper {
        value - TAU * ((value - limit.upper) / TAU).ceil()
    } else if joint.kind.is_angular() && value < limit.lower {
        value + TAU * ((limit.lower - value) / TAU).ceil()
    } else {
        value
    };
    let is_outside = turned < limit.lower || turned > limit.upper;
    is_outside.then(|| {
        let [value, lower, upper] = [value, limit.lower, limit.upper].map(limit_number);
        let unit = joint.kind.unit();
        format!("start {value} {unit} of \"{name}\" is outside its limits {lower} {unit} to {upper} {unit}")
    })
}

fn checked(written: WrittenTarget, robot: &Robot) -> Result<InverseTarget, Diagnostic> {
    configuration(&written.start, robot)?;
    if let Some(far) = written.translation_m.iter().find(|coordinate| coordinate.abs() > LARGEST) {
        let message = format!("translation_m has {far}, which is beyond {LARGEST:e} m");
        return Err(Diagnostic::error(codes::targets::TRANSLATION, message));
    }
    let (part, rotation) = match written.quaternion_wxyz {
        Some(wxyz) => (TargetPart::Pose, unit_quaternion(wxyz)?),
        None => (TargetPart::Position, UnitQuaternion::identity()),
    };
    let base_from_tcp =
        Pose::from(Isometry3::from_parts(Translation3::from(written.translation_m), rotation));
    Ok(InverseTarget { target: IkTarget { base_from_tcp, part }, start: written.start })
}

fn unit_quaternion([w, x, y, z]: [f64; 4]) -> Result<UnitQuaternion<f64>, Diagnostic> {
    let quaternion = Quaternion::new(w, x, y, z);
    let norm = quaternion.norm();
    if (norm - 1.0).abs() <= QUATERNION_NORM {
        return Ok(UnitQuaternion::from_quaternion(quaternion));
    }
    let message = format!("quaternion_wxyz has norm {norm:.7}, it must be 1 within {QUATERNION_NORM}");
    Err(Diagnostic::error(codes::targets::QUATERNION_NORM, message).with_help(
        "write the quaternion with more digits, in the order w, x, y, z: it is not normalised for you",
    ))
}
