//! The target of inverse kinematics, and the error of a pose.

use nalgebra::Vector6;
use schemars::JsonSchema;
use serde::Serialize;

use super::options::{IkMethod, IkOptions};
use crate::spatial::{pose::Pose, rotation::rotation_log, twist::Twist};

/// The part of a pose that the target prescribes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TargetPart {
    /// The origin alone, in any orientation.
    Position,
    /// Origin and orientation of the tool.
    Pose,
}

/// A target pose of the tool centre point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IkTarget {
    /// Target pose of the tool centre point in the base.
    pub base_from_tcp: Pose,
    /// The part of the pose that is prescribed.
    pub part: TargetPart,
}

/// The error of a pose: as distance and angle, and as a task vector in the units and axes of the method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct IkResidual {
    pub(super) position_m: f64,
    pub(super) orientation_rad: f64,
    /// Angular first, as a [`Twist`].
    pub(super) task: Vector6<f64>,
}

impl IkResidual {
    pub(super) fn between(target: &IkTarget, base_from_tcp: &Pose, frame: &TaskFrame) -> Self {
        let shift = target.base_from_tcp.translation - base_from_tcp.translation;
        let rotation = match target.part {
            TargetPart::Pose => target.base_from_tcp.rotation * base_from_tcp.rotation.transpose(),
            TargetPart::Position => nalgebra::Matrix3::identity(),
        };
        // R_d R^T is the turn from the pose to the target in the axes of the base; its logarithm is axis times angle.
        let turn = rotation_log(&rotation);
        let error = match (frame.in_body, target.part) {
            // Lynch & Park sec. 6.2.2: the body twist that would bring the pose to the target in unit time.
            (true, TargetPart::Pose) => Twist::log(&(base_from_tcp.inverse() * target.base_from_tcp)),
            _ => Twist { angular: turn, linear: shift },
        };
        Self {
            position_m: shift.norm(),
            orientation_rad: turn.norm(),
            task: frame.scaled(&error, target.part),
        }
    }

    pub(super) fn within(&self, options: &IkOptions) -> bool {
        self.position_m <= options.tolerance_m && self.orientation_rad <= options.tolerance_rad
    }

    /// Half the square of the task vector.
    pub(super) fn cost(&self) -> f64 {
        0.5 * self.task.norm_squared()
    }
}

/// The axes and units that a method works in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TaskFrame {
    /// Axes of the body and the logarithm of the whole motion; otherwise axes of the base, turn and
    /// shift apart.
    in_body: bool,
    /// Factor that converts metres into the unit of the task vector.
    rad_per_metre: f64,
}

impl TaskFrame {
    pub(super) fn for_method(method: IkMethod, part: TargetPart, metres_per_rad: f64) -> Self {
        match method {
            IkMethod::LevenbergMarquardt => Self { in_body: false, rad_per_metre: 1.0 / metres_per_rad },
            IkMethod::Newton => Self { in_body: part == TargetPart::Pose, rad_per_metre: 1.0 },
            IkMethod::PseudoInverse | IkMethod::Transpose => Self { in_body: false, rad_per_metre: 1.0 },
        }
    }

    /// A column of the geometric Jacobian as one of the task.
    #[inline]
    pub(super) fn column(&self, column: &Twist, base_from_tcp: &Pose, part: TargetPart) -> Vector6<f64> {
        // Turned only: the geometric column has its velocity at the tool already, so only the axes change.
        if self.in_body {
            let body_from_base = base_from_tcp.rotation.transpose();
            let Twist { angular, linear } = *column;
            let in_body = Twist { angular: body_from_base * angular, linear: body_from_base * linear };
            return self.scaled(&in_body, part);
        }
        self.scaled(column, part)
    }

    /// The twist as a task vector; components that the target does not prescribe are zero.
    #[inline]
    fn scaled(&self, twist: &Twist, part: TargetPart) -> Vector6<f64> {
        let linear = twist.linear * self.rad_per_metre;
        let angular = match part {
            TargetPart::Pose => twist.angular,
            TargetPart::Position => nalgebra::Vector3::zeros(),
        };
        Twist { angular, linear }.into()
    }
}
