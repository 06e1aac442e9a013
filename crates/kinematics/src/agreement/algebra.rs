//! What the ladder needs of twists as vectors.

use nalgebra::Vector3;

use crate::twist::Twist;

/// The twist that moves nothing.
pub(super) const NOTHING: Twist =
    Twist { angular: Vector3::new(0.0, 0.0, 0.0), linear: Vector3::new(0.0, 0.0, 0.0) };

/// A twist that moves `factor` times as far.
pub(super) fn scaled(twist: &Twist, factor: f64) -> Twist {
    Twist { angular: twist.angular * factor, linear: twist.linear * factor }
}

/// How `twist` changes while `generator` carries it along: the Lie bracket.
///
/// Source: Lynch & Park, *Modern Robotics* (2017), definition 8.5.
pub(super) fn bracket(generator: &Twist, twist: &Twist) -> Twist {
    let angular = generator.angular.cross(&twist.angular);
    let linear = generator.angular.cross(&twist.linear) + generator.linear.cross(&twist.angular);
    Twist { angular, linear }
}
