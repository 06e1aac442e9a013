//! Differences of torque in few coordinates: the regressor at many states, reduced to its orthogonal factor.
//!
//! Rows are weighted by the torque of the reference at their joint, so that a wrist counts as much as a shoulder. What
//! a change of one link's ten numbers does to all torques is then a small matrix times that change.

use congruent_description::Elementary as _;
use congruent_dynamics::{DynamicsError, JointMotion, JointResistance, PARAMETERS, SpatialInertia};
use congruent_kinematics::Pose;
use nalgebra::{DMatrix, DVector, SVector, Vector3};

use super::states::State;
use crate::{
    side::{JointTerm, Side, frames::LinkPlace},
    thresholds::{NO_TORQUE, SEEN, WEAKLY_SEEN},
};

/// How many inertial numbers joint torques tell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
pub struct SeenNumbers {
    /// Combinations that torques tell.
    pub numbers: usize,
    /// Inertial numbers of all moving bodies.
    pub of: usize,
    /// Those of `numbers` that only the rounding of the axes shows.
    pub weak: usize,
}

/// The difference of torque between a reference and a candidate, and what each parameter could do about it.
#[derive(Debug, Clone)]
pub(crate) struct Compressed {
    /// Reference minus candidate, the part that the candidate's numbers could explain.
    pub(crate) difference: DVector<f64>,
    /// Norm of the part that they cannot.
    pub(crate) outside: f64,
    /// Norms of both torques together.
    pub(crate) torques: f64,
    /// The largest effect of an inertial number.
    pub(crate) scale: f64,
    pub(crate) seen: SeenNumbers,
    /// For each link that moves the effect of its ten numbers.
    links: Vec<Option<DMatrix<f64>>>,
    bodies: Vec<DMatrix<f64>>,
    /// Damping, friction, armature: one column for each joint.
    terms: [DMatrix<f64>; 3],
    gravity: DMatrix<f64>,
}

impl Compressed {
    /// Compares with torques of a reference at some states, one vector a state.
    ///
    /// # Errors
    /// [`DynamicsError::Length`] if a state is another robot's.
    pub(crate) fn new(side: &Side, states: &[State], reference: &[Vec<f64>]) -> Result<Self, DynamicsError> {
        let n = side.frames.dof();
        let stacked = weighted(side, states, reference)?;
        let mut difference = &stacked.reference - &stacked.candidate;
        let torques = stacked.reference.norm() + stacked.candidate.norm();
        let columns = stacked.columns.ncols();
        let factors = stacked.columns.qr();
        factors.q_tr_mul(&mut difference);
        let outside = difference.rows(columns, difference.len() - columns).norm();
        let r = factors.r();
        let inertial = PARAMETERS * n;
        let values = r.view((0, 0), (inertial, inertial)).into_owned().singular_values();
        let scale = values.max();
        let above = |share: f64| values.iter().filter(|value| **value > share * scale).count();
        let numbers = above(SEEN);
        let block = |first: usize, count: usize| r.columns(first, count).into_owned();
        let bodies: Vec<DMatrix<f64>> = (0..n).map(|body| block(PARAMETERS * body, PARAMETERS)).collect();
        let link = |place: &LinkPlace| Some(&bodies[place.body?] * numbers_in_body(&place.body_from_link));
        Ok(Self {
            difference: difference.rows(0, columns).into_owned(),
            outside,
            torques,
            scale,
            seen: SeenNumbers { numbers, of: inertial, weak: numbers - above(WEAKLY_SEEN) },
            links: side.frames.links.iter().map(link).collect(),
            terms: [0, 1, 2].map(|term| block(inertial + term * n, n)),
            gravity: block(inertial + 3 * n, 3),
            bodies,
        })
    }

    /// Effect of a link's ten numbers; `None` for a link that does not move.
    pub(crate) fn link(&self, link: usize) -> Option<&DMatrix<f64>> {
        self.links[link].as_ref()
    }

    pub(crate) fn body(&self, body: usize) -> &DMatrix<f64> {
        &self.bodies[body]
    }

    /// Effect of one term of each joint.
    pub(crate) fn term(&self, term: JointTerm) -> &DMatrix<f64> {
        match term {
            JointTerm::Damping => &self.terms[0],
            JointTerm::Friction => &self.terms[1],
            JointTerm::Armature => &self.terms[2],
        }
    }

    /// Effect of a change of gravity.
    pub(crate) fn gravity(&self) -> &DMatrix<f64> {
        &self.gravity
    }

    /// The whole difference as a share of both torques.
    pub(crate) fn relative_difference(&self) -> f64 {
        let size = self.difference.norm().hypotenuse_with(self.outside);
        if size > 0.0 { size / self.torques } else { 0.0 }
    }

    /// The same with what an orthonormal basis spans taken out of everything.
    pub(crate) fn without(&self, basis: &DMatrix<f64>) -> Self {
        let reduced = |columns: &DMatrix<f64>| {
            let mut rest = columns.clone();
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

    /// The same with another difference.
    pub(crate) fn with_difference(&self, difference: DVector<f64>) -> Self {
        Self { difference, ..self.clone() }
    }
}

/// All rows, weighted.
pub(super) struct Weighted {
    /// Bodies, then damping, friction and armature of each joint, then gravity.
    pub(super) columns: DMatrix<f64>,
    pub(super) candidate: DVector<f64>,
    pub(super) reference: DVector<f64>,
}

pub(super) fn weighted(
    side: &Side,
    states: &[State],
    reference: &[Vec<f64>],
) -> Result<Weighted, DynamicsError> {
    let n = side.frames.dof();
    let tree = side.tree();
    let weightless = side.tree().with_gravity(Vector3::zeros()).without_resistances();
    let mut buffer = tree.buffer();
    let zeros = vec![0.0; n];
    let along: Vec<_> = (0..3).map(|axis| weightless.clone().with_gravity(Vector3::ith(axis, 1.0))).collect();
    let mut columns = DMatrix::zeros(n * states.len(), (PARAMETERS + 3) * n + 3);
    let mut candidate = DVector::zeros(columns.nrows());
    let mut block = DMatrix::zeros(n, PARAMETERS * n);
    let mut tau = vec![0.0; n];
    let (weights, numbers) = (weights(reference, n), side.stacked_numbers());
    let all = DVector::from_iterator(columns.nrows(), reference.iter().flatten().copied());
    let mut reference = all;
    for (at, state) in states.iter().enumerate() {
        let motion = JointMotion { q: &state.q, qd: &state.qd, qdd: &state.qdd };
        tree.regressor_into(&motion, &mut buffer, &mut block)?;
        let rigid = &block * &numbers;
        columns.view_mut((at * n, 0), (n, PARAMETERS * n)).copy_from(&block);
        for (axis, along) in along.iter().enumerate() {
            let still = JointMotion { q: &state.q, qd: &zeros, qdd: &zeros };
            along.inverse_into(&still, &mut buffer, &mut tau)?;
            let column = (PARAMETERS + 3) * n + axis;
            columns.view_mut((at * n, column), (n, 1)).copy_from_slice(&tau);
        }
        for joint in 0..n {
            let row = at * n + joint;
            let motion = [state.qd[joint], sign(state.qd[joint]), state.qdd[joint]];
            candidate[row] = rigid[joint] + resistance_torque(&side.resistances[joint], motion);
            for (term, value) in motion.into_iter().enumerate() {
                columns[(row, (PARAMETERS + term) * n + joint)] = value;
            }
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
    JointTerm::ALL.iter().zip(motion).map(|(term, value)| term.of(resistance) * value).sum()
}

/// One over the root mean square of each joint's torque.
pub(crate) fn weights(torques: &[Vec<f64>], n: usize) -> Vec<f64> {
    let square = |joint: usize| torques.iter().map(|torque| torque[joint] * torque[joint]).sum::<f64>();
    let squares: Vec<f64> = (0..n).map(square).collect();
    let largest = squares.iter().copied().fold(0.0, f64::max);
    let count = f64::from(u32::try_from(torques.len()).unwrap_or(u32::MAX));
    let weight = |square: f64| match square {
        _ if largest == 0.0 => 1.0,
        square if square < NO_TORQUE * NO_TORQUE * largest => (count / largest).sqrt(),
        square => (count / square).sqrt(),
    };
    squares.into_iter().map(weight).collect()
}

/// The matrix that gives the numbers of a body by those of a link of it.
fn numbers_in_body(body_from_link: &Pose) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(PARAMETERS, PARAMETERS);
    for parameter in 0..PARAMETERS {
        let mut unit = [0.0; PARAMETERS];
        unit[parameter] = 1.0;
        let moved = SpatialInertia::from_parameters(unit).transformed_by(body_from_link);
        matrix.set_column(parameter, &SVector::from(moved.parameters()));
    }
    matrix
}

/// Torques of a side at some states.
///
/// # Errors
/// [`DynamicsError::Length`] if a state is another robot's.
pub(crate) fn torques(side: &Side, states: &[State]) -> Result<Vec<Vec<f64>>, DynamicsError> {
    let tree = side.tree();
    let mut buffer = tree.buffer();
    let one = |state: &State| {
        let mut tau = vec![0.0; tree.dof()];
        tree.inverse_into(
            &JointMotion { q: &state.q, qd: &state.qd, qdd: &state.qdd },
            &mut buffer,
            &mut tau,
        )?;
        Ok(tau)
    };
    states.iter().map(one).collect()
}
