//! What the digits of a pose that is written as xyz and rpy leave open.

use crate::SmallMotion;
use congruent_input::axes_of_rpy_fixed_xyz;
use nalgebra::{Isometry3, Vector3};

/// The motions that half of the last place of each written number makes, in the frame in which the pose is written: `halves` are
/// those of x, y, z in m, then of roll, pitch, yaw in rad. None of a number that is exact.
pub fn motions_of_pose(halves: [f64; 6], pose: &Isometry3<f64>) -> Vec<SmallMotion> {
    let axes = axes_of_rpy_fixed_xyz(pose.rotation.to_rotation_matrix().matrix());
    let motion = |(at, half): (usize, f64)| match at {
        0..3 => SmallMotion::shift(Vector3::ith(at, half)),
        _ => SmallMotion::turn(axes[at - 3] * half, &pose.translation.vector),
    };
    halves.into_iter().enumerate().filter(|(_, half)| *half > 0.0).map(motion).collect()
}
