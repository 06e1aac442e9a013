//! Numbers of an attribute, separated by white space.

/// Largest number. Kind: range of numbers; squares and products of two such numbers are finite, and no robot needs them.
const LARGEST: f64 = 1e100;

/// Which numbers an attribute takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum MjNumberKind {
    Real,
    Integer,
}

/// The numbers of a text that the grammar has accepted; what is not a number is left out.
pub(crate) fn numbers(text: &str) -> Vec<f64> {
    text.split_whitespace().filter_map(|token| token.parse().ok()).collect()
}

/// Why a token is not a number that can be used; `None` if it is one.
pub(super) fn fault(token: &str, kind: MjNumberKind) -> Option<&'static str> {
    match token.parse::<f64>() {
        Err(_) if token.contains(',') => {
            Some("is not a number: the decimal point is a dot, and spaces separate numbers")
        }
        Err(_) => Some("is not a number"),
        Ok(value) if !value.is_finite() => Some("is not a finite number"),
        Ok(value) if value.abs() > LARGEST => Some("is larger than 1e100"),
        Ok(_) if kind == MjNumberKind::Integer && token.parse::<i32>().is_err() => {
            Some("is not an integer of 32 bits")
        }
        Ok(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{MjNumberKind::*, *};

    #[test]
    fn numbers_are_separated_by_white_space() {
        assert_eq!(numbers(" +1 .5\t1.\n-2e-3 "), [1.0, 0.5, 1.0, -2e-3]);
        for (token, kind, expected) in [
            ("1,5", Real, "decimal point"),
            ("1d", Real, "not a number"),
            ("nan", Real, "not a finite"),
            ("1e400", Real, "not a finite"),
            ("1e200", Real, "larger"),
            ("1.5", Integer, "integer"),
        ] {
            assert!(fault(token, kind).is_some_and(|found| found.contains(expected)), "{token}");
        }
        assert_eq!(fault("0.5", Real).or(fault("-3", Integer)), None);
    }
}
