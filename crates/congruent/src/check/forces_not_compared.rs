//! What the reader of an MJCF omits from forces, where two descriptions differ in it.

use std::collections::BTreeSet;

use congruent_description::{MJCF_LOOP, RobotDescription, codes::mjcf};
use congruent_input::Code;

/// What is read and has no part in the torques that are compared.
const LEFT_OUT: [&Code; 5] = [mjcf::SPRING, mjcf::DAMPING, mjcf::GRAVITY, mjcf::MEDIUM, MJCF_LOOP];

/// Springs, damping by powers of the speed, gravity, a medium and closed loops that one of the two has and the other has not, or otherwise, in
/// words.
pub(super) fn forces_not_compared(description: &RobotDescription, other: &RobotDescription) -> Vec<String> {
    let of_mjcf = |of: &RobotDescription| -> BTreeSet<String> {
        let warnings = of.warnings.iter().filter(|of| LEFT_OUT.contains(&of.code));
        warnings.map(|of| of.message.clone()).collect()
    };
    let [own, other] = [description, other].map(of_mjcf);
    own.symmetric_difference(&other).cloned().collect()
}
