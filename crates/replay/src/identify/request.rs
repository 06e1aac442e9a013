//! What a person wants to be identified.

use std::collections::BTreeMap;

use congruent_identification::{EffortKind, FreeGroup};
use nalgebra::Vector3;

use crate::request::ReplayRequest;

/// What is identified, and what is known of the log.
#[derive(Debug, Clone, Default)]
pub struct IdentifyRequest {
    /// What is known of the log.
    pub log: ReplayRequest,
    /// What is estimated.
    pub free: Vec<FreeGroup>,
    /// The link that carries the payload; the TCP if it is not named.
    pub payload_at: Option<String>,
    /// What the efforts are; recognised if nobody says.
    pub effort: Option<EffortKind>,
    /// Torque for a unit of effort, by joint.
    pub torque_constants: BTreeMap<String, f64>,
    /// Whether instants at rest are taken, at which gravity acts alone.
    pub is_still: bool,
    /// Half of the window that smooths, s; chosen by the noise of the positions if nobody says.
    pub half_window_s: Option<f64>,
    /// Gravity in the root link, m/s^2; if it is not given, along minus z.
    pub gravity_m_s2: Option<Vector3<f64>>,
}
