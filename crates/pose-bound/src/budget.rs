//! The end of a search: how narrow a bracket must be, how much work it may take, and which bounds need no
//! search.

/// A telescoping bound up to here needs no search. Unit: m and rad; kind: rounding. The chain identified
/// from a table and the one identified from a URDF of the same robot have a telescoping bound of some 1e-14.
pub(super) const ROUNDING_LEVEL: f64 = 1e-12;

/// When a search ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Budget {
    /// The bracket is narrow enough if `certified <= attained (1 + relative_gap)`.
    pub relative_gap: f64,
    /// Most corners that are evaluated for each of the two brackets, some 5 ns each; a box counts some
    /// hundred corners more than it has.
    pub corners: u64,
}

impl Default for Budget {
    fn default() -> Self {
        Self { relative_gap: 0.02, corners: 200_000_000 }
    }
}
