//! The largest difference of gravity torque over all joint positions: attained from below, certified from above.

use congruent_description::RobotQ;
use congruent_dynamics::{BodyTree, DynamicsError, SpatialInertia};
use congruent_kinematics::Uniform;
use nalgebra::Vector3;

use super::{
    bracket::{AttainedAt, TorqueBracket, TorqueCertificate},
    dependency::JointDependency,
    function::{
        branch::{SearchLimits, upper_bound},
        local_search,
        measure::ValueMeasure,
        trigonometric::{Trigonometric, Variable},
    },
};
use crate::{
    model::{DynamicsModel, Frames},
    thresholds::{CLOSED, MAX_BOXES, MAX_CONTROL_VALUES, MAX_VARIABLES, NO_COEFFICIENT, SAME_VALUE},
    torque::states::position,
};

/// Random positions for a torque of more than `MAX_VARIABLES` joints. Kind: choice.
const SAMPLES: usize = 5_000;

/// The difference of gravity torque between a candidate and a reference in the candidate's geometry.
pub(super) struct GravityTorques<'a> {
    frames: &'a Frames,
    candidate: &'a DynamicsModel,
    trees: [BodyTree; 2],
    /// Trees with the difference of the bodies' inertias under unit gravity along each axis; empty if gravity differs.
    along_axes: Vec<BodyTree>,
    gravity_m_s2: f64,
    /// Difference of the inertias of each body, in the frame of its link.
    differences: Vec<SpatialInertia>,
    dependency: JointDependency<'a>,
}

impl<'a> GravityTorques<'a> {
    /// Brackets of all driven joints.
    pub(super) fn certify(&self, seed: u64) -> Result<TorqueCertificate, DynamicsError> {
        // Followers have no torque of their own: theirs is in that of their masters.
        let driven = (0..self.frames.dof()).filter(|&joint| self.dependency.coupling.is_driven(joint));
        let brackets = driven.map(|joint| self.bracket(joint, seed));
        let by_joint: Vec<TorqueBracket> =
            brackets.filter_map(Result::transpose).collect::<Result<_, _>>()?;
        Ok(TorqueCertificate::from_brackets(by_joint))
    }

    /// The joints on whose positions the difference of one joint's torque depends; `None` if it has no difference.
    pub(super) fn joints(&self, joint: usize) -> Result<Option<Vec<usize>>, DynamicsError> {
        let all = self.dependency.through(joint);
        if !self.dependency.has_difference(joint) {
            return Ok(None);
        }
        // Too many to sample: all of them may matter, which is the safe answer.
        if all.len() > MAX_VARIABLES {
            return Ok(Some(all));
        }
        let torque = self.torque(joint, self.dependency.variables(&all))?;
        // `sampled` drops variables without an effect, so these are the joints that really matter.
        Ok(Some(torque.variables.iter().map(|variable| variable.joint).collect()))
    }

    pub(super) fn new(candidate: &'a DynamicsModel, reference: &DynamicsModel) -> Self {
        let same_gravity = candidate.gravity_m_s2 == reference.gravity_m_s2;
        let (found, expected) = (candidate.bodies(), reference.bodies());
        let differences: Vec<SpatialInertia> =
            found.iter().zip(&expected).map(|(a, b)| difference(a, b)).collect();
        // 3e-14 of the value: the same parameters, added up in another order, differ by no more than rounding.
        let rounding = |a: f64, b: f64| SAME_VALUE * SAME_VALUE.sqrt() * a.abs().max(b.abs());
        let differs = differences.iter().zip(found.iter().zip(&expected)).map(|(difference, (a, b))| {
            let [h, k] = [a, b].map(|body| body.first_moment_kg_m.norm());
            !same_gravity
                || difference.mass_kg.abs() > rounding(a.mass_kg, b.mass_kg)
                || difference.first_moment_kg_m.norm() > rounding(h, k)
        });
        let differs = differs.collect();
        let bare = |gravity| candidate.frames.tree.clone().with_gravity(gravity);
        // One tree for each axis: torques under unit gravity along x, y and z are the components of the lever.
        let weightless: Vec<BodyTree> = (0..3)
            // The lever bound factors |g| out, which is possible only if both descriptions have the same gravity.
            .filter(|_| same_gravity)
            .filter_map(|axis| bare(Vector3::ith(axis, 1.0)).with_inertias_in_links(&differences).ok())
            .collect();
        Self {
            frames: &candidate.frames,
            candidate,
            trees: [candidate.tree(), reference.tree()],
            along_axes: weightless,
            gravity_m_s2: candidate.gravity_m_s2.norm(),
            differences,
            dependency: JointDependency::new(&candidate.frames, differs),
        }
    }

    /// The bracket of one joint; `None` if its gravity torques do not differ.
    fn bracket(&self, joint: usize, seed: u64) -> Result<Option<TorqueBracket>, DynamicsError> {
        let below = self.dependency.below(joint);
        let variables = self.dependency.variables(&self.dependency.through(joint));
        if !self.dependency.has_difference(joint) {
            return Ok(None);
        }
        // The bounds come from the cheapest to the dearest, each only if the one before does not close the
        // bracket: crude, lever, torque.
        let crude = self.crude_bound(joint);
        if variables.len() > MAX_VARIABLES {
            let (attained, q) = self.sampled(joint, seed)?;
            return Ok(Some(self.report(joint, [attained, crude], q, 0)));
        }
        let torque = self.torque(joint, variables)?;
        let (mut attained, positions) = local_search::largest(&torque, seed);
        let mut q = RobotQ::zeros(self.frames.dof());
        // Joints that do not matter stay as near to zero as their ranges allow: the reported position is readable.
        for place in 0..q.len() {
            q[place] = q[place].clamp(self.frames.joints[place].range.0, self.frames.joints[place].range.1);
        }
        for (variable, position) in torque.variables.iter().zip(positions) {
            q[variable.joint] = position;
        }
        let places: Vec<usize> = torque.variables.iter().map(|variable| variable.joint).collect();
        // The function treated followers as free, so its maximum may be at a configuration that the robot cannot
        // take.
        if places.iter().any(|&place| self.dependency.coupling.is_coupled(place)) {
            let mut difference = self.difference_at(joint);
            attained = self.dependency.coupling.search(&mut q, &places, |q| difference(q).map(f64::abs))?;
        }
        self.dependency.coupling.place(&mut q);
        // After the search, which needs the function anyway; only then is "no difference" certain.
        if torque.coefficients.iter().all(|value| *value == 0.0) && torque.slack == 0.0 {
            return Ok(None);
        }
        let stop = SearchLimits {
            below: attained * (1.0 + CLOSED),
            boxes: MAX_BOXES,
            control_values: MAX_CONTROL_VALUES,
        };
        let (mut certified, mut boxes) = (crude, 0);
        if let Some(lever) = self.lever(joint, &below)? {
            // The lever depends on the joints below this one alone: fewer variables than the torque, which
            // depends on the joints above as well.
            let stop = SearchLimits { below: stop.below / self.gravity_m_s2, ..stop };
            let bound = upper_bound(&lever, stop);
            certified = certified.min(bound.value * self.gravity_m_s2);
            boxes += bound.boxes;
        }
        // Reached if the joints above cannot turn the lever across gravity, so that its norm is never attained.
        if certified > stop.below {
            let bound = upper_bound(&torque, stop);
            certified = certified.min(bound.value);
            boxes += bound.boxes;
        }
        // Far below the sum of the levers: masses cancel, and the remainder is rounding.
        let is_rounding = certified <= NO_COEFFICIENT * crude && crude.is_finite();
        Ok((!is_rounding).then(|| self.report(joint, [attained, certified], q, boxes)))
    }

    /// The largest difference at random positions, for a torque of more than `MAX_VARIABLES` joints.
    fn sampled(&self, joint: usize, seed: u64) -> Result<(f64, RobotQ), DynamicsError> {
        let mut random = Uniform::seeded(seed);
        let mut best = (0.0, RobotQ::zeros(self.frames.dof()));
        let mut difference_at = self.difference_at(joint);
        for _ in 0..SAMPLES {
            let mut q = position(&mut random, self.frames);
            self.dependency.coupling.place(&mut q);
            let difference = difference_at(&q)?;
            if difference.abs() > best.0 {
                best = (difference.abs(), q);
            }
        }
        Ok(best)
    }

    /// The difference of a driven joint's torque at a position.
    fn difference_at(&self, joint: usize) -> impl FnMut(&RobotQ) -> Result<f64, DynamicsError> {
        let mut buffers = [self.trees[0].buffer(), self.trees[1].buffer()];
        let mut tau = [vec![0.0; self.frames.dof()], vec![0.0; self.frames.dof()]];
        move |q| {
            for ((tree, buffer), tau) in self.trees.iter().zip(&mut buffers).zip(&mut tau) {
                tree.gravity_into(q, buffer, tau)?;
            }
            let [found, expected] = [0, 1].map(|model| self.dependency.coupling.torque(joint, &tau[model]));
            Ok(found - expected)
        }
    }

    fn report(&self, joint: usize, bracket: [f64; 2], q: RobotQ, boxes: usize) -> TorqueBracket {
        TorqueBracket::new(self.candidate, joint, bracket, AttainedAt::rest(q), boxes)
    }

    /// The difference of a joint's gravity torque as a function of these variables.
    fn torque(&self, joint: usize, variables: Vec<Variable>) -> Result<Trigonometric, DynamicsError> {
        let mut error = Ok(());
        let mut difference_at = self.difference_at(joint);
        let joints: Vec<usize> = variables.iter().map(|variable| variable.joint).collect();
        let mut q = RobotQ::zeros(self.frames.dof());
        let function = Trigonometric::sampled(variables, 1, ValueMeasure::Sum, |positions| {
            joints.iter().zip(positions).for_each(|(&joint, &position)| q[joint] = position);
            // The sampler cannot fail, so the first error is kept and returned after it.
            vec![difference_at(&q).unwrap_or_else(|found| {
                error = Err(found);
                0.0
            })]
        });
        error.map(|()| function)
    }

    /// The vector whose dot product with gravity is the torque difference: its norm times |g| bounds the torque for any
    /// orientation of the joints above.
    fn lever(&self, joint: usize, below: &[usize]) -> Result<Option<Trigonometric>, DynamicsError> {
        // The vectors of followers are in other frames and cannot be added.
        if self.along_axes.is_empty() || self.dependency.coupling.is_coupled(joint) {
            return Ok(None);
        }
        let mut error = Ok(());
        let mut buffer = self.trees[0].buffer();
        let mut tau = vec![0.0; self.frames.dof()];
        let mut q = RobotQ::zeros(self.frames.dof());
        let function =
            Trigonometric::sampled(self.dependency.variables(below), 3, ValueMeasure::Length, |positions| {
                below.iter().zip(positions).for_each(|(&joint, &position)| q[joint] = position);
                let mut along = Vec::with_capacity(3);
                for tree in &self.along_axes {
                    if let Err(found) = tree.gravity_into(&q, &mut buffer, &mut tau) {
                        error = Err(found);
                    }
                    along.push(tau[joint]);
                }
                along
            });
        error.map(|()| Some(function))
    }

    /// A bound without a search: every body at the largest possible distance.
    fn crude_bound(&self, joint: usize) -> f64 {
        if self.along_axes.is_empty() {
            return f64::INFINITY;
        }
        let group = self.dependency.coupling.group(joint).iter();
        group.map(|(of, ratio)| ratio.abs() * self.stretched(*of)).sum()
    }

    /// [`GravityTorques::crude_bound`] of one joint without its followers.
    fn stretched(&self, joint: usize) -> f64 {
        let below = |body: &usize| self.dependency.carries(joint, *body);
        let turns = self.frames.joints[joint].is_angular;
        // A body carried by a turning joint is at most the reach away from its axis; a sliding joint carries its
        // weight alone.
        let lever = |body: usize| {
            let difference = &self.differences[body];
            let mass_kg = difference.mass_kg.abs();
            if turns { difference.first_moment_kg_m.norm() + mass_kg * self.frames.reach_m } else { mass_kg }
        };
        (0..self.frames.dof()).filter(below).map(lever).sum::<f64>() * self.gravity_m_s2
    }
}

/// The inertia of one body minus that of another; its mass may be zero or negative.
pub(super) fn difference(a: &SpatialInertia, b: &SpatialInertia) -> SpatialInertia {
    SpatialInertia {
        mass_kg: a.mass_kg - b.mass_kg,
        first_moment_kg_m: a.first_moment_kg_m - b.first_moment_kg_m,
        tensor_kg_m2: a.tensor_kg_m2 - b.tensor_kg_m2,
    }
}
