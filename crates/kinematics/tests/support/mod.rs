//! Robots built in code, and random parameters, for the tests and benchmarks of this crate.
//!
//! It uses isometries of nalgebra and nothing of the crate, so that it can serve as an independent source.

#![allow(dead_code, unreachable_pub, reason = "each test file uses its own part")]

use std::f64::consts::PI;

use congruent_description::{
    ChainQ, DhConvention, DhRow, DhRowKind, DhTable, JointKind, JointParts, Link, Robot, RobotQ,
};
use nalgebra::{Isometry3, Translation3, Unit, UnitQuaternion, Vector3};
use proptest::{prelude::*, test_runner::FileFailurePersistence};

/// Whether `value` is below `bound`; with `CONGRUENT_MEASURE` set it also says so on stderr, from
/// where the worst values in the comments of the tolerances come.
#[track_caller]
#[allow(clippy::print_stderr, reason = "asked for, and read by whoever asks")]
pub fn within(value: f64, bound: f64) -> bool {
    if std::env::var_os("CONGRUENT_MEASURE").is_some() {
        let at = std::panic::Location::caller();
        eprintln!("measured {}:{} {value:e} of {bound:e}", at.file(), at.line());
    }
    value <= bound
}

/// Enough cases to find a wrong sign, few enough for a fast suite; failing seeds are kept.
pub fn cases() -> ProptestConfig {
    const CASES: u32 = 64;
    let default = ProptestConfig::default();
    let measuring = std::env::var_os("CONGRUENT_MEASURE").is_some();
    let failure_persistence = Some(Box::new(FileFailurePersistence::WithSource("regressions")) as _);
    ProptestConfig { cases: if measuring { default.cases } else { CASES }, failure_persistence, ..default }
}

/// A vector of up to 1 m along each axis.
pub fn vector() -> impl Strategy<Value = Vector3<f64>> {
    [-1.0..1.0, -1.0..1.0, -1.0..1.0].prop_map(Vector3::from)
}

/// A direction.
pub fn unit_vector() -> impl Strategy<Value = Unit<Vector3<f64>>> {
    vector().prop_filter_map("too short to be a direction", |v| Unit::try_new(v, 0.1))
}

/// A shift and a turn about an unrelated axis.
pub fn isometry() -> impl Strategy<Value = Isometry3<f64>> {
    (vector(), unit_vector(), -PI..PI).prop_map(|(shift, axis, angle)| {
        Isometry3::from_parts(shift.into(), UnitQuaternion::from_axis_angle(&axis, angle))
    })
}

/// `a`, `alpha`, `d`, `theta`.
pub fn dh_figures() -> impl Strategy<Value = [f64; 4]> {
    [-1.0..1.0, -PI..PI, -1.0..1.0, -PI..PI]
}

/// `Rz(theta) Tz(d)`.
pub fn screw_z(theta_rad: f64, d_m: f64) -> Isometry3<f64> {
    let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), theta_rad);
    Isometry3::from_parts(Translation3::new(0.0, 0.0, d_m), turn)
}

/// `Tx(a) Rx(alpha)`.
pub fn screw_x(alpha_rad: f64, a_m: f64) -> Isometry3<f64> {
    let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), alpha_rad);
    Isometry3::from_parts(Translation3::new(a_m, 0.0, 0.0), turn)
}

/// One joint of a robot under construction; the link it carries has its name.
#[derive(Debug, Clone)]
pub struct Carried {
    pub name: String,
    pub parent: String,
    pub kind: JointKind,
    pub parent_from_joint: Isometry3<f64>,
    pub axis_in_joint: Unit<Vector3<f64>>,
}

impl Carried {
    pub fn fixed(name: &str, parent: &str, parent_from_joint: Isometry3<f64>) -> Self {
        Self {
            name: name.into(),
            parent: parent.into(),
            kind: JointKind::Fixed,
            parent_from_joint,
            axis_in_joint: Vector3::x_axis(),
        }
    }

    fn parts(self) -> JointParts {
        let Self { name, parent, kind, parent_from_joint, axis_in_joint } = self;
        let mut parts = JointParts::new(&name, kind, &parent, &name, parent_from_joint);
        parts.joint.axis_in_joint = axis_in_joint;
        parts
    }
}

/// A robot with the root link `base` and one link for each joint, named like the joint.
pub fn robot(joints: Vec<Carried>) -> Robot {
    let link = |name: &str| Link { name: name.into(), ..Link::default() };
    let mut links = vec![link("base")];
    links.extend(joints.iter().map(|joint| link(&joint.name)));
    let joints = joints.into_iter().map(Carried::parts).collect();
    Robot::new("test", links, joints).expect("the parts are a tree")
}

/// The parameters of one row.
#[derive(Debug, Clone, Copy)]
pub struct RowFigures {
    pub kind: DhRowKind,
    pub a_m: f64,
    pub alpha_rad: f64,
    pub d_m: f64,
    pub theta_rad: f64,
    pub sign: f64,
}

impl RowFigures {
    pub fn revolute(a_m: f64, alpha_deg: f64, d_m: f64) -> Self {
        let alpha_rad = alpha_deg.to_radians();
        Self { kind: DhRowKind::Revolute, a_m, alpha_rad, d_m, theta_rad: 0.0, sign: 1.0 }
    }

    pub fn prismatic(alpha_deg: f64) -> Self {
        Self { kind: DhRowKind::Prismatic, ..Self::revolute(0.0, alpha_deg, 0.0) }
    }

    fn table_row(self, at: usize, robot: &Robot) -> DhRow {
        let Self { kind, a_m, alpha_rad, d_m, theta_rad, sign } = self;
        let joint = robot.find_joint(&format!("joint{}", at + 1)).expect("a joint for each row");
        DhRow { joint, kind, a_m, alpha_rad, d_m, theta_rad, sign, line: at + 1 }
    }
}

/// A table before its robot exists.
#[derive(Debug, Clone)]
pub struct TableFigures {
    pub convention: DhConvention,
    pub rows: Vec<RowFigures>,
    pub base_from_dh0: Isometry3<f64>,
    pub dhn_from_tip: Isometry3<f64>,
}

impl TableFigures {
    pub fn new(convention: DhConvention, rows: &[RowFigures]) -> Self {
        let identity = Isometry3::identity();
        Self { convention, rows: rows.to_vec(), base_from_dh0: identity, dhn_from_tip: identity }
    }

    /// The robot that the table describes, as a description with links `base`, `joint1`, ..., `tip`:
    /// each row's factors before and after its joint's motion, multiplied into the joint origins.
    pub fn robot(&self) -> Robot {
        let mut joints = Vec::new();
        let (mut parent, mut parent_from_here) = (String::from("base"), self.base_from_dh0);
        for (at, row) in self.rows.iter().enumerate() {
            let (about_x, about_z) = (screw_x(row.alpha_rad, row.a_m), screw_z(row.theta_rad, row.d_m));
            let (before, after) = match self.convention {
                DhConvention::Standard => (Isometry3::identity(), about_z * about_x),
                DhConvention::Modified => (about_x, about_z),
            };
            let name = format!("joint{}", at + 1);
            joints.push(Carried {
                name: name.clone(),
                parent,
                kind: match row.kind {
                    DhRowKind::Revolute => JointKind::Continuous,
                    DhRowKind::Prismatic => JointKind::Prismatic,
                },
                parent_from_joint: parent_from_here * before,
                axis_in_joint: Unit::new_unchecked(Vector3::z() * row.sign),
            });
            (parent, parent_from_here) = (name, after);
        }
        joints.push(Carried::fixed("tip", &parent, parent_from_here * self.dhn_from_tip));
        robot(joints)
    }

    /// The table as the description holds it, for the joints of [`TableFigures::robot`].
    pub fn table(&self, robot: &Robot) -> DhTable {
        DhTable {
            convention: self.convention,
            source: None,
            base_from_dh0: self.base_from_dh0,
            dhn_from_tip: self.dhn_from_tip,
            rows: self.rows.iter().enumerate().map(|(at, row)| row.table_row(at, robot)).collect(),
        }
    }
}

/// A table with the lengths of a `UR5e`.
pub fn ur5e_table() -> TableFigures {
    let row = RowFigures::revolute;
    let rows = [
        row(0.0, 90.0, 0.1625),
        row(-0.425, 0.0, 0.0),
        row(-0.3922, 0.0, 0.0),
        row(0.0, 90.0, 0.1333),
        row(0.0, -90.0, 0.0997),
        row(0.0, 0.0, 0.0996),
    ];
    TableFigures::new(DhConvention::Standard, &rows)
}

/// A table with the lengths of a Panda: seven joints, of which all matter.
pub fn panda_table() -> TableFigures {
    let row = RowFigures::revolute;
    let rows = [
        row(0.0, 0.0, 0.333),
        row(0.0, -90.0, 0.0),
        row(0.0, 90.0, 0.316),
        row(0.0825, 90.0, 0.0),
        row(-0.0825, -90.0, 0.384),
        row(0.0, 90.0, 0.0),
        row(0.088, 90.0, 0.107),
    ];
    TableFigures::new(DhConvention::Modified, &rows)
}

/// A random table of one to seven rows, with a random base and tip.
pub fn table_figures() -> impl Strategy<Value = TableFigures> {
    let row = (dh_figures(), any::<bool>(), any::<bool>()).prop_map(
        |([a_m, alpha_rad, d_m, theta_rad], turns, backwards)| RowFigures {
            kind: if turns { DhRowKind::Revolute } else { DhRowKind::Prismatic },
            a_m,
            alpha_rad,
            d_m,
            theta_rad,
            sign: if backwards { -1.0 } else { 1.0 },
        },
    );
    (any::<bool>(), proptest::collection::vec(row, 1..=7), isometry(), isometry()).prop_map(
        |(standard, rows, base_from_dh0, dhn_from_tip)| TableFigures {
            convention: if standard { DhConvention::Standard } else { DhConvention::Modified },
            rows,
            base_from_dh0,
            dhn_from_tip,
        },
    )
}

/// The joints of a random tree of up to eight links beside `base`, all kinds of joint.
pub fn tree() -> impl Strategy<Value = Vec<Carried>> {
    let kind = prop_oneof![
        1 => Just(JointKind::Fixed),
        3 => Just(JointKind::Revolute),
        1 => Just(JointKind::Continuous),
        2 => Just(JointKind::Prismatic),
    ];
    let joint = (kind, any::<prop::sample::Index>(), isometry(), unit_vector());
    proptest::collection::vec(joint, 1..=8).prop_map(|joints| {
        let name = |at: usize| if at == 0 { String::from("base") } else { format!("link{at}") };
        let carried = |(at, (kind, parent, parent_from_joint, axis_in_joint)): (
            usize,
            (_, prop::sample::Index, _, _),
        )| {
            Carried {
                name: name(at + 1),
                parent: name(parent.index(at + 1)),
                kind,
                parent_from_joint,
                axis_in_joint,
            }
        };
        joints.into_iter().enumerate().map(carried).collect()
    })
}

/// One number for each joint of any robot of [`tree`] or [`table_figures`].
#[derive(Debug, Clone)]
pub struct Positions([f64; 8]);

impl Positions {
    pub fn of_robot(&self, robot: &Robot) -> RobotQ {
        self.of_joints(robot.dof()).into()
    }

    pub fn of_chain(&self, joints: usize) -> ChainQ {
        self.of_joints(joints).into()
    }

    /// The first `joints` numbers: positions, speeds, accelerations.
    pub fn of_joints(&self, joints: usize) -> &[f64] {
        &self.0[..joints]
    }
}

/// Random positions of up to eight joints, between -pi and pi.
pub fn positions() -> impl Strategy<Value = Positions> {
    proptest::array::uniform8(-PI..PI).prop_map(Positions)
}
