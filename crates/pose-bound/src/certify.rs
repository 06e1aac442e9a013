//! A bracket around the worst disagreement of two chains over the whole joint range: from below a
//! configuration that attains it, from above a bound that no configuration exceeds.
//!
//! Four steps. Chains with their joints in different orders are brought to one order (`common_order.rs`).
//! The telescoping bound (`telescoping.rs`) is enough for chains that agree, in microseconds. Other
//! differences are simplified to the joints that matter (`simplify.rs`); a local search from many starts
//! (`search.rs`) finds a bad configuration, and branch and bound (`branch.rs`) proves that none is much
//! worse. Its bounds come from corners of polygons (`difference_norm.rs`, `corner.rs`), and if these are
//! too wide, from intermediate chains (`intermediate_chains.rs`). None is above what both chains reach
//! (`reach.rs`).
//!
//! The bound is rigorous in floating point: each file states its rounding error and adds it. It is a bound
//! for the two [`ScrewChain`]s as they are given. `docs/bound.md` has the derivation.

use std::f64::consts::PI;

use congruent_kinematics::{KinematicsError, ScrewChain};

use super::{
    branch::{BracketOutcome, BracketTask, DisagreementBound, NormConversion, bracket, is_affordable},
    budget::{Budget, ROUNDING_LEVEL},
    common_order::{AlignedChains, DrivenScrews},
    corner::PositionInterval,
    difference_norm::DifferenceNorm,
    intermediate_chains::{self, ChainSequence},
    reach::reach_m,
    search::Incumbent,
    simplify::{Denoised, Simplified},
    telescoping::TelescopingBound,
};

/// Slack for the removal of joints that hardly matter, as part of the attained disagreement.
const ALLOWANCE: f64 = 1e-4;
/// The bound of the difference itself gets one part in this many of the budget, before intermediate chains are
/// tried.
const FIRST_PHASE_PART: u64 = 16;
/// Intermediate chains may help if the maxima of their steps add up to at most this many times the attained
/// disagreement.
const PROMISING: f64 = 1.25;
/// Most sequences of intermediate chains that are used.
const MAX_SEQUENCES: usize = 4;

/// A lower and an upper bound of the worst disagreement.
#[derive(Debug, Clone, PartialEq)]
pub struct Bracket {
    /// The disagreement at `at`; m or rad.
    pub attained: f64,
    /// No configuration of the ranges has a larger one; m or rad.
    pub certified: f64,
    /// The configuration that was found, in the ranges; rad or m.
    pub at: Vec<f64>,
    /// Number of boxes that were bounded; 0 if the telescoping bound was enough.
    pub boxes: u64,
}

impl Bracket {
    /// Whether `certified` is within `relative_gap` of `attained`, or both are rounding.
    pub fn is_within(&self, relative_gap: f64) -> bool {
        self.certified <= (self.attained * (1.0 + relative_gap)).max(ROUNDING_LEVEL)
    }
}

/// The worst disagreement of two chains, in position and in orientation.
#[derive(Debug, Clone, PartialEq)]
pub struct Certificate {
    /// Distance of the tips' origins, m.
    pub position_m: Bracket,
    /// Angle between the tips' orientations, rad.
    pub orientation_rad: Bracket,
}

/// Brackets the worst disagreement of two chains over joint ranges.
///
/// | value | shape | unit | frame |
/// |---|---|---|---|
/// | `a`, `b` | n joints each, driven by the same positions | | base to tip |
/// | `ranges` | n closed intervals | rad, m | |
///
/// Source: Tuy, *Convex Analysis and Global Optimization* (2016), chapter 6, for branch and bound; the
/// bound by corners is derived in `docs/bound.md`.
///
/// # Errors
/// [`KinematicsError::JointCount`] if lengths differ, [`KinematicsError::JointRange`] for a range
/// that is no closed interval.
/// # Examples
/// A tool that is 5 mm off is 5 mm off at every configuration:
/// ```
/// use congruent_pose_bound::{Budget, certify};
/// use congruent_kinematics::{Pose, ScrewChain, Twist};
/// use nalgebra::Vector3;
/// let joint = |y: f64| Twist { angular: Vector3::z(), linear: Vector3::new(0., y, 0.) };
/// let arm = |tool_m: f64| ScrewChain {
///     twists_in_base: vec![joint(0.0), joint(-0.6)],
///     base_from_tip_at_zero: Pose { translation: Vector3::new(1.0, 0.0, tool_m), ..Pose::identity() },
/// };
/// let turn = (-std::f64::consts::PI, std::f64::consts::PI);
/// let certificate = certify(&arm(0.0), &arm(0.005), &[turn, turn], Budget::default())?;
/// assert!((certificate.position_m.attained - 0.005).abs() < 1e-12);
/// assert!((certificate.position_m.certified - 0.005).abs() < 1e-12);
/// assert_eq!(certificate.orientation_rad.certified, 0.0);
/// # Ok::<(), congruent_kinematics::KinematicsError>(())
/// ```
pub fn certify(
    a: &ScrewChain,
    b: &ScrewChain,
    ranges: &[(f64, f64)],
    budget: Budget,
) -> Result<Certificate, KinematicsError> {
    KinematicsError::check_joint_count(a.joint_count(), b.joint_count())?;
    KinematicsError::check_joint_count(a.joint_count(), ranges.len())?;
    let drivers: Vec<usize> = (0..a.joint_count()).collect();
    let [a, b] = [a, b].map(|chain| DrivenScrews { chain: chain.clone(), drivers: drivers.clone() });
    certify_driven(&a, &b, ranges, budget)
}

/// As [`certify`] for joints that are driven in any order: each chain comes with the index of the position
/// in `ranges` for each of its joints. This covers mimic joints, and chains with different orders of joints.
///
/// # Errors
/// As [`certify`]; [`KinematicsError::JointCount`] also for a driver that has no range.
/// # Examples
/// Two consecutive joints that follow one position turn twice as far as one joint:
/// ```
/// use congruent_pose_bound::{Budget, DrivenScrews, certify_driven};
/// use congruent_kinematics::{Pose, ScrewChain, Twist};
/// use nalgebra::Vector3;
/// let turn = Twist { angular: Vector3::z(), linear: Vector3::zeros() };
/// let chain = |twists_in_base| ScrewChain { twists_in_base, base_from_tip_at_zero: Pose::identity() };
/// let once = DrivenScrews { chain: chain(vec![turn]), drivers: vec![0] };
/// let twice = DrivenScrews { chain: chain(vec![turn, turn]), drivers: vec![0, 0] };
/// let certificate = certify_driven(&once, &twice, &[(0.0, 0.5)], Budget::default())?;
/// assert!((certificate.orientation_rad.attained - 0.5).abs() < 1e-7);
/// # Ok::<(), congruent_kinematics::KinematicsError>(())
/// ```
pub fn certify_driven(
    a: &DrivenScrews,
    b: &DrivenScrews,
    ranges: &[(f64, f64)],
    budget: Budget,
) -> Result<Certificate, KinematicsError> {
    KinematicsError::check_joint_count(a.chain.joint_count(), a.drivers.len())?;
    KinematicsError::check_joint_count(b.chain.joint_count(), b.drivers.len())?;
    // First the common order: all later steps compare the chains joint by joint.
    let AlignedChains { chains: [a, b], drivers } = AlignedChains::new(a, b);
    check_ranges(&drivers, ranges)?;
    let near_zero: Vec<f64> = ranges.iter().map(|&(lower, upper)| 0.0_f64.clamp(lower, upper)).collect();
    let ranges_of_joints: Vec<PositionInterval> = drivers.iter().map(|&driver| ranges[driver]).collect();
    // Of the given chains, not of the denoised ones: this bound needs no slack.
    let first = TelescopingBound::new(&a, &b, &ranges_of_joints);
    let denoised = Denoised::new(&a, &b, &drivers, ranges);
    let problem = CertificateProblem { denoised: &denoised, near_zero: &near_zero, budget };
    // Grossly different chains: the telescoping sum counts each fault over the full lever arm and may exceed what
    // the two arms can reach in opposite directions. Angles have their own limit, half a turn.
    let apart_m = reach_m(&a, &ranges_of_joints) + reach_m(&b, &ranges_of_joints);
    let mut position_m = problem.bracket(&POSITION, first.total_m().min(apart_m));
    let mut orientation_rad = problem.bracket(&ORIENTATION, first.total_rad());
    // The search ran on simplified chains. What is reported as attained comes from the given chains at that
    // configuration, so that anyone can reproduce it.
    let at = |chain: &ScrewChain, positions: &[f64]| {
        chain.base_from_tip(&drivers.iter().map(|&driver| positions[driver]).collect())
    };
    position_m.attain(at(&a, &position_m.at)?.distance_m(&at(&b, &position_m.at)?));
    orientation_rad.attain(at(&a, &orientation_rad.at)?.angle_rad(&at(&b, &orientation_rad.at)?));
    Ok(Certificate { position_m, orientation_rad })
}

/// Every driver has a range, and every range is a closed interval.
fn check_ranges(drivers: &[usize], ranges: &[PositionInterval]) -> Result<(), KinematicsError> {
    let driven = drivers.iter().max().map_or(0, |last| last + 1);
    KinematicsError::check_joint_count(driven.max(ranges.len()), ranges.len())?;
    for (joint, &(lower, upper)) in ranges.iter().enumerate() {
        if !(lower.is_finite() && upper.is_finite() && lower <= upper) {
            return Err(KinematicsError::JointRange { joint, lower, upper });
        }
    }
    Ok(())
}

impl Bracket {
    /// Takes the value that the chains themselves give; above the certified bound it is rounding.
    fn attain(&mut self, found: f64) {
        self.attained = found.min(self.certified);
    }
}

/// The measure that is bracketed, position or orientation: how to get its difference, and how to convert
/// the norm.
struct BracketedMeasure {
    simplify: fn(&Denoised, f64) -> Simplified,
    conversion: NormConversion,
    denoising_slack: fn(&Denoised) -> f64,
    /// Its value of a pair in m and in rad.
    component: fn([f64; 2]) -> f64,
    sequences: fn(&ScrewChain, &ScrewChain) -> Vec<ChainSequence>,
}

const POSITION: BracketedMeasure = BracketedMeasure {
    simplify: Denoised::position,
    conversion: NormConversion { from_norm: |difference_m| difference_m, max_norm: f64::INFINITY },
    denoising_slack: |denoised| denoised.slack_m,
    component: |[position_m, _]| position_m,
    sequences: |a, b| {
        [intermediate_chains::through_fault_locations(a, b), intermediate_chains::through_points(a, b)]
            .concat()
    },
};

const ORIENTATION: BracketedMeasure = BracketedMeasure {
    simplify: Denoised::orientation,
    conversion: NormConversion {
        // Two orientations differ by half a turn at most; their quaternions differ by sqrt(2) then.
        from_norm: |difference| {
            if difference < std::f64::consts::SQRT_2 { 4.0 * libm::asin(difference / 2.0) } else { PI }
        },
        max_norm: std::f64::consts::SQRT_2,
    },
    denoising_slack: |denoised| denoised.slack_rad,
    component: |[_, orientation_rad]| orientation_rad,
    sequences: intermediate_chains::through_fault_locations,
};

struct CertificateProblem<'a> {
    denoised: &'a Denoised,
    /// The configuration nearest to zero.
    near_zero: &'a [f64],
    budget: Budget,
}

impl CertificateProblem<'_> {
    fn bracket(&self, measure: &BracketedMeasure, telescoping_bound: f64) -> Bracket {
        if telescoping_bound <= ROUNDING_LEVEL {
            // Chains that agree end here, after microseconds. The difference is rounding, which has no maximum worth
            // searching: a search would find the largest rounding error.
            return Bracket {
                attained: 0.0,
                certified: telescoping_bound,
                at: self.near_zero.to_vec(),
                boxes: 0,
            };
        }
        let ranges: &[PositionInterval] = &self.denoised.positions;
        let from_norm = measure.conversion.from_norm;
        // Twice: how much may be left out is a part of the attained difference, which is known only after a search.
        // The first pass omits rounding only; the second one has fewer joints and so far fewer corners.
        let whole = (measure.simplify)(self.denoised, ROUNDING_LEVEL);
        let found = Incumbent::search(&whole.difference, ranges);
        let allowance = (ALLOWANCE * from_norm(found.norm)).max(ROUNDING_LEVEL);
        let Simplified { difference, slack } = (measure.simplify)(self.denoised, allowance);
        let found = Incumbent::new(&difference, self.with_idle_joints_near_zero(&difference, &found.at));
        let slack = slack + (measure.denoising_slack)(self.denoised);
        // Idle joints near zero: the reported configuration then shows only joints that matter for the difference.
        let itself = DisagreementBound { differences: vec![difference.clone()], slack };
        let affordable = |bounds: Vec<DisagreementBound>| -> Vec<DisagreementBound> {
            bounds.into_iter().filter(|bound| bound.is_affordable(ranges, self.budget)).collect()
        };
        let Budget { corners, relative_gap } = self.budget;
        // First the difference itself with a small part of the budget. It closes the bracket for most single faults,
        // and intermediate chains cost local searches of their own.
        let mut task = BracketTask {
            difference: &difference,
            bounds: affordable(vec![itself.clone()]),
            ranges,
            conversion: measure.conversion,
            budget: Budget { corners: corners / FIRST_PHASE_PART, relative_gap },
        };
        let mut outcome = bracket(&task, found);
        let attained = from_norm(outcome.incumbent.norm);
        if outcome.certified > (attained * (1.0 + relative_gap)).max(ROUNDING_LEVEL) {
            // The largest difference is probably flat around its maximum, as if two faults add up: bound it in steps.
            let sequences = self.sequences(measure, &difference, &outcome.incumbent, allowance);
            task.bounds = affordable([vec![itself], sequences].concat());
            task.budget = Budget { corners: corners - corners / FIRST_PHASE_PART, relative_gap };
            let further = bracket(&task, outcome.incumbent);
            outcome = BracketOutcome {
                // Both hold, and the second search may have ended on its budget with the wider one.
                certified: outcome.certified.min(further.certified),
                boxes: outcome.boxes + further.boxes,
                ..further
            };
        }
        let BracketOutcome { incumbent, certified, boxes } = outcome;
        // Outward rounding of the conversions and their sum, some dozen operations.
        let certified = certified * (1.0 + 64.0 * f64::EPSILON);
        // All three hold for all configurations; the last one is half a turn for orientations and no limit for
        // positions.
        let certified = certified.min(telescoping_bound).min(from_norm(f64::INFINITY));
        Bracket { attained: from_norm(incumbent.norm), certified, at: incumbent.at, boxes }
    }

    /// Bounds over intermediate chains, the most promising ones.
    fn sequences(
        &self,
        measure: &BracketedMeasure,
        difference: &DifferenceNorm,
        incumbent: &Incumbent,
        allowance: f64,
    ) -> Vec<DisagreementBound> {
        let Denoised { a, b, drivers, positions, .. } = self.denoised;
        let ranges: Vec<PositionInterval> = drivers.iter().map(|&driver| positions[driver]).collect();
        let step = |[from, to]: &[ScrewChain; 2]| -> (Option<DifferenceNorm>, f64) {
            let denoised = Denoised::new(from, to, drivers, positions);
            let Simplified { difference, slack } = (measure.simplify)(&denoised, allowance);
            match intermediate_chains::bound_of_rigid_move(from, to, &ranges) {
                // Corners are tighter than the closed form, which adds lengths of links; so that is for too many
                // joints.
                Some(bounds) if !is_affordable(&difference, positions, self.budget) => {
                    (None, (measure.component)(bounds))
                }
                _ => (Some(difference), slack + (measure.denoising_slack)(&denoised)),
            }
        };
        let denoising_slack = (measure.denoising_slack)(self.denoised);
        let bound = |intermediate_chains: &ChainSequence| {
            let (steps, slacks): (Vec<Option<DifferenceNorm>>, Vec<f64>) =
                intermediate_chains.iter().map(step).unzip();
            let steps: Vec<DifferenceNorm> = steps.into_iter().flatten().collect();
            let slack = denoising_slack + slacks.iter().sum::<f64>();
            // The sum of the steps' maxima is the least that boxes can prove over this sequence. So it decides which
            // sequences are worth the corners, without a single box. A local search gives it from below, near enough.
            let worst = |difference: &DifferenceNorm| {
                (measure.conversion.from_norm)(Incumbent::near(difference, positions, &incumbent.at).norm)
            };
            (slack + steps.iter().map(worst).sum::<f64>(), DisagreementBound { differences: steps, slack })
        };
        let mut sequences: Vec<(f64, DisagreementBound)> =
            (measure.sequences)(a, b).iter().map(bound).collect();
        if is_affordable(difference, positions, self.budget) {
            let limit = PROMISING * (measure.conversion.from_norm)(incumbent.norm);
            // The difference itself converges, if slowly; a sequence that cannot come near it only costs corners.
            sequences.retain(|(sum, _)| *sum <= limit);
        } else {
            // Too many joints for corners: any bound helps, also that of a single step from one chain to the other,
            // which has a closed form if the chains differ in one place.
            sequences.push(bound(&vec![[b.clone(), a.clone()]]));
        }
        // A step whose boxes cannot be bounded makes its sequence useless.
        sequences.retain(|(_, bound)| bound.is_affordable(positions, self.budget));
        sequences.sort_by(|one, two| one.0.total_cmp(&two.0));
        sequences.truncate(MAX_SEQUENCES);
        sequences.into_iter().map(|(_, bound)| bound).collect()
    }

    /// Joints that the difference does not depend on go to the position nearest to zero.
    fn with_idle_joints_near_zero(&self, difference: &DifferenceNorm, at: &[f64]) -> Vec<f64> {
        let position =
            |joint: usize| if difference.depends_on(joint) { at[joint] } else { self.near_zero[joint] };
        (0..at.len()).map(position).collect()
    }
}
