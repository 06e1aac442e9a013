//! The settings of a world, apart from the robot.

use congruent_description::Obstacle;
use nalgebra::Vector3;

/// How a [`World`](crate::World) is set up.
///
/// The world frame is the frame of the robot's root link.
#[derive(Debug, Clone, PartialEq)]
pub struct WorldSettings {
    /// Length of a step, s. The scheme is of first order in it.
    pub step_s: f64,
    /// Acceleration of free fall, m/s^2.
    pub gravity_in_world: Vector3<f64>,
    /// Bodies around the robot, with their poses at the start.
    pub obstacles: Vec<Obstacle>,
    /// Numbers of the obstacles that [`World::move_obstacle`](crate::World::move_obstacle) may move.
    pub moving_obstacles: Vec<usize>,
    /// Whether links touch obstacles; links never touch each other.
    pub contacts: bool,
    /// Coefficient of friction between links and obstacles.
    pub contact_friction: f64,
    /// Coefficient of restitution between links and obstacles.
    pub contact_restitution: f64,
    /// Whether actuators keep the limits of effort and velocity that the description gives.
    pub actuator_limits: bool,
}

impl Default for WorldSettings {
    /// A step of 1 ms, 9.81 m/s^2 along -z, no obstacle, limits as in the description.
    fn default() -> Self {
        Self {
            step_s: 1e-3,
            gravity_in_world: Vector3::new(0.0, 0.0, -9.81),
            obstacles: Vec::new(),
            moving_obstacles: Vec::new(),
            contacts: false,
            contact_friction: 0.5,
            contact_restitution: 0.0,
            actuator_limits: true,
        }
    }
}

/// A link and an obstacle that push each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairForce {
    /// The link, in the robot's order.
    pub link: usize,
    /// Number of the obstacle in [`WorldSettings::obstacles`].
    pub obstacle: usize,
    /// Mean normal force in the last step, N, without friction.
    pub force_n: f64,
}

/// What an obstacle touches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Touches {
    /// The links of the robot.
    Links,
    /// Nothing: a link carries it.
    Nothing,
}
