//! Whether a diagnosis has found the faults that a scenario has injected.

use congruent_input::{Quantity, SiUnit};
use std::f64::consts::TAU;

use congruent_scenario::{FaultKind, FaultQuantity, RunFault};
use schemars::JsonSchema;
use serde::Serialize;

/// How far a found value may be from the true one, as a part of the largest value of the fault in the same unit.
const OFF_BY_PART: f64 = 0.05;

/// A value this near is the same, in its unit: rounding, where the fault has no value of this unit but zero.
const SAME: f64 = 1e-9;

/// How far the share of lost readings may be from the probability of a loss: three standard deviations of 1400 readings, of
/// which every second is lost.
const SHARE_OFF_BY: f64 = 0.04;

/// Agreement of a diagnosis with the injected faults.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FaultVerdict {
    /// Every fault is found with kind, joint or link, and values within 5 % (or 1e-9), and no other fault. Coordinates that are
    /// not identifiable from the motion are not compared.
    Right,
    /// Kind and joint or link are found; a value is farther away.
    OtherValue,
    /// Another fault is found, or one too many or too few.
    Wrong,
    /// No fault is found although one is injected.
    Nothing,
}

/// Compares what was found with what was injected.
pub fn judge(injected: &[RunFault], found: &[RunFault]) -> FaultVerdict {
    if found.is_empty() {
        return if injected.is_empty() { FaultVerdict::Right } else { FaultVerdict::Nothing };
    }
    let partner = |fault: &RunFault| found.iter().find(|found| is_about_the_same(fault, found));
    let pairs: Option<Vec<_>> =
        injected.iter().map(|fault| partner(fault).map(|found| (fault, found))).collect();
    // As many pairs as findings: a finding without a partner is a fault too many.
    match pairs.filter(|pairs| pairs.len() == found.len()) {
        None => FaultVerdict::Wrong,
        Some(pairs) if pairs.iter().all(|(fault, found)| values_are_near(fault, found)) => {
            FaultVerdict::Right
        }
        Some(_) => FaultVerdict::OtherValue,
    }
}

fn is_about_the_same(a: &RunFault, b: &RunFault) -> bool {
    let joints = a.joints.len() == b.joints.len() && a.joints.iter().all(|joint| b.joints.contains(joint));
    a.kind == b.kind && joints && a.link == b.link
}

fn values_are_near(injected: &RunFault, found: &RunFault) -> bool {
    // A value that is not named is zero: `y` of a mass on the x axis.
    let value = |fault: &RunFault, quantity: Quantity| {
        fault.values.iter().find(|value| value.quantity == quantity).map_or(0.0, |value| value.value)
    };
    let is_found = |quantity: Quantity| found.values.iter().any(|value| value.quantity == quantity);
    let near = |known: &FaultQuantity| {
        let of_unit = injected.values.iter().filter(|value| value.unit == known.unit);
        // By the largest value of the unit: a coordinate near zero has no relative error.
        let scale = of_unit.map(|value| value.value.abs()).fold(known.value.abs(), f64::max);
        let allowed =
            if injected.kind == FaultKind::DroppedSamples { SHARE_OFF_BY } else { OFF_BY_PART * scale };
        let difference = (value(injected, known.quantity) - value(found, known.quantity)).abs();
        // A turn by 180 deg is one by -180 deg.
        let is_turn = injected.kind == FaultKind::ShiftedTool && known.unit == SiUnit::Radian;
        let difference = if is_turn { difference.min((TAU - difference).abs()) } else { difference };
        difference <= allowed.max(SAME)
            || (injected.kind == FaultKind::WrongPayload && !is_found(known.quantity))
    };
    injected.values.iter().chain(&found.values).all(near)
}

#[cfg(test)]
mod tests {
    use nalgebra::{Isometry3, Vector3};

    use super::*;

    #[test]
    fn rounding_and_whole_turns_are_no_other_value() {
        let turned = |x, yaw| {
            let shift = Isometry3::new(Vector3::new(x, 0.0, 0.0), Vector3::new(0.0, 0.0, yaw));
            vec![RunFault {
                kind: FaultKind::ShiftedTool,
                joints: Vec::new(),
                link: Some("tool0".to_owned()),
                values: FaultQuantity::shift(&shift),
                from_s: 0.0,
                until_s: None,
            }]
        };
        let half = std::f64::consts::PI;
        assert_eq!(judge(&turned(0.0, 1.5), &turned(1e-15, 1.5)), FaultVerdict::Right);
        assert_eq!(judge(&turned(0.0, 1.5), &turned(1e-6, 1.5)), FaultVerdict::OtherValue);
        assert_eq!(judge(&turned(0.0, half), &turned(0.0, 1e-9 - half)), FaultVerdict::Right);
        assert_eq!(judge(&turned(0.0, half), &turned(0.0, -1.0)), FaultVerdict::OtherValue);
    }
}
