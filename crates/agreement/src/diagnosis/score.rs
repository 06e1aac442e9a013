//! The order of the explanations that reach the tolerance.
//!
//! An explanation has a cost, one for each free parameter and one for each fault beyond the first, and a
//! residual. The two cannot be added, since the precision of a file is unknown; but the smallest residual of
//! all explanations shows it. An explanation with a residual that is an order of magnitude larger is refuted
//! at any cost. Of the others, whose residuals are the rounding of the file, the one with the lowest cost is
//! named.

use congruent_description::Tolerance;
use congruent_kinematics::{PoseError, rotation_exp};
use nalgebra::{Matrix3, Vector3};

use super::{
    candidate::{CandidateModel, DeclaredTransform, DhEntry, ModelParameter},
    explanation::Criterion,
    fit::hypothesis_fit::{FitContext, HypothesisFit},
    fitted_length::FittedLength,
    hypothesis::{Cause, FaultPlace, ModelPair, PoseHypothesis},
    thresholds::{
        BELOW_TOLERANCE, CERTAIN, EVIDENT, FAR_BELOW_TOLERANCE, QUARTER_TURNS, REFUTED, ROUNDING_RESIDUAL,
        SAME_VALUE,
    },
};

/// The order in which explanations are named; smaller is first.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct ExplanationRank {
    /// Free parameters, choices that count as such, and one for each fault beyond the first.
    cost: usize,
    /// Class of the residual: 0 far below the tolerance, 1 below it, 2 near it.
    residual_class: u8,
    /// Parameters that are named although the file gives 0, or that the correction of a unit makes almost 0.
    unlikely: usize,
    /// Faults of the reference model's file.
    in_reference: usize,
    /// Fitted values that neither file has: of values along parallel axes, each of which makes up for the wrong one, that
    /// which is written elsewhere is the likelier one.
    unfamiliar: usize,
    /// Fitted values that are no typing error of the one given: not one digit, two digits or the sign.
    mistyped: usize,
    /// Values that are exchanged between two rows: one wrong sign is likelier than two wrong values of the same effect.
    exchanged: usize,
    /// The causes, in the catalogue's order.
    causes: Vec<Cause>,
    /// The hypotheses, so that the order is the same on every machine.
    hypotheses: Vec<usize>,
}

pub(super) fn rank(context: &FitContext<'_>, fit: &HypothesisFit, criterion: &Criterion) -> ExplanationRank {
    let hypotheses = || fit.hypotheses.iter().map(|&at| &context.hypotheses[at]);
    let residual = context.corrected(fit).residual(criterion);
    let in_tolerances = criterion.in_tolerances(&residual);
    let mut causes: Vec<Cause> = hypotheses().map(|hypothesis| hypothesis.cause).collect();
    // Sorted, so that a pair has one rank whichever fault was tried first.
    causes.sort_unstable();
    let unproven: usize = hypotheses()
        .filter_map(|hypothesis| UnitEvidence::for_hypothesis(context, fit, hypothesis))
        .map(|wrong_unit| wrong_unit.unproven(&residual))
        .sum();
    let given_as_zero = hypotheses()
        .filter(|hypothesis| {
            is_given_as_zero(&context.models.candidate, hypothesis)
                && !is_missing_base_turn(context, fit, hypothesis)
        })
        .count();
    let in_place_of_base =
        hypotheses().filter(|hypothesis| is_zero_in_place_of_base(context, fit, hypothesis)).count();
    let lengths = || {
        hypotheses().filter_map(|hypothesis| FittedLength::of_hypothesis(context, fit, criterion, hypothesis))
    };
    let choices: usize = hypotheses().map(|hypothesis| choices(context, fit, criterion, hypothesis)).sum();
    // Beside other faults, a value that nothing speaks for may only make up for what they leave.
    let unexplained = if fit.hypotheses.len() > 1 {
        lengths().filter(|length| !length.is_explained(context.models)).count()
    } else {
        0
    };
    ExplanationRank {
        // One for each further fault: two faults without parameters must not win against one fault with one
        // parameter.
        cost: choices + unproven + unexplained + fit.hypotheses.len() - 1,
        // Classes, not the residual itself: within a class it differs by rounding, which must not decide.
        residual_class: if in_tolerances <= FAR_BELOW_TOLERANCE {
            0
        } else {
            u8::from(in_tolerances > BELOW_TOLERANCE) + 1
        },
        unlikely: given_as_zero + in_place_of_base + unproven,
        // The reference counts as correct, so a fault in its file is named only if nothing simpler fits.
        in_reference: hypotheses().filter(|hypothesis| is_in_reference(hypothesis)).count(),
        unfamiliar: lengths().filter(|length| !length.is_written_elsewhere(context.models)).count(),
        mistyped: lengths().filter(|length| !length.is_typing_error()).count(),
        exchanged: hypotheses()
            .filter(|hypothesis| matches!(&hypothesis.place, FaultPlace::Entries(_, rows) if rows.len() == 2))
            .count(),
        causes,
        hypotheses: fit.hypotheses.clone(),
    }
}

/// Whether the residual of an explanation is so much larger than the best one that the explanation is wrong.
pub(super) fn is_refuted(
    context: &FitContext<'_>,
    fit: &HypothesisFit,
    criterion: &Criterion,
    best: &PoseError,
) -> bool {
    let own = context.corrected(fit).residual(criterion);
    // Of two residuals that the digits allow, neither is the better evidence.
    let PoseError { position_m, orientation_rad } = criterion.digits.allowed;
    let rounded_up = |residual: &PoseError| {
        criterion.in_tolerances(&PoseError {
            position_m: residual.position_m.max(ROUNDING_RESIDUAL).max(position_m),
            orientation_rad: residual.orientation_rad.max(ROUNDING_RESIDUAL).max(orientation_rad),
        })
    };
    // Below the rounding of a file, residuals of 1e-15 and 1e-13 are equally good: the ratio would refute by
    // chance.
    rounded_up(&own) > REFUTED * rounded_up(best) && !is_certain_unit(context, fit, &own)
}

/// Whether an explanation is of wrong units alone, with values that are so far above its residual that this is no coincidence.
pub(super) fn is_certain_unit(context: &FitContext<'_>, fit: &HypothesisFit, residual: &PoseError) -> bool {
    fit.hypotheses.iter().all(|&at| {
        UnitEvidence::for_hypothesis(context, fit, &context.hypotheses[at])
            .is_some_and(|wrong_unit| wrong_unit.is_above(CERTAIN, residual))
    })
}

impl Criterion {
    /// A residual as a multiple of the one that says nothing.
    pub(super) fn in_tolerances(&self, residual: &PoseError) -> f64 {
        let Tolerance { position_m, orientation_rad } = self.insignificant();
        (residual.position_m / position_m).max(residual.orientation_rad / orientation_rad)
    }
}

/// The number of free choices of a hypothesis: its free parameters, and one for an edit that needs them. Another order of
/// angles in the reference model's file counts as one; as three for quarter turns, since every order of them gives quarter
/// turns.
fn choices(
    context: &FitContext<'_>,
    fit: &HypothesisFit,
    criterion: &Criterion,
    hypothesis: &PoseHypothesis,
) -> usize {
    // A shifted column with a value that is fitted explains any single value: along parallel axes one offset makes up for
    // whatever the others sum up to.
    let fitted = hypothesis.free.len() + usize::from(hypothesis.is_fitted_edit());
    if is_half_superfluous(context, fit, criterion, hypothesis) {
        return fitted + HALF_SUPERFLUOUS;
    }
    let FaultPlace::ReferenceJoints(joints) = &hypothesis.place else { return fitted };
    if !is_in_reference(hypothesis) {
        return fitted;
    }
    let by_quarters = |models: &ModelPair| {
        let mut rotations =
            joints.iter().map(|&joint| models.reference.joints[joint].parent_from_joint.rotation);
        rotations.all(|rotation| is_by_quarter_turns(&rotation))
    };
    // As many as the parameters of a rotation: an order of quarter turns that fits is no better evidence than a
    // fit.
    if by_quarters(context.models) && by_quarters(&context.corrected(fit)) { 3 } else { 1 }
}

/// Whether the fault is in the reference model's file itself, not in how the candidate was derived from it.
fn is_in_reference(hypothesis: &PoseHypothesis) -> bool {
    hypothesis.cause == Cause::RpyOrder && matches!(hypothesis.place, FaultPlace::ReferenceJoints(_))
}

/// The parameters that the correction of a wrong unit changes.
struct UnitEvidence {
    is_angle: bool,
    /// Number of parameters that are not zero; of a vector all three.
    count: usize,
    /// The largest value as given, and corrected.
    found: f64,
    expected: f64,
}

impl UnitEvidence {
    /// The evidence for a hypothesis about the unit of parameters; `None` for other hypotheses, also about joint
    /// positions.
    fn for_hypothesis(
        context: &FitContext<'_>,
        fit: &HypothesisFit,
        hypothesis: &PoseHypothesis,
    ) -> Option<Self> {
        let is_angle = match hypothesis.cause {
            Cause::DegreesAsRadians | Cause::RadiansAsDegrees => true,
            Cause::MillimetresAsMetres => false,
            _ => return None,
        };
        let values = |candidate: &CandidateModel| -> Vec<f64> {
            let column = |entries: &[DhEntry]| {
                let rows = 0..candidate.rows.len();
                let entries =
                    rows.flat_map(|row| entries.iter().filter_map(move |&entry| candidate.entry(row, entry)));
                entries.collect()
            };
            let constant = |constant: &DeclaredTransform| match constant.written_rpy_rad {
                // The angles as written: the pose has lost whole turns, which a wrong unit produces.
                Some(rpy) if is_angle => rpy.to_vec(),
                _ if is_angle => {
                    congruent_kinematics::rotation_log(&constant.pose.rotation).as_slice().to_vec()
                }
                _ => constant.pose.translation.as_slice().to_vec(),
            };
            match &hypothesis.place {
                FaultPlace::Entries(entry, rows) => candidate.entry(rows[0], *entry).into_iter().collect(),
                FaultPlace::Column(entries) => column(entries),
                FaultPlace::Base => constant(&candidate.base),
                FaultPlace::Tool => constant(&candidate.tool),
                FaultPlace::Model => {
                    [column(&[DhEntry::A, DhEntry::D]), constant(&candidate.base), constant(&candidate.tool)]
                        .concat()
                }
                FaultPlace::Rows(_)
                | FaultPlace::RowEntries(..)
                | FaultPlace::ShiftedColumn(..)
                | FaultPlace::ReferenceJoints(_) => Vec::new(),
            }
        };
        let largest = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let (found, expected) =
            (values(&context.models.candidate), values(&context.corrected(fit).candidate));
        let is_written = found.iter().any(|value| *value != 0.0);
        // A vector that becomes almost zero proves as little as a fit of its three components.
        let is_vector = matches!(hypothesis.place, FaultPlace::Base | FaultPlace::Tool);
        let count = found.iter().filter(|value| is_vector || **value != 0.0).count();
        is_written.then(|| Self { is_angle, count, found: largest(&found), expected: largest(&expected) })
    }

    fn is_above(&self, times: f64, residual: &PoseError) -> bool {
        self.expected >= times * if self.is_angle { residual.orientation_rad } else { residual.position_m }
    }

    /// Number of parameters that become so small that zero would be as good: this is no evidence of a wrong
    /// unit, only of wrong values.
    fn unproven(&self, residual: &PoseError) -> usize {
        if self.expected < self.found && !self.is_above(EVIDENT, residual) { self.count } else { 0 }
    }
}

/// Whether a hypothesis is about a single parameter that is 0 as given: a zero is rarely a typing error. Does not
/// apply to a joint's zero, for which 0 is the default.
fn is_given_as_zero(candidate: &CandidateModel, hypothesis: &PoseHypothesis) -> bool {
    if hypothesis.cause == Cause::ZeroOffset {
        return false;
    }
    match hypothesis.free[..] {
        [ModelParameter::Row(row, entry)] => candidate.entry(row, entry) == Some(0.0),
        [ModelParameter::Base(component)] => is_zero(&candidate.base.pose, component),
        [ModelParameter::Tool(component)] => is_zero(&candidate.tool.pose, component),
        _ => false,
    }
}

/// Whether an exchange of two values explains no more than one of the two changes: under a loose tolerance a wrong value can
/// be exchanged with any other one that matters little, and one of the two may be fitted beside it.
fn is_half_superfluous(
    context: &FitContext<'_>,
    fit: &HypothesisFit,
    criterion: &Criterion,
    hypothesis: &PoseHypothesis,
) -> bool {
    let (Cause::ParametersExchanged, FaultPlace::Entries(entry, rows)) =
        (hypothesis.cause, &hypothesis.place)
    else {
        return false;
    };
    let corrected = context.corrected(fit);
    let in_tolerances = |models: &ModelPair| criterion.in_tolerances(&models.residual(criterion));
    let whole = in_tolerances(&corrected);
    let is_fitted = |row: usize| {
        let mut free = fit.hypotheses.iter().flat_map(|&at| &context.hypotheses[at].free);
        free.any(|parameter| *parameter == ModelParameter::Row(row, *entry))
    };
    rows.iter().any(|&row| {
        if is_fitted(row) {
            return true;
        }
        let Some(given) = context.models.candidate.entry(row, *entry) else { return false };
        let mut half = corrected.clone().into_owned();
        half.candidate.set_entry(row, *entry, given);
        // A residual that is larger by rounding alone is no reason for the other change.
        in_tolerances(&half) <= whole * (1.0 + SAME_VALUE)
    })
}

/// What an exchange costs of which one half would do: more than a single value. Kind: choice.
const HALF_SUPERFLUOUS: usize = 2;

/// Whether the declared base is missing and should be a rotation by quarter turns: data sheets give tables without
/// it, so its zeros are no evidence against this fault.
fn is_missing_base_turn(context: &FitContext<'_>, fit: &HypothesisFit, hypothesis: &PoseHypothesis) -> bool {
    let corrected = context.corrected(fit);
    let base = &corrected.candidate.base.pose;
    hypothesis.cause == Cause::Base
        && has_no_base(context)
        && is_by_quarter_turns(&base.rotation)
        && base.translation == context.models.candidate.base.pose.translation
}

/// Whether the zero of the first joint is off in place of the base: by quarter turns in a table without a base, or by what a base
/// that is nearly made of quarter turns, as a yaw of 3.1, is off. If both are about one axis, no pose distinguishes the two.
fn is_zero_in_place_of_base(
    context: &FitContext<'_>,
    fit: &HypothesisFit,
    hypothesis: &PoseHypothesis,
) -> bool {
    if hypothesis.cause != Cause::ZeroOffset
        || hypothesis.free[..] != [ModelParameter::Row(0, DhEntry::Theta)]
    {
        return false;
    }
    let theta_rad = |candidate: &CandidateModel| candidate.entry(0, DhEntry::Theta);
    let turn_rad = theta_rad(&context.corrected(fit).candidate).zip(theta_rad(&context.models.candidate));
    turn_rad.is_some_and(|(expected, found)| {
        let turn = rotation_exp(&(Vector3::z() * (expected - found)));
        let base = &context.models.candidate.base.pose.rotation;
        // A calibrated zero is off by fractions of a degree; quarter turns are a matter of definition.
        if has_no_base(context) {
            is_by_quarter_turns(&turn)
        } else {
            !is_by_quarter_turns(base) && is_by_quarter_turns(&(base * turn))
        }
    })
}

fn is_by_quarter_turns(rotation: &Matrix3<f64>) -> bool {
    (rotation - rotation.map(f64::round)).amax() < QUARTER_TURNS
}

fn has_no_base(context: &FitContext<'_>) -> bool {
    context.models.candidate.base.pose == congruent_kinematics::Pose::identity()
}

fn is_zero(pose: &congruent_kinematics::Pose, component: usize) -> bool {
    if component < 3 {
        pose.translation[component] == 0.0
    } else {
        congruent_kinematics::rotation_log(&pose.rotation)[component - 3] == 0.0
    }
}
