//! Hypothesis: the tool carries a point mass of which nobody knows.

use congruent_description::RobotDescription;
use congruent_dynamics::{BodyTree, DynamicsError, JointMotion, PARAMETERS, SpatialInertia};
use nalgebra::{DMatrix, Point3, Vector3};

use super::{
    fit::{Fit, norm, solve},
    observed::Observed,
    residual::{OffWindow, Residual, body_of},
};
use crate::{
    fault::{FaultQuantity, RunFault},
    scenario::FaultKind,
};

/// Residuals that the fit takes at most: the regressor of each costs some microseconds.
const MOST_RESIDUALS: usize = 1000;
/// The inertia of a point mass follows from mass and place; it is small beside the weight, and the sequence settles.
const ROUNDS: usize = 12;
/// What changes the efforts by less than this part of what the best known direction does is not shown by the motion: efforts
/// are known to a part of about that.
const NOT_SHOWN: f64 = 1e-3;
/// An axis with less of one that is not shown is not one. Kind: engineering.
const PART_OF_AXIS: f64 = 0.05;
/// Columns of the regressor: the first moment and the mass, after the six of the tensor.
const FIRST_MOMENT: usize = 6;

/// The point mass that explains the residuals of all `joints` in a window of them.
pub(super) fn fault(
    observed: &Observed<'_>,
    description: &RobotDescription,
    joints: &[usize],
    (residuals, window): (&[Residual], OffWindow),
) -> Result<Option<Fit>, DynamicsError> {
    let tree = BodyTree::new(observed.robot).with_gravity(observed.clock.gravity_in_world);
    let (body, body_from_tip) = body_of(observed.robot, description.tip);
    let Some(body) = (0..tree.dof()).find(|&joint| tree.link(joint) == body) else { return Ok(None) };
    let of_window = &residuals[window.residuals.samples()];
    let every = of_window.len().div_ceil(MOST_RESIDUALS).max(1);
    let (mut columns, mut left) = (vec![Vec::new(); PARAMETERS], Vec::new());
    let mut buffer = tree.buffer();
    let mut regressor = DMatrix::zeros(tree.dof(), PARAMETERS * tree.dof());
    for residual in of_window.iter().step_by(every) {
        let motion = JointMotion { q: &residual.q, qd: &residual.qd[0], qdd: &residual.qdd };
        tree.regressor_into(&motion, &mut buffer, &mut regressor)?;
        for &joint in joints.iter().filter(|&&joint| !residual.is_held[joint]) {
            // The effort that is missing is what the load needs, with the other sign.
            left.push(-residual.missing[joint]);
            for (parameter, column) in columns.iter_mut().enumerate() {
                column.push(regressor[(joint, PARAMETERS * body + parameter)]);
            }
        }
    }
    let Some((load, remaining, is_shown)) = point_mass(&columns, &left) else { return Ok(None) };
    let com_in_body = load.first_moment_kg_m / load.mass_kg;
    let com_in_tip = body_from_tip.inverse() * Point3::from(com_in_body);
    // A coordinate along an axis of the body that is not shown is not shown either.
    let body_from_tip = body_from_tip.rotation.to_rotation_matrix();
    let of_axis = |axis: usize| {
        let hidden = (0..3).filter(|&of_body| !is_shown[of_body]);
        hidden.map(|of_body| body_from_tip[(of_body, axis)].abs()).sum::<f64>() < PART_OF_AXIS
    };
    let is_shown = std::array::from_fn(of_axis);
    let (from_s, until_s) = observed.times(window.samples);
    let fault = RunFault {
        kind: FaultKind::WrongPayload,
        joints: Vec::new(),
        link: Some(observed.robot.link(description.tip).name.clone()),
        values: FaultQuantity::payload(load.mass_kg, com_in_tip.coords, is_shown),
        from_s,
        until_s,
    };
    Ok(Some(Fit { fault, remaining, parameters: 4 }))
}

/// Mass and place by least squares, with the inertia of the mass and place of the round before.
fn point_mass(columns: &[Vec<f64>], left: &[f64]) -> Option<(SpatialInertia, f64, [bool; 3])> {
    let linear = &columns[FIRST_MOMENT..];
    // The three moments have one scale, so that one which has next to no effect has next to no column.
    let moment = linear[..3].iter().map(|column| norm(column)).fold(0.0, f64::max);
    let scales = [moment, moment, moment, norm(&linear[3])];
    let mut is_shown = [false; 3];
    let mut load = SpatialInertia::zero();
    let mut remaining = 1.0;
    let whole: f64 = left.iter().map(|value| value * value).sum();
    for _ in 0..ROUNDS {
        let tensor = load.parameters();
        let without_tensor: Vec<f64> = left
            .iter()
            .enumerate()
            .map(|(row, value)| {
                value - (0..FIRST_MOMENT).map(|at| columns[at][row] * tensor[at]).sum::<f64>()
            })
            .collect();
        let solution = solve((linear, &scales), &without_tensor, NOT_SHOWN)?;
        let [x, y, z, mass_kg] = solution.parameters[..] else { return None };
        if !solution.is_shown[3] {
            return None;
        }
        is_shown.copy_from_slice(&solution.is_shown[..3]);
        if mass_kg <= 0.0 {
            return None;
        }
        load = SpatialInertia::point_mass(mass_kg, Vector3::new(x, y, z) / mass_kg);
        let rest: f64 = without_tensor.iter().map(|value| value * value).sum();
        remaining = solution.remaining * (rest / whole).sqrt();
    }
    Some((load, remaining, is_shown))
}
