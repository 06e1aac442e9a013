//! Two descriptions whose joints have other names, directions or zeros: the other one in the variables of the robot, so that
//! everything that compares two descriptions works on it.

use std::collections::BTreeSet;

use congruent_agreement::compare::CheckOptions;
use congruent_description::{ChainEnd, ChainEnds, JointIndex, MappedJoint, Robot, RobotDescription};
use congruent_kinematics::PoseError;
use congruent_mapping::{
    CommonAxes, EndInOtherFrames, FoundMapping, MatchedBy, MatchedRobots, declared, ends_in_other_frames,
    find, find_exchanged, has_other_frames, in_frames_of, link_names, with_fitted, with_fitted_base,
    with_other_still_links,
};

use super::{
    left_out::LeftOutInChain,
    part::{kept_joints, part},
    poses_of_other::matched_robots,
    reported_mapping::{LEAST_ZERO_RAD, ReportedEnd, ReportedMapping},
};

/// Axes that are farther apart than this, as a share of the reach, are no proof that joints in the same order are the same.
/// Kind: choice; revisions of one robot differ by some centimetres, sizes of a family by more.
const SAME_CHAIN: f64 = 0.06;
/// Below it a direction and a zero that explain all are a convention, as a share of the reach. Kind: choice; six digits of
/// pi give a hundredth of it.
const EXPLAINED: f64 = 1e-4;
/// A frame that is farther off, as a multiple of what the axes are apart, lies elsewhere in its link. Kind: choice.
const OTHER_FRAME: f64 = 10.0;
/// Most joints of the same names whose directions and zeros are searched. Kind: time, which grows with the third power: minutes for
/// 200.
const MOST_JOINTS: usize = 60;

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

    /// Two descriptions with the same joints by name whose directions and zeros, or a turned base, explain most of why the poses
    /// differ.
    pub(super) fn of_other_variables(
        description: &RobotDescription,
        other: &RobotDescription,
        options: &CheckOptions,
    ) -> Option<Self> {
        if description.robot.movable_joints().len() > MOST_JOINTS {
            return None;
        }
        let found = find(description, other)?;
        let is_convention = |of: &MappedJoint| of.is_flipped || of.offset.abs() > LEAST_ZERO_RAD;
        let is_turned = found.root_from_other_root.rotation.angle() > LEAST_ZERO_RAD;
        let has_convention = is_turned || found.joints.iter().any(is_convention);
        let explains = has_convention && off(&found, description) < SAME_CHAIN;
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
        let rounded =
            rounded.map(|found| (pair(&found), found)).filter(|(pair, _)| pair.is_explained_by_digits());
        let (mapped, found) = rounded.unwrap_or_else(|| (pair(found), found.clone()));
        let declared = |found: &FoundMapping| {
            pair(&FoundMapping { matched_by: MatchedBy::Declared, ..found.clone() }).is_explained_by_digits()
        };
        // Zeros that are fitted to the axes may be beside those that the digits explain, and are no lines to declare then.
        match mapped.zeros_of_digits(&found) {
            Some(moved) if !declared(&found) => {
                let rounded = moved.with_rounded_zeros();
                let best = [rounded, moved].into_iter().find(declared);
                best.map_or(mapped, |found| pair(&found))
            }
            _ => mapped,
        }
    }

    /// The mapping with the zeros at which the digits explain the rest; `None` if they do not, or explain it without another zero.
    fn zeros_of_digits(&self, found: &FoundMapping) -> Option<FoundMapping> {
        let robots = self.matched_robots()?;
        let zeros = robots.zeros_by_digits().filter(|_| found.matched_by != MatchedBy::Declared)?;
        let mut moved = found.clone();
        for joint in moved.joints.iter_mut().filter(|of| of.offset != 0.0) {
            joint.offset += joint.sign() * zeros.get(joint.name.as_str()).copied().unwrap_or_default();
        }
        (moved != *found).then_some(moved)
    }

    fn is_explained_by_digits(&self) -> bool {
        self.matched_robots().is_some_and(|robots| robots.explained_by_digits().is_some())
    }

    fn matched_robots(&self) -> Option<MatchedRobots<'_>> {
        matched_robots([&self.description.robot, &self.other.robot])
    }

    fn in_variables(
        description: &RobotDescription,
        other: &RobotDescription,
        options: &CheckOptions,
        found: &FoundMapping,
    ) -> Self {
        let mut report = ReportedMapping::new(description, other, found);
        let kept: BTreeSet<&str> = found.joints.iter().map(|of| of.name.as_str()).collect();
        let [locked, other_locked] = locked(description, other, &found.unmatched);
        report.held_at_zero = [(description, &locked), (other, &other_locked)]
            .into_iter()
            .flat_map(|(of, locked)| locked.iter().map(|&joint| of.robot.joint(joint).name.clone()))
            .collect();
        report.left_out_in_chain = left_out_in_chain([description, other], found);
        let robot = description.robot.locked(&locked).moved_by(&kept);
        let own = if found.unmatched[0].is_empty() { description.clone() } else { part(description, robot) };
        let options =
            CheckOptions { configurations: kept_joints(description, &own, options), ..options.clone() };
        let in_variables = other.robot.locked(&other_locked).in_variables(&found.joints).moved_by(&kept);
        let axes = common_axes(found, description, [&own.robot, &in_variables]);
        report.ends_in_other_frames = ends([&own.robot, &in_variables], found);
        let named_tip = (own.chain_ends.tip != ChainEnd::Chosen).then_some(own.tip);
        let misplaced = found.joints.iter().filter(|of| found.misplaced.contains(&of.joint));
        let misplaced = misplaced.map(|of| of.name.as_str()).collect();
        let root = &found.root_from_other_root;
        let in_frames = in_frames_of([&own.robot, &in_variables], named_tip, root, axes, &misplaced);
        let is_fitted = |of: &&MappedJoint| of.offset != 0.0 && found.matched_by != MatchedBy::Declared;
        let fitted = found.joints.iter().filter(is_fitted).map(|of| of.name.as_str()).collect();
        let in_frames = with_fitted(&in_frames, &fitted);
        let tip = other.robot.link(other.tip).name.clone();
        let link_names = link_names(&own, &in_frames, &tip);
        let robot = in_frames.with_link_names(&link_names);
        let robot =
            if found.has_fitted_base { with_fitted_base(&with_other_still_links(&robot)) } else { robot };
        let names = found.joints.iter().map(|of| (of.name.clone(), other.robot.joint(of.joint).name.clone()));
        let link_names =
            link_names.iter().map(|(&link, name)| (name.clone(), in_frames.link(link).name.clone()));
        // Which tip is meant is known by the joints; a frame that the other lacks is no obstacle then.
        let own = match own.chain_ends.tip {
            ChainEnd::Given => own,
            _ => {
                RobotDescription { chain_ends: ChainEnds { tip: ChainEnd::Chosen, ..own.chain_ends }, ..own }
            }
        };
        let there = part(other, robot);
        let places = there.places.clone().of_rewritten(&names.collect(), &link_names.collect());
        Self { description: own, other: RobotDescription { places, ..there }, options, report }
    }
}

/// The joints of each description that are left out and carry joints of both.
fn left_out_in_chain(
    [description, other]: [&RobotDescription; 2],
    found: &FoundMapping,
) -> Vec<LeftOutInChain> {
    let own = found.joints.iter().filter_map(|of| description.robot.find_joint(&of.name));
    let common = [own.collect(), found.joints.iter().map(|of| of.joint).collect::<Vec<_>>()];
    let of = |at: usize| {
        let robot = &[description, other][at].robot;
        LeftOutInChain::of(robot, &found.unmatched[at], &common[at])
    };
    let mut both = of(0);
    both.extend(of(1).into_iter().filter(|there| {
        description.robot.find_joint(&there.joint).is_none_or(|own| !found.unmatched[0].contains(&own))
    }));
    both
}

/// The last links of branches whose frames are chosen otherwise in the two files.
fn ends([robot, other]: [&Robot; 2], found: &FoundMapping) -> Vec<ReportedEnd> {
    let ends = ends_in_other_frames([robot, other], &found.root_from_other_root);
    let named = |end: EndInOtherFrames| ReportedEnd {
        link: robot.link(end.link).name.clone(),
        along_axis_m: end.along_axis_m,
    };
    ends.into_iter().map(named).collect()
}

/// How far the axes are apart, as a share of the reach.
fn off(found: &FoundMapping, description: &RobotDescription) -> f64 {
    let reach_m = description.tolerance_scale().reach_m().unwrap_or(1.0);
    found.distance_m / reach_m + found.angle_rad
}

/// Whether the axes agree: a convention explains all, or what it does not explain is within the tolerance, or far less than what
/// the frames of links differ in.
fn common_axes(found: &FoundMapping, description: &RobotDescription, robots: [&Robot; 2]) -> CommonAxes {
    let apart = PoseError { position_m: found.distance_m, orientation_rad: found.angle_rad };
    let off = off(found, description);
    let has_other_frames =
        || has_other_frames(robots, &found.root_from_other_root, OTHER_FRAME * found.distance_m);
    if off < EXPLAINED || apart.is_within(&description.tolerance) || (off < SAME_CHAIN && has_other_frames())
    {
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
