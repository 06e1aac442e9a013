//! How much alike two descriptions are: to rounding, within the digits that they are typed with, or not.

use congruent_description::Tolerance;
use congruent_kinematics::PoseError;
use schemars::JsonSchema;
use serde::Serialize;

/// How much alike the sources are, whatever the tolerance is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Grade {
    /// To the rounding of an `f64`: within 1e-9 m and 1e-9 rad.
    Identical,
    /// There are values within half of the last place of the typed ones with which the two files are identical.
    SameWithinDigits,
    /// Identical once joints have the names, directions and zeros of the other description, which nothing declares.
    EqualAfterMapping,
    /// No rounding of what is typed explains the difference.
    Different,
}

impl Grade {
    /// The grade of two files in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Identical => "identical",
            Self::SameWithinDigits => "same within the digits written",
            Self::EqualAfterMapping => "equal after mapping",
            Self::Different => "different beyond the digits written",
        }
    }

    /// The grade of sources without digits of their own, by their largest difference: identical or not.
    pub(super) fn from_difference(worst: &PoseError) -> Self {
        if worst.is_within(&Tolerance::default()) { Self::Identical } else { Self::Different }
    }
}
