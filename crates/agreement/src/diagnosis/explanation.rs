//! Explanations of a difference, and the criterion for agreement.

use congruent_description::{ChainQ, Tolerance};
use congruent_kinematics::PoseError;

use super::{
    candidate::ModelParameter,
    hypothesis::{Cause, FaultPlace, ModelPair},
};

/// The tolerance, and the configurations at which a residual is measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Criterion {
    /// Largest difference of the tips that counts as agreement.
    pub tolerance: Tolerance,
    /// Configurations at which residuals are measured, in the order of the reference model's joints.
    pub configurations: Vec<ChainQ>,
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
    /// The difference before any correction, then after each of `faults` is corrected, one after the other.
    pub stages: Vec<PoseError>,
    /// The remaining difference of the corrected models.
    pub residual: PoseError,
}

impl Explanation {
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

    /// Whether the residual is accepted; stops at the first configuration at which it is not.
    pub(super) fn is_accepted(&self, criterion: &Criterion) -> bool {
        criterion.configurations.iter().all(|q| criterion.accepts(&self.residual_at(q)))
    }

    fn residual_at(&self, q: &ChainQ) -> PoseError {
        PoseError::between(&self.candidate.base_from_tip(q), &self.reference.base_from_tip(q))
    }
}

impl Criterion {
    /// Whether a residual is within the tolerance.
    pub fn accepts(&self, residual: &PoseError) -> bool {
        residual.is_within(&self.tolerance)
    }
}
