//! When to stop dividing, and which bounds are final.

/// Telescoped bounds up to here are final. Unit: m and rad; kind: rounding; a chain identified from a
/// table and one identified from a URDF of the same robot telescoping to some 1e-14.
pub(super) const ROUNDING_LEVEL: f64 = 1e-12;

/// When to stop dividing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Budget {
    /// The bracket is narrow enough when `certified <= attained (1 + relative_gap)`.
    pub relative_gap: f64,
    /// Most corners that are evaluated for each of the two brackets, some 5 ns each; a box counts for
    /// some hundred more than it has.
    pub corners: u64,
}

impl Default for Budget {
    fn default() -> Self {
        Self { relative_gap: 0.02, corners: 200_000_000 }
    }
}
