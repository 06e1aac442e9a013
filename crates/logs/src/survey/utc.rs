//! A time since 1970 as a date.

/// `2025-10-09T08:53:20Z`; `None` before 1990, for clocks that start at 0.
pub(super) fn date(ns: i64) -> Option<String> {
    /// 1990-01-01, s since 1970.
    const LEAST_S: i64 = 631_152_000;
    const DAY_S: i64 = 86_400;
    let seconds = ns.div_euclid(1_000_000_000);
    if seconds < LEAST_S {
        return None;
    }
    let (mut days, rest) = (seconds / DAY_S, seconds % DAY_S);
    let mut year = 1970;
    while days >= days_of_year(year) {
        days -= days_of_year(year);
        year += 1;
    }
    let february = if days_of_year(year) == 366 { 29 } else { 28 };
    let mut month = 1;
    for length in [31, february, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31] {
        if days < length {
            break;
        }
        days -= length;
        month += 1;
    }
    let (hour, minute, second) = (rest / 3600, rest / 60 % 60, rest % 60);
    Some(format!("{year}-{month:02}-{:02}T{hour:02}:{minute:02}:{second:02}Z", days + 1))
}

fn days_of_year(year: i64) -> i64 {
    let is_leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    if is_leap { 366 } else { 365 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates() {
        let date_of = |seconds: i64| date(seconds * 1_000_000_000);
        assert_eq!(date_of(1_760_000_000).as_deref(), Some("2025-10-09T08:53:20Z"));
        assert_eq!(date_of(951_782_400).as_deref(), Some("2000-02-29T00:00:00Z"));
        assert_eq!(date_of(1_735_689_599).as_deref(), Some("2024-12-31T23:59:59Z"));
        assert_eq!(date_of(5), None);
        assert!(date(i64::MAX).is_some() && date(i64::MIN).is_none());
    }
}
