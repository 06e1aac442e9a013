//! The largest differences of torque by acceleration, by velocity products and by a whole motion: attained, and
//! certified from above.

use congruent_description::RobotQ;
use congruent_dynamics::DynamicsError;
use congruent_kinematics::Uniform;

use super::{
    bracket::{AttainedAt, CoveredMotion, TorqueBracket, TorqueCertificate},
    dependence::{Dependence, Part},
    function::{
        branch::{Stop, UpperBound, upper_bound},
        climb::{self, Course},
        measure::{LargestMotion, Measure, Motion},
        trigonometric::{Trigonometric, Variable, along},
    },
    gravity::GravityTorques,
    rows::Rows,
};
use crate::{
    side::Side,
    thresholds::{CLOSED_SUM, MAX_BOXES, MAX_MOTION_VALUES, NO_COEFFICIENT},
    torque::states::position,
};

/// Brackets of all parts.
pub(crate) struct Certified {
    pub(crate) gravity: TorqueCertificate,
    pub(crate) inertia: TorqueCertificate,
    pub(crate) velocity: TorqueCertificate,
    pub(crate) together: TorqueCertificate,
    pub(crate) covered: Vec<CoveredMotion>,
}

/// Brackets the differences of torque between a candidate and a reference in the candidate's geometry.
pub(crate) fn certify(candidate: &Side, reference: &Side, seed: u64) -> Result<Certified, DynamicsError> {
    let gravity_torques = GravityTorques::new(candidate, reference);
    let gravity = gravity_torques.certify(seed)?;
    let motions = Motions { rows: Rows::new(candidate, reference)?, seed };
    let mut by_joint: Vec<(usize, [Option<TorqueBracket>; 3])> = Vec::new();
    for dependence in Dependence::all(&motions.rows, &gravity_torques)? {
        let function = if dependence.is_tractable { Some(motions.function(&dependence)?) } else { None };
        let of_joint = |at: usize| {
            let joint = dependence.joints[at];
            let name = candidate.frames.joint_name(joint);
            let of_gravity = gravity.by_joint.iter().find(|bracket| bracket.joint == name);
            let one =
                OneJoint { motions: &motions, dependence: &dependence, function: function.as_ref(), at };
            Ok((joint, one.brackets(of_gravity)?))
        };
        by_joint.extend(side_by_side(dependence.joints.len(), of_joint)?);
    }
    by_joint.sort_by_key(|(joint, _)| *joint);
    let [inertia, velocity, together] = [0, 1, 2].map(|part| {
        TorqueCertificate::of(by_joint.iter().filter_map(|(_, parts)| parts[part].clone()).collect())
    });
    Ok(Certified { gravity, inertia, velocity, together, covered: motions.rows.covered })
}

/// What each of some joints has, in their order, each in a thread of its own: seconds of a long arm.
fn side_by_side<T: Send, E: Send>(
    count: usize,
    of_one: impl Fn(usize) -> Result<T, E> + Sync,
) -> Result<Vec<T>, E> {
    std::thread::scope(|scope| {
        let of_one = &of_one;
        let running: Vec<_> = (0..count).map(|at| scope.spawn(move || of_one(at))).collect();
        running
            .into_iter()
            .map(|one| one.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
            .collect()
    })
}

struct Motions<'a> {
    rows: Rows<'a>,
    seed: u64,
}

impl Motions<'_> {
    /// All values of all joints that depend on the same.
    fn function(&self, dependence: &Dependence) -> Result<Trigonometric, DynamicsError> {
        let places: Vec<usize> = dependence.positions.iter().map(|(joint, _)| *joint).collect();
        let mut variables = self.rows.ways.variables(&places);
        for (variable, (_, degree)) in variables.iter_mut().zip(&dependence.positions) {
            variable.degree = *degree;
        }
        let mut memory = self.rows.memory();
        let mut error = Ok(());
        let mut q = RobotQ::zeros(self.rows.covered.len());
        let count = dependence.joints.len() * dependence.values();
        let function = Trigonometric::sampled(variables, (count, Measure::Sum), |positions| {
            places.iter().zip(positions).for_each(|(&joint, &position)| q[joint] = position);
            let moving = (&dependence.joints[..], &dependence.moving[..]);
            self.rows.values(&q, moving, &mut memory).unwrap_or_else(|found| {
                error = Err(found);
                vec![0.0; count]
            })
        });
        error.map(|()| function)
    }

    /// The middle of all ranges, at rest.
    fn somewhere(&self) -> AttainedAt {
        let ranges = self.rows.covered.iter().map(|covered| (covered.lower, covered.upper));
        let mut at = AttainedAt::rest(ranges.map(|(lower, upper)| 0.0_f64.clamp(lower, upper)).collect());
        self.rows.ways.coupling.follow(&mut at);
        at
    }

    /// The motion with the largest torque, which is computed by the algorithm of inverse dynamics.
    fn best(
        &self,
        (part, joint): (Part, usize),
        motions: Vec<AttainedAt>,
    ) -> Result<(f64, AttainedAt), DynamicsError> {
        let mut best = (-1.0, self.somewhere());
        for mut at in motions {
            self.rows.ways.coupling.follow(&mut at);
            let torque = match part {
                Part::Together => self.rows.together(joint, &at)?,
                Part::Inertia | Part::Velocity => self.rows.part(joint, &at)?,
            };
            if torque.abs() > best.0 {
                best = (torque.abs(), at);
            }
        }
        Ok(best)
    }

    /// A bound that needs no search: every lever stretched out.
    fn crude(&self, part: Part, joint: usize) -> f64 {
        let ways = &self.rows.ways;
        // A body turns no faster than all joints together, and no velocity product is larger than twice its square.
        let of_products = |of: usize| if ways.frames.joints[of].is_angular { 2.0 } else { 1.0 };
        let entries = |of: usize| -> f64 {
            let turns = ways.frames.joints[of].is_angular;
            let most = if turns { &self.rows.largest_entries } else { &self.rows.largest_forces };
            let bodies = (0..ways.differs.len()).filter(|&body| ways.differs[body] && ways.carries(of, body));
            bodies.map(|body| most[body]).sum()
        };
        let group = ways.coupling.group(joint).iter();
        let sum = |factor: &dyn Fn(usize) -> f64| -> f64 {
            group.clone().map(|(of, ratio)| ratio.abs() * factor(*of) * entries(*of)).sum()
        };
        let covered = &self.rows.covered;
        let armature = self.rows.resistances[joint].armature.abs() * covered[joint].acceleration;
        // Other joints move no body that moves with this one.
        let moving = ways.through(joint);
        let accelerations: f64 = moving.iter().map(|&joint| covered[joint].acceleration).sum();
        let speeds: f64 = moving.iter().map(|&joint| covered[joint].speed).sum();
        match part {
            Part::Inertia => sum(&|_| 1.0) * accelerations + armature,
            Part::Velocity => sum(&of_products) * speeds * speeds,
            Part::Together => f64::INFINITY,
        }
    }
}

/// One joint of those that depend on the same.
struct OneJoint<'a> {
    motions: &'a Motions<'a>,
    dependence: &'a Dependence,
    /// `None` if it has too many coefficients.
    function: Option<&'a Trigonometric>,
    at: usize,
}

impl OneJoint<'_> {
    /// Inertia, velocity, together.
    fn brackets(&self, gravity: Option<&TorqueBracket>) -> Result<[Option<TorqueBracket>; 3], DynamicsError> {
        let inertia = self.bracket(Part::Inertia, f64::INFINITY)?;
        let velocity = self.bracket(Part::Velocity, f64::INFINITY)?;
        let parts = [gravity, inertia.as_ref(), velocity.as_ref()].into_iter().flatten();
        let known = parts.map(|bracket| bracket.certified_n_m).sum::<f64>()
            + self.motions.rows.resistance(self.dependence.joints[self.at]);
        let together = self.bracket(Part::Together, known)?;
        Ok([inertia, velocity, together])
    }

    /// `None` if the joint has no difference; `known` is a bound of it from elsewhere.
    fn bracket(&self, part: Part, known: f64) -> Result<Option<TorqueBracket>, DynamicsError> {
        let (joint, motions) = (self.dependence.joints[self.at], self.motions);
        let crude = known.min(motions.crude(part, joint));
        if crude <= 0.0 {
            return Ok(None);
        }
        let report = |(attained, at): (f64, AttainedAt), certified: f64, boxes: usize| {
            // What is left of a sum that cancels is rounding.
            let is_rounding = certified <= NO_COEFFICIENT * crude && crude.is_finite();
            let bracket = [attained, certified];
            Ok((!is_rounding)
                .then(|| TorqueBracket::new(motions.rows.candidate, joint, bracket, (at, boxes))))
        };
        let Some(function) = self.function else {
            return report(motions.best((part, joint), self.random_motions(part))?, crude, 0);
        };
        let motion = self.dependence.motion(part, motions.rows.resistance(joint));
        let values = self.dependence.values_of(part, self.at);
        let function = function.selected(values, Measure::Motion(motion));
        let positions = self.climbed(part, &function)?;
        let largest = motion.largest(&function.at(&positions));
        let candidates = self.candidates(&motion, (&function, &positions), &largest);
        let attained = motions.best((part, joint), candidates)?;
        let stop = Stop {
            below: attained.0 * (1.0 + CLOSED_SUM),
            boxes: MAX_BOXES,
            control_values: MAX_MOTION_VALUES,
        };
        let crude = crude.min(function.sum_of_amplitudes() + motion.resistance);
        if crude <= stop.below {
            return report(attained, crude, 0);
        }
        let (mut certified, mut boxes) = (crude, 0);
        if function.control_values() <= MAX_MOTION_VALUES / FEWEST_BOXES {
            let bound = upper_bound(&function, stop);
            (certified, boxes) = (bound.value.min(crude), bound.boxes);
        }
        if certified > stop.below && part != Part::Together {
            let apart = one_by_one(&function);
            certified = certified.min(apart.value);
            boxes += apart.boxes;
        }
        report(attained, certified, boxes)
    }

    /// Positions with a torque that is as large as climbing finds.
    fn climbed(&self, part: Part, function: &Trigonometric) -> Result<Vec<f64>, DynamicsError> {
        let (motions, dependence) = (self.motions, self.dependence);
        let mut memory = motions.rows.memory();
        let mut at_q = motions.somewhere().q;
        let mut error = Ok(());
        let values = dependence.values_of(part, 0);
        let of_one = |at: usize, q: &[f64]| {
            for (variable, position) in function.variables.iter().zip(q) {
                at_q[variable.joint] = *position;
            }
            let variable = &function.variables[at];
            let mut sampled = Vec::with_capacity(variable.size() * function.values);
            for position in variable.samples() {
                at_q[variable.joint] = position;
                let moving = (&dependence.joints[self.at..=self.at], &dependence.moving[..]);
                match motions.rows.values(&at_q, moving, &mut memory) {
                    Ok(all) => sampled.extend_from_slice(&all[values.clone()]),
                    Err(found) => {
                        error = Err(found);
                        sampled.resize(sampled.len() + values.len(), 0.0);
                    }
                }
            }
            along(&sampled, (&mut [variable.size()], function.values), 0, &variable.coefficient_rows())
        };
        let course = Course { variables: &function.variables, measure: function.measure, of_one };
        let (_, positions) = climb::largest_sampled(course, motions.seed);
        error?;
        self.followed((part, function), positions)
    }

    /// Positions that the robot can take, climbed to from those of a function whose joints do not follow each other.
    fn followed(
        &self,
        (part, function): (Part, &Trigonometric),
        positions: Vec<f64>,
    ) -> Result<Vec<f64>, DynamicsError> {
        let (rows, coupling) = (&self.motions.rows, &self.motions.rows.ways.coupling);
        let places: Vec<usize> = function.variables.iter().map(|variable| variable.joint).collect();
        if !places.iter().any(|&place| coupling.is_coupled(place)) {
            return Ok(positions);
        }
        let mut q = self.motions.somewhere().q;
        places.iter().zip(&positions).for_each(|(&place, position)| q[place] = *position);
        let mut memory = rows.memory();
        let values = self.dependence.values_of(part, 0);
        let moving = (&self.dependence.joints[self.at..=self.at], &self.dependence.moving[..]);
        coupling.climb(&mut q, &places, |q| {
            let all = rows.values(q, moving, &mut memory)?;
            Ok(function.measure.of(&all[values.clone()]))
        })?;
        Ok(places.iter().map(|&place| q[place]).collect())
    }

    /// Motions that may attain the largest torque: speeds either way, and the joint's own as dry friction wants it.
    fn candidates(
        &self,
        motion: &Motion,
        (function, positions): (&Trigonometric, &[f64]),
        largest: &LargestMotion,
    ) -> Vec<AttainedAt> {
        let covered = &self.motions.rows.covered;
        let (joint, moving) = (self.dependence.joints[self.at], &self.dependence.moving);
        let mut at = self.motions.somewhere();
        for (variable, position) in function.variables.iter().zip(positions) {
            at.q[variable.joint] = *position;
        }
        let places: Vec<usize> = function.variables.iter().map(|variable| variable.joint).collect();
        self.motions.rows.ways.coupling.lead(&mut at.q, &places);
        for (&joint, share) in moving.iter().zip(&largest.accelerations) {
            at.qdd[joint] = share * covered[joint].acceleration;
        }
        for (&joint, share) in moving.iter().zip(&largest.speeds) {
            at.qd[joint] = share * covered[joint].speed;
        }
        let mut all = vec![at];
        if motion.resistance > 0.0 {
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

    /// Motions at the limits of speed and acceleration, for a torque of too many joints.
    fn random_motions(&self, part: Part) -> Vec<AttainedAt> {
        let rows = &self.motions.rows;
        let mut random = Uniform::seeded(self.motions.seed);
        let mut motion = || {
            let mut at = AttainedAt::rest(position(&mut random, rows.ways.frames));
            for &joint in &self.dependence.moving {
                let covered = &rows.covered[joint];
                if part != Part::Velocity {
                    at.qdd[joint] = covered.acceleration * random.between((-1.0, 1.0)).signum();
                }
                if part != Part::Inertia {
                    at.qd[joint] = covered.speed * random.between((-1.0, 1.0)).signum();
                }
            }
            at
        };
        (0..SAMPLES).map(|_| motion()).collect()
    }
}

/// A bound of the sum by the largest value of each acceleration and of each product of two speeds: these are not largest
/// at the same positions, but each depends on fewer joints than all together and is one value instead of many.
fn one_by_one(function: &Trigonometric) -> UpperBound {
    let mut sum = UpperBound { value: 0.0, boxes: 0 };
    for at in 0..function.values {
        let one = function.selected(at..at + 1, Measure::Sum);
        let mut bound = UpperBound { value: one.sum_of_amplitudes(), boxes: 0 };
        if one.control_values() <= VALUES_OF_ONE / FEWEST_BOXES {
            let control_values = VALUES_OF_ONE;
            let stop =
                Stop { below: largest_seen(&one) * (1.0 + CLOSED_SUM), boxes: MAX_BOXES, control_values };
            let divided = upper_bound(&one, stop);
            bound = UpperBound { value: divided.value.min(bound.value), boxes: divided.boxes };
        }
        sum.value += bound.value;
        sum.boxes += bound.boxes;
    }
    sum
}

/// The largest of a value that climbing finds from the middle of all ranges and from both ends.
fn largest_seen(one: &Trigonometric) -> f64 {
    let starts = [0.5, 0.25, 0.75].map(|share| {
        let at = |variable: &Variable| variable.lower + share * (variable.upper - variable.lower);
        one.variables.iter().map(at).collect::<Vec<f64>>()
    });
    let climbed = starts.into_iter().map(|q| climb::largest_from(one, q));
    climbed.fold(0.0, f64::max)
}

/// Control values of one acceleration or product of speeds. Kind: speed; some 5 ms.
const VALUES_OF_ONE: usize = MAX_MOTION_VALUES / 12;
/// Where fewer boxes can be divided the sum of amplitudes is the better bound. Kind: choice.
const FEWEST_BOXES: usize = 10;
/// Random motions for a torque of too many joints. Kind: choice.
const SAMPLES: usize = 2_000;
/// A speed at which damping is nothing beside dry friction, as a part of the limit. No unit; kind: choice.
const SLOW: f64 = 1e-6;
