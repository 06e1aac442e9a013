//! The table that agrees with the reference model and is nearest to the candidate's: every value is fitted, and
//! of values that only matter together one changes and the others stay as they are given.

use congruent_kinematics::derive_dh;

use super::{
    candidate::{CandidateModel, CandidateRow, DhEntry, ModelParameter},
    fit::{evaluation_point::EvaluationPoint, least_squares::FitTarget},
    hypothesis::ModelPair,
    thresholds::{DERIVED_WITHIN, INDEPENDENT, MAX_PASSES, SAME_VALUE},
};

/// The nearest table that agrees, from the candidate of `models`: as given, or with a gross cause corrected, of which
/// `preferred` are the fitted values. From the axes of the reference model alone if no table near the candidate agrees;
/// `None` for a candidate in screws, and if a joint fits no row.
pub(crate) fn nearest_table(models: &ModelPair, preferred: &[ModelParameter]) -> Option<CandidateModel> {
    nearby_table(models, preferred).or_else(|| derived(models))
}

/// The nearest table that agrees, if there is one near the candidate.
pub(super) fn nearby_table(models: &ModelPair, preferred: &[ModelParameter]) -> Option<CandidateModel> {
    models.candidate.convention?;
    let evaluation_point = EvaluationPoint::for_reference(&models.reference);
    let state = models.reference.state(&evaluation_point.q);
    let target = FitTarget { evaluation_point: &evaluation_point, state: &state };
    let order = by_preference(&models.candidate, preferred);
    let mut candidate = models.candidate.clone();
    for _ in 0..MAX_PASSES {
        let free = independent(&candidate, &order, &evaluation_point);
        let fit = target.refit(&candidate, &free);
        if fit.norm <= SAME_VALUE {
            return Some(fit.candidate);
        }
        // Elsewhere other values may be independent.
        candidate = fit.candidate;
    }
    None
}

/// The values to fit, the likeliest to be wrong first, without values whose effect is a combination of those of
/// others.
fn independent(
    candidate: &CandidateModel,
    order: &[ModelParameter],
    evaluation_point: &EvaluationPoint,
) -> Vec<ModelParameter> {
    let walk = candidate.walk(&evaluation_point.q);
    // Gram-Schmidt on the columns of the Jacobian, in the order of preference: of two values with one effect
    // (offsets along parallel axes) the one that is more likely to be wrong is fitted, and the other one stays as
    // the file has it.
    let mut directions: Vec<Vec<f64>> = Vec::new();
    let mut free = Vec::new();
    for &parameter in order {
        let Some(effect) = candidate.parameter_effect(parameter, &evaluation_point.q, &walk) else {
            continue;
        };
        let mut column = evaluation_point.derivative(candidate, &walk, &effect);
        let size = norm(&column);
        // Twice: the second pass removes the rounding of the first.
        for direction in directions.iter().chain(&directions.clone()) {
            let along: f64 = column.iter().zip(direction).map(|(a, b)| a * b).sum();
            column.iter_mut().zip(direction).for_each(|(value, axis)| *value -= along * axis);
        }
        let independent_norm = norm(&column);
        if independent_norm > INDEPENDENT * size {
            directions.push(column.iter().map(|value| value / independent_norm).collect());
            free.push(parameter);
        }
    }
    free
}

/// Every value of a table: those that are preferred, lengths that are not zero, other values that are not, zeros,
/// declared transforms.
fn by_preference(given: &CandidateModel, preferred: &[ModelParameter]) -> Vec<ModelParameter> {
    let entries = (0..given.rows.len()).flat_map(|row| DhEntry::ALL.map(|entry| (row, entry)));
    let mut entries: Vec<(usize, DhEntry)> = entries.collect();
    // Lengths before angles, values before zeros: a typing error is in a number that somebody typed, and angles of
    // a table are mostly quarter turns, which are rarely wrong by a little.
    entries.sort_by_key(|&(row, entry)| match given.entry(row, entry) {
        Some(0.0) | None => 2,
        Some(_) => u8::from(entry.is_angle()),
    });
    let rows = entries.into_iter().map(|(row, entry)| ModelParameter::Row(row, entry));
    let transforms = (0..6).map(ModelParameter::Base).chain((0..6).map(ModelParameter::Tool));
    let others = rows.chain(transforms).filter(|parameter| !preferred.contains(parameter));
    preferred.iter().copied().chain(others).collect()
}

/// A table of the axes of the reference model, in the candidate's convention.
fn derived(models: &ModelPair) -> Option<CandidateModel> {
    let dh = derive_dh(&models.reference.screws(), models.candidate.convention?, DERIVED_WITHIN).ok()?.dh;
    let row = |(joint, row)| CandidateRow::from_dh_row(joint, row);
    Some(CandidateModel {
        convention: Some(dh.convention),
        base: dh.base_from_dh0.into(),
        rows: dh.rows.iter().enumerate().map(row).collect(),
        tool: dh.dhn_from_tip.into(),
    })
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>().sqrt()
}
