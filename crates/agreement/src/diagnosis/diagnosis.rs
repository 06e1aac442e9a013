//! What the ladder answers: explanations, the simplest first, and what cannot be told from it.

use congruent_kinematics::{Pose, larger};

use super::{
    gauge::Gauge,
    hypothesis::{Case, Cause, Place},
    invariants::JointDifference,
    suspect::Parameter,
};

/// What is held to be the same, and where a residual is measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Question {
    /// Largest distance of the tips that counts as none.
    pub position_m: f64,
    /// Largest angle between the tips that counts as none.
    pub orientation_rad: f64,
    /// Configurations at which residuals are measured, in the order of the reference's joints.
    pub configurations: Vec<Vec<f64>>,
}

/// The worst difference of the tips over the configurations of a [`Question`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Residual {
    /// Distance of the origins.
    pub position_m: f64,
    /// Angle between the orientations.
    pub orientation_rad: f64,
}

impl Residual {
    /// Of two poses of the tip.
    pub(super) fn between(found: &Pose, expected: &Pose) -> Self {
        Self { position_m: found.distance_m(expected), orientation_rad: found.angle_rad(expected) }
    }

    /// The larger of each.
    pub(super) fn larger(self, other: Self) -> Self {
        Self {
            position_m: larger(self.position_m, other.position_m),
            orientation_rad: larger(self.orientation_rad, other.orientation_rad),
        }
    }
}

/// One fault of an explanation.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// What is wrong.
    pub cause: Cause,
    /// Where.
    pub place: Place,
    /// The numbers that were fitted.
    pub free: Vec<Parameter>,
}

/// Faults that together explain a difference, or part of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Explanation {
    /// The faults: one, or several; none where nothing explains the difference.
    pub parts: Vec<Part>,
    /// Both models with the faults undone.
    pub mended: Case,
    /// What is left then.
    pub residual: Residual,
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

/// The answer of the ladder.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// The simplest explanation that reaches the tolerance, or `unexplained`; then what comes next
    /// and leaves more.
    pub explanations: Vec<Explanation>,
    /// Explanations that leave as little as the first: the models cannot tell them apart, and why.
    pub indistinguishable: Vec<(Explanation, Gauge)>,
    /// Where the screws differ, in the order in which quantities survive a change of frames.
    pub differences: Vec<JointDifference>,
}

impl Case {
    /// The worst difference of the tips over the question's configurations; not a number where a
    /// figure is so large that no tip comes out.
    pub fn residual(&self, question: &Question) -> Residual {
        question.configurations.iter().map(|q| self.residual_at(q)).fold(
            Residual::default(),
            |worst, here| Residual {
                position_m: larger(worst.position_m, here.position_m),
                orientation_rad: larger(worst.orientation_rad, here.orientation_rad),
            },
        )
    }

    /// Whether the residual counts as none; the first configuration where it does not is enough to
    /// know.
    pub(super) fn is_accepted(&self, question: &Question) -> bool {
        question.configurations.iter().all(|q| question.accepts(&self.residual_at(q)))
    }

    fn residual_at(&self, q: &[f64]) -> Residual {
        Residual::between(&self.suspect.base_from_tip(q), &self.reference.base_from_tip(q))
    }
}

impl Question {
    /// Whether a residual counts as none.
    pub fn accepts(&self, residual: &Residual) -> bool {
        residual.position_m <= self.position_m && residual.orientation_rad <= self.orientation_rad
    }
}
