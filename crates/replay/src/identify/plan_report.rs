//! The answer of `congruent plan`.

use congruent_identification::JointUnknown;
use schemars::JsonSchema;
use serde::Serialize;

/// A term, and the standard error with which it will be known.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct PlannedTerm {
    /// The joint.
    pub joint: String,
    /// Which.
    pub term: JointUnknown,
    /// Its standard error.
    pub standard_error: f64,
    /// Its unit.
    pub unit: &'static str,
}

/// The answer of `congruent plan`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct PlanReport {
    /// Path of the description.
    pub file: String,
    /// Name of the robot.
    pub robot: String,
    /// How long the motion takes, s.
    pub duration_s: f64,
    /// Motions that were tried.
    pub tried: usize,
    /// Smallest distance of links from each other and from obstacles in the motion, m; null without pairs.
    pub nearest_m: Option<f64>,
    /// Pairs of links that are nearer than the clearance wherever the robot is: they do not count.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub always_near: Vec<String>,
    /// Joints without a limit of velocity.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub without_velocity_limit: Vec<String>,
    /// Largest acceleration that a joint without a limit of it has, rad/s^2 or m/s^2.
    pub assumed_acceleration: f64,
    /// The noise of efforts that the standard errors are for, as part of the effort limit of each joint.
    pub effort_noise: f64,
    /// What it will show of the joints.
    pub terms: Vec<PlannedTerm>,
    /// Standard error of the mass of a payload, kg.
    pub payload_mass_error_kg: Option<f64>,
    /// Combinations of inertial parameters of which it shows more than is known.
    pub known_combinations: usize,
    /// Inertial parameters that are free.
    pub free_inertial_parameters: usize,
    /// The files that were written: positions over time, and a scenario that runs them.
    pub written: Vec<String>,
}
