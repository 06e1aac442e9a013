//! Which column of a table is which joint.

use std::{
    collections::{BTreeMap, BTreeSet},
    f64::consts::PI,
};

use super::{
    head::TableHead,
    quantity::{NamedColumn, is_name_of_joint, named, word_count},
};
use crate::table_reading::{LoggedQuantity, Preset, TableColumn};

/// The joints of a UR arm, in the order of its controller.
const UR_JOINTS: [&str; 6] = [
    "shoulder_pan_joint",
    "shoulder_lift_joint",
    "elbow_joint",
    "wrist_1_joint",
    "wrist_2_joint",
    "wrist_3_joint",
];
/// Columns of these joints.
const UR_COLUMNS: [(&str, LoggedQuantity); 3] = [
    ("actual_q_", LoggedQuantity::Position),
    ("actual_qd_", LoggedQuantity::Velocity),
    ("actual_current_", LoggedQuantity::Effort),
];
/// The position of the TCP in m and its rotation vector in rad, in the frame `base`.
const UR_POSE: &str = "actual_tcp_pose_";

/// A column with a value of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct JointCell {
    pub(super) column: usize,
    pub(super) joint: usize,
    pub(super) quantity: LoggedQuantity,
    /// What one of the unit that the name of the column states is in rad, m, rad/s, m/s, N m or N.
    pub(super) si_per_unit: f64,
}

/// What one of a unit is in the unit of SI.
fn si_per_unit(unit: Option<&str>) -> f64 {
    match unit {
        Some("deg" | "degree" | "degrees" | "deg_s") => PI / 180.0,
        Some("mm" | "mm_s") => 1e-3,
        _ => 1.0,
    }
}

/// The columns of a table that are read.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct ReadColumns {
    pub(super) joints: Vec<String>,
    pub(super) cells: Vec<JointCell>,
    /// The six columns of the pose of a UR's TCP.
    pub(super) tcp_pose: Option<[usize; 6]>,
    pub(super) preset: Option<Preset>,
    pub(super) described: Vec<TableColumn>,
    pub(super) unused: Vec<String>,
}

/// A column that is taken for one of a joint.
struct TakenColumn {
    column: usize,
    /// By which columns of one joint are found.
    key: String,
    name: String,
    quantity: LoggedQuantity,
    stated_unit: Option<String>,
    /// Number of words that say neither the joint nor what of it.
    other_words: usize,
}

/// Finds the columns of joints; none is empty. `robot` has the names of the joints of a robot, in its order.
pub(super) fn find_columns(head: &TableHead, time: Option<usize>, robot: &[String]) -> ReadColumns {
    let Some(names) = &head.names else { return by_order(head, time, robot) };
    if let Some(columns) = of_ur(names, time) {
        return columns;
    }
    let columns = || names.iter().enumerate().filter(|(column, _)| Some(*column) != time);
    let mut taken: Vec<TakenColumn> =
        columns().filter_map(|(column, name)| by_robot(column, name, robot)).collect();
    if taken.is_empty() {
        taken = columns().filter_map(|(column, name)| by_words(column, name)).collect();
        without_common_path(&mut taken);
    }
    let has = |quantity| taken.iter().any(|of: &TakenColumn| of.quantity == quantity);
    if has(LoggedQuantity::Position) {
        // A current of the whole robot is of no joint.
        let with_position = taken.iter().filter(|of| of.quantity == LoggedQuantity::Position);
        let keys: BTreeSet<String> = with_position.map(|of| of.key.clone()).collect();
        taken.retain(|of| keys.contains(&of.key));
    }
    retain_plainest(&mut taken);
    collected(names, time, taken)
}

/// Of several columns of one value of a joint the one with the fewest other words: `joint_1_position`, not
/// `gripper_joint_1_position`.
fn retain_plainest(taken: &mut Vec<TakenColumn>) {
    let mut plainest = BTreeMap::new();
    for of in taken.iter() {
        let this = (of.other_words, of.column);
        let known = plainest.entry((of.quantity, of.key.clone())).or_insert(this);
        *known = this.min(*known);
    }
    let columns: BTreeSet<usize> = plainest.into_values().map(|(_, column)| column).collect();
    taken.retain(|of| columns.contains(&of.column));
}

/// A column whose name has the name of a joint of the robot.
fn by_robot(column: usize, name: &str, robot: &[String]) -> Option<TakenColumn> {
    let is_end = |letter: Option<char>| letter.is_none_or(|letter| !letter.is_alphanumeric());
    let around = |joint: &str| {
        let mut places = name.match_indices(joint).map(|(at, _)| (&name[..at], &name[at + joint.len()..]));
        places.find(|(before, behind)| is_end(before.chars().next_back()) && is_end(behind.chars().next()))
    };
    let joints = robot.iter().filter(|joint| !joint.is_empty());
    let found = joints.filter_map(|joint| Some((joint, around(joint)?)));
    let (joint, (before, behind)) = found.max_by_key(|(joint, _)| joint.len())?;
    // The words of the joint's name say nothing about the column.
    let NamedColumn { quantity, rest, stated_unit } = named(&format!("{before}joint{behind}"))?;
    // Without a word that says what it is, a column is a position if no other word is behind the joint: the words before it
    // may be those of an arm or a topic.
    let is_bare = || named(&format!("joint{behind}")).is_some_and(|named| named.rest == "joint");
    let quantity = quantity.or_else(|| is_bare().then_some(LoggedQuantity::Position))?;
    let other_words = word_count(&rest).saturating_sub(1);
    let (key, name) = (joint.clone(), joint.clone());
    Some(TakenColumn { column, key, name, quantity, stated_unit, other_words })
}

/// A column whose name has a word such as `position`, or is that of a joint.
fn by_words(column: usize, name: &str) -> Option<TakenColumn> {
    let NamedColumn { quantity, rest, stated_unit } = named(name)?;
    let quantity = quantity.or_else(|| is_name_of_joint(&rest).then_some(LoggedQuantity::Position))?;
    let has_letter = rest.contains(char::is_alphabetic);
    let joint = if has_letter { rest.clone() } else { name.to_owned() };
    Some(TakenColumn { column, key: rest, name: joint, quantity, stated_unit, other_words: 0 })
}

/// Takes off what all names have before a slash: the topic.
fn without_common_path(taken: &mut [TakenColumn]) {
    let Some(path) =
        taken.first().and_then(|of| of.name.rsplit_once('/')).map(|(path, _)| format!("{path}/"))
    else {
        return;
    };
    if taken.iter().all(|of| of.name.starts_with(&path)) {
        for of in taken {
            of.name = of.name[path.len()..].to_owned();
        }
    }
}

fn collected(names: &[String], time: Option<usize>, taken: Vec<TakenColumn>) -> ReadColumns {
    let mut found = ReadColumns::default();
    let mut joints: BTreeMap<String, usize> = BTreeMap::new();
    let used: BTreeSet<usize> = taken.iter().map(|of| of.column).chain(time).collect();
    for TakenColumn { column, key, name, quantity, stated_unit, .. } in taken {
        let joint = *joints.entry(key).or_insert_with(|| {
            found.joints.push(name);
            found.joints.len() - 1
        });
        let si_per_unit = si_per_unit(stated_unit.as_deref());
        found.cells.push(JointCell { column, joint, quantity, si_per_unit });
        let (name, joint) = (names[column].clone(), found.joints[joint].clone());
        found.described.push(TableColumn { name, joint, quantity, stated_unit });
    }
    let unused = names.iter().enumerate().filter(|(column, _)| !used.contains(column));
    found.unused = unused.map(|(_, name)| name.clone()).collect();
    found
}

/// The columns of the client library of Universal Robots.
fn of_ur(names: &[String], time: Option<usize>) -> Option<ReadColumns> {
    let column = |prefix: &str, number: usize| {
        let wanted = format!("{prefix}{number}");
        names.iter().position(|name| name.eq_ignore_ascii_case(&wanted))
    };
    (0..UR_JOINTS.len()).try_for_each(|joint| column(UR_COLUMNS[0].0, joint).map(|_| ()))?;
    let mut taken = Vec::new();
    for (prefix, quantity) in UR_COLUMNS {
        for (number, joint) in UR_JOINTS.iter().enumerate() {
            let (key, name) = ((*joint).to_owned(), (*joint).to_owned());
            let of = |column| TakenColumn { column, key, name, quantity, stated_unit: None, other_words: 0 };
            taken.extend(column(prefix, number).map(of));
        }
    }
    let pose: Vec<usize> = (0..6).filter_map(|number| column(UR_POSE, number)).collect();
    let mut found = collected(names, time, taken);
    found.preset = Some(Preset::UrRtde);
    found.tcp_pose = pose.try_into().ok();
    let is_of_pose = |name: &String| name.to_lowercase().starts_with(UR_POSE);
    if found.tcp_pose.is_some() {
        found.unused.retain(|name| !is_of_pose(name));
    }
    Some(found)
}

/// Columns without names are positions: of the robot's joints in their order, if it has as many or more.
fn by_order(head: &TableHead, time: Option<usize>, robot: &[String]) -> ReadColumns {
    let columns: Vec<usize> = (0..head.width).filter(|column| Some(*column) != time).collect();
    if !robot.is_empty() && columns.len() > robot.len() {
        return ReadColumns {
            unused: columns.iter().map(|column| head.name(*column)).collect(),
            ..ReadColumns::default()
        };
    }
    let mut found = ReadColumns::default();
    for (joint, column) in columns.into_iter().enumerate() {
        let name = head.name(column);
        let of_joint = robot.get(joint).cloned().unwrap_or_else(|| name.clone());
        found.joints.push(of_joint.clone());
        let quantity = LoggedQuantity::Position;
        found.cells.push(JointCell { column, joint, quantity, si_per_unit: 1.0 });
        found.described.push(TableColumn { name, joint: of_joint, quantity, stated_unit: None });
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::csv::Dialect;

    #[track_caller]
    fn check(header: &str, robot: &[&str], joints: &[&str], unused: &[&str]) -> ReadColumns {
        let width = header.split(',').count();
        let rows = format!("{0}\n{0}\n", vec!["0"; width].join(","));
        let dialect = Dialect::of(format!("{header}\n{rows}").as_bytes()).unwrap();
        let robot: Vec<String> = robot.iter().map(|&name| name.to_owned()).collect();
        let found = find_columns(&dialect.head, Some(0), &robot);
        assert_eq!((&found.joints[..], &found.unused[..]), (&owned(joints)[..], &owned(unused)[..]));
        found
    }

    fn owned(names: &[&str]) -> Vec<String> {
        names.iter().map(|&name| name.to_owned()).collect()
    }

    #[test]
    fn joints_by_words() {
        check("t,- a_1_joint_position,- a_2_joint_position", &[], &["a_1_joint", "a_2_joint"], &[]);
        let found = check("t,q1,q2,dq1,dq2,robot_current", &[], &["q1", "q2"], &["robot_current"]);
        assert_eq!(
            found.cells[3],
            JointCell { column: 4, joint: 1, quantity: LoggedQuantity::Velocity, si_per_unit: 1.0 }
        );
        let path = ["t,/js/elbow/position,/js/elbow/velocity", "t,/js/position/elbow,/js/velocity/elbow"];
        for header in path {
            check(header, &[], &["elbow"], &[]);
        }
        check("t,target_q_0,temperature", &[], &[], &["target_q_0", "temperature"]);
    }

    #[test]
    fn joints_by_the_robot() {
        let header = "t,left_elbow_pos,left_elbow_vel,Goal x,elbow_target,left_wrist_z";
        let found = check(header, &["elbow", "wrist_z"], &["elbow", "wrist_z"], &["Goal x", "elbow_target"]);
        assert_eq!(found.cells.iter().filter(|cell| cell.quantity == LoggedQuantity::Velocity).count(), 1);
    }

    #[test]
    fn of_several_columns_of_a_joint_the_plainest() {
        let positions = |header: &str, robot: &[&str], joints: &[&str], unused: &[&str]| {
            let found = check(header, robot, joints, unused);
            found.cells.iter().map(|cell| cell.column).collect::<Vec<_>>()
        };
        let header = "t,elbow_joint_acceleration,elbow_joint_position";
        let elbow = ["elbow_joint"];
        assert_eq!(positions(header, &elbow, &elbow, &["elbow_joint_acceleration"]), [2]);
        for other in ["elbow_joint_cmd", "elbow_joint_temp", "elbow_joint_brake"] {
            assert_eq!(positions(&format!("t,{other},elbow_joint_rad"), &elbow, &elbow, &[other]), [2]);
        }
        let header = "t,gripper_joint_1_position,joint_1_position,joint_2_position";
        let joints = ["joint_1", "joint_2"];
        assert_eq!(positions(header, &joints, &joints, &["gripper_joint_1_position"]), [2, 3]);
        assert_eq!(positions("t,left_elbow_joint", &elbow, &elbow, &[]), [1]);
    }

    #[test]
    fn a_table_of_poses_has_no_joints() {
        check("t,x,y,z,q_x,q_y,q_z,q_w", &[], &[], &["x", "y", "z", "q_x", "q_y", "q_z", "q_w"]);
    }

    #[test]
    fn columns_of_a_ur() {
        let of = |prefix: &str| (0..6).map(|at| format!("{prefix}{at}")).collect::<Vec<_>>().join(",");
        let header = format!("timestamp,{},{},{}", of("target_q_"), of("actual_q_"), of("actual_TCP_pose_"));
        let unused: Vec<String> = (0..6).map(|at| format!("target_q_{at}")).collect();
        let unused: Vec<&str> = unused.iter().map(String::as_str).collect();
        let found = check(&header, &[], &UR_JOINTS, &unused);
        assert_eq!((found.preset, found.tcp_pose), (Some(Preset::UrRtde), Some([13, 14, 15, 16, 17, 18])));
    }

    #[test]
    fn without_names_the_order_of_the_robot() {
        let dialect = Dialect::of(b"0 1\n0 1\n").unwrap();
        let found = |robot: &[&str]| find_columns(&dialect.head, None, &owned(robot)).joints;
        assert_eq!(found(&["a", "b", "finger"]), ["a", "b"]);
        assert_eq!(found(&[]), ["column 1", "column 2"]);
        assert!(found(&["a"]).is_empty());
    }
}
