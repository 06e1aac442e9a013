//! A parameter that differs, as a sentence: both values with the digits that are written, their files, and the unit that a
//! factor between them suggests.

use congruent_description::PlaceElsewhere;
use congruent_input::{SiUnit, display::quantity_with_digits};

use super::sentences::with_distinct_digits;
use crate::differences::ParameterDifference;

/// A value with more significant digits was computed, not typed. Kind: choice.
const MOST_TYPED_DIGITS: usize = 8;
/// How far a ratio may be from a factor between units: three digits of a converted value. No unit, relative.
const ROUNDED: f64 = 5e-3;

/// Values of one link that are larger are in another unit. Kind: engineering; links of the heaviest six-axis arms, which carry a tonne,
/// have 900 kg, 1.5 m and 400 kg m^2.
const LARGEST_MASS_KG: f64 = 1000.0;
const LARGEST_LENGTH_M: f64 = 3.0;
const LARGEST_INERTIA_KG_M2: f64 = 500.0;

/// A factor between two values that is one between units.
struct OtherUnit {
    factor: &'static str,
    /// The unit that the larger value has, unless it is plausible as it is.
    unit: &'static str,
    larger: Larger,
}

/// The larger one of two values.
struct Larger {
    is_of_reference: bool,
    /// Whether a link of a robot may have it in SI units.
    is_plausible: bool,
}

impl ParameterDifference {
    /// `shoulder_link: mass is 2.63 kg, expected 3.76 kg`.
    pub fn sentence(&self) -> String {
        let [found, expected] = self.values("not given");
        self.about(&format!("{} is {found}, expected {expected}", self.parameter))
    }

    /// `link_2: mass 3.909 kg in a.urdf:5, 3.099 kg in b.urdf:5`, of two files of which either may be wrong.
    pub fn sentence_in(&self, [candidate, reference]: [&str; 2]) -> String {
        let [found, expected] = self.values("not given");
        let here = place_in(candidate, self.line, self.elsewhere.as_ref());
        let there = place_in(reference, self.expected_line, self.expected_elsewhere.as_ref());
        if self.is_computed {
            return self.about(&format!(
                "{} {found} in {here}, {expected} computed for {reference}",
                self.parameter
            ));
        }
        self.about(&format!("{} {found} in {here}, {expected} in {there}", self.parameter))
    }

    /// `a factor of 1000, grams?`, if such a factor is between the two.
    pub fn unit_remark(&self) -> Option<String> {
        let OtherUnit { factor, unit, larger } = self.other_unit()?;
        // A value that is plausible in SI units is not the one in another unit: the smaller one was converted although it was not.
        let how =
            if larger.is_plausible { format!("converted from {unit} twice?") } else { format!("{unit}?") };
        Some(format!("a factor of {factor}, {how}"))
    }

    /// Whether the reference seems to have the value in another unit, so that the candidate is right.
    pub fn is_reference_in_other_unit(&self) -> bool {
        self.other_unit().is_some_and(|of| of.larger.is_of_reference && !of.larger.is_plausible)
    }

    /// The factor between the two values, if it is one between units.
    fn other_unit(&self) -> Option<OtherUnit> {
        let (found, expected) = self.found.zip(self.expected)?;
        let is_of_reference = found.abs() < expected.abs();
        let (larger, smaller) = if is_of_reference { (expected, found) } else { (found, expected) };
        let (units, most): (&[(f64, &str, &str)], f64) = match self.unit {
            SiUnit::Kilogram => (&[(1e3, "1000", "grams")], LARGEST_MASS_KG),
            SiUnit::Metre => (&[(1e3, "1000", "millimetres")], LARGEST_LENGTH_M),
            SiUnit::KilogramSquareMetre => (
                &[(1e3, "1000", "g m^2"), (1e6, "1,000,000", "kg mm^2"), (1e9, "1,000,000,000", "g mm^2")],
                LARGEST_INERTIA_KG_M2,
            ),
            _ => return None,
        };
        let is_near = |factor: f64| (larger / smaller / factor - 1.0).abs() < ROUNDED;
        let (_, factor, unit) = *units.iter().find(|(factor, ..)| is_near(*factor))?;
        Some(OtherUnit {
            factor,
            unit,
            larger: Larger { is_of_reference, is_plausible: larger.abs() <= most },
        })
    }

    fn about(&self, what: &str) -> String {
        if self.of.is_empty() { what.to_owned() } else { format!("{}: {what}", self.of) }
    }

    /// Both values with all digits that are written, since transposed ones are seen in the last of them; of computed values
    /// those that distinguish the two.
    fn values(&self, nothing: &str) -> [String; 2] {
        let (both, unit) = ([self.found, self.expected], self.unit.symbol());
        if !both.iter().flatten().all(|value| is_typed(*value)) {
            return with_distinct_digits(self.found, self.expected, unit, nothing);
        }
        both.map(|value| match value {
            None => nothing.to_owned(),
            // As elsewhere, lengths of ten metres and more, which no robot has, are in m.
            Some(metres) if self.unit == SiUnit::Metre && metres.abs() < 10.0 => {
                quantity_with_digits(metres * 1e3, "mm", MOST_TYPED_DIGITS)
            }
            Some(value) => quantity_with_digits(value, unit, MOST_TYPED_DIGITS),
        })
    }
}

/// `arm.urdf:5`, or the file alone if the line is not known.
pub(super) fn place_in(file: &str, line: Option<usize>, elsewhere: Option<&PlaceElsewhere>) -> String {
    match (elsewhere, line) {
        (Some(elsewhere), _) => elsewhere.in_words(file),
        (None, Some(line)) => format!("{file}:{line}"),
        (None, None) => file.to_owned(),
    }
}

/// Whether a value is one with few digits, up to the rounding of a product with a factor between units.
fn is_typed(value: f64) -> bool {
    /// Some units of the last place. No unit, relative; kind: rounding.
    const ROUNDING: f64 = 1e-14;
    let decimals = MOST_TYPED_DIGITS - 1;
    let typed: Option<f64> = format!("{value:.decimals$e}").parse().ok();
    typed.is_some_and(|typed| (typed - value).abs() <= ROUNDING * value.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn difference(parameter: &str, unit: SiUnit, found: f64, expected: f64) -> ParameterDifference {
        ParameterDifference {
            of: "link_2".to_owned(),
            parameter: parameter.to_owned(),
            found: Some(found),
            expected: Some(expected),
            unit,
            line: Some(5),
            expected_line: None,
            elsewhere: None,
            expected_elsewhere: None,
            below_resolution: None,
            is_computed: false,
            cancelled: None,
        }
    }

    #[test]
    fn written_digits_are_kept() {
        let mass = difference("mass", SiUnit::Kilogram, 3.909, 3.099);
        assert_eq!(mass.sentence(), "link_2: mass is 3.909 kg, expected 3.099 kg");
        let in_files = "link_2: mass 3.909 kg in a.urdf:5, 3.099 kg in b.urdf";
        assert_eq!(mass.sentence_in(["a.urdf", "b.urdf"]), in_files);
        let grams = difference("mass", SiUnit::Kilogram, 3909.0, 3909.0 * 0.001);
        assert_eq!(grams.sentence(), "link_2: mass is 3909 kg, expected 3.909 kg");
        let com = difference("com_x", SiUnit::Metre, 0.1234, 0.1243);
        assert_eq!(com.sentence(), "link_2: com_x is 123.4 mm, expected 124.3 mm");
        let fitted = difference("mass", SiUnit::Kilogram, 2.631, 3.761_234_567_89);
        assert_eq!(fitted.sentence(), "link_2: mass is 2.63 kg, expected 3.76 kg");
    }

    #[test]
    fn a_factor_between_units_is_named_in_both_directions() {
        let remark = |unit, found, expected| difference("x", unit, found, expected).unit_remark();
        let grams = Some("a factor of 1000, grams?".to_owned());
        assert_eq!(remark(SiUnit::Kilogram, 3.909, 3909.0), grams);
        assert_eq!(remark(SiUnit::Kilogram, 3909.0, 3.91), grams);
        assert!(difference("mass", SiUnit::Kilogram, 3.909, 3909.0).is_reference_in_other_unit());
        assert!(!difference("mass", SiUnit::Kilogram, 3909.0, 3.909).is_reference_in_other_unit());
        // An arm of grams is as wrong as one of tonnes.
        assert!(!difference("mass", SiUnit::Kilogram, 0.0027, 2.7).is_reference_in_other_unit());
        let twice = Some("a factor of 1000, converted from grams twice?".to_owned());
        assert_eq!(remark(SiUnit::Kilogram, 0.0027, 2.7), twice);
        let tensor = Some("a factor of 1,000,000, kg mm^2?".to_owned());
        assert_eq!(remark(SiUnit::KilogramSquareMetre, 60_300.0, 0.0603), tensor);
        assert_eq!(remark(SiUnit::Kilogram, 3.909, 3.099), None);
    }
}
