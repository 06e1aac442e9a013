//! A rigid transform as a TOML file writes it: by translation and one of three kinds of rotation,
//! or by a whole matrix.

use nalgebra::{Isometry3, Matrix3, Quaternion, Rotation3, Translation3, UnitQuaternion};
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use super::{
    array::{fixed_array, fixed_matrix},
    number::{Slack, fitted_list},
    rpy::{fitted_rpy_fixed_xyz_rad, rotation_from_rpy_fixed_xyz},
};
use crate::{
    codes,
    diagnostic::Diagnostic,
    units::{Unit, UnitSystem, check_finite},
};

/// How far the norm of a written quaternion may be from 1: six digits in the file, rounding of
/// four components. A larger deviation is an error in the file, which normalising would hide.
const QUATERNION_NORM: f64 = 1e-6;
/// How far `R^T R` of a written matrix may be from the identity, per entry: ten digits in the file.
const ORTHONORMAL: f64 = 1e-9;

/// A transform as written; the identity if nothing is given.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Transform")]
pub struct WrittenTransform {
    /// Translation x, y, z in metres.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "[f64; 3]")]
    pub xyz_m: Option<Spanned<[f64; 3]>>,
    /// Translation x, y, z in millimetres.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "[f64; 3]")]
    pub xyz_mm: Option<Spanned<[f64; 3]>>,
    /// Turns about the fixed axes x, then y, then z, in radians.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "[f64; 3]")]
    pub rpy_rad: Option<Spanned<[f64; 3]>>,
    /// Turns about the fixed axes x, then y, then z, in degrees.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "[f64; 3]")]
    pub rpy_deg: Option<Spanned<[f64; 3]>>,
    /// Unit quaternion, scalar first.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "[f64; 4]")]
    pub quaternion_wxyz: Option<Spanned<[f64; 4]>>,
    /// Homogeneous matrix by rows, in metres; excludes all other keys.
    #[serde(default, deserialize_with = "fixed_matrix")]
    #[schemars(with = "[[f64; 4]; 4]")]
    pub matrix: Option<Spanned<[[f64; 4]; 4]>>,
}

impl WrittenTransform {
    /// Whether a rotation is written, even if it is the identity.
    pub fn has_rotation(&self) -> bool {
        let Self { xyz_m: _, xyz_mm: _, rpy_rad, rpy_deg, quaternion_wxyz, matrix } = self;
        rpy_rad.is_some() || rpy_deg.is_some() || quaternion_wxyz.is_some() || matrix.is_some()
    }

    /// The keys again, as they were written.
    pub fn to_table(&self) -> toml::Table {
        fn numbers(numbers: &[f64]) -> toml::Value {
            numbers.iter().map(|&number| toml::Value::Float(number)).collect::<Vec<_>>().into()
        }
        let vector = |key: &str, vector: Option<&Spanned<[f64; 3]>>| {
            vector.map(|vector| (key.to_owned(), numbers(vector.get_ref())))
        };
        let quaternion = self
            .quaternion_wxyz
            .as_ref()
            .map(|entries| ("quaternion_wxyz".to_owned(), numbers(entries.get_ref())));
        let matrix = self.matrix.as_ref().map(|rows| {
            let rows = rows.get_ref().iter().map(|row| numbers(row));
            ("matrix".to_owned(), rows.collect::<Vec<_>>().into())
        });
        let vectors = [
            vector("xyz_m", self.xyz_m.as_ref()),
            vector("xyz_mm", self.xyz_mm.as_ref()),
            vector("rpy_rad", self.rpy_rad.as_ref()),
            vector("rpy_deg", self.rpy_deg.as_ref()),
        ];
        vectors.into_iter().chain([quaternion, matrix]).flatten().collect()
    }

    /// The keys that write another transform as this one is written: in its units and by its kind of
    /// rotation. A key that this one lacks is written in the units `default`, of lengths and of angles.
    pub fn with_keys(&self, pose: &Isometry3<f64>, default: [UnitSystem; 2], slack: Slack) -> Vec<String> {
        if self.matrix.is_some() {
            let matrix = pose.to_homogeneous();
            let rows = (0..4).map(|row| fitted_list(matrix.row(row).iter().copied()));
            return vec![format!("matrix = [{}]", rows.collect::<Vec<_>>().join(", "))];
        }
        let shift = (pose.translation.vector.amax() > slack.length_m
            || self.xyz_m.is_some()
            || self.xyz_mm.is_some())
        .then(|| {
            let units = UnitSystem::from_given_key(self.xyz_m.as_ref(), self.xyz_mm.as_ref(), default[0]);
            Unit::Length.fitted_vector("xyz", pose.translation.vector.into(), units, slack)
        });
        let turn = if self.quaternion_wxyz.is_some() {
            let Quaternion { coords } = *pose.rotation.quaternion();
            Some(format!("quaternion_wxyz = {}", fitted_list([coords.w, coords.x, coords.y, coords.z])))
        } else {
            let units = UnitSystem::from_given_key(self.rpy_rad.as_ref(), self.rpy_deg.as_ref(), default[1]);
            let rpy_rad = fitted_rpy_fixed_xyz_rad(pose, slack);
            let has_turn = self.has_rotation() || rpy_rad.iter().any(|angle| angle.abs() > slack.angle_rad);
            has_turn.then(|| Unit::Angle.fitted_vector("rpy", rpy_rad, units, slack))
        };
        shift.into_iter().chain(turn).collect()
    }

    /// The transform as a rigid motion in metres.
    ///
    /// # Errors
    /// Two keys for one part, a value that is not finite, a quaternion whose norm is not 1, or
    /// a matrix that is no rigid motion.
    pub fn isometry(&self) -> Result<Isometry3<f64>, Diagnostic> {
        let translation = Unit::Length.vector("xyz", self.xyz_m.as_ref(), self.xyz_mm.as_ref())?;
        let rpy = Unit::Angle.vector("rpy", self.rpy_rad.as_ref(), self.rpy_deg.as_ref())?;
        if let Some(matrix) = &self.matrix {
            if translation.is_some() || rpy.is_some() || self.quaternion_wxyz.is_some() {
                return Err(conflict(
                    "matrix is given together with xyz, rpy or quaternion_wxyz",
                    matrix.span(),
                ));
            }
            return from_matrix(matrix);
        }
        let rotation = match (rpy, &self.quaternion_wxyz) {
            (Some(_), Some(quaternion)) => {
                return Err(conflict("rpy and quaternion_wxyz are both given", quaternion.span()));
            }
            (Some(rpy), None) => rotation_from_rpy_fixed_xyz(rpy),
            (None, Some(quaternion)) => from_quaternion(quaternion)?,
            (None, None) => UnitQuaternion::identity(),
        };
        Ok(Isometry3::from_parts(Translation3::from(translation.unwrap_or_default()), rotation))
    }
}

/// A fitted transform in metres and radians, as a robot file could write it.
pub fn fitted_transform(pose: &Isometry3<f64>, slack: Slack) -> String {
    let xyz = Unit::Length.fitted_vector("xyz", pose.translation.vector.into(), UnitSystem::Si, slack);
    let rpy = Unit::Angle.fitted_vector("rpy", fitted_rpy_fixed_xyz_rad(pose, slack), UnitSystem::Si, slack);
    format!("{{ {xyz}, {rpy} }}")
}

fn conflict(message: &str, span: std::ops::Range<usize>) -> Diagnostic {
    Diagnostic::error(codes::transform::CONFLICT, message).at(span).with_help("keep exactly one of them")
}

fn from_quaternion(written: &Spanned<[f64; 4]>) -> Result<UnitQuaternion<f64>, Diagnostic> {
    let [w, x, y, z] = *written.get_ref();
    for value in [w, x, y, z] {
        check_finite("quaternion_wxyz", value, written.span())?;
    }
    let quaternion = Quaternion::new(w, x, y, z);
    let norm = quaternion.norm();
    if (norm - 1.0).abs() > QUATERNION_NORM {
        let message = format!("quaternion_wxyz has norm {norm:.7}, it must be 1 within {QUATERNION_NORM}");
        return Err(Diagnostic::error(codes::transform::QUATERNION_NORM, message)
            .at(written.span())
            .with_help("write it with more digits, in the order w, x, y, z: it is not normalised for you"));
    }
    Ok(UnitQuaternion::from_quaternion(quaternion))
}

fn from_matrix(written: &Spanned<[[f64; 4]; 4]>) -> Result<Isometry3<f64>, Diagnostic> {
    let rows = written.get_ref();
    for &value in rows.iter().flatten() {
        check_finite("matrix", value, written.span())?;
    }
    let refused = |message: String| {
        Err(Diagnostic::error(codes::transform::MATRIX, message)
            .at(written.span())
            .with_help("rows of [R | t] with R^T R = 1 and det R = 1, then [0, 0, 0, 1]; t in metres"))
    };
    let last = [0.0, 0.0, 0.0, 1.0];
    if rows[3].iter().zip(last).any(|(found, expected)| (found - expected).abs() > ORTHONORMAL) {
        return refused(format!("the last row of matrix is {:?}, it must be [0, 0, 0, 1]", rows[3]));
    }
    for row in &rows[..3] {
        Unit::Length.check_range("a translation of matrix", row[3], written.span())?;
    }
    let turn = Matrix3::from_fn(|row, column| rows[row][column]);
    // Orthonormality comes first: only then the determinant is 1 or -1, and its sign alone shows a reflection.
    let off = (turn.transpose() * turn - Matrix3::identity()).amax();
    if off > ORTHONORMAL {
        return refused(format!(
            "the columns of matrix are not orthonormal: R^T R is off by {off:.1e} (limit {ORTHONORMAL:e})"
        ));
    }
    if turn.determinant() < 0.0 {
        return refused("matrix contains a reflection: the determinant of R is -1".to_owned());
    }
    let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(turn));
    Ok(Isometry3::from_parts(Translation3::new(rows[0][3], rows[1][3], rows[2][3]), rotation))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use nalgebra::Point3;

    use super::*;
    use crate::{diagnostic::Diagnostics, written::toml_text::parse_toml};

    fn read(text: &str) -> Result<Isometry3<f64>, Diagnostic> {
        let mut diagnostics = Diagnostics::default();
        parse_toml::<WrittenTransform>(text, &mut diagnostics).expect(text).isometry()
    }

    /// Rounding of a handful of products of numbers near 1; worst seen 2.3e-16.
    const ROUNDING: f64 = 1e-15;

    #[track_caller]
    fn check(text: &str, from: Point3<f64>, to: Point3<f64>) {
        let found = read(text).unwrap() * from;
        assert!((found - to).norm() < ROUNDING, "{text}: {found} is not {to}");
    }

    #[test]
    fn every_notation_gives_the_same_transform() {
        // Shift by (1, 2, 3) after a quarter turn about z: (1, 0, 0) goes to (1, 3, 3).
        let (from, to) = (Point3::new(1.0, 0.0, 0.0), Point3::new(1.0, 3.0, 3.0));
        check("", from, from);
        check("xyz_m = [1, 2, 3]\nrpy_deg = [0, 0, 90]", from, to);
        check(&format!("xyz_mm = [1000, 2000, 3000]\nrpy_rad = [0, 0, {FRAC_PI_2}]"), from, to);
        check(
            "xyz_m = [1, 2, 3]\nquaternion_wxyz = [0.7071067811865476, 0, 0, 0.7071067811865476]",
            from,
            to,
        );
        check("matrix = [[0, -1, 0, 1], [1, 0, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]]", from, to);
    }

    #[test]
    fn rpy_turns_about_fixed_axes() {
        // x, then y: (0, 1, 0) goes to z by the first turn, to x by the second.
        check("rpy_deg = [90, 90, 0]", Point3::new(0.0, 1.0, 0.0), Point3::new(1.0, 0.0, 0.0));
    }

    #[test]
    fn what_was_written_is_written_again() {
        for text in [
            "",
            "xyz_m = [1.0, 2.0, 3.0]\nrpy_deg = [0.0, 0.0, 90.0]\n",
            "xyz_mm = [1000.0, 2000.0, 3000.0]\nrpy_rad = [0.0, 0.0, 0.1]\n",
            "quaternion_wxyz = [1.0, 0.0, 0.0, 0.0]\n",
            "matrix = [[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 2.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]\n",
        ] {
            let mut diagnostics = Diagnostics::default();
            let written = parse_toml::<WrittenTransform>(text, &mut diagnostics).unwrap();
            assert_eq!(written.to_table().to_string(), text);
            assert_eq!(written.has_rotation(), !text.is_empty());
        }
        let mut diagnostics = Diagnostics::default();
        let place = parse_toml::<WrittenTransform>("xyz_m = [1, 2, 3]", &mut diagnostics).unwrap();
        assert!(!place.has_rotation());
    }

    #[track_caller]
    fn refused(text: &str, message: &str) {
        let error = read(text).expect_err(text);
        assert!(error.message.contains(message), "{}", error.message);
        assert!(error.span.is_some());
    }

    #[track_caller]
    fn unreadable(text: &str, message: &str) {
        let mut diagnostics = Diagnostics::default();
        assert!(parse_toml::<WrittenTransform>(text, &mut diagnostics).is_none(), "{text}");
        let found = diagnostics.into_vec();
        assert!(found[0].message.contains(message), "{}", found[0].message);
        let span = found[0].span.clone().unwrap();
        assert!(text[span.clone()].starts_with('['), "{text}: {span:?}");
    }

    #[test]
    fn an_entry_too_many_is_not_dropped() {
        unreadable("xyz_m = [1, 2, 3, 4]", "expected an array of 3, found 4");
        unreadable("rpy_deg = [1, 2]", "expected an array of 3, found 2");
        unreadable("quaternion_wxyz = [1, 0, 0, 0, 0]", "expected an array of 4, found 5");
        unreadable("matrix = [[1, 0, 0, 0, 9], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]", "of 4, found 5");
        unreadable("matrix = [[1, 0, 0, 0]]", "expected an array of 4, found 1");
    }

    #[test]
    fn faults_are_named() {
        refused("xyz_m = [1, 2, 3]\nxyz_mm = [1, 2, 3]", "xyz_m and xyz_mm are both given");
        refused("rpy_deg = [1, 2, 3]\nquaternion_wxyz = [1, 0, 0, 0]", "rpy and quaternion_wxyz");
        refused("quaternion_wxyz = [0.5, 0.5, 0.5, 0.6]", "norm 1.0535654");
        refused("quaternion_wxyz = [nan, 0, 0, 0]", "NaN");
        refused("xyz_m = [0, 1e200, 0]", "xyz_m is 1.0e200 m, limit <= 1e6 m");
        refused("rpy_rad = [1e308, 0, 0]", "limit <= 1e6 rad");
        refused("matrix = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 1e9], [0, 0, 0, 1]]", "limit <= 1e6 m");
        refused("matrix = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 2, 0], [0, 0, 0, 1]]", "off by 3");
        refused("matrix = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 0], [0, 0, 0, 1]]", "reflection");
        refused("matrix = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 2]]", "last row");
        refused(
            "matrix = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]\nxyz_m = [0, 0, 0]",
            "is given together with",
        );
    }

    /// How far a suggested transform may be from what it stands for. Kind: six values within 5e-14
    /// that move a pose, and a quaternion in between; worst seen 1.8e-13.
    const SUGGESTED: f64 = 5e-13;

    const IDENTITY: &str = "matrix = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]";

    /// Writes a pose as `like` is written and reads it again.
    fn read_again(like: &str, pose: &Isometry3<f64>) -> Isometry3<f64> {
        let mut diagnostics = Diagnostics::default();
        let like = parse_toml::<WrittenTransform>(like, &mut diagnostics).unwrap();
        let keys =
            like.with_keys(pose, [UnitSystem::Si, UnitSystem::Engineering], Slack::default()).join("\n");
        parse_toml::<WrittenTransform>(&keys, &mut diagnostics).expect(&keys).isometry().unwrap()
    }

    #[test]
    fn a_transform_is_read_again_as_it_was_written() {
        let forms =
            ["", "xyz_mm = [1, 2, 3]", "rpy_rad = [0, 0, 0]", "quaternion_wxyz = [1, 0, 0, 0]", IDENTITY];
        // Pitch at, near and away from a quarter turn; a golden angle meets no symmetry.
        let pitches =
            [FRAC_PI_2, -FRAC_PI_2, FRAC_PI_2 - 1e-9, 1e-7 - FRAC_PI_2, FRAC_PI_2 - 1e-13, 0.0, 0.7];
        let mut worst = 0.0_f64;
        for step in 0..200 {
            let golden = f64::from(step) * 2.399_963_229_728_653;
            for pitch in pitches {
                let rotation = rotation_from_rpy_fixed_xyz([golden.sin() * 3.0, pitch, golden.cos() * 3.0]);
                let shift = nalgebra::Vector3::new(golden.sin(), 0.1, -golden.cos());
                let pose = Isometry3::from_parts(shift.into(), rotation);
                for form in forms {
                    let off = (read_again(form, &pose).to_homogeneous() - pose.to_homogeneous()).amax();
                    worst = worst.max(off);
                }
            }
        }
        assert!(worst < SUGGESTED, "{worst:e}");
    }

    #[test]
    fn a_transform_is_written_as_the_file_writes_it() {
        let written = |like: &str, pose: &Isometry3<f64>| {
            let like = parse_toml::<WrittenTransform>(like, &mut Diagnostics::default()).unwrap();
            like.with_keys(pose, [UnitSystem::Engineering; 2], Slack::default()).join(", ")
        };
        let down = Isometry3::from_parts(
            Translation3::new(0.0, 0.0, 0.12),
            rotation_from_rpy_fixed_xyz([0.3, -FRAC_PI_2, 0.2]),
        );
        // If only roll plus yaw counts, there is no yaw.
        let angle = "28.64788975654";
        assert_eq!(written("", &down), format!("xyz_mm = [0, 0, 120], rpy_deg = [{angle}, -90, 0]"));
        assert_eq!(
            written("xyz_m = [0, 0, 0]\nrpy_rad = [0, 0, 0]", &down),
            "xyz_m = [0, 0, 0.12], rpy_rad = [0.5, -1.5707963267949, 0]"
        );
        assert_eq!(written("", &Isometry3::identity()), "");
        assert_eq!(written("rpy_deg = [1, 2, 3]", &Isometry3::identity()), "rpy_deg = [0, 0, 0]");
    }
}
