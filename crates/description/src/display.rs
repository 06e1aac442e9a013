//! Numbers for people: the one place that decides how lengths and angles are printed.

/// Below this, in m or rad, a value is printed in m or rad with an exponent: no hand measures it.
const MEASURABLE: f64 = 1e-6;

/// A length: millimetres if a hand could measure it, otherwise metres with an exponent.
///
/// # Examples
/// ```
/// use congruent_description::display::length;
/// assert_eq!([length(0.0338), length(7.9e-16)], ["33.8000 mm", "7.90e-16 m"]);
/// ```
pub fn length(metres: f64) -> String {
    if metres.abs() >= MEASURABLE { format!("{:.4} mm", metres * 1e3) } else { format!("{metres:.2e} m") }
}

/// An angle: degrees if an eye could see it, otherwise radians with an exponent.
///
/// # Examples
/// ```
/// use congruent_description::display::angle;
/// assert_eq!([angle(0.017_453_292_519_943_295), angle(1e-12)], ["1.00000 deg", "1.00e-12 rad"]);
/// ```
pub fn angle(radians: f64) -> String {
    if radians.abs() >= MEASURABLE {
        format!("{:.5} deg", radians.to_degrees())
    } else {
        format!("{radians:.2e} rad")
    }
}

/// A length with an angle beside it, as of a pose; without the angle if there is none.
///
/// # Examples
/// ```
/// use congruent_description::display::length_and_angle;
/// assert_eq!(length_and_angle(0.005, 0.0), "5.0000 mm");
/// ```
pub fn length_and_angle(metres: f64, radians: f64) -> String {
    if radians > 0.0 { format!("{} and {}", length(metres), angle(radians)) } else { length(metres) }
}
