//! A pose as a scenario writes it: translation and one of three kinds of rotation, or a whole matrix.

use congruent_input::{Diagnostic, WrittenTransform};
use nalgebra::Isometry3;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize, de::Error};
use toml::Spanned;

use super::{number::optional_array, place::FilePlace};
use crate::codes;

/// A pose; identity if nothing is given.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PoseSettings {
    /// Translation of the pose, in metres.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub xyz_m: Option<[f64; 3]>,
    /// Translation of the pose, in millimetres.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub xyz_mm: Option<[f64; 3]>,
    /// Rotations about the fixed axes x, then y, then z, in radians.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub rpy_rad: Option<[f64; 3]>,
    /// Rotations about the fixed axes x, then y, then z, in degrees.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub rpy_deg: Option<[f64; 3]>,
    /// Unit quaternion, scalar first.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub quaternion_wxyz: Option<[f64; 4]>,
    /// Homogeneous matrix by rows, in metres; excludes all other keys.
    #[serde(default, deserialize_with = "matrix", skip_serializing_if = "Option::is_none")]
    pub matrix: Option<[[f64; 4]; 4]>,
}

fn matrix<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<[[f64; 4]; 4]>, D::Error> {
    let rows = Vec::<Vec<f64>>::deserialize(deserializer)?;
    let wrong = |_| D::Error::custom("expected 4 rows of 4 entries");
    let rows: Vec<[f64; 4]> =
        rows.into_iter().map(|row| row.try_into().map_err(wrong)).collect::<Result<_, _>>()?;
    rows.try_into().map(Some).map_err(|_| D::Error::custom("expected 4 rows of 4 entries"))
}

impl PoseSettings {
    /// Whether a rotation is given, the identity included.
    pub fn has_rotation(&self) -> bool {
        self.rpy_rad.is_some()
            || self.rpy_deg.is_some()
            || self.quaternion_wxyz.is_some()
            || self.matrix.is_some()
    }

    /// Whether a position is given.
    fn has_position(&self) -> bool {
        self.xyz_m.is_some() || self.xyz_mm.is_some() || self.matrix.is_some()
    }

    /// The pose of a target of the tool. A missing position is an error: it does not mean the origin of the world.
    ///
    /// # Errors
    /// It has no position, or as [`PoseSettings::isometry`].
    pub fn target(&self, place: FilePlace<'_>) -> Result<Isometry3<f64>, Diagnostic> {
        if self.has_position() {
            return self.isometry(place);
        }
        let message = "the target has no position: `xyz_m` (or `xyz_mm`) is missing";
        let help = "give the position of the tool centre point in the world; for a pure rotation, its present position";
        Err(place.mark(Diagnostic::error(codes::scenario::TARGET_POSITION, message).with_help(help)))
    }

    /// The pose; `place` is its place in the file.
    ///
    /// # Errors
    /// Two keys for one thing, a value that is not finite, a quaternion whose norm is not 1, or a matrix that
    /// is no rigid motion.
    pub fn isometry(&self, place: FilePlace<'_>) -> Result<Isometry3<f64>, Diagnostic> {
        let written = WrittenTransform {
            xyz_m: spanned(self.xyz_m, place.key("xyz_m")),
            xyz_mm: spanned(self.xyz_mm, place.key("xyz_mm")),
            rpy_rad: spanned(self.rpy_rad, place.key("rpy_rad")),
            rpy_deg: spanned(self.rpy_deg, place.key("rpy_deg")),
            quaternion_wxyz: spanned(self.quaternion_wxyz, place.key("quaternion_wxyz")),
            matrix: spanned(self.matrix, place.key("matrix")),
        };
        written.isometry().map_err(|error| match place.span() {
            Some(span) if error.span.is_none() => error.at(span),
            Some(_) => error,
            // For a pose made in code, the places of the wrapper have no meaning.
            None => Diagnostic { span: None, ..error },
        })
    }
}

fn spanned<T>(value: Option<T>, place: FilePlace<'_>) -> Option<Spanned<T>> {
    value.map(|value| Spanned::new(place.span().unwrap_or(0..0), value))
}
