//! From below: configurations with a large difference, by climbing from many starts. No randomness: the
//! starts are a lattice, so the same chains give the same configuration.

use super::{corner::Interval, difference_norm::DifferenceNorm};

/// Number of starts besides the middle of the ranges.
const STARTS: u32 = 16;
/// A climb starts with steps of this part of a range and ends below [`LAST_STEP`].
const FIRST_STEP: f64 = 0.25;
/// Where a climb ends: near a maximum the difference is flat, so its error is the square of this.
const LAST_STEP: f64 = 1e-8;
/// Most rounds over all joints in one climb.
const MOST_ROUNDS: u32 = 200;

/// A move must widen the difference by this part of it: what is less is no news, or rounding.
const LEAST_GAIN: f64 = 1e-9;

/// A configuration and its difference.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Attained {
    pub(super) difference: f64,
    pub(super) at: Vec<f64>,
}

impl Attained {
    /// The difference at `at`.
    pub(super) fn new(difference: &DifferenceNorm, at: Vec<f64>) -> Self {
        Self { difference: difference.at(&at), at }
    }

    /// The best of climbs from all starts.
    pub(super) fn search(difference: &DifferenceNorm, ranges: &[Interval]) -> Self {
        let mut best =
            Self::new(difference, ranges.iter().map(|range| f64::midpoint(range.0, range.1)).collect());
        best.ascend(difference, ranges);
        for start in starts(ranges) {
            let mut found = Self::new(difference, start);
            found.ascend(difference, ranges);
            if found.difference > best.difference {
                best = found;
            }
        }
        best
    }

    /// The better of climbs from a configuration and from the middle of the ranges.
    pub(super) fn near(difference: &DifferenceNorm, ranges: &[Interval], at: &[f64]) -> Self {
        let middle = ranges.iter().map(|range| f64::midpoint(range.0, range.1)).collect();
        let [mut one, mut two] = [Self::new(difference, at.to_vec()), Self::new(difference, middle)];
        one.ascend(difference, ranges);
        two.ascend(difference, ranges);
        if two.difference > one.difference { two } else { one }
    }

    /// Moves one joint at a time, as long as that widens the difference, in ever smaller steps.
    pub(super) fn ascend(&mut self, difference: &DifferenceNorm, ranges: &[Interval]) {
        let mut step = FIRST_STEP;
        let noise = difference.rounding(&self.at.iter().map(|&q| (q, q)).collect::<Vec<_>>());
        for _ in 0..MOST_ROUNDS {
            if step < LAST_STEP {
                return;
            }
            let mut improved = false;
            for (joint, &(lower, upper)) in ranges.iter().enumerate() {
                let reach = step * (upper - lower);
                let before = self.at[joint];
                improved |= [reach, -reach]
                    .iter()
                    .any(|by| self.moves(difference, (joint, (before + by).clamp(lower, upper)), noise));
            }
            if !improved {
                step /= 2.0;
            }
        }
    }

    /// Moves one joint there if that widens the difference by more than noise.
    fn moves(&mut self, difference: &DifferenceNorm, (joint, position): (usize, f64), noise: f64) -> bool {
        let before = std::mem::replace(&mut self.at[joint], position);
        let wider = difference.at(&self.at);
        let improves = wider > self.difference * (1.0 + LEAST_GAIN) + noise;
        if improves {
            self.difference = wider;
        } else {
            self.at[joint] = before;
        }
        improves
    }

    /// Comes back towards the middle of the ranges until the difference is `ceiling`: it is continuous, so
    /// where it is beyond here and below there, it is met between.
    pub(super) fn descend_to(&mut self, ceiling: f64, difference: &DifferenceNorm, ranges: &[Interval]) {
        const HALVINGS: u32 = 60;
        let far = self.at.clone();
        let middle: Vec<f64> = ranges.iter().map(|range| f64::midpoint(range.0, range.1)).collect();
        let between =
            |part: f64| far.iter().zip(&middle).map(move |(far, middle)| middle + part * (far - middle));
        let (mut inside, mut outside) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let part = f64::midpoint(inside, outside);
            *self = Self::new(difference, between(part).collect());
            if self.difference > ceiling {
                outside = part;
            } else {
                inside = part;
            }
        }
    }
}

/// A lattice that fills the ranges evenly for any number of joints.
///
/// Source: Roberts, *The unreasonable effectiveness of quasirandom sequences* (2018): steps are
/// powers of the root of `x^(n + 1) = x + 1`.
fn starts(ranges: &[Interval]) -> impl Iterator<Item = Vec<f64>> {
    const ITERATIONS: u32 = 60;
    let root_power = 1.0 / f64::from(u32::try_from(ranges.len()).unwrap_or(u32::MAX).saturating_add(1));
    let root = (0..ITERATIONS).fold(2.0_f64, |x, _| (1.0 + x).powf(root_power));
    (1..=STARTS).map(move |start| {
        let mut step = 1.0;
        let place = |&(lower, upper): &Interval| {
            step /= root;
            lower + (upper - lower) * (0.5 + f64::from(start) * step).fract()
        };
        ranges.iter().map(place).collect()
    })
}
