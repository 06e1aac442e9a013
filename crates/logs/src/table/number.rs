//! Numbers in the cells of a table.

use crate::table_reading::{DecimalMark, TimeUnit};

/// Words for a value that is not there.
const MISSING: [&str; 6] = ["null", "none", "n/a", "na", "nil", "-"];

/// How a cell reads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum CellValue {
    Number(f64),
    /// Empty, or a word for it.
    Missing,
    NotANumber,
}

/// Reads a cell.
pub(crate) fn cell_value(cell: &str, decimal: DecimalMark) -> CellValue {
    let cell = cell.trim().trim_matches('"');
    let parsed = if decimal == DecimalMark::Comma && cell.contains(',') {
        cell.replacen(',', ".", 1).parse()
    } else {
        cell.parse()
    };
    match parsed {
        Ok(number) => CellValue::Number(number),
        Err(_) if cell.is_empty() || MISSING.contains(&cell.to_lowercase().as_str()) => CellValue::Missing,
        Err(_) => CellValue::NotANumber,
    }
}

/// A time in nanoseconds, exact if it is written without an exponent: as a float, a time since 1970 in s has 0.2 us.
pub(super) fn time_ns(cell: &str, decimal: DecimalMark, unit: TimeUnit) -> Option<i64> {
    let cell = cell.trim().trim_matches('"');
    let point = if decimal == DecimalMark::Comma { ',' } else { '.' };
    let (sign, digits) = cell.strip_prefix('-').map_or((1, cell), |rest| (-1, rest));
    let (whole, fraction) = digits.split_once(point).unwrap_or((digits, ""));
    let is_plain = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit());
    if whole.is_empty() || whole.len() > 20 || !is_plain(whole) || !is_plain(fraction) {
        return rounded_ns(cell, decimal, unit);
    }
    let decimals = unit.decimals_to_ns();
    let mut ns = whole.parse::<i128>().ok()?;
    let mut fraction = fraction.bytes();
    for _ in 0..decimals {
        ns = ns * 10 + i128::from(fraction.next().unwrap_or(b'0') - b'0');
    }
    i64::try_from(sign * ns).ok()
}

fn rounded_ns(cell: &str, decimal: DecimalMark, unit: TimeUnit) -> Option<i64> {
    /// Times since 1970 in ns, until the year 2262.
    const MOST_NS: f64 = 9.2e18;
    let CellValue::Number(number) = cell_value(cell, decimal) else { return None };
    let ns = (number * unit.ns()).round();
    #[expect(clippy::cast_possible_truncation, reason = "within the range of i64")]
    (ns.abs() <= MOST_NS).then_some(ns as i64)
}

impl TimeUnit {
    /// Decimal places from this unit to nanoseconds.
    fn decimals_to_ns(self) -> usize {
        match self {
            Self::Second => 9,
            Self::Millisecond => 6,
            Self::Microsecond => 3,
            Self::Nanosecond => 0,
        }
    }

    /// Nanoseconds of one.
    pub(super) fn ns(self) -> f64 {
        [1.0, 1e3, 1e6, 1e9][self.decimals_to_ns() / 3]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimal_commas_and_words_for_nothing() {
        assert_eq!(cell_value(" -1,5E-3", DecimalMark::Comma), CellValue::Number(-0.0015));
        assert_eq!(cell_value("1,5", DecimalMark::Point), CellValue::NotANumber);
        assert!(matches!(cell_value("nan", DecimalMark::Point), CellValue::Number(value) if value.is_nan()));
        assert_eq!(
            [cell_value("", DecimalMark::Point), cell_value("None", DecimalMark::Point)],
            [CellValue::Missing; 2]
        );
    }

    #[test]
    fn times_since_1970_keep_their_nanoseconds() {
        let time = |cell, unit| time_ns(cell, DecimalMark::Point, unit);
        assert_eq!(time("1760000000.123456789", TimeUnit::Second), Some(1_760_000_000_123_456_789));
        assert_eq!(time("-0.5", TimeUnit::Millisecond), Some(-500_000));
        assert_eq!(time("2.5e3", TimeUnit::Microsecond), Some(2_500_000));
        assert_eq!(time("1e300", TimeUnit::Second), None);
        assert_eq!(time("99999999999999999999", TimeUnit::Second), None);
        assert_eq!(time("abc", TimeUnit::Second), None);
        assert_eq!(time_ns("0,25", DecimalMark::Comma, TimeUnit::Second), Some(250_000_000));
    }
}
