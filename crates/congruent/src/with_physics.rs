//! Questions about a robot that need the physics beside the analytical sources.

use congruent_analysis::dynamics::{DynamicsOptions, DynamicsReport, DynamicsSource, dynamics, robot_of};
use congruent_analysis::forward::{ForwardError, ForwardReport, Source, forward_by_table};
use congruent_description::{Diagnostic, JointState, RobotDescription, RobotQ, Use};
use congruent_dynamics::{JointDynamics, TreeDynamics};
use congruent_kinematics::{LinkPoses, ScrewTree, UrdfTree};
use congruent_twin::source::{SimulatedDynamics, SimulatedPoses};

/// Poses of all links at each configuration, by a chosen source.
///
/// # Errors
/// What is wrong with the robot or with the configurations, if the source does not exist or rejects them.
pub fn forward(
    description: &RobotDescription,
    source: Source,
    configurations: &[RobotQ],
) -> Result<ForwardReport, Vec<Diagnostic>> {
    let robot = &description.robot;
    let mut link_poses: Box<dyn LinkPoses> = match source {
        Source::Dh => return forward_by_table(description, configurations).map_err(refused),
        Source::Urdf => Box::new(UrdfTree::new(robot)),
        Source::Poe => Box::new(ScrewTree::new(robot)),
        Source::Simulation => Box::new(simulated_poses(description)?),
    };
    congruent_analysis::forward::forward(description, (source, &mut *link_poses), configurations)
        .map_err(refused)
}

fn refused(error: ForwardError) -> Vec<Diagnostic> {
    vec![error.into()]
}

/// The physics of a robot, or the findings for which it cannot be built.
pub(crate) fn simulated_poses(description: &RobotDescription) -> Result<SimulatedPoses, Vec<Diagnostic>> {
    description.for_use(Use::Physics)?;
    SimulatedPoses::new(&description.robot)
        .map_err(|error| vec![Diagnostic::error("simulation::robot", error.to_string())])
}

/// Torques and accelerations at each state, by the equations of motion or by the physics.
///
/// # Errors
/// The findings for which the robot has no dynamics, or what a source says that refuses a state; a payload without
/// mass.
pub fn joint_dynamics(
    description: &RobotDescription,
    source: DynamicsSource,
    options: &DynamicsOptions,
    states: &[JointState],
) -> Result<DynamicsReport, Vec<Diagnostic>> {
    description.for_use(Use::Physics)?;
    let robot = robot_of(description, options)?;
    let refused =
        |error: &dyn std::error::Error| vec![Diagnostic::error("dynamics::source", error.to_string())];
    let mut by: Box<dyn JointDynamics> = match source {
        DynamicsSource::Model => Box::new(TreeDynamics::new(&robot)),
        DynamicsSource::Simulation => {
            Box::new(SimulatedDynamics::new(&robot).map_err(|error| refused(&error))?)
        }
    };
    dynamics((description, &robot), options, (source, &mut *by), states).map_err(|error| refused(&error))
}
