//! How a wrong value may have come to be typed: its sign, its decimal point, or two digits in each other's place.

/// What a typed value has otherwise than the expected one, both as `key = value`; `None` if they differ in more, or if the
/// keys have other units.
pub(super) fn typing_error(found: &str, expected: &str) -> Option<&'static str> {
    let ((key, found), (other_key, expected)) = (found.split_once(" = ")?, expected.split_once(" = ")?);
    let (found, expected) = (TypedDecimal::new(found)?, TypedDecimal::new(expected)?);
    if key != other_key || found.digits.is_empty() || expected.digits.is_empty() {
        return None;
    }
    let is_same_size = found.digits == expected.digits && found.point == expected.point;
    if is_same_size {
        return (found.is_negative != expected.is_negative).then_some("the opposite sign");
    }
    if found.is_negative != expected.is_negative {
        return None;
    }
    // One digit says little: 3 and 30 are two values, 163.9 and 16.39 are a point in the wrong place.
    if found.digits == expected.digits {
        return (found.digits.len() > 1).then_some("the decimal point is in another place");
    }
    found.is_transposed(&expected).then_some("two digits are transposed")
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

    /// Whether two neighbouring digits are exchanged.
    fn is_transposed(&self, other: &Self) -> bool {
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
        let [one, two] = differing[..] else { return false };
        two == one + 1
            && digit(self, places[one]) == digit(other, places[two])
            && digit(self, places[two]) == digit(other, places[one])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn is(found: &str, expected: &str, how: Option<&str>) {
        let [found, expected] = [found, expected].map(|value| format!("a_mm = {value}"));
        assert_eq!(typing_error(&found, &expected), how, "{found}, {expected}");
    }

    #[test]
    fn two_transposed_digits_are_recognised() {
        let transposed = Some("two digits are transposed");
        is("324.5", "342.5", transposed);
        is("-324.5", "-342.5", transposed);
        is("0.0312", "0.3012", transposed);
        is("0.0996", "0.0969", transposed);
        is("36.14", "361.4", Some("the decimal point is in another place"));
        is("163.914", "163.941", transposed);
        is("901", "910", transposed);
        is("91", "910", Some("the decimal point is in another place"));
        is("425", "-425.0", Some("the opposite sign"));
        is("324.5", "432.5", None);
        is("324.5", "342.4", None);
        is("-324.5", "342.5", None);
        is("3", "30", None);
        is("0", "30", None);
        is("1e-3", "1e-2", None);
    }

    #[test]
    fn another_unit_is_no_typing_error() {
        assert_eq!(typing_error("a_m = 324.5", "a_mm = 342.5"), None);
        assert_eq!(typing_error("a is not written (default 0)", "a_mm = 342.5"), None);
    }
}
