//! What the checks measure over time: for each quantity the worst value since the recorded time before, beside its limit.

use congruent_twin::{
    recorder::RecordingError,
    scenario::CheckKind,
    verdict::{CheckValue, InstantValue},
};
use re_sdk_types::archetypes::SeriesLines;

use super::scalars::write_scalars;
use crate::rrd::{
    paths,
    times::{SampleTime, SampleTimes},
    writer::RrdWriter,
};

/// One quantity of one check.
#[derive(Debug)]
struct Line {
    check: usize,
    of: InstantValue,
    /// Whether there was a value since the recorded time before; it is `of`.
    is_new: bool,
    times: SampleTimes,
    values: Vec<f64>,
    /// Kind of the check with its number, and the quantity with its unit.
    path: [String; 2],
    has_name: bool,
}

/// All quantities of all checks.
#[derive(Debug, Default)]
pub(crate) struct CheckSeries {
    lines: Vec<Line>,
}

/// The two parts of a path that tell a quantity of a check, by its number from 0: kind with number, quantity with unit.
pub(crate) fn path_parts(check: usize, kind: CheckKind, (quantity, unit): (&str, &str)) -> [String; 2] {
    let unit = unit.replace([' ', '/'], "_");
    let quantity = if unit.is_empty() { quantity.to_owned() } else { format!("{quantity}_{unit}") };
    [format!("{}_{}", check + 1, kind.word()), quantity]
}

impl CheckSeries {
    /// Takes the values of a sample, recorded or not.
    pub(crate) fn observe(&mut self, values: &[CheckValue]) {
        for value in values {
            let is_same = |line: &&mut Line| {
                let of = &line.of;
                (line.check, of.quantity, of.unit) == (value.check, value.of.quantity, value.of.unit)
            };
            match self.lines.iter_mut().find(is_same) {
                Some(line) => {
                    if !line.is_new || line.of.bound.is_worse(value.of.value, line.of.value) {
                        line.of.value = value.of.value;
                    }
                    line.is_new = true;
                }
                None => self.lines.push(Line::new(value)),
            }
        }
    }

    /// Adds a row of the worst values.
    pub(crate) fn push(&mut self, time: SampleTime) {
        for line in self.lines.iter_mut().filter(|line| line.is_new) {
            line.times.push(time);
            line.values.push(line.of.value);
            line.is_new = false;
        }
    }

    /// Writes all rows and removes them.
    pub(crate) fn write(&mut self, writer: &mut RrdWriter) -> Result<(), RecordingError> {
        self.lines.iter_mut().try_for_each(|line| line.write(writer))
    }
}

impl Line {
    fn new(value: &CheckValue) -> Self {
        Self {
            check: value.check,
            of: value.of,
            is_new: true,
            times: SampleTimes::default(),
            values: Vec::new(),
            path: path_parts(value.check, value.kind, (value.of.quantity, value.of.unit)),
            has_name: false,
        }
    }

    /// The first time also its name, with the limit.
    fn write(&mut self, writer: &mut RrdWriter) -> Result<(), RecordingError> {
        if self.times.is_empty() {
            return Ok(());
        }
        let [check, quantity] = &self.path;
        let path = paths::check(check, quantity);
        if !self.has_name {
            let InstantValue { bound, limit, unit, .. } = self.of;
            let name = format!("{quantity}, {} {limit} {unit}", bound.words());
            writer.log_static(&path, &SeriesLines::new().with_names([name.trim_end()]))?;
            self.has_name = true;
        }
        write_scalars(writer, &path, &self.times.columns(), self.values.iter().copied())?;
        self.times.clear();
        self.values.clear();
        Ok(())
    }
}
