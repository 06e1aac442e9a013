//! The table that agrees with the reference model and is nearest to the candidate's: every value is fitted, and
//! of values that only matter together one changes and the others stay as they are given.

use congruent_kinematics::derive_dh;

use super::{
    candidate::{CandidateModel, CandidateRow, DhEntry, ModelParameter},
    explanation::Criterion,
    fit::{
        evaluation_point::EvaluationPoint,
        least_squares::{FitTarget, FittedCandidate},
    },
    hypothesis::ModelPair,
    thresholds::{DERIVED_WITHIN, INDEPENDENT, INDEPENDENT_IN_DIGITS, MAX_PASSES, SAME_VALUE},
};

/// The nearest table that agrees, from the candidate of `models`: as given, or with a gross cause corrected, of which
/// `preferred` are the fitted values. From the axes of the reference model alone if no table near the candidate agrees;
/// `None` for a candidate in screws, and if a joint fits no row. With a criterion a table suffices that it accepts.
pub(crate) fn nearest_table(
    models: &ModelPair,
    preferred: &[ModelParameter],
    criterion: Option<&Criterion>,
) -> Option<CandidateModel> {
    let within = criterion.and_then(|criterion| within_digits(models, preferred, criterion));
    let nearby = within.or_else(|| nearby_table(models, preferred));
    nearby.or_else(|| derived(models))
}

/// The nearest table that agrees, if there is one near the candidate.
pub(super) fn nearby_table(models: &ModelPair, preferred: &[ModelParameter]) -> Option<CandidateModel> {
    models.candidate.convention?;
    let fitted = fitted(models, preferred, INDEPENDENT);
    fitted.into_iter().find(|fit| fit.norm <= SAME_VALUE).map(|fit| fit.candidate)
}

/// The nearest table that agrees within the tolerance or the digits of the files, with every value as given that need not
/// change.
fn within_digits(
    models: &ModelPair,
    preferred: &[ModelParameter],
    criterion: &Criterion,
) -> Option<CandidateModel> {
    models.candidate.convention?;
    let accepted = |candidate: CandidateModel| {
        let pair = ModelPair { candidate, reference: models.reference.clone() };
        pair.is_accepted(criterion).then_some(pair.candidate)
    };
    // Axes that are parallel up to the rounding of the file count as parallel: otherwise offsets along them would move
    // against each other by a thousand times what they have to make up for.
    let fit = fitted(models, preferred, INDEPENDENT_IN_DIGITS).pop()?;
    let mut nearest = accepted(fit.candidate)?;
    let of_rows = (0..nearest.rows.len()).flat_map(|row| DhEntry::ALL.map(|entry| (row, entry)));
    let change = |nearest: &CandidateModel, (row, entry): (usize, DhEntry)| {
        let values = nearest.entry(row, entry).zip(models.candidate.entry(row, entry));
        values.map_or(0.0, |(one, other)| (one - other).abs())
    };
    let mut changed: Vec<(usize, DhEntry)> = of_rows.filter(|&at| change(&nearest, at) > 0.0).collect();
    changed.sort_by(|&one, &other| change(&nearest, one).total_cmp(&change(&nearest, other)));
    for (row, entry) in changed {
        let mut kept = nearest.clone();
        kept.set_entry(row, entry, models.candidate.entry(row, entry).unwrap_or_default());
        nearest = accepted(kept).unwrap_or(nearest);
    }
    Some(nearest)
}

/// The candidate with every independent value fitted, again with those that are independent there.
fn fitted(models: &ModelPair, preferred: &[ModelParameter], independent_part: f64) -> Vec<FittedCandidate> {
    let evaluation_point = EvaluationPoint::for_reference(&models.reference);
    let state = models.reference.state(&evaluation_point.q);
    let target = FitTarget { evaluation_point: &evaluation_point, state: &state };
    let order = by_preference(&models.candidate, preferred);
    let mut fits: Vec<FittedCandidate> = Vec::new();
    for _ in 0..MAX_PASSES {
        let candidate = fits.last().map_or(&models.candidate, |fit| &fit.candidate);
        let free = independent(candidate, &order, &evaluation_point, independent_part);
        let fit = target.refit(candidate, &free);
        let is_exact = fit.norm <= SAME_VALUE;
        fits.push(fit);
        if is_exact {
            break;
        }
    }
    fits
}

/// The values to fit, the likeliest to be wrong first, without values whose effect is a combination of those of
/// others.
fn independent(
    candidate: &CandidateModel,
    order: &[ModelParameter],
    evaluation_point: &EvaluationPoint,
    part: f64,
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
        if independent_norm > part * size {
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
