//! The values that the files of two models are typed with, and what all of them together allow.

use congruent_description::{ChainQ, Tolerance};
use congruent_kinematics::{Pose, PoseError};

use super::typed_value::{NO_EFFECT, TransformPart, TypedPlace, TypedValue};
use crate::diagnosis::{
    candidate::{CandidateModel, DhEntry, ModelParameter},
    hypothesis::ModelPair,
};

/// Part of half a place by which a value moves if it moves at all, in a thousandth of its unit, too. No unit; kind:
/// rounding of a difference.
const MOVED: f64 = 1e-6;

/// A fitted value may move by this many half places of the others, which add up in it. No unit; kind: judgement.
const FREE: f64 = 30.0;

/// How much farther than the difference that is left a fitted value may move. No unit; kind: judgement.
const FAR: f64 = 1e3;

/// A short link, as part of the arm's size: half places at its ends turn it. Kind: choice.
const SHORT: f64 = 0.1;

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
        let tips = |models: &ModelPair, is_in_reference: bool| -> Vec<Pose> {
            let tip = |q| {
                if is_in_reference {
                    models.reference.base_from_tip(q)
                } else {
                    models.candidate.base_from_tip(q)
                }
            };
            configurations.iter().map(tip).collect()
        };
        let [of_candidate, of_reference] = [false, true].map(|is_in_reference| tips(models, is_in_reference));
        let mut allowed = vec![PoseError::default(); configurations.len()];
        for value in &values {
            let mut shifted = models.clone();
            value.shift(&mut shifted, value.half_place);
            let is_in_reference = value.is_in_reference();
            let before = if is_in_reference { &of_reference } else { &of_candidate };
            let moved = before.iter().zip(tips(&shifted, is_in_reference));
            for (allowed, (before, after)) in allowed.iter_mut().zip(moved) {
                let moved = PoseError::between(before, &after);
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

    /// The digits of the models after a correction: exchanged values take theirs with them, and a value in another unit has
    /// its half place in that unit.
    pub(in crate::diagnosis) fn after(&self, models: &ModelPair, correct: impl Fn(&mut ModelPair)) -> Self {
        let mut corrected = models.clone();
        correct(&mut corrected);
        let values = self.values.iter().filter_map(|value| {
            let mut shifted = models.clone();
            value.shift(&mut shifted, value.half_place);
            correct(&mut shifted);
            self.moved(value, &corrected.candidate, &shifted.candidate)
        });
        Self { values: values.collect(), allowed: self.allowed }
    }

    /// Lets values that are fitted move as far as the rounding of the others may take them, of an arm of this size, but not
    /// much farther than the difference that is left: beside that, an angle of nine digits would be lost in rounding.
    pub(in crate::diagnosis) fn free(
        &mut self,
        fitted: impl Iterator<Item = ModelParameter>,
        length_m: f64,
        left: f64,
    ) {
        let most = (FAR * left).max(Tolerance::default().position_m);
        let free = |entry| (FREE * self.coarsest_effect(entry, length_m)).min(most);
        let (length, angle) = (free(DhEntry::A), free(DhEntry::Alpha));
        for parameter in fitted {
            let Some(place) = TypedPlace::of(parameter) else { continue };
            self.values.retain(|value| value.place != place);
            let half_place = if parameter.is_angle() { angle } else { length };
            self.values.push(TypedValue { place, half_place });
        }
    }

    /// Takes their digits from these values.
    pub(in crate::diagnosis) fn fix(&mut self, parameters: impl Iterator<Item = ModelParameter>) {
        let places: Vec<TypedPlace> = parameters.filter_map(TypedPlace::of).collect();
        self.values.retain(|value| !places.contains(&value.place));
    }

    /// What the coarsest half place, of an angle or of a length, changes in an entry, of an arm of this size.
    pub(crate) fn coarsest_effect(&self, entry: DhEntry, length_m: f64) -> f64 {
        let [half_m, half_rad] = [DhEntry::A, DhEntry::Alpha].map(|entry| self.coarsest_half_place(entry));
        if entry.is_angle() { half_rad + half_m / (SHORT * length_m) } else { half_m + half_rad * length_m }
    }

    /// A value at its place in a corrected candidate, of which `shifted` has this value off by half a place; `None` if the
    /// correction has removed it.
    fn moved(
        &self,
        value: &TypedValue,
        corrected: &CandidateModel,
        shifted: &CandidateModel,
    ) -> Option<TypedValue> {
        let at = |place, by: f64| {
            // A length that becomes a thousandth was typed without the zeros at its end, as `d_m = 384.0`: it is not finer
            // than the others.
            let half_place = if by < value.half_place { by.max(self.finest_half_place(value)) } else { by };
            TypedValue { place, half_place }
        };
        let of_transform = |pose: fn(&CandidateModel) -> &Pose, part| match part {
            TransformPart::Translation(_) => {
                at(value.place, (pose(shifted).translation - pose(corrected).translation).norm())
            }
            TransformPart::Rotation(_) => at(value.place, pose(shifted).angle_rad(pose(corrected))),
        };
        match value.place {
            TypedPlace::Row(..) => {
                let rows = 0..corrected.rows.len();
                let mut places = rows.flat_map(|row| DhEntry::ALL.map(|entry| (row, entry)));
                places.find_map(|(row, entry)| {
                    let by = (shifted.entry(row, entry)? - corrected.entry(row, entry)?).abs();
                    (by > MOVED * value.half_place).then(|| at(TypedPlace::Row(row, entry), by))
                })
            }
            TypedPlace::Base(part) => Some(of_transform(|of| &of.base.pose, part)),
            TypedPlace::Tool(part) => Some(of_transform(|of| &of.tool.pose, part)),
            TypedPlace::Origin(..) | TypedPlace::Axis(..) => Some(*value),
        }
    }

    /// The finest half place of the candidate's values of one kind; 0 if there is none.
    fn finest_half_place(&self, kind: &TypedValue) -> f64 {
        let alike = |value: &&TypedValue| !value.is_in_reference() && value.is_angle() == kind.is_angle();
        let halves = self.values.iter().filter(alike).map(|value| value.half_place);
        halves.reduce(f64::min).unwrap_or_default()
    }

    /// The digits of the reference model's values alone.
    pub(in crate::diagnosis) fn of_reference(&self) -> Self {
        let of_reference = self.values.iter().filter(|value| value.is_in_reference()).copied();
        Self { values: of_reference.collect(), allowed: self.allowed }
    }

    /// The candidate's values, each with the finest half place of its kind.
    pub(in crate::diagnosis) fn finest_of_candidate(&self) -> Vec<TypedValue> {
        let of_candidate = self.values.iter().filter(|value| !value.is_in_reference());
        of_candidate.map(|value| TypedValue { half_place: self.finest_half_place(value), ..*value }).collect()
    }
}
