//! Faults to inject: each changes the model (or, if a file of the reference model can be wrong, the
//! reference) by its own code, not by the catalogue's.

mod typing;

use std::f64::consts::{FRAC_PI_2, PI};

use congruent_agreement::diagnosis::{Cause, DhEntry, FaultPlace, ModelPair, ReferenceJoint, RowConstants};
use congruent_description::{DhConvention, DhRowKind};
use congruent_kinematics::{Pose, rotation_exp};
use nalgebra::{Matrix3, Vector3};

const ANGLES_RAD: [f64; 5] = [1e-4, -0.017_453_292_519_943_295, 0.3, -1.9, PI];
const LENGTHS_M: [f64; 3] = [1e-4, -5e-3, 0.12];
const RATIOS: [f64; 3] = [0.5, 1.02, -3.0];

/// One fault: its cause, its place, and the change to the models.
pub(crate) struct InjectedFault {
    pub(crate) cause: Cause,
    pub(crate) place: FaultPlace,
    inject: Box<dyn Fn(&mut ModelPair)>,
}

impl InjectedFault {
    fn new(cause: Cause, place: FaultPlace, inject: impl Fn(&mut ModelPair) + 'static) -> Self {
        Self { cause, place, inject: Box::new(inject) }
    }

    pub(crate) fn inject(&self, models: &mut ModelPair) {
        (self.inject)(models);
    }
}

/// All faults that are injected into a robot.
pub(crate) fn all(models: &ModelPair) -> Vec<InjectedFault> {
    let rows = models.candidate.rows.len();
    let mut list = Vec::new();
    for row in 0..rows {
        row_faults(models, row, &mut list);
        for other in row + 1..rows {
            order(row, other, &mut list);
        }
    }
    table(&mut list);
    typing::all(models, &mut list);
    constants(&mut list);
    reference(models, &mut list);
    list
}

fn entry(models: &mut ModelPair, row: usize, entry: DhEntry) -> &mut f64 {
    match (&mut models.candidate.rows[row].link, entry) {
        (RowConstants::Dh { a_m, .. }, DhEntry::A) => a_m,
        (RowConstants::Dh { alpha_rad, .. }, DhEntry::Alpha) => alpha_rad,
        (RowConstants::Dh { d_m, .. }, DhEntry::D) => d_m,
        (RowConstants::Dh { theta_rad, .. }, DhEntry::Theta) => theta_rad,
        (RowConstants::Screw { .. }, _) => panic!("robots here have tables"),
    }
}

fn row_faults(models: &ModelPair, row: usize, list: &mut Vec<InjectedFault>) {
    let flip = move |models: &mut ModelPair| models.candidate.rows[row].rate *= -1.0;
    list.push(InjectedFault::new(Cause::AxisFlipped, FaultPlace::Rows(vec![row]), flip));
    for what in [DhEntry::A, DhEntry::Alpha, DhEntry::D, DhEntry::Theta] {
        let is_angle = matches!(what, DhEntry::Alpha | DhEntry::Theta);
        let is_zero = what == models.candidate.zero_entry(row);
        let cause = if is_zero { Cause::ZeroOffset } else { Cause::Parameter };
        let place = FaultPlace::Entries(what, vec![row]);
        for &by in if is_angle { &ANGLES_RAD[..] } else { &LENGTHS_M[..] } {
            list.push(InjectedFault::new(cause, place.clone(), move |models| {
                *entry(models, row, what) += by;
            }));
        }
        let mistakes: &[(Cause, f64)] = if is_angle {
            &[(Cause::DegreesAsRadians, 180.0 / PI), (Cause::RadiansAsDegrees, PI / 180.0)]
        } else {
            &[(Cause::MillimetresAsMetres, 1e3), (Cause::MillimetresAsMetres, 1e-3)]
        };
        for &(cause, factor) in mistakes {
            list.push(InjectedFault::new(cause, place.clone(), move |models| {
                *entry(models, row, what) *= factor;
            }));
        }
    }
    list.push(InjectedFault::new(Cause::Parameter, FaultPlace::Rows(vec![row]), move |models| {
        if let RowConstants::Dh { kind, .. } = &mut models.candidate.rows[row].link {
            *kind = match *kind {
                DhRowKind::Revolute => DhRowKind::Prismatic,
                DhRowKind::Prismatic => DhRowKind::Revolute,
            };
        }
    }));
    let swap_lengths = move |models: &mut ModelPair| {
        let (a, d) = (*entry(models, row, DhEntry::A), *entry(models, row, DhEntry::D));
        (*entry(models, row, DhEntry::A), *entry(models, row, DhEntry::D)) = (d, a);
    };
    list.push(InjectedFault::new(Cause::ParametersExchanged, FaultPlace::Rows(vec![row]), swap_lengths));
    for ratio in RATIOS {
        let slower = move |models: &mut ModelPair| models.candidate.rows[row].rate *= ratio;
        list.push(InjectedFault::new(Cause::Ratio, FaultPlace::Rows(vec![row]), slower));
    }
    let in_degrees = move |models: &mut ModelPair| models.candidate.rows[row].rate *= 180.0 / PI;
    list.push(InjectedFault::new(Cause::DegreesAsRadians, FaultPlace::Rows(vec![row]), in_degrees));
}

fn order(row: usize, other: usize, list: &mut Vec<InjectedFault>) {
    let place = FaultPlace::Rows(vec![row, other]);
    list.push(InjectedFault::new(Cause::JointsSwapped, place.clone(), move |models| {
        let rows = &mut models.candidate.rows;
        (rows[row].joint, rows[other].joint) = (rows[other].joint, rows[row].joint);
    }));
    list.push(InjectedFault::new(Cause::JointsSwapped, place, move |models| {
        models.candidate.rows.swap(row, other);
    }));
    for what in [DhEntry::A, DhEntry::Alpha, DhEntry::D, DhEntry::Theta] {
        let place = FaultPlace::Entries(what, vec![row, other]);
        list.push(InjectedFault::new(Cause::ParametersExchanged, place, move |models| {
            let (first, second) = (*entry(models, row, what), *entry(models, other, what));
            (*entry(models, row, what), *entry(models, other, what)) = (second, first);
        }));
    }
}

fn table(list: &mut Vec<InjectedFault>) {
    list.push(InjectedFault::new(Cause::ConventionSwapped, FaultPlace::Model, |models| {
        models.candidate.convention = match models.candidate.convention {
            Some(DhConvention::Standard) => Some(DhConvention::Modified),
            _ => Some(DhConvention::Standard),
        };
    }));
    for column in [[DhEntry::A, DhEntry::D], [DhEntry::Alpha, DhEntry::Theta]] {
        let place = FaultPlace::Column(column.to_vec());
        list.push(InjectedFault::new(Cause::ParametersExchanged, place, move |models| {
            for row in 0..models.candidate.rows.len() {
                let [one, two] = column.map(|what| *entry(models, row, what));
                (*entry(models, row, column[0]), *entry(models, row, column[1])) = (two, one);
            }
        }));
    }
    for (cause, factor, column) in [
        (Cause::DegreesAsRadians, 180.0 / PI, vec![DhEntry::Alpha]),
        (Cause::RadiansAsDegrees, PI / 180.0, vec![DhEntry::Alpha]),
        (Cause::DegreesAsRadians, 180.0 / PI, vec![DhEntry::Alpha, DhEntry::Theta]),
        (Cause::RadiansAsDegrees, PI / 180.0, vec![DhEntry::Alpha, DhEntry::Theta]),
        (Cause::MillimetresAsMetres, 1e3, vec![DhEntry::A]),
        (Cause::MillimetresAsMetres, 1e3, vec![DhEntry::D]),
        (Cause::MillimetresAsMetres, 1e3, vec![DhEntry::A, DhEntry::D]),
        (Cause::MillimetresAsMetres, 1e-3, vec![DhEntry::A, DhEntry::D]),
    ] {
        list.push(InjectedFault::new(cause, FaultPlace::Column(column.clone()), move |models| {
            for row in 0..models.candidate.rows.len() {
                for &what in &column {
                    *entry(models, row, what) *= factor;
                }
            }
        }));
    }
}

fn constants(list: &mut Vec<InjectedFault>) {
    let shifts = [Vector3::new(0.0, 0.0, 4e-4), Vector3::new(-0.02, 0.003, 0.11)];
    let turns =
        [Vector3::new(0.0, 0.0, FRAC_PI_2), Vector3::new(1e-3, 0.0, -2e-3), Vector3::new(0.0, PI, 0.0)];
    let off = |shift, turn: Vector3<f64>| Pose::from_parts(rotation_exp(&turn), shift);
    let by = shifts.iter().map(|&shift| off(shift, Vector3::zeros()));
    let by = by.chain(turns.iter().map(|&turn| off(Vector3::zeros(), turn)));
    for by in by.chain([off(shifts[1], Vector3::new(0.4, -0.3, 0.7))]) {
        list.push(InjectedFault::new(Cause::Tool, FaultPlace::Tool, move |models| {
            models.candidate.tool = (models.candidate.tool.pose * by).into();
        }));
        list.push(InjectedFault::new(Cause::Base, FaultPlace::Base, move |models| {
            models.candidate.base = (by * models.candidate.base.pose).into();
        }));
    }
}

/// Faults of a URDF, or of a model that was derived from it.
fn reference(models: &ModelPair, list: &mut Vec<InjectedFault>) {
    let turn = |axis: usize, angle: f64| rotation_exp(&Vector3::ith(axis, angle));
    let (roll, pitch, yaw) = (0.4, -0.7, 1.1);
    let right: Matrix3<f64> = turn(2, yaw) * turn(1, pitch) * turn(0, roll);
    let wrong =
        [turn(0, roll) * turn(1, pitch) * turn(2, yaw), turn(2, roll) * turn(1, pitch) * turn(0, yaw)];
    for wrong in wrong {
        // A robot with a rotated base, whose model has the base's angles in another order.
        list.push(InjectedFault::new(Cause::RpyOrder, FaultPlace::Base, move |models| {
            let base = models.candidate.base.pose;
            let rotated = Pose::from_parts(right, base.translation) * base.inverse();
            let fixed = ReferenceJoint {
                parent_from_joint: rotated,
                twist_in_joint: None,
                is_upward: false,
                is_written: false,
            };
            models.reference.joints.insert(0, fixed);
            models.candidate.base = Pose::from_parts(wrong, base.translation).into();
        }));
    }
    for joint in 0..models.reference.joints.len() {
        list.push(InjectedFault::new(
            Cause::FixedJointDropped,
            FaultPlace::ReferenceJoints(vec![joint]),
            move |models| {
                let rotation = turn(1, 0.2) * turn(0, -0.1);
                let parent_from_joint = Pose::from_parts(rotation, Vector3::new(0.03, -0.02, 0.05));
                let fixed = ReferenceJoint {
                    parent_from_joint,
                    twist_in_joint: None,
                    is_upward: false,
                    is_written: true,
                };
                models.reference.joints.insert(joint, fixed);
            },
        ));
    }
}
