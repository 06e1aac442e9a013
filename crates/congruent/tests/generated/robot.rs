//! Valid robots of any shape: trees of all kinds of joints, axes that are odd or almost parallel, names that are legal and
//! unusual.

use std::{f64::consts::FRAC_PI_2, fmt::Write};

use proptest::prelude::*;

/// A robot as its URDF says it.
#[derive(Debug, Clone)]
pub(crate) struct GeneratedRobot {
    name: &'static str,
    joints: Vec<GeneratedJoint>,
}

#[derive(Debug, Clone)]
struct GeneratedJoint {
    name: &'static str,
    kind: GeneratedKind,
    /// Links that it may hang on, counted from the newest one back.
    back: usize,
    xyz: [f64; 3],
    rpy: [f64; 3],
    axis: [f64; 3],
    /// Half of the range, and its middle as a share of that.
    range: [f64; 2],
}

#[derive(Debug, Clone, Copy)]
enum GeneratedKind {
    Fixed,
    Revolute,
    Continuous,
    Prismatic,
    /// Turns by so many times the newest joint that is not fixed and follows none, and an offset.
    Mimic(f64, f64),
}

/// Names that XML and TOML can hold; each becomes unique by a number.
const NAMES: [&str; 12] =
    ["joint", "ellbogen gelenk", "关节", "a\"b", "it's", "<&>", "a.b", "a/b", "-", "👋", "#", "[dh.row]"];

fn name() -> impl Strategy<Value = &'static str> {
    proptest::sample::select(NAMES.to_vec())
}

/// Lengths of arms, zero among them.
fn length() -> impl Strategy<Value = f64> {
    prop_oneof![2 => Just(0.0), 1 => Just(0.25), 3 => -0.6..0.6]
}

/// Angles, quarter turns among them, exact and with the digits of files.
fn angle() -> impl Strategy<Value = f64> {
    prop_oneof![
        3 => Just(0.0),
        2 => Just(FRAC_PI_2),
        1 => Just(-FRAC_PI_2),
        1 => Just((FRAC_PI_2 * 1e7).round() / 1e7),
        1 => Just(std::f64::consts::PI),
        2 => -3.0..3.0,
    ]
}

fn axis() -> impl Strategy<Value = [f64; 3]> {
    let long = |axis: &[f64; 3]| axis.iter().map(|it| it * it).sum::<f64>() > 0.01;
    prop_oneof![
        4 => Just([0.0, 0.0, 1.0]),
        1 => Just([0.0, -1.0, 0.0]),
        1 => Just([1.0, 0.0, 0.0]),
        1 => Just([0.0, 0.6, 0.8]),
        2 => [-1.0..1.0, -1.0..1.0, -1.0..1.0].prop_filter("an axis has a length", long),
    ]
}

fn kind() -> impl Strategy<Value = GeneratedKind> {
    prop_oneof![
        1 => Just(GeneratedKind::Fixed),
        4 => Just(GeneratedKind::Revolute),
        1 => Just(GeneratedKind::Continuous),
        1 => Just(GeneratedKind::Prismatic),
        1 => (-2.0..2.0, -0.3..0.3).prop_map(|(by, offset)| GeneratedKind::Mimic(by, offset)),
    ]
}

fn joint() -> impl Strategy<Value = GeneratedJoint> {
    let place = ([length(), length(), length()], [angle(), angle(), angle()], axis());
    // Mostly chains: a branch hangs on an older link.
    let back = prop_oneof![5 => Just(0_usize), 1 => 0_usize..4];
    (name(), kind(), back, place, [0.3..3.0, -0.9..0.9]).prop_map(
        |(name, kind, back, (xyz, rpy, axis), range)| GeneratedJoint {
            name,
            kind,
            back,
            xyz,
            rpy,
            axis,
            range,
        },
    )
}

/// Robots of one to eight joints, of which at least one moves by itself.
pub(crate) fn robot() -> impl Strategy<Value = GeneratedRobot> {
    (name(), proptest::collection::vec(joint(), 1..9)).prop_map(|(name, mut joints)| {
        let drives =
            |joint: &GeneratedJoint| !matches!(joint.kind, GeneratedKind::Fixed | GeneratedKind::Mimic(..));
        if !joints.iter().any(drives) {
            joints[0].kind = GeneratedKind::Revolute;
        }
        GeneratedRobot { name, joints }
    })
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

fn numbers(values: [f64; 3]) -> String {
    values.map(|value| format!("{value:?}")).join(" ")
}

impl GeneratedRobot {
    /// The robot as a URDF text, one link and joint for each row.
    pub(crate) fn urdf(&self) -> String {
        let mut text = format!("<robot name=\"{}\">\n", escaped(self.name));
        let link = |index: usize| format!("{} {index}", escaped(NAMES[index % NAMES.len()]));
        for index in 0..=self.joints.len() {
            let _ = writeln!(
                text,
                "<link name=\"{}\"><inertial><origin xyz=\"0.02 0.01 0.05\"/><mass value=\"1.5\"/>\
                 <inertia ixx=\"0.02\" ixy=\"0\" ixz=\"0\" iyy=\"0.03\" iyz=\"0\" izz=\"0.025\"/></inertial></link>",
                link(index)
            );
        }
        let mut driver: Option<String> = None;
        for (index, joint) in self.joints.iter().enumerate() {
            let name = format!("{} {index}", escaped(joint.name));
            let parent = link(index.saturating_sub(joint.back));
            let (kind, mimic) = match (joint.kind, &driver) {
                (GeneratedKind::Fixed, _) | (GeneratedKind::Mimic(..), None) => ("fixed", String::new()),
                (GeneratedKind::Mimic(by, offset), Some(master)) => {
                    let mimic =
                        format!("<mimic joint=\"{master}\" multiplier=\"{by:?}\" offset=\"{offset:?}\"/>");
                    ("continuous", mimic)
                }
                (GeneratedKind::Revolute, _) => ("revolute", String::new()),
                (GeneratedKind::Continuous, _) => ("continuous", String::new()),
                (GeneratedKind::Prismatic, _) => ("prismatic", String::new()),
            };
            let [half, middle] = joint.range;
            let range = match kind {
                "revolute" | "prismatic" => {
                    format!("lower=\"{:?}\" upper=\"{:?}\" ", half * (middle - 1.0), half * (middle + 1.0))
                }
                _ => String::new(),
            };
            let limit = if kind == "fixed" {
                String::new()
            } else {
                format!("<axis xyz=\"{}\"/><limit {range}effort=\"50\" velocity=\"2\"/>", numbers(joint.axis))
            };
            let _ = writeln!(
                text,
                "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{}\"/>\
                 <origin xyz=\"{}\" rpy=\"{}\"/>{limit}{mimic}</joint>",
                link(index + 1),
                numbers(joint.xyz),
                numbers(joint.rpy)
            );
            if !matches!(joint.kind, GeneratedKind::Fixed | GeneratedKind::Mimic(..)) {
                driver = Some(name);
            }
        }
        text.push_str("</robot>\n");
        text
    }
}
