//! Forward kinematics against numbers from independent programs: tables against
//! roboticstoolbox-python, trees against Pinocchio.

#[path = "../../../tests/support/corpus.rs"]
mod corpus;
#[path = "support/mod.rs"]
mod support;

use std::path::Path;

use congruent_description::{DhConvention, DhRowKind, Robot, RobotQ, load_robot};
use congruent_kinematics::{DhChain, Pose, ScrewTree, SerialChain, UrdfTree};
use nalgebra::{Isometry3, Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};
use serde_json::Value;
use support::{RowFigures, TableFigures, within};

/// Rounding, ours and the other program's, over up to nine rows within 3 m; worst seen 5.3e-16.
const TABLE_M: f64 = 1e-14;
/// Rounding, ours and the other program's, over up to nine rows; worst seen 5.3e-16.
const TABLE_RAD: f64 = 1e-14;
/// Rounding, ours and the other program's, over chains of up to 15 joints within 2 m; worst seen 2.8e-15.
const TREE_M: f64 = 2e-14;
/// Rounding, ours and the other program's, over chains of up to 15 joints; worst seen 5.7e-15.
const TREE_RAD: f64 = 2e-14;

const ROBOTS: [&str; 9] =
    ["baxter", "denso_hsr065", "fanuc_m10ia", "iiwa14", "panda", "rrr_arm", "so100", "ur5e", "xarm7_gripper"];

fn read(path: &Path) -> Value {
    let text = std::fs::read_to_string(path).expect("the corpus holds the file");
    serde_json::from_str(&text).expect("the file is JSON")
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn numbers(value: &Value) -> Vec<f64> {
    array(value).iter().map(number).collect()
}

fn array(value: &Value) -> &Vec<Value> {
    value.as_array().expect("an array")
}

fn text(value: &Value) -> &str {
    value.as_str().expect("a string")
}

fn pose_of_rows(rows: &Value) -> Pose {
    let rotation = Matrix3::from_fn(|row, column| number(&rows[row][column]));
    Pose::from_parts(rotation, Vector3::from_fn(|row, _| number(&rows[row][3])))
}

fn isometry_of_rows(rows: &Value) -> Isometry3<f64> {
    let Pose { rotation, translation } = pose_of_rows(rows);
    let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rotation));
    Isometry3::from_parts(translation.into(), turn)
}

/// From `[x, y, z, qw, qx, qy, qz]`.
fn pose_of_seven(seven: &Value) -> Pose {
    let seven = numbers(seven);
    let turn = UnitQuaternion::from_quaternion(Quaternion::new(seven[3], seven[4], seven[5], seven[6]));
    Pose::from(Isometry3::from_parts(Vector3::new(seven[0], seven[1], seven[2]).into(), turn))
}

fn table_figures(table: &Value) -> TableFigures {
    let row = |row: &Value| {
        let [a_m, alpha_rad, d_m, theta_rad] =
            ["a", "alpha", "d", "theta_offset"].map(|key| number(&row[key]));
        let kind = if text(&row["type"]) == "R" { DhRowKind::Revolute } else { DhRowKind::Prismatic };
        let sign = if row["flip"] == Value::Bool(true) { -1.0 } else { 1.0 };
        RowFigures { kind, a_m, alpha_rad, d_m, theta_rad, sign }
    };
    TableFigures {
        convention: match text(&table["convention"]) {
            "classic" => DhConvention::Standard,
            "modified" => DhConvention::Modified,
            other => panic!("unknown convention {other}"),
        },
        rows: array(&table["rows"]).iter().map(row).collect(),
        base_from_dh0: isometry_of_rows(&table["base"]),
        dhn_from_tip: isometry_of_rows(&table["tool"]),
    }
}

#[track_caller]
fn assert_table_pose(name: &str, found: &Pose, golden: &Value) {
    let golden = pose_of_rows(golden);
    let (distance_m, angle_rad) = (found.distance_m(&golden), found.angle_rad(&golden));
    assert!(within(distance_m, TABLE_M), "{name}: {distance_m:e} m");
    assert!(within(angle_rad, TABLE_RAD), "{name}: {angle_rad:e} rad");
}

#[test]
fn tables_against_roboticstoolbox() {
    let Some(corpus) = corpus::corpus() else { return };
    let file = read(&corpus.join("robots/dh_tables.json"));
    let tables = array(&file["tables"]);
    assert_eq!(tables.len(), 32);
    for table in tables {
        let (name, golden) = (text(&table["name"]), &table["golden"]);
        let figures = table_figures(table);
        let robot = figures.robot();
        let chain = DhChain::new(&figures.table(&robot), &robot);
        for sample in array(&golden["fk"]) {
            let tip = chain.base_from_tip(&numbers(&sample["q"]).into()).unwrap();
            assert_table_pose(name, &tip, &sample["T"]);
        }
        let mut frames = vec![Pose::identity(); chain.joint_count() + 1];
        chain.dh_frames_into(&numbers(&golden["frames_q"]).into(), &mut frames).unwrap();
        assert_eq!(frames.len(), array(&golden["frames"]).len());
        for (found, golden) in frames.iter().zip(array(&golden["frames"])) {
            assert_table_pose(name, found, golden);
        }
    }
}

/// The golden's joint positions, which go by name, in the order of the robot's coordinates.
fn positions(robot: &Robot, golden: &Value, configuration: &Value) -> RobotQ {
    let mut q = RobotQ::from(vec![f64::NAN; robot.dof()]);
    for (joint, position) in array(&golden["joints"]).iter().zip(array(&configuration["q"])) {
        let joint = robot.find_joint(text(&joint["name"])).expect("the robot has the golden's joint");
        q[robot.coordinate(joint).expect("the golden's joint moves")] = number(position);
    }
    q
}

#[track_caller]
fn assert_tree_pose(at: &str, found: &Pose, golden: &Value) {
    let golden = pose_of_seven(golden);
    let (distance_m, angle_rad) = (found.distance_m(&golden), found.angle_rad(&golden));
    assert!(within(distance_m, TREE_M), "{at}: {distance_m:e} m");
    assert!(within(angle_rad, TREE_RAD), "{at}: {angle_rad:e} rad");
}

fn assert_trees(name: &str, robot: &Robot, golden: &Value) {
    let (tree, screws) = (UrdfTree::new(robot), ScrewTree::new(robot));
    let mut by_joints = vec![Pose::identity(); robot.links().len()];
    let mut by_screws = by_joints.clone();
    for configuration in array(&golden["configs"]) {
        let q = positions(robot, golden, configuration);
        tree.root_from_links_into(&q, &mut by_joints).expect("lengths are right");
        screws.root_from_links_into(&q, &mut by_screws).expect("lengths are right");
        for (link, pose) in array(&golden["links"]).iter().zip(array(&configuration["poses"])) {
            let link = robot.find_link(text(link)).expect("the robot has the golden's link");
            for (path, found) in [("urdf", &by_joints[link.get()]), ("poe", &by_screws[link.get()])] {
                assert_tree_pose(&format!("{name}, {path}, {} at {q:?}", robot.link(link).name), found, pose);
            }
        }
    }
}

/// All configurations of the golden at once, to every link.
fn assert_batches(name: &str, robot: &Robot, golden: &Value) {
    let configurations = array(&golden["configs"]);
    for (at, link) in array(&golden["links"]).iter().enumerate() {
        let tip = robot.find_link(text(link)).expect("the robot has the golden's link");
        let chain = SerialChain::from_urdf(robot, robot.root(), tip);
        let q: Vec<f64> = configurations
            .iter()
            .flat_map(|configuration| {
                let q = positions(robot, golden, configuration).chain_positions(chain.coordinates());
                q.to_vec()
            })
            .collect();
        let mut root_from_tips = vec![Pose::identity(); configurations.len()];
        chain.base_from_tips_into(&q, &mut root_from_tips).expect("lengths are right");
        for (found, configuration) in root_from_tips.iter().zip(configurations) {
            assert_tree_pose(&format!("{name}, batch to {link}"), found, &configuration["poses"][at]);
        }
    }
}

#[test]
fn trees_against_pinocchio() {
    let Some(corpus) = corpus::corpus() else { return };
    for name in ROBOTS {
        let folder = corpus.join("robots").join(name);
        let description = load_robot(&folder.join("robot.urdf")).expect("the corpus robot loads");
        let golden = read(&folder.join("golden.json"));
        assert_eq!(description.robot.link(description.robot.root()).name, text(&golden["root_link"]));
        assert_eq!(description.robot.links().len(), array(&golden["links"]).len());
        assert_trees(name, &description.robot, &golden);
        assert_batches(name, &description.robot, &golden);
    }
}
