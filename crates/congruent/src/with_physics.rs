//! Questions about a robot that need the physics beside the analytical sources.

use congruent_analysis::{
    dynamics::{
        DynamicsOptions, DynamicsResult, DynamicsSource, DynamicsStream, JointDynamicsReport, dynamics,
        refused,
    },
    forward::{ForwardReport, PoseStream, Source, forward_by_table},
    largest_value,
};
use congruent_configurations::JointStateList;
use congruent_description::{DrivenCoordinates, Robot, RobotDescription, RobotQ};
use congruent_dynamics::{JointDynamics, TreeDynamics};
use congruent_input::{Capability, Diagnostic, Findings};
use congruent_kinematics::{LinkPoses, ScrewTree, UrdfTree};
use congruent_twin::source::{SimulatedDynamics, SimulatedPoses};

use crate::codes;

/// Poses of all links at each configuration, by a chosen source; each is computed when the iterator reaches it.
///
/// # Errors
/// What is wrong with the robot or with the first configuration, if the source does not exist or rejects them.
pub fn forward<'a>(
    description: &'a RobotDescription,
    source: Source,
    configurations: impl Iterator<Item = RobotQ> + 'a,
) -> Result<ForwardReport<PoseStream<'a>>, Findings> {
    let robot = &description.robot;
    let link_poses: Box<dyn LinkPoses + 'a> = match source {
        Source::Dh => return Ok(forward_by_table(description, configurations)?),
        Source::Urdf => Box::new(UrdfTree::new(robot)),
        Source::Poe => Box::new(ScrewTree::new(robot)),
        Source::Simulation => Box::new(simulated_poses(description)?),
    };
    Ok(congruent_analysis::forward::forward(description, source, link_poses, configurations)?)
}

/// The physics of a robot, or the findings for which it cannot be built.
pub(crate) fn simulated_poses(description: &RobotDescription) -> Result<SimulatedPoses, Findings> {
    description.check_capability(Capability::Physics)?;
    SimulatedPoses::new(&description.robot)
        .map_err(|error| Diagnostic::error(codes::simulation::ROBOT, error.to_string()).into())
}

/// Torques and accelerations at each state, by the equations of motion or by the physics; each is computed when it is asked
/// for. The robot is [`robot_with_options`](congruent_analysis::dynamics::robot_with_options) the description and the options.
///
/// # Errors
/// The findings for which the robot has no dynamics, or what a source says that refuses a state.
pub fn joint_dynamics<'a>(
    description: &RobotDescription,
    robot: &'a Robot,
    options: &DynamicsOptions,
    states: &'a JointStateList,
) -> Result<JointDynamicsReport<DynamicsStream<'a>>, Findings> {
    description.check_capability(Capability::Physics)?;
    let mut by: Box<dyn JointDynamics + 'a> = match options.source {
        DynamicsSource::Model => Box::new(TreeDynamics::new(robot)),
        DynamicsSource::Simulation => {
            Box::new(SimulatedDynamics::new(robot).map_err(|error| refused(&error))?)
        }
    };
    // Nothing is written if there is a state that cannot be answered, so all are tried before the first is.
    let coordinates = DrivenCoordinates::new(robot, options.followers);
    for state in states.iter() {
        match DynamicsResult::at(&state, &mut *by, &coordinates) {
            Ok(result) if result.is_finite() => {}
            // A number that overflows may look like a joint without inertia.
            Ok(_) => return Err(beyond_numbers(description, robot, states).into()),
            Err(error) => {
                return Err(match largest_value(description, robot, states) {
                    (_, value, _) if value > LARGEST_VALUE => beyond_numbers(description, robot, states),
                    _ => refused(&error),
                }
                .into());
            }
        }
    }
    Ok(dynamics(description, robot, options, by, states)?)
}

/// Squares of larger values times lengths and speeds overflow. Kind: range of numbers.
const LARGEST_VALUE: f64 = 1e100;

/// The finding that torques overflow, with the largest value as the likely cause.
fn beyond_numbers(description: &RobotDescription, robot: &Robot, states: &JointStateList) -> Diagnostic {
    let (what, value, span) = largest_value(description, robot, states);
    let message = format!("{what} = {value:e} is too large: the computed torques are not finite");
    let found = Diagnostic::error(codes::dynamics::OVERFLOW, message);
    match (span, description.places.urdf.as_ref()) {
        (Some(span), Some(places)) => found.at(span).in_file(places.source()),
        _ => found,
    }
}
