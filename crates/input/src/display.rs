//! Formats numbers for people: decides unit and digits for every command, report and recording. Three significant digits,
//! all digits before the decimal point, no trailing zeros.

use std::f64::consts::PI;

/// A unit, and the smallest value (in SI, after rounding to three digits) that is printed in it.
struct Step {
    from: f64,
    unit: &'static str,
    units_in_si: f64,
}

const fn step(from: f64, unit: &'static str, units_in_si: f64) -> Step {
    Step { from, unit, units_in_si }
}

/// Below the last step only rounding is left, whose size means nothing to people.
const LENGTHS: [Step; 5] = [
    step(10.0, "m", 1.0),
    step(1e-4, "mm", 1e3),
    step(1e-6, "um", 1e6),
    step(1e-9, "nm", 1e9),
    step(1e-12, "pm", 1e12),
];
/// Below this a decimal fraction is mostly zeros.
const SMALLEST_DECIMAL: f64 = 1e-4;
const ANGLES: [Step; 4] = [
    step(1e-3 * PI / 180.0, "deg", 180.0 / PI),
    step(1e-6, "urad", 1e6),
    step(1e-9, "nrad", 1e9),
    step(1e-12, "prad", 1e12),
];

/// Formats a length in m, in the unit that fits its size.
///
/// # Examples
/// ```
/// use congruent_input::display::length;
/// let lengths = [2.687, 0.0338, 1e-3, 2.5e-5, 1e-9, 2.5e-12, 7.9e-16, 0.0].map(length);
/// assert_eq!(lengths, ["2687 mm", "33.8 mm", "1 mm", "25 um", "1 nm", "2.5 pm", "<1 pm", "0 mm"]);
/// ```
pub fn length(metres: f64) -> String {
    scaled(metres, &LENGTHS, "m", "mm", "")
}

/// Formats an angle in rad, in the unit that fits its size.
///
/// # Examples
/// ```
/// use congruent_input::display::angle;
/// let angles = [1.5707963267948966, -0.0021, 1e-6, 1e-12].map(angle);
/// assert_eq!(angles, ["90 deg", "-0.12 deg", "1 urad", "1 prad"]);
/// ```
pub fn angle(radians: f64) -> String {
    scaled(radians, &ANGLES, "rad", "deg", "")
}

/// A length with an angle beside it, as of a pose; without the angle if it is rounding.
///
/// # Examples
/// ```
/// use congruent_input::display::length_and_angle;
/// assert_eq!(length_and_angle(0.005, 0.01), "5 mm and 0.573 deg");
/// assert_eq!(length_and_angle(0.005, 1e-16), "5 mm");
/// assert_eq!(length_and_angle(0.0, 0.3), "17.2 deg");
/// ```
pub fn length_and_angle(metres: f64, radians: f64) -> String {
    /// The smallest angle that is printed with a number.
    const SMALLEST_RAD: f64 = 0.9995e-12;
    match (metres > 0.0, radians >= SMALLEST_RAD) {
        (false, true) => angle(radians),
        (true, true) => format!("{} and {}", length(metres), angle(radians)),
        (_, false) => length(metres),
    }
}

/// A value in an SI unit, as reports name it: `m`, `rad`, `m/s`, `rad/s`, `N m`, or nothing for a plain number.
///
/// # Examples
/// ```
/// use congruent_input::display::quantity;
/// assert_eq!(quantity(1.0663, "rad"), "61.1 deg");
/// assert_eq!(quantity(0.25, "m/s"), "250 mm/s");
/// assert_eq!(quantity(std::f64::consts::PI, "rad/s^2"), "180 deg/s^2");
/// assert_eq!(quantity(12.3456, "N m"), "12.3 N m");
/// assert_eq!(quantity(0.0, ""), "0");
/// ```
pub fn quantity(value: f64, unit: &str) -> String {
    match unit {
        "m" => length(value),
        "rad" => angle(value),
        "m/s" => scaled(value, &LENGTHS, "m", "mm", "/s"),
        "rad/s" => scaled(value, &ANGLES, "rad", "deg", "/s"),
        "rad/s^2" => scaled(value, &ANGLES, "rad", "deg", "/s^2"),
        "rad/s^3" => scaled(value, &ANGLES, "rad", "deg", "/s^3"),
        _ => format!("{} {unit}", number(value)).trim_end().to_owned(),
    }
}

/// A value in its SI unit with all its digits, to be copied into a file.
///
/// # Examples
/// ```
/// use congruent_input::display::quantity_in_full;
/// assert_eq!(quantity_in_full(3.000_001, "kg"), "3.000001 kg");
/// ```
pub fn quantity_in_full(value: f64, unit: &str) -> String {
    format!("{value} {unit}").trim_end().to_owned()
}

/// A value in its SI unit with so many significant digits, for two that [`quantity`] prints alike.
///
/// # Examples
/// ```
/// use congruent_input::display::quantity_with_digits;
/// assert_eq!(quantity_with_digits(3.000_001_000_000_000_4, "kg", 8), "3.000001 kg");
/// assert_eq!(quantity_with_digits(5.551e-17, "kg", 2), "5.6e-17 kg");
/// ```
pub fn quantity_with_digits(value: f64, unit: &str, digits: usize) -> String {
    /// From here on the digits end before the decimal point. Kind: choice.
    const LARGEST_IN_FULL: f64 = 1e9;
    let decimals = digits.saturating_sub(1);
    let rounded: f64 = format!("{value:.decimals$e}").parse().unwrap_or(value);
    let text = match rounded.abs() {
        0.0 => "0".to_owned(),
        size if (SMALLEST_DECIMAL..LARGEST_IN_FULL).contains(&size) => rounded.to_string(),
        _ => format!("{rounded:e}"),
    };
    format!("{text} {unit}").trim_end().to_owned()
}

/// Two values that are compared, in the same unit: with three digits, or with as many more as it takes to see which one is
/// larger.
///
/// # Examples
/// ```
/// use congruent_input::display::compared_quantities;
/// let speeds = [250.02_f64, 250.0].map(f64::to_radians);
/// assert_eq!(compared_quantities(speeds, "rad/s"), ["250.02 deg/s", "250 deg/s"]);
/// assert_eq!(compared_quantities([0.01, 0.02], "m"), ["10 mm", "20 mm"]);
/// ```
pub fn compared_quantities(values: [f64; 2], unit: &str) -> [String; 2] {
    /// Beyond these only rounding is left.
    const MOST_DIGITS: usize = 9;
    let texts = values.map(|value| quantity(value, unit));
    if texts[0] != texts[1] || values[0].total_cmp(&values[1]).is_eq() {
        return texts;
    }
    // In the unit of the text, which is the same for both; its factor is the one that its three digits show.
    let (size, shown) = texts[0].split_once(' ').unwrap_or((&texts[0], ""));
    let per_si = size.parse::<f64>().map_or(f64::NAN, |size| size / values[0]);
    let is_near = |factor: &&f64| (per_si / **factor - 1.0).abs() < 0.1;
    let Some(factor) = [1.0, 180.0 / PI, 1e3, 1e6, 1e9, 1e12].iter().find(is_near) else { return texts };
    let rounded = |digits| values.map(|value| quantity_with_digits(value * factor, shown, digits));
    let distinct = (4..=MOST_DIGITS).map(rounded).find(|texts| texts[0] != texts[1]);
    distinct.unwrap_or(texts)
}

/// A position or a limit of a joint in rad or m, with digits enough to see on which side of the limit it is.
pub fn limit_number(value: f64) -> String {
    quantity_with_digits(value, "", 7)
}

/// Formats a number without unit.
///
/// # Examples
/// ```
/// use congruent_input::display::number;
/// let numbers = [0.46184, 2687.4, 1.0, 3.21e-16].map(number);
/// assert_eq!(numbers, ["0.462", "2687", "1", "3.2e-16"]);
/// ```
pub fn number(value: f64) -> String {
    /// From here on it is mostly digits.
    const LARGEST_DECIMAL: f64 = 1e7;
    match value.abs() {
        0.0 => "0".to_owned(),
        size if (SMALLEST_DECIMAL..LARGEST_DECIMAL).contains(&size) => significant(value),
        _ if !value.is_finite() => value.to_string(),
        _ => format!("{value:.1e}"),
    }
}

/// A value of a column, whose heading has the unit: mm or deg with two decimals, a plain number with four. All
/// values of a column have the same decimals, so that their points align.
///
/// # Examples
/// ```
/// use congruent_input::display::in_column;
/// assert_eq!([0.81725, -1e-9].map(|metres| in_column(metres, "m")), ["817.25", "0.00"]);
/// assert_eq!(in_column(-std::f64::consts::FRAC_PI_2, "rad"), "-90.00");
/// assert_eq!(in_column(-0.70710678, ""), "-0.7071");
/// ```
pub fn in_column(value: f64, unit: &str) -> String {
    let text = match unit {
        "m" => format!("{:.2}", value * 1e3),
        "rad" => format!("{:.2}", value.to_degrees()),
        _ => format!("{value:.4}"),
    };
    match text.strip_prefix('-') {
        // Rounding has no sign.
        Some(size) if size.bytes().all(|byte| matches!(byte, b'0' | b'.')) => size.to_owned(),
        _ => text,
    }
}

/// The position of a joint, by the unit of its coordinate: two decimals as in a column, without zeros at the end.
///
/// # Examples
/// ```
/// use congruent_input::display::position;
/// assert_eq!(position(1.5707963267948966, "rad"), "90 deg");
/// assert_eq!([0.12345, -1e-9].map(|metres| position(metres, "m")), ["123.45 mm", "0 mm"]);
/// ```
pub fn position(value: f64, unit: &str) -> String {
    let text = in_column(value, unit);
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    let unit = match unit {
        "m" => "mm",
        "rad" => "deg",
        other => other,
    };
    format!("{text} {unit}").trim_end().to_owned()
}

fn scaled(value: f64, steps: &[Step], si: &str, unit_of_zero: &str, per: &str) -> String {
    /// What rounds up to a step is printed in its unit: 0.9999 nm is 1 nm.
    const ROUNDED_UP: f64 = 0.9995;
    if value == 0.0 {
        return format!("0 {unit_of_zero}{per}");
    }
    match steps.iter().find(|step| value.abs() >= step.from * ROUNDED_UP) {
        Some(step) if value.is_finite() => {
            format!("{} {}{per}", number(value * step.units_in_si), step.unit)
        }
        _ if value.is_finite() => {
            let smallest = steps.last().map_or(si, |step| step.unit);
            format!("<1 {smallest}{per}")
        }
        _ => format!("{value} {si}{per}"),
    }
}

/// Three significant digits or all before the decimal point.
fn significant(value: f64) -> String {
    let mut decimals = 2;
    let mut bound = 1.0;
    // Powers of ten are exact enough here, and a logarithm is not needed.
    while decimals > 0 && value.abs() >= bound * 10.0 {
        (decimals, bound) = (decimals - 1, bound * 10.0);
    }
    let mut bound = 1.0;
    while value.abs() < bound {
        (decimals, bound) = (decimals + 1, bound / 10.0);
    }
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// A number of things: `1 link`, `2 links`.
pub fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// Words as a list in a sentence.
///
/// # Examples
/// ```
/// use congruent_input::display::listed;
/// assert_eq!(listed(&["table", "URDF", "physics"]), "table, URDF and physics");
/// assert_eq!(listed(&["table"]), "table");
/// ```
pub fn listed(words: &[&str]) -> String {
    match words {
        [others @ .., last] if !others.is_empty() => format!("{} and {last}", others.join(", ")),
        _ => words.concat(),
    }
}

/// The first of many words, and how many more there are.
///
/// # Examples
/// ```
/// use congruent_input::display::first_of;
/// assert_eq!(first_of(&["a", "b", "c"], 3), "a, b, c");
/// assert_eq!(first_of(&["a", "b", "c"], 1), "a and 2 more");
/// ```
pub fn first_of(words: &[impl AsRef<str>], most: usize) -> String {
    let shown: Vec<&str> = words.iter().take(most).map(AsRef::as_ref).collect();
    let shown = shown.join(", ");
    match words.len().saturating_sub(most) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_at_the_edges() {
        let shown = [9.996, 99.96, 999.6, 0.099_96, 0.12, -33.84, 100.0].map(significant);
        assert_eq!(shown, ["10", "100", "1000", "0.1", "0.12", "-33.8", "100"]);
    }

    #[test]
    fn what_rounds_up_to_a_unit_is_printed_in_it() {
        let lengths = [1e-9 - 1e-15, 0.9996e-6, 0.999_96e-4, 9.9996, 0.999e-9].map(length);
        assert_eq!(lengths, ["1 nm", "1 um", "0.1 mm", "10 m", "999 pm"]);
    }

    #[test]
    fn values_that_are_not_numbers_are_shown_as_such() {
        assert_eq!([length(f64::NAN), angle(f64::INFINITY)], ["NaN m", "inf rad"]);
        assert_eq!(number(f64::NAN), "NaN");
    }

    #[test]
    fn large_values_keep_their_size() {
        assert_eq!([length(53_087.0), length(1e12), number(1.234e9)], ["53087 m", "1.0e12 m", "1.2e9"]);
    }
}
