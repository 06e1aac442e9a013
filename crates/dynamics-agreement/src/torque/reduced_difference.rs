//! The torque difference in few coordinates: the regressor at many states, reduced by a QR decomposition.
//!
//! Rows are weighted by the torque of the reference at their joint, so that a wrist counts as much as a shoulder. The effect
//! of a change of one link's ten parameters on all torques is then a small matrix times that change.

use congruent_dynamics::{DynamicsError, JointMotionState, JointResistance, PARAMETERS, SpatialInertia};
use congruent_kinematics::Pose;
use nalgebra::{DMatrix, DVector, SVector, Vector3};

use super::{
    least_squares::{basis, solve},
    states::SampledState,
};
use crate::{
    model::{DynamicsModel, Frames, JointTerm, frames::LinkPlace},
    thresholds::{IDENTIFIABLE, NO_TORQUE, WEAKLY_IDENTIFIABLE},
};

/// How many inertial parameters are identifiable from joint torques.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
pub struct IdentifiableParameters {
    /// Identifiable combinations of inertial parameters: the number of base parameters.
    pub numbers: usize,
    /// Inertial parameters of all moving bodies: ten each.
    pub of: usize,
    /// Those of `numbers` that are identifiable only because joint axes are rounded.
    pub weak: usize,
}

/// The torque difference between a reference and a candidate, and the effect of each parameter on it.
#[derive(Debug, Clone)]
pub(crate) struct ReducedTorqueDifference {
    /// Reference minus candidate: the part in the span of the candidate's parameters.
    pub(crate) difference: DVector<f64>,
    /// Norm of the part outside of this span, which no parameters can explain.
    pub(crate) outside: f64,
    /// Sum of the norms of both torques.
    pub(crate) torques: f64,
    /// The largest singular value of the inertial columns: the scale of rounding.
    pub(crate) scale: f64,
    pub(crate) identifiable: IdentifiableParameters,
    /// For each moving link the effect of its ten parameters; `None` for a link that does not move.
    links: Vec<Option<DMatrix<f64>>>,
    bodies: Vec<DMatrix<f64>>,
    /// Damping, friction, armature: one column for each joint.
    terms: [DMatrix<f64>; 3],
    gravity: DMatrix<f64>,
}

impl ReducedTorqueDifference {
    /// Compares with torques of a reference at some states, one vector a state.
    ///
    /// # Errors
    /// [`DynamicsError::Length`] if a state is another robot's.
    pub(crate) fn new(
        model: &DynamicsModel,
        states: &[SampledState],
        reference: &[Vec<f64>],
    ) -> Result<Self, DynamicsError> {
        let n = model.frames.dof();
        let stacked = weighted(model, states, reference)?;
        // QR of the regressor: rows by the number of states become rows by the number of parameters; norms stay,
        // because Q is orthogonal.
        let mut difference = &stacked.reference - &stacked.candidate;
        let torques = stacked.reference.norm() + stacked.candidate.norm();
        let columns = stacked.columns.ncols();
        let factors = stacked.columns.qr();
        factors.q_tr_mul(&mut difference);
        // Rows below R: torque that no parameter can produce, whatever the hypothesis.
        let outside = difference.rows(columns, difference.len() - columns).norm();
        let r = factors.r();
        let inertial = PARAMETERS * n;
        // Rank of the inertial columns alone: joint terms and gravity are always identifiable and would raise the
        // scale.
        let values = r.view((0, 0), (inertial, inertial)).into_owned().singular_values();
        let scale = values.max();
        let above = |share: f64| values.iter().filter(|value| **value > share * scale).count();
        let numbers = above(IDENTIFIABLE);
        let block = |first: usize, count: usize| r.columns(first, count).into_owned();
        let bodies: Vec<DMatrix<f64>> = (0..n).map(|body| block(PARAMETERS * body, PARAMETERS)).collect();
        let link = |place: &LinkPlace| Some(&bodies[place.body?] * numbers_in_body(&place.body_from_link));
        Ok(Self {
            difference: difference.rows(0, columns).into_owned(),
            outside,
            torques,
            scale,
            identifiable: IdentifiableParameters {
                numbers,
                of: inertial,
                weak: numbers - above(WEAKLY_IDENTIFIABLE),
            },
            links: model.frames.links.iter().map(link).collect(),
            terms: [0, 1, 2].map(|term| block(inertial + term * n, n)),
            gravity: block(inertial + 3 * n, 3),
            bodies,
        })
    }

    /// Effect of a link's ten parameters; `None` for a link that does not move.
    pub(crate) fn link(&self, link: usize) -> Option<&DMatrix<f64>> {
        self.links[link].as_ref()
    }

    pub(crate) fn body(&self, body: usize) -> &DMatrix<f64> {
        &self.bodies[body]
    }

    /// Effect of one term, one column for each joint.
    pub(crate) fn term(&self, term: JointTerm) -> &DMatrix<f64> {
        match term {
            JointTerm::Damping => &self.terms[0],
            JointTerm::Friction => &self.terms[1],
            JointTerm::Armature => &self.terms[2],
        }
    }

    /// Effect of a change of gravity, one column for each axis of the root.
    pub(crate) fn gravity(&self) -> &DMatrix<f64> {
        &self.gravity
    }

    /// The whole difference relative to the sum of both torques.
    pub(crate) fn relative_difference(&self) -> f64 {
        let size = libm::hypot(self.difference.norm(), self.outside);
        if size > 0.0 { size / self.torques } else { 0.0 }
    }

    /// The same projected onto the orthogonal complement of a basis: difference and all columns.
    pub(crate) fn without(&self, basis: &DMatrix<f64>) -> Self {
        let reduced = |columns: &DMatrix<f64>| {
            let mut rest = columns.clone();
            // Twice, against the loss of orthogonality in one pass (Giraud, Langou, Rozloznik 2005).
            for _ in 0..2 {
                rest -= basis * basis.tr_mul(&rest);
            }
            rest
        };
        Self {
            difference: super::least_squares::outside(basis, &self.difference),
            links: self.links.iter().map(|link| link.as_ref().map(reduced)).collect(),
            bodies: self.bodies.iter().map(reduced).collect(),
            terms: [0, 1, 2].map(|term| reduced(&self.terms[term])),
            gravity: reduced(&self.gravity),
            ..*self
        }
    }

    /// The same without what some bodies, whose parameters are not known, can add to the torques: of these bodies nothing has
    /// an effect, and of the others only what they cannot hide.
    pub(crate) fn without_bodies(&self, frames: &Frames, bodies: &[usize]) -> Self {
        if bodies.is_empty() {
            return self.clone();
        }
        let mut rest = self.without(&basis(&self.columns_of(bodies), self.scale));
        for &body in bodies {
            // Exactly: rounding would be the only effect.
            rest.bodies[body].fill(0.0);
            for link in frames.links_of(body) {
                rest.links[link].iter_mut().for_each(|columns| columns.fill(0.0));
            }
        }
        rest
    }

    /// The change of the ten parameters of each of some bodies of the reference that gives the smallest residual.
    pub(crate) fn closing(&self, bodies: &[usize]) -> Vec<[f64; PARAMETERS]> {
        if bodies.is_empty() {
            return Vec::new();
        }
        let change = solve(&self.columns_of(bodies), &-&self.difference, self.scale).unknowns;
        change.as_slice().chunks_exact(PARAMETERS).map(|of| std::array::from_fn(|at| of[at])).collect()
    }

    /// The columns of some bodies, one body after another.
    fn columns_of(&self, bodies: &[usize]) -> DMatrix<f64> {
        let columns: Vec<_> = bodies.iter().flat_map(|&body| self.bodies[body].column_iter()).collect();
        DMatrix::from_columns(&columns)
    }

    /// The difference of two models in this geometry and gravity, by their parameters, of which torques are linear functions: without
    /// another reduction, which takes seconds for a long arm. Rows keep their weights.
    pub(crate) fn between(&self, model: &DynamicsModel, right: &DynamicsModel) -> Self {
        let change = right.stacked_numbers() - model.stacked_numbers();
        let mut difference = DVector::zeros(self.difference.len());
        for (body, columns) in self.bodies.iter().enumerate() {
            difference += columns * change.rows(PARAMETERS * body, PARAMETERS);
        }
        for (term, columns) in JointTerm::ALL.iter().zip(&self.terms) {
            let resistances = right.resistances.iter().zip(&model.resistances);
            let changes = resistances.map(|(right, own)| term.value_in(right) - term.value_in(own));
            difference += columns * DVector::from_iterator(columns.ncols(), changes);
        }
        Self { outside: 0.0, ..self.with_difference(difference) }
    }

    /// The same columns with another difference.
    pub(crate) fn with_difference(&self, difference: DVector<f64>) -> Self {
        Self { difference, ..self.clone() }
    }
}

/// The regressor and both torques at all states, each row divided by the size of its joint's torque.
pub(super) struct Weighted {
    /// Bodies, then damping, friction and armature of each joint, then gravity.
    pub(super) columns: DMatrix<f64>,
    pub(super) candidate: DVector<f64>,
    pub(super) reference: DVector<f64>,
}

pub(super) fn weighted(
    model: &DynamicsModel,
    states: &[SampledState],
    reference: &[Vec<f64>],
) -> Result<Weighted, DynamicsError> {
    let n = model.frames.dof();
    let tree = model.tree();
    let weightless = model.tree().with_gravity(Vector3::zeros()).without_resistances();
    let mut buffer = tree.buffer();
    let zeros = vec![0.0; n];
    let along: Vec<_> = (0..3).map(|axis| weightless.clone().with_gravity(Vector3::ith(axis, 1.0))).collect();
    let mut columns = DMatrix::zeros(n * states.len(), (PARAMETERS + 3) * n + 3);
    let mut candidate = DVector::zeros(columns.nrows());
    let mut block = DMatrix::zeros(n, PARAMETERS * n);
    let mut tau = vec![0.0; n];
    let (weights, numbers) = (weights(reference, n), model.stacked_numbers());
    let all = DVector::from_iterator(columns.nrows(), reference.iter().flatten().copied());
    let mut reference = all;
    for (at, state) in states.iter().enumerate() {
        let motion = JointMotionState { q: &state.q, qd: &state.qd, qdd: &state.qdd };
        tree.regressor_into(&motion, &mut buffer, &mut block)?;
        let rigid = &block * &numbers;
        columns.view_mut((at * n, 0), (n, PARAMETERS * n)).copy_from(&block);
        for (axis, along) in along.iter().enumerate() {
            // At rest and without other terms: a column for gravity along one axis of the root.
            let still = JointMotionState { q: &state.q, qd: &zeros, qdd: &zeros };
            along.inverse_into(&still, &mut buffer, &mut tau)?;
            let column = (PARAMETERS + 3) * n + axis;
            columns.view_mut((at * n, column), (n, 1)).copy_from_slice(&tau);
        }
        for joint in 0..n {
            let row = at * n + joint;
            // Columns of damping, dry friction and armature: tau = d qd + f sign(qd) + a qdd.
            let motion = [state.qd[joint], sign(state.qd[joint]), state.qdd[joint]];
            candidate[row] = rigid[joint] + resistance_torque(&model.resistances[joint], motion);
            for (term, value) in motion.into_iter().enumerate() {
                columns[(row, (PARAMETERS + term) * n + joint)] = value;
            }
            // Columns, candidate and reference alike, otherwise a fit would not be the fit of the weighted
            // torques.
            columns.row_mut(row).scale_mut(weights[joint]);
            candidate[row] *= weights[joint];
            reference[row] *= weights[joint];
        }
    }
    Ok(Weighted { columns, candidate, reference })
}

fn sign(speed: f64) -> f64 {
    if speed == 0.0 { 0.0 } else { speed.signum() }
}

fn resistance_torque(resistance: &JointResistance, motion: [f64; 3]) -> f64 {
    JointTerm::ALL.iter().zip(motion).map(|(term, value)| term.value_in(resistance) * value).sum()
}

/// The reciprocal root mean square of each joint's torque; that of the largest one for a joint without torque.
pub(crate) fn weights(torques: &[Vec<f64>], n: usize) -> Vec<f64> {
    let square = |joint: usize| torques.iter().map(|torque| torque[joint] * torque[joint]).sum::<f64>();
    let squares: Vec<f64> = (0..n).map(square).collect();
    let largest = squares.iter().copied().fold(0.0, f64::max);
    let count = f64::from(u32::try_from(torques.len()).unwrap_or(u32::MAX));
    let weight = |square: f64| match square {
        _ if largest == 0.0 => 1.0,
        // A joint that needs no torque would get an infinite weight, and rounding there would outweigh
        // everything.
        square if square < NO_TORQUE * NO_TORQUE * largest => (count / largest).sqrt(),
        square => (count / square).sqrt(),
    };
    squares.into_iter().map(weight).collect()
}

/// The matrix from the ten parameters of a link to those of its body.
fn numbers_in_body(body_from_link: &Pose) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(PARAMETERS, PARAMETERS);
    for parameter in 0..PARAMETERS {
        let mut unit = [0.0; PARAMETERS];
        // The map is linear, so the images of ten unit vectors are its columns.
        unit[parameter] = 1.0;
        let moved = SpatialInertia::from_parameters(unit).transformed_by(body_from_link);
        matrix.set_column(parameter, &SVector::from(moved.parameters()));
    }
    matrix
}

/// Torques of a model at some states, by inverse dynamics.
///
/// # Errors
/// [`DynamicsError::Length`] if a state is another robot's.
pub(crate) fn torques(
    model: &DynamicsModel,
    states: &[SampledState],
) -> Result<Vec<Vec<f64>>, DynamicsError> {
    let tree = model.tree();
    let mut buffer = tree.buffer();
    let one = |state: &SampledState| {
        let mut tau = vec![0.0; tree.dof()];
        tree.inverse_into(
            &JointMotionState { q: &state.q, qd: &state.qd, qdd: &state.qdd },
            &mut buffer,
            &mut tau,
        )?;
        Ok(tau)
    };
    states.iter().map(one).collect()
}
