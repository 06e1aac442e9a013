//! The largest torque differences by accelerations, by velocity products and by a whole motion: attained from below,
//! certified from above.

use congruent_description::RobotQ;
use congruent_dynamics::DynamicsError;
use congruent_kinematics::Uniform;

use super::{
    bracket::{AttainedAt, CoveredMotion, TorqueBracket, TorqueCertificate},
    function::{
        branch::{SearchLimits, upper_bound},
        local_search::{self, SectionedFunction},
        measure::{LargestMotion, MotionCoefficients, ValueMeasure},
        one_by_one::{FEWEST_BOXES, one_by_one},
        trigonometric::{Trigonometric, along},
    },
    gravity::GravityTorques,
    rows::{DifferenceRows, TorquePart, WantedTorques},
    variable_group::VariableGroup,
};
use crate::{
    model::DynamicsModel,
    thresholds::{CLOSED_SUM, MAX_BOXES, MAX_MOTION_VALUES, NO_COEFFICIENT},
    torque::states::position,
};

/// The certificates of all parts of the torque, and the motion that they cover.
pub(crate) struct Certified {
    pub(crate) gravity: TorqueCertificate,
    pub(crate) inertia: TorqueCertificate,
    pub(crate) velocity: TorqueCertificate,
    pub(crate) together: TorqueCertificate,
    pub(crate) covered: Vec<CoveredMotion>,
}

/// Brackets the torque differences between a candidate and a reference in the candidate's geometry.
pub(crate) fn certify(
    candidate: &DynamicsModel,
    reference: &DynamicsModel,
    seed: u64,
) -> Result<Certified, DynamicsError> {
    let gravity_torques = GravityTorques::new(candidate, reference);
    // Gravity first: its certificate is a summand of the bound of the whole motion.
    let gravity = gravity_torques.certify(seed)?;
    let motions = Motions { rows: DifferenceRows::new(candidate, reference)?, seed };
    let mut by_joint: Vec<(usize, [Option<TorqueBracket>; 3])> = Vec::new();
    for variable_group in VariableGroup::all(&motions.rows, &gravity_torques)? {
        let function =
            if variable_group.is_tractable { Some(motions.function(&variable_group)?) } else { None };
        let of_joint = |at: usize| {
            let joint = variable_group.joints[at];
            let name = candidate.frames.joint_name(joint);
            let of_gravity = gravity.by_joint.iter().find(|bracket| bracket.joint == name);
            let one = OneJoint {
                motions: &motions,
                variable_group: &variable_group,
                function: function.as_ref(),
                at,
            };
            Ok((joint, one.brackets(of_gravity)?))
        };
        by_joint.extend(side_by_side(variable_group.joints.len(), of_joint)?);
    }
    // Joints were grouped by what they depend on; the report has them in the order of the chain.
    by_joint.sort_by_key(|(joint, _)| *joint);
    let [inertia, velocity, together] = [0, 1, 2].map(|part| {
        TorqueCertificate::from_brackets(
            by_joint.iter().filter_map(|(_, parts)| parts[part].clone()).collect(),
        )
    });
    Ok(Certified { gravity, inertia, velocity, together, covered: motions.rows.covered })
}

/// The results of several joints in their order, each computed in a thread of its own: a long arm takes seconds.
fn side_by_side<T: Send, E: Send>(
    count: usize,
    result_of: impl Fn(usize) -> Result<T, E> + Sync,
) -> Result<Vec<T>, E> {
    std::thread::scope(|scope| {
        let result_of = &result_of;
        // Collected before joining: a lazy iterator would run one thread after the other.
        let running: Vec<_> = (0..count).map(|at| scope.spawn(move || result_of(at))).collect();
        running
            .into_iter()
            .map(|one| one.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
            .collect()
    })
}

struct Motions<'a> {
    rows: DifferenceRows<'a>,
    seed: u64,
}

impl Motions<'_> {
    /// The function with all values of the joints of one group.
    fn function(&self, variable_group: &VariableGroup) -> Result<Trigonometric, DynamicsError> {
        let places: Vec<usize> = variable_group.positions.iter().map(|(joint, _)| *joint).collect();
        let mut variables = self.rows.dependency.variables(&places);
        for (variable, (_, degree)) in variables.iter_mut().zip(&variable_group.positions) {
            variable.degree = *degree;
        }
        let (mut memory, mut error) = (self.rows.memory(), Ok(()));
        let mut q = RobotQ::zeros(self.rows.covered.len());
        let count = variable_group.joints.len() * variable_group.values();
        let function = Trigonometric::sampled(variables, count, ValueMeasure::Sum, |positions| {
            places.iter().zip(positions).for_each(|(&joint, &position)| q[joint] = position);
            let wanted = variable_group.wanted(TorquePart::Together);
            self.rows.values(&q, &wanted, &mut memory).unwrap_or_else(|found| {
                error = Err(found);
                vec![0.0; count]
            })
        });
        error.map(|()| function)
    }

    /// Zero, or the nearest limit, of each joint; at rest.
    fn somewhere(&self) -> AttainedAt {
        let ranges = self.rows.covered.iter().map(|covered| (covered.lower, covered.upper));
        // Joints that do not matter stay at zero, or at the limit nearest to it: a position that is easy to read.
        let mut at = AttainedAt::rest(ranges.map(|(lower, upper)| 0.0_f64.clamp(lower, upper)).collect());
        self.rows.dependency.coupling.follow(&mut at);
        at
    }

    /// The motion with the largest torque difference, each recomputed by inverse dynamics: an attained value does not depend on
    /// the coefficients.
    fn best(
        &self,
        part: TorquePart,
        joint: usize,
        motions: Vec<AttainedAt>,
    ) -> Result<(f64, AttainedAt), DynamicsError> {
        // Below every absolute value, so that a motion is reported even if all torques are zero.
        let mut best = (-1.0, self.somewhere());
        for mut at in motions {
            self.rows.dependency.coupling.follow(&mut at);
            let torque = match part {
                TorquePart::Together => self.rows.together(joint, &at)?,
                TorquePart::Inertia | TorquePart::Velocity => self.rows.part(joint, &at)?,
            };
            if torque.abs() > best.0 {
                best = (torque.abs(), at);
            }
        }
        Ok(best)
    }

    /// A bound without a search: every body at the largest possible distance.
    fn crude(&self, part: TorquePart, joint: usize) -> f64 {
        let dependency = &self.rows.dependency;
        // A body turns at most as fast as the sum of all joint speeds; centrifugal and Coriolis terms together are at most
        // twice the square of this sum.
        let of_products = |of: usize| if dependency.frames.joints[of].is_angular { 2.0 } else { 1.0 };
        let entries = |of: usize| -> f64 {
            let turns = dependency.frames.joints[of].is_angular;
            let most = if turns { &self.rows.largest_entries } else { &self.rows.largest_forces };
            let bodies = (0..dependency.differs.len())
                .filter(|&body| dependency.differs[body] && dependency.carries(of, body));
            bodies.map(|body| most[body]).sum()
        };
        let group = dependency.coupling.group(joint).iter();
        let sum = |factor: &dyn Fn(usize) -> f64| -> f64 {
            group.clone().map(|(of, ratio)| ratio.abs() * factor(*of) * entries(*of)).sum()
        };
        let covered = &self.rows.covered;
        let armature = self.rows.resistances[joint].armature.abs() * covered[joint].acceleration;
        // Only these joints move bodies that this joint carries.
        let moving = dependency.through(joint);
        let accelerations: f64 = moving.iter().map(|&joint| covered[joint].acceleration).sum();
        let speeds: f64 = moving.iter().map(|&joint| covered[joint].speed).sum();
        match part {
            TorquePart::Inertia => sum(&|_| 1.0) * accelerations + armature,
            TorquePart::Velocity => sum(&of_products) * speeds * speeds,
            TorquePart::Together => f64::INFINITY,
        }
    }
}

/// One joint of a group with the same variables.
struct OneJoint<'a> {
    motions: &'a Motions<'a>,
    variable_group: &'a VariableGroup,
    /// The function of all its values; `None` if it has too many coefficients.
    function: Option<&'a Trigonometric>,
    at: usize,
}

impl OneJoint<'_> {
    /// The brackets of inertia, velocity products and the whole torque.
    fn brackets(&self, gravity: Option<&TorqueBracket>) -> Result<[Option<TorqueBracket>; 3], DynamicsError> {
        let inertia = self.bracket(TorquePart::Inertia, f64::INFINITY)?;
        let velocity = self.bracket(TorquePart::Velocity, f64::INFINITY)?;
        let parts = [gravity, inertia.as_ref(), velocity.as_ref()].into_iter().flatten();
        // The triangle inequality: the whole is at most the sum of its certified parts.
        let known = parts.map(|bracket| bracket.certified_n_m).sum::<f64>()
            + self.motions.rows.resistance(self.variable_group.joints[self.at]);
        let together = self.bracket(TorquePart::Together, known)?;
        Ok([inertia, velocity, together])
    }

    /// The bracket of one part; `None` if the joint has no difference. `known` is an upper bound that is known already.
    fn bracket(&self, part: TorquePart, known: f64) -> Result<Option<TorqueBracket>, DynamicsError> {
        let (joint, motions) = (self.variable_group.joints[self.at], self.motions);
        let crude = known.min(motions.crude(part, joint));
        if crude <= 0.0 {
            return Ok(None);
        }
        // Far below the crude bound: inertias cancel, and the remainder is rounding.
        let is_rounding = |certified: f64| certified <= NO_COEFFICIENT * crude && crude.is_finite();
        let report = |(attained, at): (f64, AttainedAt), certified: f64, boxes: usize| {
            let bracket = [attained, certified];
            Ok((!is_rounding(certified))
                .then(|| TorqueBracket::new(motions.rows.candidate, joint, bracket, at, boxes)))
        };
        let Some(function) = self.function else {
            return report(motions.best(part, joint, self.random_motions(part))?, crude, 0);
        };
        let motion = self.variable_group.motion(part, motions.rows.resistance(joint));
        let values = self.variable_group.values_of(part, self.at);
        let function = function.selected(values, ValueMeasure::Motion(motion));
        let amplitudes = function.sum_of_amplitudes() + motion.resistance;
        // Before the search, which would take as long for rounding as for a difference.
        if is_rounding(amplitudes) {
            return Ok(None);
        }
        let positions = self.local_maximum(part, &function)?;
        let largest = motion.largest(&function.at(&positions));
        let candidates = self.candidates(&motion, &function, &positions, &largest);
        let attained = motions.best(part, joint, candidates)?;
        let stop = SearchLimits {
            below: attained.0 * (1.0 + CLOSED_SUM),
            boxes: MAX_BOXES,
            control_values: MAX_MOTION_VALUES,
        };
        // Amplitudes cost one pass; boxes are divided only if this is too wide.
        let crude = crude.min(amplitudes);
        if crude <= stop.below {
            return report(attained, crude, 0);
        }
        let (mut certified, mut boxes) = (crude, 0);
        // Fewer boxes than this cannot beat the amplitudes, so the effort would be wasted.
        if function.control_values() <= MAX_MOTION_VALUES / FEWEST_BOXES {
            let bound = upper_bound(&function, stop);
            (certified, boxes) = (bound.value.min(crude), bound.boxes);
        }
        // One value at a time has far fewer variables. Not for the whole motion, whose bound by its parts
        // contains this already.
        if certified > stop.below && part != TorquePart::Together {
            let apart = one_by_one(&function);
            certified = certified.min(apart.value);
            boxes += apart.boxes;
        }
        report(attained, certified, boxes)
    }

    /// What is computed for a part of this joint's torque.
    fn wanted(&self, part: TorquePart) -> WantedTorques<'_> {
        let joints = &self.variable_group.joints[self.at..=self.at];
        WantedTorques { joints, ..self.variable_group.wanted(part) }
    }

    /// Positions with the largest torque that a coordinate search finds.
    fn local_maximum(&self, part: TorquePart, function: &Trigonometric) -> Result<Vec<f64>, DynamicsError> {
        let (motions, variable_group) = (self.motions, self.variable_group);
        let (mut memory, mut error) = (motions.rows.memory(), Ok(()));
        let mut at_q = motions.somewhere().q;
        let values = variable_group.values_of(part, 0);
        let along_variable = |at: usize, q: &[f64]| {
            for (variable, position) in function.variables.iter().zip(q) {
                at_q[variable.joint] = *position;
            }
            let variable = &function.variables[at];
            let mut sampled = Vec::with_capacity(variable.size() * function.values);
            for position in variable.samples() {
                at_q[variable.joint] = position;
                match motions.rows.values(&at_q, &self.wanted(part), &mut memory) {
                    Ok(all) => sampled.extend_from_slice(&all[values.clone()]),
                    Err(found) => {
                        error = Err(found);
                        sampled.resize(sampled.len() + values.len(), 0.0);
                    }
                }
            }
            along(&sampled, &mut [variable.size(), function.values], 0, &variable.coefficient_rows())
        };
        let sectioned =
            SectionedFunction { variables: &function.variables, measure: function.measure, along_variable };
        let (_, positions) = local_search::largest_sampled(sectioned, motions.seed);
        error?;
        self.followed(part, function, positions)
    }

    /// Positions that the robot can reach, searched from positions at which followers were free.
    fn followed(
        &self,
        part: TorquePart,
        function: &Trigonometric,
        positions: Vec<f64>,
    ) -> Result<Vec<f64>, DynamicsError> {
        let (rows, coupling) = (&self.motions.rows, &self.motions.rows.dependency.coupling);
        let places: Vec<usize> = function.variables.iter().map(|variable| variable.joint).collect();
        if !places.iter().any(|&place| coupling.is_coupled(place)) {
            return Ok(positions);
        }
        let mut q = self.motions.somewhere().q;
        places.iter().zip(&positions).for_each(|(&place, position)| q[place] = *position);
        let mut memory = rows.memory();
        let values = self.variable_group.values_of(part, 0);
        coupling.search(&mut q, &places, |q| {
            let all = rows.values(q, &self.wanted(part), &mut memory)?;
            Ok(function.measure.value(&all[values.clone()]))
        })?;
        Ok(places.iter().map(|&place| q[place]).collect())
    }

    /// Candidate motions of the largest torque: both directions of all speeds, and the joint's own speed small or large,
    /// since dry friction depends on its sign alone.
    fn candidates(
        &self,
        motion: &MotionCoefficients,
        function: &Trigonometric,
        positions: &[f64],
        largest: &LargestMotion,
    ) -> Vec<AttainedAt> {
        let covered = &self.motions.rows.covered;
        let (joint, moving) = (self.variable_group.joints[self.at], &self.variable_group.moving);
        let mut at = self.motions.somewhere();
        for (variable, position) in function.variables.iter().zip(positions) {
            at.q[variable.joint] = *position;
        }
        let places: Vec<usize> = function.variables.iter().map(|variable| variable.joint).collect();
        self.motions.rows.dependency.coupling.place_masters(&mut at.q, &places);
        for (&joint, share) in moving.iter().zip(&largest.accelerations) {
            at.qdd[joint] = share * covered[joint].acceleration;
        }
        for (&joint, share) in moving.iter().zip(&largest.speeds) {
            at.qd[joint] = share * covered[joint].speed;
        }
        let mut all = vec![at];
        if motion.resistance > 0.0 {
            // Friction acts fully at any speed, damping at the largest: if they have opposite signs, a slow
            // motion has the larger difference.
            for speed in [covered[joint].speed, covered[joint].speed * SLOW] {
                let mut other = all[0].clone();
                other.qd[joint] = speed.copysign(other.qd[joint]);
                all.push(other);
            }
            let reversed = |at: &AttainedAt| {
                let qd = at.qd.iter().map(|speed| -speed).collect();
                AttainedAt { qd, ..at.clone() }
            };
            all.extend(all.iter().map(reversed).collect::<Vec<_>>());
        }
        all
    }

    /// Random motions at the limits of speed and acceleration, for a torque of too many joints.
    fn random_motions(&self, part: TorquePart) -> Vec<AttainedAt> {
        let rows = &self.motions.rows;
        let mut random = Uniform::seeded(self.motions.seed);
        let mut motion = || {
            let mut at = AttainedAt::rest(position(&mut random, rows.dependency.frames));
            for &joint in &self.variable_group.moving {
                let covered = &rows.covered[joint];
                if part != TorquePart::Velocity {
                    at.qdd[joint] = covered.acceleration * random.between(-1.0, 1.0).signum();
                }
                if part != TorquePart::Inertia {
                    at.qd[joint] = covered.speed * random.between(-1.0, 1.0).signum();
                }
            }
            at
        };
        (0..SAMPLES).map(|_| motion()).collect()
    }
}

/// Random motions for a torque with too many coefficients. Kind: choice.
const SAMPLES: usize = 2_000;
/// A speed at which damping is negligible against dry friction, as a share of the limit. No unit; kind: choice.
const SLOW: f64 = 1e-6;
