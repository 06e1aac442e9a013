//! The inputs of planning a motion.

use congruent_description::{Diagnostic, RobotDescription, RobotQ};

use crate::scenario::FilePlace;

/// The robot, the start of the motion, and its place in the scenario file.
pub(super) struct Planning<'a> {
    pub(super) description: &'a RobotDescription,
    /// The end of the previous motion; after a servo, whose end is not known, the last configuration that is.
    pub(super) from: &'a RobotQ,
    pub(super) place: FilePlace<'a>,
    pub(super) warnings: &'a mut Vec<Diagnostic>,
}
