//! What the checks measure over time: for each quantity the worst value since the recorded time before, beside its limit.

use congruent_description::Robot;
use congruent_input::{Quantity, SiUnit};
use congruent_monitors::{
    RecordingError,
    verdict::{CheckValue, InstantValue},
};
use congruent_results::report::quantity_words;
use congruent_scenario::CheckKind;
use re_sdk_types::archetypes::SeriesLines;

use super::scalars::write_scalars;
use crate::{
    rrd::{
        paths,
        times::{SampleTime, SampleTimes},
        writer::RrdWriter,
    },
    scene::palette,
};

/// Width of a line on the screen.
const WIDTH_UI_POINTS: f32 = 1.5;

/// One quantity of one check.
#[derive(Debug)]
struct QuantityLine {
    check: usize,
    of: InstantValue,
    /// Whether there was a value since the recorded time before; it is `of`.
    is_new: bool,
    times: SampleTimes,
    values: Vec<f64>,
    /// Kind of the check with its number, and the quantity with its unit.
    path: [String; 2],
    has_name: bool,
    /// The last value of the quantity, in its unit.
    last: f64,
}

/// All quantities of all checks.
#[derive(Debug, Default)]
pub(crate) struct CheckSeries {
    lines: Vec<QuantityLine>,
}

/// The link that a value outside its limit is about: that of a joint, or a link itself.
pub(crate) fn violating_link(value: &CheckValue, robot: &Robot) -> Option<usize> {
    let InstantValue { quantity, bound, limit, value: measured, subject, .. } = value.of;
    if bound.holds(measured, limit) {
        return None;
    }
    match value.kind {
        CheckKind::Twist => Some(subject),
        CheckKind::Tracking if quantity.is_of_tcp() => Some(subject),
        CheckKind::Dynamics | CheckKind::Effort | CheckKind::Limits | CheckKind::Tracking => {
            // Beyond the last joint there is the sum of all.
            let &joint = robot.movable_joints().get(subject)?;
            Some(robot.joint(joint).child.get())
        }
        _ => None,
    }
}

/// The two parts of a path that identify a quantity of a check, by its number from 0: kind with number, quantity with
/// unit.
pub(crate) fn path_parts(check: usize, kind: CheckKind, quantity: Quantity, unit: SiUnit) -> [String; 2] {
    let unit = unit.symbol().replace([' ', '/'], "_");
    let quantity = if unit.is_empty() { quantity.name().to_owned() } else { format!("{quantity}_{unit}") };
    [format!("{}_{}", check + 1, kind.word()), quantity]
}

impl CheckSeries {
    /// Takes the values of a sample, recorded or not.
    pub(crate) fn observe(&mut self, values: &[CheckValue]) {
        for value in values {
            let is_same = |line: &&mut QuantityLine| {
                let of = &line.of;
                (line.check, of.quantity, of.unit) == (value.check, value.of.quantity, value.of.unit)
            };
            match self.lines.iter_mut().find(is_same) {
                Some(line) => {
                    // The first value since the recorded time replaces the old one, even if it is better.
                    if !line.is_new || line.of.bound.is_worse(value.of.value, line.of.value) {
                        line.of.value = value.of.value;
                    }
                    line.is_new = true;
                    line.last = value.of.value;
                }
                None => self.lines.push(QuantityLine::new(value)),
            }
        }
    }

    /// Whether a quantity is outside its limit at the last sample that has it.
    pub(crate) fn is_any_outside(&self) -> bool {
        self.lines.iter().any(|line| !line.of.bound.holds(line.last, line.of.limit))
    }

    /// Adds a row of the worst values.
    pub(crate) fn push(&mut self, time: SampleTime) {
        for line in self.lines.iter_mut().filter(|line| line.is_new) {
            line.times.push(time);
            line.values.push(line.of.value);
            line.is_new = false;
        }
    }

    /// The parts of the paths of all quantities so far.
    pub(crate) fn recorded(&self) -> Vec<[String; 2]> {
        self.lines.iter().map(|line| line.path.clone()).collect()
    }

    /// Writes all rows and removes them.
    pub(crate) fn write(&mut self, writer: &mut RrdWriter) -> Result<(), RecordingError> {
        self.lines.iter_mut().try_for_each(|line| line.write(writer))
    }
}

impl QuantityLine {
    fn new(value: &CheckValue) -> Self {
        Self {
            check: value.check,
            of: value.of,
            is_new: true,
            times: SampleTimes::default(),
            values: Vec::new(),
            path: path_parts(value.check, value.kind, value.of.quantity, value.of.unit),
            has_name: false,
            last: value.of.value,
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
            let name = quantity_words(self.of.quantity);
            let style = SeriesLines::new().with_names([name]).with_colors([palette::link(0)]);
            writer.log_static(&path, &style.with_widths([WIDTH_UI_POINTS]))?;
            self.has_name = true;
        }
        write_scalars(writer, &path, &self.times.columns(), self.values.iter().copied())?;
        self.times.clear();
        self.values.clear();
        Ok(())
    }
}
