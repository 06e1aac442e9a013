//! Values of a robot file that are probably in another unit than their key says, by comparison with the size of the robot.

use std::{
    f64::consts::{FRAC_PI_2, TAU},
    ops::Range,
};

use congruent_input::{
    Diagnostic, WrittenTransform,
    display::{length, number},
    units::Unit,
};
use congruent_robot::{JointKind, Robot};
use toml::Spanned;

use super::written::{WrittenDh, WrittenRow};
use crate::codes;

/// Lengths up to this multiple of the robot's size are plausible; a tool that is as long as its arm is rare.
const MOST_SIZES: f64 = 1.5;
/// Shorter lengths, m, are not reported.
const LEAST_M: f64 = 0.3;
/// A value in degrees is taken for radians within this distance of a multiple of pi/2. Kind: four digits of the file.
const QUARTER_DEG: f64 = 1e-3;

/// The size of the robot, m: the sum of the lengths of all joint origins and of the travels of all prismatic joints.
pub(super) fn size_m(robot: &Robot) -> f64 {
    let travel = |joint: &congruent_robot::Joint| {
        let range = joint.position_range().filter(|_| joint.kind == JointKind::Prismatic)?;
        Some(range.0.abs().max(range.1.abs())).filter(|travel| travel.is_finite())
    };
    let lengths = robot
        .joints()
        .iter()
        .map(|joint| joint.parent_from_joint.translation.vector.norm() + travel(joint).unwrap_or_default());
    lengths.sum()
}

/// Warnings about a declared transform.
pub(super) fn transform(name: &str, written: &WrittenTransform, size_m: f64) -> Vec<Diagnostic> {
    let WrittenTransform { xyz_m, xyz_mm, rpy_rad, rpy_deg, matrix, .. } = written;
    let norm = |xyz: [f64; 3]| nalgebra::Vector3::from(xyz).norm();
    let of_matrix = |[[.., x], [.., y], [.., z], _]: [[f64; 4]; 4]| [x, y, z];
    let lengths = [
        xyz_m.as_ref().map(|xyz| (norm(*xyz.get_ref()), xyz.span(), LengthKey::Metres("xyz"))),
        xyz_mm.as_ref().map(|xyz| {
            (Unit::Length.convert(norm(*xyz.get_ref())), xyz.span(), LengthKey::Millimetres("xyz"))
        }),
        matrix.as_ref().map(|matrix| (norm(of_matrix(*matrix.get_ref())), matrix.span(), LengthKey::Matrix)),
    ];
    let mut lengths = lengths.into_iter().flatten();
    let far =
        lengths.find_map(|(length_m, at, key)| too_long(&format!("{name} is"), length_m, size_m, at, key));
    let degrees = rpy_rad.as_ref().and_then(|rpy| {
        let turn = rpy.get_ref().iter().find(|turn| turn.abs() > TAU)?;
        Some(degrees(&format!("{name}: rpy_rad has {}", number(*turn)), "rpy", rpy.span()))
    });
    let radians = rpy_deg.as_ref().and_then(|rpy| {
        let turn = rpy.get_ref().iter().find(|turn| is_quarter_turn_in_rad(**turn))?;
        Some(radians(&format!("{name}: rpy_deg has {turn}"), "rpy", rpy.span()))
    });
    [far, degrees, radians].into_iter().flatten().collect()
}

/// Warnings about the rows and constants of a table.
pub(super) fn table(dh: &WrittenDh, size_m: f64) -> Vec<Diagnostic> {
    let of = |name: &str, written: &Option<Spanned<WrittenTransform>>| {
        written.as_ref().map_or_else(Vec::new, |written| transform(name, written.get_ref(), size_m))
    };
    let mut found = of("base_from_dh0", &dh.base_from_dh0);
    found.extend(of("dhn_from_tip", &dh.dhn_from_tip));
    found.extend(dh.row.iter().flat_map(|written| row(written.get_ref(), size_m)));
    found
}

fn row(row: &WrittenRow, size_m: f64) -> Vec<Diagnostic> {
    let joint = row.joint.get_ref();
    let lengths = [("a", &row.a_m, &row.a_mm), ("d", &row.d_m, &row.d_mm)];
    let lengths = lengths.into_iter().filter_map(|(key, in_m, in_mm)| {
        let what = format!("row of joint \"{joint}\": {key} is");
        let warning_if_long = |written: &Spanned<f64>, length_m: f64, key| {
            too_long(&what, length_m.abs(), size_m, written.span(), key)
        };
        match (in_m, in_mm) {
            (Some(written), _) => warning_if_long(written, *written.get_ref(), LengthKey::Metres(key)),
            (_, Some(written)) => warning_if_long(
                written,
                Unit::Length.convert(*written.get_ref()),
                LengthKey::Millimetres(key),
            ),
            (None, None) => None,
        }
    });
    let angles =
        [("alpha", &row.alpha_deg), ("theta", &row.theta_deg)].into_iter().filter_map(|(key, written)| {
            let written = written.as_ref().filter(|written| is_quarter_turn_in_rad(*written.get_ref()))?;
            let what = format!("row of joint \"{joint}\": {key}_deg = {}", written.get_ref());
            Some(radians(&what, key, written.span()))
        });
    lengths.chain(angles).collect()
}

/// The kind of key that a length is given by.
#[derive(Debug, Clone, Copy)]
enum LengthKey {
    /// A key that ends in `_m`, without its ending.
    Metres(&'static str),
    /// A key that ends in `_mm`.
    Millimetres(&'static str),
    /// A homogeneous matrix.
    Matrix,
}

fn too_long(what: &str, length_m: f64, size_m: f64, at: Range<usize>, key: LengthKey) -> Option<Diagnostic> {
    (size_m > 0.0 && length_m > LEAST_M && length_m > MOST_SIZES * size_m).then(|| {
        let message = format!(
            "{what} {} long, but the robot stretched out is only {} long",
            length(length_m),
            length(size_m)
        );
        let warning = Diagnostic::warning(codes::robot_file::LENGTH, message).at(at);
        warning.with_help(match key {
            LengthKey::Metres(key) => format!("if the value is in millimetres, the key is {key}_mm"),
            LengthKey::Millimetres(key) => {
                format!("{key}_mm is read in millimetres: is the value too large by a factor of 1000?")
            }
            LengthKey::Matrix => {
                "the translation of a matrix is read in metres: is the value in millimetres?".to_owned()
            }
        })
    })
}

fn degrees(what: &str, key: &str, at: Range<usize>) -> Diagnostic {
    Diagnostic::warning(codes::robot_file::DEGREES, format!("{what}, which is more than a full turn"))
        .at(at)
        .with_help(format!("if the value is in degrees, the key is {key}_deg"))
}

fn radians(what: &str, key: &str, at: Range<usize>) -> Diagnostic {
    Diagnostic::warning(
        codes::robot_file::RADIANS,
        format!("{what}, a multiple of a quarter turn in radians"),
    )
    .at(at)
    .with_help(format!("if the value is in radians, the key is {key}_rad"))
}

fn is_quarter_turn_in_rad(degrees: f64) -> bool {
    let quarters = (degrees / FRAC_PI_2).round();
    (1.0..=4.0).contains(&quarters.abs()) && (degrees - quarters * FRAC_PI_2).abs() < QUARTER_DEG
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use crate::load::parse_robot;
    use congruent_input::SourceFile;

    const URDF: &str = "<robot name='r'><link name='a'/><link name='b'><inertial><mass value='1'/>\
        <inertia ixx='.1' ixy='0' ixz='0' iyy='.1' iyz='0' izz='.1'/></inertial></link>\
        <joint name='j' type='continuous'><origin xyz='0 0 0.5'/><parent link='a'/><child link='b'/></joint></robot>";

    fn codes(robot_file: &str) -> Vec<&'static str> {
        let source = |name: &str, text: &str| {
            Arc::new(SourceFile { path: name.into(), text: text.to_owned(), is_foreign: false })
        };
        let description = parse_robot(Some(&source("robot.toml", robot_file)), &source("r.urdf", URDF));
        description.unwrap().warnings.iter().map(|found| found.code.name).collect()
    }

    #[test]
    fn mistakes_of_a_robot_file_are_reported() {
        for (robot_file, expected) in [
            ("[tcp]\nxyz_m = [0, 0, 0.2]\nrpy_rad = [0, 1.5708, 0]", None),
            ("[tcp]\nxyz_m = [0, 0, 50]", Some("robot_file::length")),
            ("[tcp]\nxyz_m = [0, 0, 1]", Some("robot_file::length")),
            ("[tcp]\nxyz_mm = [0, 0, 200]", None),
            ("[tcp]\nxyz_mm = [0, 0, 2e5]", Some("robot_file::length")),
            ("[tcp]\nmatrix = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0.2], [0, 0, 0, 1]]", None),
            (
                "[tcp]\nmatrix = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 200], [0, 0, 0, 1]]",
                Some("robot_file::length"),
            ),
            ("[tcp]\nrpy_rad = [0, 90, 0]", Some("robot_file::degrees")),
            ("[tcp]\nrpy_deg = [0, 1.5708, 0]", Some("robot_file::radians")),
            ("[limits]\nacceleration_rad_s2 = { j = 800 }", Some("robot_file::fast")),
            ("[limits]\nacceleration_deg_s2 = { j = 800 }", None),
        ] {
            assert_eq!(codes(robot_file), Vec::from_iter(expected), "{robot_file}");
        }
        let row = |values: &str| {
            format!("[dh]\nconvention = 'standard'\n[[dh.row]]\njoint = 'j'\nkind = 'revolute'\n{values}")
        };
        assert_eq!(codes(&row("a_m = 0\nd_m = 500\nalpha_deg = 0")), ["robot_file::length"]);
        assert_eq!(codes(&row("a_m = 0\nd_m = 0.5\nalpha_deg = 1.5708")), ["robot_file::radians"]);
        assert_eq!(codes(&row("a_m = 0\nd_mm = 500\nalpha_deg = 90")), [""; 0]);
        assert_eq!(codes(&row("a_mm = 1e8\nd_mm = 500\nalpha_deg = 90")), ["robot_file::length"]);
    }
}
