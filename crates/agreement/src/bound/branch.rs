//! From above: the box of all configurations is divided where the bound is largest, until the bound
//! meets what is attained.

use std::{cmp::Ordering, collections::BinaryHeap};

use super::{
    budget::{Budget, ROUNDING_LEVEL},
    corner::Interval,
    difference_norm::{DifferenceNorm, Room},
    search::Attained,
};

/// Most corners of one box: beyond, and that is beyond ten joints that matter, the telescoping_bound sum has
/// to do.
const MOST_CORNERS_OF_CELL: u64 = 1 << 20;

/// What came of it: `attained <= certified`, as far as rounding lets one tell.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct BracketOutcome {
    pub(super) attained: Attained,
    /// No configuration disagrees more; m or rad, infinite where no bound could be had.
    pub(super) certified: f64,
    /// Number of boxes that were bounded.
    pub(super) cells: u64,
}

/// How a difference is read.
#[derive(Debug, Clone, Copy)]
pub(super) struct NormReading {
    /// The disagreement for a difference, m or rad.
    pub(super) of_norm: fn(f64) -> f64,
    /// Gaps beyond it are no larger disagreements.
    pub(super) ceiling: f64,
}

/// Gaps whose disagreements together, and the price of what they leave out, bound the one in
/// criterion.
#[derive(Debug, Clone)]
pub(super) struct UpperBound {
    pub(super) steps: Vec<DifferenceNorm>,
    pub(super) price: f64,
}

/// What is in criterion: the difference itself, which is attained, and bounds of it.
pub(super) struct BracketTask<'a> {
    pub(super) difference: &'a DifferenceNorm,
    /// The difference as its own bound comes first.
    pub(super) bounds: Vec<UpperBound>,
    pub(super) ranges: &'a [Interval],
    pub(super) scale: NormReading,
    pub(super) budget: Budget,
}

/// A box of configurations that waits.
#[derive(Debug, Clone)]
struct Cell {
    bound: f64,
    number: u64,
    intervals: Vec<Interval>,
    /// The joint to divide; none of them where no bound depends on one.
    divide: usize,
    /// Which bound was least.
    by: usize,
}

/// Largest bound first; of equal ones the oldest, so that the order is fixed.
impl Ord for Cell {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound).then(other.number.cmp(&self.number))
    }
}

impl PartialOrd for Cell {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Cell {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Cell {}

/// A search under way.
struct BranchAndBound<'a> {
    task: &'a BracketTask<'a>,
    attained: Attained,
    room: Room,
    nearest: Vec<f64>,
    cells: u64,
    /// In corners.
    spent: u64,
}

/// The other bounds are asked for each box with a number that this divides: between, a box is bounded
/// by what was best for the one it is part of.
const ASK_ALL: u64 = 8;

impl BranchAndBound<'_> {
    fn attained(&self) -> f64 {
        (self.task.scale.of_norm)(self.attained.difference)
    }

    /// Where the bracket is narrow enough.
    fn enough(&self) -> f64 {
        (self.attained() * (1.0 + self.task.budget.relative_gap)).max(ROUNDING_LEVEL)
    }

    /// CertifiedBounds a box that is part of another one, by what bounded that one.
    fn bound(&mut self, intervals: Vec<Interval>, (above, by): (f64, usize)) -> Cell {
        self.cells += 1;
        let mut cell = Cell { bound: above, number: self.cells, intervals, divide: 0, by };
        let promise = self.bound_by(by, &mut cell);
        let others = if cell.number % ASK_ALL == 1 { self.task.bounds.len() } else { 0 };
        let mut is_stuck = by > 0 && self.is_stuck(promise, &cell);
        for other in (1..others).filter(|&other| other != by) {
            let promise = self.bound_by(other, &mut cell);
            is_stuck &= self.is_stuck(promise, &cell);
        }
        if is_stuck && cell.bound > self.enough() {
            cell.by = 0;
            self.bound_by(0, &mut cell);
        }
        cell
    }

    /// Whether dividing further for a bound with this promise cannot close the bracket.
    fn is_stuck(&self, promise: f64, cell: &Cell) -> bool {
        promise < 0.5 * (cell.bound - self.enough())
    }

    /// Lowers the bound of a box, where that is so, and climbs from its most promising configuration,
    /// where that is news; how much dividing promises. What lowers the bound most, or is asked because
    /// the cell is its own, says where to divide.
    fn bound_by(&mut self, by: usize, cell: &mut Cell) -> f64 {
        let UpperBound { steps, price } = &self.task.bounds[by];
        let (mut sum, mut promises, mut best) = (*price, 0.0, (-1.0, usize::MAX));
        self.nearest.copy_from_slice(&self.attained.at);
        for step in steps {
            let enclosure = step.enclose(&cell.intervals, &mut self.room, &mut self.nearest);
            sum += (self.task.scale.of_norm)(enclosure.bound);
            promises += enclosure.promises;
            if !step.is_constant() && enclosure.promise > best.0 {
                best = (enclosure.promise, enclosure.divide);
            }
            self.spent += enclosure.corners;
        }
        let mut found = Attained::new(self.task.difference, self.nearest.clone());
        if found.difference > self.attained.difference {
            found.ascend(self.task.difference, self.task.ranges);
            self.attained = found;
        }
        if sum < cell.bound || by == cell.by {
            (cell.divide, cell.by) = (best.1, by);
        }
        cell.bound = cell.bound.min(sum);
        promises
    }

    fn halves(&mut self, cell: &Cell) -> [Cell; 2] {
        let (lower, upper) = cell.intervals[cell.divide];
        let middle = f64::midpoint(lower, upper);
        [(lower, middle), (middle, upper)].map(|half| {
            let mut intervals = cell.intervals.clone();
            intervals[cell.divide] = half;
            self.bound(intervals, (cell.bound, cell.by))
        })
    }
}

/// Brackets the largest disagreement over the ranges.
pub(super) fn bracket(task: &BracketTask<'_>, attained: Attained) -> BracketOutcome {
    let nearest = attained.at.clone();
    let mut search = BranchAndBound { task, attained, room: Room::default(), nearest, cells: 0, spent: 0 };
    if task.bounds.is_empty() {
        return BracketOutcome { attained: search.attained, certified: f64::INFINITY, cells: 0 };
    }
    let Budget { corners, .. } = task.budget;
    let mut open = BinaryHeap::from([search.bound(task.ranges.to_vec(), (f64::INFINITY, 0))]);
    let certified = loop {
        let Some(cell) = open.pop() else { unreachable!("a box that is taken leaves two behind") };
        if search.attained.difference >= task.scale.ceiling {
            search.attained.descend_to(task.scale.ceiling, task.difference, task.ranges);
            break (task.scale.of_norm)(task.scale.ceiling);
        }
        let (lower, upper) = cell.intervals.get(cell.divide).copied().unwrap_or_default();
        let middle = f64::midpoint(lower, upper);
        let divisible = lower < middle && middle < upper;
        if cell.bound <= search.enough() || search.spent >= corners || !divisible {
            break cell.bound;
        }
        open.extend(search.halves(&cell));
    };
    let (cells, attained_here) = (search.cells, search.attained());
    BracketOutcome { certified: certified.max(attained_here), attained: search.attained, cells }
}

impl UpperBound {
    /// Whether its boxes are few enough corners for a budget.
    pub(super) fn is_affordable(&self, ranges: &[Interval], budget: Budget) -> bool {
        self.steps.iter().all(|difference| is_affordable(difference, ranges, budget))
    }
}

/// Whether the boxes of a difference have few enough corners for a budget.
pub(super) fn is_affordable(difference: &DifferenceNorm, ranges: &[Interval], budget: Budget) -> bool {
    let cost = difference.most_corners(ranges).saturating_add(difference.overhead());
    cost <= MOST_CORNERS_OF_CELL.min(budget.corners)
}
