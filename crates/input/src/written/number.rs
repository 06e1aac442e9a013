//! Numbers as they are written into files: short if that loses nothing, with all digits otherwise.

use std::f64::consts::{PI, TAU};

use crate::units::{Unit, UnitSystem};

/// How far an angle written in degrees may be from the one in memory. Kind: rounding of the unit
/// change, two operations on numbers up to pi.
const WRITTEN_RAD: f64 = 1e-15;
/// Steps per degree that count as a short number.
const DEGREE_STEPS: f64 = 1e6;

/// A number with all its digits, without a negative zero.
pub fn number(value: f64) -> String {
    format!("{:?}", value + 0.0)
}

/// How far a written correction may be from the computed one, relative. Kind: what rounding to twelve significant digits costs
/// at most, which no correction exceeds in accuracy.
const CORRECTED: f64 = 5e-12;

/// A corrected value by the fewest digits that say the same: at most twelve, and not the last digits of a computation, as in
/// `0.800000000003`.
pub fn significant(value: f64) -> String {
    shortest(value, CORRECTED * value.abs())
}

/// The corrected components of a vector, each as accurate as the largest needs: the other axes of gravity are `0.0` and not
/// what rounding has left of them.
///
/// # Examples
/// ```
/// use congruent_input::number::significant_components;
/// assert_eq!(significant_components([-2.2e-16, 0.0, -9.809_999_999_999_9]), ["0.0", "0.0", "-9.81"]);
/// ```
pub fn significant_components<const N: usize>(values: [f64; N]) -> [String; N] {
    let largest = values.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    values.map(|value| shortest(value, CORRECTED * largest))
}

/// The number with the fewest significant digits that is at most `slack` away.
fn shortest(value: f64, slack: f64) -> String {
    /// Twelve significant digits, the most.
    const MOST_DECIMALS: usize = 11;
    if value.abs() <= slack {
        return number(0.0);
    }
    let rounded = |decimals: usize| format!("{value:.decimals$e}").parse::<f64>().unwrap_or(value);
    let near = (0..MOST_DECIMALS).map(rounded).find(|rounded| (rounded - value).abs() <= slack);
    number(near.unwrap_or_else(|| rounded(MOST_DECIMALS)))
}

/// How far a fitted value may be from the one that is written for it, in m or rad, relative above 1.
/// Kind: rounding of a fit on some hundred numbers, two digits above eps.
pub(super) const FITTED: f64 = 5e-14;

/// How far a written value may be from the fitted one. The rounding of the fit is always allowed in addition.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Slack {
    /// Tolerance of a length, m.
    pub length_m: f64,
    /// Tolerance of an angle, rad.
    pub angle_rad: f64,
}

/// A fitted number (m, rad, or without unit) by the fewest decimals that say the same: a fit fills all
/// digits with its rounding.
pub fn fitted_number(value: f64) -> String {
    fitted_in(value, 1.0, 0.0)
}

/// The same angle in `-pi < angle <= pi`; a half turn is positive also if it is only nearly one.
fn within_a_turn(angle_rad: f64, slack_rad: f64) -> f64 {
    let whole_turns = ((angle_rad - PI) / TAU).ceil();
    // An angle that is within already keeps its last digit.
    let reduced = if whole_turns == 0.0 { angle_rad } else { angle_rad - whole_turns * TAU };
    if reduced + PI <= slack_rad.max(FITTED) { reduced + TAU } else { reduced }
}

/// The same in a unit of which `one` make a metre or a radian.
fn fitted_in(value: f64, one: f64, slack: f64) -> String {
    /// More decimals than any number within [`FITTED`] needs.
    const MOST_DECIMALS: usize = 15;
    let is_near = |text: &String| {
        let off = text.parse::<f64>().map_or(f64::INFINITY, |written| (written - value).abs());
        off <= (FITTED * value.abs().max(one)).max(slack * one)
    };
    let near = (0..MOST_DECIMALS).map(|decimals| format!("{value:.decimals$}")).find(is_near);
    match near.unwrap_or_else(|| format!("{value:?}")) {
        zero if zero.trim_start_matches('-').chars().all(|digit| matches!(digit, '0' | '.')) => {
            "0".to_owned()
        }
        shortest => shortest,
    }
}

impl Unit {
    /// A fitted value (m, rad) as it is written in SI units or in engineering units: by the fewest decimals
    /// within the slack; angles within half a turn.
    ///
    /// # Examples
    /// ```
    /// use congruent_input::{Slack, units::{Unit, UnitSystem}};
    /// let nearly = (-269.999_999_990_52_f64).to_radians();
    /// let slack = Slack { length_m: 1e-9, angle_rad: 1e-9 };
    /// assert_eq!(Unit::Angle.fitted(nearly, UnitSystem::Engineering, slack), "90");
    /// ```
    pub fn fitted(self, value: f64, units: UnitSystem, slack: Slack) -> String {
        let (value, slack) = match self {
            Self::Length => (value, slack.length_m),
            Self::Angle => (within_a_turn(value, slack.angle_rad), slack.angle_rad),
        };
        match (units, self) {
            (UnitSystem::Si, _) => fitted_in(value, 1.0, slack),
            (UnitSystem::Engineering, Self::Length) => fitted_in(value * 1000.0, 1000.0, slack),
            (UnitSystem::Engineering, Self::Angle) => {
                fitted_in(value.to_degrees(), 1_f64.to_degrees(), slack)
            }
        }
    }

    /// The right value in place of a wrong one: short, but with enough digits to differ from it.
    pub fn corrected(self, found: f64, expected: f64, units: UnitSystem, slack: Slack) -> String {
        /// Part of its change that a value may be off.
        const PART_OF_CHANGE: f64 = 0.05;
        // A correction of 1e-8 must not be rounded away.
        let most = PART_OF_CHANGE * (found - expected).abs();
        let slack = Slack { length_m: slack.length_m.min(most), angle_rad: slack.angle_rad.min(most) };
        self.fitted(expected, units, slack)
    }

    /// A fitted vector under the key that says its unit.
    pub fn fitted_vector(self, quantity: &str, values: [f64; 3], units: UnitSystem, slack: Slack) -> String {
        let [si_key, engineering_key] = self.keys(quantity);
        let key = if units == UnitSystem::Engineering { engineering_key } else { si_key };
        format!("{key} = [{}]", values.map(|value| self.fitted(value, units, slack)).join(", "))
    }
}

/// Fitted numbers without unit as a list.
pub fn fitted_list(values: impl IntoIterator<Item = f64>) -> String {
    format!("[{}]", values.into_iter().map(fitted_number).collect::<Vec<_>>().join(", "))
}

/// Numbers with all their digits, joined by `separator`.
pub fn numbers(values: impl IntoIterator<Item = f64>, separator: &str) -> String {
    values.into_iter().map(number).collect::<Vec<_>>().join(separator)
}

/// The same angle in degrees; `None` if six decimals do not give the angle within rounding.
pub fn short_degrees(angle_rad: f64) -> Option<f64> {
    let degrees = (angle_rad.to_degrees() * DEGREE_STEPS).round() / DEGREE_STEPS;
    ((degrees.to_radians() - angle_rad).abs() <= WRITTEN_RAD).then_some(degrees)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    #[test]
    fn angles_are_short_only_if_nothing_is_lost() {
        assert_eq!(short_degrees(FRAC_PI_2), Some(90.0));
        assert_eq!(short_degrees(FRAC_PI_2 + 2.05e-10), None);
        assert_eq!(number(-0.0), "0.0");
    }

    #[test]
    fn a_correction_has_the_fewest_digits_that_say_the_same() {
        let written =
            [0.800_000_000_003, -9.81, 0.010_267_495_893_04, 1.0 / 3.0, 0.0, 2e-16].map(significant);
        assert_eq!(written, ["0.8", "-9.81", "0.010267495893", "0.333333333333", "0.0", "2e-16"]);
    }

    #[test]
    fn fitted_angles_are_within_a_turn() {
        let slack = Slack { length_m: 0.0, angle_rad: 1e-10 };
        for (degrees, written) in [
            (270.0, "-90"),
            (-180.0, "180"),
            (-179.999_999_999_9, "180"),
            (180.0, "180"),
            (-0.000_000_000_71, "0"),
            (725.0, "5"),
            (12.345_678_9, "12.3456789"),
        ] {
            let found = Unit::Angle.fitted(f64::to_radians(degrees), UnitSystem::Engineering, slack);
            assert_eq!(found, written, "{degrees}");
        }
        assert_eq!(
            Unit::Length.fitted(0.061_734_99, UnitSystem::Engineering, Slack { length_m: 1e-6, ..slack }),
            "61.735"
        );
    }

    #[test]
    fn fitted_numbers_are_as_short_as_they_may_be() {
        for (value, written) in [
            (0.1 - 1e-16, "0.1"),
            (-1e-14, "0"),
            (-0.392_200_000_000_000_3, "-0.3922"),
            (90.0 + 1e-12, "90"),
            (FRAC_PI_2, "1.5707963267949"),
            (1e-12, "0.000000000001"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(fitted_number(value), written);
        }
    }
}
