//! The motions of a scenario on its robot.

use congruent_description::{RobotDescription, RobotQ};
use congruent_input::{Diagnostic, Findings};
use congruent_motion::{MotionInput, Trajectory, motion_limits};
use congruent_scenario::Scenario;

use super::written_at::WrittenAt;

/// The motions, planned one after another.
pub(super) fn trajectory(
    scenario: &Scenario,
    WrittenAt { place, folder, known, .. }: WrittenAt<'_>,
    description: &RobotDescription,
    start: &RobotQ,
    warnings: &mut Vec<Diagnostic>,
) -> Result<Trajectory, Findings> {
    // A planner knows its own robot, whatever the simulated one is.
    let description = known.unwrap_or(description);
    let limits = motion_limits::build(&scenario.limits, place.key("limits"), description)?;
    let places = place.key("motion");
    let input = MotionInput { motions: &scenario.motion, places, limits: &limits, folder };
    Trajectory::new(input, description, start, warnings)
}

/// The duration of the motions as the scenario gives it; 1 s for each motion without one.
pub(super) fn written_s(scenario: &Scenario) -> f64 {
    scenario.motion.iter().map(|motion| motion.duration_s().unwrap_or(1.0)).sum()
}
