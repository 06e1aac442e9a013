//! Which findings say what a robot cannot do from its start, and not that the scenario is wrong.

use congruent_input::{Code, Diagnostic};
use congruent_motion::codes::scenario as motion;

use crate::codes::scenario;

/// The codes of what follows from start, targets and obstacles: with other values of these the same scenario runs.
const OF_THE_RUN: [&Code; 14] = [
    scenario::OBSTACLE_OVERLAP,
    scenario::START_LIMIT,
    motion::ARC_SPEED,
    motion::ORIENTATION,
    motion::OUT_OF_REACH,
    motion::OVER_LIMIT,
    motion::PATH_LIMIT,
    motion::PATH_REACH,
    motion::PATH_SINGULAR,
    motion::PATH_SPEED,
    motion::PLAYBACK_JUMP,
    motion::PLAYBACK_RANGE,
    motion::PLAYBACK_START,
    motion::TARGET_LIMIT,
];

/// Whether a finding says what the robot cannot do from its start, as reach a target.
pub fn is_of_the_run(finding: &Diagnostic) -> bool {
    OF_THE_RUN.contains(&finding.code)
}
