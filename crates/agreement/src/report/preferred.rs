//! Values to write: of all values within the uncertainty of a fit, one that the files already have is the likelier one.

use std::f64::consts::{FRAC_PI_2, PI};

use congruent_description::Tolerance;
use congruent_kinematics::PoseError;

use crate::diagnosis::{
    Criterion, DhEntry, Explanation, FaultPlace, ModelPair, ModelParameter, RowConstants,
    thresholds::SAME_VALUE,
};

/// A value that is written elsewhere, or a rounded one, may have this many times the residual of the fitted one. No unit; kind:
/// choice, since a fit also takes away some of the rounding of the other values.
const AS_GOOD: f64 = 3.0;

/// The part of a value by which rounding may change it. No unit; kind: choice: of two significant digits, half of the last.
const SIGNIFICANT: f64 = 0.01;

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
        let with = |value: f64| {
            let mut corrected = preferred.corrected.clone();
            corrected.candidate.set_entry(row, entry, value);
            corrected
        };
        let known =
            near.into_iter().map(|value| if value == 0.0 { 0.0 } else { value.abs().copysign(fitted) });
        let quarter = nearest_quarter_turn(fitted).filter(|_| entry.is_angle()).into_iter();
        let values = quarter.chain(known).chain(rounded_values(fitted, entry, criterion, within));
        let as_good = as_good_as(&preferred.corrected, criterion);
        // No fit has measured a converted value, and one of an angle follows the rounding of a quarter turn in either file: what
        // the digits allow is as good.
        let is_converted = is_converted(explanation, row, entry);
        let is_quarter_turn = |it: &ModelPair| {
            let value = it.candidate.entry(row, entry).filter(|_| entry.is_angle());
            value.is_some_and(is_quarter_turn)
        };
        let is_as_good =
            |it: &ModelPair| is_converted || is_quarter_turn(it) || it.is_within(&as_good, criterion);
        if let Some(better) = values.map(with).find(|it| is_as_good(it) && it.is_accepted(criterion)) {
            preferred.corrected = better;
        }
    }
    // What remains is that of the values which are written.
    preferred.residual = preferred.corrected.residual(criterion);
    if let Some(last) = preferred.stages.last_mut() {
        *last = preferred.residual;
    }
    preferred
}

fn is_quarter_turn(angle_rad: f64) -> bool {
    let quarters = angle_rad / FRAC_PI_2;
    (quarters - quarters.round()).abs() < SAME_VALUE
}

/// The quarter turn of which an angle is a rounding: 1.5708 is one of four decimals.
fn nearest_quarter_turn(angle_rad: f64) -> Option<f64> {
    /// Half of the last of four decimals.
    const ROUNDED_RAD: f64 = 5e-5;
    let quarters = libm::round(angle_rad / FRAC_PI_2) * FRAC_PI_2;
    ((quarters - angle_rad).abs() < ROUNDED_RAD).then_some(quarters)
}

/// The residual up to which another value is as good as a fitted one: what remains is the rounding of the other values,
/// which is there with a value that is right as well. An exact fit has no residual, so every digit of it counts.
fn as_good_as(corrected: &ModelPair, criterion: &Criterion) -> Tolerance {
    let PoseError { position_m, orientation_rad } = corrected.residual(criterion);
    Tolerance {
        position_m: (AS_GOOD * position_m).max(SAME_VALUE),
        orientation_rad: (AS_GOOD * orientation_rad).max(SAME_VALUE),
    }
}

/// A fitted value as data sheets print it, in the fewest digits first: those of the file and up to three more, as far as
/// they keep two significant ones.
fn rounded_values(fitted: f64, entry: DhEntry, criterion: &Criterion, within: f64) -> Vec<f64> {
    const PLACES: i32 = 4;
    let unit = if entry.is_angle() { 1.0_f64.to_radians() } else { 1.0 };
    let half_place = criterion.digits.coarsest_half_place(entry) / unit;
    if half_place <= 0.0 {
        return Vec::new();
    }
    #[expect(clippy::cast_possible_truncation, reason = "a count of digits")]
    let decimals = -libm::round(libm::log10(2.0 * half_place)) as i32;
    // The text of a number with so many decimals is its nearest one; products would add rounding of their own.
    let rounded = |decimals: i32| {
        let decimals = usize::try_from(decimals).ok()?;
        let value: f64 = format!("{:.decimals$}", fitted / unit).parse().ok()?;
        Some(value * unit)
    };
    let values = (decimals..decimals + PLACES).filter_map(rounded);
    let within = within.min(SIGNIFICANT * fitted.abs());
    values.filter(|value| (value - fitted).abs() <= within).collect()
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
    let is_fitted = |row, entry| {
        explanation.faults.iter().any(|fault| fault.free.contains(&ModelParameter::Row(row, entry)))
    };
    let is_uncertain =
        |&(row, entry): &(usize, DhEntry)| is_fitted(row, entry) || is_converted(explanation, row, entry);
    all.into_iter().filter(is_uncertain).collect()
}

/// Whether the explanation converts a value from another unit.
fn is_converted(explanation: &Explanation, row: usize, entry: DhEntry) -> bool {
    explanation.faults.iter().filter(|fault| fault.cause.is_unit()).any(|fault| match &fault.place {
        FaultPlace::Entries(of, rows) => *of == entry && rows.contains(&row),
        FaultPlace::Column(of) => of.contains(&entry),
        _ => false,
    })
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
