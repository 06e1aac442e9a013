//! The third rung: why two explanations cannot be told apart. Nothing is guessed: what both change is
//! read from the models that they correct, and where no freedom is known that makes the two one, only
//! what they do is said.

use congruent_description::{ChainQ, DhConvention};
use congruent_kinematics::{Pose, PoseError, Twist};
use nalgebra::Vector3;

use super::{
    candidate::{Candidate, CandidateRow, DhEntry, RowConstants},
    explanation::{Criterion, Explanation},
    hypothesis::ModelPair,
};

/// Axes whose angle has a smaller sine are parallel.
const PARALLEL: f64 = 1e-6;
/// Figures and models that differ by less, in m or rad, are the same: rounding of fits.
const SAME: f64 = 1e-9;
/// Fits to a file that is rounded itself end within this share of what they leave.
const SAME_SHARE: f64 = 1e-3;

/// A freedom by which two explanations are one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Equivalence {
    /// Figures before the first joint stand in the base or in the first row.
    BaseAndFirstRow,
    /// Figures behind the last joint stand in the tool or in the last row.
    ToolAndLastRow,
    /// Along parallel axes only the sum of the offsets matters.
    ParallelOffsets,
    /// A flipped axis with a flipped sign is the same joint.
    FlipAndSign,
    /// The same figures, named under another name.
    SameFigures,
    /// Other figures and no known reason: the corrected models are equal.
    SameEffect,
    /// Two models that are not equal, both within the tolerance.
    WithinTolerance,
}

impl Equivalence {
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
pub(super) fn equivalence(
    models: &ModelPair,
    criterion: &Criterion,
    named: &Explanation,
    other: &Explanation,
) -> Equivalence {
    if !is_same_model(criterion, named, other) {
        return Equivalence::WithinTolerance;
    }
    let both = [named, other].map(|explanation| changes(models, &explanation.corrected));
    let either = |one: ModelChange, other: &dyn Fn(&ModelChange) -> bool| {
        (both[0] == [one] && both[1].iter().all(other)) || (both[1] == [one] && both[0].iter().all(other))
    };
    let along_axis = |entry: DhEntry| matches!(entry, DhEntry::Theta | DhEntry::D);
    let modified = models.candidate.convention == Some(DhConvention::Modified);
    let last = models.candidate.rows.len().saturating_sub(1);
    let before_first = |change: &ModelChange| matches!(change, ModelChange::DhEntry(0, entry) if modified || along_axis(*entry));
    let behind_last = |change: &ModelChange| matches!(change, ModelChange::DhEntry(row, entry) if *row == last && (!modified || along_axis(*entry)));
    let flips =
        both.each_ref().map(|changes| changes.iter().any(|change| matches!(change, ModelChange::Flip(_))));
    if changes(&named.corrected, &other.corrected).is_empty() {
        Equivalence::SameFigures
    } else if either(ModelChange::Base, &before_first) {
        Equivalence::BaseAndFirstRow
    } else if either(ModelChange::Tool, &behind_last) {
        Equivalence::ToolAndLastRow
    } else if are_offsets_along_parallels(models, &both.concat()) {
        Equivalence::ParallelOffsets
    } else if flips[0] != flips[1] {
        Equivalence::FlipAndSign
    } else {
        Equivalence::SameEffect
    }
}

/// Whether both correct to one map from joint positions to poses, or agree with what they are held
/// against to rounding.
fn is_same_model(criterion: &Criterion, named: &Explanation, other: &Explanation) -> bool {
    let left = [&named.residual, &other.residual].map(|left| [left.position_m, left.orientation_rad]);
    if left.as_flattened().iter().all(|left| *left <= SAME) {
        return true;
    }
    let (one, two) = (&named.corrected, &other.corrected);
    let apart_at =
        |q: &ChainQ| PoseError::between(&one.candidate.base_from_tip(q), &two.candidate.base_from_tip(q));
    let apart = criterion.configurations.iter().map(apart_at).fold(PoseError::default(), PoseError::larger);
    let same = |left: f64| SAME.max(SAME_SHARE * left);
    one.reference == two.reference
        && apart.position_m <= same(named.residual.position_m)
        && apart.orientation_rad <= same(named.residual.orientation_rad)
}

/// One thing in which two states of a models differ.
#[derive(Debug, Clone, Copy, PartialEq)]
enum ModelChange {
    Base,
    Tool,
    /// A figure of a row.
    DhEntry(usize, DhEntry),
    /// A row moves the other way.
    Flip(usize),
    /// Anything else: rates, names, kinds, the convention, the reference.
    Other,
}

fn changes(from: &ModelPair, to: &ModelPair) -> Vec<ModelChange> {
    let (before, after) = (&from.candidate, &to.candidate);
    let mut list = Vec::new();
    list.extend(differ(&before.base.pose, &after.base.pose).then_some(ModelChange::Base));
    list.extend(differ(&before.tool.pose, &after.tool.pose).then_some(ModelChange::Tool));
    for (row, (one, two)) in before.rows.iter().zip(&after.rows).enumerate() {
        list.extend((one.rate * two.rate < 0.0).then_some(ModelChange::Flip(row)));
        list.extend(is_another(one, two).then_some(ModelChange::Other));
        for entry in [DhEntry::A, DhEntry::Alpha, DhEntry::D, DhEntry::Theta] {
            let value = |candidate: &Candidate| candidate.entry(row, entry).unwrap_or_default();
            let is_off = (value(before) - value(after)).abs() > SAME;
            list.extend(is_off.then_some(ModelChange::DhEntry(row, entry)));
        }
    }
    let has_more = before.convention != after.convention || from.reference != to.reference;
    list.extend(has_more.then_some(ModelChange::Other));
    list
}

/// Whether two rows differ in more than figures and direction.
fn is_another(one: &CandidateRow, two: &CandidateRow) -> bool {
    let is_another_link = match (one.link, two.link) {
        (RowConstants::Dh { kind: one, .. }, RowConstants::Dh { kind: two, .. }) => one != two,
        (RowConstants::Screw { twist: one, .. }, RowConstants::Screw { twist: two, .. }) => one != two,
        _ => true,
    };
    is_another_link || one.joint != two.joint || (one.rate.abs() - two.rate.abs()).abs() > SAME
}

fn differ(one: &Pose, two: &Pose) -> bool {
    one.distance_m(two) > SAME || one.angle_rad(two) > SAME
}

/// Whether all changes are offsets, and nothing between their rows turns but about the direction of
/// their joints.
fn are_offsets_along_parallels(models: &ModelPair, changes: &[ModelChange]) -> bool {
    let offset = |change: &ModelChange| match change {
        ModelChange::DhEntry(row, DhEntry::D) => Some(*row),
        _ => None,
    };
    let Some(rows) = changes.iter().map(offset).collect::<Option<Vec<usize>>>() else { return false };
    let (Some(&first), Some(&last)) = (rows.iter().min(), rows.iter().max()) else { return false };
    let screws = models.reference.screws();
    let direction = |row: usize| -> Option<Vector3<f64>> {
        let Twist { angular, linear } = screws.twists_in_base.get(models.candidate.rows[row].joint)?;
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
