//! A diagnosis whose links, joints and parameters are named, for the report.

use congruent_description::ParameterPlaces;
use congruent_dynamics::DynamicsError;

use crate::{
    diagnosis::{DiagnosisInput, ReferenceTorques, diagnose_in_stages},
    model::DynamicsModel,
    report::{
        content::{DynamicsExplanation, DynamicsVerdict, PlacedCause},
        explained::ExplanationContext,
        places::ModelFiles,
    },
    torque::reduced_difference::ReducedTorqueDifference,
};

/// One of the two models of a comparison, with its name and the file that it comes from.
#[derive(Debug, Clone, Copy)]
pub struct NamedModel<'a> {
    /// Its name in messages, such as the path of its file.
    pub name: &'a str,
    /// Its inertias, joint terms, gravity and limits.
    pub model: &'a DynamicsModel,
    /// Places of its parameters in the file, for messages with lines; `None` if they are not known.
    pub places: Option<&'a dyn ParameterPlaces>,
}

/// A diagnosis with names in place of indices.
pub(super) struct NamedDiagnosis {
    pub(super) same: bool,
    pub(super) links: Vec<String>,
    pub(super) explanations: Vec<DynamicsExplanation>,
    pub(super) indistinguishable: Vec<DynamicsExplanation>,
}

impl NamedDiagnosis {
    /// The verdict by torques alone: parameters without an effect on torques are compared elsewhere.
    pub(super) fn verdict(&self) -> DynamicsVerdict {
        match (self.same, self.explanations.is_empty()) {
            (true, _) => DynamicsVerdict::SameTorques,
            (false, false) => DynamicsVerdict::Explained,
            (false, true) => DynamicsVerdict::Unexplained,
        }
    }

    pub(super) fn new(
        setting: &DiagnosisInput<'_>,
        files: ModelFiles<'_>,
        torque: &ReducedTorqueDifference,
        expected: ReferenceTorques<'_>,
    ) -> Result<Self, DynamicsError> {
        let diagnosed = diagnose_in_stages(setting, torque, expected)?;
        let context = ExplanationContext::new(setting, files, torque);
        let mut explained = diagnosed.explanations.iter().map(|grouped| context.explanation(grouped));
        let mut explanations: Vec<DynamicsExplanation> = explained.by_ref().take(1).collect();
        let mut indistinguishable: Vec<DynamicsExplanation> = Vec::new();
        for other in explained {
            // With the values of the other file two causes may be one correction, of which the first is the narrower name.
            match explanations.first_mut().filter(|first| first.parameters == other.parameters) {
                Some(first) => {
                    let (cause, detail, place) = (other.cause, other.detail, other.place);
                    first.also_named.push(PlacedCause { cause, detail, place });
                    first.also_named.extend(other.also_named);
                }
                None => indistinguishable.push(other),
            }
        }
        let name = |&link: &usize| setting.candidate.frames.link_name(link).to_owned();
        Ok(Self {
            same: diagnosed.same,
            links: diagnosed.links.iter().map(name).collect(),
            explanations,
            indistinguishable,
        })
    }
}
