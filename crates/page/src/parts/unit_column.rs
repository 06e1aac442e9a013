//! Columns of lengths or angles in one unit, that of the largest value, so that a reader compares numbers alone.

use congruent_input::display::number;

/// The unit of a column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct UnitColumn {
    /// The unit, for the heading.
    pub(crate) unit: &'static str,
    units_in_si: f64,
}

/// Units of lengths with the largest value from which on they are used. Unit: m.
const LENGTHS: [(f64, &str, f64); 4] =
    [(1e-4, "mm", 1e3), (1e-7, "um", 1e6), (1e-10, "nm", 1e9), (0.0, "pm", 1e12)];
/// The same of angles, in rad.
const ANGLES: [(f64, &str, f64); 4] = [
    (1e-6, "deg", 180.0 / std::f64::consts::PI),
    (1e-7, "urad", 1e6),
    (1e-10, "nrad", 1e9),
    (0.0, "prad", 1e12),
];

impl UnitColumn {
    /// A column of lengths, m.
    pub(crate) fn of_lengths(metres: impl Iterator<Item = f64>) -> Self {
        Self::new(&LENGTHS, metres)
    }

    /// A column of angles, rad.
    pub(crate) fn of_angles(radians: impl Iterator<Item = f64>) -> Self {
        Self::new(&ANGLES, radians)
    }

    fn new(steps: &[(f64, &'static str, f64)], values: impl Iterator<Item = f64>) -> Self {
        let largest =
            values.filter(|value| value.is_finite()).fold(0.0, |most: f64, value| most.max(value.abs()));
        // A column of zeros has the unit that engineers expect.
        let step = steps.iter().find(|(from, ..)| largest == 0.0 || largest >= *from);
        let &(_, unit, units_in_si) = step.unwrap_or(&steps[0]);
        Self { unit, units_in_si }
    }

    /// A value without the unit; what three decimals do not show is below them.
    pub(crate) fn words(&self, value: f64) -> String {
        // Three decimals; below 1 pm and 1 prad there is only rounding.
        let least = if self.unit.starts_with('p') { 1.0 } else { 1e-3 };
        match value * self.units_in_si {
            0.0 => "0".to_owned(),
            shown if shown.abs() < 0.9995 * least => format!("<{least}"),
            shown => number(shown),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_column_has_the_unit_of_its_largest_value() {
        let values = [1.912, 0.0003, 2e-13, 0.0];
        let column = UnitColumn::of_lengths(values.into_iter());
        assert_eq!(
            (column.unit, values.map(|value| column.words(value))),
            ("mm", ["1912", "0.3", "<0.001", "0"].map(str::to_owned))
        );
        let rounding = UnitColumn::of_angles([3e-16, 2.5e-12].into_iter());
        assert_eq!((rounding.unit, rounding.words(3e-16)), ("prad", "<1".to_owned()));
        assert_eq!(UnitColumn::of_lengths([0.0].into_iter()).unit, "mm");
    }
}
