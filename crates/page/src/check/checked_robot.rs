//! What a page of a check shows of one robot.

use congruent_agreement::compare::{CheckReport, DifferencesAt};
use congruent_description::RobotDescription;
use congruent_dynamics_agreement::DynamicsReport;
use congruent_input::Finding;

/// The report on one robot, with the descriptions and dynamics that its page also shows.
#[derive(Debug, Clone)]
pub struct CheckedRobot<'a> {
    /// The answer in capitals, as the command prints it.
    pub answer: String,
    /// What follows the answer, with the punctuation between the two.
    pub details: String,
    /// What decides whether poses agree, if that is not the tolerance of the report alone.
    pub judged_by: Option<String>,
    /// Warnings about the descriptions, and the worst findings of lint.
    pub findings: Vec<Finding>,
    /// The robot as it was read, whose URDF the pictures draw.
    pub description: &'a RobotDescription,
    /// The report on its geometry.
    pub geometry: &'a CheckReport,
    /// The differences at requested configurations.
    pub at_configurations: Option<&'a DifferencesAt>,
    /// The other description that it was compared with.
    pub other: Option<&'a RobotDescription>,
    /// The comparisons of dynamics, as the report has them: `dynamics`, then `other_dynamics`.
    pub dynamics: Vec<&'a DynamicsReport>,
    /// What was not compared, in sentences.
    pub not_compared: Vec<String>,
}
