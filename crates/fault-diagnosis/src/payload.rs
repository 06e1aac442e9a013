//! Hypothesis: the tool carries a point mass that is not declared.

use std::cell::RefCell;

use congruent_description::RobotDescription;
use congruent_dynamics::{BodyTree, DynamicsError, JointMotionState, PARAMETERS, SpatialInertia};
use congruent_scenario::{FaultKind, FaultQuantity, RunFault};
use nalgebra::{DMatrix, Isometry3, Point3, Vector3};

use super::{
    extent::extended,
    fit::{EXPLAINED, FaultFit, Window, norm, solve},
    observed::ObservedRun,
    residual::{OffWindow, Residual, body_of},
};

/// Largest number of residuals that are fitted: the regressor of each costs some microseconds.
const MOST_RESIDUALS: usize = 1000;
/// Rounds of the fixed-point iteration for the inertia of the point mass, which follows from mass and position: its effect is
/// small compared with that of the weight, so that the iteration converges.
const ROUNDS: usize = 12;
/// A direction of the parameters is not identifiable if its singular value is a smaller part of the largest: efforts are known to
/// about that precision.
const NOT_IDENTIFIABLE: f64 = 1e-3;
/// An axis with a smaller component along an axis that is not identifiable is identifiable. Kind: engineering.
const PART_OF_AXIS: f64 = 0.05;
/// Columns of the regressor: the first moment and the mass, after the six of the tensor.
const FIRST_MOMENT: usize = 6;

/// A point mass that is not declared, with the residuals in which it acts.
pub(super) struct Load {
    pub(super) fit: FaultFit,
    tree: BodyTree,
    /// The body that carries it, and its parameters in the frame of the body.
    body: usize,
    parameters: [f64; PARAMETERS],
    residuals: Window,
}

impl Load {
    /// The residuals without what the load needs. Those of a joint that friction holds stay: they are a lower bound.
    pub(super) fn taken_out(
        &self,
        observed: &ObservedRun<'_>,
        residuals: &[Residual],
    ) -> Result<Vec<Residual>, DynamicsError> {
        let mut rest = residuals.to_vec();
        let mut buffer = self.tree.buffer();
        let mut regressor = DMatrix::zeros(self.tree.dof(), PARAMETERS * self.tree.dof());
        for residual in &mut rest[self.residuals.samples()] {
            self.tree.regressor_into(&motion(residual), &mut buffer, &mut regressor)?;
            for joint in (0..self.tree.dof()).filter(|&joint| !residual.is_held[joint]) {
                // What is missing is needed minus reported; the drive exerts what the load needs.
                residual.missing[joint] += with_followers(observed, joint, |row| {
                    torque(&regressor, row, self.body, &self.parameters)
                });
            }
        }
        Ok(rest)
    }
}

/// The motion that the regressor of a residual is of.
fn motion(residual: &Residual) -> JointMotionState<'_> {
    JointMotionState { q: &residual.q, qd: &residual.qd[0], qdd: &residual.qdd }
}

/// The torque of a row by these parameters of a body.
fn torque(regressor: &DMatrix<f64>, row: usize, body: usize, parameters: &[f64; PARAMETERS]) -> f64 {
    let terms = parameters.iter().enumerate();
    terms.map(|(at, parameter)| regressor[(row, PARAMETERS * body + at)] * parameter).sum()
}

/// The load that explains the residuals of more than half of the joints of `off`, at least two, and the others, whose residuals
/// have another part. Those without which the load explains most are left out first.
pub(super) fn beside_others(
    observed: &ObservedRun<'_>,
    description: &RobotDescription,
    off: &[(usize, OffWindow)],
    residuals: &[Residual],
) -> Result<Option<(Load, Vec<usize>)>, DynamicsError> {
    let (mut rest, mut others) = (off.to_vec(), Vec::new());
    while rest.len() > 2 && 2 * (others.len() + 1) < off.len() {
        let mut best: Option<(Load, usize)> = None;
        for at in 0..rest.len() {
            let mut without = rest.clone();
            without.remove(at);
            let load = fault(observed, description, &without, residuals)?;
            let is_better =
                |load: &Load| best.as_ref().is_none_or(|(best, _)| load.fit.remaining < best.fit.remaining);
            best = load.filter(is_better).map(|load| (load, at)).or(best);
        }
        let Some((load, at)) = best else { return Ok(None) };
        others.push(rest.remove(at).0);
        if load.fit.explains() {
            return Ok(Some((load, others)));
        }
    }
    Ok(None)
}

/// The point mass that explains the residuals of all joints of `off`, in the window of all.
pub(super) fn fault(
    observed: &ObservedRun<'_>,
    description: &RobotDescription,
    off: &[(usize, OffWindow)],
    residuals: &[Residual],
) -> Result<Option<Load>, DynamicsError> {
    let Some(window) = off.iter().map(|&(_, window)| window).reduce(OffWindow::with) else { return Ok(None) };
    let tree = BodyTree::new(observed.robot).with_gravity(observed.clock.gravity_in_world);
    let (body, body_from_tip) = body_of(observed.robot, description.tip);
    let Some(body) = (0..tree.dof()).find(|&joint| tree.link(joint) == body) else { return Ok(None) };
    let of_window = &residuals[window.residuals.samples()];
    // Evenly over the window, so that all its configurations are represented.
    let every = of_window.len().div_ceil(MOST_RESIDUALS).max(1);
    let (mut columns, mut needed) = (vec![Vec::new(); PARAMETERS], Vec::new());
    let mut buffer = tree.buffer();
    let mut regressor = DMatrix::zeros(tree.dof(), PARAMETERS * tree.dof());
    for residual in of_window.iter().step_by(every) {
        tree.regressor_into(&motion(residual), &mut buffer, &mut regressor)?;
        for joint in off.iter().map(|&(joint, _)| joint).filter(|&joint| !residual.is_held[joint]) {
            // Missing is needed minus reported; the drive exerts what the load needs, so the load has the opposite sign.
            needed.push(-residual.missing[joint]);
            for (parameter, column) in columns.iter_mut().enumerate() {
                column.push(with_followers(observed, joint, |row| {
                    regressor[(row, PARAMETERS * body + parameter)]
                }));
            }
        }
    }
    let Some((load, remaining, is_identifiable)) = point_mass(&columns, &needed) else { return Ok(None) };
    let com_in_body = load.first_moment_kg_m / load.mass_kg;
    let com_in_tip = body_from_tip.inverse() * Point3::from(com_in_body);
    let is_identifiable = along_axes_of_tip(&body_from_tip, is_identifiable);
    let parameters = load.parameters();
    let scratch = RefCell::new((buffer, regressor));
    // Of each joint of `off`. Minus: the drive exerts what the load needs, so the load has the opposite sign.
    let expected = |residual: &Residual| -> Vec<f64> {
        let (buffer, regressor) = &mut *scratch.borrow_mut();
        if tree.regressor_into(&motion(residual), buffer, regressor).is_err() {
            return vec![0.0; off.len()];
        }
        let needed = |joint| with_followers(observed, joint, |row| torque(regressor, row, body, &parameters));
        off.iter().map(|&(joint, _)| -needed(joint)).collect()
    };
    let evidence = |residual: &Residual| -> f64 {
        let each = off.iter().zip(expected(residual));
        each.map(|(&(joint, own), expected)| own.evidence(residual, joint, expected)).sum()
    };
    let window = if remaining <= EXPLAINED {
        extended(window, residuals, observed.samples(), evidence)
    } else {
        window
    };
    let (from_s, until_s) = observed.times(window.samples);
    // Joints that friction holds show no load: it ends only if it would show in what follows.
    let ends = off.iter().enumerate().any(|(at, &(joint, own))| {
        own.in_place_of(window).ends(residuals, joint, |residual| expected(residual)[at])
    });
    let until_s = until_s.filter(|_| ends);
    let fault = RunFault {
        kind: FaultKind::WrongPayload,
        joints: Vec::new(),
        link: Some(observed.robot.link(description.tip).name.clone()),
        values: FaultQuantity::payload(load.mass_kg, com_in_tip.coords, is_identifiable),
        from_s,
        until_s,
    };
    // One without a known end still acts in what follows.
    let end = if fault.until_s.is_none() { residuals.len() } else { window.residuals.end };
    let fit = FaultFit { fault, remaining, parameters: 4 };
    Ok(Some(Load { fit, tree, body, parameters, residuals: Window { end, ..window.residuals } }))
}

/// Which coordinates are identifiable along the axes of the tip, in which they are reported; known are those of the body.
fn along_axes_of_tip(body_from_tip: &Isometry3<f64>, is_identifiable: [bool; 3]) -> [bool; 3] {
    let body_from_tip = body_from_tip.rotation.to_rotation_matrix();
    std::array::from_fn(|axis| {
        let hidden = (0..3).filter(|&of_body| !is_identifiable[of_body]);
        hidden.map(|of_body| body_from_tip[(of_body, axis)].abs()).sum::<f64>() < PART_OF_AXIS
    })
}

/// A torque of a joint with those of the joints that follow it.
fn with_followers(observed: &ObservedRun<'_>, joint: usize, torque: impl Fn(usize) -> f64) -> f64 {
    let followers = observed.followers.iter().filter(|follower| follower.master == joint);
    torque(joint) + followers.map(|follower| follower.ratio * torque(follower.joint)).sum::<f64>()
}

/// Mass and place by least squares, with the inertia of the mass and place of the round before.
fn point_mass(columns: &[Vec<f64>], needed: &[f64]) -> Option<(SpatialInertia, f64, [bool; 3])> {
    // Efforts are linear in first moment and mass, but quadratic in the position through the inertia: the inertia of the round
    // before is subtracted, and the linear problem solved.
    let linear = &columns[FIRST_MOMENT..];
    // One scale for the three moments: with a scale of its own, a moment without effect would become as large as the others.
    let moment = linear[..3].iter().map(|column| norm(column)).fold(0.0, f64::max);
    let scales = [moment, moment, moment, norm(&linear[3])];
    let mut is_identifiable = [false; 3];
    let mut load = SpatialInertia::zero();
    let mut remaining = 1.0;
    let whole: f64 = needed.iter().map(|value| value * value).sum();
    for _ in 0..ROUNDS {
        let tensor = load.parameters();
        let without_tensor: Vec<f64> = needed
            .iter()
            .enumerate()
            .map(|(row, value)| {
                value - (0..FIRST_MOMENT).map(|at| columns[at][row] * tensor[at]).sum::<f64>()
            })
            .collect();
        let solution = solve(linear, &scales, &without_tensor, NOT_IDENTIFIABLE)?;
        let [x, y, z, mass_kg] = solution.parameters[..] else { return None };
        // Without the mass neither the place nor the inertia follows: the moments alone are no payload.
        if !solution.is_identifiable[3] {
            return None;
        }
        is_identifiable.copy_from_slice(&solution.is_identifiable[..3]);
        if mass_kg <= 0.0 {
            return None;
        }
        load = SpatialInertia::point_mass(mass_kg, Vector3::new(x, y, z) / mass_kg);
        let rest: f64 = without_tensor.iter().map(|value| value * value).sum();
        // The solver's residual is relative to the rest after the inertia; the fault's is relative to all that is
        // missing.
        remaining = solution.remaining * (rest / whole).sqrt();
    }
    Some((load, remaining, is_identifiable))
}
