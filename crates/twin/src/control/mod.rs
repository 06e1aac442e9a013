//! The controllers of a scenario: from measured states and setpoints to the commands of the actuators.
//!
//! A law knows the declared robot, not the physics: what a fault changes in the twin, it does not see.

mod computed_torque;
mod digital;
mod joint_controller;
mod model;
mod servos;
#[cfg(test)]
mod windup_tests;

pub use joint_controller::JointController;
