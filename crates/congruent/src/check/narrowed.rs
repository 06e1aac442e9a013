//! `check --against --tip`: two descriptions are compared from the root to the tip, whatever else either of them moves. A table
//! and screws that are the robot describe no more than that.

use congruent_agreement::compare::CheckOptions;
use congruent_description::{ChainEnd, RobotDescription};

use super::part::{kept_joints, part};

/// Two descriptions without the joints that do not move the tip, and the links beyond these joints.
pub(super) struct NarrowedPair {
    pub(super) description: RobotDescription,
    pub(super) other: RobotDescription,
    /// The options with the requested configurations in the joints that are compared.
    pub(super) options: CheckOptions,
    /// The joints of either that are left out.
    pub(super) left_out: Vec<String>,
}

impl NarrowedPair {
    /// `None` if the caller did not name the tip and neither of the two is a table or screws, or if all joints move the tip.
    pub(super) fn new(
        description: &RobotDescription,
        other: &RobotDescription,
        options: &CheckOptions,
    ) -> Option<Self> {
        let robot = &description.robot;
        let has_own_model = [description, other].iter().any(|of| of.own_model().is_some());
        if description.chain_ends.tip != ChainEnd::Given && !has_own_model {
            return None;
        }
        let mut names = robot.joints_that_move(description.tip);
        if has_own_model {
            // A joint that only the other chain has is a difference of the two.
            names.extend(other.robot.joints_that_move(other.tip));
        }
        let mut left_out: Vec<String> = Vec::new();
        for name in robot.movable_joint_names().chain(other.robot.movable_joint_names()) {
            if !names.contains(name) && !left_out.iter().any(|known| known == name) {
                left_out.push(name.to_owned());
            }
        }
        let tip = &robot.link(description.tip).name;
        let [own, other] = [description, other].map(|of| {
            let part = part(of, of.robot.moved_by(&names));
            let tip = part.robot.find_link(tip).unwrap_or(part.robot.root());
            RobotDescription { tip, ..part }
        });
        let options =
            CheckOptions { configurations: kept_joints(description, &own, options), ..options.clone() };
        (!left_out.is_empty()).then_some(Self { description: own, other, options, left_out })
    }
}
