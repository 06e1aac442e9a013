//! Chooses the tip of the chain if no file and no command names it: the tool frame before the gripper.
//!
//! The chain follows the branch with most moving joints. Where several branches have as many, they are the
//! fingers of a gripper if the chain has as many joints behind it already, and the chain ends before them;
//! otherwise they are limbs, of which the first is taken and the others are candidates.

use congruent_robot::{JointIndex, JointKind, LinkIndex, Robot};

use super::frame_name::{is_jaw, is_of_limb, preference};

/// Travel up to which a slide at the tip is a jaw, m. Kind: judgement; jaws of grippers travel 10 to 50 mm, the quill of the smallest SCARA
/// 100 mm.
const SHORT_SLIDE_M: f64 = 0.06;
/// Range up to which a hinge at the tip that opens to one side of zero is a jaw, rad. Kind: judgement; wrists turn farther, and the short
/// hinges of ankles and necks turn to both sides. Many jaws open farther: without a name for it they count as joints of the arm.
const SHORT_HINGE_RAD: f64 = 0.7;
/// Joints before a short slide or hinge from which on they are an arm, and not the axes of a small stage. Kind: judgement.
const JOINTS_OF_AN_ARM: usize = 3;

/// The chosen tip, and the other tips that might have been meant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct ChosenTip {
    pub(crate) tip: LinkIndex,
    /// Tips of other limbs that are about as long; empty if the choice is unambiguous.
    pub(crate) others: Vec<LinkIndex>,
}

/// The tip of the chain that starts at `base`.
pub(crate) fn choose_tip(robot: &Robot, base: LinkIndex) -> ChosenTip {
    let bodies = LinkBodies::new(robot);
    // From the body of the base instead of its link: joints may hang on any of the links that are fixed to each other.
    let (tip, equal_limbs) = bodies.follow(robot.body(base), Vec::new());
    // Each doubtful branch is followed to its own tip; two branches may end at the same one, which is then no other tip.
    let others =
        equal_limbs.into_iter().map(|passed| bodies.follow_branch(&passed)).filter(|&other| other != tip);
    ChosenTip { tip, others: others.collect() }
}

/// The robot as a tree of bodies, which are joined by moving joints; a body is all links that are fixed to each other.
struct LinkBodies<'a> {
    robot: &'a Robot,
    /// For each link the largest number of successive moving joints below it.
    depths: Vec<usize>,
}

impl<'a> LinkBodies<'a> {
    fn new(robot: &'a Robot) -> Self {
        let mut depths = vec![0; robot.links().len()];
        // Children come after their parents, so from the end each depth is complete if it is used.
        for joint in robot.joints().iter().rev() {
            let depth = depths[joint.child.get()] + usize::from(joint.kind.is_movable());
            let parent = &mut depths[joint.parent.get()];
            *parent = depth.max(*parent);
        }
        Self { robot, depths }
    }

    /// The largest number of successive moving joints from this one on, itself included.
    fn depth(&self, branch: JointIndex) -> usize {
        1 + self.depths[self.robot.joint(branch).child.get()]
    }

    /// The tip of the chain that continues at `link` after the moving joints `passed`, and the joints into each other limb that
    /// is about as long as the followed one.
    fn follow(&self, mut link: LinkIndex, mut passed: Vec<JointIndex>) -> (LinkIndex, Vec<Vec<JointIndex>>) {
        let mut equal_limbs = Vec::new();
        loop {
            let body = self.body(link);
            let branches = self.branches(&body, &passed);
            let Some(deepest) = branches.iter().map(|&branch| self.depth(branch)).max() else {
                return (self.frame(&body), equal_limbs);
            };
            // A limb that is one joint shorter still counts as equal, so that it is named as a candidate.
            let is_shorter = |&branch: &JointIndex| self.depth(branch) + 1 < deepest.max(2);
            let equal: Vec<JointIndex> = branches.into_iter().filter(|branch| !is_shorter(branch)).collect();
            // Several equal branches are fingers if the chain before them is at least as long; limbs of a torso have a short
            // chain or none before them. A single last joint ends the chain only if its name says that it is a jaw, since
            // the last joint of an arm is single, too.
            let are_fingers = equal.len() > 1 && passed.len() >= deepest;
            let is_gripper = !passed.is_empty()
                && deepest == 1
                && equal.iter().all(|&one| self.is_jaw(one) || self.is_short(one, &passed));
            if are_fingers || is_gripper {
                return (self.frame(&body), equal_limbs);
            }
            // Of equal branches the deepest counts, and of equally deep ones the first in file order.
            let first = equal.iter().position(|&branch| self.depth(branch) == deepest).unwrap_or(0);
            equal_limbs.extend(
                equal
                    .iter()
                    .enumerate()
                    .filter(|(at, _)| *at != first)
                    .map(|(_, &branch)| passed.iter().copied().chain([branch]).collect()),
            );
            passed.push(equal[first]);
            link = self.robot.joint(equal[first]).child;
        }
    }

    fn is_jaw(&self, last: JointIndex) -> bool {
        let joint = self.robot.joint(last);
        is_jaw(joint, self.robot.link(joint.child))
    }

    /// Whether a last joint without a name for it is a jaw all the same: a short slide, or a short hinge that opens to one side, at the
    /// end of an arm, with no frame for a tool behind it.
    fn is_short(&self, last: JointIndex, passed: &[JointIndex]) -> bool {
        let joint = self.robot.joint(last);
        // A range of no length is one that the file does not state.
        let Some((lower, upper)) = joint.position_range().filter(|(lower, upper)| lower < upper) else {
            return false;
        };
        let is_short = match joint.kind {
            JointKind::Prismatic => upper - lower <= SHORT_SLIDE_M,
            JointKind::Revolute => {
                let is_of_limb = is_of_limb(joint, self.robot.link(joint.child));
                upper - lower <= SHORT_HINGE_RAD && lower * upper >= 0.0 && !is_of_limb
            }
            JointKind::Continuous | JointKind::Fixed => false,
        };
        is_short && self.body(joint.child).len() == 1 && passed.len() >= JOINTS_OF_AN_ARM
    }

    fn follow_branch(&self, passed: &[JointIndex]) -> LinkIndex {
        let last = *passed.last().expect("a limb begins with a joint");
        self.follow(self.robot.joint(last).child, passed.to_vec()).0
    }

    /// `link` and the links that are fixed to it from there down, each with the number of fixed joints between.
    fn body(&self, link: LinkIndex) -> Vec<(LinkIndex, usize)> {
        let mut distances = vec![None; self.robot.links().len()];
        distances[link.get()] = Some(0);
        let mut body = vec![(link, 0)];
        // One pass is enough, since parents come before children in the list of joints.
        for joint in self.robot.joints().iter().filter(|joint| !joint.kind.is_movable()) {
            let Some(distance) = distances[joint.parent.get()] else { continue };
            distances[joint.child.get()] = Some(distance + 1);
            body.push((joint.child, distance + 1));
        }
        body
    }

    /// The moving joints whose parent belongs to a body, except linkages: joints that only mimic joints of the chain do not
    /// continue it.
    fn branches(&self, body: &[(LinkIndex, usize)], passed: &[JointIndex]) -> Vec<JointIndex> {
        let starts_on_body = |joint: JointIndex| {
            let joint = self.robot.joint(joint);
            body.iter().any(|(link, _)| *link == joint.parent)
        };
        let movable = self.robot.movable_joints().iter().copied();
        movable.filter(|&joint| starts_on_body(joint) && !self.is_linkage(joint, passed)).collect()
    }

    /// Whether this joint and all moving joints below it mimic joints of the chain.
    fn is_linkage(&self, branch: JointIndex, passed: &[JointIndex]) -> bool {
        let mut is_below = vec![false; self.robot.links().len()];
        is_below[self.robot.joint(branch).child.get()] = true;
        let follows = |joint: JointIndex| {
            self.robot.joint(joint).mimic.is_some_and(|mimic| passed.contains(&mimic.master))
        };
        if !follows(branch) {
            return false;
        }
        // Parents come before children, so a link is marked before the joints below it are reached.
        let mut all = true;
        for joint in self.robot.joints() {
            if is_below[joint.parent.get()] {
                is_below[joint.child.get()] = true;
                all &= !joint.kind.is_movable() || self.robot.parent_joint(joint.child).is_some_and(follows);
            }
        }
        all
    }

    /// The frame of a body in which tools are most likely programmed, by name and position.
    fn frame(&self, body: &[(LinkIndex, usize)]) -> LinkIndex {
        let rank =
            |&(link, distance): &(LinkIndex, usize)| preference(self.robot.link(link), distance, link.get());
        body.iter().max_by_key(|each| rank(each)).map_or(self.robot.root(), |(link, _)| *link)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::urdf::parse_urdf;
    use congruent_robot::JointParts;

    /// A robot from lines `parent kind child [mimic joint]`; a joint has its child's name.
    fn robot(lines: &[&str]) -> Robot {
        let element = |line: &&str| {
            let words: Vec<&str> = line.split(' ').collect();
            let (parent, kind, child) = (words[0], words[1], words[2]);
            let mimic = words.get(3).map_or(String::new(), |master| format!("<mimic joint='{master}'/>"));
            format!(
                "<link name='{child}'/>\
                 <joint name='{child}' type='{kind}'><parent link='{parent}'/><child link='{child}'/>{mimic}\
                 <limit lower='0' upper='1' effort='1' velocity='1'/></joint>"
            )
        };
        let elements: String = lines.iter().map(element).collect();
        parse_urdf(&format!("<robot name='r'><link name='base'/>{elements}</robot>")).unwrap()
    }

    #[track_caller]
    fn check(lines: &[&str], tip: &str, others: &[&str]) {
        let robot = robot(lines);
        let chosen = choose_tip(&robot, robot.root());
        let name = |link: LinkIndex| robot.link(link).name.as_str();
        assert_eq!(name(chosen.tip), tip);
        assert_eq!(chosen.others.into_iter().map(name).collect::<Vec<_>>(), others);
    }

    const ARM: [&str; 2] = ["base revolute upper", "upper revolute lower"];

    #[test]
    fn fingers_are_not_part_of_the_arm() {
        let fingers = ["lower prismatic left", "lower prismatic right left"];
        check(&[&ARM[..], &fingers].concat(), "lower", &[]);
        let palm = ["lower fixed camera", "lower fixed palm", "palm fixed grasp"];
        check(&[&ARM[..], &palm, &["palm prismatic left", "palm prismatic right"]].concat(), "grasp", &[]);
        let unequal = ["lower revolute thumb", "lower revolute index", "index revolute index_end"];
        check(&[&ARM[..], &unequal].concat(), "lower", &[]);
        check(&[&ARM[..], &["lower revolute gripper_jaw"]].concat(), "lower", &[]);
        for jaw in ["gripperMover", "jointGripper", "rightFinger", "joint_Jaw2"] {
            check(&[&ARM[..], &[format!("lower revolute {jaw}").as_str()]].concat(), "lower", &[]);
        }
        check(&[&ARM[..], &["lower revolute gripperRoll"]].concat(), "gripperRoll", &[]);
        check(&[&ARM[..], &["lower revolute gripper_roll"]].concat(), "gripper_roll", &[]);
        check(&[&ARM[..], &["lower prismatic quill"]].concat(), "quill", &[]);
    }

    /// The tip of an arm of three hinges and a joint of another range.
    fn tip_with_range(lines: &[&str], last: &str, (lower, upper): (f64, f64)) -> String {
        let long = robot(lines);
        let parts = long.joints().iter().map(|joint| {
            let mut joint = joint.clone();
            if let Some(limit) = joint.limit.as_mut().filter(|_| joint.name == last) {
                (limit.lower, limit.upper) = (lower, upper);
            }
            let [parent, child] = [joint.parent, joint.child].map(|link| long.link(link).name.clone());
            JointParts { parent, child, mimic: None, joint }
        });
        let robot = Robot::new("r", long.links().to_vec(), parts.collect()).unwrap();
        robot.link(choose_tip(&robot, robot.root()).tip).name.clone()
    }

    #[test]
    fn a_short_slide_without_a_frame_is_a_jaw_at_the_end_of_an_arm() {
        let lines = ["base revolute a", "a revolute b", "b revolute c", "c prismatic d", "d fixed e"];
        let tip = |lines: &[&str], travel_m: f64| tip_with_range(lines, "d", (0.0, travel_m));
        assert_eq!([0.04, 0.1].map(|travel_m| tip(&lines[..4], travel_m)), ["c", "d"]);
        // With a frame behind it, or as the second axis of a stage, it belongs to the chain.
        assert_eq!([tip(&lines, 0.04), tip(&["base revolute a", "a prismatic d"], 0.04)], ["e", "d"]);
    }

    #[test]
    fn a_short_hinge_that_opens_to_one_side_is_a_jaw_at_the_end_of_an_arm() {
        let lines = ["base revolute a", "a revolute b", "b revolute c", "c revolute d", "d fixed e"];
        let tip = |lines: &[&str], range: (f64, f64)| tip_with_range(lines, "d", range);
        // A wrist turns farther, and an ankle to both sides.
        let ranges = [(0.0, 0.6), (-0.7, -0.1), (0.0, 1.0), (-0.26, 0.26)];
        assert_eq!(ranges.map(|range| tip(&lines[..4], range)), ["c", "c", "d", "d"]);
        assert_eq!(tip(&lines, (0.0, 0.6)), "e");
        // A range that is not stated, and a name that says what it is.
        assert_eq!(tip(&lines[..4], (0.0, 0.0)), "d");
        let wrist = ["base revolute a", "a revolute b", "b revolute c", "c revolute wrist_flex"];
        assert_eq!(tip_with_range(&wrist, "wrist_flex", (-0.6, 0.0)), "wrist_flex");
    }

    #[test]
    fn of_limbs_the_first_is_taken_and_the_others_are_named() {
        let arms = [
            "base revolute l1",
            "l1 revolute l2",
            "base revolute head",
            "base revolute r1",
            "r1 revolute r2",
        ];
        check(&arms, "l2", &["head", "r2"]);
        let torso = [
            "base revolute torso",
            "torso revolute r1",
            "r1 revolute r2",
            "torso revolute l1",
            "l1 revolute l2",
        ];
        check(&torso, "r2", &["l2"]);
        let wheels = ["base continuous wheel_1", "base continuous wheel_2"];
        check(&[&wheels[..], &ARM, &["lower revolute wrist"]].concat(), "wrist", &[]);
    }

    #[test]
    fn a_linkage_that_follows_the_arm_is_no_branch() {
        let linkage = ["upper revolute rod upper", "lower revolute wrist", "wrist fixed flange"];
        check(&[&ARM[..], &linkage].concat(), "flange", &[]);
    }

    #[test]
    fn a_frame_for_tools_comes_before_a_deeper_one() {
        let camera = ["lower fixed tool0", "lower fixed mount", "mount fixed lens"];
        check(&[&ARM[..], &camera].concat(), "tool0", &[]);
        check(&["base fixed stand"], "stand", &[]);
        check(&[], "base", &[]);
    }
}
