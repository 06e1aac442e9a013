//! The fewest corrections of joints after which two descriptions agree.

use congruent_description::{LinkIndex, Robot, RobotQ};
use congruent_kinematics::{LinkPoses, LinkPosesError, Pose, PoseError, UrdfTree};

use super::{
    correction::{JointCorrection, JointPart, between, corrected, corrections, moved_to},
    displacement::{displaced, moves_alike},
    matched::{ComparedAt, MatchedRobots},
};
use crate::diagnosis::thresholds::MAX_PARAMETERS;

/// Corrections of joints that explain the difference of two descriptions.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ExplainedByJoints {
    /// The one with the largest effect first.
    pub(crate) corrections: Vec<JointCorrection>,
    /// The largest difference before any correction, and after each.
    pub(crate) worst: Vec<PoseError>,
    /// Corrections of other joints with the same effect as the only one.
    pub(crate) alternatives: Vec<JointCorrection>,
}

impl ExplainedByJoints {
    /// Whether several origins differ by the factor between millimetres and metres.
    pub(crate) fn may_be_unit(&self, robots: &MatchedRobots<'_>) -> bool {
        let is_scaled = |of: &JointCorrection| {
            let JointPart::Origin(expected) = of.expected else { return false };
            let found = robots.robot.joint(of.joint).parent_from_joint.translation.vector.norm();
            let ratio = found / expected.translation.vector.norm();
            [1e3, 1e-3].iter().any(|factor| (ratio / factor - 1.0).abs() < SAME_RATIO)
        };
        self.corrections.len() > 1 && self.corrections.iter().all(is_scaled)
    }
}

/// Lengths of a file with few digits have a ratio within this. No unit; kind: digits of a file.
const SAME_RATIO: f64 = 1e-2;

/// The corrections of joints that explain the difference; `None` if there are none, too many, or if the two differ only
/// in where frames lie in links that move alike.
///
/// # Errors
/// [`LinkPosesError`] if a source rejects a configuration.
pub(crate) fn explained_by_joints(
    robots: &MatchedRobots<'_>,
    poses: &mut dyn LinkPoses,
    at: &ComparedAt<'_>,
) -> Result<Option<ExplainedByJoints>, LinkPosesError> {
    let mut all = corrections(robots);
    if all.len() > 1 && moves_alike(robots, at) {
        return Ok(None);
    }
    all.sort_by(|one, other| other.size_m.total_cmp(&one.size_m));
    all.truncate(MAX_PARAMETERS);
    let every_link = |link| robots.is_matched(link);
    let mut difference = Difference::new(robots, poses, &every_link);
    if !difference.is_within(&corrected(robots.robot, &all), at)? {
        return single_displacement(robots, poses, at);
    }
    let mut worst = vec![difference.worst(robots.robot, at)?];
    for count in 1..=all.len() {
        worst.push(difference.worst(&corrected(robots.robot, &all[..count]), at)?);
        if worst[count].is_within(at.tolerance) {
            all.truncate(count);
            break;
        }
    }
    let alternatives = if let [only] = all[..] { elsewhere(robots, only) } else { Vec::new() };
    Ok((!all.is_empty()).then_some(ExplainedByJoints { corrections: all, worst, alternatives }))
}

/// One displacement of the chain, if frames of links lie elsewhere as well: the tip decides.
fn single_displacement(
    robots: &MatchedRobots<'_>,
    poses: &mut dyn LinkPoses,
    at: &ComparedAt<'_>,
) -> Result<Option<ExplainedByJoints>, LinkPosesError> {
    let mut places = displaced(robots, at);
    if places.is_empty() {
        return Ok(None);
    }
    let only = places.remove(0);
    let at_tip = |link| link == at.tip;
    let mut difference = Difference::new(robots, poses, &at_tip);
    let worst = [
        difference.worst(robots.robot, at)?,
        difference.worst(&corrected(robots.robot, std::slice::from_ref(&only)), at)?,
    ];
    let explains = !worst[0].is_within(at.tolerance) && worst[1].is_within(at.tolerance);
    let explained =
        ExplainedByJoints { corrections: vec![only], worst: worst.to_vec(), alternatives: places };
    Ok(explains.then_some(explained))
}

/// The same correction at other joints between the same two links of the other description.
fn elsewhere(robots: &MatchedRobots<'_>, only: JointCorrection) -> Vec<JointCorrection> {
    let joint = robots.robot.joint(only.joint);
    if !matches!(only.expected, JointPart::Origin(_)) || !robots.is_matched(joint.child) {
        return Vec::new();
    }
    between(robots, joint.parent).map(|fixed| moved_to(fixed, joint, robots, only)).collect()
}

/// The difference of a corrected robot from the other description.
struct Difference<'a> {
    poses: &'a mut dyn LinkPoses,
    is_compared: &'a dyn Fn(LinkIndex) -> bool,
    links: [Vec<Pose>; 2],
}

impl<'a> Difference<'a> {
    fn new(
        robots: &MatchedRobots<'_>,
        poses: &'a mut dyn LinkPoses,
        is_compared: &'a dyn Fn(LinkIndex) -> bool,
    ) -> Self {
        let links = [(); 2].map(|()| vec![Pose::identity(); robots.robot.links().len()]);
        Self { poses, is_compared, links }
    }

    /// The largest at the links that are compared, with all configurations.
    fn worst(&mut self, robot: &Robot, at: &ComparedAt<'_>) -> Result<PoseError, LinkPosesError> {
        let tree = UrdfTree::new(robot);
        let mut worst = PoseError::default();
        for q in at.configurations {
            worst = worst.larger(self.at(&tree, robot, q)?);
        }
        Ok(worst)
    }

    /// Whether it is within the tolerance; ends at the first configuration at which it is not.
    fn is_within(&mut self, robot: &Robot, at: &ComparedAt<'_>) -> Result<bool, LinkPosesError> {
        let tree = UrdfTree::new(robot);
        for q in at.configurations {
            if !self.at(&tree, robot, q)?.is_within(at.tolerance) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    fn at(&mut self, tree: &UrdfTree, robot: &Robot, q: &RobotQ) -> Result<PoseError, LinkPosesError> {
        let [own, there] = &mut self.links;
        tree.root_from_links_into(q, own)?;
        self.poses.root_from_links_into(q, there)?;
        let compared = robot.link_indices().filter(|&link| (self.is_compared)(link));
        let error = |link: LinkIndex| PoseError::between(&own[link.get()], &there[link.get()]);
        Ok(compared.map(error).fold(PoseError::default(), PoseError::larger))
    }
}
