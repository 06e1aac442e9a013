//! Findings at their places in the files of a model.

use congruent_input::Diagnostic;
use congruent_mjcf::MjPlace;

/// A finding at a place of the model, if it has one.
pub(super) fn placed<'a>(found: Diagnostic, place: impl Into<Option<&'a MjPlace>>) -> Diagnostic {
    let Some(place) = place.into() else { return found };
    found.at(place.span.clone()).in_file(&place.source)
}
