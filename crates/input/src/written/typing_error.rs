//! How a wrong value may have come to be typed: its sign, its decimal point, or two digits in each other's place.

/// How a typed number differs from the right one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TypingError {
    /// The sign alone.
    OppositeSign,
    /// The decimal point alone, of a number with at least two digits.
    DecimalPoint,
    /// Two neighbouring digits are in each other's place.
    Transposed,
    /// One digit is another, or the only one is in another place.
    OneDigit,
}

impl TypingError {
    /// `None` if the two differ in more, or in nothing.
    ///
    /// # Examples
    /// ```
    /// use congruent_input::TypingError;
    /// assert_eq!(TypingError::between("324.5", "342.5"), Some(TypingError::Transposed));
    /// ```
    pub fn between(found: &str, expected: &str) -> Option<Self> {
        let (found, expected) = (TypedDecimal::new(found)?, TypedDecimal::new(expected)?);
        if found.digits.is_empty() || expected.digits.is_empty() {
            return None;
        }
        if found.digits == expected.digits && found.point == expected.point {
            return (found.is_negative != expected.is_negative).then_some(Self::OppositeSign);
        }
        if found.is_negative != expected.is_negative {
            return None;
        }
        // One digit says little: 3 and 30 are two values, 163.9 and 16.39 are a point in the wrong place.
        if found.digits == expected.digits {
            return Some(if found.digits.len() > 1 { Self::DecimalPoint } else { Self::OneDigit });
        }
        found.in_digits(&expected)
    }

    /// The same of a typed value and a fitted one, which has one decimal more than the typed one at most.
    pub fn between_values(typed: f64, fitted: f64) -> Option<Self> {
        let typed = typed.to_string();
        let decimals = typed.split_once('.').map_or(0, |(_, decimals)| decimals.len());
        Self::between(&typed, &format!("{fitted:.*}", decimals + 1))
    }

    /// In words behind the right value.
    pub fn in_words(self) -> Option<&'static str> {
        match self {
            Self::OppositeSign => Some("the opposite sign"),
            Self::DecimalPoint => Some("the decimal point is in another place"),
            Self::Transposed => Some("two digits are transposed"),
            // A person sees that at once.
            Self::OneDigit => None,
        }
    }
}

/// A number as it is typed.
struct TypedDecimal {
    is_negative: bool,
    /// Without leading and trailing zeros.
    digits: Vec<u8>,
    /// The place of the decimal point, counted from the first of the digits.
    point: isize,
}

impl TypedDecimal {
    /// The digits of a number in decimal notation, without an exponent.
    fn new(text: &str) -> Option<Self> {
        let text = text.trim();
        text.parse::<f64>().ok()?;
        let unsigned = text.trim_start_matches(['-', '+']);
        if !unsigned.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.') {
            return None;
        }
        let (whole, part) = unsigned.split_once('.').unwrap_or((unsigned, ""));
        let all: Vec<u8> = whole.bytes().chain(part.bytes()).collect();
        let zeros = all.iter().take_while(|&&digit| digit == b'0').count();
        let end = all.iter().rposition(|&digit| digit != b'0').map_or(zeros, |last| last + 1);
        let point = whole.len().cast_signed() - zeros.cast_signed();
        Some(Self { is_negative: text.starts_with('-'), digits: all[zeros..end.max(zeros)].to_vec(), point })
    }

    /// How the digits differ from other ones.
    fn in_digits(&self, other: &Self) -> Option<TypingError> {
        // Aligned at the decimal point: 0.0312 and 0.3012 differ in where their digits begin.
        let first = self.point.max(other.point);
        let last = [self, other].map(|of| of.digits.len().cast_signed() - of.point);
        let last = last[0].max(last[1]);
        let digit = |of: &Self, at: isize| {
            usize::try_from(of.point - at).ok().and_then(|at| of.digits.get(at)).copied().unwrap_or(b'0')
        };
        // Places count up from the decimal point: `first` is the leftmost digit, `1 - last` the rightmost.
        let places: Vec<isize> = (1 - last..=first).rev().collect();
        let differing: Vec<usize> =
            (0..places.len()).filter(|&at| digit(self, places[at]) != digit(other, places[at])).collect();
        let is_exchanged = |one: usize, two: usize| digit(self, places[one]) == digit(other, places[two]);
        match differing[..] {
            [_] => Some(TypingError::OneDigit),
            [one, two] if two == one + 1 && is_exchanged(one, two) && is_exchanged(two, one) => {
                Some(TypingError::Transposed)
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn is(found: &str, expected: &str, how: Option<TypingError>) {
        assert_eq!(TypingError::between(found, expected), how, "{found}, {expected}");
    }

    #[test]
    fn mistakes_in_one_or_two_digits_are_recognised() {
        use TypingError::{DecimalPoint, OneDigit, OppositeSign, Transposed};
        is("324.5", "342.5", Some(Transposed));
        is("-324.5", "-342.5", Some(Transposed));
        is("0.0312", "0.3012", Some(Transposed));
        is("0.0996", "0.0969", Some(Transposed));
        is("36.14", "361.4", Some(DecimalPoint));
        is("163.914", "163.941", Some(Transposed));
        is("901", "910", Some(Transposed));
        is("91", "910", Some(DecimalPoint));
        is("425", "-425.0", Some(OppositeSign));
        is("166.0", "126", Some(OneDigit));
        is("221.5", "220.5", Some(OneDigit));
        is("22", "14", None);
        is("324.5", "432.5", None);
        is("324.5", "342.4", None);
        is("-324.5", "342.5", None);
        is("3", "30", Some(OneDigit));
        is("0", "30", None);
        is("1e-3", "1e-2", None);
    }

    #[test]
    fn a_fitted_value_has_rounding() {
        assert_eq!(TypingError::between_values(0.166, 0.126_000_02), Some(TypingError::OneDigit));
        assert_eq!(TypingError::between_values(0.022, 0.014), None);
    }
}
