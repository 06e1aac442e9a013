//! Which words are one value: a number with its unit is not broken over two lines.

/// Units behind a number, as `display` of `input` writes them.
const UNITS: [&str; 24] = [
    "mm", "m", "um", "nm", "pm", "deg", "rad", "mrad", "urad", "nrad", "prad", "N", "kg", "g", "s", "ms",
    "W", "J", "%", "deg/s", "rad/s", "mm/s", "m/s", "m^2",
];

/// Whether a word is the unit of the one before it, or the rest of its unit: `100 N m`.
pub(super) fn is_unit_of(before: &str, word: &str) -> bool {
    let unit = word.trim_end_matches([',', ';', '.', ':', ')']);
    let is_number = before.trim_start_matches(['(', '<', '[']).parse::<f64>().is_ok();
    let is_part = (before == "N" || before == "kg") && ["m", "m^2", "s/m"].contains(&unit);
    is_part || (is_number && UNITS.contains(&unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_follows_a_number_or_a_part_of_a_unit() {
        assert!(is_unit_of("100", "N") && is_unit_of("N", "m;") && is_unit_of("(0.5", "mm)"));
        assert!(!is_unit_of("joint_1", "m") && !is_unit_of("3", "joints"));
    }
}
