//! What to estimate, and how.

use crate::estimation::{Loss, Noise};

/// What to estimate, and how.
#[derive(Debug, Clone, PartialEq)]
pub struct CalibrationOptions {
    /// Groups and names of the corrections that are free.
    pub free: Vec<String>,
    /// Groups and names of corrections that are held at nominal even if `free` names them.
    pub hold: Vec<String>,
    /// The robust loss.
    pub loss: Loss,
    /// Smallest admitted ratio of singular values.
    pub threshold: f64,
    /// Noise of the measurement, if it is known.
    pub noise: Option<Noise>,
    /// Number of suggested configurations.
    pub suggestions: usize,
    /// Seed of the configurations among which they are chosen.
    pub seed: u64,
}

impl Default for CalibrationOptions {
    /// Zero offsets; a correction with less than a thousandth of the effect of the best identified one cannot
    /// be distinguished from noise.
    fn default() -> Self {
        Self {
            free: vec!["zero-offsets".to_owned()],
            hold: Vec::new(),
            loss: Loss::Tukey,
            threshold: 1e-3,
            noise: None,
            suggestions: 5,
            seed: 0,
        }
    }
}
