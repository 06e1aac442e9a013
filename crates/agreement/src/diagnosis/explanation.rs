//! Explanations of a difference, and the criterion for agreement.

use congruent_description::{ChainQ, Tolerance};
use congruent_kinematics::PoseError;

use super::{
    candidate::ModelParameter,
    digits::WrittenDigits,
    hypothesis::{Cause, FaultPlace, ModelPair},
    thresholds::{BEYOND_DIGITS, SAME_VALUE},
};

/// The tolerance, the configurations at which a residual is measured, and the digits of the files.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Criterion {
    /// Largest difference of the tips that counts as agreement.
    pub tolerance: Tolerance,
    /// Configurations at which residuals are measured, in the order of the reference model's joints.
    pub configurations: Vec<ChainQ>,
    /// Models that are the same within the digits of their files count as equal, too.
    pub digits: WrittenDigits,
}

/// One fault of an explanation.
#[derive(Debug, Clone, PartialEq)]
pub struct ExplainedFault {
    /// The cause that this fault has.
    pub cause: Cause,
    /// The place of the fault in the models.
    pub place: FaultPlace,
    /// The parameters that were fitted.
    pub free: Vec<ModelParameter>,
}

/// Faults that together explain a difference, or part of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Explanation {
    /// The faults: one, or several; none if no hypothesis explains the difference.
    pub faults: Vec<ExplainedFault>,
    /// Both models with the faults corrected.
    pub corrected: ModelPair,
    /// The digits that the corrected models are typed with.
    pub digits: WrittenDigits,
    /// The difference before any correction, then after each of `faults` is corrected, one after the other.
    pub stages: Vec<PoseError>,
    /// The remaining difference of the corrected models.
    pub residual: PoseError,
    /// Whether the corrected models are accepted: the faults explain the whole difference.
    pub is_complete: bool,
}

impl Explanation {
    /// No fault: all of the difference remains.
    pub(crate) fn without_faults(models: &ModelPair, criterion: &Criterion) -> Self {
        let residual = models.residual(criterion);
        Self {
            faults: Vec::new(),
            corrected: models.clone(),
            digits: criterion.digits.clone(),
            stages: vec![residual],
            residual,
            is_complete: models.is_accepted(criterion),
        }
    }

    /// The cause of the only fault, `several`, or `unexplained`.
    pub fn cause(&self) -> Cause {
        match &self.faults[..] {
            [] => Cause::Unexplained,
            [fault] => fault.cause,
            _ => Cause::Several,
        }
    }
}

impl ModelPair {
    /// The worst difference of the tips over the criterion's configurations; not a number if a parameter is
    /// so large that forward kinematics overflows.
    pub fn residual(&self, criterion: &Criterion) -> PoseError {
        let residuals = criterion.configurations.iter().map(|q| self.residual_at(q));
        residuals.fold(PoseError::default(), PoseError::larger)
    }

    /// Whether the residual is within the tolerance, or within the digits of the files.
    pub(crate) fn is_accepted(&self, criterion: &Criterion) -> bool {
        self.is_within_tolerance(criterion) || criterion.digits.explain(self, &criterion.configurations)
    }

    /// Whether the residual is within the tolerance; stops at the first configuration at which it is not.
    pub(crate) fn is_within_tolerance(&self, criterion: &Criterion) -> bool {
        self.is_within(&criterion.tolerance, criterion)
    }

    /// Whether the residual is within another tolerance than the criterion's.
    pub(crate) fn is_within(&self, tolerance: &Tolerance, criterion: &Criterion) -> bool {
        criterion.configurations.iter().all(|q| self.residual_at(q).is_within(tolerance))
    }

    pub(super) fn residual_at(&self, q: &ChainQ) -> PoseError {
        PoseError::between(&self.candidate.base_from_tip(q), &self.reference.base_from_tip(q))
    }
}

impl Criterion {
    /// Whether a residual is within the tolerance, and far below what the digits of the files allow, if there are any.
    pub(crate) fn is_beyond_digits(&self, residual: &PoseError) -> bool {
        let PoseError { position_m, orientation_rad } = self.digits.allowed;
        let has_digits = !self.digits.values.is_empty();
        let allowed = Tolerance {
            position_m: (BEYOND_DIGITS * position_m).max(SAME_VALUE),
            orientation_rad: (BEYOND_DIGITS * orientation_rad).max(SAME_VALUE),
        };
        residual.is_within(&self.tolerance) && (!has_digits || residual.is_within(&allowed))
    }

    /// The residual that says nothing: the tolerance, or what the digits of the files allow, if that is more.
    pub(super) fn insignificant(&self) -> Tolerance {
        let PoseError { position_m, orientation_rad } = self.digits.allowed;
        Tolerance {
            position_m: self.tolerance.position_m.max(position_m),
            orientation_rad: self.tolerance.orientation_rad.max(orientation_rad),
        }
    }
}
