//! Expresses a description in the link frames of another one, whose frames lie elsewhere in the same links.

use std::sync::Arc;

use congruent_description::Tolerance;
use congruent_kinematics::{Pose, PoseError};

use super::{
    DynamicsModel,
    frames::{Frames, LinkPlace},
    inertial::Inertial,
};
use crate::thresholds::ZERO_VALUE;

impl DynamicsModel {
    /// The same inertias in the frames of another description whose joints move the same links in the same way. Links that
    /// only this one has are added to the other's. `None` if the two do not have the same moving joints.
    #[must_use]
    pub fn in_frames_of(&self, other: &Self) -> Option<Self> {
        let joints: Option<Vec<usize>> =
            other.frames.joints.iter().map(|joint| self.frames.find_joint(&joint.name)).collect();
        let joints = joints.filter(|joints| joints.len() == self.frames.dof())?;
        let mut frames = (*other.frames).clone();
        let mut inertials = vec![None; frames.links.len()];
        for (place, inertial) in self.frames.links.iter().zip(&self.inertials) {
            let body = place.body.and_then(|body| joints.iter().position(|&joint| joint == body));
            let there = frames.find_link(&place.name).filter(|&there| frames.links[there].body == body);
            let there = there.unwrap_or_else(|| {
                inertials.push(None);
                frames.with_link(place, body)
            });
            let there_from_link = frames.root_from_link(there).inverse() * place.root_from_link;
            inertials[there] = inertial.map(|inertial| inertial.expressed_in(&there_from_link));
        }
        Some(Self {
            frames: Arc::new(frames),
            inertials,
            resistances: joints.iter().map(|&joint| self.resistances[joint]).collect(),
            gravity_m_s2: self.gravity_m_s2,
            limits: joints.iter().map(|&joint| self.limits[joint]).collect(),
            accelerations: joints.iter().map(|&joint| self.accelerations[joint]).collect(),
            is_complete: self.is_complete,
        })
    }
}

impl DynamicsModel {
    /// The same inertias with links of fixed joints where the other description has them, as far as the two places are equal
    /// within the tolerance: a tolerated difference of an `<origin>` is none of masses.
    #[must_use]
    pub fn with_tolerated_places_of(&self, other: &Self, tolerance: &Tolerance) -> Self {
        let mut frames = (*self.frames).clone();
        for place in &mut frames.links {
            let Some(there) = other.frames.find_link(&place.name).map(|there| &other.frames.links[there])
            else {
                continue;
            };
            let name = |of: &Self, body: Option<usize>| body.map(|body| of.frames.joints[body].name.clone());
            let has_same_body = name(self, place.body) == name(other, there.body);
            let error = PoseError::between(&place.body_from_link, &there.body_from_link);
            if has_same_body && error.is_within(tolerance) {
                place.body_from_link = there.body_from_link;
            }
        }
        Self { frames: Arc::new(frames), ..self.clone() }
    }

    /// The same masses with the centres of mass and the tensors of another description, at links that both give a mass.
    #[must_use]
    pub fn with_tensors_of(&self, other: &Self) -> Self {
        let mut changed = self.clone();
        for (place, inertial) in self.frames.links.iter().zip(&mut changed.inertials) {
            let there = other.frames.find_link(&place.name).and_then(|there| other.inertials[there]);
            if let (Some(own), Some(there)) = (inertial.as_mut(), there) {
                *own = Inertial { mass_kg: own.mass_kg, ..there };
            }
        }
        changed
    }

    /// Replaces the inertials of a body by those of the same body of another description. Links that only the other one
    /// has are added.
    pub(crate) fn replace_body(&mut self, body: usize, other: &Self, other_body: usize) {
        let mut frames = (*self.frames).clone();
        for link in self.frames.links_of(body) {
            self.inertials[link] = None;
        }
        for link in other.frames.links_of(other_body) {
            let place = &other.frames.links[link];
            let there = frames.find_link(&place.name).filter(|&there| frames.links[there].body == Some(body));
            let there = there.unwrap_or_else(|| {
                self.inertials.push(None);
                frames.with_link(place, Some(body))
            });
            self.inertials[there] = other.inertials[link];
        }
        self.frames = Arc::new(frames);
    }
}

impl Frames {
    /// Adds a link of another description to a body, and returns its index.
    fn with_link(&mut self, place: &LinkPlace, body: Option<usize>) -> usize {
        let root_from_body =
            body.map_or_else(Pose::identity, |body| self.links[self.joints[body].link].root_from_link);
        let body_from_link = root_from_body.inverse() * place.root_from_link;
        self.links.push(LinkPlace { body, body_from_link, ..place.clone() });
        for other in &mut self.others {
            other.names_at_links.push(None);
            other.link_from_frame.push(None);
        }
        self.links.len() - 1
    }
}

impl Inertial {
    /// The same body expressed in another frame.
    fn expressed_in(&self, there_from_link: &Pose) -> Self {
        let com_m = there_from_link.rotation * self.com_m + there_from_link.translation;
        let size = self.com_m.norm() + there_from_link.translation.norm();
        Self {
            // Rounding of the transform would appear as a new coordinate of the centre of mass.
            com_m: com_m.map(|value| if value.abs() <= ZERO_VALUE * size { 0.0 } else { value }),
            link_from_axes: there_from_link.rotation * self.link_from_axes,
            ..*self
        }
    }
}
