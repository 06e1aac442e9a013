//! How much one varied value decides.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How much of the variance of a quantity follows from one varied value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct KeyImportance {
    /// The key.
    pub key: String,
    /// Share of the variance that follows from this value alone: the first-order sensitivity index. Near 0 it may be negative,
    /// which is chance.
    pub share: f64,
    /// Its interval of 95 % confidence.
    pub interval: [f64; 2],
    /// Rank correlation of value and quantity, from -1 to 1: whether more makes it larger. 0 for words.
    pub rank_correlation: f64,
}

impl KeyImportance {
    /// `more makes it larger`, if more of the value makes the quantity larger or smaller.
    pub fn direction(&self) -> Option<&'static str> {
        /// From here on more and less are seen in a plot. Kind: choice.
        const CLEAR: f64 = 0.3;
        let correlation = self.rank_correlation;
        // What decides much, and is correlated little, makes it larger to both sides.
        let is_to_one_side = correlation.abs() > CLEAR && correlation.powi(2) > 0.5 * self.share;
        let words = if correlation > 0.0 { "more makes it larger" } else { "more makes it smaller" };
        is_to_one_side.then_some(words)
    }

    /// The share in whole per cent.
    pub fn percent(&self) -> String {
        format!("{:.0} %", 100.0 * self.share)
    }
}
