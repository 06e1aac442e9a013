//! What decides whether two sources agree, in words: a tolerance that somebody has declared, or the digits that are
//! written.

use congruent_description::Tolerance;
use congruent_input::display::{angle, length, length_and_angle};
use congruent_kinematics::PoseError;
use schemars::JsonSchema;
use serde::Serialize;

use super::check_report::{CheckReport, Comparison};
use crate::source_pair::SourcePair;

/// The tolerance that the caller gave; a part that is missing is that of the robot file, or 1e-9 if it declares none.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct RequestedTolerance {
    /// Largest distance of the origins, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position_m: Option<f64>,
    /// Largest angle between the orientations, rad.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orientation_rad: Option<f64>,
}

/// If nobody has declared a tolerance, and table and URDF are typed.
const BY_DIGITS: &str = "judged by the digits written (no tolerance declared)";

impl CheckReport {
    /// What decides whether table and URDF agree: the tolerance if one is declared, otherwise the digits of the two, or
    /// the rounding of computers if nothing was typed.
    pub fn judged_by(&self) -> String {
        if self.tolerance_is_declared {
            return self.tolerance_in_words();
        }
        if self.has_digits() {
            return BY_DIGITS.to_owned();
        }
        "judged by floating-point rounding, since no tolerance is declared".to_owned()
    }

    /// The same of one comparison: two sources that nobody has typed are compared within a tolerance, declared or not.
    pub fn comparison_judged_by(&self, comparison: &Comparison) -> String {
        if comparison.name == SourcePair::ModelUrdf { self.judged_by() } else { self.tolerance_in_words() }
    }

    /// The tolerance, who gave it, and that of the robot file in whose place it is.
    pub fn tolerance_in_words(&self) -> String {
        let Tolerance { position_m, orientation_rad } = self.tolerance;
        let Some(requested) = self.requested_tolerance else {
            return format!("tolerance {}", length_and_angle(position_m, orientation_rad));
        };
        // A part that was not requested is not silently 1e-9.
        let other_part = match self.replaced_tolerance {
            Some(_) => "by the robot file",
            None => "since none is declared",
        };
        match (requested.position_m, requested.orientation_rad) {
            (Some(_), None) => {
                let (length, angle) = (length(position_m), angle(orientation_rad));
                format!("tolerance {length} by --tolerance, and for angles {angle} {other_part}")
            }
            (None, Some(_)) => {
                let (length, angle) = (length(position_m), angle(orientation_rad));
                format!("tolerance {angle} by --tolerance, and for lengths {length} {other_part}")
            }
            _ => {
                let replaced = self.replaced_tolerance.map_or_else(String::new, |declared| {
                    let declared = length_and_angle(declared.position_m, declared.orientation_rad);
                    format!(", the robot file's is {declared}")
                });
                format!(
                    "tolerance {} by --tolerance{replaced}",
                    length_and_angle(position_m, orientation_rad)
                )
            }
        }
    }

    /// Whether the digits of table and URDF decide: nobody has declared a tolerance, and some were typed.
    pub fn has_digits(&self) -> bool {
        let is_typed = self.allowed_by_digits.is_some_and(|allowed| allowed != PoseError::default());
        is_typed && !self.tolerance_is_declared
    }
}
