//! A diagnosis in names.

use congruent_dynamics::DynamicsError;

use super::{
    content::{DynamicsExplanation, DynamicsVerdict},
    explained::Teller,
    places::{Files, ParameterPlaces},
};
use crate::{
    diagnosis::{Expected, Setting, diagnose_in_stages},
    side::Side,
    torque::compressed::Compressed,
};

/// One of the two descriptions.
#[derive(Debug, Clone, Copy)]
pub struct NamedSide<'a> {
    /// Its name in messages, such as the path of its file.
    pub name: &'a str,
    /// What it says.
    pub side: &'a Side,
    /// Where it says it, for messages with lines.
    pub places: Option<&'a dyn ParameterPlaces>,
}

/// A diagnosis in names.
pub(super) struct Told {
    pub(super) same: bool,
    pub(super) links: Vec<String>,
    pub(super) explanations: Vec<DynamicsExplanation>,
    pub(super) indistinguishable: Vec<DynamicsExplanation>,
}

impl Told {
    /// By torques alone.
    pub(super) fn verdict(&self) -> DynamicsVerdict {
        match (self.same, self.explanations.is_empty()) {
            (true, _) => DynamicsVerdict::SameTorques,
            (false, false) => DynamicsVerdict::Explained,
            (false, true) => DynamicsVerdict::Unexplained,
        }
    }

    pub(super) fn new(
        setting: &Setting<'_>,
        files: Files<'_>,
        torque: &Compressed,
        expected: Expected<'_>,
    ) -> Result<Self, DynamicsError> {
        let diagnosed = diagnose_in_stages(setting, torque, expected)?;
        let teller = Teller::new(setting, files, torque);
        let mut explained = diagnosed.explanations.iter().map(|grouped| teller.explanation(grouped));
        let explanations = explained.by_ref().take(1).collect();
        let name = |&link: &usize| setting.candidate.frames.link_name(link).to_owned();
        Ok(Self {
            same: diagnosed.same,
            links: diagnosed.links.iter().map(name).collect(),
            explanations,
            indistinguishable: explained.collect(),
        })
    }
}
