//! The third rung: why two explanations cannot be told apart. Nothing is guessed: what both change is
//! read from the models that they correct, and where no freedom is known that makes the two one, only
//! what they do is said.

use nalgebra::Vector3;

use congruent_description::DhConvention;

use super::{
    diagnosis::{Explanation, Question, Residual},
    hypothesis::Case,
    suspect::{Entry, Suspect, SuspectLink, SuspectRow},
};
use crate::{pose::Pose, twist::Twist};

/// Axes whose angle has a smaller sine are parallel.
const PARALLEL: f64 = 1e-6;
/// Figures and models that differ by less, in m or rad, are the same: rounding of fits.
const SAME: f64 = 1e-9;
/// Fits to a file that is rounded itself end within this share of what they leave.
const SAME_SHARE: f64 = 1e-3;

/// A freedom by which two explanations are one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Gauge {
    /// Figures before the first joint stand in the base or in the first row.
    BaseAndFirstRow,
    /// Figures behind the last joint stand in the tool or in the last row.
    ToolAndLastRow,
    /// Along parallel axes only the sum of the offsets matters.
    ParallelOffsets,
    /// A flipped axis with a flipped sign is the same joint.
    FlipAndSign,
    /// The same figures, blamed under another name.
    SameFigures,
    /// Other figures and no known reason: the corrected models are equal.
    SameEffect,
    /// Two models that are not equal, both within the tolerance.
    WithinTolerance,
}

impl Gauge {
    /// The sentence for people.
    pub fn sentence(self) -> &'static str {
        match self {
            Self::BaseAndFirstRow => "what stands before the first joint can stand in the base or in its row",
            Self::ToolAndLastRow => "what stands behind the last joint can stand in its row or in the tool",
            Self::ParallelOffsets => "along parallel axes only the sum of the offsets matters",
            Self::FlipAndSign => "a joint that turns the other way about a flipped axis is the same joint",
            Self::SameFigures => "the corrected figures are the same",
            Self::SameEffect => "both make the models agree everywhere",
            Self::WithinTolerance => "another model, also within the tolerance",
        }
    }
}

/// The freedom by which `other` says the same as `named`.
pub(super) fn gauge(case: &Case, question: &Question, named: &Explanation, other: &Explanation) -> Gauge {
    if !is_same_model(question, named, other) {
        return Gauge::WithinTolerance;
    }
    let changes = [named, other].map(|explanation| Changes::of(case, &explanation.mended));
    let either = |one: fn(&Changes) -> bool, two: &dyn Fn(&Changes) -> bool| {
        (one(&changes[0]) && two(&changes[1])) || (one(&changes[1]) && two(&changes[0]))
    };
    let modified = case.suspect.convention == Some(DhConvention::Modified);
    let last = case.suspect.rows.len().saturating_sub(1);
    let along_axis = |entry: Entry| matches!(entry, Entry::Theta | Entry::D);
    if Changes::of(&named.mended, &other.mended).is_none() {
        Gauge::SameFigures
    } else if either(Changes::is_base, &|of| of.is_row(0, |entry| modified || along_axis(entry))) {
        Gauge::BaseAndFirstRow
    } else if either(Changes::is_tool, &|of| of.is_row(last, |entry| !modified || along_axis(entry))) {
        Gauge::ToolAndLastRow
    } else if changes.iter().all(Changes::are_offsets) && are_parallel(case, &changes) {
        Gauge::ParallelOffsets
    } else if changes[0].flipped != changes[1].flipped {
        Gauge::FlipAndSign
    } else {
        Gauge::SameEffect
    }
}

/// Whether both correct to one map from joint positions to poses, or agree with what they are held
/// against to rounding.
fn is_same_model(question: &Question, named: &Explanation, other: &Explanation) -> bool {
    let left = [&named.residual, &other.residual].map(|left| [left.position_m, left.orientation_rad]);
    if left.as_flattened().iter().all(|left| *left <= SAME) {
        return true;
    }
    let (one, two) = (&named.mended, &other.mended);
    let mut apart = Residual::default();
    for q in &question.configurations {
        let (found, expected) = (one.suspect.base_from_tip(q), two.suspect.base_from_tip(q));
        apart.position_m = apart.position_m.max(found.distance_m(&expected));
        apart.orientation_rad = apart.orientation_rad.max(found.angle_rad(&expected));
    }
    let same = |left: f64| SAME.max(SAME_SHARE * left);
    one.reference == two.reference
        && apart.position_m <= same(named.residual.position_m)
        && apart.orientation_rad <= same(named.residual.orientation_rad)
}

/// What differs between two states of a case.
#[derive(Debug, Default)]
struct Changes {
    base: bool,
    tool: bool,
    /// Figures of rows.
    entries: Vec<(usize, Entry)>,
    /// Rows that move the other way.
    flipped: Vec<usize>,
    /// Anything else: rates, names, kinds, the convention, the reference.
    more: bool,
}

impl Changes {
    fn of(from: &Case, to: &Case) -> Self {
        let (before, after) = (&from.suspect, &to.suspect);
        let mut changes = Self {
            base: differ(&before.base.pose, &after.base.pose),
            tool: differ(&before.tool.pose, &after.tool.pose),
            more: before.convention != after.convention || from.reference != to.reference,
            ..Self::default()
        };
        for (row, (one, two)) in before.rows.iter().zip(&after.rows).enumerate() {
            changes.row(row, (before, one), (after, two));
        }
        changes
    }

    fn row(&mut self, row: usize, before: (&Suspect, &SuspectRow), after: (&Suspect, &SuspectRow)) {
        let kind = |row: &SuspectRow| match row.link {
            SuspectLink::Dh { kind, .. } => Some(kind),
            SuspectLink::Screw { .. } => None,
        };
        let twist = |row: &SuspectRow| match row.link {
            SuspectLink::Dh { .. } => None,
            SuspectLink::Screw { twist, .. } => Some(twist),
        };
        let (one, two) = (before.1, after.1);
        if one.rate * two.rate < 0.0 {
            self.flipped.push(row);
        }
        self.more |= (one.rate.abs() - two.rate.abs()).abs() > SAME
            || one.joint != two.joint
            || kind(one) != kind(two)
            || twist(one) != twist(two);
        for entry in [Entry::A, Entry::Alpha, Entry::D, Entry::Theta] {
            let value = |suspect: &Suspect| suspect.entry(row, entry).unwrap_or_default();
            if (value(before.0) - value(after.0)).abs() > SAME {
                self.entries.push((row, entry));
            }
        }
    }

    fn is_none(&self) -> bool {
        let Self { base, tool, entries, flipped, more } = self;
        !(*base || *tool || *more) && entries.is_empty() && flipped.is_empty()
    }

    fn is_base(&self) -> bool {
        let Self { base, tool, entries, flipped, more } = self;
        *base && !(*tool || *more) && entries.is_empty() && flipped.is_empty()
    }

    fn is_tool(&self) -> bool {
        let Self { base, tool, entries, flipped, more } = self;
        *tool && !(*base || *more) && entries.is_empty() && flipped.is_empty()
    }

    /// Whether figures of rows alone have changed.
    fn are_figures(&self) -> bool {
        let Self { base, tool, entries, flipped, more } = self;
        !(*base || *tool || *more) && flipped.is_empty() && !entries.is_empty()
    }

    /// Whether such figures of one row alone have changed.
    fn is_row(&self, row: usize, is_such: impl Fn(Entry) -> bool) -> bool {
        self.are_figures() && self.entries.iter().all(|&(at, entry)| at == row && is_such(entry))
    }

    fn are_offsets(&self) -> bool {
        self.are_figures() && self.entries.iter().all(|&(_, entry)| entry == Entry::D)
    }
}

fn differ(one: &Pose, two: &Pose) -> bool {
    one.distance_m(two) > SAME || one.angle_rad(two) > SAME
}

/// Whether nothing between the rows that two changes touch turns but about the direction of their
/// joints.
fn are_parallel(case: &Case, changes: &[Changes; 2]) -> bool {
    let rows = || changes.iter().flat_map(|changes| &changes.entries).map(|&(row, _)| row);
    let (Some(first), Some(last)) = (rows().min(), rows().max()) else { return false };
    let screws = case.reference.screws();
    let direction = |row: usize| -> Option<Vector3<f64>> {
        let Twist { angular, linear } = screws.twists_in_base.get(case.suspect.rows[row].joint)?;
        if angular.norm() > PARALLEL {
            Some(angular.normalize())
        } else if rows().any(|at| at == row) {
            linear.try_normalize(PARALLEL)
        } else {
            None // what only shifts turns nothing
        }
    };
    let directions: Vec<Vector3<f64>> = (first..=last).filter_map(direction).collect();
    directions.iter().all(|each| each.cross(&directions[0]).norm() < PARALLEL)
}
