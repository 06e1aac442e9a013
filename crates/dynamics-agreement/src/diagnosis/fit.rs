//! Does a hypothesis leave nothing of the difference of torque, and with which parameters?

use congruent_description::Elementary as _;
use congruent_dynamics::JointResistance;
use congruent_kinematics::rotation_exp;
use nalgebra::{DMatrix, DVector, Matrix3, SymmetricEigen, Vector3};

use super::{
    free::{ENTRIES, Free},
    hypothesis::{Change, Hypothesis, Scale},
};
use crate::{
    side::{Inertial, JointTerm, Side},
    thresholds::{COM_START_M, LAST_STEP, MAX_STEPS, ZERO_VALUE},
    torque::{compressed::Compressed, least_squares::solve},
};

/// The candidate's parameters after a correction; what is not named stays.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Corrected {
    pub(crate) links: Vec<(usize, Inertial)>,
    pub(crate) joints: Option<Vec<JointResistance>>,
    pub(crate) gravity: Option<Vector3<f64>>,
}

impl Corrected {
    /// A side with the correction.
    pub(crate) fn side(&self, side: &Side) -> Side {
        let mut corrected = side.clone();
        for (link, parameters) in &self.links {
            corrected.inertials[*link] = Some(*parameters);
        }
        if let Some(joints) = &self.joints {
            corrected.resistances.clone_from(joints);
        }
        corrected.gravity_m_s2 = self.gravity.unwrap_or(side.gravity_m_s2);
        corrected
    }
}

/// A hypothesis that leaves nothing.
#[derive(Debug, Clone)]
pub(crate) struct Fit {
    pub(crate) hypothesis: Hypothesis,
    pub(super) corrected: Corrected,
    /// Norm of what is left of the difference, with what lies outside.
    pub(super) left: f64,
    /// Combinations of the free numbers that torque shows.
    pub(super) rank: usize,
}

/// What hypotheses are held against.
#[derive(Clone, Copy)]
pub(super) struct Target<'a> {
    pub(super) side: &'a Side,
    pub(super) torque: &'a Compressed,
    /// The largest norm that counts as nothing left.
    pub(super) exact: f64,
}

/// What a correction does to the torques, and its parameters.
struct Effect {
    corrected: Corrected,
    torque: DVector<f64>,
    rank: usize,
}

impl Target<'_> {
    /// The fit of a hypothesis, if it leaves nothing.
    pub(super) fn fit(&self, hypothesis: &Hypothesis) -> Option<Fit> {
        let Effect { corrected, torque, rank } = match &hypothesis.change {
            Change::Links(links) => self.links(links)?,
            Change::FreeLink { link, free } => {
                let written = self.side.inertials[*link].unwrap_or_else(Inertial::nothing);
                self.free_link(*link, &written, *free)?
            }
            Change::FreeLinkFrom { link, from, free } => self.free_link(*link, from, *free)?,
            Change::FreeScale(scale) => self.free_scale(*scale)?,
            Change::Joints(joints) => self.joints(joints),
            Change::FreeJoints { term, groups } => self.free_joints(*term, groups),
            Change::Gravity(gravity) => self.gravity(*gravity),
            Change::FreeGravity(along) => self.free_gravity(along),
        };
        let left = (&self.torque.difference - &torque).norm().hypotenuse_with(self.torque.outside);
        (left <= self.exact).then(|| Fit { hypothesis: hypothesis.clone(), corrected, left, rank })
    }

    /// What a correction does to the torques; `None` if it is about a link that does not move.
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

    /// Effect of other parameters of a link.
    fn of_parameters(&self, link: usize, parameters: &Inertial) -> Option<DVector<f64>> {
        let written = self.side.inertials[link].unwrap_or_else(Inertial::nothing);
        Some(self.torque.link(link)? * (parameters.ten_numbers() - written.ten_numbers()))
    }

    fn links(&self, links: &[(usize, Inertial)]) -> Option<Effect> {
        let mut effect = DVector::zeros(self.torque.difference.len());
        for (link, parameters) in links {
            effect += self.of_parameters(*link, parameters)?;
        }
        let corrected = Corrected { links: links.to_vec(), ..Corrected::default() };
        Some(Effect { corrected, torque: effect, rank: 0 })
    }

    /// One factor of all links that move: torques are linear in it.
    fn free_scale(&self, scale: Scale) -> Option<Effect> {
        let all = |factor: f64| -> Vec<(usize, Inertial)> {
            let links = self.side.inertials.iter().enumerate();
            let moving = links.filter(|(link, _)| self.torque.link(*link).is_some());
            moving.filter_map(|(link, of)| Some((link, scale.scaled(of.as_ref()?, factor)))).collect()
        };
        let column = self.links(&all(2.0))?.torque;
        let columns = DMatrix::from_columns(&[column]);
        let solution = solve(&columns, &self.torque.difference, self.torque.scale);
        let rank = solution.rank;
        Some(Effect { rank, ..self.links(&all(1.0 + solution.unknowns[0]))? })
    }

    fn free_link(&self, link: usize, from: &Inertial, free: Free) -> Option<Effect> {
        let block = self.torque.link(link)?;
        let target = &self.torque.difference - self.of_parameters(link, from)?;
        let ends = self
            .starts(block, &target, from, free)
            .into_iter()
            .map(|(free, start)| (free, self.descend(block, &target, (from, free), start)));
        // What torque does not show may be that of a body as well as anything else.
        let is_no_body = |(free, end): &(Free, Descent)| {
            let is_exact = end.left.hypotenuse_with(self.torque.outside) <= self.exact;
            !is_exact
                || free
                    .parameters(from, end.unknowns.as_slice())
                    .law_broken(self.side.frames.reach_m)
                    .is_some()
        };
        let best = ends.min_by(|a, b| is_no_body(a).cmp(&is_no_body(b)).then(a.1.left.total_cmp(&b.1.left)));
        let (free, end) = best?;
        let parameters = free.parameters(from, end.unknowns.as_slice());
        let numbers = free.about_origin(from, end.unknowns.as_slice()).parameters();
        let written = self.side.inertials[link].unwrap_or_else(Inertial::nothing);
        let effect = block * (crate::side::inertial::TenNumbers::from(numbers) - written.ten_numbers());
        let corrected = Corrected { links: vec![(link, parameters)], ..Corrected::default() };
        Some(Effect { corrected, torque: effect, rank: end.rank })
    }

    /// Where fits start: linear ones anywhere.
    fn starts(
        &self,
        block: &DMatrix<f64>,
        target: &DVector<f64>,
        from: &Inertial,
        free: Free,
    ) -> Vec<(Free, DVector<f64>)> {
        let zeros = DVector::zeros(free.count());
        let linear = |free: Free| self.descend(block, target, (from, free), DVector::zeros(free.count()));
        match free {
            Free::Payload => {
                let all = linear(Free::Inertial).unknowns;
                let mass = all[9];
                let places = [Vector3::new(all[6], all[7], all[8]) / mass, from.com_m, Vector3::zeros()];
                let usable = places.into_iter().filter(|place| mass != 0.0 && place.norm() < f64::MAX);
                usable.map(|p| (free, DVector::from_vec(vec![mass, p.x, p.y, p.z]))).collect()
            }
            Free::Rotation(_) => {
                let fitted = linear(Free::Inertia);
                if fitted.left > self.exact {
                    return Vec::new();
                }
                let tensor = Free::Inertia.parameters(from, fitted.unknowns.as_slice()).tensor_in_link();
                turns_onto(&from.tensor_in_link(), &tensor)
                    .into_iter()
                    .chain(SKEW_STARTS_RAD.map(|turn| rotation_exp(&Vector3::from(turn))))
                    .map(|turn| (Free::Rotation(turn), zeros.clone()))
                    .collect()
            }
            // A shift of the centre of mass is quadratic: where it is zero, its first step has no direction.
            Free::Com | Free::ComEntry(_) => {
                let shifted = |by_m: f64| (free, DVector::repeat(free.count(), by_m));
                vec![(free, zeros), shifted(COM_START_M), shifted(-COM_START_M)]
            }
            Free::Inertia | Free::Inertial => {
                let ball = ball(from, &linear(free).unknowns, free);
                vec![(free, zeros), (free, ball)]
            }
            _ => vec![(free, zeros)],
        }
    }

    /// Steps of Gauss and Newton; what nothing shows stays.
    fn descend(
        &self,
        block: &DMatrix<f64>,
        target: &DVector<f64>,
        (from, free): (&Inertial, Free),
        start: DVector<f64>,
    ) -> Descent {
        let written = from.ten_numbers();
        let rest = |x: &DVector<f64>| {
            let numbers = free.about_origin(from, x.as_slice()).parameters();
            target - block * (crate::side::inertial::TenNumbers::from(numbers) - written)
        };
        let mut residual = rest(&start);
        let mut descent = Descent { left: residual.norm(), unknowns: start, rank: 0 };
        for _ in 0..MAX_STEPS {
            let derivatives = free.derivatives(from, descent.unknowns.as_slice());
            let columns: Vec<DVector<f64>> = derivatives.iter().map(|numbers| block * numbers).collect();
            let step = solve(&DMatrix::from_columns(&columns), &residual, self.torque.scale);
            descent.rank = step.rank;
            let next = &descent.unknowns + &step.unknowns;
            let next_residual = rest(&next);
            let left = next_residual.norm();
            if left.is_nan() || left >= descent.left {
                break;
            }
            let is_last = step.unknowns.norm() <= LAST_STEP * next.norm();
            (descent.unknowns, descent.left, residual) = (next, left, next_residual);
            if is_last {
                break;
            }
        }
        descent
    }

    fn joints(&self, joints: &[JointResistance]) -> Effect {
        let mut effect = DVector::zeros(self.torque.difference.len());
        for term in JointTerm::ALL {
            let changes = joints.iter().zip(&self.side.resistances);
            let change: Vec<f64> = changes.map(|(new, old)| term.of(new) - term.of(old)).collect();
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
        let mut joints = self.side.resistances.clone();
        for (group, change) in groups.iter().zip(solution.unknowns.iter()) {
            for &joint in group {
                let old = term.of(&joints[joint]);
                // What only rounding changes stays, and what is zero but for rounding is zero.
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
        let effect = self.torque.gravity() * (gravity - self.side.gravity_m_s2);
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
        let gravity = self.side.gravity_m_s2 + changes.sum::<Vector3<f64>>();
        let corrected = Corrected { gravity: Some(gravity), ..Corrected::default() };
        Effect { corrected, torque: columns * solution.unknowns, rank: solution.rank }
    }
}

/// Free numbers that make a link a ball with the largest moment of a fit: of few numbers that torque shows the
/// shortest fit is seldom a body.
fn ball(from: &Inertial, fitted: &DVector<f64>, free: Free) -> DVector<f64> {
    let moment = free.about_origin(from, fitted.as_slice()).tensor_kg_m2.amax();
    let mut ball = Inertial { tensor_kg_m2: Matrix3::from_diagonal_element(moment), ..*from };
    if ball.mass_kg <= 0.0 {
        ball.mass_kg = BALL_DENSITY * moment;
    }
    let of = |parameters: &Inertial| match free {
        Free::Inertial => parameters.ten_numbers().iter().copied().collect::<Vec<f64>>(),
        _ => ENTRIES.map(|entry| parameters.tensor_kg_m2[entry]).to_vec(),
    };
    DVector::from_vec(of(&ball)) - DVector::from_vec(of(from))
}

/// Mass of a ball for a unit of its moment, 1/m^2. Kind: choice; a radius of gyration of 0.1 m.
const BALL_DENSITY: f64 = 100.0;

/// Turns that lie square to nothing: a tensor that is turned onto its own axes changes no moment at first.
const SKEW_STARTS_RAD: [[f64; 3]; 2] = [[0.5, 0.4, 0.3], [-0.4, 0.5, -0.3]];

/// Where a fit ends.
struct Descent {
    unknowns: DVector<f64>,
    left: f64,
    rank: usize,
}

/// Turns that lay the principal axes of one tensor onto those of another, in all six orders.
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
        let turn = laid * from.transpose();
        // A reflected axis is the same principal axis.
        turns.push(if turn.determinant() < 0.0 { -turn } else { turn });
    }
    turns
}
