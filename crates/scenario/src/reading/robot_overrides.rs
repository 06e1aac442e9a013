//! Which overrides are of the scenario, and which of its robot.

use std::ops::Range;

use congruent_input::{Diagnostic, Override};
use toml::{Spanned, de::DeTable};

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

/// Refuses two overrides of one value, as by the number and by the kind of an entry, or of a list and of its entry: which of them is
/// meant is not known.
pub(super) fn distinct_places(
    overrides: &[Override],
    document: &Spanned<DeTable<'_>>,
) -> Result<(), Diagnostic> {
    let mut known: Vec<(Range<usize>, &Override)> = Vec::new();
    for change in of_scenario(overrides) {
        // A key that is not in the file yet has no place.
        let Ok(Some(place)) = change.find(document) else { continue };
        let place = place.span();
        let is_shared = |other: &Range<usize>| other.start < place.end && place.start < other.end;
        let is_meant =
            |(other, before): &&(Range<usize>, &Override)| is_shared(other) && before.excludes(change);
        if let Some((_, before)) = known.iter().find(is_meant) {
            return Err(change.refused(&format!("the same value is set by {before}")));
        }
        known.push((place, change));
    }
    Ok(())
}
