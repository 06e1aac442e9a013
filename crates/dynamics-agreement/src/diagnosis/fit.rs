//! Fits a hypothesis to the torque difference: is its residual within tolerance, and with which parameters?

use congruent_dynamics::JointResistance;
use congruent_kinematics::rotation_exp;
use nalgebra::{DMatrix, DVector, Matrix3, SymmetricEigen, Vector3};

use super::{
    free::{ENTRIES, FreeParameters},
    hypothesis::{Change, DynamicsHypothesis, Scale},
};
use crate::{
    model::{DynamicsModel, Inertial, JointTerm},
    thresholds::{COM_START_M, LAST_STEP, MAX_STEPS, ZERO_VALUE},
    torque::{least_squares::solve, reduced_difference::ReducedTorqueDifference},
};

/// The candidate's parameters after a correction; parameters that are not listed are unchanged.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Corrected {
    pub(crate) links: Vec<(usize, Inertial)>,
    pub(crate) joints: Option<Vec<JointResistance>>,
    pub(crate) gravity: Option<Vector3<f64>>,
}

impl Corrected {
    /// A model with the correction applied.
    pub(crate) fn model(&self, model: &DynamicsModel) -> DynamicsModel {
        let mut corrected = model.clone();
        for (link, parameters) in &self.links {
            corrected.inertials[*link] = Some(*parameters);
        }
        if let Some(joints) = &self.joints {
            corrected.resistances.clone_from(joints);
        }
        corrected.gravity_m_s2 = self.gravity.unwrap_or(model.gravity_m_s2);
        corrected
    }
}

/// A hypothesis whose residual is within tolerance, with the corrected parameters.
#[derive(Debug, Clone)]
pub(crate) struct FittedHypothesis {
    pub(crate) hypothesis: DynamicsHypothesis,
    pub(super) corrected: Corrected,
    /// Norm of the residual, with the part that no parameters can explain.
    pub(super) residual_norm: f64,
    /// Number of identifiable combinations of the free parameters.
    pub(super) rank: usize,
}

/// The torque difference that hypotheses are fitted to.
#[derive(Clone, Copy)]
pub(super) struct Target<'a> {
    pub(super) model: &'a DynamicsModel,
    pub(super) torque: &'a ReducedTorqueDifference,
    /// The largest residual norm that counts as exact.
    pub(super) exact: f64,
}

/// A correction with its effect on the torques.
struct Effect {
    corrected: Corrected,
    torque: DVector<f64>,
    rank: usize,
}

impl Target<'_> {
    /// The fit of a hypothesis; `None` if its residual is above tolerance.
    pub(super) fn fit(&self, hypothesis: &DynamicsHypothesis) -> Option<FittedHypothesis> {
        let Effect { corrected, torque, rank } = match &hypothesis.change {
            Change::Links(links) => self.links(links)?,
            Change::FreeLink { link, free } => {
                let written = self.model.inertials[*link].unwrap_or_else(Inertial::nothing);
                self.free_link(*link, &written, *free)?
            }
            Change::FreeLinkFrom { link, from, free } => self.free_link(*link, from, *free)?,
            Change::FreeScale(scale) => self.free_scale(*scale)?,
            Change::Joints(joints) => self.joints(joints),
            Change::FreeJoints { term, groups } => self.free_joints(*term, groups),
            Change::Gravity(gravity) => self.gravity(*gravity),
            Change::FreeGravity(along) => self.free_gravity(along),
        };
        // `outside` is orthogonal to everything that a parameter can change, so the norms add as in Pythagoras.
        let residual_norm = libm::hypot((&self.torque.difference - &torque).norm(), self.torque.outside);
        (residual_norm <= self.exact).then(|| FittedHypothesis {
            hypothesis: hypothesis.clone(),
            corrected,
            residual_norm,
            rank,
        })
    }

    /// The effect of a correction on the torques; `None` if it is about a link that does not move.
    pub(super) fn effect(&self, corrected: &Corrected) -> Option<DVector<f64>> {
        let mut effect = self.links(&corrected.links)?.torque;
        if let Some(joints) = &corrected.joints {
            effect += self.joints(joints).torque;
        }
        if let Some(gravity) = corrected.gravity {
            effect += self.gravity(gravity).torque;
        }
        Some(effect)
    }

    /// The effect of new parameters of a link on the torques.
    fn effect_of_parameters(&self, link: usize, parameters: &Inertial) -> Option<DVector<f64>> {
        let written = self.model.inertials[link].unwrap_or_else(Inertial::nothing);
        Some(self.torque.link(link)? * (parameters.ten_numbers() - written.ten_numbers()))
    }

    fn links(&self, links: &[(usize, Inertial)]) -> Option<Effect> {
        let mut effect = DVector::zeros(self.torque.difference.len());
        for (link, parameters) in links {
            effect += self.effect_of_parameters(*link, parameters)?;
        }
        let corrected = Corrected { links: links.to_vec(), ..Corrected::default() };
        Some(Effect { corrected, torque: effect, rank: 0 })
    }

    /// Fits one factor for all links that move; torques are linear in it.
    fn free_scale(&self, scale: Scale) -> Option<Effect> {
        let all = |factor: f64| -> Vec<(usize, Inertial)> {
            let links = self.model.inertials.iter().enumerate();
            let moving = links.filter(|(link, _)| self.torque.link(*link).is_some());
            moving.filter_map(|(link, of)| Some((link, scale.scaled(of.as_ref()?, factor)))).collect()
        };
        // Effect of a factor of 2 is the column of `factor - 1`: the torque is linear in the factor.
        let column = self.links(&all(2.0))?.torque;
        let columns = DMatrix::from_columns(&[column]);
        let solution = solve(&columns, &self.torque.difference, self.torque.scale);
        let rank = solution.rank;
        Some(Effect { rank, ..self.links(&all(1.0 + solution.unknowns[0]))? })
    }

    fn free_link(&self, link: usize, from: &Inertial, free: FreeParameters) -> Option<Effect> {
        let block = self.torque.link(link)?;
        let target = &self.torque.difference - self.effect_of_parameters(link, from)?;
        let link_fit = LinkFit { block, target: &target, from };
        let starts = self.starts(&link_fit, free).into_iter();
        let ends = starts.map(|(free, start)| (free, self.descend(&link_fit, free, start)));
        // Of fits that are exact those that are bodies are preferred: in the null space of the regressor there
        // are always others that are not.
        // Inexact fits count as none: among them the residual alone decides.
        let is_no_body = |(free, end): &(FreeParameters, Descent)| {
            let is_exact = libm::hypot(end.residual_norm, self.torque.outside) <= self.exact;
            !is_exact
                || free
                    .parameters(from, end.unknowns.as_slice())
                    .law_broken(self.model.frames.reach_m)
                    .is_some()
        };
        let best = ends.min_by(|a, b| {
            is_no_body(a).cmp(&is_no_body(b)).then(a.1.residual_norm.total_cmp(&b.1.residual_norm))
        });
        let (free, end) = best?;
        let parameters = free.parameters(from, end.unknowns.as_slice());
        let numbers = free.about_origin(from, end.unknowns.as_slice()).parameters();
        let written = self.model.inertials[link].unwrap_or_else(Inertial::nothing);
        let effect = block * (crate::model::inertial::TenNumbers::from(numbers) - written.ten_numbers());
        let corrected = Corrected { links: vec![(link, parameters)], ..Corrected::default() };
        Some(Effect { corrected, torque: effect, rank: end.rank })
    }

    /// Start values of a fit; fits that are linear need only one.
    fn starts(&self, link_fit: &LinkFit<'_>, free: FreeParameters) -> Vec<(FreeParameters, DVector<f64>)> {
        let from = link_fit.from;
        let zeros = DVector::zeros(free.count());
        let linear = |free: FreeParameters| self.descend(link_fit, free, DVector::zeros(free.count()));
        match free {
            FreeParameters::Payload => {
                let all = linear(FreeParameters::Inertial).unknowns;
                let mass = all[9];
                // From a free fit of all ten parameters: mass, and first moment over mass, is where a point mass
                // would be. The other starts serve if the first moment is not identifiable.
                let places = [Vector3::new(all[6], all[7], all[8]) / mass, from.com_m, Vector3::zeros()];
                let usable = places.into_iter().filter(|place| mass != 0.0 && place.norm() < f64::MAX);
                usable.map(|p| (free, DVector::from_vec(vec![mass, p.x, p.y, p.z]))).collect()
            }
            FreeParameters::Rotation(_) => {
                let fitted = linear(FreeParameters::Inertia);
                // If no tensor at all explains the difference, no rotation of the written one can: the search of
                // rotations is saved.
                if fitted.residual_norm > self.exact {
                    return Vec::new();
                }
                let tensor =
                    FreeParameters::Inertia.parameters(from, fitted.unknowns.as_slice()).tensor_in_link();
                turns_onto(&from.tensor_in_link(), &tensor)
                    .into_iter()
                    .chain(SKEW_STARTS_RAD.map(|turn| rotation_exp(&Vector3::from(turn))))
                    .map(|turn| (FreeParameters::Rotation(turn), zeros.clone()))
                    .collect()
            }
            // A shift of the centre of mass is quadratic: where it is zero, its first step has no direction.
            FreeParameters::Com | FreeParameters::ComEntry(_) => {
                let shifted = |by_m: f64| (free, DVector::repeat(free.count(), by_m));
                // From both sides of zero, where the quadratic has two branches.
                vec![(free, zeros), shifted(COM_START_M), shifted(-COM_START_M)]
            }
            FreeParameters::Inertia | FreeParameters::Inertial => {
                let ball = ball(from, &linear(free).unknowns, free);
                vec![(free, zeros), (free, ball)]
            }
            _ => vec![(free, zeros)],
        }
    }

    /// Gauss-Newton steps; directions that are not identifiable keep their values.
    fn descend(&self, link_fit: &LinkFit<'_>, free: FreeParameters, start: DVector<f64>) -> Descent {
        let &LinkFit { block, target, from } = link_fit;
        let written = from.ten_numbers();
        let rest = |x: &DVector<f64>| {
            let numbers = free.about_origin(from, x.as_slice()).parameters();
            target - block * (crate::model::inertial::TenNumbers::from(numbers) - written)
        };
        let mut residual = rest(&start);
        let mut descent = Descent { residual_norm: residual.norm(), unknowns: start, rank: 0 };
        for _ in 0..MAX_STEPS {
            let derivatives = free.derivatives(from, descent.unknowns.as_slice());
            let columns: Vec<DVector<f64>> = derivatives.iter().map(|numbers| block * numbers).collect();
            // Gauss-Newton: J dx = r in the least-squares sense; directions that are not identifiable keep their
            // written values (dx = 0 there).
            let step = solve(&DMatrix::from_columns(&columns), &residual, self.torque.scale);
            descent.rank = step.rank;
            let next = &descent.unknowns + &step.unknowns;
            let next_residual = rest(&next);
            let residual_norm = next_residual.norm();
            // No damping is needed: parameters are linear or quadratic, and a step that does not gain means that
            // the minimum is reached or missed.
            if residual_norm.is_nan() || residual_norm >= descent.residual_norm {
                break;
            }
            let is_last = step.unknowns.norm() <= LAST_STEP * next.norm();
            (descent.unknowns, descent.residual_norm, residual) = (next, residual_norm, next_residual);
            if is_last {
                break;
            }
        }
        descent
    }

    fn joints(&self, joints: &[JointResistance]) -> Effect {
        let mut effect = DVector::zeros(self.torque.difference.len());
        for term in JointTerm::ALL {
            let changes = joints.iter().zip(&self.model.resistances);
            let change: Vec<f64> =
                changes.map(|(new, old)| term.value_in(new) - term.value_in(old)).collect();
            effect += self.torque.term(term) * DVector::from_vec(change);
        }
        let corrected = Corrected { joints: Some(joints.to_vec()), ..Corrected::default() };
        Effect { corrected, torque: effect, rank: 0 }
    }

    fn free_joints(&self, term: JointTerm, groups: &[Vec<usize>]) -> Effect {
        let all = self.torque.term(term);
        let columns: Vec<DVector<f64>> =
            groups.iter().map(|group| all.select_columns(group).column_sum()).collect();
        let columns = DMatrix::from_columns(&columns);
        let solution = solve(&columns, &self.torque.difference, self.torque.scale);
        let mut joints = self.model.resistances.clone();
        for (group, change) in groups.iter().zip(solution.unknowns.iter()) {
            for &joint in group {
                let old = term.value_in(&joints[joint]);
                // A value that changes by rounding alone keeps its written digits.
                // Judged by its effect on torques, since a change of 1e-9 N m s/rad is rounding for one joint and
                // real for another.
                let effect = all.column(joint).norm() * change.abs();
                if effect <= ZERO_VALUE * self.torque.difference.norm() {
                    continue;
                }
                let new = old + change;
                let value = if new.abs() <= ZERO_VALUE * old.abs() { 0.0 } else { new };
                term.set(&mut joints[joint], value);
            }
        }
        let corrected = Corrected { joints: Some(joints), ..Corrected::default() };
        Effect { corrected, torque: columns * solution.unknowns, rank: solution.rank }
    }

    fn gravity(&self, gravity: Vector3<f64>) -> Effect {
        let effect = self.torque.gravity() * (gravity - self.model.gravity_m_s2);
        Effect {
            corrected: Corrected { gravity: Some(gravity), ..Corrected::default() },
            torque: effect,
            rank: 0,
        }
    }

    fn free_gravity(&self, along: &[Vector3<f64>]) -> Effect {
        let columns: Vec<DVector<f64>> = along.iter().map(|along| self.torque.gravity() * along).collect();
        let columns = DMatrix::from_columns(&columns);
        let solution = solve(&columns, &self.torque.difference, self.torque.scale);
        let changes = along.iter().zip(solution.unknowns.iter()).map(|(along, by)| along * *by);
        let gravity = self.model.gravity_m_s2 + changes.sum::<Vector3<f64>>();
        let corrected = Corrected { gravity: Some(gravity), ..Corrected::default() };
        Effect { corrected, torque: columns * solution.unknowns, rank: solution.rank }
    }
}

/// Values of the free parameters that make a link a ball with the largest moment of a fit. If few parameters are identifiable, the fit of
/// smallest norm is seldom physically possible; one that starts from a ball often is.
fn ball(from: &Inertial, fitted: &DVector<f64>, free: FreeParameters) -> DVector<f64> {
    let moment = free.about_origin(from, fitted.as_slice()).tensor_kg_m2.amax();
    let mut ball = Inertial { tensor_kg_m2: Matrix3::from_diagonal_element(moment), ..*from };
    if ball.mass_kg <= 0.0 {
        ball.mass_kg = BALL_DENSITY * moment;
    }
    let of = |parameters: &Inertial| match free {
        FreeParameters::Inertial => parameters.ten_numbers().iter().copied().collect::<Vec<f64>>(),
        _ => ENTRIES.map(|entry| parameters.tensor_kg_m2[entry]).to_vec(),
    };
    DVector::from_vec(of(&ball)) - DVector::from_vec(of(from))
}

/// Mass of a ball for a unit of its moment, 1/m^2. Kind: choice; a radius of gyration of 0.1 m.
const BALL_DENSITY: f64 = 100.0;

/// Rotations about no principal axis, rad: at a start aligned with the principal axes the derivative of the moments is zero.
const SKEW_STARTS_RAD: [[f64; 3]; 2] = [[0.5, 0.4, 0.3], [-0.4, 0.5, -0.3]];

/// What the parameters of one link are fitted to.
struct LinkFit<'a> {
    /// Torques for each parameter of the link.
    block: &'a DMatrix<f64>,
    /// The torques to explain.
    target: &'a DVector<f64>,
    /// The parameters that the fit starts from.
    from: &'a Inertial,
}

/// The state of a fit: free parameters, residual norm and rank.
struct Descent {
    unknowns: DVector<f64>,
    residual_norm: f64,
    rank: usize,
}

/// Rotations that align the principal axes of one tensor with those of another, in all six orders.
fn turns_onto(from: &Matrix3<f64>, to: &Matrix3<f64>) -> Vec<Matrix3<f64>> {
    let axes = |tensor: &Matrix3<f64>| {
        let largest = tensor.amax();
        (largest.is_finite() && largest > 0.0).then(|| SymmetricEigen::new(tensor / largest).eigenvectors)
    };
    let (Some(from), Some(to)) = (axes(from), axes(to)) else { return vec![Matrix3::identity()] };
    let mut turns = vec![Matrix3::identity()];
    for order in [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]] {
        let mut laid = Matrix3::zeros();
        for (place, taken) in order.into_iter().enumerate() {
            laid.set_column(place, &to.column(taken));
        }
        // turn * from = laid: both matrices have the principal axes as columns, and `from` is orthogonal.
        let turn = laid * from.transpose();
        // A principal axis has no direction, so a reflection can be replaced by the rotation with all axes reversed.
        turns.push(if turn.determinant() < 0.0 { -turn } else { turn });
    }
    turns
}
