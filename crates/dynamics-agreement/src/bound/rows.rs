//! The coefficients of a joint's torque difference at given positions: gravity, each joint's largest acceleration, each
//! product of two speeds.

use congruent_description::RobotQ;
use congruent_dynamics::{
    BodyTree, DynamicsBuffer, DynamicsError, JointMotionState, JointResistance, SpatialInertia,
};
use nalgebra::{DMatrix, Vector3};

use super::{
    bracket::{AttainedAt, CoveredMotion, covered_motions},
    dependency::JointDependency,
    function::speeds::{entries, row},
};
use crate::{model::DynamicsModel, thresholds::SAME_VALUE};

/// A part of the torque difference that has its own certificate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum TorquePart {
    /// The torque of accelerations, armature included.
    Inertia,
    /// The torque of products of speeds: centrifugal and Coriolis terms.
    Velocity,
    /// The whole torque, with gravity, damping and dry friction.
    Together,
}

/// The torques that are computed together: those of some joints by the motion of some.
#[derive(Debug, Clone, Copy)]
pub(super) struct WantedTorques<'a> {
    /// Joints whose torques are computed.
    pub(super) joints: &'a [usize],
    /// Joints whose speeds and accelerations matter.
    pub(super) moving: &'a [usize],
    /// What of it is needed: the rest is left 0.
    pub(super) part: TorquePart,
}

/// The difference between a candidate and a reference in the candidate's geometry.
pub(super) struct DifferenceRows<'a> {
    pub(super) candidate: &'a DynamicsModel,
    pub(super) dependency: JointDependency<'a>,
    pub(super) covered: Vec<CoveredMotion>,
    /// The whole dynamics of candidate and reference.
    whole: [BodyTree; 2],
    /// Bodies that are the difference of two, and the difference of armature, weightless: torques are linear in both.
    difference: BodyTree,
    /// For each body an upper bound of its part of any entry of the mass matrix.
    pub(super) largest_entries: Vec<f64>,
    /// The same for entries of a sliding joint, and for its force by velocity products per unit of the squared sum of speeds.
    pub(super) largest_forces: Vec<f64>,
    /// Damping, friction and armature at the driven joints: candidate minus reference.
    pub(super) resistances: Vec<JointResistance>,
}

/// Buffers of the torque computations, allocated once.
pub(super) struct Memory {
    buffer: DynamicsBuffer,
    matrix: DMatrix<f64>,
    tau: [Vec<f64>; 2],
    qd: Vec<f64>,
}

impl<'a> DifferenceRows<'a> {
    pub(super) fn new(
        candidate: &'a DynamicsModel,
        reference: &DynamicsModel,
    ) -> Result<Self, DynamicsError> {
        let reach_m = candidate.frames.reach_m.max(1.0);
        let size = |body: &SpatialInertia| {
            let moment = body.first_moment_kg_m.norm();
            // Steiner's terms for a body at the largest distance.
            body.tensor_kg_m2.norm() + 2.0 * moment * reach_m + body.mass_kg.abs() * reach_m * reach_m
        };
        // The origin of a body turns at a distance of at most the reach; 1.5 covers the centripetal and the Coriolis part of
        // its centre of mass.
        let force =
            |body: &SpatialInertia| body.mass_kg.abs() * reach_m + 1.5 * body.first_moment_kg_m.norm();
        let (found, expected) = (candidate.bodies(), reference.bodies());
        let differences: Vec<SpatialInertia> =
            found.iter().zip(&expected).map(|(a, b)| super::gravity::difference(a, b)).collect();
        // 3e-14 of the size, as for gravity: the same parameters, added up in another order, differ by rounding.
        let rounding = SAME_VALUE * SAME_VALUE.sqrt();
        let sizes = found.iter().zip(&expected).map(|(a, b)| size(a).max(size(b)));
        let differs = differences.iter().zip(sizes).map(|(body, of_both)| size(body) > rounding * of_both);
        let dependency = JointDependency::new(&candidate.frames, differs.collect());
        let resistances: Vec<JointResistance> = candidate
            .resistances
            .iter()
            .zip(&reference.resistances)
            .map(|(a, b)| JointResistance {
                damping: a.damping - b.damping,
                friction: a.friction - b.friction,
                armature: a.armature - b.armature,
            })
            .collect();
        // Armature is inertia and belongs to the mass matrix; damping and friction depend on the sign of the
        // speed and are added at the end.
        let armatures = resistances.iter().map(|of| JointResistance { damping: 0.0, friction: 0.0, ..*of });
        let weightless = candidate.frames.tree.clone().with_gravity(Vector3::zeros());
        Ok(Self {
            candidate,
            covered: covered_motions(candidate, reference),
            whole: [candidate.tree(), reference.tree()],
            difference: weightless
                .with_inertias_in_links(&differences)?
                .with_resistances(armatures.collect())?,
            largest_entries: differences.iter().map(size).collect(),
            largest_forces: differences.iter().map(force).collect(),
            resistances: at_driven(&dependency, &resistances),
            dependency,
        })
    }

    pub(super) fn memory(&self) -> Memory {
        let n = self.covered.len();
        let (buffer, matrix) = (self.difference.buffer(), DMatrix::zeros(n, n));
        Memory { buffer, matrix, tau: [vec![0.0; n], vec![0.0; n]], qd: vec![0.0; n] }
    }

    /// For each joint the values of [`MotionCoefficients`](super::function::measure::MotionCoefficients) at one position: gravity, and the
    /// coefficients of accelerations and products of speeds of the joints that move.
    pub(super) fn values(
        &self,
        q: &RobotQ,
        wanted: &WantedTorques<'_>,
        memory: &mut Memory,
    ) -> Result<Vec<f64>, DynamicsError> {
        let moving = wanted.moving.len();
        let mut values = vec![0.0; wanted.joints.len() * (1 + moving + entries(moving))];
        if wanted.part == TorquePart::Together {
            self.fill_gravity(q, wanted, memory, &mut values)?;
        }
        if wanted.part != TorquePart::Velocity {
            self.fill_accelerations(q, wanted, memory, &mut values)?;
        }
        if wanted.part != TorquePart::Inertia {
            self.fill_products(q, wanted, memory, &mut values)?;
        }
        Ok(values)
    }

    fn fill_gravity(
        &self,
        q: &RobotQ,
        WantedTorques { joints, moving, .. }: &WantedTorques<'_>,
        Memory { buffer, tau, .. }: &mut Memory,
        values: &mut [f64],
    ) -> Result<(), DynamicsError> {
        for (tree, tau) in self.whole.iter().zip(tau.iter_mut()) {
            tree.gravity_into(q, buffer, tau)?;
        }
        let count = 1 + moving.len() + entries(moving.len());
        for (&joint, values) in joints.iter().zip(values.chunks_exact_mut(count)) {
            let [found, expected] = [0, 1].map(|model| self.dependency.coupling.torque(joint, &tau[model]));
            values[0] = found - expected;
        }
        Ok(())
    }

    fn fill_accelerations(
        &self,
        q: &RobotQ,
        WantedTorques { joints, moving, .. }: &WantedTorques<'_>,
        Memory { buffer, matrix, .. }: &mut Memory,
        values: &mut [f64],
    ) -> Result<(), DynamicsError> {
        let coupling = &self.dependency.coupling;
        // Torques are linear in the inertial parameters, so one tree with the difference of the bodies gives the
        // difference of the torques: M(q), C(q, qd) of negative masses are well defined here.
        self.difference.mass_matrix_into(q, buffer, matrix)?;
        let count = 1 + moving.len() + entries(moving.len());
        for (&joint, values) in joints.iter().zip(values.chunks_exact_mut(count)) {
            for (&other, value) in moving.iter().zip(&mut values[1..]) {
                let pairs = coupling
                    .group(joint)
                    .iter()
                    .flat_map(|a| coupling.group(other).iter().map(move |b| (a, b)));
                let entry: f64 = pairs.map(|(a, b)| a.1 * b.1 * matrix[(a.0, b.0)]).sum();
                *value = entry * self.covered[other].acceleration;
            }
        }
        Ok(())
    }

    fn fill_products(
        &self,
        q: &RobotQ,
        WantedTorques { joints, moving, .. }: &WantedTorques<'_>,
        Memory { buffer, tau, qd, .. }: &mut Memory,
        values: &mut [f64],
    ) -> Result<(), DynamicsError> {
        let coupling = &self.dependency.coupling;
        let products = moving.len();
        let count = 1 + products + entries(products);
        // Index of the product of two speeds: after gravity and accelerations, upper triangle by rows.
        let place = |first: usize, second: usize| 1 + products + row(products, first) + second;
        // The square of a speed before its mixed products: these are found by subtracting the squares.
        let pairs = (0..products).flat_map(|first| (0..=first).rev().map(move |second| [second, first]));
        for pair in pairs {
            qd.fill(0.0);
            for at in pair {
                qd[moving[at]] = self.covered[moving[at]].speed;
            }
            coupling.set_follower_rates(qd);
            self.difference.bias_into(q, qd, buffer, &mut tau[0])?;
            // The bias of both speeds together is a x^2 + b x y + c y^2: the squares are known, so b x y is the rest.
            let squares = if pair[0] == pair[1] { &[][..] } else { &pair[..] };
            for (&joint, values) in joints.iter().zip(values.chunks_exact_mut(count)) {
                let known: f64 = squares.iter().map(|&at| values[place(at, at)]).sum();
                values[place(pair[0], pair[1])] = coupling.torque(joint, &tau[0]) - known;
            }
        }
        Ok(())
    }

    /// The torque difference at a driven joint by accelerations and velocity products, without gravity, damping and friction.
    pub(super) fn part(&self, joint: usize, at: &AttainedAt) -> Result<f64, DynamicsError> {
        let mut tau = vec![0.0; at.qd.len()];
        let motion = JointMotionState { q: &at.q, qd: &at.qd, qdd: &at.qdd };
        self.difference.inverse_into(&motion, &mut self.difference.buffer(), &mut tau)?;
        Ok(self.dependency.coupling.torque(joint, &tau))
    }

    /// The difference of the whole torque at a driven joint.
    pub(super) fn together(&self, joint: usize, at: &AttainedAt) -> Result<f64, DynamicsError> {
        let mut tau = [vec![0.0; at.qd.len()], vec![0.0; at.qd.len()]];
        let motion = JointMotionState { q: &at.q, qd: &at.qd, qdd: &at.qdd };
        for (tree, tau) in self.whole.iter().zip(&mut tau) {
            tree.inverse_into(&motion, &mut tree.buffer(), tau)?;
        }
        let [found, expected] = tau.map(|tau| self.dependency.coupling.torque(joint, &tau));
        Ok(found - expected)
    }

    /// The largest torque of damping and dry friction over all speeds of the joint.
    pub(super) fn resistance(&self, joint: usize) -> f64 {
        let of = &self.resistances[joint];
        // Linear in the speed, so the largest absolute value is at one end: just above rest, or at the limit.
        of.friction.abs().max((of.friction + of.damping * self.covered[joint].speed).abs())
    }
}

/// Damping, friction and armature at the driven joints, those of followers included.
fn at_driven(dependency: &JointDependency<'_>, own: &[JointResistance]) -> Vec<JointResistance> {
    let sum = |joint: usize| {
        let mut sum = JointResistance::default();
        for (of, ratio) in dependency.coupling.group(joint) {
            // Friction opposes the motion whatever its direction: |ratio|. Damping and armature are quadratic in
            // the ratio: once for the speed of the follower, once for its torque at the master.
            sum.friction += ratio.abs() * own[*of].friction;
            sum.damping += ratio * ratio * own[*of].damping;
            sum.armature += ratio * ratio * own[*of].armature;
        }
        sum
    };
    (0..own.len()).map(sum).collect()
}
