//! A robot file as it is written: keys and units, nothing checked.

use std::{collections::BTreeMap, path::PathBuf};

use serde::Deserialize;
use toml::Spanned;

use crate::{
    model::{DhConvention, DhRowKind},
    written::transform::WrittenTransform,
};

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct WrittenRobot {
    pub(crate) name: Option<Spanned<String>>,
    pub(crate) urdf: Option<Spanned<PathBuf>>,
    pub(crate) srdf: Option<Spanned<PathBuf>>,
    pub(crate) base: Option<Spanned<String>>,
    pub(crate) tip: Option<Spanned<String>>,
    #[serde(default)]
    pub(crate) packages: BTreeMap<String, Spanned<PathBuf>>,
    pub(crate) dh: Option<Spanned<WrittenDh>>,
    pub(crate) tcp: Option<Spanned<WrittenTransform>>,
    pub(crate) tolerance: Option<WrittenTolerance>,
}

#[derive(Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct WrittenDh {
    /// Optional, so that a missing one gets a message of its own.
    pub(crate) convention: Option<Spanned<DhConvention>>,
    pub(crate) source: Option<String>,
    pub(crate) base_from_dh0: Option<Spanned<WrittenTransform>>,
    pub(crate) dhn_from_tip: Option<Spanned<WrittenTransform>>,
    #[serde(default)]
    pub(crate) row: Vec<Spanned<WrittenRow>>,
}

#[derive(Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct WrittenRow {
    pub(crate) joint: Spanned<String>,
    pub(crate) kind: Spanned<DhRowKind>,
    pub(crate) a_m: Option<Spanned<f64>>,
    pub(crate) a_mm: Option<Spanned<f64>>,
    pub(crate) alpha_rad: Option<Spanned<f64>>,
    pub(crate) alpha_deg: Option<Spanned<f64>>,
    pub(crate) d_m: Option<Spanned<f64>>,
    pub(crate) d_mm: Option<Spanned<f64>>,
    pub(crate) theta_rad: Option<Spanned<f64>>,
    pub(crate) theta_deg: Option<Spanned<f64>>,
    pub(crate) sign: Option<Spanned<f64>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct WrittenTolerance {
    pub(crate) position_m: Option<Spanned<f64>>,
    pub(crate) position_mm: Option<Spanned<f64>>,
    pub(crate) orientation_rad: Option<Spanned<f64>>,
    pub(crate) orientation_deg: Option<Spanned<f64>>,
}
