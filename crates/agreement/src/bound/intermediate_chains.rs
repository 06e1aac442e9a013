//! Ways from one chain to another over chains between them: by the triangle inequality no
//! disagreement exceeds the sum of those along a way. Each step differs in one place only, so its difference
//! depends on fewer joints than the whole, and what the other joints turn is not seen at all: a wrong
//! base and a wrong tool are worst where they add up, on a set of configurations so flat that a
//! box around each of them would have to be divided.
//!
//! A step need not be exact for the sum to hold: any chain may stand between.

use congruent_kinematics::{Pose, ScrewChain, Twist};
use nalgebra::{Matrix3, Vector3};

use super::{
    corner::Interval,
    telescoping::{TelescopingBound, furthest},
};

/// Screws that differ by less than this part of what the chains differ are taken for one: it decides
/// only what stands between.
const ALIKE: f64 = 1e-4;
/// The same where the chains are nearly equal, in rad and m.
const LEAST_ALIKE: f64 = 1e-12;
/// Axes whose angle has a smaller sine are parallel, and closer axes one.
const PARALLEL: f64 = 1e-6;
/// Roundings of a move's figures and of a sum over axes, by far.
const ROUNDINGS: f64 = 1024.0;
/// Places at fault that are told apart; of more, one at a time is split off.
const MOST_SPLIT: usize = 4;

/// Chains from the first to the last, each step to the next one.
pub(super) type ChainSequence = Vec<[ScrewChain; 2]>;

/// Ways over the places where the chains differ, in all groupings.
pub(super) fn over_faults(a: &ScrewChain, b: &ScrewChain) -> Vec<ChainSequence> {
    let between = between(a, b);
    let groupings: Vec<Vec<usize>> = if between.len() <= MOST_SPLIT {
        let all = 0..between.len();
        let subset = |bits: usize| all.clone().filter(|at| bits >> at & 1 == 1).collect();
        (1..1 << between.len()).map(subset).collect()
    } else {
        (0..between.len()).map(|at| vec![at]).collect()
    };
    let intermediate_chains = |stops: Vec<usize>| {
        let stops = stops.into_iter().map(|at| between[at].clone());
        let chains: Vec<ScrewChain> = [b.clone()].into_iter().chain(stops).chain([a.clone()]).collect();
        chains.windows(2).map(|pair| [pair[0].clone(), pair[1].clone()]).collect()
    };
    groupings.into_iter().map(intermediate_chains).collect()
}

/// Ways over a point that rests in the base, for positions: both tips are within reach of it. Leading
/// joints that turn about the point do not move it, so they may stand before it.
pub(super) fn over_points(a: &ScrewChain, b: &ScrewChain) -> Vec<ChainSequence> {
    let points: Vec<Vector3<f64>> = [a, b].into_iter().flat_map(crossings).collect();
    let mut told: Vec<Vector3<f64>> = Vec::new();
    for point in points {
        if told.iter().all(|other| (other - point).norm() > PARALLEL) {
            told.push(point);
        }
    }
    told.iter().map(|point| vec![[a.clone(), resting(a, point)], [resting(b, point), b.clone()]]).collect()
}

/// The chains between: as many leading joints of `a` as are right, then what `b` has, moved to where
/// its next joints are those of `a`.
fn between(a: &ScrewChain, b: &ScrewChain) -> Vec<ScrewChain> {
    let joints = a.twists_in_base.len();
    let apart =
        a.twists_in_base.iter().zip(&b.twists_in_base).map(|(a, b)| distance(a, b)).fold(0.0, f64::max);
    let alike = (ALIKE * apart).max(LEAST_ALIKE);
    let matches = |a_from_b: &Pose, joint: usize| {
        distance(&a.twists_in_base[joint], &b.twists_in_base[joint].transformed_by(a_from_b)) <= alike
    };
    let candidates = placements(a, b);
    let mut list: Vec<ScrewChain> = vec![b.clone()];
    let mut tell = |chain: ScrewChain| {
        if !list.last().is_some_and(|last| is_same(last, &chain)) {
            list.push(chain);
        }
    };
    let mut a_from_b = Pose::identity();
    let mut from = 0;
    while from < joints {
        let run = |pose: &Pose| (from..joints).take_while(|&joint| matches(pose, joint)).count();
        // A joint that fits nowhere is at fault itself.
        a_from_b =
            candidates.iter().fold(a_from_b, |best, next| if run(next) > run(&best) { *next } else { best });
        tell(spliced(a, b, from, &a_from_b));
        from += run(&a_from_b).max(1);
    }
    tell(spliced(a, b, joints, &a_from_b));
    if is_same(list.last().unwrap_or(b), a) {
        list.pop();
    }
    // The first is `b` itself.
    list.split_off(list.len().min(1))
}

/// Whether nothing but rounding lies between two chains.
fn is_same(one: &ScrewChain, two: &ScrewChain) -> bool {
    let (home, other_home) = (&one.base_from_tip_at_zero, &two.base_from_tip_at_zero);
    let twists = one.twists_in_base.iter().zip(&two.twists_in_base);
    home.distance_m(other_home).max(home.angle_rad(other_home)) <= LEAST_ALIKE
        && twists.into_iter().all(|(one, two)| distance(one, two) <= LEAST_ALIKE)
}

/// The first joints of `a`, then those of `b` and its tip, moved.
fn spliced(a: &ScrewChain, b: &ScrewChain, from: usize, a_from_b: &Pose) -> ScrewChain {
    let moved = b.twists_in_base[from..].iter().map(|twist| twist.transformed_by(a_from_b));
    ScrewChain {
        twists_in_base: a.twists_in_base[..from].iter().copied().chain(moved).collect(),
        base_from_tip_at_zero: *a_from_b * b.base_from_tip_at_zero,
    }
}

/// How `b` may lie in the base of `a`: as it does, with the tips on one another, and with two axes on
/// one another.
fn placements(a: &ScrewChain, b: &ScrewChain) -> Vec<Pose> {
    let tips = a.base_from_tip_at_zero * b.base_from_tip_at_zero.inverse();
    let mut list = vec![Pose::identity(), tips];
    for first in 0..a.twists_in_base.len() {
        for second in first + 1..a.twists_in_base.len() {
            let [in_a, in_b] = [a, b].map(|chain| frame(chain, first, second));
            if let (Some(in_a), Some(in_b)) = (in_a, in_b) {
                list.push(in_a * in_b.inverse());
                break;
            }
        }
    }
    list
}

/// A frame that two axes which are not parallel define: z along the first, x along their common normal.
fn frame(chain: &ScrewChain, first: usize, second: usize) -> Option<Pose> {
    let [one, two] = [first, second].map(|joint| ScrewAxis::of(&chain.twists_in_base[joint]));
    let (one, two) = (one?, two?);
    let across = one.direction.cross(&two.direction);
    let x = across.try_normalize(PARALLEL)?;
    let rotation = Matrix3::from_columns(&[x, one.direction.cross(&x), one.direction]);
    Some(Pose::from_parts(rotation, one.foot(&two)))
}

/// Where consecutive axes come closest.
fn crossings(chain: &ScrewChain) -> Vec<Vector3<f64>> {
    let axes: Vec<Option<ScrewAxis>> = chain.twists_in_base.iter().map(ScrewAxis::of).collect();
    let middle = |pair: &[Option<ScrewAxis>]| {
        let [Some(one), Some(two)] = pair else { return None };
        let crosses = one.direction.cross(&two.direction).norm() > PARALLEL;
        crosses.then(|| (one.foot(two) + two.foot(one)) / 2.0)
    };
    axes.windows(2).filter_map(middle).collect()
}

/// A chain whose tip rests at `point`: it has the leading joints that turn about the point.
fn resting(chain: &ScrewChain, point: &Vector3<f64>) -> ScrewChain {
    let turns_about = |twist: &&Twist| (twist.angular.cross(point) + twist.linear).norm() <= PARALLEL;
    let leading = chain.twists_in_base.iter().take_while(turns_about).count();
    let still = Twist { angular: Vector3::zeros(), linear: Vector3::zeros() };
    let twist = |(joint, twist): (usize, &Twist)| if joint < leading { *twist } else { still };
    ScrewChain {
        twists_in_base: chain.twists_in_base.iter().enumerate().map(twist).collect(),
        base_from_tip_at_zero: Pose::from_parts(Matrix3::identity(), *point),
    }
}

/// A bound in closed form of a step that moves everything behind some joint as a whole, for chains of so
/// many joints that no box can be bounded: position in m, orientation in rad. `None` for other steps.
///
/// With `D` the move, `R` its turn, and `c` a point on the first axis that is moved,
/// `|D p - p| <= |D c - c| + |R - 1| |p - c|`, and a tip is no further from there than the axes between
/// are apart.
pub(super) fn of_move(from: &ScrewChain, to: &ScrewChain, ranges: &[Interval]) -> Option<[f64; 2]> {
    let pairs = from.twists_in_base.iter().zip(&to.twists_in_base);
    let first = pairs.take_while(|(from, to)| distance(from, to) <= LEAST_ALIKE).count();
    let moved = |pose: &Pose| spliced(to, from, first, pose);
    let by = placements(to, from).into_iter().find(|pose| is_same(&moved(pose), to))?;
    let left = TelescopingBound::new(&moved(&by), to, ranges);
    let tip = from.base_from_tip_at_zero.translation;
    let mut reach_m = 0.0;
    let mut point = tip;
    for (twist, range) in from.twists_in_base.iter().zip(ranges).skip(first).rev() {
        let rate = twist.angular.norm();
        if rate <= PARALLEL {
            reach_m += twist.linear.norm() * furthest(*range);
            continue;
        }
        let direction = twist.angular / rate;
        let along = direction * direction.dot(&twist.linear);
        let through = direction.cross(&twist.linear) / rate;
        let next = through + direction * direction.dot(&(point - through));
        reach_m += (point - next).norm() + along.norm() * furthest(*range);
        point = next;
    }
    let shift_m = (by.rotation * point + by.translation - point).norm();
    let turn_rad = by.angle_rad(&Pose::identity());
    let outward = 1.0 + ROUNDINGS * f64::EPSILON;
    Some([
        (shift_m + 2.0 * (turn_rad / 2.0).sin() * reach_m) * outward + left.total_m() + LEAST_ALIKE,
        turn_rad * outward + left.total_rad() + LEAST_ALIKE,
    ])
}

/// How unlike two twists are, the larger of their parts.
fn distance(a: &Twist, b: &Twist) -> f64 {
    (a.angular - b.angular).norm().max((a.linear - b.linear).norm())
}

/// The axis of a joint that turns.
#[derive(Debug, Clone, Copy)]
struct ScrewAxis {
    direction: Vector3<f64>,
    through: Vector3<f64>,
}

impl ScrewAxis {
    fn of(twist: &Twist) -> Option<Self> {
        let rate = twist.angular.norm();
        let direction = twist.angular.try_normalize(PARALLEL)?;
        Some(Self { direction, through: direction.cross(&twist.linear) / rate })
    }

    /// The point of this axis that is next to another, which is not parallel.
    fn foot(&self, other: &Self) -> Vector3<f64> {
        let across = self.direction.cross(&other.direction);
        let between = other.through - self.through;
        self.through + self.direction * (between.cross(&other.direction).dot(&across) / across.norm_squared())
    }
}
