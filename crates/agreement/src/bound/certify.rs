//! A bracket around the worst disagreement of two chains over the whole joint range: from below a
//! configuration that attains it, from above a bound that holds everywhere.
//!
//! Four steps. Chains with their joints in different orders are laid side by side (`order.rs`). The
//! telescoped sum (`telescope.rs`) settles chains that agree, in microseconds. What is left is reduced to
//! the joints that matter (`reduce.rs`); climbing from many starts (`search.rs`) finds a bad
//! configuration, and branch and bound (`branch.rs`) proves that none is much worse, with bounds from
//! corners of polygons (`gap.rs`, `corner.rs`), and where these do not do, from chains that stand
//! between the two (`way.rs`).
//!
//! The bound is rigorous in floating point: each file states what rounding can take from it, and
//! adds that. It speaks of the two [`ScrewChain`]s as they are given.

use std::f64::consts::PI;

use congruent_kinematics::{KinematicsError, ScrewChain};

use super::{
    branch::{Bound, Outcome, Scale, Task, bracket, is_affordable},
    budget::{Budget, ROUNDING_LEVEL},
    corner::Interval,
    gap::Gap,
    order::SideBySide,
    reduce::{Reduced, Tidied},
    search::Attained,
    telescope::Telescope,
    way::{self, Way},
};

/// Part of the attained disagreement that may be spent on leaving out a joint that hardly matters.
const ALLOWANCE: f64 = 1e-4;
/// One part in so many of the budget goes to the gap alone, before other bounds are looked for.
const ALONE: u64 = 16;
/// Ways whose steps are not worse together than this many times what is attained may help.
const PROMISING: f64 = 1.25;
/// Most ways that are followed.
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
    /// Number of boxes that were bounded; 0 where the telescoped sum was enough.
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
/// bound by corners is argued in `gap.rs`.
///
/// # Errors
/// [`KinematicsError::JointCount`] where lengths differ, [`KinematicsError::JointRange`] for a range
/// that is no closed interval.
/// # Examples
/// A tool that is 5 mm off is 5 mm off everywhere, also as seen by a proof:
/// ```
/// use congruent_kinematics::{Budget, Pose, ScrewChain, Twist, certify};
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
/// use congruent_kinematics::{Budget, Pose, ScrewChain, Twist, certify_driven};
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
    let first = Telescope::new(&a, &b, &ranges_of_joints);
    let tidied = Tidied::new((&a, &b), &drivers, ranges);
    let problem = Problem { tidied: &tidied, rest: &rest, budget };
    let mut position_m = problem.bracket(&POSITION, first.total_m());
    let mut orientation_rad = problem.bracket(&ORIENTATION, first.total_rad());
    let at = |chain: &ScrewChain, positions: &[f64]| {
        chain.base_from_tip(&drivers.iter().map(|&driver| positions[driver]).collect::<Vec<_>>())
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

/// What is bracketed: how it is made a gap, and how a gap is read.
struct Measure {
    reduce: fn(&Tidied, f64) -> Reduced,
    scale: Scale,
    price_of_tidying: fn(&Tidied) -> f64,
    /// Its figure of a pair in m and in rad.
    of_both: fn([f64; 2]) -> f64,
    ways: fn(&ScrewChain, &ScrewChain) -> Vec<Way>,
}

const POSITION: Measure = Measure {
    reduce: Tidied::position,
    scale: Scale { of_gap: |gap_m| gap_m, ceiling: f64::INFINITY },
    price_of_tidying: |tidied| tidied.price_m,
    of_both: |[position_m, _]| position_m,
    ways: |a, b| [way::over_faults(a, b), way::over_points(a, b)].concat(),
};

const ORIENTATION: Measure = Measure {
    reduce: Tidied::orientation,
    scale: Scale {
        // Half a turn is the most that two orientations differ, and their quaternions sqrt(2) then.
        of_gap: |gap| if gap < std::f64::consts::SQRT_2 { 4.0 * (gap / 2.0).asin() } else { PI },
        ceiling: std::f64::consts::SQRT_2,
    },
    price_of_tidying: |tidied| tidied.price_rad,
    of_both: |[_, orientation_rad]| orientation_rad,
    ways: way::over_faults,
};

struct Problem<'a> {
    tidied: &'a Tidied,
    /// The configuration nearest to zero.
    rest: &'a [f64],
    budget: Budget,
}

impl Problem<'_> {
    fn bracket(&self, measure: &Measure, telescoped: f64) -> Bracket {
        if telescoped <= ROUNDING_LEVEL {
            return Bracket { attained: 0.0, certified: telescoped, at: self.rest.to_vec(), cells: 0 };
        }
        let ranges: &[Interval] = &self.tidied.positions;
        let of_gap = measure.scale.of_gap;
        let whole = (measure.reduce)(self.tidied, ROUNDING_LEVEL);
        let found = Attained::search(&whole.gap, ranges);
        let allowance = (ALLOWANCE * of_gap(found.gap)).max(ROUNDING_LEVEL);
        let Reduced { gap, price } = (measure.reduce)(self.tidied, allowance);
        let found = Attained::new(&gap, self.at_rest_elsewhere(&gap, &found.at));
        let price = price + (measure.price_of_tidying)(self.tidied);
        let itself = Bound { steps: vec![gap.clone()], price };
        let affordable = |bounds: Vec<Bound>| -> Vec<Bound> {
            bounds.into_iter().filter(|bound| bound.is_affordable(ranges, self.budget)).collect()
        };
        let Budget { corners, relative_gap } = self.budget;
        let mut task = Task {
            gap: &gap,
            bounds: affordable(vec![itself.clone()]),
            ranges,
            scale: measure.scale,
            budget: Budget { corners: corners / ALONE, relative_gap },
        };
        let mut outcome = bracket(&task, found);
        let attained = of_gap(outcome.attained.gap);
        if outcome.certified > (attained * (1.0 + relative_gap)).max(ROUNDING_LEVEL) {
            let ways = self.ways(measure, (&gap, &outcome.attained), allowance);
            task.bounds = affordable([vec![itself], ways].concat());
            task.budget = Budget { corners: corners - corners / ALONE, relative_gap };
            let further = bracket(&task, outcome.attained);
            outcome = Outcome {
                certified: outcome.certified.min(further.certified),
                cells: outcome.cells + further.cells,
                ..further
            };
        }
        let Outcome { attained, certified, cells } = outcome;
        // The readings of the gaps and their sum are some dozen roundings.
        let certified = certified * (1.0 + 64.0 * f64::EPSILON);
        let certified = certified.min(telescoped).min(of_gap(f64::INFINITY));
        Bracket { attained: of_gap(attained.gap), certified, at: attained.at, cells }
    }

    /// Bounds over chains between the two, those that promise most.
    fn ways(&self, measure: &Measure, (gap, attained): (&Gap, &Attained), allowance: f64) -> Vec<Bound> {
        let Tidied { a, b, drivers, positions, .. } = self.tidied;
        let ranges: Vec<Interval> = drivers.iter().map(|&driver| positions[driver]).collect();
        let step = |[from, to]: &[ScrewChain; 2]| -> (Option<Gap>, f64) {
            let tidied = Tidied::new((from, to), drivers, positions);
            let Reduced { gap, price } = (measure.reduce)(&tidied, allowance);
            match way::of_move(from, to, &ranges) {
                Some(bounds) if !is_affordable(&gap, positions, self.budget) => {
                    (None, (measure.of_both)(bounds))
                }
                _ => (Some(gap), price + (measure.price_of_tidying)(&tidied)),
            }
        };
        let to_tidied = (measure.price_of_tidying)(self.tidied);
        let bound = |way: &Way| {
            let (steps, prices): (Vec<Option<Gap>>, Vec<f64>) = way.iter().map(step).unzip();
            let steps: Vec<Gap> = steps.into_iter().flatten().collect();
            let price = to_tidied + prices.iter().sum::<f64>();
            let worst = |gap: &Gap| (measure.scale.of_gap)(Attained::near(gap, positions, &attained.at).gap);
            (price + steps.iter().map(worst).sum::<f64>(), Bound { steps, price })
        };
        let mut ways: Vec<(f64, Bound)> = (measure.ways)(a, b).iter().map(bound).collect();
        if is_affordable(gap, positions, self.budget) {
            let worth = PROMISING * (measure.scale.of_gap)(attained.gap);
            ways.retain(|(sum, _)| *sum <= worth);
        } else {
            ways.push(bound(&vec![[b.clone(), a.clone()]]));
        }
        // Ways with a step that no box can be bounded for lead nowhere.
        ways.retain(|(_, bound)| bound.is_affordable(positions, self.budget));
        ways.sort_by(|one, two| one.0.total_cmp(&two.0));
        ways.truncate(MOST_WAYS);
        ways.into_iter().map(|(_, bound)| bound).collect()
    }

    /// Joints that the gap does not depend on go to where they rest.
    fn at_rest_elsewhere(&self, gap: &Gap, at: &[f64]) -> Vec<f64> {
        let place = |joint: usize| if gap.depends_on(joint) { at[joint] } else { self.rest[joint] };
        (0..at.len()).map(place).collect()
    }
}
