//! The digits that joints are written with.

use congruent_input::{
    TypedNumber, half_places,
    units::{Unit, UnitSystem},
};
use congruent_robot::{Joint, JointParts, JointRounding, SmallMotion, motions_of_pose};
use nalgebra::Vector3;
use roxmltree::Node;

use super::node::element;

/// Half of the last place of the typed values of a joint: how far each true value may be from the typed one.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointDigits {
    /// Those of its `<origin>`: x, y, z in m, then roll, pitch, yaw in rad.
    pub origin: [f64; 6],
    /// Those of the components of its `<axis>`.
    pub axis: [f64; 3],
}

impl JointDigits {
    /// The digits of these joints; whole components of an axis are exact, and so is what is not written.
    pub(super) fn read(joints: &[Option<Node<'_, '_>>]) -> Vec<Self> {
        let mut digits = vec![Self::default(); joints.len()];
        for (unit, written, first) in [(Unit::Length, "xyz", 0), (Unit::Angle, "rpy", 3)] {
            let mut places = Vec::new();
            let mut typed = Vec::new();
            for (joint, node) in joints.iter().enumerate() {
                let numbers = numbers(*node, "origin", written);
                places.extend((0..numbers.len()).map(|at| (joint, first + at)));
                typed.extend(numbers);
            }
            for ((joint, at), half) in places.into_iter().zip(half_places(unit, &typed)) {
                digits[joint].origin[at] = half;
            }
        }
        for (joint, node) in digits.iter_mut().zip(joints) {
            for (half, number) in joint.axis.iter_mut().zip(numbers(*node, "axis", "xyz")) {
                // `0 0 1` is a direction by design.
                let is_whole = number.text.parse::<f64>().is_ok_and(|component| component.fract() == 0.0);
                if !is_whole {
                    *half = half_places(Unit::Angle, &[number])[0];
                }
            }
        }
        digits
    }

    /// What they leave open in a joint.
    fn rounding(&self, joint: &Joint) -> JointRounding {
        let parent_from_joint = &joint.parent_from_joint;
        let point = parent_from_joint.translation.vector;
        let axis = |(at, half): (usize, f64)| {
            let tilt = joint.axis_in_joint.cross(&Vector3::ith(at, half));
            SmallMotion::turn(parent_from_joint.rotation * tilt, &point)
        };
        let is_open = |(_, half): &(usize, f64)| *half > 0.0;
        JointRounding {
            origin: motions_of_pose(self.origin, parent_from_joint),
            axis: self.axis.into_iter().enumerate().filter(is_open).map(axis).collect(),
            ..JointRounding::default()
        }
    }
}

/// Adds to each joint of a file what its digits leave open.
pub(super) fn add_roundings(joints: &mut [JointParts], nodes: &[Option<Node<'_, '_>>]) {
    for (JointParts { joint, .. }, digits) in joints.iter_mut().zip(JointDigits::read(nodes)) {
        joint.rounding = digits.rounding(joint);
    }
}

/// The numbers of an attribute of a part of a joint; at most three.
fn numbers<'a>(joint: Option<Node<'a, '_>>, part: &str, attribute: &str) -> Vec<TypedNumber<'a>> {
    let text = joint.and_then(|joint| element(joint, part)?.attribute(attribute)).unwrap_or_default();
    text.split_whitespace().take(3).map(|text| TypedNumber { text, units: UnitSystem::Si }).collect()
}
