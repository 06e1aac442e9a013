//! The tolerance on the command line: `1mm`, or `1mm,0.1deg`.

use std::str::FromStr;

use congruent::{
    description::{Tolerance, ToleranceScale},
    input::{Diagnostic, Severity, units::Unit},
};

/// A tolerance that replaces the one of the robot file; a part that is not given is not replaced.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct ToleranceArgument {
    position_m: Option<f64>,
    orientation_rad: Option<f64>,
}

impl ToleranceArgument {
    /// The tolerance to check with.
    pub(super) fn replace(self, declared: Tolerance) -> Tolerance {
        Tolerance {
            position_m: self.position_m.unwrap_or(declared.position_m),
            orientation_rad: self.orientation_rad.unwrap_or(declared.orientation_rad),
        }
    }
}

impl ToleranceArgument {
    /// What is wrong with it for a robot of this scale: errors, and warnings.
    pub(super) fn examine(self, scale: ToleranceScale) -> (Vec<Diagnostic>, Vec<Diagnostic>) {
        let parts = [(Unit::Length, self.position_m), (Unit::Angle, self.orientation_rad)];
        let examined =
            parts.into_iter().filter_map(|(unit, value)| scale.examine(unit, "--tolerance", value?));
        examined.partition(|found| found.severity == Severity::Error)
    }
}

impl FromStr for ToleranceArgument {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut tolerance = Self::default();
        for part in text.split(',').map(str::trim) {
            let (unit, value) = quantity(part)?;
            let place = match unit {
                Unit::Length => &mut tolerance.position_m,
                Unit::Angle => &mut tolerance.orientation_rad,
            };
            if place.replace(value).is_some() {
                let what = if matches!(unit, Unit::Length) { "a length" } else { "an angle" };
                return Err(format!("\"{part}\" is {what}, and {what} is already given"));
            }
        }
        Ok(tolerance)
    }
}

/// A number with its unit, in m or rad.
fn quantity(text: &str) -> Result<(Unit, f64), String> {
    let start = text.find(|c: char| c.is_alphabetic() && c != 'e' && c != 'E').unwrap_or(text.len());
    let (number, name) = text.split_at(start);
    let number = number.trim();
    let (unit, in_si): (Unit, fn(f64) -> f64) = match name {
        "m" => (Unit::Length, |value| value),
        "mm" => (Unit::Length, |value| Unit::Length.convert(value)),
        "um" => (Unit::Length, |value| value / 1e6),
        "nm" => (Unit::Length, |value| value / 1e9),
        "rad" => (Unit::Angle, |value| value),
        "mrad" => (Unit::Angle, |value| value / 1e3),
        "urad" => (Unit::Angle, |value| value / 1e6),
        "nrad" => (Unit::Angle, |value| value / 1e9),
        "deg" => (Unit::Angle, |value| Unit::Angle.convert(value)),
        _ => {
            return Err(format!(
                "\"{text}\" is not a number with a unit: m, mm, um, nm, deg, rad, mrad, urad or nrad, as in 1mm,0.1deg"
            ));
        }
    };
    let value = number.parse().map_err(|_| format!("\"{text}\": \"{number}\" is not a number"))?;
    let value = in_si(value);
    if value.is_finite() && value > 0.0 {
        Ok((unit, value))
    } else {
        Err(format!("\"{text}\" must be greater than 0 and finite"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tolerance_is_a_length_or_an_angle_or_both() {
        let declared = Tolerance { position_m: 1.0, orientation_rad: 2.0 };
        for (text, position_m, orientation_rad) in [
            ("1mm", 1e-3, 2.0),
            ("1mm,0.1deg", 1e-3, 0.1_f64.to_radians()),
            ("0.5deg, 20 um", 2e-5, 0.5_f64.to_radians()),
            ("1e-6m,1e-6rad", 1e-6, 1e-6),
            ("5E-3m", 5e-3, 2.0),
            ("3mrad", 1.0, 3e-3),
        ] {
            let found = text.parse::<ToleranceArgument>().unwrap().replace(declared);
            assert_eq!(found, Tolerance { position_m, orientation_rad }, "{text}");
        }
    }

    #[test]
    fn what_is_no_tolerance_is_refused() {
        for (text, message) in [
            ("0mm", "must be greater than 0"),
            ("-1mm", "must be greater than 0"),
            ("1e999mm", "must be greater than 0 and finite"),
            ("1e-400mm", "must be greater than 0"),
            ("nanmm", "is not a number"),
            ("infm", "is not a number"),
            ("1", "is not a number with a unit"),
            ("", "is not a number with a unit"),
            ("1mm,", "is not a number with a unit"),
            ("1mm,2mm", "is a length, and a length is already given"),
            ("1.2.3mm", "is not a number"),
        ] {
            let error = text.parse::<ToleranceArgument>().unwrap_err();
            assert!(error.contains(message), "{text}: {error}");
        }
    }
}
