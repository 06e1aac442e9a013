//! The difference of two chains as a function that is affine in each joint's features, and its
//! largest norm over a box of joint positions.
//!
//! A joint's motion is `constant + x first + y second` with `(x, y) = (cos, sin)` of its turn or
//! `(q, 0)` of its shift. So the difference of two products of motions is affine in the features of
//! each joint when those of the others are held, its norm is convex in them, and over a product of
//! polygons it is largest at corners. Polygons around short arcs exceed them by the square of
//! their length, times the part of the *difference* that depends on this joint: small faults are
//! bounded as tightly as large ones.
//!
//! A position that drives two slots takes the same corner in both, as long as the difference stays
//! affine in it: where each chain moves in one of them. Otherwise the slots are taken for independent,
//! which is wider and holds as well.

use nalgebra::{Matrix4, Vector4};

use super::corner::{
    Corner, Interval, MOST_CORNERS, around_arc, around_segment, corner_count, on_circle, on_line,
    outermost_radius, wraps,
};

/// Rounding of one motion and its product with a vector, in units of the largest vector: entries of
/// the motion are a dozen roundings of numbers up to its size (their norm at most three times that
/// of an entry), the product has four. Kind: rounding; the bound is 56 / 2 for the unit roundoff.
const ROUNDING_PER_MOTION: f64 = 32.0 * f64::EPSILON;
/// The same for each radian of the largest turn, whose angle is a product of three roundings.
const ROUNDING_PER_RADIAN: f64 = 6.0 * f64::EPSILON;

/// Motions whose entries differ by less, over a whole range, are one. Kind: rounding; one axis written
/// for two rates differs by some 1e-16. What it leaves is added.
const SHARED: f64 = 1e-14;

/// One joint's motion in one chain.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct AffineMotion {
    pub(super) constant: Matrix4<f64>,
    pub(super) first: Matrix4<f64>,
    pub(super) second: Matrix4<f64>,
    /// How far the origin is carried for each unit of the features' distance from `(1, 0)` for a
    /// turn, from `(0, 0)` for a shift; in metres, or 1.
    pub(super) carries: f64,
}

impl AffineMotion {
    /// The motion of a joint that does not move here.
    pub(super) fn none() -> Self {
        let (identity, zeros) = (Matrix4::identity(), Matrix4::zeros());
        Self { constant: identity, first: zeros, second: zeros, carries: 0.0 }
    }

    fn at(&self, [x, y]: [f64; 2]) -> Matrix4<f64> {
        self.constant + self.first * x + self.second * y
    }
}

/// Features that both chains share, and what they do in each.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FeatureSlot {
    /// Which joint position drives it.
    pub(super) joint: usize,
    /// Turn per unit of the position; a shift has none.
    pub(super) rate: Option<f64>,
    /// Of the first chain and of the second.
    pub(super) motions: [AffineMotion; 2],
    /// The later slot whose corner it takes.
    pub(super) like: Option<usize>,
}

impl FeatureSlot {
    pub(super) fn new(joint: usize, rate: Option<f64>, motions: [AffineMotion; 2]) -> Self {
        Self { joint, rate, motions, like: None }
    }

    /// Whether both have the same features, and no chain moves in both.
    fn shares_corners(&self, other: &Self) -> bool {
        let same_rate = match (self.rate, other.rate) {
            // Rates of one joint in two chains, each the norm of a twist: rounding.
            (Some(rate), Some(other)) => (rate - other).abs() <= 8.0 * f64::EPSILON * rate,
            (None, None) => true,
            _ => false,
        };
        let still = AffineMotion::none();
        let apart = self.motions.iter().zip(&other.motions).all(|(one, two)| *one == still || *two == still);
        self.joint == other.joint && same_rate && apart
    }

    fn motions_at(&self, corners: &[Corner]) -> [[Matrix4<f64>; 2]; MOST_CORNERS] {
        let mut motions = [[Matrix4::zeros(); 2]; MOST_CORNERS];
        for (motion, corner) in motions.iter_mut().zip(corners) {
            *motion = [self.motions[0].at(corner.features), self.motions[1].at(corner.features)];
        }
        motions
    }

    fn corner(&self, position: f64) -> Corner {
        self.rate.map_or_else(|| on_line(position), |rate| on_circle(rate, position, 1.0))
    }

    fn wraps(&self, cell: &[Interval]) -> bool {
        self.rate.is_some_and(|rate| wraps(rate, cell[self.joint]))
    }

    /// A corner of this slot moved onto the curve, to where the joint is at `position`; a turn that
    /// wraps stays where it is, since it comes there again next to any position.
    fn on_curve(&self, cell: &[Interval], corner: Corner, position: f64) -> Corner {
        if !self.wraps(cell) {
            return self.corner(position);
        }
        let [x, y] = corner.features;
        let radius = x.hypot(y);
        Corner { features: [x / radius, y / radius], ..corner }
    }

    /// The position next to `position` at which a turn that wraps is where `corner` is.
    fn phase(&self, corner: &Corner, position: f64, (lower, upper): Interval) -> f64 {
        let rate = self.rate.unwrap_or(1.0);
        let [x, y] = corner.features;
        let ahead = y.atan2(x) - rate * position;
        (position + ahead.sin().atan2(ahead.cos()) / rate).clamp(lower, upper)
    }

    /// Largest stretch of a vector, largest shift of the origin for each metre that the motion
    /// carries, and rounding of one product.
    fn growth(&self, interval: Interval) -> (f64, f64, f64) {
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
    /// Base to tip.
    slots: Vec<FeatureSlot>,
    /// The vectors at the end of the two chains.
    tips: [Vector4<f64>; 2],
}

/// A bound over a box, and what it says about where to look.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Enclosure {
    /// No configuration of the box has a larger difference.
    pub(super) bound: f64,
    /// The joint whose division promises most.
    pub(super) divide: usize,
    /// How much it promises.
    pub(super) promise: f64,
    /// How much the divisions of all joints promise together.
    pub(super) promises: f64,
    /// Number of corners that were evaluated, and what the rest costs in corners.
    pub(super) corners: u64,
}

/// Room that [`DifferenceNorm::enclose`] uses again and again.
#[derive(Debug, Clone, Default)]
pub(super) struct Room {
    corners: Vec<Vec<Corner>>,
    pairs: Vec<[Vector4<f64>; 2]>,
    next_pairs: Vec<[Vector4<f64>; 2]>,
    best: Vec<Corner>,
}

impl DifferenceNorm {
    /// Pairs slots of one position where they can share their corners.
    pub(super) fn new(mut slots: Vec<FeatureSlot>, tips: [Vector4<f64>; 2]) -> Self {
        for index in 0..slots.len() {
            let taken =
                |later: usize| slots[later].like.is_some() || slots.iter().any(|it| it.like == Some(later));
            let free = |&later: &usize| !taken(later) && slots[index].shares_corners(&slots[later]);
            slots[index].like = if taken(index) { None } else { (index + 1..slots.len()).find(free) };
        }
        Self { slots, tips }
    }

    /// The same without leading slots that move both chains alike: they turn the difference, and its
    /// length stays. What rounding has left between their motions is the second figure.
    pub(super) fn without_shared_lead(mut self, positions: &[Interval]) -> (Self, f64) {
        let unlike = |slot: &FeatureSlot| {
            let [a, b] = &slot.motions;
            let parts = [a.constant - b.constant, a.first - b.first, a.second - b.second];
            let furthest = positions[slot.joint].0.abs().max(positions[slot.joint].1.abs()).max(1.0);
            parts.iter().map(Matrix4::norm).sum::<f64>() * furthest
        };
        let mut price = 0.0;
        while let Some(first) = self.slots.first() {
            let unlike = unlike(first);
            if unlike > SHARED || first.like.is_some() || self.slots.iter().any(|slot| slot.like == Some(0)) {
                break;
            }
            price += unlike * self.sizes(positions)[1];
            self.slots.remove(0);
            self.slots.iter_mut().for_each(|slot| slot.like = slot.like.map(|like| like - 1));
        }
        (self, price)
    }

    /// The same with the other sign of the second chain.
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

    /// Most corners that a part of a box has.
    pub(super) fn most_corners(&self, cell: &[Interval]) -> u64 {
        let own = self.slots.iter().filter(|slot| slot.like.is_none());
        let count = |slot: &FeatureSlot| slot.rate.map_or(2, |rate| corner_count(rate, cell[slot.joint]));
        own.fold(1, |product, slot| product.saturating_mul(count(slot) as u64))
    }

    /// What a box costs besides its corners, in corners: time for its motions and for looking where to
    /// divide, and memory. Measured.
    pub(super) fn overhead(&self) -> u64 {
        let slots = self.slots.len() as u64;
        32 + 20 * slots + 6 * slots * slots
    }

    /// CertifiedBounds the difference over a box; `nearest` receives the configuration of the box that is next to
    /// the worst corner, where a large difference is likely.
    pub(super) fn enclose(&self, cell: &[Interval], room: &mut Room, nearest: &mut [f64]) -> Enclosure {
        self.spread_corners(cell, room);
        self.multiply_out(room);
        let squared = |[a, b]: &[Vector4<f64>; 2]| (a - b).norm_squared();
        let (mut worst, mut largest) = (0, -1.0_f64);
        for (index, pair) in room.pairs.iter().enumerate() {
            let difference = squared(pair);
            if difference > largest {
                (worst, largest) = (index, difference);
            }
        }
        self.decode(worst, room);
        for (slot, corner) in self.slots.iter().zip(&room.best).filter(|(slot, _)| !slot.wraps(cell)) {
            nearest[slot.joint] = corner.position;
        }
        for (slot, corner) in self.slots.iter().zip(&room.best).filter(|(slot, _)| slot.wraps(cell)) {
            nearest[slot.joint] = slot.phase(corner, nearest[slot.joint], cell[slot.joint]);
        }
        let bound = largest.sqrt() + self.rounding(cell);
        let corners = room.pairs.len() as u64 + self.overhead();
        Enclosure { corners, ..self.promises(cell, &room.best, bound) }
    }

    fn at_corners(&self, corners: impl DoubleEndedIterator<Item = Corner> + ExactSizeIterator) -> f64 {
        let [mut a, mut b] = self.tips;
        for (slot, corner) in self.slots.iter().zip(corners).rev() {
            a = slot.motions[0].at(corner.features) * a;
            b = slot.motions[1].at(corner.features) * b;
        }
        (a - b).norm()
    }

    fn spread_corners(&self, cell: &[Interval], room: &mut Room) {
        room.corners.resize_with(self.slots.len(), Vec::new);
        for (slot, corners) in self.slots.iter().zip(&mut room.corners) {
            corners.clear();
            match slot.rate {
                Some(rate) => around_arc(rate, cell[slot.joint], corners),
                None => corners.extend(around_segment(cell[slot.joint])),
            }
        }
    }

    /// Carries the tips through every choice of corners, from the tip to the base: the last digit
    /// of an index is the corner of the first slot.
    fn multiply_out(&self, room: &mut Room) {
        let Room { corners, pairs, next_pairs, .. } = room;
        pairs.clear();
        pairs.push(self.tips);
        for (index, slot) in self.slots.iter().enumerate().rev() {
            if let Some(like) = slot.like {
                let motions = slot.motions_at(&corners[like]);
                let own = index + 1..like;
                let stride: usize =
                    own.filter(|&at| self.slots[at].like.is_none()).map(|at| corners[at].len()).product();
                for (number, [a, b]) in pairs.iter_mut().enumerate() {
                    let [by_a, by_b] = &motions[number / stride % corners[like].len()];
                    (*a, *b) = (by_a * *a, by_b * *b);
                }
                continue;
            }
            let motions = slot.motions_at(&corners[index]);
            next_pairs.clear();
            for [a, b] in pairs.iter() {
                let here = &motions[..corners[index].len()];
                next_pairs.extend(here.iter().map(|[by_a, by_b]| [by_a * a, by_b * b]));
            }
            std::mem::swap(pairs, next_pairs);
        }
    }

    /// The corners that an index of [`DifferenceNorm::multiply_out`] stands for.
    fn decode(&self, mut index: usize, room: &mut Room) {
        room.best.clear();
        for (slot, corners) in self.slots.iter().zip(&room.corners) {
            // A slot that takes another's corner has no digit; its corner is filled in below.
            let count = if slot.like.is_none() { corners.len() } else { 1 };
            room.best.push(corners[index % count]);
            index /= count;
        }
        for (at, slot) in self.slots.iter().enumerate() {
            if let Some(like) = slot.like {
                room.best[at] = room.best[like];
            }
        }
    }

    /// The joint whose corners lie outside of its arcs, or apart from one another, by most, measured
    /// in the difference; where none does, the joint that can turn or shift furthest.
    fn promises(&self, cell: &[Interval], worst: &[Corner], bound: f64) -> Enclosure {
        let here = self.at_corners(worst.iter().copied());
        let (mut divide, mut promise, mut promises) = (None, 0.0, 0.0);
        for (index, slot) in self.slots.iter().enumerate() {
            if self.slots[..index].iter().any(|before| before.joint == slot.joint) {
                continue;
            }
            let of_joint = self.slots.iter().zip(worst).filter(|(other, _)| other.joint == slot.joint);
            let pulled_in = of_joint.map(|(_, taken)| self.at_one_position(cell, worst, (slot.joint, taken)));
            let drop = here - pulled_in.fold(0.0, f64::max);
            promises += drop.max(0.0);
            if drop > promise {
                (divide, promise) = (Some(slot.joint), drop);
            }
        }
        let width =
            |slot: &&FeatureSlot| slot.rate.unwrap_or(1.0) * (cell[slot.joint].1 - cell[slot.joint].0);
        let widest = || self.slots.iter().max_by(|a, b| width(a).total_cmp(&width(b)));
        let divide = divide.or_else(|| widest().map(|slot| slot.joint)).unwrap_or(0);
        Enclosure { bound, divide, promise, promises, corners: 0 }
    }

    /// The difference with all corners of one joint moved onto their curves, to where one of them is.
    fn at_one_position(&self, cell: &[Interval], worst: &[Corner], (joint, taken): (usize, &Corner)) -> f64 {
        let moved = |(slot, &corner): (&FeatureSlot, &Corner)| {
            if slot.joint == joint { slot.on_curve(cell, corner, taken.position) } else { corner }
        };
        self.at_corners(self.slots.iter().zip(worst).map(moved))
    }

    /// What rounding can take from the largest difference that [`DifferenceNorm::enclose`] finds.
    ///
    /// A step's own rounding is its share of the vector that it gives, and all later steps stretch
    /// both alike: so the sum of the shares times the largest vector at the base covers them all.
    pub(super) fn rounding(&self, cell: &[Interval]) -> f64 {
        let shares = self.slots.iter().map(|slot| slot.growth(cell[slot.joint]).2).sum::<f64>();
        (ROUNDING_PER_MOTION + shares) * self.sizes(cell).iter().sum::<f64>()
    }

    /// The largest vectors that corners can give, of both chains.
    fn sizes(&self, cell: &[Interval]) -> [f64; 2] {
        let mut sizes = self.tips.map(|tip| tip.norm());
        for slot in self.slots.iter().rev() {
            let (stretch, shift, _) = slot.growth(cell[slot.joint]);
            for (size, motion) in sizes.iter_mut().zip(&slot.motions) {
                *size = stretch * *size + shift * motion.carries;
            }
        }
        sizes
    }
}
