//! `degrees_as_radians`, `radians_as_degrees`, `millimetres_as_metres`: a unit slip in one entry, in a
//! column, in the whole table, in a declared transform, or in the joints' own positions.

use congruent_kinematics::rotation_exp;
use nalgebra::Vector3;

use crate::diagnosis::{
    hypothesis::{Case, Cause, Hypothesis, Place},
    suspect::{Constant, Entry, Suspect},
};

const ANGLES: [Entry; 2] = [Entry::Alpha, Entry::Theta];
const LENGTHS: [Entry; 2] = [Entry::A, Entry::D];

/// A slip of a unit: what it is called, what undoes it, what it touches.
#[derive(Clone, Copy)]
struct Slip {
    cause: Cause,
    factor: f64,
    entries: &'static [Entry; 2],
}

const SLIPS: [Slip; 4] = [
    Slip { cause: Cause::DegreesAsRadians, factor: std::f64::consts::PI / 180.0, entries: &ANGLES },
    Slip { cause: Cause::RadiansAsDegrees, factor: 180.0 / std::f64::consts::PI, entries: &ANGLES },
    Slip { cause: Cause::MillimetresAsMetres, factor: 1e-3, entries: &LENGTHS },
    Slip { cause: Cause::MillimetresAsMetres, factor: 1e3, entries: &LENGTHS },
];

pub(super) fn hypotheses(case: &Case) -> Vec<Hypothesis> {
    let mut list = Vec::new();
    for slip in SLIPS {
        table(&case.suspect, slip, &mut list);
        for place in [Place::Base, Place::Tool] {
            list.push(constant(place, slip));
        }
        if slip.entries == &LENGTHS {
            list.push(whole(slip));
        } else {
            positions(case.suspect.rows.len(), slip, &mut list);
        }
    }
    list
}

/// Entries, columns, and both columns of a table.
fn table(suspect: &Suspect, slip: Slip, list: &mut Vec<Hypothesis>) {
    let Slip { cause, factor, entries } = slip;
    for row in 0..suspect.rows.len() {
        for &entry in entries {
            if suspect.entry(row, entry).is_some_and(|value| value != 0.0) {
                let place = Place::Entries(entry, vec![row]);
                list.push(Hypothesis::edit(cause, place, move |case| {
                    scale(&mut case.suspect, row, entry, factor);
                }));
            }
        }
    }
    for column in [&entries[..1], &entries[1..], &entries[..]] {
        let edit = move |case: &mut Case| scale_columns(&mut case.suspect, column, factor);
        list.push(Hypothesis::edit(cause, Place::Column(column.to_vec()), edit));
    }
}

fn constant(place: Place, slip: Slip) -> Hypothesis {
    let at_base = place == Place::Base;
    Hypothesis::edit(slip.cause, place, move |case: &mut Case| {
        let suspect = &mut case.suspect;
        rescale(if at_base { &mut suspect.base } else { &mut suspect.tool }, slip);
    })
}

/// All lengths of the model, the declared transforms' too.
fn whole(slip: Slip) -> Hypothesis {
    Hypothesis::edit(slip.cause, Place::Model, move |case: &mut Case| {
        let suspect = &mut case.suspect;
        scale_columns(suspect, slip.entries, slip.factor);
        for row in &mut suspect.rows {
            row.rescale_screw(slip.factor);
        }
        rescale(&mut suspect.base, slip);
        rescale(&mut suspect.tool, slip);
    })
}

/// The position of one joint, or of all: a joint that moves 57.3 times as far.
fn positions(rows: usize, slip: Slip, list: &mut Vec<Hypothesis>) {
    let Slip { cause, factor, .. } = slip;
    for row in 0..rows {
        list.push(Hypothesis::edit(cause, Place::Rows(vec![row]), move |case: &mut Case| {
            case.suspect.rows[row].rate *= factor;
        }));
    }
    list.push(Hypothesis::edit(cause, Place::Rows((0..rows).collect()), move |case: &mut Case| {
        for row in &mut case.suspect.rows {
            row.rate *= factor;
        }
    }));
}

fn scale_columns(suspect: &mut Suspect, column: &[Entry], factor: f64) {
    for row in 0..suspect.rows.len() {
        for &entry in column {
            scale(suspect, row, entry, factor);
        }
    }
}

fn scale(suspect: &mut Suspect, row: usize, entry: Entry, factor: f64) {
    if let Some(value) = suspect.entry_mut(row, entry) {
        *value *= factor;
    }
}

fn rescale(constant: &mut Constant, slip: Slip) {
    if slip.entries == &LENGTHS {
        constant.pose.translation *= slip.factor;
    } else if let Some(rpy) = constant.written_rpy_rad {
        let [roll, pitch, yaw] = rpy.map(|angle| angle * slip.factor);
        let turn = |axis, angle| rotation_exp(&Vector3::ith(axis, angle));
        constant.pose.rotation = turn(2, yaw) * turn(1, pitch) * turn(0, roll);
        constant.written_rpy_rad = Some([roll, pitch, yaw]);
    }
}
