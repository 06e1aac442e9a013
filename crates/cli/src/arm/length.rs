//! Lengths on the command line.

use congruent::input::units::{Unit, WrittenUnit};

/// A positive length: `20mm`, `0.02m`, or in m without a unit.
pub(super) fn positive_length(text: &str) -> Result<f64, String> {
    let written = WrittenUnit::at_end(text).filter(|(_, unit)| unit.unit == Unit::Length);
    let (number, unit) = written.map_or((text, None), |(number, unit)| (number, Some(unit)));
    match number.trim().parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(unit.map_or(value, |unit| unit.to_si(value))),
        Ok(_) => Err("a length must be above 0".to_owned()),
        Err(_) => Err("expected a length such as 20mm or 0.02m".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units() {
        assert_eq!(["20mm", "20 mm", "0.02m", "0.02"].map(positive_length), [const { Ok(0.02) }; 4]);
        for wrong in ["0mm", "-1m", "inf", "NaN", "20cm", "mm", ""] {
            assert!(positive_length(wrong).is_err(), "{wrong}");
        }
    }
}
