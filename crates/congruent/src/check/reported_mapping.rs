//! The joints of another description in the terms of a robot, as reports have them and as a robot file declares them.

use std::collections::BTreeSet;

use congruent_agreement::{
    SourcePair,
    compare::{Agreement, CheckReport},
};
use congruent_description::{JointElement, MappedJoint, RobotDescription};
use congruent_input::{display::length, number::significant, toml_key, toml_string};
use congruent_kinematics::{Pose, PoseError, ReportedPose};
use congruent_mapping::{FoundMapping, MatchedBy};
use schemars::JsonSchema;
use serde::Serialize;

use super::{left_out::LeftOutInChain, turned_base::turned_first_joint};

/// A smaller zero is a calibration or a mistake of a digit. Kind: choice, 5 deg.
pub(super) const LEAST_ZERO_RAD: f64 = 0.087;

/// The joints of the other description in terms of this robot: `q_other = sign * q + offset`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReportedMapping {
    /// How the joints were found to be the same.
    pub matched_by: MatchedBy,
    /// The URDF or MJCF of this robot, in which the lines of joints are; missing if there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// The two files, by name.
    #[serde(skip)]
    pub(super) names: [String; 2],
    /// The joints that both have, in the order of this robot.
    pub joints: Vec<ReportedJoint>,
    /// Moving joints of this robot that do not move in the other: they are not compared, and neither is what they carry; those
    /// that are fixed there are fixed at 0.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub left_out: Vec<String>,
    /// The same of the other description.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub other_left_out: Vec<String>,
    /// Joints that are left out without a word of the robot file.
    #[serde(skip)]
    pub(super) undeclared: Vec<String>,
    /// Joints that are left out and fixed in the other description: they are held at 0 there, and what they carry is compared.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub held_at_zero: Vec<String>,
    /// Joints that are left out and carry joints of both: those of this description, then those of the other.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub left_out_in_chain: Vec<LeftOutInChain>,
    /// Pose of the other root in this one, if the two are not the same frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub root_from_other_root: Option<ReportedPose>,
    /// The first joint and the line of its origin, if another zero of it is the same motion as with this root.
    #[serde(skip)]
    pub(super) turned_first_joint: Option<(String, Option<usize>)>,
    /// Last links of branches whose axes the two files write in other coordinates: a length along these axes is not compared. Only those
    /// that are farther apart than the poses that are.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub ends_in_other_frames: Vec<ReportedEnd>,
    /// The number of other choices of directions and zeros with which the axes agree as well, as a wrist has.
    pub equivalent: usize,
    /// Whether poses agree in the same variables; missing if they were not compared.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub verdict: Option<Agreement>,
    /// The largest difference of poses in the same variables; missing if they were not compared.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub worst: Option<PoseError>,
    /// The largest difference of poses at the same values of joints of one name, as both files count them; missing if joints have other
    /// names, or if the robot file declares how they count.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub as_written: Option<PoseError>,
    /// Whether the robot file declares all of it.
    pub is_declared: bool,
    /// Lines of a robot file that declare it.
    pub lines: Vec<String>,
}

/// The last link of a branch, with another frame in each file.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReportedEnd {
    /// The link.
    pub link: String,
    /// How far the origins of both frames are apart along the axis of its joint, m.
    pub along_axis_m: f64,
}

impl ReportedEnd {
    /// `wrist_3_link lies 98.9 mm elsewhere along the axis of its joint`.
    pub fn sentence(&self) -> String {
        format!("{} lies {} elsewhere along the axis of its joint", self.link, length(self.along_axis_m))
    }
}

/// A joint of two descriptions.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReportedJoint {
    /// Its name in this description.
    pub joint: String,
    /// Its name in the other one.
    pub other: String,
    /// 1, or -1 if it moves in the opposite direction there.
    pub sign: i8,
    /// Its position there if it is at 0 here, rad or m.
    pub offset: f64,
    /// `rad` or `m`.
    pub unit: &'static str,
    /// What the variable does to the range.
    #[serde(skip)]
    pub(super) range: RangeInVariable,
    /// The line of the URDF or MJCF with the axis of a joint that has the opposite direction; missing if there is no such file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis_line: Option<usize>,
    /// The line with the origin of a joint that has another zero.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub origin_line: Option<usize>,
}

/// Whether the ranges of a joint of two files are the same in the variable that is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum RangeInVariable {
    /// As they are written: the same, other ones, or not stated.
    AsWritten,
    /// The variable makes them the same.
    Explained,
    /// They are the same as both files write them, and would have to be others.
    Contradicted,
}

impl RangeInVariable {
    fn new(description: &RobotDescription, other: &RobotDescription, of: &MappedJoint) -> Self {
        /// Ranges are given to a tenth of a degree, or to some tenths of a millimetre.
        const SAME_END: f64 = 2e-3;
        let is_near =
            |a: (f64, f64), b: (f64, f64)| (a.0 - b.0).abs() < SAME_END && (a.1 - b.1).abs() < SAME_END;
        let own = description.robot.find_joint(&of.name);
        let own = own.and_then(|own| description.robot.joint(own).position_range());
        let Some((own, there)) = own.zip(other.robot.joint(of.joint).position_range()) else {
            return Self::AsWritten;
        };
        let [from, to] = [there.0, there.1].map(|end| of.there(end));
        match (is_near(own, there), is_near(own, (from.min(to), from.max(to)))) {
            (true, false) => Self::Contradicted,
            (false, true) => Self::Explained,
            _ => Self::AsWritten,
        }
    }
}

impl ReportedJoint {
    /// Whether direction and zero are the same.
    pub fn has_same_variable(&self) -> bool {
        self.sign == 1 && self.offset == 0.0
    }
}

impl ReportedMapping {
    /// A mapping that was found or declared.
    pub(super) fn new(
        description: &RobotDescription,
        other: &RobotDescription,
        found: &FoundMapping,
    ) -> Self {
        let joint = |of: &MappedJoint| {
            let joint = other.robot.joint(of.joint);
            ReportedJoint {
                joint: of.name.clone(),
                other: joint.name.clone(),
                sign: if of.is_flipped { -1 } else { 1 },
                offset: of.offset,
                unit: joint.kind.unit(),
                range: RangeInVariable::new(description, other, of),
                axis_line: of.is_flipped.then(|| line(description, &of.name, JointElement::Axis)).flatten(),
                origin_line: (of.offset != 0.0)
                    .then(|| line(description, &of.name, JointElement::Origin))
                    .flatten(),
            }
        };
        let names = |of: usize| -> Vec<String> {
            let robot = [&description.robot, &other.robot][of];
            found.unmatched[of].iter().map(|&joint| robot.joint(joint).name.clone()).collect()
        };
        let root = Pose::from(found.root_from_other_root);
        let is_same = PoseError::between(&Pose::identity(), &root).is_within(&description.tolerance);
        let joints: Vec<ReportedJoint> = found.joints.iter().map(joint).collect();
        let (left_out, other_left_out) = (names(0), names(1));
        let is_unknown =
            |name: &&String| description.mapping.as_ref().is_none_or(|of| !of.left_out.contains(*name));
        let undeclared: Vec<String> =
            left_out.iter().chain(&other_left_out).filter(is_unknown).cloned().collect();
        let is_declared = found.matched_by == MatchedBy::Declared && undeclared.is_empty();
        let root_from_other_root = (!is_same).then(|| ReportedPose::from(&root));
        Self {
            matched_by: found.matched_by,
            file: description.places.parameters().map(|of| of.source().path.display().to_string()),
            names: [description, other].map(|of| {
                let name = of.urdf_path.file_name().unwrap_or(of.urdf_path.as_os_str());
                name.to_string_lossy().into_owned()
            }),
            lines: lines(&joints, [&left_out, &other_left_out], root_from_other_root.as_ref()),
            joints,
            turned_first_joint: turned_first_joint(description, &found.root_from_other_root)
                .map(|joint| (joint.to_owned(), line(description, joint, JointElement::Origin))),
            left_out,
            other_left_out,
            undeclared,
            held_at_zero: Vec::new(),
            left_out_in_chain: Vec::new(),
            root_from_other_root,
            ends_in_other_frames: Vec::new(),
            equivalent: found.equivalent.len(),
            verdict: None,
            worst: None,
            as_written: None,
            is_declared,
        }
    }

    /// Joints of one name that have no common axis: the files place them elsewhere.
    pub fn elsewhere(&self) -> Vec<&str> {
        let of_both = self.left_out.iter().filter(|name| self.other_left_out.contains(name));
        of_both.map(String::as_str).collect()
    }

    /// Joints that move in this file alone, and in the other alone.
    pub fn alone(&self) -> [Vec<&str>; 2] {
        let elsewhere = self.elsewhere();
        [&self.left_out, &self.other_left_out]
            .map(|names| names.iter().map(String::as_str).filter(|name| !elsewhere.contains(name)).collect())
    }

    /// By how much the base is turned, rad, if it is turned at all: rounding of lengths moves a fitted base a little.
    pub(super) fn turn_of_base_rad(&self) -> Option<f64> {
        let root = Pose::from(self.root_from_other_root.as_ref()?);
        let turn_rad = PoseError::between(&Pose::identity(), &root).orientation_rad;
        (turn_rad > LEAST_ZERO_RAD).then_some(turn_rad)
    }

    /// Joints that are left out, carry joints of both, and are held nowhere: what they carry is not compared.
    pub(super) fn free_in_chain(&self) -> impl Iterator<Item = &LeftOutInChain> {
        self.left_out_in_chain.iter().filter(|of| !self.held_at_zero.contains(&of.joint))
    }

    /// How many joints of both are compared: not those that a joint which is left out carries, unless that is held at 0.
    pub fn compared_joints(&self) -> usize {
        let carried = self.free_in_chain().flat_map(|of| &of.carries);
        let behind: BTreeSet<&str> = carried.map(String::as_str).collect();
        let is_behind = |of: &&ReportedJoint| {
            [&of.joint, &of.other].into_iter().any(|name| behind.contains(name.as_str()))
        };
        self.joints.len() - self.joints.iter().filter(is_behind).count()
    }

    /// Whether all that differs is what people choose, and no mistake of a digit: directions, and zeros next to quarter turns.
    pub(super) fn is_by_convention(&self) -> bool {
        /// Digits of pi that a file writes. Unit: rad.
        const QUARTER_RAD: f64 = 1e-2;
        let quarters = |offset: f64| offset / std::f64::consts::FRAC_PI_2;
        let is_round = |offset: f64| (quarters(offset) - quarters(offset).round()).abs() < QUARTER_RAD;
        self.joints.iter().all(|of| of.unit == "rad" && is_round(of.offset) || of.has_same_variable())
    }

    /// The joints of both files together, if no joint of both has another name, direction or zero there, and the roots are the same:
    /// some move in one file alone then.
    pub(super) fn all_of_alike(&self) -> Option<usize> {
        let is_same = |of: &ReportedJoint| of.has_same_variable() && of.joint == of.other;
        let is_alike = self.joints.iter().all(is_same) && self.root_from_other_root.is_none();
        let all = self.all_joints();
        (is_alike && all > self.joints.len()).then_some(all)
    }

    /// The joints of the file that has more of them.
    pub(super) fn all_joints(&self) -> usize {
        self.joints.len() + self.left_out.len().max(self.other_left_out.len())
    }

    /// The mapping with the largest difference of poses that the comparison of the two has found.
    pub(super) fn with_worst(mut self, geometry: &CheckReport) -> Self {
        let compared = geometry.comparisons.iter().find(|of| of.name == SourcePair::UrdfOther);
        let least_m = compared.map_or(0.0, |of| of.worst.error.position_m.max(geometry.tolerance.position_m));
        self.ends_in_other_frames.retain(|end| end.along_axis_m > least_m);
        Self { worst: compared.map(|of| of.worst.error), verdict: compared.map(|of| of.verdict), ..self }
    }

    /// The mapping with the largest difference that the comparison without it has found.
    pub(super) fn with_difference_as_written(self, geometry: &CheckReport) -> Self {
        let compared = geometry.comparisons.iter().find(|of| of.name == SourcePair::UrdfOther);
        Self { as_written: compared.map(|of| of.worst.error), ..self }
    }
}

/// The line of a part of a joint, in the URDF or MJCF of the robot.
fn line(description: &RobotDescription, joint: &str, part: JointElement) -> Option<usize> {
    let places = description.places.parameters()?;
    places.joint_part(joint, part)?.line_in(places.source())
}

/// The section of a robot file that declares a mapping.
fn lines(
    joints: &[ReportedJoint],
    left_out: [&[String]; 2],
    root_from_other_root: Option<&ReportedPose>,
) -> Vec<String> {
    let mut lines = vec!["[mapping]".to_owned()];
    let left_out: BTreeSet<&String> = left_out.into_iter().flatten().collect();
    let names: Vec<String> = left_out.into_iter().map(|name| toml_string(name)).collect();
    if !names.is_empty() {
        lines.push(format!("left_out = [{}]", names.join(", ")));
    }
    if root_from_other_root.is_some() {
        lines.push("base = \"fitted\"".to_owned());
    }
    let is_other = |of: &&ReportedJoint| !of.has_same_variable() || of.joint != of.other;
    let mut joints = joints.iter().filter(is_other).peekable();
    if joints.peek().is_some() {
        lines.push("[mapping.joints]".to_owned());
    }
    lines.extend(joints.map(|of| format!("{} = {}", toml_key(&of.joint), value(of))));
    lines
}

/// The value of a joint in `[mapping.joints]`: its name in the other description, with what differs in its variable.
fn value(of: &ReportedJoint) -> String {
    let name = toml_string(&of.other);
    if of.has_same_variable() {
        return name;
    }
    let sign = if of.sign < 0 { ", sign = -1" } else { "" };
    let offset = if of.offset == 0.0 { String::new() } else { format!(", {}", offset(of)) };
    format!("{{ joint = {name}{sign}{offset} }}")
}

/// The offset in the unit in which it has fewer digits.
fn offset(of: &ReportedJoint) -> String {
    let si = significant(of.offset);
    let (unit, other) = match of.unit {
        "rad" => ("deg", significant(of.offset.to_degrees())),
        _ => ("mm", significant(of.offset * 1e3)),
    };
    if other.len() < si.len() {
        format!("offset_{unit} = {other}")
    } else {
        format!("offset_{} = {si}", of.unit)
    }
}
