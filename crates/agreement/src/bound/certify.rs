//! A bracket around the worst disagreement of two chains over the whole joint range: from below a
//! configuration that attains it, from above a bound that holds everywhere.
//!
//! Four steps. Chains with their joints in different orders are laid side by side (`common_common_order.rs`). The
//! telescoping_bound sum (`telescoping.rs`) settles chains that agree, in microseconds. What is left is simplified to
//! the joints that matter (`simplify.rs`); climbing from many starts (`search.rs`) finds a bad
//! configuration, and branch and bound (`branch.rs`) proves that none is much worse, with bounds from
//! corners of polygons (`difference.rs`, `corner.rs`), and where these do not do, from chains that stand
//! between the two (`intermediate_chains.rs`).
//!
//! The bound is rigorous in floating point: each file states what rounding can take from it, and
//! adds that. It speaks of the two [`ScrewChain`]s as they are given.

use std::f64::consts::PI;

use congruent_kinematics::{KinematicsError, ScrewChain};

use super::{
    branch::{BracketOutcome, BracketTask, NormReading, UpperBound, bracket, is_affordable},
    budget::{Budget, ROUNDING_LEVEL},
    common_order::SideBySide,
    corner::Interval,
    difference_norm::DifferenceNorm,
    intermediate_chains::{self, ChainSequence},
    search::Attained,
    simplify::{Denoised, Simplified},
    telescoping::TelescopingBound,
};

/// Part of the attained disagreement that may be spent on leaving out a joint that hardly matters.
const ALLOWANCE: f64 = 1e-4;
/// One part in so many of the budget goes to the difference alone, before other bounds are looked for.
const ALONE: u64 = 16;
/// Ways whose steps are not worse together than this many times what is attained may help.
const PROMISING: f64 = 1.25;
/// Most sequences that are followed.
const MOST_WAYS: usize = 4;

/// What the worst disagreement lies between.
#[derive(Debug, Clone, PartialEq)]
pub struct Bracket {
    /// The disagreement at `at`; m or rad.
    pub attained: f64,
    /// No configuration of the ranges has a larger one; m or rad.
    pub certified: f64,
    /// The configuration that was found, in the ranges; rad or m.
    pub at: Vec<f64>,
    /// Number of boxes that were bounded; 0 where the telescoping_bound sum was enough.
    pub cells: u64,
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
/// bound by corners is argued in `difference.rs`.
///
/// # Errors
/// [`KinematicsError::JointCount`] where lengths differ, [`KinematicsError::JointRange`] for a range
/// that is no closed interval.
/// # Examples
/// A tool that is 5 mm off is 5 mm off everywhere, also as seen by a proof:
/// ```
/// use congruent_agreement::bound::{Budget, certify};
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
    let each_its_own: Vec<usize> = (0..a.joint_count()).collect();
    certify_driven((a, &each_its_own), (b, &each_its_own), ranges, budget)
}

/// The same where the joints of the chains are driven in any order: beside each chain stands, for
/// each of its joints, the index of its position in `ranges`. So joints that mimic others are held, and
/// chains that have their joints in different orders.
///
/// # Errors
/// As [`certify`]; [`KinematicsError::JointCount`] also for a driver that has no range.
/// # Examples
/// Two joints in a row that follow one position turn twice as far as one:
/// ```
/// use congruent_agreement::bound::{Budget, certify_driven};
/// use congruent_kinematics::{Pose, ScrewChain, Twist};
/// use nalgebra::Vector3;
/// let turn = Twist { angular: Vector3::z(), linear: Vector3::zeros() };
/// let chain = |twists_in_base| ScrewChain { twists_in_base, base_from_tip_at_zero: Pose::identity() };
/// let (once, twice) = (chain(vec![turn]), chain(vec![turn, turn]));
/// let certificate = certify_driven((&once, &[0]), (&twice, &[0, 0]), &[(0.0, 0.5)], Budget::default())?;
/// assert!((certificate.orientation_rad.attained - 0.5).abs() < 1e-7);
/// # Ok::<(), congruent_kinematics::KinematicsError>(())
/// ```
pub fn certify_driven(
    a: (&ScrewChain, &[usize]),
    b: (&ScrewChain, &[usize]),
    ranges: &[(f64, f64)],
    budget: Budget,
) -> Result<Certificate, KinematicsError> {
    KinematicsError::check_joint_count(a.0.joint_count(), a.1.len())?;
    KinematicsError::check_joint_count(b.0.joint_count(), b.1.len())?;
    let SideBySide { chains: [a, b], drivers } = SideBySide::new(a, b);
    check_ranges(&drivers, ranges)?;
    let rest: Vec<f64> = ranges.iter().map(|&(lower, upper)| 0.0_f64.clamp(lower, upper)).collect();
    let ranges_of_joints: Vec<Interval> = drivers.iter().map(|&driver| ranges[driver]).collect();
    let first = TelescopingBound::new(&a, &b, &ranges_of_joints);
    let denoised = Denoised::new((&a, &b), &drivers, ranges);
    let problem = CertificateProblem { denoised: &denoised, rest: &rest, budget };
    let mut position_m = problem.bracket(&POSITION, first.total_m());
    let mut orientation_rad = problem.bracket(&ORIENTATION, first.total_rad());
    let at = |chain: &ScrewChain, positions: &[f64]| {
        chain.base_from_tip(&drivers.iter().map(|&driver| positions[driver]).collect())
    };
    position_m.attain(at(&a, &position_m.at)?.distance_m(&at(&b, &position_m.at)?));
    orientation_rad.attain(at(&a, &orientation_rad.at)?.angle_rad(&at(&b, &orientation_rad.at)?));
    Ok(Certificate { position_m, orientation_rad })
}

/// Every driver has a range, and every range is a closed interval.
fn check_ranges(drivers: &[usize], ranges: &[Interval]) -> Result<(), KinematicsError> {
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
    /// Takes the figure that the chains themselves give; what exceeds the proof is its rounding.
    fn attain(&mut self, found: f64) {
        self.attained = found.min(self.certified);
    }
}

/// What is bracketed: how it is made a difference, and how a difference is read.
struct BracketedMeasure {
    simplify: fn(&Denoised, f64) -> Simplified,
    scale: NormReading,
    price_of_tidying: fn(&Denoised) -> f64,
    /// Its figure of a pair in m and in rad.
    of_both: fn([f64; 2]) -> f64,
    sequences: fn(&ScrewChain, &ScrewChain) -> Vec<ChainSequence>,
}

const POSITION: BracketedMeasure = BracketedMeasure {
    simplify: Denoised::position,
    scale: NormReading { of_norm: |difference_m| difference_m, ceiling: f64::INFINITY },
    price_of_tidying: |denoised| denoised.price_m,
    of_both: |[position_m, _]| position_m,
    sequences: |a, b| {
        [intermediate_chains::over_faults(a, b), intermediate_chains::over_points(a, b)].concat()
    },
};

const ORIENTATION: BracketedMeasure = BracketedMeasure {
    simplify: Denoised::orientation,
    scale: NormReading {
        // Half a turn is the most that two orientations differ, and their quaternions sqrt(2) then.
        of_norm: |difference| {
            if difference < std::f64::consts::SQRT_2 { 4.0 * (difference / 2.0).asin() } else { PI }
        },
        ceiling: std::f64::consts::SQRT_2,
    },
    price_of_tidying: |denoised| denoised.price_rad,
    of_both: |[_, orientation_rad]| orientation_rad,
    sequences: intermediate_chains::over_faults,
};

struct CertificateProblem<'a> {
    denoised: &'a Denoised,
    /// The configuration nearest to zero.
    rest: &'a [f64],
    budget: Budget,
}

impl CertificateProblem<'_> {
    fn bracket(&self, measure: &BracketedMeasure, telescoping_bound: f64) -> Bracket {
        if telescoping_bound <= ROUNDING_LEVEL {
            return Bracket { attained: 0.0, certified: telescoping_bound, at: self.rest.to_vec(), cells: 0 };
        }
        let ranges: &[Interval] = &self.denoised.positions;
        let of_norm = measure.scale.of_norm;
        let whole = (measure.simplify)(self.denoised, ROUNDING_LEVEL);
        let found = Attained::search(&whole.difference, ranges);
        let allowance = (ALLOWANCE * of_norm(found.difference)).max(ROUNDING_LEVEL);
        let Simplified { difference, price } = (measure.simplify)(self.denoised, allowance);
        let found = Attained::new(&difference, self.at_rest_elsewhere(&difference, &found.at));
        let price = price + (measure.price_of_tidying)(self.denoised);
        let itself = UpperBound { steps: vec![difference.clone()], price };
        let affordable = |bounds: Vec<UpperBound>| -> Vec<UpperBound> {
            bounds.into_iter().filter(|bound| bound.is_affordable(ranges, self.budget)).collect()
        };
        let Budget { corners, relative_gap } = self.budget;
        let mut task = BracketTask {
            difference: &difference,
            bounds: affordable(vec![itself.clone()]),
            ranges,
            scale: measure.scale,
            budget: Budget { corners: corners / ALONE, relative_gap },
        };
        let mut outcome = bracket(&task, found);
        let attained = of_norm(outcome.attained.difference);
        if outcome.certified > (attained * (1.0 + relative_gap)).max(ROUNDING_LEVEL) {
            let sequences = self.sequences(measure, (&difference, &outcome.attained), allowance);
            task.bounds = affordable([vec![itself], sequences].concat());
            task.budget = Budget { corners: corners - corners / ALONE, relative_gap };
            let further = bracket(&task, outcome.attained);
            outcome = BracketOutcome {
                certified: outcome.certified.min(further.certified),
                cells: outcome.cells + further.cells,
                ..further
            };
        }
        let BracketOutcome { attained, certified, cells } = outcome;
        // The readings of the differences and their sum are some dozen roundings.
        let certified = certified * (1.0 + 64.0 * f64::EPSILON);
        let certified = certified.min(telescoping_bound).min(of_norm(f64::INFINITY));
        Bracket { attained: of_norm(attained.difference), certified, at: attained.at, cells }
    }

    /// CertifiedBounds over chains between the two, those that promise most.
    fn sequences(
        &self,
        measure: &BracketedMeasure,
        (difference, attained): (&DifferenceNorm, &Attained),
        allowance: f64,
    ) -> Vec<UpperBound> {
        let Denoised { a, b, drivers, positions, .. } = self.denoised;
        let ranges: Vec<Interval> = drivers.iter().map(|&driver| positions[driver]).collect();
        let step = |[from, to]: &[ScrewChain; 2]| -> (Option<DifferenceNorm>, f64) {
            let denoised = Denoised::new((from, to), drivers, positions);
            let Simplified { difference, price } = (measure.simplify)(&denoised, allowance);
            match intermediate_chains::of_move(from, to, &ranges) {
                Some(bounds) if !is_affordable(&difference, positions, self.budget) => {
                    (None, (measure.of_both)(bounds))
                }
                _ => (Some(difference), price + (measure.price_of_tidying)(&denoised)),
            }
        };
        let to_tidied = (measure.price_of_tidying)(self.denoised);
        let bound = |intermediate_chains: &ChainSequence| {
            let (steps, prices): (Vec<Option<DifferenceNorm>>, Vec<f64>) =
                intermediate_chains.iter().map(step).unzip();
            let steps: Vec<DifferenceNorm> = steps.into_iter().flatten().collect();
            let price = to_tidied + prices.iter().sum::<f64>();
            let worst = |difference: &DifferenceNorm| {
                (measure.scale.of_norm)(Attained::near(difference, positions, &attained.at).difference)
            };
            (price + steps.iter().map(worst).sum::<f64>(), UpperBound { steps, price })
        };
        let mut sequences: Vec<(f64, UpperBound)> = (measure.sequences)(a, b).iter().map(bound).collect();
        if is_affordable(difference, positions, self.budget) {
            let worth = PROMISING * (measure.scale.of_norm)(attained.difference);
            sequences.retain(|(sum, _)| *sum <= worth);
        } else {
            sequences.push(bound(&vec![[b.clone(), a.clone()]]));
        }
        // Ways with a step that no box can be bounded for lead nowhere.
        sequences.retain(|(_, bound)| bound.is_affordable(positions, self.budget));
        sequences.sort_by(|one, two| one.0.total_cmp(&two.0));
        sequences.truncate(MOST_WAYS);
        sequences.into_iter().map(|(_, bound)| bound).collect()
    }

    /// Joints that the difference does not depend on go to where they rest.
    fn at_rest_elsewhere(&self, difference: &DifferenceNorm, at: &[f64]) -> Vec<f64> {
        let place = |joint: usize| if difference.depends_on(joint) { at[joint] } else { self.rest[joint] };
        (0..at.len()).map(place).collect()
    }
}
