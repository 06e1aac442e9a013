//! `[dynamics]` and `[[inertial]]` of a robot file as they are written. The doc comments become the descriptions of the JSON
//! schema.

use congruent_input::fixed_array;
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use super::declared::InertialPoint;

/// The values that hold for all bodies.
#[derive(Debug, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Dynamics")]
pub(crate) struct WrittenDynamics {
    /// The publication that the values are from.
    #[serde(default)]
    #[schemars(with = "String")]
    pub(crate) source: Option<String>,
    /// Gravity in the base link in m/s^2; if it is left out it is not compared.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "[f64; 3]")]
    pub(crate) gravity_m_s2: Option<Spanned<[f64; 3]>>,
}

/// Mass, centre of mass and inertia of the body that a joint carries: its link and all links that are fixed to it. Parameters
/// that are left out are not compared.
#[derive(Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Inertial")]
pub(crate) struct WrittenInertial {
    /// Name of the joint in the URDF.
    #[schemars(with = "String")]
    pub(crate) joint: Spanned<String>,
    // Optional, so that missing ones get a message of their own.
    /// The frame of centre of mass and inertia: `link`, or the frame `dhN` of the joint's row in the table.
    #[schemars(with = "String")]
    pub(crate) frame: Option<Spanned<String>>,
    /// The point that the inertia is about: the centre of mass, or the origin of the frame.
    #[schemars(with = "InertialPoint")]
    pub(crate) about: Option<Spanned<InertialPoint>>,
    /// Mass of the body in kg.
    #[schemars(with = "f64")]
    pub(crate) mass_kg: Spanned<f64>,
    /// Centre of mass in metres; it is not compared if this key and `com_mm` are left out.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "[f64; 3]")]
    pub(crate) com_m: Option<Spanned<[f64; 3]>>,
    /// Centre of mass in millimetres.
    #[serde(default, deserialize_with = "fixed_array")]
    #[schemars(with = "[f64; 3]")]
    pub(crate) com_mm: Option<Spanned<[f64; 3]>>,
    /// Rotational inertia in kg m^2, in the axes of the frame.
    #[serde(default)]
    #[schemars(with = "WrittenTensor")]
    pub(crate) inertia_kg_m2: Option<Spanned<WrittenTensor>>,
    /// Inertia of the motor behind its gear in kg m^2, of a joint that turns.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub(crate) armature_kg_m2: Option<Spanned<f64>>,
    /// Inertia of the motor behind its gear in kg, of a joint that slides.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub(crate) armature_kg: Option<Spanned<f64>>,
    /// Damping in N m s/rad, of a joint that turns.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub(crate) damping_n_m_s_rad: Option<Spanned<f64>>,
    /// Damping in N s/m, of a joint that slides.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub(crate) damping_n_s_m: Option<Spanned<f64>>,
    /// Dry friction in N m, of a joint that turns.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub(crate) friction_n_m: Option<Spanned<f64>>,
    /// Dry friction in N, of a joint that slides.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub(crate) friction_n: Option<Spanned<f64>>,
}

/// The six entries of a symmetric tensor by name, so that no order can be wrong.
#[derive(Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Tensor")]
pub(crate) struct WrittenTensor {
    /// Moment of inertia about x, kg m^2.
    #[schemars(with = "f64")]
    pub(crate) xx: Spanned<f64>,
    /// Moment of inertia about y, kg m^2.
    #[schemars(with = "f64")]
    pub(crate) yy: Spanned<f64>,
    /// Moment of inertia about z, kg m^2.
    #[schemars(with = "f64")]
    pub(crate) zz: Spanned<f64>,
    /// Entry of the tensor, minus the integral of x y.
    #[schemars(with = "f64")]
    pub(crate) xy: Spanned<f64>,
    /// Entry of the tensor, minus the integral of x z.
    #[schemars(with = "f64")]
    pub(crate) xz: Spanned<f64>,
    /// Entry of the tensor, minus the integral of y z.
    #[schemars(with = "f64")]
    pub(crate) yz: Spanned<f64>,
}

impl WrittenTensor {
    /// The entries by row and column.
    pub(crate) fn entries(&self) -> [(&'static str, (usize, usize), &Spanned<f64>); 6] {
        [
            ("xx", (0, 0), &self.xx),
            ("xy", (0, 1), &self.xy),
            ("xz", (0, 2), &self.xz),
            ("yy", (1, 1), &self.yy),
            ("yz", (1, 2), &self.yz),
            ("zz", (2, 2), &self.zz),
        ]
    }
}

/// A term of the joint dynamics in addition to the inertia of the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum WrittenTerm {
    Armature,
    Damping,
    Friction,
}

impl WrittenInertial {
    /// A term under its two keys: of a joint that turns, then of one that slides.
    pub(crate) fn term(&self, term: WrittenTerm) -> [(&'static str, Option<&Spanned<f64>>); 2] {
        match term {
            WrittenTerm::Armature => {
                [("armature_kg_m2", self.armature_kg_m2.as_ref()), ("armature_kg", self.armature_kg.as_ref())]
            }
            WrittenTerm::Damping => [
                ("damping_n_m_s_rad", self.damping_n_m_s_rad.as_ref()),
                ("damping_n_s_m", self.damping_n_s_m.as_ref()),
            ],
            WrittenTerm::Friction => {
                [("friction_n_m", self.friction_n_m.as_ref()), ("friction_n", self.friction_n.as_ref())]
            }
        }
    }
}
