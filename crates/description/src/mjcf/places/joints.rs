//! Where an MJCF writes the parts of a joint of the robot: its origin is the pose of a body.

use congruent_mjcf::{MjBody, MjEqualityKind, MjJoint, MjPlace};

use super::{FixedPart, MjcfPlaces};
use crate::parameter_places::{JointElement, ParameterPlace};

impl MjcfPlaces {
    /// Where a part of a joint is written, or the element that would write it.
    pub(super) fn part_of_joint(&self, name: &str, part: JointElement) -> Option<ParameterPlace> {
        let place = match self.joint(name) {
            Some((index, joint)) => match part {
                JointElement::Origin => self.origin_of_moving(index, joint),
                JointElement::Axis => joint.axis_in_body.place.as_ref().unwrap_or(&joint.place),
                JointElement::Mimic => self.coupling(index).unwrap_or(&joint.place),
            },
            None => self.fixed_part(name)?,
        };
        Some(self.named(place))
    }

    /// Of the first joint of a body the pose of the body; another is where the file puts its axis.
    fn origin_of_moving<'a>(&'a self, index: usize, joint: &'a MjJoint) -> &'a MjPlace {
        match self.moved_body(index) {
            Some(body) => pose(body),
            None => point_of_axis(joint),
        }
    }

    /// The body that has the origin of a joint as its pose: that of its first joint that moves.
    pub(super) fn moved_body(&self, joint: usize) -> Option<&MjBody> {
        let body = self.model.joints[joint].body;
        let first = self.moving_joints(body).next();
        (first == Some(joint)).then(|| &self.model.bodies[body])
    }

    /// The joints of a body that move in the robot, in their order.
    pub(super) fn moving_joints(&self, body: usize) -> impl DoubleEndedIterator<Item = usize> {
        let is_moving = |joint: &usize| self.parts.joints.values().any(|moving| moving == joint);
        self.model.bodies[body].joints.clone().filter(is_moving)
    }

    fn fixed_part(&self, name: &str) -> Option<&MjPlace> {
        Some(match *self.parts.fixed.get(self.names.joint(name))? {
            FixedPart::Site(site) => &self.model.sites[site].place,
            // Behind its joints it is as far from the last axis as that is from it.
            FixedPart::Body(body) => match self.moving_joints(body).next_back() {
                Some(last) => point_of_axis(&self.model.joints[last]),
                None => pose(&self.model.bodies[body]),
            },
        })
    }

    /// The equality that makes a joint follow another one.
    fn coupling(&self, joint: usize) -> Option<&MjPlace> {
        let follows = |kind: &MjEqualityKind| matches!(kind, MjEqualityKind::Joint { follower, .. } if *follower == joint);
        self.model.equalities.iter().find(|of| of.is_active && follows(&of.kind)).map(|of| &of.place)
    }
}

/// Where the pose of a body is written.
fn pose(body: &MjBody) -> &MjPlace {
    body.pos.place.as_ref().or(body.orientation.place.as_ref()).unwrap_or(&body.place)
}

fn point_of_axis(joint: &MjJoint) -> &MjPlace {
    joint.pos_in_body.place.as_ref().unwrap_or(&joint.place)
}
