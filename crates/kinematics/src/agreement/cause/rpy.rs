//! `rpy_order`: roll, pitch and yaw written or read in the other order, in a declared transform of
//! the model or in one joint of the reference.

use nalgebra::{Matrix3, Vector3};

use crate::{
    agreement::hypothesis::{Case, Cause, Hypothesis, Place},
    rotation::rotation_exp,
};

/// Figures below this make every order the same.
const NO_TURN_RAD: f64 = 1e-12;

/// What another order makes of a rotation.
type Reading = fn([f64; 3], &Matrix3<f64>) -> Matrix3<f64>;

/// The same figures in another order, by product, by its reverse, and by the place of the figures.
const READINGS: [Reading; 3] = [
    |[roll, pitch, yaw], _| turn(0, roll) * turn(1, pitch) * turn(2, yaw),
    |_, rotation| {
        // Rx(r) Ry(p) Rz(y) is the transpose of Rz(-y) Ry(-p) Rx(-r).
        let [roll, pitch, yaw] = rpy_of(&rotation.transpose()).map(|angle| -angle);
        turn(2, yaw) * turn(1, pitch) * turn(0, roll)
    },
    |[roll, pitch, yaw], _| turn(2, roll) * turn(1, pitch) * turn(0, yaw),
];

pub(super) fn hypotheses(case: &Case) -> Vec<Hypothesis> {
    let mut list = Vec::new();
    for reading in READINGS {
        list.push(Hypothesis::edit(Cause::RpyOrder, Place::Base, move |case: &mut Case| {
            let constant = &mut case.suspect.base;
            reread(&mut constant.pose.rotation, constant.written_rpy_rad, reading);
        }));
        list.push(Hypothesis::edit(Cause::RpyOrder, Place::Tool, move |case: &mut Case| {
            let constant = &mut case.suspect.tool;
            reread(&mut constant.pose.rotation, constant.written_rpy_rad, reading);
        }));
        for joint in (0..case.reference.joints.len()).filter(|&at| case.reference.joints[at].is_written) {
            let place = Place::ReferenceJoints(vec![joint]);
            list.push(Hypothesis::edit(Cause::RpyOrder, place, move |case: &mut Case| {
                reread(&mut case.reference.joints[joint].parent_from_joint.rotation, None, reading);
            }));
        }
    }
    list
}

fn reread(rotation: &mut Matrix3<f64>, written_rpy_rad: Option<[f64; 3]>, reading: Reading) {
    let rpy = written_rpy_rad.unwrap_or_else(|| rpy_of(rotation));
    // One turn alone has no order, but its figure has a place.
    if rpy.iter().any(|angle| angle.abs() > NO_TURN_RAD) {
        *rotation = reading(rpy, rotation);
    }
}

fn turn(axis: usize, angle_rad: f64) -> Matrix3<f64> {
    rotation_exp(&Vector3::ith(axis, angle_rad))
}

/// Roll, pitch and yaw about fixed axes; where the pitch is a quarter turn, without yaw.
fn rpy_of(rotation: &Matrix3<f64>) -> [f64; 3] {
    let cos_pitch = rotation[(0, 0)].hypot(rotation[(1, 0)]);
    let pitch = (-rotation[(2, 0)]).atan2(cos_pitch);
    if cos_pitch < 1e-9 {
        return [(-rotation[(1, 2)]).atan2(rotation[(1, 1)]), pitch, 0.0];
    }
    let roll = rotation[(2, 1)].atan2(rotation[(2, 2)]);
    [roll, pitch, rotation[(1, 0)].atan2(rotation[(0, 0)])]
}
