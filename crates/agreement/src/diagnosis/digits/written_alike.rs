//! Lengths that both files have alike: one number, written twice.

use nalgebra::DMatrix;

use super::{
    typed_value::{TransformPart, TypedPlace, TypedValue},
    written_digits::WrittenDigits,
};
use crate::diagnosis::{fit::evaluation_point::EvaluationPoint, hypothesis::ModelPair};

/// Values with the same number and precision that are equal within this part of half a place. No unit; kind: rounding of a value in mm.
const EQUAL: f64 = 1e-6;

/// The effect of two values that move the models alike, as a part of that of one: their directions differ by what the files round, as in
/// a quarter turn of 1.57. They keep as much of their places. No unit; kind: judgement.
const CANCELLED: f64 = 1e-2;

/// Takes nearly all of their places from lengths that both files have alike, if a change of both changes no difference: a flange of
/// 0.107 m in the table and in the URDF is one flange, which cannot be longer in one of them and shorter in the other.
pub(crate) fn tie_written_alike(values: &mut [TypedValue], models: &ModelPair) {
    let point = EvaluationPoint::for_reference(&models.reference);
    let (of_reference, of_candidate): (Vec<TypedValue>, Vec<TypedValue>) =
        values.iter().partition(|value| value.is_in_reference());
    let mut tied: Vec<TypedPlace> = Vec::new();
    for value in &of_candidate {
        let twin = of_reference.iter().find(|other| {
            !tied.contains(&other.place)
                && is_same_number(value, other, models)
                && move_alike(value, other, models, &point)
        });
        tied.extend(twin.into_iter().flat_map(|other| [value.place, other.place]));
    }
    for value in values.iter_mut().filter(|value| tied.contains(&value.place)) {
        value.half_place *= CANCELLED;
    }
}

/// Whether both are the same length, up to its sign, with the same last place. Zeros are alike everywhere, and say nothing.
fn is_same_number(value: &TypedValue, other: &TypedValue, models: &ModelPair) -> bool {
    let (Some(length_m), Some(other_m)) = (length_m(value, models), length_m(other, models)) else {
        return false;
    };
    let equal = EQUAL * value.half_place;
    length_m != 0.0
        && (length_m.abs() - other_m.abs()).abs() < equal
        && (value.half_place - other.half_place).abs() < equal
}

/// Whether making both longer by the same changes no difference.
fn move_alike(value: &TypedValue, other: &TypedValue, models: &ModelPair, point: &EvaluationPoint) -> bool {
    let effect = |value: &TypedValue| -> Option<DMatrix<f64>> {
        let alone = WrittenDigits { values: vec![*value], ..WrittenDigits::default() };
        Some(alone.effects(models, point) * length_m(value, models)?.signum())
    };
    let (Some(effect), Some(of_other)) = (effect(value), effect(other)) else { return false };
    (&effect + of_other).norm() < CANCELLED * effect.norm()
}

/// The number of a length as it stands in its file, in m; `None` for an angle.
fn length_m(value: &TypedValue, ModelPair { candidate, reference }: &ModelPair) -> Option<f64> {
    let of = |part, pose: &congruent_kinematics::Pose| match part {
        TransformPart::Translation(axis) => Some(pose.translation[axis]),
        TransformPart::Rotation(_) => None,
    };
    match value.place {
        TypedPlace::Row(row, entry) if !entry.is_angle() => candidate.entry(row, entry),
        TypedPlace::Base(part) => of(part, &candidate.base.pose),
        TypedPlace::Tool(part) => of(part, &candidate.tool.pose),
        TypedPlace::Origin(joint, part) => of(part, &reference.joints[joint].parent_from_joint),
        TypedPlace::Row(..) | TypedPlace::Axis(..) => None,
    }
}
