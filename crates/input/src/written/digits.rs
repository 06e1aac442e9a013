//! The precision with which a number is typed: half of its last place.
//!
//! A value of a data sheet is rounded to the digits that are printed, so the true value is within half of the last
//! place of the typed one. Values that a program has written, with 15 digits or more, are exact here.

use std::f64::consts::FRAC_PI_2;

use crate::units::{Unit, UnitSystem};

/// Significant digits from which a program has written a number, with all that an `f64` has. Kind: format.
const PROGRAM_DIGITS: usize = 15;

/// Digits that a person types at most: a number that has no more of them, up to the rounding of an `f64`, is as precise as they are.
/// Kind: choice.
const SHORT_DIGITS: usize = 8;

/// The rounding of an `f64` and of one multiplication, as a part of the number. Kind: rounding.
const NOISE: f64 = 2.0 * f64::EPSILON;

/// The coarsest last place, as an exponent of ten, of a value that is rounded: a millimetre, and a hundredth of a radian.
/// Coarser ones have lost their trailing zeros: `0.4` is 400 mm, and not something from 350 mm to 450 mm. Kind: choice.
const COARSEST_M: i32 = -3;
const COARSEST_MM: i32 = 0;
const COARSEST_RAD: i32 = -2;

/// The most that a zero is off: most zeros are design values, and no table writes an offset of half a millimetre as 0.
/// Unit: m and rad; kind: choice, half of the fourth decimal.
const MOST_OF_ZERO: f64 = 5e-5;

/// Significant digits that a mass, a moment or a limit has at least: `35` is 35.0, without its trailing zero. Kind: choice; a
/// placeholder of 1 kg is no rounded 0.6 kg.
const LEAST_DIGITS: i32 = 3;

/// A number as it is typed, and the unit system of its key.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TypedNumber<'a> {
    /// The characters of the number.
    pub text: &'a str,
    /// Whether it is in m or rad, or in mm or degrees.
    pub units: UnitSystem,
}

/// Half of the last place of each number, in m or rad: how far the true value may be from the typed one.
///
/// `typed` are all lengths, or all angles, of one file. A value that is no finer than a centimetre has lost the zeros at its end:
/// it has the finest last place of the others, or as many digits as the longest of them, whichever is coarser, and is exact if
/// there are no others. A zero has the finest last place, and is off by 5e-5 at most.
/// A program that has written `0.10300000000000001` meant 0.103. Whole degrees are exact, too: they are design angles, not
/// measurements; of those that are typed with two decimals or more, as `10.00`, multiples of 15 alone. A quarter turn that is cut
/// instead of rounded, as 1.57079, is off by up to a whole last place, and 3.14158 by two.
///
/// # Examples
/// ```
/// use congruent_input::{TypedNumber, half_places, units::{Unit, UnitSystem::Si}};
/// let typed = ["0.1625", "0", "-0.425", "1.234567890123456"].map(|text| TypedNumber { text, units: Si });
/// assert_eq!(half_places(Unit::Length, &typed[..3]), [5e-5, 5e-5, 5e-4]);
/// // A value with all digits is exact, and shows that zeros of this file are, too.
/// assert_eq!(half_places(Unit::Length, &typed)[1..], [0.0, 5e-4, 0.0]);
/// ```
pub fn half_places(unit: Unit, typed: &[TypedNumber<'_>]) -> Vec<f64> {
    half_places_with_zero(unit, typed, MOST_OF_ZERO)
}

/// The same of the coordinates of a point that was measured or computed, as a centre of mass: its zeros are no design values, and
/// are off by the finest last place of the others.
pub fn half_places_of_point(typed: &[TypedNumber<'_>]) -> Vec<f64> {
    half_places_with_zero(Unit::Length, typed, f64::INFINITY)
}

/// Half places of numbers whose zeros are off by this at most.
fn half_places_with_zero(unit: Unit, typed: &[TypedNumber<'_>], most_of_zero: f64) -> Vec<f64> {
    let halves: Vec<Option<f64>> = typed.iter().map(|number| half_place(unit, *number)).collect();
    let written = || halves.iter().zip(typed).filter_map(|(half, number)| Some(((*half)?, number.text)));
    let finest = written().map(|(half, _)| half).fold(f64::INFINITY, f64::min);
    let finest = if finest.is_finite() { finest } else { 0.0 };
    let most_digits = written().filter_map(|(_, text)| Some(TypedDigits::read(text)?.significant)).max();
    let half = |(half, number): (&Option<f64>, &TypedNumber<'_>)| match half {
        Some(half) => *half,
        None if number.text.parse() == Ok(0.0) => finest.min(most_of_zero),
        None => finest.max(most_digits.map_or(0.0, |most| with_digits(unit, *number, most))),
    };
    halves.iter().zip(typed).map(half).collect()
}

/// Half of the last place of a number that has lost its trailing zeros, if it had this many digits.
fn with_digits(unit: Unit, TypedNumber { text, units }: TypedNumber<'_>, digits: usize) -> f64 {
    let (Some(typed), (one, coarsest)) = (TypedDigits::read(text), places(unit, units)) else { return 0.0 };
    if digits >= PROGRAM_DIGITS {
        return 0.0;
    }
    let last_place = typed.first_place().saturating_sub(i32::try_from(digits).unwrap_or(i32::MAX)) + 1;
    half_of_place(last_place.min(coarsest)) * one
}

/// Half of the last place of each number of one kind that is neither a length nor an angle, such as the entries of a tensor, in
/// their unit. A number has three significant digits at least, with trailing zeros that may be left out, unless another one has as
/// many and the same last place, as all do that are written with six decimals; a zero is as fine as the finest of the others, and
/// exact alone.
///
/// # Examples
/// ```
/// use congruent_input::half_places_of_values;
/// assert_eq!(half_places_of_values(&["3.7612", "35", "0"]), [5e-5, 5e-2, 5e-5]);
/// assert_eq!(half_places_of_values(&["0.4"]), [5e-4]);
/// assert_eq!(half_places_of_values(&["0.000132", "0.000099"]), [5e-7, 5e-7]);
/// assert_eq!(half_places_of_values(&["0.123456789012345", "0"]), [0.0, 0.0]);
/// ```
pub fn half_places_of_values(typed: &[&str]) -> Vec<f64> {
    let full = typed.iter().filter_map(|text| TypedDigits::read(text));
    let places: Vec<i32> = full
        .filter(|of| of.first_place() - of.last_place >= LEAST_DIGITS - 1)
        .map(|of| of.last_place)
        .collect();
    let halves: Vec<Option<f64>> = typed.iter().map(|text| half_place_of_value(text, &places)).collect();
    let finest = halves.iter().copied().flatten().fold(f64::INFINITY, f64::min);
    let of_zero = if finest.is_finite() { finest } else { 0.0 };
    halves.into_iter().map(|half| half.unwrap_or(of_zero)).collect()
}

/// Half of the last place of a value; `None` for a zero. `places` are the last places of values with enough digits.
fn half_place_of_value(text: &str, places: &[i32]) -> Option<f64> {
    let Some(TypedDigits { significant, last_place }) = TypedDigits::read(text) else { return Some(0.0) };
    if significant >= PROGRAM_DIGITS {
        return Some(0.0);
    }
    let first_place = TypedDigits { significant, last_place }.first_place();
    let least = first_place.saturating_sub(LEAST_DIGITS - 1);
    let last_place = if places.contains(&last_place) { last_place } else { last_place.min(least) };
    (significant > 0).then(|| half_of_place(last_place))
}

/// Half of a unit of a decimal place.
fn half_of_place(exponent: i32) -> f64 {
    // A tenth power is exact as a literal alone: `powi` would be off by its rounding.
    format!("5e{}", exponent.saturating_sub(1)).parse().unwrap_or(0.0)
}

/// Half of the last place; `None` if zeros at the end may be left out.
fn half_place(unit: Unit, TypedNumber { text, units }: TypedNumber<'_>) -> Option<f64> {
    let Some(TypedDigits { significant, last_place }) = TypedDigits::read(text) else { return Some(0.0) };
    if (unit, units) == (Unit::Angle, UnitSystem::Engineering) && is_design_angle(text, last_place) {
        return Some(0.0);
    }
    let (one, coarsest) = places(unit, units);
    if significant >= PROGRAM_DIGITS {
        return Some(0.0);
    }
    if significant == 0 || last_place > coarsest {
        return None;
    }
    let half = half_of_place(last_place);
    if (unit, units) == (Unit::Angle, UnitSystem::Si) {
        return Some(half * halves_of_cut_quarter_turns(text, half).unwrap_or(1.0));
    }
    Some(half * one)
}

/// Whether an angle in degrees is one of a drawing, and no rounded one: whole degrees, of those that are typed with two decimals or
/// more, as `10.00`, only multiples of 15.
fn is_design_angle(text: &str, last_place: i32) -> bool {
    const OF_DRAWINGS_DEG: f64 = 15.0;
    let is_rounded = last_place <= -2;
    text.parse::<f64>().is_ok_and(|value| value % if is_rounded { OF_DRAWINGS_DEG } else { 1.0 } == 0.0)
}

/// The unit of a typed number in m or rad, and the coarsest last place of one that is rounded.
fn places(unit: Unit, units: UnitSystem) -> (f64, i32) {
    match (unit, units) {
        (Unit::Length, UnitSystem::Si) => (1.0, COARSEST_M),
        (Unit::Length, UnitSystem::Engineering) => (1e-3, COARSEST_MM),
        (Unit::Angle, UnitSystem::Si) => (1.0, COARSEST_RAD),
        (Unit::Angle, UnitSystem::Engineering) => (1_f64.to_radians(), i32::MAX),
    }
}

/// How many half places an angle in radians may be off, if it is a multiple of a quarter turn that is cut behind its last digit instead
/// of rounded: a whole place for each quarter at most, since 3.14158 is twice 1.57079. `None` if it is not.
fn halves_of_cut_quarter_turns(text: &str, half: f64) -> Option<f64> {
    let value = text.parse::<f64>().ok()?;
    let quarters = (value / FRAC_PI_2).round().abs();
    let missing = quarters * FRAC_PI_2 - value.abs();
    let places = (missing / (2.0 * half)).ceil();
    (missing > half && places <= quarters).then_some(2.0 * places)
}

/// The digits of a typed number.
struct TypedDigits {
    /// Digits from the first one that is not zero; 0 for a zero.
    significant: usize,
    /// Exponent of ten of the last digit.
    last_place: i32,
}

impl TypedDigits {
    /// The digits of a number; those of `0.103` for `0.10300000000000001`, which a program has written with the rounding of 103 mm.
    fn read(text: &str) -> Option<Self> {
        let typed = Self::of_text(text)?;
        if typed.significant < PROGRAM_DIGITS {
            return Some(typed);
        }
        let value: f64 = text.trim().parse().ok()?;
        let short = format!("{value:.*e}", SHORT_DIGITS - 1);
        let is_same = short.parse::<f64>().is_ok_and(|of| (of - value).abs() <= NOISE * value.abs());
        let (mantissa, exponent) = short.split_once('e')?;
        let short = format!("{}e{exponent}", mantissa.trim_end_matches('0').trim_end_matches('.'));
        if is_same { Self::of_text(&short) } else { Some(typed) }
    }

    fn of_text(text: &str) -> Option<Self> {
        let unsigned = text.trim().trim_start_matches(['+', '-']).replace('_', "");
        let (mantissa, exponent) = unsigned.split_once(['e', 'E']).unwrap_or((&unsigned, "0"));
        let (whole, decimals) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let all: String = [whole, decimals].concat();
        if all.is_empty() || !all.chars().all(|digit| digit.is_ascii_digit()) {
            return None;
        }
        let last_place = exponent.parse::<i32>().ok()?.checked_sub(i32::try_from(decimals.len()).ok()?)?;
        Some(Self { significant: all.trim_start_matches('0').len(), last_place })
    }

    /// Exponent of ten of the first digit that is not zero.
    fn first_place(&self) -> i32 {
        self.last_place.saturating_add(i32::try_from(self.significant).unwrap_or(i32::MAX)) - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn half(unit: Unit, units: UnitSystem, text: &str) -> f64 {
        half_places(unit, &[TypedNumber { text, units }])[0]
    }

    #[test]
    fn the_last_place_is_that_of_the_typed_text() {
        use UnitSystem::{Engineering, Si};
        for (unit, units, text, expected) in [
            (Unit::Length, Si, "-0.0003501", 5e-8),
            (Unit::Length, Engineering, "342.5", 5e-5),
            (Unit::Length, Engineering, "425", 5e-4),
            (Unit::Length, Si, "1.5e-3", 5e-5),
            (Unit::Length, Si, "0.4", 0.0),
            (Unit::Length, Si, "0.325", 5e-4),
            // Written by a program: 103 mm, and what it has computed.
            (Unit::Length, Si, "0.10300000000000001", 5e-4),
            (Unit::Length, Si, "0.103000000000123", 0.0),
            (Unit::Angle, Si, "1.5707963267948966", 0.0),
            (Unit::Angle, Si, "1.5708", 5e-5),
            (Unit::Angle, Si, "+1.57", 5e-3),
            (Unit::Angle, Si, "-1.57079", 1e-5),
            (Unit::Angle, Si, "3.1415", 1e-4),
            (Unit::Angle, Si, "-3.14158", 2e-5),
            (Unit::Angle, Si, "3.14157", 5e-6),
            (Unit::Angle, Si, "1.57069", 5e-6),
            (Unit::Angle, Si, "3", 0.0),
            (Unit::Angle, Engineering, "90.0", 0.0),
            (Unit::Angle, Engineering, "-21.5", 0.05_f64.to_radians()),
            (Unit::Angle, Si, "1.5707963267948966", 0.0),
            (Unit::Angle, Si, "2.7629E-18", 5e-23),
            (Unit::Length, Si, "0", 0.0),
            (Unit::Length, Si, "nan", 0.0),
        ] {
            let found = half(unit, units, text);
            assert!((found - expected).abs() <= 1e-15 * expected, "{text}: {found} for {expected}");
        }
    }

    #[test]
    fn a_value_without_its_trailing_zeros_is_as_fine_as_the_others() {
        let typed = ["0.4", "0.3125", "0"].map(|text| TypedNumber { text, units: UnitSystem::Si });
        assert_eq!(half_places(Unit::Length, &typed), [5e-5; 3]);
        // Three digits each, as a program rounds them: no tiny one makes 0.22 an exact value.
        let typed = ["0.22", "0.00123", "1.46e-12"].map(|text| TypedNumber { text, units: UnitSystem::Si });
        assert_eq!(half_places(Unit::Length, &typed), [5e-4, 5e-6, 5e-15]);
        let angles = ["-1.7", "3.1415926535897931"].map(|text| TypedNumber { text, units: UnitSystem::Si });
        assert_eq!(half_places(Unit::Angle, &angles), [0.0, 0.0], "the file has all digits");
    }
}
