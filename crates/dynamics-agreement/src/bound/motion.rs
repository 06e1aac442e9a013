//! The largest differences of torque by acceleration, by velocity products and by a whole motion: attained, and
//! certified from above.

use congruent_description::RobotQ;
use congruent_dynamics::DynamicsError;
use congruent_kinematics::Uniform;

use super::{
    bracket::{AttainedAt, TorqueBracket, TorqueCertificate},
    branch::{Stop, upper_bound},
    climb,
    gravity::GravityTorques,
    measure::{LargestMotion, Measure, Motion},
    motion_range::CoveredMotion,
    rows::Rows,
    speeds::MAX_SPEEDS,
    trigonometric::Trigonometric,
};
use crate::{
    side::Side,
    thresholds::{CLOSED_SUM, MAX_BOXES, MAX_COEFFICIENTS, MAX_MOTION_VALUES, NO_COEFFICIENT},
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

/// A part of the torque.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    /// Of accelerations, armature included.
    Inertia,
    /// Of products of speeds.
    Velocity,
    /// All of it, with damping and dry friction.
    Together,
}

/// Brackets the differences of torque between a candidate and a reference in the candidate's geometry.
pub(crate) fn certify(candidate: &Side, reference: &Side, seed: u64) -> Result<Certified, DynamicsError> {
    let gravity_torques = GravityTorques::new(candidate, reference);
    let gravity = gravity_torques.certify(seed)?;
    let motions = Motions { rows: Rows::new(candidate, reference)?, gravity: &gravity_torques, seed };
    let inertia = motions.certify(Part::Inertia, |_| f64::INFINITY)?;
    let velocity = motions.certify(Part::Velocity, |_| f64::INFINITY)?;
    let of_parts = |joint: usize| {
        let name = candidate.frames.joint_name(joint);
        let parts = [&gravity, &inertia, &velocity].map(|part| part.certified(name));
        parts.iter().sum::<f64>() + motions.rows.resistance(joint)
    };
    let together = motions.certify(Part::Together, of_parts)?;
    Ok(Certified { gravity, inertia, velocity, together, covered: motions.rows.covered })
}

struct Motions<'a> {
    rows: Rows<'a>,
    gravity: &'a GravityTorques<'a>,
    seed: u64,
}

/// What one joint's torque depends on.
struct Dependence {
    joint: usize,
    /// Joints whose speeds and accelerations matter.
    moving: Vec<usize>,
    /// Joints whose positions matter, each with the degree of their waves.
    positions: Vec<(usize, usize)>,
    motion: Motion,
}

impl Motions<'_> {
    fn certify(&self, part: Part, known: impl Fn(usize) -> f64) -> Result<TorqueCertificate, DynamicsError> {
        let brackets = (0..self.rows.covered.len()).map(|joint| self.bracket(part, joint, known(joint)));
        let by_joint = brackets.filter_map(Result::transpose).collect::<Result<_, _>>()?;
        Ok(TorqueCertificate::of(by_joint))
    }

    /// `None` if the joint has no difference; `known` is a bound of it from elsewhere.
    fn bracket(&self, part: Part, joint: usize, known: f64) -> Result<Option<TorqueBracket>, DynamicsError> {
        let dependence = self.dependence(part, joint)?;
        let crude = known.min(self.crude(part, joint));
        if crude <= 0.0 {
            return Ok(None);
        }
        if !dependence.is_tractable(&self.rows) {
            let best = self.best(part, joint, self.random_motions(part, &dependence))?;
            return Ok(Some(self.report(joint, [best.0, crude], (best.1, 0))));
        }
        let function = self.function(&dependence)?;
        let is_nothing = function.coefficients.iter().all(|value| *value == 0.0);
        if is_nothing && function.slack == 0.0 && dependence.motion.resistance == 0.0 {
            return Ok(None);
        }
        let (_, positions) = climb::largest_sampled(&function, self.seed);
        let largest = dependence.motion.largest(&function.at(&positions));
        let candidates = self.candidates(&dependence, (&function, &positions), &largest);
        let (attained, at) = self.best(part, joint, candidates)?;
        let stop = Stop {
            below: attained * (1.0 + CLOSED_SUM),
            boxes: MAX_BOXES,
            control_values: MAX_MOTION_VALUES,
        };
        if crude <= stop.below {
            return Ok(Some(self.report(joint, [attained, crude], (at, 0))));
        }
        let bound = upper_bound(&function, stop);
        let certified = bound.value.min(crude);
        // What is left of a sum that cancels is rounding.
        let is_rounding = certified <= NO_COEFFICIENT * crude && crude.is_finite();
        Ok((!is_rounding).then(|| self.report(joint, [attained, certified], (at, bound.boxes))))
    }

    fn report(&self, joint: usize, bracket: [f64; 2], at: (AttainedAt, usize)) -> TorqueBracket {
        TorqueBracket::new(self.rows.candidate, joint, bracket, at)
    }

    fn dependence(&self, part: Part, joint: usize) -> Result<Dependence, DynamicsError> {
        let (ways, frames) = (&self.rows.ways, self.rows.ways.frames);
        let carries = (0..frames.dof()).any(|body| ways.differs[body] && ways.carries(joint, body));
        let moving = if carries { ways.through(joint) } else { vec![joint] };
        let mut positions: Vec<(usize, usize)> = Vec::new();
        if carries {
            // Neither the mass matrix nor its derivatives depend on how the whole robot is turned.
            let inner = moving.iter().filter(|joint| frames.joints[**joint].parent.is_some());
            positions.extend(inner.map(|joint| (*joint, 2)));
        }
        let mut gravity = false;
        if part == Part::Together {
            let of_gravity = self.gravity.joints(joint)?;
            gravity = of_gravity.is_some();
            for other in of_gravity.unwrap_or_default() {
                if positions.iter().all(|(known, _)| *known != other) {
                    positions.push((other, 1));
                }
            }
        }
        let motion = Motion {
            gravity,
            accelerations: if part == Part::Velocity { 0 } else { moving.len() },
            speeds: if carries && part != Part::Inertia { moving.len() } else { 0 },
            resistance: if part == Part::Together { self.rows.resistance(joint) } else { 0.0 },
        };
        Ok(Dependence { joint, moving, positions, motion })
    }

    fn function(&self, dependence: &Dependence) -> Result<Trigonometric, DynamicsError> {
        let mut variables: Vec<_> = self
            .rows
            .ways
            .variables(&dependence.positions.iter().map(|(joint, _)| *joint).collect::<Vec<_>>());
        for (variable, (_, degree)) in variables.iter_mut().zip(&dependence.positions) {
            variable.degree = *degree;
        }
        let (moving, motion) = (&dependence.moving[..], &dependence.motion);
        let mut memory = self.rows.memory();
        let mut error = Ok(());
        let mut q = RobotQ::zeros(self.rows.covered.len());
        let values = (motion.values(), Measure::Motion(*motion));
        let function = Trigonometric::sampled(variables, values, |positions| {
            for ((joint, _), position) in dependence.positions.iter().zip(positions) {
                q[*joint] = *position;
            }
            self.rows.values(&q, (dependence.joint, moving), motion, &mut memory).unwrap_or_else(|found| {
                error = Err(found);
                vec![0.0; motion.values()]
            })
        });
        error.map(|()| function)
    }

    /// Motions that may attain the largest torque: speeds either way, and the joint's own as dry friction wants it.
    fn candidates(
        &self,
        dependence: &Dependence,
        (function, positions): (&Trigonometric, &[f64]),
        largest: &LargestMotion,
    ) -> Vec<AttainedAt> {
        let mut at = self.somewhere();
        for (variable, position) in function.variables.iter().zip(positions) {
            at.q[variable.joint] = *position;
        }
        for (&joint, share) in dependence.moving.iter().zip(&largest.accelerations) {
            at.qdd[joint] = share * self.rows.covered[joint].acceleration;
        }
        for (&joint, share) in dependence.moving.iter().zip(&largest.speeds) {
            at.qd[joint] = share * self.rows.covered[joint].speed;
        }
        let mut all = vec![at];
        if dependence.motion.resistance > 0.0 {
            let own = self.rows.covered[dependence.joint].speed;
            for speed in [own, own * SLOW] {
                let mut other = all[0].clone();
                other.qd[dependence.joint] = speed.copysign(other.qd[dependence.joint]);
                all.push(other);
            }
            let reversed =
                |at: &AttainedAt| AttainedAt { qd: at.qd.iter().map(|speed| -speed).collect(), ..at.clone() };
            all.extend(all.iter().map(reversed).collect::<Vec<_>>());
        }
        all
    }

    /// Motions at the limits of speed and acceleration, for a torque of too many joints.
    fn random_motions(&self, part: Part, dependence: &Dependence) -> Vec<AttainedAt> {
        let mut random = Uniform::seeded(self.seed);
        let mut motion = || {
            let mut at = AttainedAt::rest(position(&mut random, self.rows.ways.frames));
            for &joint in &dependence.moving {
                let covered = &self.rows.covered[joint];
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

    /// The middle of all ranges, at rest.
    fn somewhere(&self) -> AttainedAt {
        let ranges = self.rows.covered.iter().map(|covered| (covered.lower, covered.upper));
        AttainedAt::rest(ranges.map(|(lower, upper)| 0.0_f64.clamp(lower, upper)).collect())
    }

    /// The motion with the largest torque, which is computed by the algorithm of inverse dynamics.
    fn best(
        &self,
        part: Part,
        joint: usize,
        motions: Vec<AttainedAt>,
    ) -> Result<(f64, AttainedAt), DynamicsError> {
        let mut best = (-1.0, self.somewhere());
        for at in motions {
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
        let bodies = (0..ways.differs.len()).filter(|&body| ways.differs[body] && ways.carries(joint, body));
        let entries: f64 = bodies.map(|body| self.rows.largest_entries[body]).sum();
        let covered = &self.rows.covered;
        let armature = self.rows.resistances[joint].armature.abs() * covered[joint].acceleration;
        let accelerations: f64 = covered.iter().map(|covered| covered.acceleration).sum();
        let speeds: f64 = covered.iter().map(|covered| covered.speed).sum();
        match part {
            Part::Inertia => entries * accelerations + armature,
            // A body turns no faster than all joints together, and no velocity product is larger than twice its square.
            Part::Velocity => 2.0 * entries * speeds * speeds,
            Part::Together => f64::INFINITY,
        }
    }
}

/// Random motions for a torque of too many joints. Kind: choice.
const SAMPLES: usize = 2_000;
/// A speed at which damping is nothing beside dry friction, as a part of the limit. No unit; kind: choice.
const SLOW: f64 = 1e-6;

impl Dependence {
    fn is_tractable(&self, rows: &Rows<'_>) -> bool {
        let size = |(joint, degree): &(usize, usize)| {
            if rows.ways.frames.joints[*joint].is_angular { 1 + 2 * degree } else { 1 + degree }
        };
        let count = self.positions.iter().map(size).fold(self.motion.values(), usize::saturating_mul);
        self.motion.speeds <= MAX_SPEEDS && count <= MAX_COEFFICIENTS
    }
}
