//! Questions about a robot that need the physics beside the analytical sources.

use congruent_agreement::compare::{CheckError, CheckOptions, CheckReport};
use congruent_analysis::forward::{ForwardError, ForwardReport, Source, forward_by_table};
use congruent_description::{RobotDescription, RobotQ};
use congruent_kinematics::{LinkPoses, LinkPosesError, ScrewTree, UrdfTree};
use congruent_twin::source::SimulatedPoses;

/// Compares table, URDF chain, screws and the physics twin of a robot.
///
/// # Errors
/// [`CheckError`] if a source rejects the robot.
pub fn check(description: &RobotDescription, options: &CheckOptions) -> Result<CheckReport, CheckError> {
    let mut physics = SimulatedPoses::new(&description.robot).map_err(LinkPosesError::source)?;
    congruent_agreement::compare::check(description, &mut physics, options)
}

/// Poses of all links at each configuration, by a chosen source.
///
/// # Errors
/// [`ForwardError`] if the source does not exist or rejects the robot.
pub fn forward(
    description: &RobotDescription,
    source: Source,
    configurations: &[RobotQ],
) -> Result<ForwardReport, ForwardError> {
    let robot = &description.robot;
    let mut link_poses: Box<dyn LinkPoses> = match source {
        Source::Dh => return forward_by_table(description, configurations),
        Source::Urdf => Box::new(UrdfTree::new(robot)),
        Source::Poe => Box::new(ScrewTree::new(robot)),
        Source::Simulation => Box::new(SimulatedPoses::new(robot).map_err(LinkPosesError::source)?),
    };
    congruent_analysis::forward::forward(description, (source, &mut *link_poses), configurations)
}
