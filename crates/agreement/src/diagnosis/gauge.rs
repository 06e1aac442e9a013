//! The third rung: why two explanations cannot be told apart. Nothing is guessed: what both change is
//! read from the models that they correct, and where no freedom is known that makes the two one, only
//! what they do is said.

use congruent_description::DhConvention;
use congruent_kinematics::{Pose, Twist};
use nalgebra::Vector3;

use super::{
    diagnosis::{Explanation, Question, Residual},
    hypothesis::Case,
    suspect::{Entry, Suspect, SuspectLink, SuspectRow},
};

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
    let both = [named, other].map(|explanation| changes(case, &explanation.mended));
    let either = |one: Change, other: &dyn Fn(&Change) -> bool| {
        (both[0] == [one] && both[1].iter().all(other)) || (both[1] == [one] && both[0].iter().all(other))
    };
    let along_axis = |entry: Entry| matches!(entry, Entry::Theta | Entry::D);
    let modified = case.suspect.convention == Some(DhConvention::Modified);
    let last = case.suspect.rows.len().saturating_sub(1);
    let before_first =
        |change: &Change| matches!(change, Change::Entry(0, entry) if modified || along_axis(*entry));
    let behind_last = |change: &Change| matches!(change, Change::Entry(row, entry) if *row == last && (!modified || along_axis(*entry)));
    let flips = both.each_ref().map(|changes| changes.iter().any(|change| matches!(change, Change::Flip(_))));
    if changes(&named.mended, &other.mended).is_empty() {
        Gauge::SameFigures
    } else if either(Change::Base, &before_first) {
        Gauge::BaseAndFirstRow
    } else if either(Change::Tool, &behind_last) {
        Gauge::ToolAndLastRow
    } else if are_offsets_along_parallels(case, &both.concat()) {
        Gauge::ParallelOffsets
    } else if flips[0] != flips[1] {
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
    let apart_at =
        |q: &Vec<f64>| Residual::between(&one.suspect.base_from_tip(q), &two.suspect.base_from_tip(q));
    let apart = question.configurations.iter().map(apart_at).fold(Residual::default(), Residual::larger);
    let same = |left: f64| SAME.max(SAME_SHARE * left);
    one.reference == two.reference
        && apart.position_m <= same(named.residual.position_m)
        && apart.orientation_rad <= same(named.residual.orientation_rad)
}

/// One thing in which two states of a case differ.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Change {
    Base,
    Tool,
    /// A figure of a row.
    Entry(usize, Entry),
    /// A row moves the other way.
    Flip(usize),
    /// Anything else: rates, names, kinds, the convention, the reference.
    Other,
}

fn changes(from: &Case, to: &Case) -> Vec<Change> {
    let (before, after) = (&from.suspect, &to.suspect);
    let mut list = Vec::new();
    list.extend(differ(&before.base.pose, &after.base.pose).then_some(Change::Base));
    list.extend(differ(&before.tool.pose, &after.tool.pose).then_some(Change::Tool));
    for (row, (one, two)) in before.rows.iter().zip(&after.rows).enumerate() {
        list.extend((one.rate * two.rate < 0.0).then_some(Change::Flip(row)));
        list.extend(is_another(one, two).then_some(Change::Other));
        for entry in [Entry::A, Entry::Alpha, Entry::D, Entry::Theta] {
            let value = |suspect: &Suspect| suspect.entry(row, entry).unwrap_or_default();
            let is_off = (value(before) - value(after)).abs() > SAME;
            list.extend(is_off.then_some(Change::Entry(row, entry)));
        }
    }
    let has_more = before.convention != after.convention || from.reference != to.reference;
    list.extend(has_more.then_some(Change::Other));
    list
}

/// Whether two rows differ in more than figures and direction.
fn is_another(one: &SuspectRow, two: &SuspectRow) -> bool {
    let is_another_link = match (one.link, two.link) {
        (SuspectLink::Dh { kind: one, .. }, SuspectLink::Dh { kind: two, .. }) => one != two,
        (SuspectLink::Screw { twist: one, .. }, SuspectLink::Screw { twist: two, .. }) => one != two,
        _ => true,
    };
    is_another_link || one.joint != two.joint || (one.rate.abs() - two.rate.abs()).abs() > SAME
}

fn differ(one: &Pose, two: &Pose) -> bool {
    one.distance_m(two) > SAME || one.angle_rad(two) > SAME
}

/// Whether all changes are offsets, and nothing between their rows turns but about the direction of
/// their joints.
fn are_offsets_along_parallels(case: &Case, changes: &[Change]) -> bool {
    let offset = |change: &Change| match change {
        Change::Entry(row, Entry::D) => Some(*row),
        _ => None,
    };
    let Some(rows) = changes.iter().map(offset).collect::<Option<Vec<usize>>>() else { return false };
    let (Some(&first), Some(&last)) = (rows.iter().min(), rows.iter().max()) else { return false };
    let screws = case.reference.screws();
    let direction = |row: usize| -> Option<Vector3<f64>> {
        let Twist { angular, linear } = screws.twists_in_base.get(case.suspect.rows[row].joint)?;
        if angular.norm() > PARALLEL {
            Some(angular.normalize())
        } else if rows.contains(&row) {
            linear.try_normalize(PARALLEL)
        } else {
            None // what only shifts turns nothing
        }
    };
    let directions: Vec<Vector3<f64>> = (first..=last).filter_map(direction).collect();
    directions.iter().all(|each| each.cross(&directions[0]).norm() < PARALLEL)
}
