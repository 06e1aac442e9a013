//! The limits of a joint.

/// The range and the capability of a joint; units are those of the coordinate, per second for
/// `velocity`, newton or newton metre for `effort`. The default states a range of the position 0 alone.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointLimit {
    /// Smallest allowed position; minus infinity for a continuous joint.
    pub lower: f64,
    /// Largest allowed position; infinity for a continuous joint.
    pub upper: f64,
    /// Largest allowed speed; `None` if the description gives none.
    pub velocity: Option<f64>,
    /// Largest force or torque of the actuator; `None` if the description gives none.
    pub effort: Option<f64>,
    /// Largest acceleration, per second squared; `None` if the description gives none, as before version 1.2 of URDF.
    pub acceleration: Option<f64>,
    /// Largest deceleration, per second squared; that of URDF is the acceleration if the file gives none.
    pub deceleration: Option<f64>,
    /// Largest jerk, per second cubed; `None` if the description gives none.
    pub jerk: Option<f64>,
}
