//! The values that the files of two models are typed with, and what all of them together allow.

use congruent_description::ChainQ;
use congruent_kinematics::{Pose, PoseError};

use super::typed_value::{NO_EFFECT, TypedValue};
use crate::diagnosis::{candidate::DhEntry, hypothesis::ModelPair, thresholds::SAME_VALUE};

/// The weights are those of the models as given; with a gross cause corrected, the same digits have other effects, at
/// most so many times as large. No unit; kind: judgement.
const OTHER_EFFECTS: f64 = 10.0;

/// The values that the files of both models are typed with; none for a black box, or a file that a program has
/// written with all digits.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct WrittenDigits {
    /// The values that may be off.
    pub values: Vec<TypedValue>,
    /// The largest difference of the tips that they allow, to first order: the sum over all values of what half of the
    /// last place of each moves the tip.
    pub allowed: PoseError,
}

impl WrittenDigits {
    /// The digits of these values, which allow at most the sum of their effects at these configurations.
    pub fn new(values: Vec<TypedValue>, models: &ModelPair, configurations: &[ChainQ]) -> Self {
        let values: Vec<TypedValue> =
            values.into_iter().filter(|value| value.half_place > NO_EFFECT).collect();
        let tips = |models: &ModelPair, value: &TypedValue| -> Vec<Pose> {
            let tip = |q| {
                if value.is_in_reference() {
                    models.reference.base_from_tip(q)
                } else {
                    models.candidate.base_from_tip(q)
                }
            };
            configurations.iter().map(tip).collect()
        };
        let mut allowed = vec![PoseError::default(); configurations.len()];
        for value in &values {
            let mut shifted = models.clone();
            value.shift(&mut shifted, value.half_place);
            let moved = tips(models, value).into_iter().zip(tips(&shifted, value));
            for (allowed, (before, after)) in allowed.iter_mut().zip(moved) {
                let moved = PoseError::between(&before, &after);
                allowed.position_m += moved.position_m;
                allowed.orientation_rad += moved.orientation_rad;
            }
        }
        Self { allowed: allowed.into_iter().fold(PoseError::default(), PoseError::larger), values }
    }

    /// The coarsest half place of all angles, or of all lengths, as the entry is one: the precision of the files.
    pub(crate) fn coarsest_half_place(&self, entry: DhEntry) -> f64 {
        let of_kind = self.values.iter().filter(|value| value.is_angle() == entry.is_angle());
        of_kind.map(|value| value.half_place).fold(0.0, f64::max)
    }

    /// The largest norm of a weighted difference that the digits may explain. Each value within its half place adds at
    /// most the smallest weight that counts, and their squares are summed.
    pub(in crate::diagnosis) fn most_norm(&self) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "files have few values")]
        let values = self.values.len() as f64;
        OTHER_EFFECTS * SAME_VALUE * values.sqrt()
    }
}
