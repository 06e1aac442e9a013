//! The comparison that an explanation by joints is of.

use congruent_description::{LinkIndex, RobotQ, Tolerance};

/// Where two descriptions are compared, and what counts as agreement.
#[derive(Debug, Clone, Copy)]
pub struct ComparedAt<'a> {
    /// Where poses are compared.
    pub configurations: &'a [RobotQ],
    /// By how much poses may differ.
    pub tolerance: &'a Tolerance,
    /// Whether what rounding of the written numbers explains is no difference: not of a revision, whose changes are asked for.
    pub digits_count: bool,
    /// First link of the chain.
    pub base: LinkIndex,
    /// Its last link.
    pub tip: LinkIndex,
}
