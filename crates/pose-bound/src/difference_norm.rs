//! The difference of two chains as a function that is affine in each joint's features, and its largest norm over a box
//! of joint positions.
//!
//! A joint's motion is `constant + x first + y second` with `(x, y) = (cos, sin)` of its turn or `(q, 0)` of its
//! shift. Affine in each joint's features, the norm is convex in them, and over a product of polygons it is largest at
//! corners (`docs/bound.md`, section 6). If a position drives two slots, both take the same corner as long as the
//! difference stays affine in it, that is, if each chain moves in only one of them. Otherwise the slots count as
//! independent, which gives a wider bound that holds as well.

use nalgebra::{Matrix4, Vector4};

use super::corner::{
    Corner, MAX_CORNERS, PositionInterval, around_arc, around_segment, corner_count, on_circle, on_line,
    outermost_radius, wraps,
};

/// Rounding of one motion and its product with a vector, relative to the largest vector: entries of the motion have a
/// dozen roundings of numbers up to its size (the norm is at most three times an entry), the product has four. Kind:
/// rounding; the bound is 56 unit roundoffs, 28 eps.
const ROUNDING_PER_MOTION: f64 = 32.0 * f64::EPSILON;
/// Rounding of one motion per radian of the largest turn, whose angle is a product with three roundings.
const ROUNDING_PER_RADIAN: f64 = 6.0 * f64::EPSILON;

/// Motions whose entries differ by less over a whole range count as the same. Kind: rounding; one axis given at two
/// rates differs by some 1e-16. The difference is added as slack.
const SHARED: f64 = 1e-14;

/// One joint's motion in one chain.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct AffineMotion {
    pub(super) constant: Matrix4<f64>,
    pub(super) first: Matrix4<f64>,
    pub(super) second: Matrix4<f64>,
    /// Displacement of the origin per unit of the features' distance from `(1, 0)` for a turn and from `(0, 0)` for a
    /// shift; in metres, or 1.
    pub(super) origin_displacement: f64,
}

impl AffineMotion {
    /// The motion of a joint that does not move here.
    pub(super) fn none() -> Self {
        let (identity, zeros) = (Matrix4::identity(), Matrix4::zeros());
        Self { constant: identity, first: zeros, second: zeros, origin_displacement: 0.0 }
    }

    pub(super) fn at(&self, [x, y]: [f64; 2]) -> Matrix4<f64> {
        self.constant + self.first * x + self.second * y
    }
}

/// One pair of features with the motion that it gives in each chain.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FeatureSlot {
    /// Index of the joint position that drives it.
    pub(super) joint: usize,
    /// Turn per unit of the position; a shift has none.
    pub(super) rate: Option<f64>,
    /// The motion in the first chain and in the second.
    pub(super) motions: [AffineMotion; 2],
    /// The later slot that determines its corner.
    pub(super) corner_of: Option<usize>,
}

impl FeatureSlot {
    pub(super) fn new(joint: usize, rate: Option<f64>, motions: [AffineMotion; 2]) -> Self {
        Self { joint, rate, motions, corner_of: None }
    }

    /// Whether both have the same features, and no chain moves in both.
    fn can_share_corners(&self, other: &Self) -> bool {
        let same_rate = match (self.rate, other.rate) {
            // The rates of one joint in two chains, each the norm of a twist, differ by rounding.
            (Some(rate), Some(other)) => (rate - other).abs() <= 8.0 * f64::EPSILON * rate,
            (None, None) => true,
            _ => false,
        };
        let fixed = AffineMotion::none();
        let mut pairs = self.motions.iter().zip(&other.motions);
        self.joint == other.joint && same_rate && pairs.all(|(one, two)| *one == fixed || *two == fixed)
    }

    fn motions_at(&self, corners: &[Corner]) -> [[Matrix4<f64>; 2]; MAX_CORNERS] {
        let mut motions = [[Matrix4::zeros(); 2]; MAX_CORNERS];
        for (motion, corner) in motions.iter_mut().zip(corners) {
            *motion = self.motions.each_ref().map(|motion| motion.at(corner.features));
        }
        motions
    }

    pub(super) fn corner(&self, position: f64) -> Corner {
        self.rate.map_or_else(|| on_line(position), |rate| on_circle(rate, position, 1.0))
    }

    fn wraps(&self, intervals: &[PositionInterval]) -> bool {
        self.rate.is_some_and(|rate| wraps(rate, intervals[self.joint]))
    }

    /// The point of the curve at the joint position `position`; for a turn that wraps the point next to `corner`,
    /// since some configuration near any position reaches it.
    fn on_curve(&self, intervals: &[PositionInterval], corner: Corner, position: f64) -> Corner {
        if !self.wraps(intervals) {
            return self.corner(position);
        }
        let [x, y] = corner.features;
        let radius = libm::hypot(x, y);
        Corner { features: [x / radius, y / radius], ..corner }
    }

    /// The position nearest to `position` at which a turn that wraps has the direction of `corner`.
    fn phase(&self, corner: &Corner, position: f64, (lower, upper): PositionInterval) -> f64 {
        let rate = self.rate.unwrap_or(1.0);
        let [x, y] = corner.features;
        let ahead = libm::atan2(y, x) - rate * position;
        (position + libm::atan2(libm::sin(ahead), libm::cos(ahead)) / rate).clamp(lower, upper)
    }

    /// Largest factor on a vector's norm, largest factor on the displacement of the origin, and rounding of one
    /// product.
    fn growth(&self, interval: PositionInterval) -> (f64, f64, f64) {
        let furthest = interval.0.abs().max(interval.1.abs());
        match self.rate {
            Some(rate) => {
                let radius = outermost_radius(rate, interval);
                (radius, 1.0 + radius, ROUNDING_PER_MOTION + ROUNDING_PER_RADIAN * rate * furthest)
            }
            None => (1.0, furthest, ROUNDING_PER_MOTION),
        }
    }
}

/// `|A_1(q) ... A_n(q) a - B_1(q) ... B_n(q) b|`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct DifferenceNorm {
    /// From base to tip; a joint has one slot, or two if it turns and shifts or has two rates.
    pub(super) slots: Vec<FeatureSlot>,
    /// The vectors at the end of the two chains.
    pub(super) tips: [Vector4<f64>; 2],
}

/// The bound over a box, and which joint to split.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct BoxBound {
    /// No configuration of the box has a larger difference.
    pub(super) bound: f64,
    /// The joint whose split is expected to reduce the bound most.
    pub(super) split_joint: usize,
    /// The expected reduction by that split.
    pub(super) reduction: f64,
    /// The expected reductions of all joints together.
    pub(super) total_reduction: f64,
    /// Number of corners that were evaluated, plus the overhead in corners.
    pub(super) corners: u64,
}

/// Buffers of [`DifferenceNorm::enclose`] that are used again for every box.
#[derive(Debug, Clone, Default)]
pub(super) struct EnclosureBuffers {
    corners: Vec<Vec<Corner>>,
    pairs: Vec<[Vector4<f64>; 2]>,
    next_pairs: Vec<[Vector4<f64>; 2]>,
    best: Vec<Corner>,
}

impl DifferenceNorm {
    /// The difference of two chains; slots of one position are paired if they can share their corners.
    pub(super) fn new(mut slots: Vec<FeatureSlot>, tips: [Vector4<f64>; 2]) -> Self {
        for index in 0..slots.len() {
            let taken = |later: usize| {
                slots[later].corner_of.is_some() || slots.iter().any(|it| it.corner_of == Some(later))
            };
            let free = |&later: &usize| slots[index].can_share_corners(&slots[later]) && !taken(later);
            // A pair, never a chain of three: `multiply_out` looks a corner up in one step.
            slots[index].corner_of = if taken(index) { None } else { (index + 1..slots.len()).find(free) };
        }
        Self { slots, tips }
    }

    /// The difference without leading slots that move both chains alike: they turn the difference and keep its norm.
    /// The second value is a bound of the effect of rounding between their motions.
    pub(super) fn without_common_leading_slots(mut self, positions: &[PositionInterval]) -> (Self, f64) {
        let unlike = |slot: &FeatureSlot| {
            let [a, b] = &slot.motions;
            let parts = [a.constant - b.constant, a.first - b.first, a.second - b.second];
            let furthest = positions[slot.joint].0.abs().max(positions[slot.joint].1.abs()).max(1.0);
            parts.iter().map(Matrix4::norm).sum::<f64>() * furthest
        };
        let mut slack = 0.0;
        while let Some(first) = self.slots.first() {
            let unlike = unlike(first);
            if unlike > SHARED
                || first.corner_of.is_some()
                || self.slots.iter().any(|slot| slot.corner_of == Some(0))
            {
                break;
            }
            // `|A_1 x - B_1 y| = |x - y|` needs `A_1 = B_1`; what the two differ by acts on the second chain's vector.
            slack += unlike * self.largest_norms(positions)[1];
            self.slots.remove(0);
            self.slots.iter_mut().for_each(|slot| slot.corner_of = slot.corner_of.map(|other| other - 1));
        }
        (self, slack)
    }

    /// The difference with the opposite sign of the second chain.
    pub(super) fn negated(self) -> Self {
        Self { tips: [self.tips[0], -self.tips[1]], ..self }
    }

    /// Whether the difference depends on a joint position.
    pub(super) fn depends_on(&self, joint: usize) -> bool {
        self.slots.iter().any(|slot| slot.joint == joint)
    }

    /// Whether it depends on no joint position.
    pub(super) fn is_constant(&self) -> bool {
        self.slots.is_empty()
    }

    /// The difference at joint positions `q`.
    pub(super) fn at(&self, q: &[f64]) -> f64 {
        self.at_corners(self.slots.iter().map(|slot| slot.corner(q[slot.joint])))
    }

    /// Most corners that any part of a box has.
    pub(super) fn max_corners(&self, intervals: &[PositionInterval]) -> u64 {
        let own = self.slots.iter().filter(|slot| slot.corner_of.is_none());
        let count =
            |slot: &FeatureSlot| slot.rate.map_or(2, |rate| corner_count(rate, intervals[slot.joint]));
        own.fold(1, |product, slot| product.saturating_mul(count(slot) as u64))
    }

    /// The cost of a box without its corners, in corners: motions, choice of the joint to split, memory. Measured.
    pub(super) fn overhead(&self) -> u64 {
        let slots = self.slots.len() as u64;
        32 + 20 * slots + 6 * slots * slots
    }

    /// Bounds the difference over a box; `nearest` receives the configuration of the box that is nearest to the worst
    /// corner, which is likely to have a large difference.
    pub(super) fn enclose(
        &self,
        intervals: &[PositionInterval],
        buffers: &mut EnclosureBuffers,
        nearest: &mut [f64],
    ) -> BoxBound {
        self.spread_corners(intervals, buffers);
        self.multiply_out(buffers);
        let squares = buffers.pairs.iter().map(|[a, b]| (a - b).norm_squared()).enumerate();
        let (worst, largest) =
            squares.fold((0, -1.0_f64), |best, next| if next.1 > best.1 { next } else { best });
        // Turns that wrap come last: any position is near one at which such a turn has the direction of its corner,
        // so they can follow a position that other slots of the same joint have fixed.
        self.decode(worst, buffers);
        for (slot, corner) in self.slots.iter().zip(&buffers.best).filter(|(slot, _)| !slot.wraps(intervals))
        {
            nearest[slot.joint] = corner.position;
        }
        for (slot, corner) in self.slots.iter().zip(&buffers.best).filter(|(slot, _)| slot.wraps(intervals)) {
            nearest[slot.joint] = slot.phase(corner, nearest[slot.joint], intervals[slot.joint]);
        }
        let bound = largest.sqrt() + self.rounding(intervals);
        let corners = buffers.pairs.len() as u64 + self.overhead();
        BoxBound { corners, ..self.expected_reductions(intervals, &buffers.best, bound) }
    }

    fn at_corners(&self, corners: impl DoubleEndedIterator<Item = Corner> + ExactSizeIterator) -> f64 {
        let [mut a, mut b] = self.tips;
        for (slot, corner) in self.slots.iter().zip(corners).rev() {
            a = slot.motions[0].at(corner.features) * a;
            b = slot.motions[1].at(corner.features) * b;
        }
        (a - b).norm()
    }

    fn spread_corners(&self, intervals: &[PositionInterval], buffers: &mut EnclosureBuffers) {
        buffers.corners.resize_with(self.slots.len(), Vec::new);
        for (slot, corners) in self.slots.iter().zip(&mut buffers.corners) {
            corners.clear();
            match slot.rate {
                Some(rate) => around_arc(rate, intervals[slot.joint], corners),
                None => corners.extend(around_segment(intervals[slot.joint])),
            }
        }
    }

    /// Multiplies the tips by the motions of every choice of corners, from the tip to the base: the last digit of an
    /// index is the corner of the first slot.
    fn multiply_out(&self, buffers: &mut EnclosureBuffers) {
        let EnclosureBuffers { corners, pairs, next_pairs, .. } = buffers;
        pairs.clear();
        pairs.push(self.tips);
        for (index, slot) in self.slots.iter().enumerate().rev() {
            if let Some(other) = slot.corner_of {
                // `other` is nearer to the tip, so its digit is in the index already. Every slot between the two that
                // has a digit of its own was appended after it: dividing by their product of corners brings it to the
                // last place.
                let motions = slot.motions_at(&corners[other]);
                let own = index + 1..other;
                let stride: usize = own
                    .filter(|&at| self.slots[at].corner_of.is_none())
                    .map(|at| corners[at].len())
                    .product();
                for (number, [a, b]) in pairs.iter_mut().enumerate() {
                    let [by_a, by_b] = &motions[number / stride % corners[other].len()];
                    (*a, *b) = (by_a * *a, by_b * *b);
                }
                continue;
            }
            let motions = slot.motions_at(&corners[index]);
            next_pairs.clear();
            for [a, b] in pairs.iter() {
                // Row-major: the choices of this slot are the last digit of the index so far.
                let here = &motions[..corners[index].len()];
                next_pairs.extend(here.iter().map(|[by_a, by_b]| [by_a * a, by_b * b]));
            }
            std::mem::swap(pairs, next_pairs);
        }
    }

    /// The corners that an index of [`DifferenceNorm::multiply_out`] encodes.
    fn decode(&self, mut index: usize, buffers: &mut EnclosureBuffers) {
        buffers.best.clear();
        for (slot, corners) in self.slots.iter().zip(&buffers.corners) {
            // A slot that takes the corner of another has no digit; its corner is filled in below.
            let count = if slot.corner_of.is_none() { corners.len() } else { 1 };
            buffers.best.push(corners[index % count]);
            index /= count;
        }
        for (at, slot) in self.slots.iter().enumerate() {
            if let Some(other) = slot.corner_of {
                buffers.best[at] = buffers.best[other];
            }
        }
    }

    /// For each joint the reduction of the difference if its worst corners are moved onto their curves and to one
    /// position. The joint with the largest reduction is split; if no joint has one, the joint with the widest range.
    fn expected_reductions(&self, intervals: &[PositionInterval], worst: &[Corner], bound: f64) -> BoxBound {
        let here = self.at_corners(worst.iter().copied());
        let (mut split_joint, mut reduction, mut total_reduction) = (None, 0.0, 0.0);
        for (index, slot) in self.slots.iter().enumerate() {
            if self.slots[..index].iter().any(|before| before.joint == slot.joint) {
                continue;
            }
            // A short interval has all its corners near the curve, so this is about what splitting takes away in the
            // end. Of several positions the largest difference counts: a split cannot get below it.
            let of_joint = self.slots.iter().zip(worst).filter(|(other, _)| other.joint == slot.joint);
            let pulled_in =
                of_joint.map(|(_, taken)| self.at_one_position(intervals, worst, slot.joint, taken));
            let drop = here - pulled_in.fold(0.0, f64::max);
            total_reduction += drop.max(0.0);
            if drop > reduction {
                (split_joint, reduction) = (Some(slot.joint), drop);
            }
        }
        let width = |slot: &&FeatureSlot| {
            slot.rate.unwrap_or(1.0) * (intervals[slot.joint].1 - intervals[slot.joint].0)
        };
        let widest = || self.slots.iter().max_by(|a, b| width(a).total_cmp(&width(b)));
        let split_joint = split_joint.or_else(|| widest().map(|slot| slot.joint)).unwrap_or(0);
        BoxBound { bound, split_joint, reduction, total_reduction, corners: 0 }
    }

    /// The difference with all corners of one joint moved onto their curves, at the position of one of them.
    fn at_one_position(
        &self,
        intervals: &[PositionInterval],
        worst: &[Corner],
        joint: usize,
        taken: &Corner,
    ) -> f64 {
        let moved = |(slot, &corner): (&FeatureSlot, &Corner)| {
            if slot.joint == joint { slot.on_curve(intervals, corner, taken.position) } else { corner }
        };
        self.at_corners(self.slots.iter().zip(worst).map(moved))
    }

    /// Bound of the rounding error of the largest difference that [`DifferenceNorm::enclose`] finds.
    ///
    /// The rounding of a product is relative to its result, and all later products enlarge both by the same factors:
    /// so the sum of the relative errors times the largest vector at the base bounds the total.
    pub(super) fn rounding(&self, intervals: &[PositionInterval]) -> f64 {
        let shares = self.slots.iter().map(|slot| slot.growth(intervals[slot.joint]).2).sum::<f64>();
        (ROUNDING_PER_MOTION + shares) * self.largest_norms(intervals).iter().sum::<f64>()
    }

    /// The largest norms of the vectors at the base, of both chains, over all corners.
    fn largest_norms(&self, intervals: &[PositionInterval]) -> [f64; 2] {
        let mut norms = self.tips.map(|tip| tip.norm());
        for slot in self.slots.iter().rev() {
            // `|M x| <= |R| |x| + |p|`: a corner outside of the circle stretches vectors, and the shift of the origin
            // is at most the displacement per feature times the distance of the corner from position zero's features.
            let (stretch, shift, _) = slot.growth(intervals[slot.joint]);
            for (norm, motion) in norms.iter_mut().zip(&slot.motions) {
                *norm = stretch * *norm + shift * motion.origin_displacement;
            }
        }
        norms
    }
}
