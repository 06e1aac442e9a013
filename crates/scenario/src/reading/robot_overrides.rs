//! Which overrides are of the scenario, and which of its robot.

use congruent_input::Override;

/// The key of the robot's path, and of its values: `robot.dh.row.3.d_m`.
const ROBOT: &str = "robot";

/// The overrides of values of the scenario file, without those of its robot.
pub(super) fn of_scenario(overrides: &[Override]) -> impl Iterator<Item = &Override> {
    overrides.iter().filter(|change| change.inside(ROBOT).is_none())
}

/// The overrides of values of the robot, as its own files have them: `dh.row.3.d_m` for `robot.dh.row.3.d_m`.
pub fn robot_overrides(overrides: &[Override]) -> Vec<Override> {
    overrides.iter().filter_map(|change| change.inside(ROBOT)).collect()
}
