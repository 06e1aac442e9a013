//! Faults to inject: each changes the model (or, where a file of the reference can be wrong, the
//! reference) by its own code, not by the catalogue's.

use std::f64::consts::{FRAC_PI_2, PI};

use congruent_agreement::diagnosis::{Case, Cause, Entry, Place, ReferenceJoint, SuspectLink};
use congruent_description::{DhConvention, DhRowKind};
use congruent_kinematics::{Pose, rotation_exp};
use nalgebra::{Matrix3, Vector3};

const ANGLES_RAD: [f64; 5] = [1e-4, -0.017_453_292_519_943_295, 0.3, -1.9, PI];
const LENGTHS_M: [f64; 3] = [1e-4, -5e-3, 0.12];
const RATIOS: [f64; 3] = [0.5, 1.02, -3.0];

/// One fault: what it is called, where it is, how it is made.
pub(crate) struct Fault {
    pub(crate) cause: Cause,
    pub(crate) place: Place,
    inject: Box<dyn Fn(&mut Case)>,
}

impl Fault {
    fn new(cause: Cause, place: Place, inject: impl Fn(&mut Case) + 'static) -> Self {
        Self { cause, place, inject: Box::new(inject) }
    }

    pub(crate) fn inject(&self, case: &mut Case) {
        (self.inject)(case);
    }
}

/// Every fault that a robot can have.
pub(crate) fn all(case: &Case) -> Vec<Fault> {
    let rows = case.suspect.rows.len();
    let mut list = Vec::new();
    for row in 0..rows {
        of_row(case, row, &mut list);
        for other in row + 1..rows {
            order(row, other, &mut list);
        }
    }
    table(&mut list);
    constants(&mut list);
    reference(case, &mut list);
    list
}

fn entry(case: &mut Case, row: usize, entry: Entry) -> &mut f64 {
    match (&mut case.suspect.rows[row].link, entry) {
        (SuspectLink::Dh { a_m, .. }, Entry::A) => a_m,
        (SuspectLink::Dh { alpha_rad, .. }, Entry::Alpha) => alpha_rad,
        (SuspectLink::Dh { d_m, .. }, Entry::D) => d_m,
        (SuspectLink::Dh { theta_rad, .. }, Entry::Theta) => theta_rad,
        (SuspectLink::Screw { .. }, _) => panic!("robots here have tables"),
    }
}

fn of_row(case: &Case, row: usize, list: &mut Vec<Fault>) {
    let flip = move |case: &mut Case| case.suspect.rows[row].rate *= -1.0;
    list.push(Fault::new(Cause::AxisFlipped, Place::Rows(vec![row]), flip));
    for what in [Entry::A, Entry::Alpha, Entry::D, Entry::Theta] {
        let is_angle = matches!(what, Entry::Alpha | Entry::Theta);
        let is_zero = what == case.suspect.zero_entry(row);
        let cause = if is_zero { Cause::ZeroOffset } else { Cause::Parameter };
        let place = Place::Entries(what, vec![row]);
        for &by in if is_angle { &ANGLES_RAD[..] } else { &LENGTHS_M[..] } {
            list.push(Fault::new(cause, place.clone(), move |case| *entry(case, row, what) += by));
        }
        let slips: &[(Cause, f64)] = if is_angle {
            &[(Cause::DegreesAsRadians, 180.0 / PI), (Cause::RadiansAsDegrees, PI / 180.0)]
        } else {
            &[(Cause::MillimetresAsMetres, 1e3), (Cause::MillimetresAsMetres, 1e-3)]
        };
        for &(cause, factor) in slips {
            list.push(Fault::new(cause, place.clone(), move |case| *entry(case, row, what) *= factor));
        }
    }
    list.push(Fault::new(Cause::Parameter, Place::Rows(vec![row]), move |case| {
        if let SuspectLink::Dh { kind, .. } = &mut case.suspect.rows[row].link {
            *kind = match *kind {
                DhRowKind::Revolute => DhRowKind::Prismatic,
                DhRowKind::Prismatic => DhRowKind::Revolute,
            };
        }
    }));
    let swap_lengths = move |case: &mut Case| {
        let (a, d) = (*entry(case, row, Entry::A), *entry(case, row, Entry::D));
        (*entry(case, row, Entry::A), *entry(case, row, Entry::D)) = (d, a);
    };
    list.push(Fault::new(Cause::ParametersExchanged, Place::Rows(vec![row]), swap_lengths));
    for ratio in RATIOS {
        let slower = move |case: &mut Case| case.suspect.rows[row].rate *= ratio;
        list.push(Fault::new(Cause::Ratio, Place::Rows(vec![row]), slower));
    }
    let in_degrees = move |case: &mut Case| case.suspect.rows[row].rate *= 180.0 / PI;
    list.push(Fault::new(Cause::DegreesAsRadians, Place::Rows(vec![row]), in_degrees));
}

fn order(row: usize, other: usize, list: &mut Vec<Fault>) {
    let place = Place::Rows(vec![row, other]);
    list.push(Fault::new(Cause::JointsSwapped, place.clone(), move |case| {
        let rows = &mut case.suspect.rows;
        (rows[row].joint, rows[other].joint) = (rows[other].joint, rows[row].joint);
    }));
    list.push(Fault::new(Cause::JointsSwapped, place, move |case| case.suspect.rows.swap(row, other)));
    if other == row + 1 {
        let place = Place::Entries(Entry::Alpha, vec![row, other]);
        list.push(Fault::new(Cause::ParametersExchanged, place, move |case| {
            let (first, second) = (*entry(case, row, Entry::Alpha), *entry(case, other, Entry::Alpha));
            (*entry(case, row, Entry::Alpha), *entry(case, other, Entry::Alpha)) = (second, first);
        }));
    }
}

fn table(list: &mut Vec<Fault>) {
    list.push(Fault::new(Cause::ConventionSwapped, Place::Model, |case| {
        case.suspect.convention = match case.suspect.convention {
            Some(DhConvention::Standard) => Some(DhConvention::Modified),
            _ => Some(DhConvention::Standard),
        };
    }));
    for (cause, factor, column) in [
        (Cause::DegreesAsRadians, 180.0 / PI, vec![Entry::Alpha]),
        (Cause::RadiansAsDegrees, PI / 180.0, vec![Entry::Alpha]),
        (Cause::DegreesAsRadians, 180.0 / PI, vec![Entry::Alpha, Entry::Theta]),
        (Cause::RadiansAsDegrees, PI / 180.0, vec![Entry::Alpha, Entry::Theta]),
        (Cause::MillimetresAsMetres, 1e3, vec![Entry::A]),
        (Cause::MillimetresAsMetres, 1e3, vec![Entry::D]),
        (Cause::MillimetresAsMetres, 1e3, vec![Entry::A, Entry::D]),
        (Cause::MillimetresAsMetres, 1e-3, vec![Entry::A, Entry::D]),
    ] {
        list.push(Fault::new(cause, Place::Column(column.clone()), move |case| {
            for row in 0..case.suspect.rows.len() {
                for &what in &column {
                    *entry(case, row, what) *= factor;
                }
            }
        }));
    }
}

fn constants(list: &mut Vec<Fault>) {
    let shifts = [Vector3::new(0.0, 0.0, 4e-4), Vector3::new(-0.02, 0.003, 0.11)];
    let turns =
        [Vector3::new(0.0, 0.0, FRAC_PI_2), Vector3::new(1e-3, 0.0, -2e-3), Vector3::new(0.0, PI, 0.0)];
    let off = |shift, turn: Vector3<f64>| Pose::from_parts(rotation_exp(&turn), shift);
    let by = shifts.iter().map(|&shift| off(shift, Vector3::zeros()));
    let by = by.chain(turns.iter().map(|&turn| off(Vector3::zeros(), turn)));
    for by in by.chain([off(shifts[1], Vector3::new(0.4, -0.3, 0.7))]) {
        list.push(Fault::new(Cause::Tool, Place::Tool, move |case| {
            case.suspect.tool = (case.suspect.tool.pose * by).into();
        }));
        list.push(Fault::new(Cause::Base, Place::Base, move |case| {
            case.suspect.base = (by * case.suspect.base.pose).into();
        }));
    }
}

/// What a URDF's author can get wrong, or a model's author in reading it.
fn reference(case: &Case, list: &mut Vec<Fault>) {
    let turn = |axis: usize, angle: f64| rotation_exp(&Vector3::ith(axis, angle));
    let (roll, pitch, yaw) = (0.4, -0.7, 1.1);
    let right: Matrix3<f64> = turn(2, yaw) * turn(1, pitch) * turn(0, roll);
    let wrong =
        [turn(0, roll) * turn(1, pitch) * turn(2, yaw), turn(2, roll) * turn(1, pitch) * turn(0, yaw)];
    for wrong in wrong {
        // A robot that stands askew, its model's base written in another order.
        list.push(Fault::new(Cause::RpyOrder, Place::Base, move |case| {
            let base = case.suspect.base.pose;
            let askew = Pose::from_parts(right, base.translation) * base.inverse();
            let fixed = ReferenceJoint {
                parent_from_joint: askew,
                twist_in_joint: None,
                is_upward: false,
                is_written: false,
            };
            case.reference.joints.insert(0, fixed);
            case.suspect.base = Pose::from_parts(wrong, base.translation).into();
        }));
    }
    for joint in 0..case.reference.joints.len() {
        list.push(Fault::new(Cause::FixedJointDropped, Place::ReferenceJoints(vec![joint]), move |case| {
            let rotation = turn(1, 0.2) * turn(0, -0.1);
            let parent_from_joint = Pose::from_parts(rotation, Vector3::new(0.03, -0.02, 0.05));
            let fixed = ReferenceJoint {
                parent_from_joint,
                twist_in_joint: None,
                is_upward: false,
                is_written: true,
            };
            case.reference.joints.insert(joint, fixed);
        }));
    }
}
