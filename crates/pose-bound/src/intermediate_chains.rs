//! Intermediate chains between two chains: by the triangle inequality the disagreement is at most the sum of
//! the disagreements of consecutive chains. Each step differs in one place only, so its difference depends
//! on fewer joints than the whole. This helps if two faults add up at the worst configurations, as of base
//! and tool: the difference is flat around these, and branch and bound alone would have to split very many
//! boxes.
//!
//! Any chain can be an intermediate chain: the choice affects how tight the sum is, not whether it holds.

use congruent_kinematics::{Pose, ScrewChain, Twist};
use nalgebra::{Matrix3, Vector3};

use super::{
    corner::PositionInterval,
    telescoping::{TelescopingBound, furthest},
};

/// Screws that differ by less than this part of the chains' difference count as the same. It only affects
/// the choice of intermediate chains.
const ALIKE: f64 = 1e-4;
/// The least such difference, for chains that are nearly equal; rad and m.
const LEAST_ALIKE: f64 = 1e-12;
/// Axes whose angle has a smaller sine count as parallel, and axes that are closer as the same.
const PARALLEL: f64 = 1e-6;
/// Outward rounding, in eps, of a rigid move and of a sum over axes; far more than they have.
const ROUNDINGS: f64 = 1024.0;
/// Most faulty places of which all groupings are tried; of more places only one at a time is separated.
const MAX_GROUPED: usize = 4;

/// The steps from the first chain to the last, each from one chain to the next.
pub(super) type ChainSequence = Vec<[ScrewChain; 2]>;

/// Sequences over the places at which the chains differ, in all groupings.
pub(super) fn through_fault_locations(a: &ScrewChain, b: &ScrewChain) -> Vec<ChainSequence> {
    let between = between(a, b);
    let groupings: Vec<Vec<usize>> = if between.len() <= MAX_GROUPED {
        let all = 0..between.len();
        // Bit `at` of `bits` says whether the sequence passes the place `at`. Without any place it is a single
        // step, the difference itself, which is bounded anyway: so the count starts at 1. All groupings, because it
        // is not known which faults add up and which cancel each other.
        let subset = |bits: usize| all.clone().filter(|at| bits >> at & 1 == 1).collect();
        (1..1 << between.len()).map(subset).collect()
    } else {
        // Groupings double with each place, and each costs local searches.
        (0..between.len()).map(|at| vec![at]).collect()
    };
    let intermediate_chains = |stops: Vec<usize>| {
        let stops = stops.into_iter().map(|at| between[at].clone());
        let chains: Vec<ScrewChain> = [b.clone()].into_iter().chain(stops).chain([a.clone()]).collect();
        chains.windows(2).map(|pair| [pair[0].clone(), pair[1].clone()]).collect()
    };
    groupings.into_iter().map(intermediate_chains).collect()
}

/// Sequences over a point that is fixed in the base, for positions: the distance of each tip from the point
/// is bounded by the reach. Leading joints that turn about the point do not move it and are kept.
pub(super) fn through_points(a: &ScrewChain, b: &ScrewChain) -> Vec<ChainSequence> {
    let points: Vec<Vector3<f64>> = [a, b].into_iter().flat_map(common_normal_midpoints).collect();
    let mut distinct: Vec<Vector3<f64>> = Vec::new();
    for point in points {
        // Two nearly equal arms give nearly the same points, and each point costs a sequence.
        if distinct.iter().all(|other| (other - point).norm() > PARALLEL) {
            distinct.push(point);
        }
    }
    distinct
        .iter()
        // Through two chains of which both have their tip at the point: the step between them is zero for
        // positions.
        .map(|point| vec![[a.clone(), with_tip_at(a, point)], [with_tip_at(b, point), b.clone()]])
        .collect()
}

/// The intermediate chains: some leading joints of `a`, then the remaining joints of `b`, moved so that the
/// next joints coincide with those of `a`.
fn between(a: &ScrewChain, b: &ScrewChain) -> Vec<ScrewChain> {
    let joints = a.twists_in_base.len();
    let apart =
        a.twists_in_base.iter().zip(&b.twists_in_base).map(|(a, b)| distance(a, b)).fold(0.0, f64::max);
    // Relative to the fault: what differs ten thousand times less needs no step of its own.
    let alike = (ALIKE * apart).max(LEAST_ALIKE);
    let matches = |a_from_b: &Pose, joint: usize| {
        distance(&a.twists_in_base[joint], &b.twists_in_base[joint].transformed_by(a_from_b)) <= alike
    };
    let candidates = placements(a, b);
    let mut list: Vec<ScrewChain> = vec![b.clone()];
    let mut push_distinct = |chain: ScrewChain| {
        if !list.last().is_some_and(|last| is_same(last, &chain)) {
            list.push(chain);
        }
    };
    // From base to tip, greedily: the placement under which the longest run of joints coincides ends at the next
    // faulty place. Fewer places give fewer steps, and each step adds to the sum.
    let mut a_from_b = Pose::identity();
    let mut from = 0;
    while from < joints {
        let run = |pose: &Pose| (from..joints).take_while(|&joint| matches(pose, joint)).count();
        // A joint that coincides in no placement is faulty itself.
        a_from_b =
            candidates.iter().fold(a_from_b, |best, next| if run(next) > run(&best) { *next } else { best });
        push_distinct(spliced(a, b, from, &a_from_b));
        from += run(&a_from_b).max(1);
    }
    push_distinct(spliced(a, b, joints, &a_from_b));
    // The last chain of every sequence is `a` itself; twice would be a step of zero.
    if is_same(list.last().unwrap_or(b), a) {
        list.pop();
    }
    // Every sequence starts with `b` itself.
    list.split_off(list.len().min(1))
}

/// Whether two chains differ by rounding only.
fn is_same(one: &ScrewChain, two: &ScrewChain) -> bool {
    let (home, other_home) = (&one.base_from_tip_at_zero, &two.base_from_tip_at_zero);
    let twists = one.twists_in_base.iter().zip(&two.twists_in_base);
    home.distance_m(other_home).max(home.angle_rad(other_home)) <= LEAST_ALIKE
        && twists.into_iter().all(|(one, two)| distance(one, two) <= LEAST_ALIKE)
}

/// The first joints of `a`, then the remaining joints and the tip of `b`, moved by `a_from_b`.
fn spliced(a: &ScrewChain, b: &ScrewChain, from: usize, a_from_b: &Pose) -> ScrewChain {
    let moved = b.twists_in_base[from..].iter().map(|twist| twist.transformed_by(a_from_b));
    ScrewChain {
        twists_in_base: a.twists_in_base[..from].iter().copied().chain(moved).collect(),
        base_from_tip_at_zero: *a_from_b * b.base_from_tip_at_zero,
    }
}

/// Placements of `b` in the base of `a`: unchanged, with coinciding tips at zero, and with two coinciding
/// axes.
fn placements(a: &ScrewChain, b: &ScrewChain) -> Vec<Pose> {
    let tips = a.base_from_tip_at_zero * b.base_from_tip_at_zero.inverse();
    let mut list = vec![Pose::identity(), tips];
    for first in 0..a.twists_in_base.len() {
        for second in first + 1..a.twists_in_base.len() {
            let [in_a, in_b] = [a, b].map(|chain| frame(chain, first, second));
            if let (Some(in_a), Some(in_b)) = (in_a, in_b) {
                list.push(in_a * in_b.inverse());
                // One frame for each first axis: further partners of the same axis give the same placement if both
                // axes agree.
                break;
            }
        }
    }
    list
}

/// The frame of two axes that are not parallel: z along the first, x along their common normal.
fn frame(chain: &ScrewChain, first: usize, second: usize) -> Option<Pose> {
    let [one, two] = [first, second].map(|joint| ScrewAxis::from_twist(&chain.twists_in_base[joint]));
    let (one, two) = (one?, two?);
    let across = one.direction.cross(&two.direction);
    let x = across.try_normalize(PARALLEL)?;
    let rotation = Matrix3::from_columns(&[x, one.direction.cross(&x), one.direction]);
    Some(Pose::from_parts(rotation, one.foot(&two)))
}

/// The points at which consecutive axes are closest: the middles of their common normals.
fn common_normal_midpoints(chain: &ScrewChain) -> Vec<Vector3<f64>> {
    let axes: Vec<Option<ScrewAxis>> = chain.twists_in_base.iter().map(ScrewAxis::from_twist).collect();
    let middle = |pair: &[Option<ScrewAxis>]| {
        let [Some(one), Some(two)] = pair else { return None };
        let crosses = one.direction.cross(&two.direction).norm() > PARALLEL;
        crosses.then(|| (one.foot(two) + two.foot(one)) / 2.0)
    };
    axes.windows(2).filter_map(middle).collect()
}

/// A chain whose tip is fixed at `point`: it has the leading joints that turn about the point.
fn with_tip_at(chain: &ScrewChain, point: &Vector3<f64>) -> ScrewChain {
    let turns_about = |twist: &&Twist| (twist.angular.cross(point) + twist.linear).norm() <= PARALLEL;
    let leading = chain.twists_in_base.iter().take_while(turns_about).count();
    // The other joints remain as joints that do not move: both chains of a step need the same number of joints.
    let fixed = Twist { angular: Vector3::zeros(), linear: Vector3::zeros() };
    let twist = |(joint, twist): (usize, &Twist)| if joint < leading { *twist } else { fixed };
    ScrewChain {
        twists_in_base: chain.twists_in_base.iter().enumerate().map(twist).collect(),
        base_from_tip_at_zero: Pose::from_parts(Matrix3::identity(), *point),
    }
}

/// A bound in closed form of a step that moves everything behind some joint as a whole, for chains with too
/// many joints for boxes: position in m, orientation in rad. `None` for other steps.
///
/// With `D` the move, `R` its rotation, and `c` a point on the first axis that is moved,
/// `|D p - p| <= |D c - c| + |R - 1| |p - c|`, and the distance of the tip `p` from `c` is at most the sum of
/// the distances between the axes in between.
pub(super) fn bound_of_rigid_move(
    from: &ScrewChain,
    to: &ScrewChain,
    ranges: &[PositionInterval],
) -> Option<[f64; 2]> {
    let pairs = from.twists_in_base.iter().zip(&to.twists_in_base);
    let first = pairs.take_while(|(from, to)| distance(from, to) <= LEAST_ALIKE).count();
    let moved = |pose: &Pose| spliced(to, from, first, pose);
    // Some placement of the whole rest must give the second chain; otherwise the step changes more than one place.
    let by = placements(to, from).into_iter().find(|pose| is_same(&moved(pose), to))?;
    // The placement fits up to rounding only; the telescoping bound of what differs makes the sum rigorous.
    let placement_error = TelescopingBound::new(&moved(&by), to, ranges);
    let tip = from.base_from_tip_at_zero.translation;
    // Along the links from the tip to the first moved axis, each time to the nearest point of the next axis:
    // distances between points that one link carries are the same at all configurations.
    let mut reach_m = 0.0;
    let mut point = tip;
    for (twist, range) in from.twists_in_base.iter().zip(ranges).skip(first).rev() {
        let rate = twist.angular.norm();
        if rate <= PARALLEL {
            // A prismatic joint has no axis to go to, but it lengthens the arm by its travel.
            reach_m += twist.linear.norm() * furthest(*range);
            continue;
        }
        let direction = twist.angular / rate;
        let along = direction * direction.dot(&twist.linear);
        let through = direction.cross(&twist.linear) / rate;
        // The foot of the perpendicular from the last point.
        let next = through + direction * direction.dot(&(point - through));
        reach_m += (point - next).norm() + along.norm() * furthest(*range);
        point = next;
    }
    // `|D c - c|`, and `|R - 1| = 2 sin(turn / 2)` times the lever arm `|p - c|`, as the doc comment has it.
    let shift_m = (by.rotation * point + by.translation - point).norm();
    let turn_rad = by.angle_rad(&Pose::identity());
    let outward = 1.0 + ROUNDINGS * f64::EPSILON;
    Some([
        (shift_m + 2.0 * libm::sin(turn_rad / 2.0) * reach_m) * outward
            + placement_error.total_m()
            + LEAST_ALIKE,
        turn_rad * outward + placement_error.total_rad() + LEAST_ALIKE,
    ])
}

/// The distance of two twists: the larger one of their angular and linear parts.
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
    fn from_twist(twist: &Twist) -> Option<Self> {
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
