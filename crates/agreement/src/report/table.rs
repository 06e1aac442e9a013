//! The given table beside the nearest one that agrees, value by value.

use congruent_description::{ConstantKey, RowKey};
use congruent_input::{
    Slack, fitted_transform,
    units::{Unit, UnitSystem},
};
use congruent_kinematics::Pose;

use super::{
    content::{ComparedValue, TableComparison},
    fault_message::row_key,
    names::ModelNames,
};
use crate::diagnosis::{
    CandidateModel, Criterion, DhEntry, Explanation, ModelPair, ModelParameter, nearest_table,
};

/// Part of the tolerance by which a value must differ to be marked. Kind: choice.
const PART_OF_TOLERANCE: f64 = 0.1;

/// Values that differ by less are the same at any tolerance. Unit: m or rad; kind: rounding of a fit.
const SAME: f64 = 1e-10;

/// Compares the table of `models` with the nearest one that agrees; `first` corrects a gross
/// cause, from which that one is fitted.
pub(super) fn table_comparison(
    models: &ModelPair,
    first: &Explanation,
    criterion: &Criterion,
    names: &ModelNames<'_>,
) -> Option<TableComparison> {
    let preferred: Vec<ModelParameter> =
        first.faults.iter().flat_map(|fault| fault.free.iter().copied()).collect();
    let corrected =
        ModelPair { reference: models.reference.clone(), candidate: first.corrected.candidate.clone() };
    // From the corrected candidate: with a gross cause still in it, most values of the nearest table would be
    // different.
    // Without a cause all that differs is rounding, which the exact table shows.
    let accepting = (!first.faults.is_empty()).then_some(criterion);
    let nearest = nearest_table(&corrected, &preferred, accepting)?;
    let slack = Slack {
        length_m: (PART_OF_TOLERANCE * criterion.tolerance.position_m).max(SAME),
        angle_rad: (PART_OF_TOLERANCE * criterion.tolerance.orientation_rad).max(SAME),
    };
    let tables = [&models.candidate, &nearest];
    let rows = 0..models.candidate.rows.len().min(nearest.rows.len());
    let mut values: Vec<ComparedValue> = Vec::new();
    for row in rows {
        values.extend(signs(tables, row, names));
        values.extend(DhEntry::ALL.into_iter().filter_map(|entry| entries(tables, row, entry, names, slack)));
    }
    values.push(constant(tables, ConstantKey::BaseFromDh0, slack));
    values.push(constant(tables, ConstantKey::DhnFromTip, slack));
    let residual = ModelPair { candidate: nearest, reference: models.reference.clone() }.residual(criterion);
    Some(TableComparison { residual, values })
}

/// The sign of a row, if the two differ.
fn signs(
    [given, nearest]: [&CandidateModel; 2],
    row: usize,
    names: &ModelNames<'_>,
) -> Option<ComparedValue> {
    let sign = |of: &CandidateModel| if of.rows[row].rate < 0.0 { "-1" } else { "1" };
    let (found, expected) = (sign(given), sign(nearest));
    (found != expected).then(|| ComparedValue {
        joint: Some(names.moving_joint(given.rows[row].joint)),
        key: RowKey::Sign.name().to_owned(),
        found: found.to_owned(),
        expected: expected.to_owned(),
        differs: true,
    })
}

fn entries(
    [given, nearest]: [&CandidateModel; 2],
    row: usize,
    entry: DhEntry,
    names: &ModelNames<'_>,
    slack: Slack,
) -> Option<ComparedValue> {
    let (found, expected) = (given.entry(row, entry)?, nearest.entry(row, entry)?);
    let (unit, most) =
        if entry.is_angle() { (Unit::Angle, slack.angle_rad) } else { (Unit::Length, slack.length_m) };
    let place = names.places.and_then(|places| places.value(row, row_key(entry)));
    let (key, units) =
        place.map_or_else(|| (entry.to_string(), UnitSystem::Si), |place| (place.key, place.units));
    let off = found - expected;
    let off = if entry.is_angle() { libm::atan2(libm::sin(off), libm::cos(off)) } else { off };
    let differs = off.abs() > most;
    let found = unit.fitted(found, units, Slack::default());
    Some(ComparedValue {
        joint: Some(names.moving_joint(given.rows[row].joint)),
        key,
        expected: if differs { unit.fitted(expected, units, slack) } else { found.clone() },
        found,
        differs,
    })
}

fn constant([given, nearest]: [&CandidateModel; 2], key: ConstantKey, slack: Slack) -> ComparedValue {
    let pose = |of: &CandidateModel| match key {
        ConstantKey::BaseFromDh0 => of.base.pose,
        ConstantKey::DhnFromTip => of.tool.pose,
    };
    let (found, expected) = (pose(given), pose(nearest));
    let differs =
        found.distance_m(&expected) > slack.length_m || found.angle_rad(&expected) > slack.angle_rad;
    let written = |slack| move |pose: Pose| fitted_transform(&pose.to_isometry(), slack);
    let found = written(Slack::default())(found);
    ComparedValue {
        joint: None,
        key: key.name().to_owned(),
        expected: if differs { written(slack)(expected) } else { found.clone() },
        found,
        differs,
    }
}
