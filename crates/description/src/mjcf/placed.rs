//! Findings at their places in the files of a model.

use congruent_input::Diagnostic;
use congruent_mjcf::MjPlace;

/// A finding at a place of the model.
pub(super) fn placed(found: Diagnostic, place: &MjPlace) -> Diagnostic {
    found.at(place.span.clone()).in_file(&place.source)
}
