//! Questions about a robot that need the physics beside the analytical sources.

use congruent_agreement::compare::{CheckError, CheckOptions, CheckReport};
use congruent_analysis::dynamics::{DynamicsOptions, DynamicsReport, DynamicsSource, dynamics, robot_of};
use congruent_analysis::forward::{ForwardError, ForwardReport, Source, forward_by_table};
use congruent_description::{Diagnostic, JointState, RobotDescription, RobotQ};
use congruent_dynamics::{JointDynamics, TreeDynamics};
use congruent_kinematics::{LinkPoses, LinkPosesError, ScrewTree, UrdfTree};
use congruent_twin::source::{SimulatedDynamics, SimulatedPoses};

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

/// Torques and accelerations at each state, by the equations of motion or by the physics.
///
/// # Errors
/// What a source says that refuses the robot or a state; a payload without mass.
pub fn joint_dynamics(
    description: &RobotDescription,
    source: DynamicsSource,
    options: &DynamicsOptions,
    states: &[JointState],
) -> Result<DynamicsReport, Diagnostic> {
    let robot = robot_of(description, options)?;
    let refused = |error: &dyn std::error::Error| Diagnostic::error("dynamics::source", error.to_string());
    let mut by: Box<dyn JointDynamics> = match source {
        DynamicsSource::Model => Box::new(TreeDynamics::new(&robot)),
        DynamicsSource::Simulation => {
            Box::new(SimulatedDynamics::new(&robot).map_err(|error| refused(&error))?)
        }
    };
    dynamics(&robot, options, (source, &mut *by), states).map_err(|error| refused(&error))
}
