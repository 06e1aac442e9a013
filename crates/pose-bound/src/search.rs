//! The bound from below: a configuration with a large difference, by local search from many starts. Nothing
//! is random: the starts are a lattice, so the same chains give the same configuration.

use super::{corner::PositionInterval, difference_norm::DifferenceNorm, joint_sweep::SlotSweep};

/// Number of starts in addition to the middle of the ranges.
const STARTS: usize = 16;
/// Fewer of them, but at least [`FEWEST_STARTS`], if starts times joints are more: a start costs as much as its joints.
/// Kind: speed; chains of so many joints have no bound by corners that a better start would meet.
const STARTS_TIMES_JOINTS: usize = 640;
/// See [`STARTS_TIMES_JOINTS`].
const FEWEST_STARTS: usize = 4;
/// A local search starts with steps of this part of a range and ends below [`LAST_STEP`].
const FIRST_STEP: f64 = 0.25;
/// Smallest step, as part of a range: the difference is flat near a maximum, so its error is the square of
/// this.
const LAST_STEP: f64 = 1e-8;
/// Most rounds over all joints in one local search.
const MAX_ROUNDS: u32 = 200;
/// A step must enlarge the difference by this part of it: a smaller gain is not worth a step, or rounding.
const MIN_GAIN: f64 = 1e-9;

/// A configuration and its difference; the best one so far is the incumbent of branch and bound.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Incumbent {
    /// Norm of the difference there.
    pub(super) norm: f64,
    pub(super) at: Vec<f64>,
}

impl Incumbent {
    /// The difference at `at`.
    pub(super) fn new(difference: &DifferenceNorm, at: Vec<f64>) -> Self {
        Self { norm: difference.at(&at), at }
    }

    /// The best local maximum from all starts.
    pub(super) fn search(difference: &DifferenceNorm, ranges: &[PositionInterval]) -> Self {
        let mut best =
            Self::new(difference, ranges.iter().map(|range| f64::midpoint(range.0, range.1)).collect());
        // The middle first: of equal maxima the first one counts, so a difference that is the same everywhere is
        // reported in the middle of the ranges.
        best.ascend(difference, ranges);
        for start in starts(ranges) {
            let mut found = Self::new(difference, start);
            found.ascend(difference, ranges);
            if found.norm > best.norm {
                best = found;
            }
        }
        best
    }

    /// The better local maximum of two starts: a configuration, and the middle of the ranges.
    pub(super) fn near(difference: &DifferenceNorm, ranges: &[PositionInterval], at: &[f64]) -> Self {
        let middle = ranges.iter().map(|range| f64::midpoint(range.0, range.1)).collect();
        let [mut one, mut two] = [Self::new(difference, at.to_vec()), Self::new(difference, middle)];
        one.ascend(difference, ranges);
        two.ascend(difference, ranges);
        if two.norm > one.norm { two } else { one }
    }

    /// Moves one joint at a time as long as that enlarges the difference, in ever smaller steps. A round costs as much
    /// as some evaluations of the difference, whatever the number of joints.
    pub(super) fn ascend(&mut self, difference: &DifferenceNorm, ranges: &[PositionInterval]) {
        let mut step = FIRST_STEP;
        // Without this a search on a difference of a few nm would follow the rounding of its own arithmetic.
        let rounding = difference.rounding(&self.at.iter().map(|&q| (q, q)).collect::<Vec<_>>());
        let mut sweep = SlotSweep::new(difference, &self.at);
        for _ in 0..MAX_ROUNDS {
            if step < LAST_STEP {
                break;
            }
            let norm = self.norm;
            sweep.round(&mut self.at, |joint, before, difference_at| {
                let (lower, upper) = ranges[joint];
                let reach = step * (upper - lower);
                // Clamped, so that a maximum at a limit of the range, which is frequent, is reached exactly.
                let further = [reach, -reach].map(|by| (before + by).clamp(lower, upper));
                let least = self.norm * (1.0 + MIN_GAIN) + rounding;
                let mut moved = further.into_iter().map(|position| (position, difference_at(position)));
                let (position, norm) = moved.find(|(_, norm)| *norm > least)?;
                self.norm = norm;
                Some(position)
            });
            // Smaller steps only after a round without gain: halving sooner would end on a slope.
            if self.norm <= norm {
                step /= 2.0;
            }
        }
        // The sweep multiplies in another order and rounds differently; the reported norm must be that of `at`.
        self.norm = difference.at(&self.at);
    }

    /// Bisects towards the middle of the ranges until the difference is `max_norm`: it is continuous, larger
    /// here and smaller there, so some configuration between has exactly that.
    pub(super) fn descend_to(
        &mut self,
        max_norm: f64,
        difference: &DifferenceNorm,
        ranges: &[PositionInterval],
    ) {
        const HALVINGS: u32 = 60;
        let far = self.at.clone();
        let middle: Vec<f64> = ranges.iter().map(|range| f64::midpoint(range.0, range.1)).collect();
        let between =
            |part: f64| far.iter().zip(&middle).map(move |(far, middle)| middle + part * (far - middle));
        let (mut inside, mut outside) = (0.0, 1.0);
        // Ends with the inside or the outside point of an interval of 2^-60 of the path: the two norms differ by
        // rounding.
        for _ in 0..HALVINGS {
            let part = f64::midpoint(inside, outside);
            *self = Self::new(difference, between(part).collect());
            if self.norm > max_norm {
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
fn starts(ranges: &[PositionInterval]) -> impl Iterator<Item = Vec<f64>> {
    const ITERATIONS: u32 = 60;
    let root_power = 1.0 / f64::from(u32::try_from(ranges.len()).unwrap_or(u32::MAX).saturating_add(1));
    // Fixed-point iteration of `x = (1 + x)^(1 / (n + 1))`; its slope is below 1/2, so 60 steps reach rounding.
    let root = (0..ITERATIONS).fold(2.0_f64, |x, _| libm::pow(1.0 + x, root_power));
    // 16 starts up to 40 joints, then fewer.
    let count = (STARTS_TIMES_JOINTS / ranges.len().max(1)).clamp(FEWEST_STARTS, STARTS);
    (1_u32..).take(count).map(move |start| {
        let mut step = 1.0;
        let coordinate = |&(lower, upper): &PositionInterval| {
            step /= root;
            lower + (upper - lower) * (0.5 + f64::from(start) * step).fract()
        };
        ranges.iter().map(coordinate).collect()
    })
}
