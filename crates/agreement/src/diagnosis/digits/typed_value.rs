//! One value of a file, and what it changes in the models.

use congruent_input::axes_of_rpy_fixed_xyz;
use congruent_kinematics::{Pose, rotation_exp};
use nalgebra::Vector3;

use crate::diagnosis::{
    candidate::{DeclaredTransform, DhEntry, ModelParameter},
    hypothesis::ModelPair,
};

/// Half places below this change nothing. Unit: m or rad; kind: rounding, as `2.7629E-18` in an exported URDF.
pub(super) const NO_EFFECT: f64 = 1e-13;

/// A number of a written transform.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TransformPart {
    /// x, y or z, in the frame before the transform.
    Translation(usize),
    /// Roll, pitch or yaw about the fixed axes x, y, z.
    Rotation(usize),
}

impl TransformPart {
    /// All six numbers in the order in which files write them: x, y, z, roll, pitch, yaw.
    pub const ALL: [Self; 6] = [
        Self::Translation(0),
        Self::Translation(1),
        Self::Translation(2),
        Self::Rotation(0),
        Self::Rotation(1),
        Self::Rotation(2),
    ];
}

/// The place of a typed value in the two models.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TypedPlace {
    /// An entry of a row of the candidate.
    Row(usize, DhEntry),
    /// A number of the declared transform before the rows.
    Base(TransformPart),
    /// A number of the declared transform after the rows.
    Tool(TransformPart),
    /// A number of the constant transform of a joint of the reference model.
    Origin(usize, TransformPart),
    /// A component of the axis of a joint of the reference model.
    Axis(usize, usize),
}

impl TypedPlace {
    /// The place of a parameter; `None` for one that no file has.
    pub(super) fn of(parameter: ModelParameter) -> Option<Self> {
        let part = |component: usize| TransformPart::ALL[component];
        match parameter {
            ModelParameter::Row(row, entry) => Some(Self::Row(row, entry)),
            ModelParameter::Base(component) => Some(Self::Base(part(component))),
            ModelParameter::Tool(component) => Some(Self::Tool(part(component))),
            ModelParameter::Rate(_) => None,
        }
    }
}

/// A value of a file that is right within half of its last place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TypedValue {
    /// What the value is of the models.
    pub place: TypedPlace,
    /// Half of its last place, m or rad.
    pub half_place: f64,
}

impl TypedValue {
    /// Whether it is a value of the reference model.
    pub(super) fn is_in_reference(&self) -> bool {
        matches!(self.place, TypedPlace::Origin(..) | TypedPlace::Axis(..))
    }

    /// Whether it is an angle, or a component of a direction.
    pub(super) fn is_angle(&self) -> bool {
        match self.place {
            TypedPlace::Row(_, entry) => entry.is_angle(),
            TypedPlace::Base(part) | TypedPlace::Tool(part) | TypedPlace::Origin(_, part) => {
                matches!(part, TransformPart::Rotation(_))
            }
            TypedPlace::Axis(..) => true,
        }
    }

    /// Adds `by` to the value.
    pub(super) fn shift(&self, models: &mut ModelPair, by: f64) {
        let ModelPair { candidate, reference } = models;
        match self.place {
            TypedPlace::Row(row, entry) => candidate.shift(ModelParameter::Row(row, entry), by),
            TypedPlace::Base(part) => shift_declared(&mut candidate.base, part, by),
            TypedPlace::Tool(part) => shift_declared(&mut candidate.tool, part, by),
            TypedPlace::Origin(joint, part) => {
                let pose = &mut reference.joints[joint].parent_from_joint;
                *pose = shifted(pose, part, by);
            }
            TypedPlace::Axis(joint, component) => {
                let Some(twist) = &mut reference.joints[joint].twist_in_joint else { return };
                // An axis is a direction: the length that a component adds is normalised away.
                for vector in [&mut twist.angular, &mut twist.linear] {
                    if *vector != Vector3::zeros() {
                        *vector = (*vector + Vector3::ith(component, by)).normalize();
                    }
                }
            }
        }
    }
}

/// Changes one of the numbers of a declared transform, and the angles that it is written with.
fn shift_declared(transform: &mut DeclaredTransform, part: TransformPart, by: f64) {
    transform.pose = shifted(&transform.pose, part, by);
    if let (TransformPart::Rotation(angle), Some(rpy)) = (part, &mut transform.written_rpy_rad) {
        rpy[angle] += by;
    }
}

/// A transform with one of its numbers changed.
fn shifted(pose: &Pose, part: TransformPart, by: f64) -> Pose {
    let Pose { rotation, translation } = *pose;
    match part {
        TransformPart::Translation(axis) => Pose::from_parts(rotation, translation + Vector3::ith(axis, by)),
        TransformPart::Rotation(angle) => {
            let axis = axes_of_rpy_fixed_xyz(&rotation)[angle];
            Pose::from_parts(rotation_exp(&(axis * by)) * rotation, translation)
        }
    }
}

#[cfg(test)]
mod tests {
    use congruent_input::rotation_from_rpy_fixed_xyz;

    use super::*;

    /// Shifting roll, pitch and yaw is what writing other angles is.
    #[test]
    fn a_shifted_angle_is_another_written_angle() {
        let rpy = [0.4, -0.7, 1.1];
        let pose = |rpy: [f64; 3]| {
            Pose::from_parts(
                rotation_from_rpy_fixed_xyz(rpy).to_rotation_matrix().into_inner(),
                Vector3::zeros(),
            )
        };
        for angle in 0..3 {
            let mut other = rpy;
            other[angle] += 0.2;
            let error = shifted(&pose(rpy), TransformPart::Rotation(angle), 0.2).angle_rad(&pose(other));
            assert!(error < 1e-15, "{angle}: {error}");
        }
    }
}
