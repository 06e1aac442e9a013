//! Options of a calibration.

use crate::{
    camera::CameraMount,
    estimation::{Loss, Noise},
};

/// Options of a calibration: free corrections, loss, noise, suggestions.
#[derive(Debug, Clone, PartialEq)]
pub struct CalibrationOptions {
    /// Groups and names of the corrections that are free.
    pub free: Vec<String>,
    /// Groups and names of corrections that are held at nominal even if `free` names them.
    pub hold: Vec<String>,
    /// Where the camera is, if one measured the rows: then `base` and `tool` are the poses of camera and target.
    pub camera: Option<CameraMount>,
    /// The loss of the robust estimate.
    pub loss: Loss,
    /// Smallest singular value of the estimated corrections over the largest of all. No unit.
    pub threshold: f64,
    /// Noise of the measurement, if it is known; otherwise it is estimated from the residuals.
    pub noise: Option<Noise>,
    /// Number of suggested configurations.
    pub suggestions: usize,
    /// Seed of the configurations among which they are chosen.
    pub seed: u64,
}

impl Default for CalibrationOptions {
    /// Zero offsets are free. A correction with less than a thousandth of the effect of the best identified one is fixed, since
    /// it cannot be distinguished from noise.
    fn default() -> Self {
        Self {
            free: vec!["zero-offsets".to_owned()],
            hold: Vec::new(),
            camera: None,
            loss: Loss::Tukey,
            threshold: 1e-3,
            noise: None,
            suggestions: 5,
            seed: 0,
        }
    }
}
