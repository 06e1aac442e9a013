//! Values of the whole robot that are compared without searching a cause: masses, gravity torques, mass matrix.

use congruent_dynamics::{BodyTree, DynamicsError};
use congruent_input::SiUnit;
use nalgebra::{DMatrix, SymmetricEigen, Vector3};

use crate::{
    model::{DynamicsModel, frames::JointPlace},
    torque::states::SampledState,
};

/// One value by both models.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct CandidateAndReference {
    /// The candidate's value.
    pub found: f64,
    /// The reference's value.
    pub expected: f64,
}

/// Values of the whole robot.
#[derive(Debug, Clone, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct Invariants {
    /// Mass of all links, kg.
    pub total_mass_kg: CandidateAndReference,
    /// Mass of all links that a joint moves, kg.
    pub moving_mass_kg: CandidateAndReference,
    /// Distance between the centres of mass of all moving links, joints at zero, m; `null` if one model has no moving mass.
    pub com_distance_m: Option<f64>,
    /// The largest difference of a gravity torque at the compared states; N m, or N for a sliding joint.
    pub gravity_n_m: f64,
    /// The joint with this difference; `null` if no gravity torque differs.
    pub gravity_joint: Option<String>,
    /// Unit of `gravity_n_m`: `N m`, or `N` for a sliding joint.
    #[schemars(with = "String")]
    pub gravity_unit: SiUnit,
    /// The largest relative difference of the mass matrix at the compared states, in any direction of acceleration;
    /// `null` if the reference's is not positive definite.
    pub mass_matrix_relative: Option<f64>,
}

/// Compares masses, gravity torques and mass matrices; `reference_in_candidate` is the reference in the candidate's geometry.
pub(crate) fn invariants(
    [candidate, reference]: [&DynamicsModel; 2],
    reference_in_candidate: &BodyTree,
    states: &[SampledState],
) -> Result<Invariants, DynamicsError> {
    let [total, moving] = candidate.masses_kg();
    let [reference_total, reference_moving] = reference.masses_kg();
    // Without armature and damping, which are compared by themselves: the mass matrix is that of the bodies.
    let trees = [&candidate.tree().without_resistances(), reference_in_candidate];
    let (mut gravity_n_m, mut gravity_joint) = (0.0, None);
    let mut mass_matrix_relative = Some(0.0_f64);
    for state in states {
        let [found, expected] = [gravity(trees[0], state)?, gravity(trees[1], state)?];
        for (joint, (found, expected)) in found.iter().zip(&expected).enumerate() {
            if (found - expected).abs() > gravity_n_m {
                gravity_n_m = (found - expected).abs();
                gravity_joint = Some(joint);
            }
        }
        let [found, expected] = [mass_matrix(trees[0], state)?, mass_matrix(trees[1], state)?];
        let relative = relative_difference(&found, &expected);
        mass_matrix_relative = mass_matrix_relative.zip(relative).map(|(a, b)| a.max(b));
    }
    let gravity_place = gravity_joint.map(|joint: usize| &candidate.frames.joints[joint]);
    Ok(Invariants {
        total_mass_kg: CandidateAndReference { found: total, expected: reference_total },
        moving_mass_kg: CandidateAndReference { found: moving, expected: reference_moving },
        com_distance_m: com_at_zero(candidate).zip(com_at_zero(reference)).map(|(a, b)| (a - b).norm()),
        gravity_n_m,
        gravity_joint: gravity_place.map(|place| place.name.clone()),
        gravity_unit: gravity_place.map_or(SiUnit::NewtonMetre, JointPlace::effort_unit),
        mass_matrix_relative,
    })
}

fn com_at_zero(model: &DynamicsModel) -> Option<Vector3<f64>> {
    let (mut mass, mut moment) = (0.0, Vector3::zeros());
    for (place, inertial) in model.frames.links.iter().zip(&model.inertials) {
        if let (Some(_), Some(inertial)) = (place.body, inertial) {
            let at = place.root_from_link.rotation * inertial.com_m + place.root_from_link.translation;
            mass += inertial.mass_kg;
            moment += at * inertial.mass_kg;
        }
    }
    (mass > 0.0).then(|| moment / mass)
}

fn gravity(tree: &BodyTree, state: &SampledState) -> Result<Vec<f64>, DynamicsError> {
    let mut tau = vec![0.0; tree.dof()];
    tree.gravity_into(&state.q, &mut tree.buffer(), &mut tau)?;
    Ok(tau)
}

fn mass_matrix(tree: &BodyTree, state: &SampledState) -> Result<DMatrix<f64>, DynamicsError> {
    let mut matrix = DMatrix::zeros(tree.dof(), tree.dof());
    tree.mass_matrix_into(&state.q, &mut tree.buffer(), &mut matrix)?;
    Ok(matrix)
}

/// The largest absolute value of `(x' (M - M_ref) x) / (x' M_ref x)` over all accelerations `x`: the generalised eigenvalues of
/// the difference against the reference. `None` if `M_ref` is not positive definite.
fn relative_difference(found: &DMatrix<f64>, expected: &DMatrix<f64>) -> Option<f64> {
    // With M_ref = L L', these are the eigenvalues of the symmetric matrix L^-1 (M - M_ref) L^-T.
    let lower = expected.clone().cholesky()?.l();
    let whitened = lower.solve_lower_triangular(&(found - expected))?;
    let both = lower.solve_lower_triangular(&whitened.transpose())?;
    // Symmetric except for rounding: the solver for symmetric matrices reads one half, so both are averaged.
    let symmetric = (&both + both.transpose()) * 0.5;
    let largest = symmetric.amax();
    if largest == 0.0 || !largest.is_finite() {
        return (largest == 0.0).then_some(0.0);
    }
    Some(SymmetricEigen::new(symmetric / largest).eigenvalues.amax() * largest)
}
