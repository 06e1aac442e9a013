//! From two chains to the smallest difference with the same norm: joints that both chains share at the base
//! or at the tip do not change the distance. Joints that are almost the same are made the same, and the
//! telescoping bound of that change is added as slack.

use std::f64::consts::{SQRT_2, TAU};

use congruent_kinematics::{ScrewChain, Twist, hat, quaternion_of};
use nalgebra::{Matrix3, Matrix4, Vector3, Vector4};

use super::{
    corner::PositionInterval,
    difference_norm::{AffineMotion, DifferenceNorm, FeatureSlot},
    telescoping::{TelescopingBound, furthest},
};

/// A turn or a shift over a whole range below this counts as rounding of the given chain. Unit: rad and m;
/// kind: rounding; an identified chain shows some 1e-15. It only decides what is exchanged: the slack is
/// computed from the given chain.
const NOISE: f64 = 1e-12;

/// Two chains without rounding noise.
#[derive(Debug, Clone)]
pub(super) struct Denoised {
    pub(super) a: ScrewChain,
    pub(super) b: ScrewChain,
    /// For each joint the index of the position that drives it.
    pub(super) drivers: Vec<usize>,
    /// Range of each position; at most one turn if it drives a single joint that only turns.
    pub(super) positions: Vec<PositionInterval>,
    /// Range of each joint, that of its driver.
    ranges: Vec<PositionInterval>,
    /// Bound of the distance between the denoised chains and the given ones, both together, m.
    pub(super) slack_m: f64,
    /// Bound of the angle between the denoised chains and the given ones, both together, rad.
    pub(super) slack_rad: f64,
}

/// A difference, and a bound of what was removed from it.
#[derive(Debug, Clone)]
pub(super) struct Simplified {
    pub(super) difference: DifferenceNorm,
    pub(super) slack: f64,
}

impl Denoised {
    /// Removes turns, pitches and differences of rate that are noise.
    pub(super) fn new(
        a: &ScrewChain,
        b: &ScrewChain,
        drivers: &[usize],
        positions: &[PositionInterval],
    ) -> Self {
        let (mut denoised_a, mut denoised_b) = (a.clone(), b.clone());
        let mut one_turn = positions.to_vec();
        let twists = denoised_a.twists_in_base.iter_mut().zip(&mut denoised_b.twists_in_base);
        for ((a, b), &driver) in twists.zip(drivers) {
            let furthest = furthest(positions[driver]);
            *a = without_noise(a, furthest);
            *b = without_noise(b, furthest);
            let (rate_a, rate_b) = (a.angular.norm(), b.angular.norm());
            if rate_b > 0.0 && (rate_a - rate_b).abs() * furthest <= NOISE {
                // Rates that differ by noise would get two feature slots instead of one, and several times the corners.
                // To the rate of the second chain, not to the mean: only one chain then needs slack.
                let scale = rate_b / rate_a;
                *a = Twist { angular: a.angular * scale, linear: a.linear * scale };
                // Cut to one turn only what repeats itself exactly: a pitch moves on with every turn, and another
                // joint with the same position may have another rate.
                let repeats = [*a, *b].iter().all(|twist| ScrewParts::new(twist).shift == Vector3::zeros());
                let alone = drivers.iter().filter(|&&other| other == driver).count() == 1;
                if repeats && alone {
                    one_turn[driver] = within_one_turn(positions[driver], rate_b);
                }
            }
        }
        // Over the given ranges, not over one turn: what a wrong rate makes grows with every turn.
        let whole: Vec<PositionInterval> = drivers.iter().map(|&driver| positions[driver]).collect();
        let slack_a = TelescopingBound::new(a, &denoised_a, &whole);
        let slack_b = TelescopingBound::new(b, &denoised_b, &whole);
        Self {
            a: denoised_a,
            b: denoised_b,
            drivers: drivers.to_vec(),
            ranges: drivers.iter().map(|&driver| one_turn[driver]).collect(),
            positions: one_turn,
            slack_m: slack_a.total_m() + slack_b.total_m(),
            slack_rad: slack_a.total_rad() + slack_b.total_rad(),
        }
    }

    /// The difference between the tips' positions, in metres; at most `allowance_m` is left out at each end.
    pub(super) fn position(&self, allowance_m: f64) -> Simplified {
        let telescoping = TelescopingBound::new(&self.a, &self.b, &self.ranges);
        let first = exchangeable_count(&telescoping.position_m, allowance_m);
        // The sum of exchanged joints is bounded once, with the joints exchanged together; the entries of
        // `telescoping` have only decided how many.
        let mut slack = self.exchange_bound(first).total_m();
        let tips = [&self.a, &self.b].map(|chain| chain.base_from_tip_at_zero.translation);
        let mut last = self.ranges.len();
        while last > first {
            let joint = last - 1;
            // A joint whose axis passes through the tip does not move it: the speed of the tip per unit of the
            // joint, times the largest position, bounds how far.
            let moved = |twist: &Twist, tip: &Vector3<f64>| (twist.angular.cross(tip) + twist.linear).norm();
            let both = (moved(&self.a.twists_in_base[joint], &tips[0])
                + moved(&self.b.twists_in_base[joint], &tips[1]))
                * furthest(self.ranges[joint]);
            if both > allowance_m {
                break;
            }
            slack += both;
            last -= 1;
        }
        let slots = (first..last).flat_map(|joint| self.point_slots(joint)).collect();
        let difference = DifferenceNorm::new(slots, tips.map(|tip| tip.push(1.0)));
        let (difference, leading_slack) = difference.without_common_leading_slots(&self.positions);
        Simplified { difference, slack: slack + leading_slack }
    }

    /// The difference between the tips' unit quaternions, `2 sin(angle / 4)`, with the signs that are
    /// nearest to each other in the middle of the ranges; at most `allowance_rad` is left out at each end.
    pub(super) fn orientation(&self, allowance_rad: f64) -> Simplified {
        let telescoping = TelescopingBound::new(&self.a, &self.b, &self.ranges);
        let first = exchangeable_count(&telescoping.orientation_rad, allowance_rad);
        let mut slack = self.exchange_bound(first).total_rad();
        let homes = [&self.a, &self.b].map(|chain| chain.base_from_tip_at_zero.rotation);
        let mut last = self.ranges.len();
        let mut allowed = allowance_rad;
        while last > first {
            // A trailing joint turns both tips about its axis in the tip frame. If that axis is the same in both,
            // the angle between the tips stays as it is.
            let in_tip = |chain: usize, twist: &Twist| homes[chain].transpose() * twist.angular;
            let joint = last - 1;
            let apart = in_tip(0, &self.a.twists_in_base[joint]) - in_tip(1, &self.b.twists_in_base[joint]);
            let turned = apart.norm() * furthest(self.ranges[joint]);
            if turned > allowed {
                break;
            }
            allowed -= turned;
            slack += turned;
            last -= 1;
        }
        let slots = (first..last).flat_map(|joint| self.quaternion_slots(joint)).collect();
        let difference = DifferenceNorm::new(slots, homes.map(|home| Vector4::from(quaternion_of(&home))));
        let (difference, leading_slack) = difference.without_common_leading_slots(&self.positions);
        // The chord of two quaternions is about half of the angle, and at least a quarter of it.
        let slack = slack + 4.0 * leading_slack;
        let middle: Vec<f64> = self.positions.iter().map(|range| f64::midpoint(range.0, range.1)).collect();
        // A quaternion and its negative are one orientation: take the nearer one.
        let difference = if difference.at(&middle) > SQRT_2 { difference.negated() } else { difference };
        Simplified { difference, slack }
    }

    /// Bound of the change if the first chain gets the leading joints of the second one.
    fn exchange_bound(&self, count: usize) -> TelescopingBound {
        let mut a = self.a.clone();
        a.twists_in_base[..count].copy_from_slice(&self.b.twists_in_base[..count]);
        TelescopingBound::new(&self.a, &a, &self.ranges)
    }

    fn screws(&self, joint: usize) -> [ScrewParts; 2] {
        [&self.a, &self.b].map(|chain| ScrewParts::new(&chain.twists_in_base[joint]))
    }

    fn point_slots(&self, joint: usize) -> Vec<FeatureSlot> {
        let (screws, joint) = (self.screws(joint), self.drivers[joint]);
        let mut slots = turns(joint, &screws, ScrewParts::turn_of_points);
        if screws.iter().any(|screw| screw.shift != Vector3::zeros()) {
            slots.push(FeatureSlot::new(joint, None, screws.each_ref().map(ScrewParts::shift_of_points)));
        }
        slots
    }

    fn quaternion_slots(&self, joint: usize) -> Vec<FeatureSlot> {
        let mut slots = turns(self.drivers[joint], &self.screws(joint), ScrewParts::turn_of_quaternions);
        for slot in &mut slots {
            slot.rate = slot.rate.map(|rate| rate / 2.0);
        }
        slots
    }
}

/// One turn with the rate that both screws have, and one for the rest of the faster screw.
fn turns(
    joint: usize,
    screws: &[ScrewParts; 2],
    motion: fn(&ScrewParts) -> AffineMotion,
) -> Vec<FeatureSlot> {
    let [a, b] = screws;
    // Denoised rates differ by rounding or by more than rounding.
    let alike = (a.rate - b.rate).abs() <= 8.0 * f64::EPSILON * b.rate;
    let shared = if alike { b.rate } else { a.rate.min(b.rate) };
    let slot = |rate: f64, motions| FeatureSlot::new(joint, Some(rate), motions);
    let mut slots = Vec::new();
    if shared > 0.0 {
        // Two turns about one axis at the common rate and at the rest: a product of commuting motions.
        slots.push(slot(shared, [motion(a), motion(b)]));
    }
    if !alike && a.rate > shared {
        slots.push(slot(a.rate - shared, [motion(a), AffineMotion::none()]));
    }
    if !alike && b.rate > shared {
        slots.push(slot(b.rate - shared, [AffineMotion::none(), motion(b)]));
    }
    slots
}

/// The parts of a twist: a turn about a line and a shift along it.
#[derive(Debug, Clone, Copy)]
struct ScrewParts {
    /// Turn per unit of the joint's position.
    rate: f64,
    axis: Vector3<f64>,
    /// The line's moment: the velocity of the origin per radian.
    moment: Vector3<f64>,
    /// Shift per unit of the joint's position.
    shift: Vector3<f64>,
}

impl ScrewParts {
    fn new(twist: &Twist) -> Self {
        let rate = twist.angular.norm();
        if rate == 0.0 {
            return Self { rate, axis: Vector3::zeros(), moment: Vector3::zeros(), shift: twist.linear };
        }
        let axis = twist.angular / rate;
        let shift = axis * axis.dot(&twist.linear);
        let moment = (twist.linear - shift) / rate;
        // After a pitch was removed the remaining shift is rounding.
        let is_rounding = shift.norm() <= 8.0 * f64::EPSILON * twist.linear.norm();
        Self { rate, axis, moment, shift: if is_rounding { Vector3::zeros() } else { shift } }
    }

    /// `R = n n' + cos (I - n n') + sin [n]`, `p = sin m + (1 - cos) n x m`.
    fn turn_of_points(&self) -> AffineMotion {
        let along = self.axis * self.axis.transpose();
        let inwards = self.axis.cross(&self.moment);
        let mut constant = homogeneous(&along, &inwards);
        constant[(3, 3)] = 1.0;
        AffineMotion {
            constant,
            first: homogeneous(&(Matrix3::identity() - along), &-inwards),
            second: homogeneous(&hat(&self.axis), &self.moment),
            origin_displacement: self.moment.norm(),
        }
    }

    fn shift_of_points(&self) -> AffineMotion {
        let first = homogeneous(&Matrix3::zeros(), &self.shift);
        AffineMotion { first, origin_displacement: self.shift.norm(), ..AffineMotion::none() }
    }

    /// `cos + sin n` of half the angle, as a matrix that multiplies `(w, x, y, z)` from the left.
    fn turn_of_quaternions(&self) -> AffineMotion {
        let [x, y, z] = self.axis.into();
        let second = Matrix4::new(0.0, -x, -y, -z, x, 0.0, -z, y, y, z, 0.0, -x, z, -y, x, 0.0);
        AffineMotion {
            constant: Matrix4::zeros(),
            first: Matrix4::identity(),
            second,
            origin_displacement: 0.0,
        }
    }
}

fn homogeneous(linear: &Matrix3<f64>, shift: &Vector3<f64>) -> Matrix4<f64> {
    let mut matrix = Matrix4::zeros();
    matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(linear);
    matrix.fixed_view_mut::<3, 1>(0, 3).copy_from(shift);
    matrix
}

fn without_noise(twist: &Twist, furthest: f64) -> Twist {
    let rate = twist.angular.norm();
    if rate * furthest <= NOISE {
        return Twist { angular: Vector3::zeros(), ..*twist };
    }
    let axis = twist.angular / rate;
    let along = axis.dot(&twist.linear);
    // A small pitch would add a shift slot and double the corners.
    let linear = if along.abs() * furthest <= NOISE { twist.linear - axis * along } else { twist.linear };
    Twist { linear, ..*twist }
}

/// The middle turn of a range of more than one turn: all others repeat it.
fn within_one_turn((lower, upper): PositionInterval, rate: f64) -> PositionInterval {
    if (upper - lower) * rate <= TAU {
        return (lower, upper);
    }
    let (middle, half) = (f64::midpoint(lower, upper), TAU / rate / 2.0);
    (middle - half, middle + half)
}

/// How many leading joints can be exchanged within the allowance.
fn exchangeable_count(slacks: &[f64], allowance: f64) -> usize {
    let mut spent = 0.0;
    let affordable = |slack: &&f64| {
        spent += **slack;
        spent <= allowance
    };
    // The last entry is that of the home pose, not of a joint.
    slacks[..slacks.len() - 1].iter().take_while(affordable).count()
}
