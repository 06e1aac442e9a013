//! What to estimate, and how.

use crate::estimation::{Loss, Noise};

/// What to estimate, and how.
#[derive(Debug, Clone, PartialEq)]
pub struct CalibrationOptions {
    /// Groups and names of the corrections that are free.
    pub free: Vec<String>,
    /// Groups and names of corrections that are not, whatever `free` says.
    pub hold: Vec<String>,
    /// The robust loss.
    pub loss: Loss,
    /// Smallest admitted ratio of singular values.
    pub threshold: f64,
    /// Noise of the measurement where it is known.
    pub noise: Option<Noise>,
    /// Number of suggested configurations.
    pub suggestions: usize,
    /// Seed of the candidates.
    pub seed: u64,
}

impl Default for CalibrationOptions {
    /// Zero offsets; what moves the tip by less than a thousandth of what the best known correction
    /// does cannot be told from noise.
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
