//! A diagnosis in names.

use congruent_description::UrdfPlaces;

use super::{
    content::{Explanation, Verdict},
    explained::Teller,
};
use crate::{
    diagnosis::{Setting, diagnose},
    side::Side,
    torque::compressed::Compressed,
};

/// One of the two descriptions.
#[derive(Debug, Clone, Copy)]
pub struct Description<'a> {
    /// Its name in messages, such as the path of its file.
    pub name: &'a str,
    /// What it says.
    pub side: &'a Side,
    /// Where it says it, for messages with lines.
    pub places: Option<&'a UrdfPlaces>,
}

/// A diagnosis in names.
pub(super) struct Told {
    pub(super) same: bool,
    pub(super) links: Vec<String>,
    pub(super) explanations: Vec<Explanation>,
    pub(super) indistinguishable: Vec<Explanation>,
}

impl Told {
    /// By torques alone.
    pub(super) fn verdict(&self) -> Verdict {
        match (self.same, self.explanations.is_empty()) {
            (true, _) => Verdict::SameTorques,
            (false, false) => Verdict::Explained,
            (false, true) => Verdict::Unexplained,
        }
    }

    pub(super) fn new(setting: &Setting<'_>, candidate: &Description<'_>, torque: &Compressed) -> Self {
        let diagnosed = diagnose(setting, torque);
        let teller = Teller {
            candidate: setting.candidate,
            suspect: setting.suspect,
            places: candidate.places,
            difference: torque.difference.norm().hypot(torque.outside),
        };
        let mut explained = diagnosed.explanations.iter().map(|grouped| teller.explanation(grouped));
        let explanations = explained.by_ref().take(1).collect();
        let name = |&link: &usize| setting.candidate.frames.link_name(link).to_owned();
        Self {
            same: diagnosed.same,
            links: diagnosed.links.iter().map(name).collect(),
            explanations,
            indistinguishable: explained.collect(),
        }
    }
}
