//! Tolerances that allow any pose: a check with one of these would pass whatever happens.

use congruent_description::{Diagnostic, Severity, ToleranceScale};

use crate::scenario::{Check, FilePlace, UnitKeys};

/// What is wrong with the tolerances of a check: errors, and warnings.
pub(super) fn tolerances(
    check: &Check,
    place: FilePlace<'_>,
    scale: ToleranceScale,
) -> (Vec<Diagnostic>, Vec<Diagnostic>) {
    let examined = check.unit_keys().into_iter().filter(|keys| is_tolerance(check, keys));
    examined
        .filter_map(|keys| keys.examine_tolerance(place, scale))
        .partition(|found| found.severity == Severity::Error)
}

/// Whether these keys say how far from each other two things may be that should be at one place.
fn is_tolerance(check: &Check, keys: &UnitKeys) -> bool {
    match check {
        Check::Agreement(_)
        | Check::Contact(_)
        | Check::CycleTime(_)
        | Check::Goal(_)
        | Check::Tracking(_) => true,
        // The others of these keys are margins.
        Check::Limits(_) => keys.keys[0].starts_with("tolerance"),
        // A distance that is kept, velocities, or no keys in two units.
        Check::Clearance(_)
        | Check::Dynamics(_)
        | Check::Invariants(_)
        | Check::Power(_)
        | Check::Twist(_)
        | Check::Zone(_) => false,
    }
}
