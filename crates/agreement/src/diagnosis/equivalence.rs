//! Why two explanations cannot be distinguished. The reason is derived from the changes that both make to the
//! models; if no known reason applies, the answer is only that both have the same effect.

use congruent_description::{ChainQ, DhConvention};
use congruent_kinematics::{Pose, PoseError, Twist};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::Serialize;

use super::{
    candidate::{CandidateModel, CandidateRow, DhEntry, RowConstants},
    explanation::{Criterion, Explanation},
    hypothesis::ModelPair,
    thresholds::{PARALLEL, SAME_PART_OF_RESIDUAL, SAME_VALUE},
};

/// The reason why two explanations cannot be distinguished.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Equivalence {
    /// A transform before the first joint can be in the base or in the first row.
    BaseAndFirstRow,
    /// A transform behind the last joint can be in the tool or in the last row.
    ToolAndLastRow,
    /// Along parallel axes only the sum of the offsets matters.
    ParallelOffsets,
    /// A flipped axis with a flipped sign is the same joint.
    FlipAndSign,
    /// The same values, under another cause.
    SameValues,
    /// Other values without a known reason: the corrected models are equal.
    SameEffect,
    /// Two different models, both within the tolerance.
    WithinTolerance,
}

impl Equivalence {
    /// The sentence for people.
    pub fn sentence(self) -> &'static str {
        match self {
            Self::BaseAndFirstRow => {
                "a transform before the first joint can be in the base or in the joint's row"
            }
            Self::ToolAndLastRow => {
                "a transform behind the last joint can be in the joint's row or in the tool"
            }
            Self::ParallelOffsets => "only the sum of the offsets along parallel axes matters",
            Self::FlipAndSign => {
                "a joint that turns in the opposite direction about a flipped axis is the same joint"
            }
            Self::SameValues => "the corrected values are the same",
            Self::SameEffect => "both make the models agree at every configuration",
            Self::WithinTolerance => "another model that is also within the tolerance",
        }
    }
}

/// The reason why `other` cannot be distinguished from `named`.
pub(super) fn equivalence(
    models: &ModelPair,
    criterion: &Criterion,
    named: &Explanation,
    other: &Explanation,
) -> Equivalence {
    // First, since all reasons below claim that no pose can distinguish the two.
    if !is_same_model(criterion, named, other) {
        return Equivalence::WithinTolerance;
    }
    let both = [named, other].map(|explanation| changes(models, &explanation.corrected));
    // In both directions: it is the same reason whichever of the two is named.
    let either = |one: ModelChange, other: &dyn Fn(&ModelChange) -> bool| {
        (both[0] == [one] && both[1].iter().all(other)) || (both[1] == [one] && both[0].iter().all(other))
    };
    let along_axis = |entry: DhEntry| matches!(entry, DhEntry::Theta | DhEntry::D);
    let modified = models.candidate.convention == Some(DhConvention::Modified);
    let last = models.candidate.rows.len().saturating_sub(1);
    // A modified row begins with `alpha` and `a`, before the joint's axis, so all four entries of its first row are
    // constant transforms in front of the first joint's motion or along its axis. A standard row begins with the
    // axis: only `theta` and `d` commute with the motion. At the last row it is the other order.
    let before_first = |change: &ModelChange| matches!(change, ModelChange::DhEntry(0, entry) if modified || along_axis(*entry));
    let behind_last = |change: &ModelChange| matches!(change, ModelChange::DhEntry(row, entry) if *row == last && (!modified || along_axis(*entry)));
    let flips =
        both.each_ref().map(|changes| changes.iter().any(|change| matches!(change, ModelChange::Flip(_))));
    if changes(&named.corrected, &other.corrected).is_empty() {
        Equivalence::SameValues
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

/// Whether both give the same map from joint positions to poses, or both agree with the reference model up to
/// rounding.
fn is_same_model(criterion: &Criterion, named: &Explanation, other: &Explanation) -> bool {
    let residuals =
        [&named.residual, &other.residual].map(|residual| [residual.position_m, residual.orientation_rad]);
    // Two models that both equal the reference up to rounding are equal to each other: no poses are needed.
    if residuals.as_flattened().iter().all(|residual| *residual <= SAME_VALUE) {
        return true;
    }
    let (one, two) = (&named.corrected, &other.corrected);
    let distance_at =
        |q: &ChainQ| PoseError::between(&one.candidate.base_from_tip(q), &two.candidate.base_from_tip(q));
    let distance =
        criterion.configurations.iter().map(distance_at).fold(PoseError::default(), PoseError::larger);
    let same = |residual: f64| SAME_VALUE.max(SAME_PART_OF_RESIDUAL * residual);
    // Otherwise their distance must be small compared with what both fail to explain, which is the file's rounding.
    one.reference == two.reference
        && distance.position_m <= same(named.residual.position_m)
        && distance.orientation_rad <= same(named.residual.orientation_rad)
}

/// One difference between two states of a pair of models.
#[derive(Debug, Clone, Copy, PartialEq)]
enum ModelChange {
    Base,
    Tool,
    /// An entry of a row.
    DhEntry(usize, DhEntry),
    /// The direction of a row.
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
            let value = |candidate: &CandidateModel| candidate.entry(row, entry).unwrap_or_default();
            let is_off = (value(before) - value(after)).abs() > SAME_VALUE;
            list.extend(is_off.then_some(ModelChange::DhEntry(row, entry)));
        }
    }
    let has_more = before.convention != after.convention || from.reference != to.reference;
    list.extend(has_more.then_some(ModelChange::Other));
    list
}

/// Whether two rows differ in more than entries and direction.
fn is_another(one: &CandidateRow, two: &CandidateRow) -> bool {
    let is_another_link = match (one.link, two.link) {
        (RowConstants::Dh { kind: one, .. }, RowConstants::Dh { kind: two, .. }) => one != two,
        (RowConstants::Screw { twist: one, .. }, RowConstants::Screw { twist: two, .. }) => one != two,
        _ => true,
    };
    is_another_link || one.joint != two.joint || (one.rate.abs() - two.rate.abs()).abs() > SAME_VALUE
}

fn differ(one: &Pose, two: &Pose) -> bool {
    one.distance_m(two) > SAME_VALUE || one.angle_rad(two) > SAME_VALUE
}

/// Whether all changes are offsets `d`, and all joints between their rows turn about axes that are parallel
/// to the offsets.
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
            None // a prismatic joint does not turn
        }
    };
    // A joint between the two rows that turns about another axis turns the second offset away from the first.
    let directions: Vec<Vector3<f64>> = (first..=last).filter_map(direction).collect();
    directions.iter().all(|each| each.cross(&directions[0]).norm() < PARALLEL)
}
