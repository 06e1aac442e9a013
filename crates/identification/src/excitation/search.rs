//! The best motion of many.

use congruent_description::RobotQ;
use congruent_dynamics::{BodyTree, DynamicsError, JointMotionState};
use congruent_kinematics::Uniform;
use nalgebra::DMatrix;

use super::fourier::{FourierMotion, HARMONICS};
use crate::{
    equations::RecordedEquations,
    estimate::{JointNoise, PlannedInformation, planned_information},
    regressor_row::ColumnMaker,
    smoothing::SmoothedInstant,
    unknowns::{FreeUnknowns, JointUnknown, UnknownOrder},
};

/// What a motion may not exceed, of each moving joint; infinite where there is no limit.
#[derive(Debug, Clone, PartialEq)]
pub struct ExcitationLimits {
    /// Smallest positions, rad or m.
    pub lower: Vec<f64>,
    /// Largest positions.
    pub upper: Vec<f64>,
    /// Velocities, rad/s or m/s.
    pub velocity: Vec<f64>,
    /// Accelerations, rad/s^2 or m/s^2.
    pub acceleration: Vec<f64>,
    /// Efforts, N m or N.
    pub effort: Vec<f64>,
}

/// What a motion is for.
#[derive(Debug, Clone, PartialEq)]
pub struct ExcitationOptions {
    /// The parameters that it shall show.
    pub free: FreeUnknowns,
    /// How long it takes, s.
    pub duration_s: f64,
    /// Where it begins and ends, rad or m.
    pub center: RobotQ,
    /// Noise of the efforts of each driven joint, root mean square, N m or N.
    pub noise: Vec<f64>,
    /// Seed of the motions that are tried.
    pub seed: u64,
}

/// The standard error with which a parameter will be identified.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlannedError {
    /// The joint, among the moving ones.
    pub joint: usize,
    /// The term.
    pub term: JointUnknown,
    /// Its standard error.
    pub standard_error: f64,
}

/// A motion, and what it shows.
#[derive(Debug, Clone)]
pub struct Excitation {
    /// The motion.
    pub motion: FourierMotion,
    /// Standard errors of the terms of the joints.
    pub terms: Vec<PlannedError>,
    /// Standard error of the mass of the payload, kg.
    pub payload_mass_error_kg: Option<f64>,
    /// Combinations of the free inertial parameters of which it shows more than is known, and their number.
    pub known_combinations: [usize; 2],
    /// Motions that were tried.
    pub tried: usize,
}

/// Why there is no motion.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ExcitationError {
    /// Links are too close to each other or to obstacles in each.
    #[error("none of {tried} motions keeps the links far enough from each other and from obstacles")]
    TooClose {
        /// Motions that were tried.
        tried: usize,
    },
    /// The effort limit of a joint is too small for each.
    #[error("each of {tried} motions exceeds the effort limit of a joint")]
    TooStrong {
        /// Motions that were tried.
        tried: usize,
        /// The joint, among the moving ones, whose limit is exceeded most often.
        joint: usize,
    },
    /// No joint can move.
    #[error("no joint can move within its limits")]
    Still,
    /// A vector is another robot's.
    #[error(transparent)]
    Dynamics(#[from] DynamicsError),
}

/// Instants that independent noise is assumed of, per second, and at which a motion is judged. Kind: choice; the residual of efforts
/// resembles itself for some 100 ms.
const INSTANTS_HZ: f64 = 10.0;
/// Instants at which distances are measured, per second. Kind: choice.
const DISTANCES_HZ: f64 = 25.0;
/// Random motions, and changes of the best one. Kind: choice; more gain a few percent.
const RANDOM: usize = 60;
const REFINED: usize = 240;
/// A motion that exceeds a limit is made smaller by this factor, so often. Kind: choice.
const SMALLER: f64 = 0.75;
const TIMES_SMALLER: usize = 8;

/// The best motion of many within the limits. `is_clear` says whether the links are far enough from each other and from obstacles.
///
/// # Errors
/// No motion stays within the limits.
pub fn excite(
    tree: &BodyTree,
    limits: &ExcitationLimits,
    options: &ExcitationOptions,
    mut is_clear: impl FnMut(&RobotQ) -> bool,
) -> Result<Excitation, ExcitationError> {
    let mut search = MotionSearch::new(tree, limits, options);
    let mut random = Uniform::seeded(options.seed);
    let mut best: Option<(f64, FourierMotion)> = None;
    for at in 0..RANDOM + REFINED {
        let from = best.as_ref().filter(|_| at >= RANDOM).map(|(_, motion)| motion.clone());
        let candidate = search.candidate(from, &mut random);
        let least = best.as_ref().map_or(f64::NEG_INFINITY, |(value, _)| *value);
        if let Some(found) = search.within_limits(candidate, least, &mut is_clear)? {
            best = Some(found);
        }
    }
    let Some((_, motion)) = best else { return Err(search.why_none()) };
    search.shown_by(motion)
}

struct MotionSearch<'a> {
    limits: &'a ExcitationLimits,
    options: &'a ExcitationOptions,
    maker: ColumnMaker<'a>,
    empty: RecordedEquations,
    instant: SmoothedInstant,
    tau: Vec<f64>,
    tried: usize,
    /// How often the effort limit of each joint was exceeded.
    stopped_by_effort: Vec<usize>,
    stopped_by_distance: usize,
}

impl<'a> MotionSearch<'a> {
    fn new(tree: &'a BodyTree, limits: &'a ExcitationLimits, options: &'a ExcitationOptions) -> Self {
        let (maker, empty) = ColumnMaker::new(tree);
        let zeros = vec![0.0; tree.dof()];
        let instant = SmoothedInstant {
            time_s: 0.0,
            q: options.center.clone(),
            qd: zeros.clone(),
            qdd: zeros.clone(),
            effort: zeros.clone(),
            effort_rate: zeros.clone(),
            q_variance: zeros.clone(),
            effort_variance: zeros.clone(),
            of_derivatives: [0.0; 2],
            velocity_change: zeros.clone(),
        };
        Self {
            limits,
            options,
            maker,
            empty,
            instant,
            tau: zeros,
            tried: 0,
            stopped_by_effort: vec![0; limits.effort.len()],
            stopped_by_distance: 0,
        }
    }

    /// A random motion, or a change of one, as large as positions, velocities and accelerations allow.
    fn candidate(&mut self, from: Option<FourierMotion>, random: &mut Uniform) -> FourierMotion {
        let driven = self.maker.tree.driven_joints();
        let mut draw = || -> [[f64; 2]; HARMONICS] {
            std::array::from_fn(|_| [random.between(-1.0, 1.0), random.between(-1.0, 1.0)])
        };
        let motion = match from {
            None => FourierMotion {
                center: self.options.center.clone(),
                duration_s: self.options.duration_s,
                joints: driven.to_vec(),
                factors: driven.iter().map(|_| draw()).collect(),
            },
            Some(mut motion) => {
                for factors in &mut motion.factors {
                    let changes = draw();
                    let size = factors.iter().flatten().fold(0.0_f64, |most, of| most.max(of.abs()));
                    for (factor, change) in factors.iter_mut().flatten().zip(changes.iter().flatten()) {
                        *factor += CHANGE * size * change;
                    }
                }
                motion
            }
        };
        self.as_large_as_allowed(motion)
    }

    /// Scales the motion of each joint to the first limit that it meets.
    fn as_large_as_allowed(&mut self, mut motion: FourierMotion) -> FourierMotion {
        let dof = self.limits.lower.len();
        let mut largest = vec![[0.0_f64; 4]; dof];
        for time_s in times(motion.duration_s, DISTANCES_HZ) {
            let SmoothedInstant { q, qd, qdd, .. } = &mut self.instant;
            motion.state_into(time_s, q, qd, qdd);
            for (joint, most) in largest.iter_mut().enumerate() {
                let moved = q[joint] - motion.center[joint];
                *most = [
                    most[0].max(moved),
                    most[1].max(-moved),
                    most[2].max(qd[joint].abs()),
                    most[3].max(qdd[joint].abs()),
                ];
            }
        }
        for (&joint, factors) in motion.joints.iter().zip(&mut motion.factors) {
            let center = motion.center[joint];
            let allowed = [
                self.limits.upper[joint] - center,
                center - self.limits.lower[joint],
                self.limits.velocity[joint],
                self.limits.acceleration[joint],
            ];
            let factor = allowed.iter().zip(largest[joint]).map(|(allowed, most)| allowed.max(0.0) / most);
            let factor = factor.filter(|factor| !factor.is_nan()).fold(f64::INFINITY, f64::min);
            let factor = if factor.is_finite() { factor } else { 0.0 };
            factors.iter_mut().flatten().for_each(|of| *of *= factor);
        }
        motion
    }

    /// The motion, smaller if it has to be, with its information; `None` if it has less than `least`, or stays beyond a limit.
    fn within_limits(
        &mut self,
        mut motion: FourierMotion,
        least: f64,
        is_clear: &mut impl FnMut(&RobotQ) -> bool,
    ) -> Result<Option<(f64, FourierMotion)>, ExcitationError> {
        self.tried += 1;
        for _ in 0..TIMES_SMALLER {
            let (equations, is_strong_enough) = self.equations(&motion)?;
            let information =
                self.information(&equations).map_or(f64::NEG_INFINITY, |found| found.log_determinant);
            // A smaller one has still less.
            if information <= least {
                return Ok(None);
            }
            let is_free = is_strong_enough && self.is_clear(&motion, is_clear);
            if is_free {
                return Ok(Some((information, motion)));
            }
            self.stopped_by_distance += usize::from(is_strong_enough);
            motion.factors.iter_mut().flatten().flatten().for_each(|of| *of *= SMALLER);
        }
        Ok(None)
    }

    fn is_clear(&mut self, motion: &FourierMotion, is_clear: &mut impl FnMut(&RobotQ) -> bool) -> bool {
        times(motion.duration_s, DISTANCES_HZ).all(|time_s| {
            let SmoothedInstant { q, qd, qdd, .. } = &mut self.instant;
            motion.state_into(time_s, q, qd, qdd);
            is_clear(q)
        })
    }

    /// The equations of a motion, and whether its efforts are within their limits.
    fn equations(&mut self, motion: &FourierMotion) -> Result<(RecordedEquations, bool), DynamicsError> {
        let mut equations = self.empty.clone();
        let mut is_strong_enough = true;
        let mut buffer = self.maker.tree.buffer();
        for time_s in times(motion.duration_s, INSTANTS_HZ) {
            let SmoothedInstant { q, qd, qdd, .. } = &mut self.instant;
            motion.state_into(time_s, q, qd, qdd);
            self.maker.tree.inverse_into(&JointMotionState { q, qd, qdd }, &mut buffer, &mut self.tau)?;
            for (joint, (tau, limit)) in self.tau.iter().zip(&self.limits.effort).enumerate() {
                let is_beyond = tau.abs() > *limit;
                self.stopped_by_effort[joint] += usize::from(is_beyond);
                is_strong_enough &= !is_beyond;
            }
            let rows = self.maker.rows(&self.instant, &equations.joints)?;
            for (row, joint) in rows.iter().zip(&mut equations.joints) {
                joint.add(0, row, [0.0; 2]);
            }
        }
        Ok((equations, is_strong_enough))
    }

    fn information(&self, equations: &RecordedEquations) -> Option<PlannedInformation> {
        let noise: Vec<JointNoise> = self
            .options
            .noise
            .iter()
            .zip(&equations.joints)
            .map(|(rms, joint)| JointNoise { rms: *rms, rows: joint.rows(), alike: 1.0 })
            .collect();
        planned_information(equations, &self.options.free, &noise)
    }

    fn why_none(&self) -> ExcitationError {
        let (tried, efforts) = (self.tried, &self.stopped_by_effort);
        let worst =
            (0..efforts.len()).max_by_key(|joint| efforts[*joint]).filter(|joint| efforts[*joint] > 0);
        match worst {
            _ if self.stopped_by_distance > 0 => ExcitationError::TooClose { tried },
            Some(joint) => ExcitationError::TooStrong { tried, joint },
            None => ExcitationError::Still,
        }
    }

    /// What a motion shows.
    fn shown_by(&mut self, motion: FourierMotion) -> Result<Excitation, ExcitationError> {
        let (equations, _) = self.equations(&motion)?;
        let tried = self.tried;
        let shown = self.information(&equations).ok_or(ExcitationError::Still)?;
        let layout = &equations.layout;
        let covariance: &DMatrix<f64> = &shown.covariance;
        let error = |unknown: usize| {
            let at = shown.free.iter().position(|of| *of == unknown)?;
            Some(covariance[(at, at)].sqrt())
        };
        let mut terms = Vec::new();
        for (row, &joint) in layout.joints.iter().enumerate() {
            let of = JointUnknown::ALL.into_iter().filter_map(|term| {
                Some(PlannedError { joint, term, standard_error: error(layout.term(row, term))? })
            });
            terms.extend(of);
        }
        let payload = self.options.free.payload_alone();
        let payload_mass_error_kg = payload.and_then(|place| error(UnknownOrder::body(place.joint).end - 1));
        Ok(Excitation {
            motion,
            terms,
            payload_mass_error_kg,
            known_combinations: shown.known_combinations,
            tried,
        })
    }
}

/// By how much a refined motion differs, as part of the largest factor of a joint. No unit; kind: choice.
const CHANGE: f64 = 0.25;

/// The instants of a motion at a rate.
fn times(duration_s: f64, rate_hz: f64) -> impl Iterator<Item = f64> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "durations are bounded")]
    let count = (duration_s * rate_hz).ceil() as u32;
    (0..=count).map(move |at| duration_s * f64::from(at) / f64::from(count.max(1)))
}
