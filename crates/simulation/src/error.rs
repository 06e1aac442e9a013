//! The errors of this crate: one enum, one test for each variant.

/// Why a world cannot be built, or cannot be stepped.
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
        /// Name of the joint.
        joint: String,
        /// Lower position limit, in that unit.
        lower: f64,
        /// Upper position limit, in that unit.
        upper: f64,
        /// Unit of the limits: `rad` or `m`.
        unit: &'static str,
    },
    /// The robot has so many joints that the physics would not end in a time that anyone waits for.
    #[error(
        "{joints} joints move, and the physics is built for at most {most}: its time for one pose grows with the square of the number"
    )]
    TooManyJoints {
        /// Number of movable joints.
        joints: usize,
        /// The limit.
        most: usize,
    },
    /// Damping, dry friction, armature or a share of the effort is negative or not finite.
    #[error("joint \"{joint}\": {what} = {value} must be finite and >= 0")]
    Resistance {
        /// Name of the joint.
        joint: String,
        /// Name of the quantity.
        what: &'static str,
        /// The value that was given.
        value: f64,
    },
    /// A shape with contacts has no convex hull.
    #[error("{owner}: a shape is flat or empty and has no convex hull; give it a thickness or remove it")]
    Shape {
        /// Kind and name of the link or the obstacle.
        owner: String,
    },
    /// A vector does not hold one entry for each movable joint.
    #[error("{what}: {found} entries, but the robot has {expected} movable joints")]
    Length {
        /// Name of the vector.
        what: &'static str,
        /// Number of its entries.
        found: usize,
        /// Number of movable joints of the robot.
        expected: usize,
    },
    /// A value is infinite or NaN.
    #[error("joint \"{joint}\": {what} is not finite at {time_s} s")]
    NotFinite {
        /// Name of the first such joint.
        joint: String,
        /// Simulated time at the end of the step.
        time_s: f64,
        /// Name of the quantity.
        what: &'static str,
    },
    /// A joint moves no inertia, so its dynamics are undefined.
    #[error(
        "link \"{link}\" and every link that it carries have no mass; give it an <inertial>, or use the controller kinematic"
    )]
    Massless {
        /// The link that the joint carries.
        link: String,
    },
}
