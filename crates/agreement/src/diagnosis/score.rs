//! Which of several explanations is named first.
//!
//! The measure is how much an explanation must say: a price for every free number and every part, and
//! what it leaves over. The two cannot be added, since nobody knows how exact a file is meant to be;
//! but the best explanation shows it. What leaves orders of magnitude more than that is refuted at
//! any price, and of the others, which leave what a file's rounding leaves, the cheapest is named.

use congruent_kinematics::PoseError;

use super::{
    candidate::{Candidate, Constant, DhEntry, ModelParameter},
    explanation::Criterion,
    hypothesis::{Cause, Hypothesis, ModelPair, Place},
    hypothesis_fit::{FitContext, HypothesisFit},
};

/// Residuals below this, in m or rad, are rounding: of a fit, or of ten digits in a file.
const ROUNDING: f64 = 1e-11;
/// A residual so many times the best one's is no rounding of the same file.
const FAR: f64 = 10.0;
/// A figure that is not so many times the residual that is left could as well be zero.
const EVIDENT: f64 = 3.0;
/// A slip that gives a figure so many times the residual is no coincidence, even where a free number
/// takes the file's rounding with it and leaves less.
const CERTAIN: f64 = 1e3;
/// Entries of a rotation by quarter turns are 0 or 1 within this: four decimals of an angle.
const QUARTER_TURNS: f64 = 1e-3;

/// The order in which explanations are named; smaller is first.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Rank {
    /// Free numbers, what counts as one, and one for each part beyond the first.
    price: usize,
    /// What is left: far below the tolerance, below it, or at it.
    left: u8,
    /// Figures that are named although nothing stands there, or that a slip leaves near nothing.
    unlikely: usize,
    /// Blames of the other file.
    elsewhere: usize,
    /// The causes, in the catalogue's order.
    causes: Vec<Cause>,
    /// The hypotheses, so that the order is the same on every machine.
    hypotheses: Vec<usize>,
}

pub(super) fn rank(context: &FitContext<'_>, fit: &HypothesisFit, criterion: &Criterion) -> Rank {
    let parts = || fit.hypotheses.iter().map(|&at| &context.hypotheses[at]);
    let residual = fit.corrected.residual(criterion);
    let share = criterion.share(&residual);
    let mut causes: Vec<Cause> = parts().map(|hypothesis| hypothesis.cause).collect();
    causes.sort_unstable();
    let slips: usize = parts()
        .filter_map(|hypothesis| EvaluatedSlip::of(context, fit, hypothesis))
        .map(|slip| slip.unproved(&residual))
        .sum();
    let unwritten = parts().filter(|hypothesis| is_unwritten(&context.models.candidate, hypothesis)).count();
    let numbers: usize = parts().map(|hypothesis| numbers(context, fit, hypothesis)).sum();
    Rank {
        price: numbers + slips + fit.hypotheses.len() - 1,
        left: if share <= 0.1 { 0 } else { u8::from(share > 0.3) + 1 },
        unlikely: unwritten + slips,
        elsewhere: parts().filter(|hypothesis| is_elsewhere(hypothesis)).count(),
        causes,
        hypotheses: fit.hypotheses.clone(),
    }
}

/// Whether an explanation leaves so much more than the best that both cannot be right.
pub(super) fn is_refuted(
    context: &FitContext<'_>,
    fit: &HypothesisFit,
    criterion: &Criterion,
    best: &PoseError,
) -> bool {
    let left = fit.corrected.residual(criterion);
    let above = |residual: &PoseError| {
        criterion.share(&PoseError {
            position_m: residual.position_m.max(ROUNDING),
            orientation_rad: residual.orientation_rad.max(ROUNDING),
        })
    };
    let is_certain = |at: &usize| {
        EvaluatedSlip::of(context, fit, &context.hypotheses[*at])
            .is_some_and(|slip| slip.is_above(CERTAIN, &left))
    };
    above(&left) > FAR * above(best) && !fit.hypotheses.iter().all(is_certain)
}

impl Criterion {
    /// A residual in tolerances.
    pub(super) fn share(&self, residual: &PoseError) -> f64 {
        (residual.position_m / self.tolerance.position_m)
            .max(residual.orientation_rad / self.tolerance.orientation_rad)
    }
}

/// What a hypothesis is free to choose, in numbers. Another order of angles in the other file is a
/// choice as well: of quarter turns, where every order is some quarter turn, as good as any three.
fn numbers(context: &FitContext<'_>, fit: &HypothesisFit, hypothesis: &Hypothesis) -> usize {
    let Place::ReferenceJoints(joints) = &hypothesis.place else { return hypothesis.free.len() };
    if !is_elsewhere(hypothesis) {
        return hypothesis.free.len();
    }
    let by_quarters = |models: &ModelPair| {
        let mut rotations =
            joints.iter().map(|&joint| models.reference.joints[joint].parent_from_joint.rotation);
        rotations.all(|rotation| (rotation - rotation.map(f64::round)).amax() < QUARTER_TURNS)
    };
    if by_quarters(context.models) && by_quarters(&fit.corrected) { 3 } else { 1 }
}

/// Whether the other file is named for what it says, not the model for how it was made from it.
fn is_elsewhere(hypothesis: &Hypothesis) -> bool {
    hypothesis.cause == Cause::RpyOrder && matches!(hypothesis.place, Place::ReferenceJoints(_))
}

/// The figures that a slip of a unit changes.
struct EvaluatedSlip {
    is_angle: bool,
    /// How many are not zero; of a vector all.
    figures: usize,
    /// The largest as it stands, and as it should be.
    found: f64,
    expected: f64,
}

impl EvaluatedSlip {
    /// Of a hypothesis about the unit of some figures; a unit of positions is none of those.
    fn of(context: &FitContext<'_>, fit: &HypothesisFit, hypothesis: &Hypothesis) -> Option<Self> {
        let is_angle = match hypothesis.cause {
            Cause::DegreesAsRadians | Cause::RadiansAsDegrees => true,
            Cause::MillimetresAsMetres => false,
            _ => return None,
        };
        let figures = |candidate: &Candidate| -> Vec<f64> {
            let column = |entries: &[DhEntry]| {
                let rows = 0..candidate.rows.len();
                let figures =
                    rows.flat_map(|row| entries.iter().filter_map(move |&entry| candidate.entry(row, entry)));
                figures.collect()
            };
            let constant = |constant: &Constant| match constant.written_rpy_rad {
                Some(rpy) if is_angle => rpy.to_vec(),
                _ if is_angle => {
                    congruent_kinematics::rotation_log(&constant.pose.rotation).as_slice().to_vec()
                }
                _ => constant.pose.translation.as_slice().to_vec(),
            };
            match &hypothesis.place {
                Place::Entries(entry, rows) => candidate.entry(rows[0], *entry).into_iter().collect(),
                Place::Column(entries) => column(entries),
                Place::Base => constant(&candidate.base),
                Place::Tool => constant(&candidate.tool),
                Place::Model => {
                    [column(&[DhEntry::A, DhEntry::D]), constant(&candidate.base), constant(&candidate.tool)]
                        .concat()
                }
                Place::Rows(_) | Place::ReferenceJoints(_) => Vec::new(),
            }
        };
        let largest = |figures: &[f64]| figures.iter().fold(0.0_f64, |most, figure| most.max(figure.abs()));
        let (found, expected) = (figures(&context.models.candidate), figures(&fit.corrected.candidate));
        let is_written = found.iter().any(|figure| *figure != 0.0);
        let is_vector = matches!(hypothesis.place, Place::Base | Place::Tool);
        let count = found.iter().filter(|figure| is_vector || **figure != 0.0).count();
        is_written.then(|| Self {
            is_angle,
            figures: count,
            found: largest(&found),
            expected: largest(&expected),
        })
    }

    fn is_above(&self, times: f64, left: &PoseError) -> bool {
        self.expected >= times * if self.is_angle { left.orientation_rad } else { left.position_m }
    }

    /// How many figures become so small that zero would do as well: nothing speaks for the slip then,
    /// only for that the figures are wrong.
    fn unproved(&self, left: &PoseError) -> usize {
        if self.expected < self.found && !self.is_above(EVIDENT, left) { self.figures } else { 0 }
    }
}

/// Whether a single figure is named that is zero as it stands: a zero is rarely a slip of the pen.
/// A joint's zero is not asked: tables leave it out.
fn is_unwritten(candidate: &Candidate, hypothesis: &Hypothesis) -> bool {
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

fn is_zero(pose: &congruent_kinematics::Pose, component: usize) -> bool {
    if component < 3 {
        pose.translation[component] == 0.0
    } else {
        congruent_kinematics::rotation_log(&pose.rotation)[component - 3] == 0.0
    }
}
