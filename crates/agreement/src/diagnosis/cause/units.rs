//! `degrees_as_radians`, `radians_as_degrees`, `millimetres_as_metres`: the wrong unit of one entry, of a
//! column, of the whole table, of a declared transform, or of joint positions.

use congruent_kinematics::rotation_exp;
use nalgebra::Vector3;

use crate::diagnosis::{
    candidate::{CandidateModel, DeclaredTransform, DhEntry},
    hypothesis::{Cause, FaultPlace, ModelPair, PoseHypothesis},
};

const ANGLES: [DhEntry; 2] = [DhEntry::Alpha, DhEntry::Theta];
const LENGTHS: [DhEntry; 2] = [DhEntry::A, DhEntry::D];

/// A wrong unit: its cause, the factor that corrects it, and the entries of that kind.
#[derive(Clone, Copy)]
struct UnitCorrection {
    cause: Cause,
    factor: f64,
    entries: &'static [DhEntry; 2],
}

const UNIT_CORRECTIONS: [UnitCorrection; 4] = [
    UnitCorrection { cause: Cause::DegreesAsRadians, factor: std::f64::consts::PI / 180.0, entries: &ANGLES },
    UnitCorrection { cause: Cause::RadiansAsDegrees, factor: 180.0 / std::f64::consts::PI, entries: &ANGLES },
    UnitCorrection { cause: Cause::MillimetresAsMetres, factor: 1e-3, entries: &LENGTHS },
    UnitCorrection { cause: Cause::MillimetresAsMetres, factor: 1e3, entries: &LENGTHS },
];

pub(super) fn hypotheses(models: &ModelPair) -> Vec<PoseHypothesis> {
    let mut list = Vec::new();
    for wrong_unit in UNIT_CORRECTIONS {
        table(&models.candidate, wrong_unit, &mut list);
        for place in [FaultPlace::Base, FaultPlace::Tool] {
            list.push(constant(place, wrong_unit));
        }
        // A length needs no such hypothesis: the factor on a sliding joint is a ratio, which has a family of its own.
        if wrong_unit.entries == &LENGTHS {
            list.push(whole(wrong_unit));
        } else {
            positions(models.candidate.rows.len(), wrong_unit, &mut list);
        }
    }
    list
}

/// Entries, columns, and both columns of a table.
fn table(candidate: &CandidateModel, wrong_unit: UnitCorrection, list: &mut Vec<PoseHypothesis>) {
    let UnitCorrection { cause, factor, entries } = wrong_unit;
    for row in 0..candidate.rows.len() {
        for &entry in entries {
            // A zero has no unit: its hypothesis would have no effect.
            if candidate.entry(row, entry).is_some_and(|value| value != 0.0) {
                let place = FaultPlace::Entries(entry, vec![row]);
                list.push(PoseHypothesis::edit(cause, place, move |models| {
                    scale(&mut models.candidate, row, entry, factor);
                }));
            }
        }
    }
    // Each column alone, and both: a reader may convert one and forget the other.
    for column in [&entries[..1], &entries[1..], &entries[..]] {
        let edit = move |models: &mut ModelPair| scale_columns(&mut models.candidate, column, factor);
        list.push(PoseHypothesis::edit(cause, FaultPlace::Column(column.to_vec()), edit));
    }
}

fn constant(place: FaultPlace, wrong_unit: UnitCorrection) -> PoseHypothesis {
    let at_base = place == FaultPlace::Base;
    PoseHypothesis::edit(wrong_unit.cause, place, move |models: &mut ModelPair| {
        let candidate = &mut models.candidate;
        rescale(if at_base { &mut candidate.base } else { &mut candidate.tool }, wrong_unit);
    })
}

/// All lengths of the model, including the declared transforms.
fn whole(wrong_unit: UnitCorrection) -> PoseHypothesis {
    PoseHypothesis::edit(wrong_unit.cause, FaultPlace::Model, move |models: &mut ModelPair| {
        let candidate = &mut models.candidate;
        scale_columns(candidate, wrong_unit.entries, wrong_unit.factor);
        for row in &mut candidate.rows {
            row.rescale_screw(wrong_unit.factor);
        }
        rescale(&mut candidate.base, wrong_unit);
        rescale(&mut candidate.tool, wrong_unit);
    })
}

/// The position of one joint, or of all joints: the joint moves 57.3 times as far.
fn positions(rows: usize, wrong_unit: UnitCorrection, list: &mut Vec<PoseHypothesis>) {
    let UnitCorrection { cause, factor, .. } = wrong_unit;
    for row in 0..rows {
        list.push(PoseHypothesis::edit(cause, FaultPlace::Rows(vec![row]), move |models: &mut ModelPair| {
            models.candidate.rows[row].rate *= factor;
        }));
    }
    list.push(PoseHypothesis::edit(
        cause,
        FaultPlace::Rows((0..rows).collect()),
        move |models: &mut ModelPair| {
            for row in &mut models.candidate.rows {
                // A position in the wrong unit is a motion that is 57.3 times too large or too small: a factor on the rate.
                row.rate *= factor;
            }
        },
    ));
}

fn scale_columns(candidate: &mut CandidateModel, column: &[DhEntry], factor: f64) {
    for row in 0..candidate.rows.len() {
        for &entry in column {
            scale(candidate, row, entry, factor);
        }
    }
}

fn scale(candidate: &mut CandidateModel, row: usize, entry: DhEntry, factor: f64) {
    if let Some(value) = candidate.entry_mut(row, entry) {
        *value *= factor;
    }
}

fn rescale(constant: &mut DeclaredTransform, wrong_unit: UnitCorrection) {
    if wrong_unit.entries == &LENGTHS {
        constant.pose.translation *= wrong_unit.factor;
    } else if let Some(rpy) = constant.written_rpy_rad {
        let [roll, pitch, yaw] = rpy.map(|angle| angle * wrong_unit.factor);
        let turn = |axis, angle| rotation_exp(&Vector3::ith(axis, angle));
        // From the angles as written: scaling the rotation itself would lose whole turns.
        constant.pose.rotation = turn(2, yaw) * turn(1, pitch) * turn(0, roll);
        constant.written_rpy_rad = Some([roll, pitch, yaw]);
    }
}
