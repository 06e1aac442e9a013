//! Where an MJCF writes values of the robot that was made of it.

mod element;
mod inertial_edits;
mod joint_edits;
mod joints;
mod parameters;
mod pose_edits;
mod users;

use std::{collections::BTreeMap, sync::Arc};

use congruent_input::SourceFile;
use congruent_mjcf::{MjBody, MjJoint, MjModel, MjPlace};

use self::users::PlaceUsers;
use congruent_robot::WrittenNames;

use crate::parameter_places::ParameterPlace;

/// The texts of an MJCF and of the files that it includes, in which values of links and joints are found.
#[derive(Debug, Clone, PartialEq)]
pub struct MjcfPlaces {
    model: Arc<MjModel>,
    /// The files of the model in its order, as messages name them.
    files: Vec<Arc<SourceFile>>,
    parts: Arc<PartsByName>,
    users: Arc<PlaceUsers>,
    names: WrittenNames,
}

/// The parts of a model by the names that they have in the robot.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct PartsByName {
    /// Bodies by the names of their links.
    pub(super) bodies: BTreeMap<String, usize>,
    /// Joints that move.
    pub(super) joints: BTreeMap<String, usize>,
    /// What fixed joints carry.
    pub(super) fixed: BTreeMap<String, FixedPart>,
}

/// What a fixed joint carries.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FixedPart {
    /// A body, which may have joints before it.
    Body(usize),
    /// A site.
    Site(usize),
}

impl MjcfPlaces {
    pub(super) fn new(model: Arc<MjModel>, parts: PartsByName) -> Self {
        let (files, users) = (model.files.clone(), PlaceUsers::of(&model).into());
        Self { model, files, parts: parts.into(), users, names: WrittenNames::default() }
    }

    /// The same of a robot whose joints and links have other names than in the file, or are those of no element there.
    #[must_use]
    pub(crate) fn with_names(self, change: impl FnOnce(WrittenNames) -> WrittenNames) -> Self {
        Self { names: change(self.names), ..self }
    }

    /// The main file, then those that it includes.
    pub fn files(&self) -> &[Arc<SourceFile>] {
        &self.files
    }

    /// The same, to name them in another form.
    pub(crate) fn files_mut(&mut self) -> &mut [Arc<SourceFile>] {
        &mut self.files
    }

    /// The constant of a `polycoef` with which `follower = multiplier * leader + offset`, in rad or m: its positions count from the `ref`
    /// of each joint. `None` if one of the two is no joint of the file.
    pub fn coupling_constant(
        &self,
        [follower, leader]: [&str; 2],
        multiplier: f64,
        offset: f64,
    ) -> Option<f64> {
        /// Decimals that are no rounding of a sum of numbers that files write.
        const DECIMALS: f64 = 1e12;
        let [own, other] = [self.joint(follower)?.1, self.joint(leader)?.1].map(|of| of.reference.value);
        let from_references = offset - own + multiplier * other;
        Some((from_references * DECIMALS).round() / DECIMALS)
    }

    /// The number and the values of the body of a link; `None` if the link is no body, or joined with others.
    fn body(&self, link: &str) -> Option<(usize, &MjBody)> {
        let index = *self.parts.bodies.get(self.names.link(link)?)?;
        Some((index, &self.model.bodies[index]))
    }

    /// A joint that moves.
    fn joint(&self, name: &str) -> Option<(usize, &MjJoint)> {
        let index = *self.parts.joints.get(self.names.joint(name))?;
        Some((index, &self.model.joints[index]))
    }

    /// Whether a place is in the main file, and a change there changes one element alone: not a class of defaults, nor a copy.
    fn is_of_one_element(&self, place: &MjPlace) -> bool {
        let is_in_main = Arc::ptr_eq(&place.source, &self.model.files[0]);
        is_in_main && place.class.is_none() && !self.users.are_several(place)
    }

    /// A place of the model, in the files as messages name them.
    fn named(&self, place: &MjPlace) -> ParameterPlace {
        let index = self.model.files.iter().position(|file| Arc::ptr_eq(file, &place.source));
        let source = index.map_or(&place.source, |index| &self.files[index]);
        let class = place.class.as_ref().filter(|_| self.users.are_several(place));
        ParameterPlace { source: Arc::clone(source), span: place.span.clone(), class: class.cloned() }
    }
}

#[cfg(test)]
mod edit_tests;
#[cfg(test)]
mod tests;
