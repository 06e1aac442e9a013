//! Values to write: of all values within the uncertainty of a fit, one that the files already have is the likelier one.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::diagnosis::{
    Criterion, DhEntry, Explanation, FaultPlace, ModelPair, ModelParameter, RowConstants,
};

/// The explanation with each value of a row that is fitted, or converted from another unit, replaced by the value of the
/// same kind, from the table or the URDF, that is within the digits, if there is one and the models are still accepted.
pub(super) fn with_known_values(
    explanation: &Explanation,
    models: &ModelPair,
    criterion: &Criterion,
) -> Explanation {
    let mut preferred = explanation.clone();
    // The digits of the corrected models: a converted value is as uncertain as it was in its own unit.
    let criterion = &Criterion { digits: explanation.digits.clone(), ..criterion.clone() };
    for (row, entry) in uncertain(explanation, models) {
        let Some(fitted) = explanation.corrected.candidate.entry(row, entry) else { continue };
        // The values beside it are rounded, too, and the fit makes up for them.
        let within = criterion.digits.coarsest_effect(entry, reach_m(models, criterion));
        let distance = |value: &f64| (value.abs() - fitted.abs()).abs();
        let mut near: Vec<f64> =
            known_values(models, entry).into_iter().filter(|value| distance(value) <= within).collect();
        near.sort_by(|one, other| distance(one).total_cmp(&distance(other)));
        near.dedup();
        let with = |known: f64| {
            let mut corrected = preferred.corrected.clone();
            corrected.candidate.set_entry(
                row,
                entry,
                if known == 0.0 { 0.0 } else { known.abs().copysign(fitted) },
            );
            corrected
        };
        if let Some(known) = near.into_iter().map(with).find(|corrected| corrected.is_accepted(criterion)) {
            preferred.corrected = known;
        }
    }
    preferred
}

/// The largest distance of the tip from the base.
fn reach_m(models: &ModelPair, criterion: &Criterion) -> f64 {
    let reach = criterion.configurations.iter().map(|q| models.reference.base_from_tip(q).translation.norm());
    reach.fold(f64::MIN_POSITIVE, f64::max)
}

/// The values of rows that are fitted, and those that are converted from another unit: 1.5708 rad is a quarter turn.
fn uncertain(explanation: &Explanation, models: &ModelPair) -> Vec<(usize, DhEntry)> {
    let rows = 0..models.candidate.rows.len();
    let all: Vec<(usize, DhEntry)> = rows.flat_map(|row| DhEntry::ALL.map(|entry| (row, entry))).collect();
    let is_uncertain = |&(row, entry): &(usize, DhEntry)| {
        explanation.faults.iter().any(|fault| match &fault.place {
            FaultPlace::Entries(of, rows) if fault.cause.is_unit() => *of == entry && rows.contains(&row),
            FaultPlace::Column(of) if fault.cause.is_unit() => of.contains(&entry),
            _ => fault.free.contains(&ModelParameter::Row(row, entry)),
        })
    };
    all.into_iter().filter(is_uncertain).collect()
}

/// The values that a wrong entry may be meant to have: 0, lengths of the table and the URDF for a length, angles of the
/// table and quarter turns for an angle.
fn known_values(models: &ModelPair, entry: DhEntry) -> Vec<f64> {
    let of_row = |link: &RowConstants| match *link {
        RowConstants::Dh { a_m, alpha_rad, d_m, theta_rad, .. } => {
            if entry.is_angle() {
                [alpha_rad, theta_rad]
            } else {
                [a_m, d_m]
            }
        }
        RowConstants::Screw { .. } => [0.0; 2],
    };
    let rows = models.candidate.rows.iter().flat_map(|row| of_row(&row.link));
    let quarters = [FRAC_PI_2, PI].into_iter().filter(|_| entry.is_angle());
    let origins = models.reference.joints.iter().filter(|_| !entry.is_angle());
    let origins =
        origins.flat_map(|joint| joint.parent_from_joint.translation.iter().copied().collect::<Vec<_>>());
    rows.chain(quarters).chain(origins).chain([0.0]).collect()
}
