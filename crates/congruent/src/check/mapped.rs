//! Two descriptions whose joints have other names, directions or zeros: the other one in the variables of the robot, so that
//! everything that compares two descriptions works on it.

use std::collections::{BTreeMap, BTreeSet};

use congruent_agreement::{
    SourcePair,
    compare::{Agreement, CheckOptions, CheckReport},
};
use congruent_description::{
    ChainEnd, ChainEnds, JointIndex, LinkIndex, MappedJoint, Places, Robot, RobotDescription, toml_key,
    toml_string,
};
use congruent_input::number::significant;
use congruent_kinematics::{Pose, PoseError, ReportedPose, ScrewTree};
use congruent_mapping::{
    CommonAxes, FoundMapping, MatchedBy, MatchedRobots, declared, find, find_exchanged, in_frames_of,
    with_fitted,
};
use schemars::JsonSchema;
use serde::Serialize;

use super::{
    part::{kept_joints, part},
    poses_of_other::PosesOfOther,
};

/// Axes that are farther apart than this, as a share of the reach, are no proof that joints in the same order are the same.
/// Kind: choice; revisions of one robot differ by some centimetres, sizes of a family by more.
const SAME_CHAIN: f64 = 0.06;
/// Below it a direction and a zero that explain all are a convention, as a share of the reach. Kind: choice; six digits of
/// pi give a hundredth of it.
const EXPLAINED: f64 = 1e-4;
/// A smaller zero is a calibration or a mistake of a digit. Kind: choice, 5 deg.
const LEAST_ZERO_RAD: f64 = 0.087;

/// The joints of the other description in terms of this robot: `q_other = sign * q + offset`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReportedMapping {
    /// How the joints were found to be the same.
    pub matched_by: MatchedBy,
    /// The joints that both have, in the order of this robot.
    pub joints: Vec<ReportedJoint>,
    /// Moving joints of this robot that do not move in the other: they are not compared, and neither is what they carry; those
    /// that are fixed there are fixed at 0.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub left_out: Vec<String>,
    /// The same of the other description.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub other_left_out: Vec<String>,
    /// Pose of the other root in this one, if the two are not the same frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub root_from_other_root: Option<ReportedPose>,
    /// The number of other choices of directions and zeros with which the axes agree as well, as a wrist has.
    pub equivalent: usize,
    /// Whether poses agree in the same variables; missing if they were not compared.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub verdict: Option<Agreement>,
    /// The largest difference of poses in the same variables; missing if they were not compared.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub worst: Option<PoseError>,
    /// Whether the robot file declares all of it.
    pub is_declared: bool,
    /// Lines of a robot file that declare it.
    pub lines: Vec<String>,
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
}

impl ReportedJoint {
    /// Whether direction and zero are the same.
    pub fn has_same_variable(&self) -> bool {
        self.sign == 1 && self.offset == 0.0
    }
}

/// Two descriptions in the same variables.
pub(super) struct MappedPair {
    pub(super) description: RobotDescription,
    pub(super) other: RobotDescription,
    /// The options with the requested configurations in the joints that are compared.
    pub(super) options: CheckOptions,
    pub(super) report: ReportedMapping,
}

impl MappedPair {
    /// Two descriptions of which the robot file of the first declares how the joints of the second are called and counted;
    /// `None` if it does not.
    ///
    /// # Errors
    /// The other description lacks a joint that is declared.
    pub(super) fn declared(
        description: &RobotDescription,
        other: &RobotDescription,
        options: &CheckOptions,
    ) -> Result<Option<Self>, String> {
        let Some(mapping) = &description.mapping else { return Ok(None) };
        let robots = [&description.robot, &other.robot];
        let is_known = |name: &&String| robots.iter().any(|robot| robot.find_joint(name).is_some());
        if let Some(name) = mapping.left_out.iter().find(|name| !is_known(name)) {
            return Err(format!(
                "[mapping]: left_out names \"{name}\", a joint that neither description has"
            ));
        }
        let found = declared(description, other, mapping).map_err(|why| format!("[mapping]: {why}"))?;
        Ok(Some(Self::new(description, other, options, &found)))
    }

    /// Two descriptions with other joints by name; `None` if they have no chain in common.
    pub(super) fn of_other_names(
        description: &RobotDescription,
        other: &RobotDescription,
        options: &CheckOptions,
    ) -> Option<Self> {
        let found = find(description, other)?;
        let is_proved = found.matched_by != MatchedBy::Order || off(&found, description) < SAME_CHAIN;
        is_proved.then(|| Self::new(description, other, options, &found))
    }

    /// Two descriptions with the same joints by name, of which some are exchanged: their links show which is which.
    pub(super) fn of_exchanged_names(
        description: &RobotDescription,
        other: &RobotDescription,
        options: &CheckOptions,
    ) -> Option<Self> {
        let found = find_exchanged(description, other)?;
        (off(&found, description) < SAME_CHAIN).then(|| Self::new(description, other, options, &found))
    }

    /// Two descriptions with the same joints by name whose directions and zeros explain why the poses differ.
    pub(super) fn of_other_variables(
        description: &RobotDescription,
        other: &RobotDescription,
        options: &CheckOptions,
    ) -> Option<Self> {
        let found = find(description, other)?;
        let is_convention = |of: &MappedJoint| of.is_flipped || of.offset.abs() > LEAST_ZERO_RAD;
        let explains = found.joints.iter().any(is_convention) && off(&found, description) < EXPLAINED;
        explains.then(|| Self::new(description, other, options, &found))
    }

    /// The pair with the zeros that the mapping has, or with the round ones near them if digits explain the rest.
    fn new(
        description: &RobotDescription,
        other: &RobotDescription,
        options: &CheckOptions,
        found: &FoundMapping,
    ) -> Self {
        let pair = |found: &FoundMapping| Self::in_variables(description, other, options, found);
        let rounded = found.with_round_zeros([&description.robot, &other.robot]);
        let rounded = rounded.map(|found| pair(&found)).filter(Self::is_explained_by_digits);
        rounded.unwrap_or_else(|| pair(found))
    }

    fn is_explained_by_digits(&self) -> bool {
        let robots = [&self.description.robot, &self.other.robot];
        let mut poses = PosesOfOther::new(robots[0], robots[1]);
        MatchedRobots::new(robots, &mut poses).is_ok_and(|robots| robots.explained_by_digits().is_some())
    }

    fn in_variables(
        description: &RobotDescription,
        other: &RobotDescription,
        options: &CheckOptions,
        found: &FoundMapping,
    ) -> Self {
        let report = reported(description, other, found);
        let kept: BTreeSet<&str> = found.joints.iter().map(|of| of.name.as_str()).collect();
        let [locked, other_locked] = locked(description, other, &found.unmatched);
        let robot = description.robot.locked(&locked).moved_by(&kept);
        let own = if found.unmatched[0].is_empty() { description.clone() } else { part(description, robot) };
        let options =
            CheckOptions { configurations: kept_joints(description, &own, options), ..options.clone() };
        let in_variables = other.robot.locked(&other_locked).in_variables(&found.joints).moved_by(&kept);
        let axes = common_axes(found, description);
        let named_tip = (own.chain_ends.tip != ChainEnd::Chosen).then_some(own.tip);
        let in_frames =
            in_frames_of([&own.robot, &in_variables], named_tip, &found.root_from_other_root, axes);
        let is_fitted = |of: &&MappedJoint| of.offset != 0.0 && found.matched_by != MatchedBy::Declared;
        let fitted = found.joints.iter().filter(is_fitted).map(|of| of.name.as_str()).collect();
        let in_frames = with_fitted(&in_frames, &fitted, axes);
        let tip = other.robot.link(other.tip).name.clone();
        let robot = in_frames.with_link_names(&link_names(&own, &in_frames, &tip));
        let robot = if has_fitted_base(description, found) { with_other_still_links(&robot) } else { robot };
        let names = found.joints.iter().map(|of| (of.name.clone(), other.robot.joint(of.joint).name.clone()));
        let names = names.collect();
        // Which tip is meant is known by the joints; a frame that the other lacks is no obstacle then.
        let own = match own.chain_ends.tip {
            ChainEnd::Given => own,
            _ => {
                RobotDescription { chain_ends: ChainEnds { tip: ChainEnd::Chosen, ..own.chain_ends }, ..own }
            }
        };
        let there = part(other, robot);
        let urdf = there.places.urdf.clone().map(|urdf| urdf.of_rewritten(names));
        let places = Places { urdf, ..there.places };
        Self { description: own, other: RobotDescription { places, ..there }, options, report }
    }
}

impl ReportedMapping {
    /// The mapping with the largest difference of poses that the comparison of the two has found.
    pub(super) fn with_worst(self, geometry: &CheckReport) -> Self {
        let compared = geometry.comparisons.iter().find(|of| of.name == SourcePair::UrdfOther);
        Self { worst: compared.map(|of| of.worst.error), verdict: compared.map(|of| of.verdict), ..self }
    }
}

/// The names that links of the other description have in this one: of the root, of those that the joints carry, and of the tip if
/// both are the same frame.
fn link_names(own: &RobotDescription, other: &Robot, tip: &str) -> BTreeMap<LinkIndex, String> {
    let robot = &own.robot;
    let mut names = BTreeMap::from([(other.root(), robot.link(robot.root()).name.clone())]);
    for joint in other.joints().iter().filter(|joint| joint.kind.is_movable()) {
        let Some(here) = robot.find_joint(&joint.name) else { continue };
        names.insert(joint.child, robot.link(robot.joint(here).child).name.clone());
    }
    let own_tip = &robot.link(own.tip).name;
    let trees = [robot, other].map(ScrewTree::new);
    let there = other.find_link(tip).filter(|there| !names.contains_key(there));
    if let Some(there) = there.filter(|_| other.find_link(own_tip).is_none()) {
        let off = PoseError::between(trees[0].home(own.tip), trees[1].home(there));
        let is_same_body = !names.values().any(|name| name == own_tip);
        if is_same_body && off.is_within(&own.tolerance) {
            names.insert(there, own_tip.clone());
        }
    }
    names
}

/// How far the axes are apart, as a share of the reach.
fn off(found: &FoundMapping, description: &RobotDescription) -> f64 {
    let reach_m = description.tolerance_scale().reach_m().unwrap_or(1.0);
    found.distance_m / reach_m + found.angle_rad
}

/// Whether the file says that the base is fitted to the axes: then the frames that are fixed to it are no evidence.
fn has_fitted_base(description: &RobotDescription, found: &FoundMapping) -> bool {
    found.matched_by == MatchedBy::Declared
        && description.mapping.as_ref().is_some_and(|mapping| mapping.has_fitted_base)
}

/// The robot with other names of the links that are fixed to its root, so that no link of another description is one of them.
fn with_other_still_links(robot: &Robot) -> Robot {
    let is_still = |link: &LinkIndex| robot.body(*link) == robot.root() && *link != robot.root();
    let name = |link: LinkIndex| format!("{} (fixed to the fitted base)", robot.link(link).name);
    robot.with_link_names(&robot.link_indices().filter(is_still).map(|link| (link, name(link))).collect())
}

/// Whether the axes agree: a convention explains all, or what it does not explain is within the tolerance.
fn common_axes(found: &FoundMapping, description: &RobotDescription) -> CommonAxes {
    let apart = PoseError { position_m: found.distance_m, orientation_rad: found.angle_rad };
    if off(found, description) < EXPLAINED || apart.is_within(&description.tolerance) {
        CommonAxes::Agree
    } else {
        CommonAxes::Differ
    }
}

/// Of the joints without a partner those that are fixed in the other description: they are fixed at 0, to be compared with it.
fn locked(
    description: &RobotDescription,
    other: &RobotDescription,
    unmatched: &[Vec<JointIndex>; 2],
) -> [BTreeSet<JointIndex>; 2] {
    let robots = [&description.robot, &other.robot];
    let of = |from: usize| {
        let is_fixed = |joint: &JointIndex| {
            let (own, other) = (robots[from], robots[1 - from]);
            let by_name = other.find_joint(&own.joint(*joint).name);
            let by_link = other.find_link(&own.link(own.joint(*joint).child).name);
            let there = by_name.or_else(|| other.parent_joint(by_link?));
            there.is_some_and(|there| !other.joint(there).kind.is_movable())
        };
        unmatched[from].iter().copied().filter(is_fixed).collect()
    };
    [of(0), of(1)]
}

fn reported(
    description: &RobotDescription,
    other: &RobotDescription,
    found: &FoundMapping,
) -> ReportedMapping {
    let joint = |of: &MappedJoint| {
        let joint = other.robot.joint(of.joint);
        ReportedJoint {
            joint: of.name.clone(),
            other: joint.name.clone(),
            sign: if of.is_flipped { -1 } else { 1 },
            offset: of.offset,
            unit: joint.kind.unit(),
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
    let is_known = |name: &String| description.mapping.as_ref().is_some_and(|of| of.left_out.contains(name));
    let is_declared =
        found.matched_by == MatchedBy::Declared && left_out.iter().chain(&other_left_out).all(is_known);
    let root_from_other_root = (!is_same).then(|| ReportedPose::from(&root));
    ReportedMapping {
        matched_by: found.matched_by,
        lines: lines(&joints, [&left_out, &other_left_out], root_from_other_root.as_ref()),
        joints,
        left_out,
        other_left_out,
        root_from_other_root,
        equivalent: found.equivalent.len(),
        verdict: None,
        worst: None,
        is_declared,
    }
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
