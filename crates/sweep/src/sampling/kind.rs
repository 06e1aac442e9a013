//! How the values of the cases are chosen.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How the values of the cases are chosen.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CaseSampling {
    /// Every combination of the values; ranges have `steps`.
    Grid,
    /// Each case draws by itself.
    Random,
    /// Each of as many equal parts of a distribution as there are cases has one case.
    #[default]
    LatinHypercube,
    /// Scrambled Sobol points: each further case fills a gap. Up to 40 keys.
    Sobol,
}
