//! Edits of the pose of a body, which is the origin of its first joint, and of the axis of a joint.

use congruent_input::{
    Slack, TextEdit,
    units::{Unit, UnitSystem},
};
use congruent_mjcf::{MjBody, MjJointKind};
use nalgebra::{Isometry3, Translation3, Unit as UnitVector, Vector3};

use super::{
    super::tree::point_of_axis,
    FixedPart, MjcfPlaces,
    element::{NewAttribute, changed_attributes},
};

/// A shift or a turn that is smaller is none, and a written number may be off by it. Unit: m or rad; kind: rounding of products of
/// poses.
const ROUNDING: f64 = 1e-10;
const WITHOUT_NOISE: Slack = Slack { length_m: ROUNDING, angle_rad: ROUNDING };

impl MjcfPlaces {
    /// The edits after which a joint has this origin in the link before it; none if that is not the pose of a body of its own in
    /// the main file. Of a joint with a `ref` the `ref` is edited, if that is all that is to change.
    pub fn set_joint_origin(&self, name: &str, origin: &Isometry3<f64>) -> Vec<TextEdit> {
        if let Some(edits) = self.set_reference(name, origin) {
            return edits;
        }
        let Some((body, parent_from_body)) = self.body_of_origin(name, origin) else { return Vec::new() };
        if !self.is_of_one_element(&body.place) {
            return Vec::new();
        }
        let frame_from_body = body.notation.body_from_frame.inverse() * parent_from_body;
        let mut new = Vec::new();
        let pos = frame_from_body.translation.vector;
        if (pos - body.pos.value).norm() > ROUNDING {
            new.push(NewAttribute::value("pos", numbers(pos.into())));
        }
        let rotation = frame_from_body.rotation;
        if rotation.angle_to(&body.orientation.value) > ROUNDING {
            let [x, y, z, w]: [f64; 4] = rotation.coords.into();
            // Of the two quaternions of a rotation the one with the smaller angle.
            let sign = if w < 0.0 { -1.0 } else { 1.0 };
            let key = body.orientation.place.as_ref().map_or("quat", |place| &place.key);
            let value = numbers([w, x, y, z].map(|part| sign * part));
            new.push(NewAttribute { in_place_of: key.to_owned(), key: "quat", value });
        }
        changed_attributes(&self.files[0].text, body.place.span.start, &new, &[])
    }

    /// Whether the pose of the body of a joint is not that of position 0.
    pub fn has_reference(&self, name: &str) -> bool {
        self.joint(name).is_some_and(|(_, joint)| joint.reference.value != 0.0)
    }

    /// The edits of the `ref` of a joint after which it has this origin; `None` if it has none, or if another one is not enough.
    fn set_reference(&self, name: &str, origin: &Isometry3<f64>) -> Option<Vec<TextEdit>> {
        let (index, joint) = self.joint(name).filter(|_| self.has_reference(name))?;
        let parent_from_body = self.moved_body(index)?.parent_from_body;
        let axis = joint.axis_in_body.value;
        let is_hinge = joint.kind == MjJointKind::Hinge;
        // At `ref` the body is where the file puts it, and position 0 is that much behind.
        let written_from_zero =
            (parent_from_body * Translation3::from(point_of_axis(joint))).inverse() * origin;
        let (shift, turn) = (written_from_zero.translation.vector, written_from_zero.rotation.scaled_axis());
        let (moved, rest) = if is_hinge { (turn, shift) } else { (shift, turn) };
        let back = moved.dot(&axis);
        if rest.norm() > ROUNDING || (moved - axis.into_inner() * back).norm() > ROUNDING {
            return None;
        }
        let reference = if is_hinge { joint.notation.written_angle(-back) } else { -back };
        let new = [NewAttribute::value("ref", numbers([reference]))];
        let is_own = joint.reference.place.as_ref().is_none_or(|place| self.is_of_one_element(place));
        (is_own && self.is_of_one_element(&joint.place))
            .then(|| changed_attributes(&self.files[0].text, joint.place.span.start, &new, &[]))
    }

    /// The edits after which a joint has this axis; none if it has no axis of its own in the main file, or if the joint has a `ref`.
    pub fn set_joint_axis(&self, name: &str, axis: &UnitVector<Vector3<f64>>) -> Vec<TextEdit> {
        let Some((_, joint)) = self.joint(name) else { return Vec::new() };
        let place = joint.axis_in_body.place.as_ref();
        let is_own = place.is_none_or(|place| self.is_of_one_element(place));
        if !is_own || !self.is_of_one_element(&joint.place) || joint.reference.value != 0.0 {
            return Vec::new();
        }
        let in_frame = joint.notation.body_from_frame.rotation.inverse() * axis.into_inner();
        let new = [NewAttribute::value("axis", numbers(in_frame.into()))];
        changed_attributes(&self.files[0].text, joint.place.span.start, &new, &[])
    }

    /// The body whose pose follows from the origin of a joint, and that pose in its parent.
    fn body_of_origin(&self, name: &str, origin: &Isometry3<f64>) -> Option<(&MjBody, Isometry3<f64>)> {
        let Some((index, joint)) = self.joint(name) else {
            let FixedPart::Body(body) = *self.parts.fixed.get(self.names.joint(name))? else { return None };
            let is_fixed = self.moving_joints(body).next().is_none();
            return is_fixed.then(|| (&self.model.bodies[body], *origin));
        };
        let body = self.moved_body(index).filter(|_| joint.reference.value == 0.0)?;
        // The origin of the joint is on its axis, which may be beside that of the body.
        Some((body, origin * Translation3::from(-point_of_axis(joint))))
    }
}

fn numbers<const N: usize>(values: [f64; N]) -> String {
    values.map(|value| Unit::Length.fitted(value, UnitSystem::Si, WITHOUT_NOISE)).join(" ")
}
