//! The fewest corrections of joints after which two descriptions agree.

use congruent_description::{LinkIndex, Robot, RobotQ};
use congruent_kinematics::{LinkPoses, LinkPosesError, Pose, PoseError, UrdfTree};

use super::{
    compared_at::ComparedAt,
    correction::{JointCorrection, JointPart, between, corrected, corrections, moved_to},
    displacement::{displaced, moves_alike},
};
use crate::MatchedRobots;

/// Corrections of joints that explain the difference of two descriptions.
#[derive(Debug, Clone, PartialEq)]
pub struct ExplainedByJoints {
    /// The one with the largest effect first.
    pub corrections: Vec<JointCorrection>,
    /// The largest difference before any correction, and after each.
    pub worst: Vec<PoseError>,
    /// Corrections of other joints with the same effect as the only one.
    pub alternatives: Vec<JointCorrection>,
}

/// Most corrections that are searched together. Kind: choice; more wrong joints are a matter of calibration.
const MOST_CORRECTIONS: usize = 30;

/// Beside more origins that differ, frames that all lie elsewhere in their links may be the reason, and one displacement the only fault.
/// Kind: choice.
const FEW_CORRECTIONS: usize = 8;

/// The corrections of joints that explain the difference; `None` if there are none, too many, or if the two differ only
/// in where frames lie in links that move alike.
///
/// # Errors
/// [`LinkPosesError`] if a source rejects a configuration.
pub fn explained_by_joints(
    robots: &MatchedRobots<'_>,
    poses: &mut dyn LinkPoses,
    at: &ComparedAt<'_>,
) -> Result<Option<ExplainedByJoints>, LinkPosesError> {
    let mut all = corrections(robots);
    // Largest first, so that the fewest are needed: after them the rest is rounding.
    all.sort_by(|one, other| other.size_m.total_cmp(&one.size_m));
    all.truncate(MOST_CORRECTIONS);
    if all.len() > FEW_CORRECTIONS
        && let Some(only) = single_displacement(robots, poses, displaced(robots, at), at)?
        && moves_alike(&robots.with(&corrected(robots.robot, &only.corrections)), at)
    {
        return Ok(Some(only));
    }
    let every_link = |link| robots.is_matched(link);
    let mut difference = CorrectedDifference::new(robots, poses, &every_link);
    // All corrections together first: if these do not suffice, no part of them does.
    let whole = corrected(robots.robot, &all);
    if !difference.is_within(&whole, at)? && !is_rounding(robots, &whole, at) {
        return single_displacement(robots, poses, displaced(robots, at), at);
    }
    let mut worst = vec![difference.worst(robots.robot, at)?];
    for count in 1..=all.len() {
        // One more correction each time, until all links agree: the others only round.
        let part = corrected(robots.robot, &all[..count]);
        worst.push(difference.worst(&part, at)?);
        if worst[count].is_within(at.tolerance) {
            all.truncate(count);
            break;
        }
        if is_rounding(robots, &part, at) {
            all.truncate(count);
            all = beyond_digits(robots, all, at);
            worst.truncate(1);
            for count in 1..=all.len() {
                worst.push(difference.worst(&corrected(robots.robot, &all[..count]), at)?);
            }
            break;
        }
    }
    // A link frame that lies elsewhere gives two differing origins, before it and behind it, which cancel each
    // other.
    if all.len() > 1 {
        if moves_alike(robots, at) {
            return Ok(None);
        }
        // Then all further differences are only frames of links.
        let suffices = |only: &&JointCorrection| {
            let corrected = corrected(robots.robot, std::slice::from_ref(*only));
            moves_alike(&robots.with(&corrected), at)
        };
        if let Some(only) = all.iter().find(suffices) {
            return single_displacement(robots, poses, vec![*only], at);
        }
    }
    let alternatives = if let [only] = all[..] { elsewhere(robots, only) } else { Vec::new() };
    Ok((!all.is_empty()).then_some(ExplainedByJoints { corrections: all, worst, alternatives }))
}

/// Whether what differs after a correction is rounding of the numbers in the files.
fn is_rounding(robots: &MatchedRobots<'_>, corrected: &Robot, at: &ComparedAt<'_>) -> bool {
    at.digits_count && robots.with(corrected).explained_by_digits().is_some()
}

/// Those of the corrections without which the rest is more than rounding: a large one may be within coarse digits, and a small one
/// beyond fine ones.
fn beyond_digits(
    robots: &MatchedRobots<'_>,
    mut all: Vec<JointCorrection>,
    at: &ComparedAt<'_>,
) -> Vec<JointCorrection> {
    let mut index = all.len();
    while index > 0 && all.len() > 1 {
        index -= 1;
        let mut without = all.clone();
        without.remove(index);
        if is_rounding(robots, &corrected(robots.robot, &without), at) {
            all = without;
        }
    }
    all
}

/// One displacement of the chain in one of `places`, if frames of links lie elsewhere as well: the tip decides.
fn single_displacement(
    robots: &MatchedRobots<'_>,
    poses: &mut dyn LinkPoses,
    mut places: Vec<JointCorrection>,
    at: &ComparedAt<'_>,
) -> Result<Option<ExplainedByJoints>, LinkPosesError> {
    if places.is_empty() {
        return Ok(None);
    }
    let only = places.remove(0);
    let at_tip = |link| link == at.tip;
    let mut difference = CorrectedDifference::new(robots, poses, &at_tip);
    let worst = [
        difference.worst(robots.robot, at)?,
        difference.worst(&corrected(robots.robot, std::slice::from_ref(&only)), at)?,
    ];
    // The frames differ at every link, so only the tip can say whether one correction suffices.
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
    between(robots, joint.parent).map(|(index, _)| moved_to(index, joint, robots, only)).collect()
}

/// The difference of a corrected robot from the other description.
struct CorrectedDifference<'a> {
    poses: &'a mut dyn LinkPoses,
    is_compared: &'a dyn Fn(LinkIndex) -> bool,
    links: [Vec<Pose>; 2],
}

impl<'a> CorrectedDifference<'a> {
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

#[cfg(test)]
mod tests {
    use congruent_description::{Tolerance, parse_urdf};
    use congruent_kinematics::sample_configurations;
    use nalgebra::{Isometry3, Unit, Vector3};

    use super::*;

    /// Three joints about z, y and z, a sliding one, and a fixed tool; the origins are those given.
    fn robot(origins: [&str; 5], axes: [&str; 4]) -> Robot {
        let links: Vec<String> = (0..=5).map(|at| format!("<link name='l{at}'/>")).collect();
        let moving = ["revolute", "revolute", "revolute", "prismatic"];
        let limit = "<limit lower='-2' upper='2' effort='1' velocity='1'/>";
        let joint = |at: usize| {
            let kind = moving.get(at).copied().unwrap_or("fixed");
            let axis = axes.get(at).map(|axis| format!("<axis xyz='{axis}'/>{limit}")).unwrap_or_default();
            format!(
                "<joint name='j{at}' type='{kind}'><parent link='l{at}'/><child link='l{}'/><origin {}/>{axis}</joint>",
                at + 1,
                origins[at]
            )
        };
        let joints: Vec<String> = (0..5).map(joint).collect();
        parse_urdf(&format!("<robot name='r'>{}{}</robot>", links.concat(), joints.concat())).unwrap()
    }

    const ORIGINS: [&str; 5] = [
        "xyz='0 0 0.3'",
        "xyz='0.1 0 0.2' rpy='0.3 0 0'",
        "xyz='0.4 0.05 0'",
        "xyz='0 0 0.1'",
        "xyz='0 0.02 0.1'",
    ];
    const AXES: [&str; 4] = ["0 0 1", "0 1 0", "0 0 1", "1 0 0"];

    /// The names of the joints that are corrected, with how many alternatives.
    #[track_caller]
    fn named(robot: &Robot) -> Option<(Vec<String>, usize)> {
        let other = super::tests::robot(ORIGINS, AXES);
        let mut poses = UrdfTree::new(&other);
        let robots = MatchedRobots::new([robot, &other], &mut poses).unwrap();
        let configurations = sample_configurations(robot, 1, 50);
        let [base, tip] = ["l0", "l5"].map(|name| robot.find_link(name).unwrap());
        let tolerance = &Tolerance::default();
        let at = ComparedAt { configurations: &configurations, tolerance, digits_count: false, base, tip };
        let explained = explained_by_joints(&robots, &mut poses, &at).unwrap()?;
        assert!(explained.worst.last().unwrap().is_within(at.tolerance));
        assert_eq!(explained.worst.len(), explained.corrections.len() + 1);
        let names = explained.corrections.iter().map(|of| robot.joint(of.joint).name.clone()).collect();
        Some((names, explained.alternatives.len()))
    }

    fn with_origins(changes: &[(usize, &'static str)]) -> Robot {
        let mut origins = ORIGINS;
        for &(at, origin) in changes {
            origins[at] = origin;
        }
        robot(origins, AXES)
    }

    #[test]
    fn joints_with_other_origins_are_named_the_largest_first() {
        assert_eq!(named(&with_origins(&[])), None);
        let one = |joint: &str| Some((vec![joint.to_owned()], 0));
        let turned = "xyz='0.4 0.052 0.001' rpy='0.1 0.2 -0.3'";
        assert_eq!(named(&with_origins(&[(2, turned)])), one("j2"));
        assert_eq!(named(&with_origins(&[(3, "xyz='0.01 0 0.1'")])), one("j3"));
        assert_eq!(named(&with_origins(&[(4, "xyz='0 0.02 0.11'")])), one("j4"));
        let two = with_origins(&[(1, "xyz='0.1 0 0.201' rpy='0.3 0 0'"), (4, "xyz='0 0.03 0.1'")]);
        assert_eq!(named(&two), Some((vec!["j4".to_owned(), "j1".to_owned()], 0)));
    }

    #[test]
    fn an_axis_is_a_fault_of_its_own() {
        let mut axes = AXES;
        axes[1] = "0 1 0.2";
        assert_eq!(named(&robot(ORIGINS, axes)), Some((vec!["j1".to_owned()], 0)));
        let mut origins = ORIGINS;
        origins[1] = "xyz='0.1 0 0.21' rpy='0.3 0 0'";
        assert_eq!(named(&robot(origins, axes)), Some((vec!["j1".to_owned(), "j1".to_owned()], 0)));
    }

    /// The frame of link l3 lies 0.2 m along the axis of its joint, which the next origin takes back.
    const MOVED_FRAME: [(usize, &str); 2] = [(2, "xyz='0.4 0.05 0.2'"), (3, "xyz='0 0 -0.1'")];

    #[test]
    fn a_frame_that_lies_elsewhere_in_its_link_is_no_fault() {
        assert_eq!(named(&with_origins(&MOVED_FRAME)), None);
        let [first, second] = MOVED_FRAME;
        let with_tool = with_origins(&[first, second, (4, "xyz='0 0.02 0.101'")]);
        assert_eq!(named(&with_tool), Some((vec!["j4".to_owned()], 0)));
    }

    /// All frames but the first and the last lie elsewhere in their links, which is more than eight origins and axes:
    /// the tip and the screws alone determine the place.
    #[test]
    fn a_displacement_is_distinguished_from_frames_that_all_lie_elsewhere() {
        let mut at: usize = 0;
        let found = robot(ORIGINS, AXES).with_joints(|joint| {
            let before = at.checked_sub(1).map(moved_frame).unwrap_or_default();
            let behind = moved_frame(at);
            joint.parent_from_joint = before.inverse() * joint.parent_from_joint * behind;
            joint.axis_in_joint = Unit::new_normalize(behind.rotation.inverse() * *joint.axis_in_joint);
            at += 1;
        });
        let displaced = found.with_joints(|joint| {
            if joint.name == "j2" {
                joint.parent_from_joint.translation.vector.x += 0.003;
            }
        });
        let (names, alternatives) = named(&displaced).unwrap();
        assert_eq!((names, alternatives), (vec!["j2".to_owned()], 0));
        assert_eq!(named(&found), None);
    }

    /// Where the frame of what a joint carries lies in it: along the joint's axis, and turned.
    fn moved_frame(joint: usize) -> Isometry3<f64> {
        let along = [Vector3::z(), Vector3::y(), Vector3::z(), Vector3::x()];
        along.get(joint).map_or_else(Isometry3::identity, |along| {
            Isometry3::new(0.1 * along, Vector3::new(0.3, 0.2, -0.4))
        })
    }

    #[test]
    fn rounding_of_many_origins_is_no_fault_beside_one() {
        let rounded = [
            (0, "xyz='0 0 0.30000000001'"),
            (1, "xyz='0.1 0 0.2' rpy='0.30000000001 0 0'"),
            (2, "xyz='0.41 0.05 0'"),
        ];
        assert_eq!(named(&with_origins(&rounded)), Some((vec!["j2".to_owned()], 0)));
    }
}
