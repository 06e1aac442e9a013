//! `[[payload]]`: bodies that a link carries for a time.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::number::{non_negative, optional_array, optional_positive, positive};

/// A body that the tool or a link carries from one time to another. The model knows it: controllers that compute with
/// the model, and checks, take it into account.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PayloadSettings {
    /// Name in reports and messages.
    pub name: String,
    /// Link that carries the payload; default: the TCP.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub link: Option<String>,
    /// Mass of the payload.
    #[serde(deserialize_with = "positive")]
    pub mass_kg: f64,
    /// Centre of mass in the frame of the TCP or of the link; default: its origin.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub com_m: Option<[f64; 3]>,
    /// The same in millimetres.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub com_mm: Option<[f64; 3]>,
    /// Rotational inertia about the centre of mass, in the axes of the TCP or of the link; default: that of a point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia_kg_m2: Option<PayloadInertia>,
    /// Time from which the payload is carried.
    #[serde(default, deserialize_with = "non_negative")]
    pub from_s: f64,
    /// Time at which the payload is released; default: the end of the run.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}

/// Entries of a rotational inertia.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PayloadInertia {
    /// Moment of inertia about x, kg m^2.
    pub xx: f64,
    /// Moment of inertia about y, kg m^2.
    pub yy: f64,
    /// Moment of inertia about z, kg m^2.
    pub zz: f64,
    /// Entry xy of the inertia tensor, kg m^2: minus the product of inertia.
    #[serde(default)]
    pub xy: f64,
    /// Entry xz of the inertia tensor, kg m^2.
    #[serde(default)]
    pub xz: f64,
    /// Entry yz of the inertia tensor, kg m^2.
    #[serde(default)]
    pub yz: f64,
}
