//! Overrides that replace one value, by different keys.

use std::ops::Range;

use toml::{Spanned, de::DeTable};

use super::overrides::Override;
use crate::Diagnostic;

/// Refuses two overrides of one value of a document, as by the number and by the kind of an entry, or of a list and of its entry: which
/// of them is meant is not known.
///
/// # Errors
/// The second of the two, which names the first.
pub fn distinct_places<'a>(
    overrides: impl IntoIterator<Item = &'a Override>,
    document: &Spanned<DeTable<'_>>,
) -> Result<(), Diagnostic> {
    let mut known: Vec<(Range<usize>, &Override)> = Vec::new();
    for change in overrides {
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
