//! Begin and end of a fault whose size is known. A residual counts as off only above a threshold for all faults; the size of a
//! fault says how far off each residual should be, so that many small ones together show it before one of them is large.

use super::{
    fit::Window,
    residual::{OffWindow, Residual},
};

/// The window of a fault, extended to all residuals that speak for it. `evidence` of a residual is the part of its squared
/// deviation that the fault explains, in units of the smallest deviation that counts as off; negative if it speaks against it.
pub(super) fn extended(
    window: OffWindow,
    all: &[Residual],
    samples: usize,
    evidence: impl Fn(&Residual) -> f64,
) -> OffWindow {
    let Window { first, end } = window.residuals;
    let before = all[..first].iter().rev().map(&evidence);
    let after = window.usable(all)[end..].iter().map(&evidence);
    let residuals = Window { first: first - extension(before), end: end + extension(after) };
    window.over(residuals, all, samples)
}

/// How many successive residuals have the largest sum of evidence. More of them need a larger sum, not an equal one: while a
/// joint rests, nothing speaks for a fault.
fn extension(evidence: impl Iterator<Item = f64>) -> usize {
    /// Evidence that counts as none: a deviation of a tenth of what counts as off is that of the engine's step.
    const NO_EVIDENCE: f64 = 0.01;
    let (mut sum, mut best, mut count) = (0.0, 0.0, 0);
    for (index, evidence) in evidence.enumerate() {
        sum += evidence;
        if sum > best + NO_EVIDENCE {
            (best, count) = (sum, index + 1);
        }
    }
    count
}

#[cfg(test)]
mod tests {
    use super::extension;

    #[test]
    fn small_residuals_of_one_sign_count_together_and_those_of_rest_do_not() {
        let check = |evidence: &[f64], expected: usize| {
            assert_eq!(extension(evidence.iter().copied()), expected, "{evidence:?}");
        };
        check(&[], 0);
        check(&[0.02, 0.02, 0.02, -0.5, 0.02], 3);
        // Each too small to count, all together not.
        check(&[0.004; 6], 6);
        // A pass through zero of the effort, then more of the fault.
        check(&[0.1, 0.0, -0.01, 0.0, 0.1], 5);
        check(&[1e-9; 1000], 0);
        check(&[-0.1, 0.05, 0.04], 0);
    }
}
