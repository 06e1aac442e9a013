//! Robots to mutate: those of `robots/` with their URDFs, and tables of the corpus with the chain of
//! joints that they describe.

use std::{fs, path::Path};

use congruent_agreement::diagnosis::{
    CandidateModel, CandidateRow, ModelPair, ReferenceJoint, ReferenceModel, RowConstants,
};
use congruent_description::{DhConvention, DhRowKind, load_robot};
use congruent_kinematics::{Pose, Twist, rotation_exp};
use nalgebra::{Matrix3, Vector3};
use serde_json::Value;

/// The range of a joint without limits.
const TURN: (f64, f64) = (-std::f64::consts::PI, std::f64::consts::PI);

/// A robot: its name, its models, which agree, and the ranges of its joints, base to tip, in rad or m.
pub(crate) struct Mutable {
    pub(crate) name: String,
    pub(crate) models: ModelPair,
    pub(crate) ranges: Vec<(f64, f64)>,
}

/// Every robot at hand.
pub(crate) fn all() -> Vec<Mutable> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut robots = Vec::new();
    let mut folders: Vec<_> = fs::read_dir(root.join("robots")).unwrap().flatten().collect();
    folders.sort_by_key(fs::DirEntry::path);
    for folder in folders {
        let description = load_robot(&folder.path()).unwrap();
        let (reference, joints) =
            ReferenceModel::from_urdf(&description.robot, description.base, description.tip).unwrap();
        let moving: Vec<_> =
            joints.into_iter().filter(|&joint| description.robot.joint(joint).kind.is_movable()).collect();
        let candidate = CandidateModel::from_table(description.dh.as_ref().unwrap(), &moving).unwrap();
        let range = |&joint| description.robot.joint(joint).position_range().unwrap_or(TURN);
        let ranges = moving.iter().map(range).collect();
        robots.push(Mutable {
            name: description.name.clone(),
            models: ModelPair { candidate, reference },
            ranges,
        });
    }
    if let Some(corpus) = std::env::var_os("CONGRUENT_CORPUS") {
        let text = fs::read_to_string(root.join(corpus).join("robots/dh_tables.json")).unwrap();
        let tables: Value = serde_json::from_str(&text).unwrap();
        robots.extend(tables["tables"].as_array().unwrap().iter().map(table));
    }
    robots
}

/// A table with its chain of joints, as a URDF would write it.
fn table(table: &Value) -> Mutable {
    let convention =
        if table["convention"] == "classic" { DhConvention::Standard } else { DhConvention::Modified };
    let (base, tool) = (pose(&table["base"]), pose(&table["tool"]));
    let mut joints = Vec::new();
    let mut rows = Vec::new();
    let mut parent_from_joint = base;
    for (joint, row) in table["rows"].as_array().unwrap().iter().enumerate() {
        let value = |key: &str| row[key].as_f64().unwrap();
        let (a_m, alpha_rad, d_m, theta_rad) =
            (value("a"), value("alpha"), value("d"), value("theta_offset"));
        let kind = if row["type"] == "R" { DhRowKind::Revolute } else { DhRowKind::Prismatic };
        let rate = if row["flip"] == true { -1.0 } else { 1.0 };
        rows.push(CandidateRow {
            joint,
            rate,
            link: RowConstants::Dh { kind, a_m, alpha_rad, d_m, theta_rad },
        });
        let along_x = turned_and_shifted(Vector3::x(), alpha_rad, a_m);
        let along_z = turned_and_shifted(Vector3::z(), theta_rad, d_m);
        let (before, behind) = match convention {
            DhConvention::Standard => (Pose::identity(), along_z * along_x),
            DhConvention::Modified => (along_x, along_z),
        };
        joints.push(moving(parent_from_joint * before, kind, rate));
        parent_from_joint = behind;
    }
    joints.push(ReferenceJoint {
        parent_from_joint,
        twist_in_joint: None,
        is_upward: false,
        is_written: true,
    });
    joints.push(ReferenceJoint {
        parent_from_joint: tool,
        twist_in_joint: None,
        is_upward: false,
        is_written: true,
    });
    let candidate =
        CandidateModel { convention: Some(convention), base: base.into(), rows, tool: tool.into() };
    let name = table["name"].as_str().unwrap().to_owned();
    let ranges = table["rows"].as_array().unwrap().iter().map(range).collect();
    Mutable { name, models: ModelPair { candidate, reference: ReferenceModel { joints } }, ranges }
}

/// The row's limits, or one turn, or half a metre to either side.
fn range(row: &Value) -> (f64, f64) {
    match (&row["qlim"], row["type"] == "R") {
        (Value::Array(ends), _) => (ends[0].as_f64().unwrap(), ends[1].as_f64().unwrap()),
        (_, true) => TURN,
        (_, false) => (-0.5, 0.5),
    }
}

fn moving(parent_from_joint: Pose, kind: DhRowKind, rate: f64) -> ReferenceJoint {
    let axis = Vector3::z() * rate;
    let twist = match kind {
        DhRowKind::Revolute => Twist { angular: axis, linear: Vector3::zeros() },
        DhRowKind::Prismatic => Twist { angular: Vector3::zeros(), linear: axis },
    };
    ReferenceJoint { parent_from_joint, twist_in_joint: Some(twist), is_upward: false, is_written: true }
}

fn turned_and_shifted(axis: Vector3<f64>, turn_rad: f64, shift_m: f64) -> Pose {
    Pose::from_parts(rotation_exp(&(axis * turn_rad)), axis * shift_m)
}

fn pose(rows: &Value) -> Pose {
    let at = |row: usize, column: usize| rows[row][column].as_f64().unwrap();
    Pose::from_parts(Matrix3::from_fn(at), Vector3::from_fn(|row, _| at(row, 3)))
}
