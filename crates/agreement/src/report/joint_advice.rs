//! The lines to write for parts of joints.

use congruent_description::{ParameterPlaces, UrdfPlaces};
use congruent_input::{ChangedLines, TextEdit};

use super::fault_message::FaultMessage;
use crate::diagnosis::thresholds::SAME_UNIT_RATIO;

/// An attribute of a part of a joint: its name, as the file writes it, and as it is expected.
pub(super) struct JointAttribute {
    pub(super) name: &'static str,
    pub(super) found: String,
    pub(super) expected: String,
}

impl JointAttribute {
    /// The end of the sentence if the found numbers are the expected ones in another unit.
    pub(super) fn other_unit(&self) -> Option<&'static str> {
        let (factor, words) = match self.name {
            "rpy" => (1_f64.to_degrees(), ": the rpy is in degrees"),
            _ => (1e3, ": the xyz is in millimetres"),
        };
        let numbers = |text: &str| -> Vec<f64> {
            text.split_whitespace().map(|word| word.parse().unwrap_or(f64::NAN)).collect()
        };
        let (found, expected) = (numbers(&self.found), numbers(&self.expected));
        let is_scaled = |(found, expected): (&f64, &f64)| {
            (found - factor * expected).abs() <= SAME_UNIT_RATIO * found.abs()
        };
        found.iter().zip(&expected).all(is_scaled).then_some(words)
    }
}

/// The edits that give a part of a joint of a URDF these attributes.
pub(super) fn edits_of(
    places: &UrdfPlaces,
    joint: &str,
    part: &str,
    attributes: &[JointAttribute],
) -> Vec<TextEdit> {
    let new: Vec<(&'static str, String)> =
        attributes.iter().map(|of| (of.name, of.expected.clone())).collect();
    places.set_joint_part(joint, part, &new)
}

/// Replaces the suggestions in words by the lines of the file with the edits of each. A line that several of them change is written
/// once, with all of their edits: written one after the other, each would undo those before it.
pub(super) fn advise_together(
    messages: &mut [FaultMessage],
    edits: &[Vec<TextEdit>],
    places: &dyn ParameterPlaces,
) {
    let together = places.changed_lines(&edits.concat());
    let mut written: Vec<&ChangedLines> = Vec::new();
    for (message, edits) in messages.iter_mut().zip(edits) {
        let own = places.changed_lines(edits);
        let is_own = |of: &&ChangedLines| {
            own.iter().any(|own| own.from_line <= of.to_line && of.from_line <= own.to_line)
        };
        let changes: Vec<&ChangedLines> =
            together.iter().filter(is_own).filter(|of| !written.contains(of)).collect();
        if !own.is_empty() {
            message.advise(changes.iter().copied().cloned().collect(), places.source());
        }
        written.extend(changes);
    }
}
