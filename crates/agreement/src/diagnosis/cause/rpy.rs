//! `rpy_order`: roll, pitch and yaw written or read in another order, in a declared transform of the
//! candidate or in one joint of the reference model.

use congruent_kinematics::EulerSet;
use nalgebra::Matrix3;

use crate::diagnosis::{
    hypothesis::{Cause, FaultPlace, ModelPair, PoseHypothesis},
    thresholds::{NO_TURN, SINGULAR_BELOW_RAD},
};

/// A rotation after its angles are read in another order, from its roll, pitch and yaw and its matrix.
type RpyReading = fn([f64; 3], &Matrix3<f64>) -> Matrix3<f64>;

/// The other orders: the product in reverse order; its inverse (twice, since at a pitch of a quarter turn
/// only the sum of roll and yaw is known: without roll, and without yaw); and exchanged values of roll and
/// yaw.
const READINGS: [RpyReading; 4] = [
    |rpy, _| EulerSet::Xyz.rotation(rpy),
    |_, rotation| {
        let [roll, pitch, yaw] = EulerSet::Xyz.angles_singular_below(rotation, SINGULAR_BELOW_RAD).angles_rad;
        EulerSet::Zyx.rotation([yaw, pitch, roll])
    },
    |_, rotation| {
        // Rx(r) Ry(p) Rz(y) is the transpose of Rz(-y) Ry(-p) Rx(-r).
        let [roll, pitch, yaw] = rpy_from_rotation(&rotation.transpose()).map(|angle| -angle);
        EulerSet::Zyx.rotation([yaw, pitch, roll])
    },
    |rpy, _| EulerSet::Zyx.rotation(rpy),
];

pub(super) fn hypotheses(models: &ModelPair) -> Vec<PoseHypothesis> {
    let mut list = Vec::new();
    for reading in READINGS {
        list.push(PoseHypothesis::edit(Cause::RpyOrder, FaultPlace::Base, move |models: &mut ModelPair| {
            let constant = &mut models.candidate.base;
            reread(&mut constant.pose.rotation, constant.written_rpy_rad, reading);
        }));
        list.push(PoseHypothesis::edit(Cause::RpyOrder, FaultPlace::Tool, move |models: &mut ModelPair| {
            let constant = &mut models.candidate.tool;
            reread(&mut constant.pose.rotation, constant.written_rpy_rad, reading);
        }));
        // A black box has no file in which an order could be wrong.
        for joint in (0..models.reference.joints.len()).filter(|&at| models.reference.joints[at].is_written) {
            let place = FaultPlace::ReferenceJoints(vec![joint]);
            list.push(PoseHypothesis::edit(Cause::RpyOrder, place, move |models: &mut ModelPair| {
                reread(&mut models.reference.joints[joint].parent_from_joint.rotation, None, reading);
            }));
        }
    }
    list
}

fn reread(rotation: &mut Matrix3<f64>, written_rpy_rad: Option<[f64; 3]>, reading: RpyReading) {
    let rpy = written_rpy_rad.unwrap_or_else(|| rpy_from_rotation(rotation));
    // A single rotation has no order, but roll and yaw can still be exchanged.
    if rpy.iter().any(|angle| angle.abs() > NO_TURN) {
        *rotation = reading(rpy, rotation);
    }
}

/// Roll, pitch and yaw about the fixed axes x, y, z.
pub(super) fn rpy_from_rotation(rotation: &Matrix3<f64>) -> [f64; 3] {
    let [yaw, pitch, roll] = EulerSet::Zyx.angles_singular_below(rotation, SINGULAR_BELOW_RAD).angles_rad;
    [roll, pitch, yaw]
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    /// Rounding of two products of three turns; worst seen 5.6e-17.
    const ROUNDING: f64 = 4e-15;

    /// A file in the other order is read correctly, also if the pitch is a quarter turn and roll or yaw is
    /// left out, as files do.
    #[test]
    fn the_other_order_is_undone() {
        for rpy in [[0.3, -0.4, 1.2], [0.7, FRAC_PI_2, 0.0], [0.0, FRAC_PI_2, 0.7], [0.0, -FRAC_PI_2, -2.0]] {
            let [roll, pitch, yaw] = rpy;
            let meant = EulerSet::Zyx.rotation([yaw, pitch, roll]);
            let mut found = READINGS.map(|reading| {
                let mut rotation = EulerSet::Xyz.rotation(rpy);
                reread(&mut rotation, None, reading);
                (rotation - meant).amax()
            });
            found.sort_by(f64::total_cmp);
            assert!(found[0] < ROUNDING, "{rpy:?}: {:e}", found[0]);
        }
    }
}
