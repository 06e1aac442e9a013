//! The comparison that an explanation by joints is of.

use congruent_description::{LinkIndex, RobotQ, Tolerance};

/// Where two descriptions are compared, and what counts as agreement.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ComparedAt<'a> {
    pub(crate) configurations: &'a [RobotQ],
    pub(crate) tolerance: &'a Tolerance,
    /// Whether what rounding of the written numbers explains is no difference: not of a revision, whose changes are asked for.
    pub(crate) digits_count: bool,
    /// First and last link of the chain.
    pub(crate) base: LinkIndex,
    pub(crate) tip: LinkIndex,
}
