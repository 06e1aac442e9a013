//! Values with units on the command line: lengths, angles and masses.

use congruent::input::{display::counted, units::Unit};

/// What a value measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Dimension {
    /// In m.
    Length,
    /// In rad.
    Angle,
    /// In kg.
    Mass,
}

impl Dimension {
    /// The word for it in messages.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Length => "a length",
            Self::Angle => "an angle",
            Self::Mass => "a mass",
        }
    }

    /// Examples of its units.
    fn units(self) -> &'static str {
        match self {
            Self::Length => "mm or m",
            Self::Angle => "deg or rad",
            Self::Mass => "kg or g",
        }
    }
}

/// A unit of the command line.
struct ArgumentUnit {
    name: &'static str,
    dimension: Dimension,
    to_si: fn(f64) -> f64,
}

const fn unit(name: &'static str, dimension: Dimension, to_si: fn(f64) -> f64) -> ArgumentUnit {
    ArgumentUnit { name, dimension, to_si }
}

const UNITS: [ArgumentUnit; 11] = [
    unit("m", Dimension::Length, |value| value),
    unit("mm", Dimension::Length, |value| Unit::Length.convert(value)),
    unit("um", Dimension::Length, |value| value / 1e6),
    unit("nm", Dimension::Length, |value| value / 1e9),
    unit("rad", Dimension::Angle, |value| value),
    unit("mrad", Dimension::Angle, |value| value / 1e3),
    unit("urad", Dimension::Angle, |value| value / 1e6),
    unit("nrad", Dimension::Angle, |value| value / 1e9),
    unit("deg", Dimension::Angle, |value| Unit::Angle.convert(value)),
    unit("kg", Dimension::Mass, |value| value),
    unit("g", Dimension::Mass, |value| value / 1e3),
];

/// A finite number, in SI units if it is written with a unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct QuantityArgument {
    /// Of the unit; none without a unit.
    pub(crate) dimension: Option<Dimension>,
    /// In m, rad or kg.
    pub(crate) value: f64,
}

impl QuantityArgument {
    /// The quantity in a text such as `20mm`, `-90 deg` or `0.02`.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let text = text.trim();
        // The exponent of 1e-6 is no unit.
        let start = text.find(|c: char| c.is_alphabetic() && !matches!(c, 'e' | 'E')).unwrap_or(text.len());
        let (number, name) = text.split_at(start);
        let unit = UNITS.iter().find(|unit| unit.name == name);
        if unit.is_none() && !name.is_empty() {
            return Err(match number.trim().parse::<f64>() {
                Ok(_) => format!("\"{text}\": the unit \"{name}\" is not known"),
                Err(_) => format!("\"{text}\" is not a number"),
            });
        }
        let value: f64 = number.trim().parse().map_err(|_| format!("\"{text}\" is not a number"))?;
        let value = unit.map_or(value, |unit| (unit.to_si)(value));
        if value.is_finite() {
            Ok(Self { dimension: unit.map(|unit| unit.dimension), value })
        } else {
            Err(format!("\"{text}\" is not a finite number"))
        }
    }

    /// The value in SI units of a quantity of this dimension. Without a unit, lengths are in m and masses in kg; an angle needs
    /// its unit, since degrees and radians are both usual, unless it is 0.
    pub(crate) fn of(text: &str, dimension: Dimension) -> Result<f64, String> {
        let Self { dimension: found, value } = Self::parse(text)?;
        match found {
            Some(found) if found != dimension => {
                Err(format!("\"{text}\" is {}, expected {}", found.name(), dimension.name()))
            }
            None if dimension == Dimension::Angle && value != 0.0 => {
                // In radians a number of degrees is many turns: the same angle in both units.
                let radians = (Unit::Angle.convert(value) * 1e4).round() / 1e4;
                Err(format!("\"{text}\" needs a unit: {text}deg, or {radians}rad"))
            }
            _ => Ok(value),
        }
    }

    /// A value above 0.
    pub(crate) fn positive(text: &str, dimension: Dimension) -> Result<f64, String> {
        let value = Self::of(text, dimension)?;
        let refused =
            || format!("\"{text}\": {} must be above 0, in {}", dimension.name(), dimension.units());
        if value > 0.0 { Ok(value) } else { Err(refused()) }
    }
}

/// A length above 0: `20mm`, or in m without a unit.
pub(crate) fn positive_length(text: &str) -> Result<f64, String> {
    QuantityArgument::positive(text, Dimension::Length)
}

/// A length above 0 that must have its unit: 20 is in mm for most, and 20 m would pass silently.
pub(crate) fn length_with_unit(text: &str) -> Result<f64, String> {
    let length = positive_length(text)?;
    match QuantityArgument::parse(text)?.dimension {
        Some(_) => Ok(length),
        None => Err(format!("\"{text}\" needs a unit: {text}mm or {text}m")),
    }
}

/// An angle above 0, with its unit.
pub(crate) fn angle_with_unit(text: &str) -> Result<f64, String> {
    QuantityArgument::positive(text, Dimension::Angle)
}

/// Three lengths, `0.4,0.1,0.3` in m or `400mm,0.1m,300mm`.
pub(crate) fn three_lengths(text: &str) -> Result<[f64; 3], String> {
    three(text, Dimension::Length, "0.4,0.1,0.3 or 400mm,100mm,300mm")
}

/// Three angles, each with its unit unless it is 0.
pub(crate) fn three_angles(text: &str) -> Result<[f64; 3], String> {
    three(text, Dimension::Angle, "180deg,0,90deg")
}

fn three(text: &str, dimension: Dimension, example: &str) -> Result<[f64; 3], String> {
    let parts: Vec<&str> = text.split(',').collect();
    let [x, y, z] = parts[..] else {
        let words: Vec<&str> = text.split_whitespace().collect();
        if let ([_], [x, y, z]) = (&parts[..], &words[..]) {
            return Err(format!("separate the values with commas: {x},{y},{z}"));
        }
        return Err(format!("{}, expected three, as in {example}", counted(parts.len(), "value")));
    };
    all_with_unit(&[x, y, z])?;
    Ok([
        QuantityArgument::of(x, dimension)?,
        QuantityArgument::of(y, dimension)?,
        QuantityArgument::of(z, dimension)?,
    ])
}

/// Refuses values of which only some have a unit: 350,100,450mm would be two lengths in m and one in mm.
fn all_with_unit(parts: &[&str]) -> Result<(), String> {
    let read = |text: &str| Some(QuantityArgument::parse(text).ok()?).filter(|of| of.value != 0.0);
    let unit = parts.iter().find_map(|text| {
        let text = text.trim();
        let start = text.find(|c: char| c.is_alphabetic() && !matches!(c, 'e' | 'E'))?;
        read(text).map(|_| &text[start..])
    });
    let is_without = |text: &&str| read(text).is_some_and(|of| of.dimension.is_none());
    let Some(unit) = unit.filter(|_| parts.iter().any(is_without)) else { return Ok(()) };
    let with_unit = |text: &&str| {
        let text = text.trim();
        if is_without(&text) { format!("{text}{unit}") } else { text.to_owned() }
    };
    let all: Vec<String> = parts.iter().map(with_unit).collect();
    Err(format!("only some values have a unit: write {}", all.join(",")))
}

/// A rate of rows.
pub(crate) fn rate_hz(text: &str) -> Result<f64, String> {
    let rate = text.parse().ok().filter(|rate: &f64| rate.is_finite() && *rate > 0.0);
    rate.ok_or_else(|| "a rate is a number of rows a second above 0: --rate-hz 125".to_owned())
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    #[test]
    fn units() {
        for text in ["20mm", "20 mm", "0.02m", "0.02", " 2e-2 m", "2E-2", "20000um"] {
            assert_eq!(positive_length(text), Ok(0.02), "{text}");
        }
        assert_eq!(QuantityArgument::of("2500g", Dimension::Mass), Ok(2.5));
        assert_eq!(QuantityArgument::of("-90deg", Dimension::Angle), Ok(-FRAC_PI_2));
        assert_eq!(three_lengths("400mm, 0.1m,-0.3m"), Ok([0.4, 0.1, -0.3]));
        assert_eq!(three_lengths("0,0,50mm"), Ok([0.0, 0.0, 0.05]));
        assert_eq!(three_angles("180deg,0,1.5rad"), Ok([PI, 0.0, 1.5]));
    }

    #[test]
    fn what_is_no_quantity_is_refused() {
        for (text, message) in [
            ("0mm", "must be above 0, in mm or m"),
            ("-1m", "must be above 0"),
            ("inf", "is not a number"),
            ("NaN", "is not a number"),
            ("1e999m", "is not a finite number"),
            ("20cm", "the unit \"cm\" is not known"),
            ("mm", "is not a number"),
            ("", "is not a number"),
            ("1.2.3mm", "is not a number"),
            ("20deg", "is an angle, expected a length"),
        ] {
            let error = positive_length(text).unwrap_err();
            assert!(error.contains(message), "{text}: {error}");
        }
        let error = three_angles("180,0,0").unwrap_err();
        assert_eq!(error, "\"180\" needs a unit: 180deg, or 3.1416rad");
        assert_eq!(length_with_unit("20").unwrap_err(), "\"20\" needs a unit: 20mm or 20m");
        assert_eq!(length_with_unit("20mm"), Ok(0.02));
        assert!(three_lengths("1,2").unwrap_err().contains("2 values, expected three"));
        let error = three_lengths("350mm 100mm 450mm").unwrap_err();
        assert_eq!(error, "separate the values with commas: 350mm,100mm,450mm");
        let error = three_lengths("350,100,450mm").unwrap_err();
        assert_eq!(error, "only some values have a unit: write 350mm,100mm,450mm");
    }
}
