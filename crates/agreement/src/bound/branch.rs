//! The bound from above: branch and bound over the box of all configurations. The box with the largest
//! bound is split until that bound meets the largest difference that a configuration attains.

use std::{cmp::Ordering, collections::BinaryHeap};

use super::{
    budget::{Budget, ROUNDING_LEVEL},
    corner::Interval,
    difference_norm::{DifferenceNorm, EnclosureBuffers},
    search::Incumbent,
};

/// Most corners of one box. A box with more of them (more than ten joints that matter) is not bounded;
/// the telescoping bound remains.
const MAX_CORNERS_OF_BOX: u64 = 1 << 20;

/// Each box whose number has remainder 1 modulo this is bounded by every bound; every other box only by
/// the bound that was least for the box that it is half of.
const ALL_BOUNDS_EVERY: u64 = 8;

/// The bracket that was found: the incumbent attains at most `certified`, up to rounding.
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

/// An upper bound of the disagreement: the sum of the disagreements of `differences`, and `slack` for
/// what they leave out.
#[derive(Debug, Clone)]
pub(super) struct UpperBound {
    pub(super) differences: Vec<DifferenceNorm>,
    pub(super) slack: f64,
}

/// One maximisation: the difference that a configuration attains, and upper bounds of it.
pub(super) struct BracketTask<'a> {
    pub(super) difference: &'a DifferenceNorm,
    /// The first one is the difference itself.
    pub(super) bounds: Vec<UpperBound>,
    pub(super) ranges: &'a [Interval],
    pub(super) conversion: NormConversion,
    pub(super) budget: Budget,
}

/// A box of configurations with its bound, an open node of the search.
#[derive(Debug, Clone)]
struct BoxNode {
    bound: f64,
    number: u64,
    intervals: Vec<Interval>,
    /// The joint whose interval is split next; past the last joint if the bound depends on none.
    split_joint: usize,
    /// Which of the task's bounds was least.
    bound_index: usize,
}

/// Largest bound first; of equal bounds the oldest box, so that the order is fixed.
impl Ord for BoxNode {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound).then(other.number.cmp(&self.number))
    }
}

impl PartialOrd for BoxNode {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for BoxNode {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for BoxNode {}

/// The state of a search.
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
    fn bound(&mut self, intervals: Vec<Interval>, (outer, bound_index): (f64, usize)) -> BoxNode {
        self.boxes += 1;
        let mut node = BoxNode { bound: outer, number: self.boxes, intervals, split_joint: 0, bound_index };
        let reduction = self.bound_by(bound_index, &mut node);
        let others = if node.number % ALL_BOUNDS_EVERY == 1 { self.task.bounds.len() } else { 0 };
        let mut is_stuck = bound_index > 0 && self.is_stuck(reduction, &node);
        for other in (1..others).filter(|&other| other != bound_index) {
            let reduction = self.bound_by(other, &mut node);
            is_stuck &= self.is_stuck(reduction, &node);
        }
        if is_stuck && node.bound > self.target() {
            node.bound_index = 0;
            self.bound_by(0, &mut node);
        }
        node
    }

    /// Whether a bound that splitting can reduce by so much cannot reach the target.
    fn is_stuck(&self, reduction: f64, node: &BoxNode) -> bool {
        reduction < 0.5 * (node.bound - self.target())
    }

    /// Lowers the bound of a box by one of the task's bounds if that is lower, and starts a local search
    /// at the configuration nearest to the worst corner if it is better than the incumbent. Returns the
    /// reduction that splitting can bring. The bound that is lowest, or that the box had before, decides
    /// which joint is split.
    fn bound_by(&mut self, bound_index: usize, node: &mut BoxNode) -> f64 {
        let UpperBound { differences, slack } = &self.task.bounds[bound_index];
        let (mut sum, mut total_reduction, mut best) = (*slack, 0.0, (-1.0, usize::MAX));
        self.nearest.copy_from_slice(&self.incumbent.at);
        for difference in differences {
            let found = difference.enclose(&node.intervals, &mut self.buffers, &mut self.nearest);
            sum += (self.task.conversion.from_norm)(found.bound);
            total_reduction += found.total_reduction;
            if !difference.is_constant() && found.reduction > best.0 {
                best = (found.reduction, found.split_joint);
            }
            self.corners_spent += found.corners;
        }
        let mut found = Incumbent::new(self.task.difference, self.nearest.clone());
        if found.norm > self.incumbent.norm {
            found.ascend(self.task.difference, self.task.ranges);
            self.incumbent = found;
        }
        if sum < node.bound || bound_index == node.bound_index {
            (node.split_joint, node.bound_index) = (best.1, bound_index);
        }
        node.bound = node.bound.min(sum);
        total_reduction
    }

    fn split(&mut self, node: &BoxNode) -> [BoxNode; 2] {
        let (lower, upper) = node.intervals[node.split_joint];
        let middle = f64::midpoint(lower, upper);
        [(lower, middle), (middle, upper)].map(|half| {
            let mut intervals = node.intervals.clone();
            intervals[node.split_joint] = half;
            self.bound(intervals, (node.bound, node.bound_index))
        })
    }
}

/// Brackets the largest disagreement over the ranges.
pub(super) fn bracket(task: &BracketTask<'_>, incumbent: Incumbent) -> BracketOutcome {
    if task.bounds.is_empty() {
        return BracketOutcome { incumbent, certified: f64::INFINITY, boxes: 0 };
    }
    let nearest = incumbent.at.clone();
    let buffers = EnclosureBuffers::default();
    let mut search = BranchAndBound { task, incumbent, buffers, nearest, boxes: 0, corners_spent: 0 };
    let Budget { corners, .. } = task.budget;
    let mut open = BinaryHeap::from([search.bound(task.ranges.to_vec(), (f64::INFINITY, 0))]);
    let certified = loop {
        let Some(node) = open.pop() else {
            unreachable!("a box that is taken is replaced by its two halves")
        };
        if search.incumbent.norm >= task.conversion.max_norm {
            search.incumbent.descend_to(task.conversion.max_norm, task.difference, task.ranges);
            break (task.conversion.from_norm)(task.conversion.max_norm);
        }
        let (lower, upper) = node.intervals.get(node.split_joint).copied().unwrap_or_default();
        let middle = f64::midpoint(lower, upper);
        let divisible = lower < middle && middle < upper;
        if node.bound <= search.target() || search.corners_spent >= corners || !divisible {
            break node.bound;
        }
        open.extend(search.split(&node));
    };
    let (boxes, attained) = (search.boxes, search.attained());
    BracketOutcome { certified: certified.max(attained), incumbent: search.incumbent, boxes }
}

impl UpperBound {
    /// Whether its boxes have few enough corners for a budget.
    pub(super) fn is_affordable(&self, ranges: &[Interval], budget: Budget) -> bool {
        self.differences.iter().all(|difference| is_affordable(difference, ranges, budget))
    }
}

/// Whether the boxes of a difference have few enough corners for a budget.
pub(super) fn is_affordable(difference: &DifferenceNorm, ranges: &[Interval], budget: Budget) -> bool {
    let cost = difference.max_corners(ranges).saturating_add(difference.overhead());
    cost <= MAX_CORNERS_OF_BOX.min(budget.corners)
}
