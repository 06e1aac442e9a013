//! The configuration at the start of a run.

use congruent_description::{Robot, RobotQ};
use congruent_input::{Diagnostic, Findings, display::limit_number};
use congruent_kinematics::move_inside_limits;
use congruent_motion::JointTargets;
use congruent_scenario::{FilePlace, Scenario, StartSettings};

use crate::codes;

/// The start as it is written; joints that are not named are at 0.
pub(super) fn start(
    settings: &StartSettings,
    place: FilePlace<'_>,
    robot: &Robot,
) -> Result<RobotQ, Findings> {
    let targets = JointTargets::from(settings).resolve(robot, place)?;
    let mut q = RobotQ::zeros(robot.dof());
    let mut errors = Vec::new();
    for target in targets {
        if let Some(message) = target.beyond_limits(robot, "start") {
            let error = Diagnostic::error(codes::scenario::START_LIMIT, message);
            errors.push(congruent_scenario::mark(error, target.span.clone()));
        }
        target.put(robot, &mut q);
    }
    if errors.is_empty() { Ok(q) } else { Err(errors.into()) }
}

/// The start that is written, or zero, inside the limits of the joints.
pub(super) fn inside_limits(
    written: Option<RobotQ>,
    scenario: &Scenario,
    robot: &Robot,
    warnings: &mut Vec<Diagnostic>,
) -> RobotQ {
    let mut start = written.unwrap_or_else(|| RobotQ::zeros(robot.dof()));
    // Beside a log it is where joints stay that the log does not have.
    if scenario.source.is_none() {
        warnings.extend(start_warnings(&start, robot));
    }
    move_inside_limits(&mut start, robot);
    start
}

/// A joint that is not named starts at 0, or at its limit nearest to 0, with a warning.
fn start_warnings<'a>(start: &'a RobotQ, robot: &'a Robot) -> impl Iterator<Item = Diagnostic> + 'a {
    robot.movable_joints().iter().zip(start).filter_map(|(&joint, &q)| {
        let joint = robot.joint(joint);
        // A follower has no start of its own: its master determines where it is.
        let (lower, upper) = joint.position_range().filter(|_| joint.mimic.is_none())?;
        (!(lower..=upper).contains(&q)).then(|| {
            let [start, lower, upper] = [q.clamp(lower, upper), lower, upper].map(limit_number);
            let message = format!(
                "joint \"{}\" has no start position, and 0 is outside its range [{lower}, {upper}]: it starts at {start} {}",
                joint.name,
                joint.kind.unit()
            );
            Diagnostic::warning(codes::scenario::START_DEFAULT, message)
                .one_of(
                    "joints have no start position, and 0 is outside their ranges: they start at a limit",
                    &joint.name,
                )
                .with_help("give start positions under [start]")
        })
    })
}
