//! Values as text for people: few digits and a unit that follows the magnitude.

use congruent_kinematics::PoseError;
use congruent_twin::verdict::Measure;

/// Lengths below this one are written as powers of ten.
const SMALLEST_DECIMAL_M: f64 = 1e-6;

/// A length with about four digits, in m, mm or um.
pub(crate) fn length(value_m: f64) -> String {
    match value_m.abs() {
        size if size >= 1.0 => format!("{value_m:.3} m"),
        size if size >= 1e-3 => format!("{:.2} mm", value_m * 1e3),
        size if size >= SMALLEST_DECIMAL_M => format!("{:.2} um", value_m * 1e6),
        _ => format!("{value_m:.1e} m"),
    }
}

/// An angle with four decimals.
pub(crate) fn angle(value_rad: f64) -> String {
    if value_rad.abs() >= 1e-3 { format!("{value_rad:.4} rad") } else { format!("{value_rad:.1e} rad") }
}

/// A value in its unit.
pub(crate) fn quantity(value: f64, unit: &str) -> String {
    match unit {
        _ if value == 0.0 => format!("0 {unit}").trim_end().to_owned(),
        "m" => length(value),
        "rad" => angle(value),
        _ => format!("{value:.4} {unit}").trim_end().to_owned(),
    }
}

/// A limit in the unit of its scenario key.
pub(crate) fn limit(measure: &Measure) -> String {
    let (sign, value) = (measure.bound.words(), measure.limit);
    if value == 0.0 || (1e-3..1e4).contains(&value.abs()) {
        format!("{sign} {value} {}", measure.unit)
    } else {
        format!("{sign} {value:e} {}", measure.unit)
    }
}

/// A link with its position error, and its orientation error if that is a milliradian or more.
pub(crate) fn pose_error(link: &str, error: &PoseError) -> String {
    let PoseError { position_m, orientation_rad } = *error;
    if orientation_rad >= 1e-3 {
        format!("{link}: {}, {}", length(position_m), angle(orientation_rad))
    } else {
        format!("{link}: {}", length(position_m))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_follow_the_magnitude() {
        assert_eq!(length(1.2345), "1.234 m");
        assert_eq!(length(0.005), "5.00 mm");
        assert_eq!(length(-0.000_012), "-12.00 um");
        assert_eq!(length(3.21e-16), "3.2e-16 m");
        assert_eq!(quantity(0.0, "m"), "0 m");
        assert_eq!(quantity(0.25, ""), "0.2500");
        let error = PoseError { position_m: 0.005, orientation_rad: 0.0 };
        assert_eq!(pose_error("tool0", &error), "tool0: 5.00 mm");
    }
}
