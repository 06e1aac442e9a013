//! The five notations of an orientation, of which an element has at most one.

use congruent_input::Diagnostics;

use crate::{codes, document::MjElement};

/// The attributes that give an orientation; an element has at most one of them.
pub(crate) const ORIENTATIONS: [&str; 5] = ["quat", "axisangle", "euler", "xyaxes", "zaxis"];

/// Refuses a second orientation in one element.
pub(super) fn one_orientation(element: &MjElement, diagnostics: &mut Diagnostics) {
    let given: Vec<&str> = ORIENTATIONS.into_iter().filter(|key| element.text(key).is_some()).collect();
    if let [first, second, ..] = given[..] {
        let message = format!("{} has two orientations: {first} and {second}", element.label());
        let help = "keep one of quat, axisangle, euler, xyaxes and zaxis";
        diagnostics.push(element.fault_at(second, codes::mjcf::ORIENTATION, message).with_help(help));
    }
}
