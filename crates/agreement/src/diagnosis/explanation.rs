//! Explanations of a difference, and when a difference counts as none.

use congruent_description::{ChainQ, Tolerance};
use congruent_kinematics::PoseError;

use super::{
    candidate::ModelParameter,
    hypothesis::{Cause, ModelPair, Place},
};

/// What is held to be the same, and where a residual is measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Criterion {
    /// Largest difference of the tips that counts as none.
    pub tolerance: Tolerance,
    /// Configurations at which residuals are measured, in the order of the reference's joints.
    pub configurations: Vec<ChainQ>,
}

/// One fault of an explanation.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// What is wrong.
    pub cause: Cause,
    /// Where.
    pub place: Place,
    /// The numbers that were fitted.
    pub free: Vec<ModelParameter>,
}

/// Faults that together explain a difference, or part of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Explanation {
    /// The faults: one, or several; none where nothing explains the difference.
    pub parts: Vec<Part>,
    /// Both models with the faults undone.
    pub corrected: ModelPair,
    /// What is left then.
    pub residual: PoseError,
}

impl Explanation {
    /// The cause's name: that of the only part, `several`, or `unexplained`.
    pub fn cause(&self) -> Cause {
        match &self.parts[..] {
            [] => Cause::Unexplained,
            [part] => part.cause,
            _ => Cause::Several,
        }
    }
}

impl ModelPair {
    /// The worst difference of the tips over the criterion's configurations; not a number where a
    /// figure is so large that no tip comes out.
    pub fn residual(&self, criterion: &Criterion) -> PoseError {
        let residuals = criterion.configurations.iter().map(|q| self.residual_at(q));
        residuals.fold(PoseError::default(), PoseError::larger)
    }

    /// Whether the residual counts as none; the first configuration where it does not is enough to
    /// know.
    pub(super) fn is_accepted(&self, criterion: &Criterion) -> bool {
        criterion.configurations.iter().all(|q| criterion.accepts(&self.residual_at(q)))
    }

    fn residual_at(&self, q: &ChainQ) -> PoseError {
        PoseError::between(&self.candidate.base_from_tip(q), &self.reference.base_from_tip(q))
    }
}

impl Criterion {
    /// Whether a residual counts as none.
    pub fn accepts(&self, residual: &PoseError) -> bool {
        residual.is_within(&self.tolerance)
    }
}
