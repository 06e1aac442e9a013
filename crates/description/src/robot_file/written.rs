//! A robot file as it is written: keys and units, unchecked. The doc comments become the descriptions of the robot file's
//! JSON schema, so they address people who write robot files.

use std::{collections::BTreeMap, ops::Range, path::PathBuf, sync::Arc};

use congruent_input::{Diagnostic, SourceFile, WrittenTransform, fixed_array, units::WrittenUnit};
use congruent_robot::{DhConvention, DhRowKind, WrittenTolerances};
use schemars::{JsonSchema, Schema, schema_for};
use serde::Deserialize;
use toml::Spanned;

use super::{
    inertials::{WrittenDynamics, WrittenInertial},
    limits::WrittenLimits,
    mapping::{WrittenMapping, WrittenReference},
    poe::WrittenPoe,
    range::WrittenRange,
};
use crate::{WrittenLint, tolerance_scale::ToleranceScale, urdf::Repairs};

/// The JSON schema of robot files.
pub fn robot_file_schema() -> Schema {
    schema_for!(WrittenRobot)
}

/// A robot: its URDF, the chain from base to tip, and the analytical model of that chain. Without a URDF the table or the screws
/// are the robot.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
// Either key names the robot, or the file is one by itself. `parse_robot` takes a robot file without any of them.
#[schemars(title = "Robot file", extend("oneOf" = [
    { "required": ["urdf"], "not": { "required": ["poe"] } },
    { "required": ["description"], "not": { "required": ["poe"] } },
    { "required": ["dh"], "not": { "anyOf": [{ "required": ["urdf"] }, { "required": ["description"] }, { "required": ["poe"] }] } },
    { "required": ["poe"], "not": { "anyOf": [{ "required": ["urdf"] }, { "required": ["description"] }, { "required": ["dh"] }] } },
]))]
pub struct WrittenRobot {
    /// Name in reports; the URDF's name by default, or the name of this file if there is none.
    #[serde(default)]
    #[schemars(with = "String")]
    pub(crate) name: Option<Spanned<String>>,
    /// The URDF or MJCF, relative to this file.
    #[serde(default)]
    #[schemars(with = "String")]
    pub(crate) urdf: Option<Spanned<PathBuf>>,
    /// The same, under another name: a robot file has either this key or `urdf`.
    #[serde(default)]
    #[schemars(with = "String")]
    pub(crate) description: Option<Spanned<PathBuf>>,
    /// The SRDF that disables collisions, relative to this file.
    #[serde(default)]
    #[schemars(with = "String")]
    pub(crate) srdf: Option<Spanned<PathBuf>>,
    /// First link of the chain; the root by default. Without a URDF the link is given this name, `base` by default.
    #[serde(default)]
    #[schemars(with = "String")]
    pub(crate) base: Option<Spanned<String>>,
    /// Last link of the chain; by default the frame for tools at the end of the longest chain, before a gripper.
    /// Without a URDF the link is given this name, `tip` by default.
    #[serde(default)]
    #[schemars(with = "String")]
    pub(crate) tip: Option<Spanned<String>>,
    /// Folders of `package://NAME` in mesh addresses, relative to this file.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, String>")]
    pub(crate) packages: BTreeMap<String, Spanned<PathBuf>>,
    /// Correction of a link's inertia that no rigid body can have: LINK = "repair".
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, WrittenInertia>")]
    pub(crate) inertia: BTreeMap<String, Spanned<WrittenInertia>>,
    /// The Denavit-Hartenberg table; without one the URDF is compared with the physics alone. Without a URDF the table is the robot.
    #[serde(default)]
    #[schemars(with = "WrittenDh")]
    pub(crate) dh: Option<Spanned<WrittenDh>>,
    /// The screws of the chain, which are the robot: in the place of a URDF and of a table.
    #[serde(default)]
    #[schemars(with = "WrittenPoe")]
    pub(crate) poe: Option<Spanned<WrittenPoe>>,
    /// A second description of the dynamics, such as a vendor's: the values that hold for all bodies.
    #[serde(default)]
    #[schemars(with = "WrittenDynamics")]
    pub(crate) dynamics: Option<WrittenDynamics>,
    /// A second description of the dynamics: one entry for each body, which is compared with the URDF.
    #[serde(default)]
    #[schemars(with = "Vec<WrittenInertial>")]
    pub(crate) inertial: Vec<Spanned<WrittenInertial>>,
    /// Limits that a URDF does not state.
    #[serde(default)]
    #[schemars(with = "WrittenLimits")]
    pub(crate) limits: Option<WrittenLimits>,
    /// The tool centre point in the frame of the tip.
    #[serde(default)]
    #[schemars(with = "WrittenTransform")]
    pub(crate) tcp: Option<Spanned<WrittenTransform>>,
    /// How far model and twin may differ. If it is left out, a table is the same within the digits that are written; everything else within
    /// 1e-9 m and 1e-9 rad.
    #[serde(default)]
    #[schemars(with = "WrittenTolerance")]
    pub(crate) tolerance: Option<WrittenTolerance>,
    /// By how much each parameter may be off, for `congruent tolerances`.
    #[serde(default)]
    #[schemars(with = "WrittenTolerances")]
    pub(crate) tolerances: Option<WrittenTolerances>,
    /// How joints are called and counted in the description that `check --against` names.
    #[serde(default)]
    #[schemars(with = "WrittenMapping")]
    pub(crate) mapping: Option<WrittenMapping>,
    /// Other descriptions of this robot, with which `check` compares it.
    #[serde(default)]
    pub(crate) reference: Vec<WrittenReference>,
    // `Ignores` reads them on its own, also from a robot file with errors.
    /// Warnings that `lint` does not report.
    #[serde(default, rename = "lint")]
    #[schemars(with = "WrittenLint")]
    pub(crate) _lint: Option<WrittenLint>,
}

impl WrittenRobot {
    /// Byte range of the first value of the tolerance; `None` if there is none.
    pub(crate) fn tolerance_span(&self) -> Option<Range<usize>> {
        self.tolerance.as_ref()?.span()
    }

    /// The URDF or MJCF of the robot, and the key that names it.
    pub(crate) fn model(&self) -> Option<(&'static str, &Spanned<PathBuf>)> {
        let keys = [("urdf", &self.urdf), ("description", &self.description)];
        keys.into_iter().find_map(|(key, path)| Some((key, path.as_ref()?)))
    }

    /// The links whose inertia is to be repaired.
    pub(crate) fn repairs(&self, source: &Arc<SourceFile>) -> Repairs {
        let links = self.inertia.iter().map(|(link, choice)| match choice.get_ref() {
            WrittenInertia::Repair => (link.clone(), choice.span()),
        });
        Repairs { links: links.collect(), source: Some(Arc::clone(source)) }
    }
}

/// Correction of an inertia that no rigid body can have.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "InertiaChoice")]
pub(crate) enum WrittenInertia {
    /// Replaced by the nearest inertia that a rigid body can have: same mass, same principal axes.
    Repair,
}

/// A Denavit-Hartenberg table of the chain from base to tip.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "DhTable")]
pub(crate) struct WrittenDh {
    // Optional, so that a missing one gets a message of its own.
    /// The order of the four motions of a row: the same table in the other convention is another robot.
    #[schemars(with = "DhConvention")]
    pub(crate) convention: Option<Spanned<DhConvention>>,
    /// The publication that the values are from.
    #[serde(default)]
    #[schemars(with = "String")]
    pub(crate) source: Option<String>,
    /// The pose of the table's frame 0 in the base link; identity by default.
    #[serde(default)]
    #[schemars(with = "WrittenTransform")]
    pub(crate) base_from_dh0: Option<Spanned<WrittenTransform>>,
    /// The pose of the tip in the table's last frame; identity by default.
    #[serde(default)]
    #[schemars(with = "WrittenTransform")]
    pub(crate) dhn_from_tip: Option<Spanned<WrittenTransform>>,
    /// One row for each movable joint of the chain, from base to tip.
    #[serde(default)]
    #[schemars(with = "Vec<WrittenRow>")]
    pub(crate) row: Vec<Spanned<WrittenRow>>,
}

/// A row of the table. Each quantity has one of its two keys: SI units or engineering units.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "DhRow")]
pub(crate) struct WrittenRow {
    /// Name of the joint in the URDF; without a URDF the joint is given this name.
    #[schemars(with = "String")]
    pub(crate) joint: Spanned<String>,
    /// Whether the joint's position is added to theta or to d.
    #[schemars(with = "DhRowKind")]
    pub(crate) kind: Spanned<DhRowKind>,
    /// Link length a in metres.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub(crate) a_m: Option<Spanned<f64>>,
    /// Link length a in millimetres.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub(crate) a_mm: Option<Spanned<f64>>,
    /// Link twist alpha in radians.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub(crate) alpha_rad: Option<Spanned<f64>>,
    /// Link twist alpha in degrees.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub(crate) alpha_deg: Option<Spanned<f64>>,
    /// Link offset d in metres; of a prismatic row, d at position 0.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub(crate) d_m: Option<Spanned<f64>>,
    /// Link offset d in millimetres; of a prismatic row, d at position 0.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub(crate) d_mm: Option<Spanned<f64>>,
    /// Joint angle theta in radians; of a revolute row, theta at position 0. 0 by default.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub(crate) theta_rad: Option<Spanned<f64>>,
    /// Joint angle theta in degrees; of a revolute row, theta at position 0. 0 by default.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub(crate) theta_deg: Option<Spanned<f64>>,
    /// 1 or -1: the sign of the URDF's joint position in the row. 1 by default.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub(crate) sign: Option<Spanned<f64>>,
    /// Lowest and highest position in radians, of a joint that turns, in a file without a URDF; without it the joint turns freely.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "[f64; 2]")]
    pub(crate) range_rad: Option<Spanned<[f64; 2]>>,
    /// Lowest and highest position in degrees, of a joint that turns, in a file without a URDF.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "[f64; 2]")]
    pub(crate) range_deg: Option<Spanned<[f64; 2]>>,
    /// Lowest and highest position in metres, of a joint that slides, in a file without a URDF.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "[f64; 2]")]
    pub(crate) range_m: Option<Spanned<[f64; 2]>>,
    /// Lowest and highest position in millimetres, of a joint that slides, in a file without a URDF.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "[f64; 2]")]
    pub(crate) range_mm: Option<Spanned<[f64; 2]>>,
}

impl WrittenRow {
    /// The range of the joint as it is written.
    pub(crate) fn range(&self) -> WrittenRange<'_> {
        let Self { range_rad, range_deg, range_m, range_mm, .. } = self;
        let [rad, deg, m, mm] = [range_rad, range_deg, range_m, range_mm].map(Option::as_ref);
        WrittenRange { rad, deg, m, mm }
    }
}

/// How far two poses may be apart and still agree. If only a length or only an angle is given, `check` judges the other by the digits
/// that are written.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "FileTolerance")]
pub(crate) struct WrittenTolerance {
    /// Distance of the origins in metres.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub(crate) position_m: Option<Spanned<f64>>,
    /// Distance of the origins in millimetres.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub(crate) position_mm: Option<Spanned<f64>>,
    /// Angle between the orientations in radians.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub(crate) orientation_rad: Option<Spanned<f64>>,
    /// Angle between the orientations in degrees.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub(crate) orientation_deg: Option<Spanned<f64>>,
}

impl WrittenTolerance {
    /// Byte range of its first value; `None` if it has none.
    fn span(&self) -> Option<Range<usize>> {
        let values = [&self.position_m, &self.position_mm, &self.orientation_rad, &self.orientation_deg];
        values.into_iter().flatten().map(Spanned::span).min_by_key(|span| span.start)
    }

    /// The findings about tolerances that are too wide for a robot of this scale, each at its value.
    pub(crate) fn examine(&self, scale: ToleranceScale) -> Vec<Diagnostic> {
        let written = [
            ("position_m", &self.position_m),
            ("position_mm", &self.position_mm),
            ("orientation_rad", &self.orientation_rad),
            ("orientation_deg", &self.orientation_deg),
        ];
        let examined = written.into_iter().filter_map(|(key, value)| {
            let (unit, written) = (WrittenUnit::of_key(key), value.as_ref()?);
            Some(scale.examine(unit.unit, key, unit.to_si(*written.get_ref()))?.at(written.span()))
        });
        examined.collect()
    }
}
