//! Which column of a table has the times of its rows, and in which unit.

use super::{
    head::TableHead,
    number::time_ns,
    number::{CellValue, cell_value},
};
use crate::table_reading::{DecimalMark, TimeUnit, TimeUnitFrom};

/// A column with times.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TimeColumn {
    pub(super) column: usize,
    pub(super) unit: TimeUnit,
    pub(super) unit_from: TimeUnitFrom,
}

/// What was found in a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum FoundTime {
    Column(TimeColumn),
    /// A column that is named as one, in which most rows have the time of the row before.
    Coarse(usize),
    /// A column that is named as one, whose cells are not numbers, as dates in ISO 8601.
    NoNumbers(usize),
    None,
}

/// Names of columns with times, without their unit.
const NAMES: [&str; 13] = [
    "time",
    "zeit",
    "t",
    "timestamp",
    "stamp",
    "times",
    "timestamps",
    "elapsed",
    "elapsedtime",
    "robottime",
    "recvtimestamp",
    "timesec",
    "logtime",
];
const UNITS: [(&str, TimeUnit); 13] = [
    ("s", TimeUnit::Second),
    ("sec", TimeUnit::Second),
    ("secs", TimeUnit::Second),
    ("seconds", TimeUnit::Second),
    ("ms", TimeUnit::Millisecond),
    ("msec", TimeUnit::Millisecond),
    ("milliseconds", TimeUnit::Millisecond),
    ("us", TimeUnit::Microsecond),
    ("usec", TimeUnit::Microsecond),
    ("microseconds", TimeUnit::Microsecond),
    ("ns", TimeUnit::Nanosecond),
    ("nsec", TimeUnit::Nanosecond),
    ("nanoseconds", TimeUnit::Nanosecond),
];

/// Finds the times of a table.
pub(super) fn find_time(head: &TableHead) -> FoundTime {
    let Some(names) = &head.names else { return first_column(head) };
    let named = names.iter().enumerate().filter_map(|(column, name)| Some((column, named_time(name)?)));
    let mut unusable = FoundTime::None;
    for (column, NamedTime { stated }) in named {
        let values = values(head, column);
        let steps: Vec<f64> = values.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let moving = steps.iter().filter(|step| **step > 0.0).count();
        // Times in whole seconds, or a date that a spreadsheet has rounded.
        if !steps.is_empty() && 2 * moving >= steps.len() {
            let (unit, unit_from) =
                stated.map_or_else(|| guessed(&values, &steps), |unit| (unit, TimeUnitFrom::Name));
            return FoundTime::Column(TimeColumn { column, unit, unit_from });
        }
        if unusable == FoundTime::None {
            let is_text = values.is_empty();
            unusable = if is_text { FoundTime::NoNumbers(column) } else { FoundTime::Coarse(column) };
        }
    }
    unusable
}

/// Without names the first column is time if it advances evenly.
fn first_column(head: &TableHead) -> FoundTime {
    let values = values(head, 0);
    let steps: Vec<f64> = values.windows(2).map(|pair| pair[1] - pair[0]).collect();
    if !is_even(&steps) {
        return FoundTime::None;
    }
    let (unit, unit_from) = guessed(&values, &steps);
    FoundTime::Column(TimeColumn { column: 0, unit, unit_from })
}

/// The name of a time, with the unit that it states.
struct NamedTime {
    stated: Option<TimeUnit>,
}

/// Reads the name of a column; `None` if it is no name of a time.
fn named_time(name: &str) -> Option<NamedTime> {
    let lower = name.to_lowercase();
    let words: Vec<&str> =
        lower.split(|letter: char| !letter.is_alphanumeric()).filter(|word| !word.is_empty()).collect();
    let unit = |word: &str| UNITS.iter().find(|(name, _)| *name == word).map(|(_, unit)| *unit);
    let stated = words.last().and_then(|word| unit(word)).filter(|_| words.len() > 1);
    let words = &words[..words.len() - usize::from(stated.is_some())];
    let is_time =
        NAMES.contains(&words.concat().as_str()) || words.last().is_some_and(|word| NAMES.contains(word));
    is_time.then_some(NamedTime { stated })
}

fn values(head: &TableHead, column: usize) -> Vec<f64> {
    let number = |row: &Vec<String>| match cell_value(row.get(column)?, head.decimal) {
        CellValue::Number(number) if number.is_finite() => Some(number),
        _ => None,
    };
    head.rows.iter().filter_map(number).collect()
}

/// The unit of times by their values, or by their steps.
fn guessed(values: &[f64], steps: &[f64]) -> (TimeUnit, TimeUnitFrom) {
    /// Times since 1970 from the year 1990 to 2100, s.
    const SINCE_1970_S: [f64; 2] = [6.3e8, 4.1e9];
    /// The longest step of a recorder that writes dates, s. Kind: choice.
    const LONGEST_DATED_STEP_S: f64 = 60.0;
    /// The longest step of a recorder that is expected, s: 2 Hz.
    const LONGEST_STEP_S: f64 = 0.5;
    let units = [TimeUnit::Second, TimeUnit::Millisecond, TimeUnit::Microsecond, TimeUnit::Nanosecond];
    let first = values.first().copied().unwrap_or_default();
    let step = median_step(steps);
    // Microseconds since a start may look like a date in seconds; their steps are then hours.
    let is_date = |unit: &TimeUnit| {
        let in_s = unit.ns() / 1e9;
        (SINCE_1970_S[0]..SINCE_1970_S[1]).contains(&(first * in_s)) && step * in_s <= LONGEST_DATED_STEP_S
    };
    if let Some(unit) = units.into_iter().find(is_date) {
        return (unit, TimeUnitFrom::Values);
    }
    let is_step = |unit: &TimeUnit| step * (unit.ns() / 1e9) <= LONGEST_STEP_S;
    (units.into_iter().find(is_step).unwrap_or(TimeUnit::Nanosecond), TimeUnitFrom::Steps)
}

/// The median of those steps that advance.
fn median_step(steps: &[f64]) -> f64 {
    let mut forward: Vec<f64> = steps.iter().copied().filter(|step| *step > 0.0).collect();
    forward.sort_by(f64::total_cmp);
    forward.get(forward.len() / 2).copied().unwrap_or_default()
}

/// Whether a column advances as a clock does: a joint that turns at a constant speed does so for a while only.
fn is_even(steps: &[f64]) -> bool {
    /// Rows below which nothing is concluded.
    const LEAST_STEPS: usize = 3;
    /// Factor by which steps of a recorder differ from their median. Kind: choice; 2 to 30 ms were met at 125 Hz.
    const FACTOR: f64 = 4.0;
    let median = median_step(steps);
    // Rows may be repeated: up to a sixth of those of a recorder that asks faster than the robot answers.
    let forward = steps.iter().filter(|step| **step > 0.0);
    let even = forward.clone().filter(|step| **step < median * FACTOR && **step > median / FACTOR);
    steps.len() >= LEAST_STEPS
        && steps.iter().all(|step| *step >= 0.0)
        && forward.clone().count() * 4 >= steps.len() * 3
        && even.count() * 10 >= forward.count() * 9
}

impl TimeColumn {
    /// The time in a row, ns.
    pub(super) fn ns(&self, row: &[String], decimal: DecimalMark) -> Option<i64> {
        time_ns(row.get(self.column)?, decimal, self.unit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::csv::Dialect;

    #[track_caller]
    fn check(table: &str, expected: Option<(usize, TimeUnit, TimeUnitFrom)>) {
        let found = find_time(&Dialect::of(table.as_bytes()).unwrap().head);
        let found = match found {
            FoundTime::Column(TimeColumn { column, unit, unit_from }) => Some((column, unit, unit_from)),
            _ => None,
        };
        assert_eq!(found, expected, "{table}");
    }

    #[test]
    fn units_by_name_value_and_step() {
        use {TimeUnit::*, TimeUnitFrom::*};
        check("time_ms,q\n0,1\n8,1\n16,1\n", Some((0, Millisecond, Name)));
        check("q,t\n1,0\n1,0.008\n1,0.016\n", Some((1, Second, Steps)));
        check("t,q\n1500000000,1\n1500008000,1\n1500016000,1\n", Some((0, Microsecond, Steps)));
        check(
            "timestamp,t,q\n2025-10-09T08:53:20Z,0,1\n2025-10-09T08:53:20Z,0.1,1\n",
            Some((1, Second, Steps)),
        );
        check("0.000 1\n0.008 2\n0.008 2\n0.016 0\n0.024 0\n0.032 0\n", Some((0, Second, Steps)));
        check("timestamp,q\n1760000000.5,1\n1760000000.6,1\n", Some((0, Second, Values)));
        check("timestamp,q\n1760000000500000000,1\n1760000000600000000,1\n", Some((0, Nanosecond, Values)));
        check("t,q\n0,1\n8,1\n16,1\n", Some((0, Millisecond, Steps)));
        check("t,q\n0,1\n2000,1\n4000,1\n", Some((0, Microsecond, Steps)));
        check("header.stamp,q\n0,1\n0.1,1\n", Some((0, Second, Steps)));
        check("0.000 1\n0.008 2\n0.016 0\n0.024 0\n", Some((0, Second, Steps)));
    }

    #[test]
    fn what_is_no_time() {
        check("a,b\n0,1\n1,2\n", None);
        check("0.5 1\n0.5 2\n0.4 0\n0.1 0\n", None);
        let coarse = Dialect::of(b"t,q\n3,1\n3,1\n3,1\n4,1\n4,1\n").unwrap();
        assert_eq!(find_time(&coarse.head), FoundTime::Coarse(0));
        let dates = Dialect::of(b"time,q,dq\n2025-10-09,3,1\n2025-10-10,3,1\n").unwrap();
        assert_eq!(find_time(&dates.head), FoundTime::NoNumbers(0));
    }
}
