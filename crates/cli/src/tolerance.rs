//! A tolerance on the command line: `1mm`, or `1mm,0.1deg`.

use std::str::FromStr;

use congruent::{
    description::{RequestedTolerance, Tolerance, ToleranceScale},
    input::{Diagnostic, Severity, units::Unit},
};

use crate::quantity::{Dimension, QuantityArgument};

/// A tolerance that replaces another, such as that of the robot file; a part that is not given is not replaced.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ToleranceArgument {
    position_m: Option<f64>,
    orientation_rad: Option<f64>,
}

impl ToleranceArgument {
    /// The tolerance to check with.
    pub fn replace(self, declared: Tolerance) -> Tolerance {
        Tolerance {
            position_m: self.position_m.unwrap_or(declared.position_m),
            orientation_rad: self.orientation_rad.unwrap_or(declared.orientation_rad),
        }
    }
}

impl ToleranceArgument {
    /// The length in m and the angle in rad.
    pub fn parts(self) -> (Option<f64>, Option<f64>) {
        (self.position_m, self.orientation_rad)
    }

    /// What is declared together with a robot file that declares this.
    pub fn requested_or(self, declared: RequestedTolerance) -> RequestedTolerance {
        RequestedTolerance {
            position_m: self.position_m.or(declared.position_m),
            orientation_rad: self.orientation_rad.or(declared.orientation_rad),
        }
    }

    /// As a report has it.
    pub fn requested(self) -> RequestedTolerance {
        RequestedTolerance { position_m: self.position_m, orientation_rad: self.orientation_rad }
    }

    /// What is wrong with it for a robot of this scale: errors, and warnings.
    pub fn examine(self, scale: ToleranceScale) -> (Vec<Diagnostic>, Vec<Diagnostic>) {
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

/// A length or an angle above 0, with its unit.
fn quantity(text: &str) -> Result<(Unit, f64), String> {
    const UNITS: &str = "m, mm, um, nm, deg, rad, mrad, urad or nrad, as in 1mm,0.1deg";
    let found = QuantityArgument::parse(text)
        .map_err(|_| format!("\"{text}\" is not a number with a unit: {UNITS}"))?;
    let unit = match found.dimension {
        Some(Dimension::Length) => Unit::Length,
        Some(Dimension::Angle) => Unit::Angle,
        None => {
            return Err(format!("\"{text}\" has no unit: {text}mm or {text}deg?"));
        }
        Some(Dimension::Mass) => {
            return Err(format!("\"{text}\" is not a number with a unit: {UNITS}"));
        }
    };
    if found.value > 0.0 {
        Ok((unit, found.value))
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
            ("1e999mm", "is not a number with a unit"),
            ("1e-400mm", "must be greater than 0"),
            ("nanmm", "is not a number"),
            ("infm", "is not a number"),
            ("1", "\"1\" has no unit: 1mm or 1deg?"),
            ("1mm,0.1", "\"0.1\" has no unit"),
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
