//! Joints that are left out of a comparison although they carry joints that both descriptions have.

use std::collections::BTreeMap;

use congruent_description::{JointIndex, Robot};
use schemars::JsonSchema;
use serde::Serialize;

/// A joint between base and tip that moves in one of two descriptions alone, or that is left out in both: a part of the arm, and no
/// gripper.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct LeftOutInChain {
    /// The joint.
    pub joint: String,
    /// The joints of both descriptions that it carries, by their names in its own.
    pub carries: Vec<String>,
}

impl LeftOutInChain {
    /// Those of a robot among the joints that are left out; `common` are joints that both have.
    pub(super) fn of(robot: &Robot, left_out: &[JointIndex], common: &[JointIndex]) -> Vec<Self> {
        let name = |joint: JointIndex| robot.joint(joint).name.clone();
        let mut carried: BTreeMap<JointIndex, Vec<String>> = BTreeMap::new();
        for &joint in common {
            let before = robot.chain(robot.root(), robot.joint(joint).parent).unwrap_or_default();
            for by in before {
                carried.entry(by).or_default().push(name(joint));
            }
        }
        let of_joint =
            |&joint: &JointIndex| Some(Self { joint: name(joint), carries: carried.get(&joint)?.clone() });
        left_out.iter().filter_map(of_joint).collect()
    }
}
