//! The bound from above: branch and bound over the box of all configurations. The box with the largest
//! bound is split until that bound meets the largest difference that a configuration attains.

use congruent_kinematics::best_first::{halves, least_upper_bound};

use super::{
    budget::{Budget, ROUNDING_LEVEL},
    corner::PositionInterval,
    difference_norm::{DifferenceNorm, EnclosureBuffers},
    search::Incumbent,
};

/// Most corners of one box. A box with more of them (more than ten joints that matter) is not bounded;
/// the telescoping bound remains.
const MAX_CORNERS_OF_BOX: u64 = 1 << 20;

/// Most memory of the boxes of one search, bytes; beyond, the bound that was reached holds. Kind: choice; 2.7 million boxes of
/// six joints, of which the searches of all examples need a tenth.
const MOST_BYTES: usize = 512 << 20;

/// What a queue and an allocator need for one box beside it. Unit: bytes; kind: measured, 60 to 80.
const BYTES_OF_A_PLACE: usize = 80;

/// Each box whose number has remainder 1 modulo this is bounded by every bound; every other box only by
/// the bound that was least for the box that it is half of.
const ALL_BOUNDS_EVERY: u64 = 8;

/// The result of a search: no configuration is above `certified`, and the incumbent shows how close that is.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct BracketOutcome {
    pub(super) incumbent: Incumbent,
    /// No configuration has a larger disagreement; m or rad, infinite if no bound is affordable.
    pub(super) certified: f64,
    /// Number of boxes that were bounded.
    pub(super) boxes: u64,
}

/// The conversion from the norm of a difference to a disagreement.
#[derive(Debug, Clone, Copy)]
pub(super) struct NormConversion {
    /// The disagreement for a norm, m or rad; it grows with the norm.
    pub(super) from_norm: fn(f64) -> f64,
    /// Larger norms are no larger disagreements.
    pub(super) max_norm: f64,
}

/// An upper bound of the disagreement: the sum of the disagreements of `differences`, and `slack` for what
/// simplification has removed from them.
#[derive(Debug, Clone)]
pub(super) struct DisagreementBound {
    pub(super) differences: Vec<DifferenceNorm>,
    pub(super) slack: f64,
}

/// One maximisation over the box of all joint ranges: the difference, and upper bounds of it.
pub(super) struct BracketTask<'a> {
    pub(super) difference: &'a DifferenceNorm,
    /// The first one is the difference itself.
    pub(super) bounds: Vec<DisagreementBound>,
    pub(super) ranges: &'a [PositionInterval],
    pub(super) conversion: NormConversion,
    pub(super) budget: Budget,
}

/// A box of configurations with its bound, an open node of the search.
#[derive(Debug, Clone)]
struct BoxNode {
    bound: f64,
    intervals: Vec<PositionInterval>,
    /// The joint whose interval is split next; past the last joint if the bound depends on none.
    split_joint: usize,
    /// Which of the task's bounds was least.
    bound_index: usize,
}

/// The state of a search: the best configuration so far, buffers, and the work that was done.
struct BranchAndBound<'a> {
    task: &'a BracketTask<'a>,
    incumbent: Incumbent,
    buffers: EnclosureBuffers,
    nearest: Vec<f64>,
    boxes: u64,
    corners_spent: u64,
}

impl BranchAndBound<'_> {
    fn attained(&self) -> f64 {
        (self.task.conversion.from_norm)(self.incumbent.norm)
    }

    /// The bound at which the bracket is narrow enough.
    fn target(&self) -> f64 {
        (self.attained() * (1.0 + self.task.budget.relative_gap)).max(ROUNDING_LEVEL)
    }

    /// Bounds a box that is part of a larger one, starting with the bound that was least for the larger.
    fn bound(&mut self, intervals: Vec<PositionInterval>, outer: f64, bound_index: usize) -> BoxNode {
        self.boxes += 1;
        // A part of a box has no larger maximum than the box, so the bound of the box is where the bound of the part
        // starts: bounds never grow from a box to its halves, whichever bound is computed for them.
        let mut node = BoxNode { bound: outer, intervals, split_joint: 0, bound_index };
        let reduction = self.bound_by(bound_index, &mut node);
        // The bound that was least for the larger box is mostly least for its halves as well. Evaluating all of them
        // for each box would cost up to five times as many corners; now and then suffices to notice a change. The
        // first box has number 1: it is bounded by all.
        let others = if self.boxes % ALL_BOUNDS_EVERY == 1 { self.task.bounds.len() } else { 0 };
        // Bounds over intermediate chains have a gap that no split closes: the steps have their maxima at different
        // configurations. Only bound 0, of the difference itself, converges to the maximum as boxes shrink. So if
        // all that were tried are stuck above the target, the box and its parts go back to bound 0, although it may
        // be wider here.
        let mut is_stuck = bound_index > 0 && self.is_stuck(reduction, &node);
        for other in (1..others).filter(|&other| other != bound_index) {
            let reduction = self.bound_by(other, &mut node);
            is_stuck &= self.is_stuck(reduction, &node);
        }
        if is_stuck && node.bound > self.target() {
            // Set first: `bound_by` then takes the split joint of bound 0 even if its value is not the least.
            node.bound_index = 0;
            self.bound_by(0, &mut node);
        }
        node
    }

    /// Whether a bound that splitting can reduce by so much cannot reach the target.
    fn is_stuck(&self, reduction: f64, node: &BoxNode) -> bool {
        // Half, since the reduction is an estimate: it adds up what single joints bring and ignores what they bring
        // together.
        reduction < 0.5 * (node.bound - self.target())
    }

    /// Lowers the bound of a box by one of the task's bounds if that is lower, and starts a local search
    /// at the configuration nearest to the worst corner if it is better than the incumbent. Returns the
    /// reduction that splitting can bring. The bound that is lowest, or that the box had before, decides
    /// which joint is split.
    fn bound_by(&mut self, bound_index: usize, node: &mut BoxNode) -> f64 {
        let DisagreementBound { differences, slack } = &self.task.bounds[bound_index];
        let (mut sum, mut total_reduction, mut best) = (*slack, 0.0, (-1.0, usize::MAX));
        // `enclose` writes only the joints that a difference depends on; the others keep the incumbent's positions.
        self.nearest.copy_from_slice(&self.incumbent.at);
        for difference in differences {
            let found = difference.enclose(&node.intervals, &mut self.buffers, &mut self.nearest);
            // `from_norm` grows with the norm, so a bound of the norm gives a bound of the disagreement, and by the
            // triangle inequality the disagreements of consecutive steps add up (docs/bound.md, section 8).
            sum += (self.task.conversion.from_norm)(found.bound);
            total_reduction += found.total_reduction;
            // A constant step names joint 0 for want of another one; splitting that would be useless.
            if !difference.is_constant() && found.reduction > best.0 {
                best = (found.reduction, found.split_joint);
            }
            self.corners_spent += found.corners;
        }
        // Attained is what the difference itself has at a configuration; the steps of a sequence attain nothing. The
        // local search costs as much as many boxes, so it starts only where the difference is already larger.
        let mut found = Incumbent::new(self.task.difference, self.nearest.clone());
        if found.norm > self.incumbent.norm {
            found.ascend(self.task.difference, self.task.ranges);
            self.incumbent = found;
        }
        // The joint that is split must be one on which the bound in use depends, otherwise the halves get the same
        // bound again and the search does not end before its budget.
        if sum < node.bound || bound_index == node.bound_index {
            (node.split_joint, node.bound_index) = (best.1, bound_index);
        }
        node.bound = node.bound.min(sum);
        total_reduction
    }

    /// The halves of a box; `None` if its bound is good enough, or cannot be improved.
    fn split(&mut self, node: &BoxNode) -> Option<Vec<BoxNode>> {
        let is_spent = self.corners_spent >= self.task.budget.corners || self.boxes >= self.most_boxes();
        if self.is_largest_possible() || is_spent || node.bound <= self.target() {
            return None;
        }
        // If no step depends on a joint, the split joint is past the end.
        let halves = halves(*node.intervals.get(node.split_joint)?)?;
        let parts = halves.map(|half| {
            let mut intervals = node.intervals.clone();
            intervals[node.split_joint] = half;
            self.bound(intervals, node.bound, node.bound_index)
        });
        Some(parts.into())
    }

    /// The number of boxes that fit into the memory of a search: each has its intervals, and its place in the queue.
    fn most_boxes(&self) -> u64 {
        let bytes = size_of::<BoxNode>() + size_of_val(self.task.ranges) + BYTES_OF_A_PLACE;
        (MOST_BYTES / bytes) as u64
    }

    /// Whether no configuration can have a larger disagreement than the one that was found.
    fn is_largest_possible(&self) -> bool {
        self.incumbent.norm >= self.task.conversion.max_norm
    }
}

/// Brackets the largest disagreement over the ranges.
pub(super) fn bracket(task: &BracketTask<'_>, incumbent: Incumbent) -> BracketOutcome {
    // No bound is affordable: the caller has the telescoping bound, which needs no boxes.
    if task.bounds.is_empty() {
        return BracketOutcome { incumbent, certified: f64::INFINITY, boxes: 0 };
    }
    let nearest = incumbent.at.clone();
    let buffers = EnclosureBuffers::default();
    let mut search = BranchAndBound { task, incumbent, buffers, nearest, boxes: 0, corners_spent: 0 };
    // The outermost box has nothing around it, so its bound starts at infinity.
    let whole = search.bound(task.ranges.to_vec(), f64::INFINITY, 0);
    let mut certified = least_upper_bound(whole, |node| node.bound, |node| search.split(node));
    // Orientations half a turn apart: no disagreement is larger, so the bracket is closed without a further box.
    // Beyond that norm the other sign of the quaternion is nearer, and the angle is smaller than half a turn; so
    // the configuration is moved back to where the norm is exactly the largest.
    if search.is_largest_possible() {
        search.incumbent.descend_to(task.conversion.max_norm, task.difference, task.ranges);
        certified = (task.conversion.from_norm)(task.conversion.max_norm);
    }
    let (boxes, attained) = (search.boxes, search.attained());
    // Where the bound is exact, the attained difference can be above it by rounding.
    BracketOutcome { certified: certified.max(attained), incumbent: search.incumbent, boxes }
}

impl DisagreementBound {
    /// Whether its boxes have few enough corners for a budget.
    pub(super) fn is_affordable(&self, ranges: &[PositionInterval], budget: Budget) -> bool {
        self.differences.iter().all(|difference| is_affordable(difference, ranges, budget))
    }
}

/// Whether the boxes of a difference have few enough corners for a budget.
pub(super) fn is_affordable(
    difference: &DifferenceNorm,
    ranges: &[PositionInterval],
    budget: Budget,
) -> bool {
    let cost = difference.max_corners(ranges).saturating_add(difference.overhead());
    cost <= MAX_CORNERS_OF_BOX.min(budget.corners)
}
