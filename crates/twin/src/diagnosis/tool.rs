//! Hypothesis: a link stands elsewhere on its parent than the description says, by a constant transform.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use super::{
    fit::{Fit, Window, rms},
    noise::ROUNDING,
    observed::Observed,
};
use crate::{
    fault::{FaultQuantity, RunFault},
    scenario::FaultKind,
};

/// A tool that stands elsewhere, and the joint whose position is not what the poses show because of it.
pub(super) struct DisplacedTool {
    pub(super) fit: Fit,
    pub(super) joint_before: Option<usize>,
}

/// The first link that does not stand where its parent and its joint say.
pub(super) fn displaced(observed: &Observed<'_>) -> Option<DisplacedTool> {
    let samples = observed.samples();
    let (link, window) = (0..observed.robot.links().len()).find_map(|link| {
        let is_off = |sample| size(&observed.displacement(link, sample, None)) > ROUNDING;
        Some((link, Window::of(samples, is_off)?))
    })?;
    let link_index = observed.robot.link_indices().nth(link)?;
    let joint_before =
        observed.robot.parent_joint(link_index).and_then(|joint| observed.robot.coordinate(joint));
    // A turn about the axis of the joint before it would pass for a position of that joint: the measured one tells.
    let displacement = |sample: usize| {
        let measured = observed.store.sample(sample).q;
        observed.displacement(link, sample, joint_before.map(|_| measured))
    };
    let (mean, remaining) = constant(window, displacement);
    let (from_s, until_s) = observed.times(window);
    let name = observed.robot.links()[link].name.clone();
    let fault = RunFault {
        kind: FaultKind::ShiftedTool,
        joints: Vec::new(),
        link: Some(name),
        values: FaultQuantity::shift(&mean),
        from_s,
        until_s,
    };
    Some(DisplacedTool { fit: Fit { fault, remaining, parameters: 6 }, joint_before })
}

/// A turn by one radian counts as one metre.
fn size(pose: &Isometry3<f64>) -> f64 {
    pose.translation.vector.norm() + pose.rotation.imag().norm() * 2.0
}

/// The mean of a nearly constant transform, and what it leaves, as a part of the transform.
fn constant(window: Window, pose: impl Fn(usize) -> Isometry3<f64>) -> (Isometry3<f64>, f64) {
    #[expect(clippy::cast_precision_loss, reason = "samples are few")]
    let count = window.len() as f64;
    // Turns are counted from the first one: half a turn this way is half a turn the other way.
    let first = pose(window.first).rotation;
    let (shift, turn) = window.samples().map(&pose).fold(
        (Vector3::zeros(), Vector3::zeros()),
        |(shift, turn): (Vector3<f64>, Vector3<f64>), pose| {
            (shift + pose.translation.vector, turn + (first.inverse() * pose.rotation).scaled_axis())
        },
    );
    let mean = Isometry3::from_parts(
        Translation3::from(shift / count),
        first * UnitQuaternion::from_scaled_axis(turn / count),
    );
    let left = rms(window.samples().map(|sample| size(&(mean.inverse() * pose(sample)))));
    (mean, left / size(&mean))
}
