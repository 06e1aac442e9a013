//! From above: the box of all configurations is divided where the bound is largest, until the bound
//! meets what is attained.

use std::{cmp::Ordering, collections::BinaryHeap};

use super::{
    Budget, ROUNDING_LEVEL,
    corner::Interval,
    gap::{Gap, Room},
    search::Attained,
};

/// What a box costs besides its corners, in corners: time for its motions, and memory.
const CORNERS_PER_CELL: u64 = 256;

/// Most corners of one box: beyond, and that is beyond ten joints that matter, the telescoped sum has
/// to do.
const MOST_CORNERS_OF_CELL: u64 = 1 << 20;

/// What came of it: `attained.gap <= certified`, as far as rounding lets one tell.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Outcome {
    pub(super) attained: Attained,
    /// No configuration has a larger gap; infinite where the budget does not suffice for one box.
    pub(super) certified: f64,
    /// Number of boxes that were bounded.
    pub(super) cells: u64,
}

/// A box of configurations that waits.
#[derive(Debug, Clone)]
struct Cell {
    bound: f64,
    number: u64,
    intervals: Vec<Interval>,
    divide: usize,
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
struct Search<'a> {
    gap: &'a Gap,
    ranges: &'a [Interval],
    attained: Attained,
    room: Room,
    nearest: Vec<f64>,
    cells: u64,
    /// In corners.
    spent: u64,
}

impl Search<'_> {
    /// Bounds a box, and climbs from its most promising configuration where that is news.
    fn bound(&mut self, intervals: Vec<Interval>, parent: f64) -> Cell {
        self.nearest.copy_from_slice(&self.attained.at);
        let enclosure = self.gap.enclose(&intervals, &mut self.room, &mut self.nearest);
        let mut found = Attained::new(self.gap, self.nearest.clone());
        if found.gap > self.attained.gap {
            found.climb(self.gap, self.ranges);
            self.attained = found;
        }
        self.cells += 1;
        self.spent += enclosure.corners + CORNERS_PER_CELL;
        let bound = enclosure.bound.min(parent);
        Cell { bound, number: self.cells, intervals, divide: enclosure.divide }
    }

    fn halves(&mut self, cell: &Cell) -> [Cell; 2] {
        let (lower, upper) = cell.intervals[cell.divide];
        let middle = f64::midpoint(lower, upper);
        [(lower, middle), (middle, upper)].map(|half| {
            let mut intervals = cell.intervals.clone();
            intervals[cell.divide] = half;
            self.bound(intervals, cell.bound)
        })
    }
}

/// Brackets the largest gap over the ranges; gaps beyond `ceiling` need not be told apart.
pub(super) fn bracket(
    gap: &Gap,
    ranges: &[Interval],
    attained: Attained,
    (ceiling, budget): (f64, Budget),
) -> Outcome {
    let nearest = attained.at.clone();
    let most = gap.most_corners();
    if most > MOST_CORNERS_OF_CELL || most.saturating_add(CORNERS_PER_CELL) > budget.corners {
        return Outcome { attained, certified: f64::INFINITY, cells: 0 };
    }
    let mut search = Search { gap, ranges, attained, room: Room::default(), nearest, cells: 0, spent: 0 };
    let mut open = BinaryHeap::from([search.bound(ranges.to_vec(), f64::INFINITY)]);
    let certified = loop {
        let Some(cell) = open.pop() else { unreachable!("a box that is taken leaves two behind") };
        if search.attained.gap >= ceiling {
            search.attained.descend_to(ceiling, gap, ranges);
            break ceiling;
        }
        let enough = (search.attained.gap * (1.0 + budget.relative_gap)).max(ROUNDING_LEVEL);
        let (lower, upper) = cell.intervals.get(cell.divide).copied().unwrap_or_default();
        let middle = f64::midpoint(lower, upper);
        let divisible = lower < middle && middle < upper;
        let spent = search.spent >= budget.corners;
        if cell.bound <= enough || spent || !divisible {
            break cell.bound;
        }
        open.extend(search.halves(&cell));
    };
    let Search { attained, cells, .. } = search;
    Outcome { certified: certified.max(attained.gap), attained, cells }
}
