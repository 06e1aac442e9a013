//! Converts degrees and millimetres of files into radians and metres; no other code does.

use std::ops::Range;

use toml::Spanned;

use crate::diagnostic::Diagnostic;

/// The physical quantity of a value, which decides the unit suffixes of its keys in files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Keys end in `_m` or `_mm`; the value in memory is in metres.
    Length,
    /// Keys end in `_rad` or `_deg`; the value in memory is in radians.
    Angle,
}

/// The unit system in which a file gives a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnitSystem {
    /// Metres and radians, as in memory.
    Si,
    /// Millimetres and degrees, converted when read.
    Engineering,
}

impl UnitSystem {
    /// The system in which a value is written, by which of its two keys is given; `default` if none is.
    pub fn from_given_key<T>(si: Option<&T>, engineering: Option<&T>, default: Self) -> Self {
        match (si, engineering) {
            (_, Some(_)) => Self::Engineering,
            (Some(_), None) => Self::Si,
            (None, None) => default,
        }
    }
}

/// The unit that the last part of a name says: `_m`, `_mm`, `_rad` or `_deg`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct UnitSuffix {
    /// The quantity.
    pub unit: Unit,
    /// Whether values are as in memory.
    pub system: UnitSystem,
}

impl UnitSuffix {
    /// The name without its suffix, and the unit: `elbow` and degrees for `elbow_deg`.
    pub fn split(name: &str) -> Option<(&str, Self)> {
        let (stem, suffix) = name.rsplit_once('_')?;
        [Unit::Length, Unit::Angle].into_iter().find_map(|unit| {
            let at = unit.suffixes().iter().position(|known| *known == suffix)?;
            let system = [UnitSystem::Si, UnitSystem::Engineering][at];
            Some((stem, Self { unit, system }))
        })
    }

    /// A value in m or rad.
    pub fn to_si(self, value: f64) -> f64 {
        if self.system == UnitSystem::Si { value } else { self.unit.convert(value) }
    }
}

impl Unit {
    /// The keys that may give `quantity`: in SI units, then in engineering units.
    pub fn keys(self, quantity: &str) -> [String; 2] {
        self.suffixes().map(|suffix| format!("{quantity}_{suffix}"))
    }

    /// The ends of keys and columns: for SI units, then for engineering units.
    fn suffixes(self) -> [&'static str; 2] {
        match self {
            Self::Length => ["m", "mm"],
            Self::Angle => ["rad", "deg"],
        }
    }

    /// A value in engineering units (mm, deg) in SI units (m, rad).
    pub fn convert(self, value: f64) -> f64 {
        match self {
            // 1000 is exact in binary and 0.001 is not: dividing rounds once.
            Self::Length => value / 1000.0,
            Self::Angle => value.to_radians(),
        }
    }

    /// The value of `quantity` from its two keys, of which at most one may be given.
    ///
    /// # Errors
    /// Both keys are given, or the value is not finite.
    pub fn value(
        self,
        quantity: &str,
        si: Option<&Spanned<f64>>,
        engineering: Option<&Spanned<f64>>,
    ) -> Result<Option<f64>, Diagnostic> {
        let vector = |value: &Spanned<f64>| Spanned::new(value.span(), [*value.get_ref()]);
        let (si, engineering) = (si.map(vector), engineering.map(vector));
        Ok(self.vector(quantity, si.as_ref(), engineering.as_ref())?.map(|[value]| value))
    }

    /// The vector `quantity` from its two keys, of which at most one may be given.
    ///
    /// # Errors
    /// Both keys are given, or a value is not finite.
    pub fn vector<const N: usize>(
        self,
        quantity: &str,
        si: Option<&Spanned<[f64; N]>>,
        engineering: Option<&Spanned<[f64; N]>>,
    ) -> Result<Option<[f64; N]>, Diagnostic> {
        let [si_key, engineering_key] = self.keys(quantity);
        match (si, engineering) {
            (None, None) => Ok(None),
            (Some(values), None) => finite(&si_key, values).map(Some),
            (None, Some(values)) => {
                Ok(Some(finite(&engineering_key, values)?.map(|value| self.convert(value))))
            }
            (Some(_), Some(second)) => Err(Diagnostic::error(
                "toml::both_units",
                format!("{si_key} and {engineering_key} are both given"),
            )
            .at(second.span())
            .with_help("keep exactly one of the two")),
        }
    }
}

fn finite<const N: usize>(key: &str, values: &Spanned<[f64; N]>) -> Result<[f64; N], Diagnostic> {
    values.get_ref().iter().try_for_each(|&value| check_finite(key, value, values.span()))?;
    Ok(*values.get_ref())
}

/// Refuses NaN and the infinities, which TOML has literals for.
///
/// # Errors
/// `value` is not finite.
pub fn check_finite(key: &str, value: f64, span: Range<usize>) -> Result<(), Diagnostic> {
    if value.is_finite() {
        return Ok(());
    }
    let message = format!("{key} is {value}, which is not a finite number");
    let help = "give a finite number: a check that compares with NaN could never fail";
    Err(Diagnostic::error("toml::not_finite", message).at(span).with_help(help))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    fn given(value: f64) -> Spanned<f64> {
        Spanned::new(3..5, value)
    }

    #[track_caller]
    fn check(unit: Unit, si: Option<f64>, engineering: Option<f64>, expected: Result<Option<f64>, &str>) {
        let (si, engineering) = (si.map(given), engineering.map(given));
        let found = unit.value("a", si.as_ref(), engineering.as_ref());
        assert_eq!(found.as_ref().map_err(|error| error.message.as_str()), expected.as_ref().map_err(|e| *e));
    }

    #[test]
    fn one_of_two_keys_gives_the_value() {
        check(Unit::Length, None, None, Ok(None));
        check(Unit::Length, Some(0.1625), None, Ok(Some(0.1625)));
        check(Unit::Length, None, Some(162.5), Ok(Some(0.1625)));
        check(Unit::Angle, None, Some(90.0), Ok(Some(FRAC_PI_2)));
        check(Unit::Angle, Some(FRAC_PI_2), None, Ok(Some(FRAC_PI_2)));
    }

    #[test]
    fn two_keys_and_values_that_are_not_finite_are_refused() {
        check(Unit::Length, Some(1.0), Some(1.0), Err("a_m and a_mm are both given"));
        check(Unit::Angle, None, Some(f64::NAN), Err("a_deg is NaN, which is not a finite number"));
        check(Unit::Length, Some(f64::INFINITY), None, Err("a_m is inf, which is not a finite number"));
    }
}
