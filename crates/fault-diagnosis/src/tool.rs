//! Hypothesis: a link is displaced on its parent by a constant transform.

use congruent_scenario::{FaultKind, FaultQuantity, RunFault};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use super::{
    fit::{FaultFit, Window, rms},
    noise::ROUNDING,
    observed::ObservedRun,
};

/// A displaced tool, and the joint whose position the poses give wrongly because of it.
pub(super) struct DisplacedTool {
    pub(super) fit: FaultFit,
    pub(super) joint_before: Option<usize>,
}

/// The first link that is not at its nominal pose on its parent.
pub(super) fn displaced(observed: &ObservedRun<'_>) -> Option<DisplacedTool> {
    let samples = observed.samples();
    // The first: links are in the order of the tree, and everything behind it is displaced with it.
    let (link, window) = (0..observed.robot.links().len()).find_map(|link| {
        let is_off = |sample| size(&observed.displacement(link, sample, None)) > ROUNDING;
        Some((link, Window::spanning(samples, is_off)?))
    })?;
    let link_index = observed.robot.link_indices().nth(link)?;
    let joint_before =
        observed.robot.parent_joint(link_index).and_then(|joint| observed.robot.coordinate(joint));
    // A rotation of the tool about the axis of the joint before it looks like a motion of that joint: so the measured position
    // of the joint is used, not the one by the poses.
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
    Some(DisplacedTool { fit: FaultFit { fault, remaining, parameters: 6 }, joint_before })
}

/// Size of a pose: one radian counts as one metre. The vector part of a quaternion is sin(t/2), so twice it is about the angle.
fn size(pose: &Isometry3<f64>) -> f64 {
    pose.translation.vector.norm() + pose.rotation.imag().norm() * 2.0
}

/// The mean of a nearly constant transform, and the relative residual.
fn constant(window: Window, pose: impl Fn(usize) -> Isometry3<f64>) -> (Isometry3<f64>, f64) {
    #[expect(clippy::cast_precision_loss, reason = "samples are few")]
    let count = window.len() as f64;
    // Rotation vectors relative to the first rotation: near half a turn their sign would jump between samples, and the mean be
    // zero.
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
    let residual = rms(window.samples().map(|sample| size(&(mean.inverse() * pose(sample)))));
    (mean, residual / size(&mean))
}
