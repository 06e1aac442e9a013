//! The errors of this crate: one enum, one test for each variant.

/// Why a world was not built, or why it did not step.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SimulationError {
    /// The time step is not a positive number.
    #[error("step_s = {step_s} is not a positive number of seconds")]
    Step {
        /// The requested step, s.
        step_s: f64,
    },
    /// Gravity has an entry that is not finite.
    #[error("gravity [{}, {}, {}] m/s2 is not finite", .gravity_in_world[0], .gravity_in_world[1], .gravity_in_world[2])]
    Gravity {
        /// The requested gravity, m/s^2.
        gravity_in_world: [f64; 3],
    },
    /// The limits of a joint allow no position.
    #[error("joint \"{joint}\": the lower limit {lower} {unit} is above the upper limit {upper} {unit}")]
    Limits {
        /// The joint.
        joint: String,
        /// Lower limit.
        lower: f64,
        /// Upper limit.
        upper: f64,
        /// `rad` or `m`.
        unit: &'static str,
    },
    /// Damping, dry friction, armature or a share of the effort is no number from zero on.
    #[error("joint \"{joint}\": a {what} of {value} is not a finite number of at least 0")]
    Resistance {
        /// The joint.
        joint: String,
        /// Which of them.
        what: &'static str,
        /// The value.
        value: f64,
    },
    /// A shape with contacts has no convex hull.
    #[error("{owner}: a shape is flat or empty and has no convex hull; give it a thickness or leave it out")]
    Shape {
        /// The link or the obstacle.
        owner: String,
    },
    /// A vector does not hold one entry for each movable joint.
    #[error("{what}: {found} entries, but the robot has {expected} movable joints")]
    Length {
        /// Which vector.
        what: &'static str,
        /// Its length.
        found: usize,
        /// The number of movable joints.
        expected: usize,
    },
    /// A value is infinite or NaN.
    #[error("joint \"{joint}\": {what} is not finite at {time_s} s")]
    NotFinite {
        /// The first such joint.
        joint: String,
        /// Simulated time at the end of the step.
        time_s: f64,
        /// Which quantity.
        what: &'static str,
    },
    /// A joint moves no inertia, so its dynamics are undefined.
    #[error(
        "link \"{link}\" and all that it carries have no mass; give it an <inertial>, or use the controller kinematic"
    )]
    Massless {
        /// The link that the joint carries.
        link: String,
    },
}
