//! `[[payload]]`: bodies that a link carries for a time.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::scenario::number::{non_negative, optional_array, optional_positive, positive};

/// A body that the tool or a link carries from one time to another. The model knows it: controllers that compute with
/// the model, and checks, take it into account.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PayloadSettings {
    /// Its name in reports.
    pub name: String,
    /// The link that carries it; the TCP if it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub link: Option<String>,
    /// Mass.
    #[serde(deserialize_with = "positive")]
    pub mass_kg: f64,
    /// Centre of mass in the frame of the TCP or of the link; its origin if it is left out.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub com_m: Option<[f64; 3]>,
    /// The same in millimetres.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub com_mm: Option<[f64; 3]>,
    /// Rotational inertia about the centre of mass, in the axes of the TCP or of the link; a point if it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia_kg_m2: Option<PayloadInertia>,
    /// It is carried from this time on.
    #[serde(default, deserialize_with = "non_negative")]
    pub from_s: f64,
    /// It is left at this time; never if it is left out.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}

/// Entries of a rotational inertia.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PayloadInertia {
    /// About x.
    pub xx: f64,
    /// About y.
    pub yy: f64,
    /// About z.
    pub zz: f64,
    /// Product of inertia, with the sign of a tensor's entry.
    #[serde(default)]
    pub xy: f64,
    /// Likewise.
    #[serde(default)]
    pub xz: f64,
    /// Likewise.
    #[serde(default)]
    pub yz: f64,
}
