//! Converts degrees and millimetres of files into radians and metres; no other code does.

use std::ops::Range;

use toml::Spanned;

use crate::{codes, diagnostic::Diagnostic, display::number};

/// Longer parts of a robot, and offsets between them, are taken for millimetres.
pub const LARGEST_PLAUSIBLE_M: f64 = 10.0;
/// Largest length in m and largest angle in rad of a description. Kind: range of numbers; a double resolves 1e-10 there, a
/// tenth of the default tolerance, and no machine is a thousand kilometres long.
pub const LARGEST: f64 = 1e6;

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

/// The unit of a value in a file or an argument, as the end of its key, its column or its text says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WrittenUnit {
    /// The quantity.
    pub unit: Unit,
    /// Whether values are as in memory.
    pub system: UnitSystem,
}

impl WrittenUnit {
    /// All of them: deg, rad, m, mm.
    pub const ALL: [Self; 4] = [
        Self { unit: Unit::Angle, system: UnitSystem::Engineering },
        Self { unit: Unit::Angle, system: UnitSystem::Si },
        Self { unit: Unit::Length, system: UnitSystem::Si },
        Self { unit: Unit::Length, system: UnitSystem::Engineering },
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        let [si, engineering] = self.unit.names();
        if self.system == UnitSystem::Si { si } else { engineering }
    }

    /// A text without the unit at its end: `90` for `90deg`.
    pub fn at_end(text: &str) -> Option<(&str, Self)> {
        // From the last on, as a text in mm also ends with m.
        Self::ALL.into_iter().rev().find_map(|unit| Some((text.strip_suffix(unit.name())?, unit)))
    }

    /// The quantity and the unit of a column: `elbow` for `elbow_deg`.
    pub fn split(name: &str) -> Option<(&str, Self)> {
        let (quantity, unit) = Self::at_end(name)?;
        Some((quantity.strip_suffix('_')?, unit))
    }

    /// The unit of a key of ours, also per time: of `velocity_deg_s` degrees.
    ///
    /// # Panics
    /// The key has no unit.
    pub fn of_key(key: &'static str) -> Self {
        let unit = key.rsplit('_').find_map(|part| Self::ALL.into_iter().find(|unit| unit.name() == part));
        unit.unwrap_or_else(|| panic!("{key} has no unit"))
    }

    /// A value in m or rad.
    pub fn to_si(self, value: f64) -> f64 {
        if self.system == UnitSystem::Si { value } else { self.unit.convert(value) }
    }

    /// A value in m or rad, in this unit.
    pub fn from_si(self, value: f64) -> f64 {
        match (self.system, self.unit) {
            (UnitSystem::Si, _) => value,
            (UnitSystem::Engineering, Unit::Length) => value * 1e3,
            (UnitSystem::Engineering, Unit::Angle) => value.to_degrees(),
        }
    }
}

/// The fault of a quantity that two keys give, in SI units and in engineering units.
pub fn both_given([si, engineering]: [&str; 2]) -> Diagnostic {
    let message = format!("{si} and {engineering} are both given");
    Diagnostic::error(codes::toml::BOTH_UNITS, message).with_help("keep exactly one of the two")
}

impl Unit {
    /// The keys that may give `quantity`: in SI units, then in engineering units.
    pub fn keys(self, quantity: &str) -> [String; 2] {
        self.names().map(|unit| format!("{quantity}_{unit}"))
    }

    /// The units: of SI, then the engineering unit.
    pub fn names(self) -> [&'static str; 2] {
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
    /// Both keys are given, or the value is not finite or beyond [`LARGEST`].
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
    /// Both keys are given, or a value is not finite or beyond [`LARGEST`].
    pub fn vector<const N: usize>(
        self,
        quantity: &str,
        si: Option<&Spanned<[f64; N]>>,
        engineering: Option<&Spanned<[f64; N]>>,
    ) -> Result<Option<[f64; N]>, Diagnostic> {
        let [si_key, engineering_key] = self.keys(quantity);
        match (si, engineering) {
            (None, None) => Ok(None),
            (Some(values), None) => self.in_range(&si_key, values, |value| value).map(Some),
            (None, Some(values)) => {
                self.in_range(&engineering_key, values, |value| self.convert(value)).map(Some)
            }
            (Some(_), Some(second)) => Err(both_given([&si_key, &engineering_key]).at(second.span())),
        }
    }

    fn in_range<const N: usize>(
        self,
        key: &str,
        written: &Spanned<[f64; N]>,
        to_si: impl Fn(f64) -> f64,
    ) -> Result<[f64; N], Diagnostic> {
        let values = finite(key, written)?.map(to_si);
        values.iter().try_for_each(|&value| self.check_range(key, value, written.span()))?;
        Ok(values)
    }

    /// Refuses a value, m or rad, that no description has and whose digits would be lost.
    ///
    /// # Errors
    /// `value` is beyond [`LARGEST`].
    pub fn check_range(self, key: &str, value: f64, span: Range<usize>) -> Result<(), Diagnostic> {
        if value.abs() <= LARGEST {
            return Ok(());
        }
        let [unit, engineering] = self.names();
        let value = number(value);
        let message = format!("{key} is {value} {unit}, limit <= {LARGEST:e} {unit}");
        Err(Diagnostic::error(codes::toml::TOO_LARGE, message).at(span).with_help(format!(
            "numbers that large have lost the digits that a robot needs; keys that end in _{engineering} are in {engineering}"
        )))
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
    Err(Diagnostic::error(codes::toml::NOT_FINITE, message).at(span).with_help(help))
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
    fn a_value_beyond_meaning_is_refused_with_its_limit() {
        check(Unit::Length, Some(-LARGEST), None, Ok(Some(-LARGEST)));
        check(Unit::Length, Some(1e200), None, Err("a_m is 1.0e200 m, limit <= 1e6 m"));
        check(Unit::Length, None, Some(-1e12), Err("a_mm is -1.0e9 m, limit <= 1e6 m"));
        check(Unit::Angle, None, Some(1e9), Err("a_deg is 1.7e7 rad, limit <= 1e6 rad"));
    }

    #[test]
    fn names_end_with_units() {
        let found =
            |split: Option<(&str, WrittenUnit)>| split.map(|(rest, unit)| (rest.to_owned(), unit.name()));
        for (name, rest, unit) in
            [("a_deg", "a", "deg"), ("a_b_rad", "a_b", "rad"), ("x_m", "x", "m"), ("x_mm", "x", "mm")]
        {
            assert_eq!(found(WrittenUnit::split(name)), Some((rest.to_owned(), unit)));
        }
        assert_eq!(["arm", "mm", "a_m_s", "a_radm"].map(WrittenUnit::split), [None; 4]);
        assert_eq!(found(WrittenUnit::at_end("100 mm")), Some(("100 ".to_owned(), "mm")));
        let keys = ["velocity_deg_s", "rate_mm_per_s", "jerk_m_s3", "path_tcp_m", "value_rad"];
        assert_eq!(keys.map(|key| WrittenUnit::of_key(key).name()), ["deg", "mm", "m", "m", "rad"]);
    }

    #[test]
    fn two_keys_and_values_that_are_not_finite_are_refused() {
        check(Unit::Length, Some(1.0), Some(1.0), Err("a_m and a_mm are both given"));
        check(Unit::Angle, None, Some(f64::NAN), Err("a_deg is NaN, which is not a finite number"));
        check(Unit::Length, Some(f64::INFINITY), None, Err("a_m is inf, which is not a finite number"));
    }
}
