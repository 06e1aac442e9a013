//! The orders in which programs list the joints of a robot.

use std::collections::BTreeMap;

use congruent_description::{JointIndex, Robot, RobotDescription, UrdfPlaces};
use schemars::JsonSchema;
use serde::Serialize;

/// The answer of `congruent describe --orders` for one robot: its moving joints in the orders in which programs list them. Where
/// the order is another one, the same list of positions is another configuration. Followers are among the joints, fixed
/// joints are not.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct JointOrders {
    /// The robot file, or the description if there is none.
    pub file: String,
    /// Name of the robot.
    pub robot: String,
    /// In the order of the file. In an MJCF it is that of the bodies.
    pub in_file: Vec<String>,
    /// Depth first, branches in the order of the file: `qpos` of the model that MuJoCo compiles from the file, and
    /// configurations of Congruent.
    pub depth_first: Vec<String>,
    /// Breadth first, where links without a moving joint between them are one body: articulations of Isaac Sim and Isaac Lab
    /// whose importer has merged fixed joints.
    pub breadth_first: Vec<String>,
    /// Breadth first, where each link is a body: the same programs, if fixed joints are kept.
    pub breadth_first_of_links: Vec<String>,
    /// Where the orders differ, in sentences; empty if they are all the same.
    pub remarks: Vec<String>,
}

/// The orders of the moving joints of a robot.
///
/// # Examples
/// ```
/// use congruent_analysis::description_summary::joint_orders;
/// use congruent_description::load_robot;
///
/// # let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/panda");
/// let orders = joint_orders(&load_robot(folder.as_ref())?);
/// // Both fingers hang at the end of the arm, so there is one order.
/// assert_eq!(orders.in_file, orders.breadth_first);
/// assert!(orders.remarks.is_empty());
/// # Ok::<(), congruent_input::Findings>(())
/// ```
pub fn joint_orders(description: &RobotDescription) -> JointOrders {
    let robot = &description.robot;
    // A robot is sorted depth first, branches in the order of the file.
    let depth_first = robot.movable_joints();
    let written = description.places.urdf.as_ref().map(UrdfPlaces::joint_order).unwrap_or_default();
    let place: BTreeMap<&str, usize> =
        written.iter().enumerate().map(|(place, name)| (name.as_str(), place)).collect();
    let sorted = |rank: &dyn Fn(JointIndex) -> usize| -> Vec<String> {
        let mut joints = depth_first.to_vec();
        // The sort is stable: within a rank the branches keep their order, which is that of a breadth-first search.
        joints.sort_by_key(|&joint| rank(joint));
        joints.into_iter().map(|joint| robot.joint(joint).name.clone()).collect()
    };
    let is_movable = |joint: &JointIndex| robot.joint(*joint).kind.is_movable();
    let mut orders = JointOrders {
        file: description.path.display().to_string(),
        robot: description.name.clone(),
        in_file: sorted(&|joint| place.get(robot.joint(joint).name.as_str()).copied().unwrap_or_default()),
        depth_first: sorted(&|_| 0),
        breadth_first: sorted(&|joint| joints_before(robot, joint).filter(is_movable).count()),
        breadth_first_of_links: sorted(&|joint| joints_before(robot, joint).count()),
        remarks: Vec::new(),
    };
    orders.remarks = remarks(&orders);
    orders
}

/// The joints between a joint and the root, the nearest first.
fn joints_before(robot: &Robot, joint: JointIndex) -> impl Iterator<Item = JointIndex> {
    let before = |joint| robot.parent_joint(robot.joint(joint).parent);
    std::iter::successors(before(joint), move |&joint| before(joint))
}

fn remarks(orders: &JointOrders) -> Vec<String> {
    let pairs = [
        ("the file", &orders.in_file, "MuJoCo (depth first)", &orders.depth_first),
        ("MuJoCo (depth first)", &orders.depth_first, "Isaac (breadth first)", &orders.breadth_first),
        (
            "Isaac (breadth first)",
            &orders.breadth_first,
            "the same with fixed joints kept as links",
            &orders.breadth_first_of_links,
        ),
    ];
    let remark = |(a, order, b, other): (&str, &Vec<String>, &str, &Vec<String>)| {
        let differ = || order.iter().zip(other).enumerate().filter(|(_, (here, there))| here != there);
        let (place, (here, there)) = differ().next()?;
        let (count, all) = (differ().count(), order.len());
        Some(format!(
            "{a} and {b} differ at {count} of {all} places: place {} is {here} in {a}, {there} in {b}",
            place + 1
        ))
    };
    pairs.into_iter().filter_map(remark).collect()
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use congruent_description::parse_robot;
    use congruent_input::SourceFile;

    use super::*;

    /// The orders of a robot with these joints, each `name parent child kind`.
    fn orders(joints: &[&str]) -> JointOrders {
        let links = ["base", "a1", "a2", "b1", "b2", "plate"].map(|link| format!("<link name='{link}'/>"));
        let joint = |joint: &&str| {
            let [name, parent, child, kind] = joint.split(' ').collect::<Vec<_>>()[..] else {
                panic!("{joint}")
            };
            format!(
                "<joint name='{name}' type='{kind}'><parent link='{parent}'/><child link='{child}'/></joint>"
            )
        };
        let joints: Vec<String> = joints.iter().map(joint).collect();
        let text = format!("<robot name='r'>{}{}</robot>", links.concat(), joints.concat());
        let source = SourceFile { path: "r.urdf".into(), text, is_foreign: false };
        joint_orders(&parse_robot(None, &Arc::new(source)).unwrap())
    }

    /// `file`, depth first, breadth first and breadth first of links, as names divided by spaces.
    fn as_words(orders: &JointOrders) -> [String; 4] {
        [&orders.in_file, &orders.depth_first, &orders.breadth_first, &orders.breadth_first_of_links]
            .map(|order| order.join(" "))
    }

    #[test]
    fn branches_are_gone_through_in_four_orders() {
        // MuJoCo 4.0.0 lists the joints of this URDF as ja1 ja2 jb1 jb2.
        let orders = orders(&[
            "ja1 base a1 continuous",
            "jp base plate fixed",
            "jb2 b1 b2 continuous",
            "jb1 plate b1 continuous",
            "ja2 a1 a2 continuous",
        ]);
        assert_eq!(
            as_words(&orders),
            ["ja1 jb2 jb1 ja2", "ja1 ja2 jb1 jb2", "ja1 jb1 ja2 jb2", "ja1 ja2 jb1 jb2"]
        );
        assert_eq!(orders.remarks.len(), 3);
        assert_eq!(
            orders.remarks[0],
            "the file and MuJoCo (depth first) differ at 2 of 4 places: place 2 is jb2 in the file, ja2 in MuJoCo (depth first)"
        );
    }

    #[test]
    fn a_chain_has_one_order() {
        let orders = orders(&[
            "j1 base a1 continuous",
            "j2 a1 a2 fixed",
            "j3 a2 b1 continuous",
            "j4 b1 b2 continuous",
            "j5 b2 plate fixed",
        ]);
        assert_eq!(as_words(&orders), ["j1 j3 j4"; 4].map(str::to_owned));
        assert!(orders.remarks.is_empty());
    }
}
