//! A table of joint positions over time, read from CSV: a header that names time and joints with their units, one instant
//! in each row.

use std::{ops::Range, sync::Arc};

use congruent_description::{Robot, RobotQ};
use congruent_input::{Diagnostic, SourceFile, display::quantity, known_names, units::Unit};
use congruent_scenario::OverLimit;

use crate::MotionLimits;

/// Largest table that is read.
pub(super) const MOST_BYTES: u64 = 256 << 20;
/// How far positions of a table may be from where they should be, rad or m. Kind: digits of a table.
pub(super) const SAME_PLACE: f64 = 1e-4;
/// The column of times.
const TIME: &str = "time_s";
/// Between the name of a joint and the position among other quantities, in the tables that runs write.
const POSITION: &str = ".q";

/// Columns without a joint in tables that runs write. Other columns that are ignored have a dot in their names.
const OF_THE_RUN: [&str; 7] = [
    "step",
    "position_error_m",
    "position_error_link",
    "orientation_error_rad",
    "orientation_error_link",
    "clearance_m",
    "clearance_pair",
];

/// Joint positions over time.
#[derive(Debug, Clone, PartialEq)]
pub struct JointTable {
    /// Times from the first row on, each later than the one before; at least two.
    pub times_s: Vec<f64>,
    /// Positions at these times.
    pub points: Vec<RobotQ>,
    /// Lines and columns of the values in the file.
    pub places: TablePlaces,
}

/// Lines and columns of a table, for messages.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TablePlaces {
    /// The line of each instant, from 1.
    lines: Vec<usize>,
    /// The name of the column of each coordinate; that of its master if it follows another joint.
    columns: Vec<Option<String>>,
}

impl TablePlaces {
    /// The end of a message: the lines before and after an instant, and the column of a joint.
    pub(super) fn between(&self, joint: usize, next: usize) -> String {
        let column = self.column(joint);
        let next = next.clamp(1, self.lines.len().max(2) - 1);
        match self.lines.get(next - 1..=next) {
            Some([before, after]) => format!(" (between lines {before} and {after}{column})"),
            _ => String::new(),
        }
    }

    fn column(&self, joint: usize) -> String {
        let name = self.columns.get(joint).and_then(Option::as_ref);
        name.map_or_else(String::new, |name| format!(", column \"{name}\""))
    }
}

/// A column that is used, and how its values become SI.
struct PositionColumn {
    cell: usize,
    coordinate: usize,
    engineering_unit: Option<Unit>,
}

/// A line of the file that is not a comment.
struct TableRow<'a> {
    number: usize,
    span: Range<usize>,
    cells: Vec<&'a str>,
}

impl JointTable {
    /// Reads a table; joints without a column stay where `from` has them.
    ///
    /// # Errors
    /// A column or a number is wrong, times do not increase, or a joint would have to move
    /// faster than its limit from one row to the next.
    pub(super) fn read(
        source: &Arc<SourceFile>,
        (robot, limits): (&Robot, &MotionLimits),
        from: &RobotQ,
    ) -> Result<Self, Diagnostic> {
        Self::parse(source, (robot, limits), from).map_err(|fault| fault.in_file(source))
    }

    fn parse(
        source: &SourceFile,
        (robot, limits): (&Robot, &MotionLimits),
        from: &RobotQ,
    ) -> Result<Self, Diagnostic> {
        let mut rows = rows(&source.text);
        let header = rows.next().ok_or_else(|| fault("the table has no header", 0..0))?;
        let time = header.cells.iter().position(|&name| name == TIME);
        let time = time.ok_or_else(|| fault("the table has no column time_s", header.span.clone()))?;
        let columns = columns(&header, robot)?;
        let names = |coordinate: usize| {
            let master = robot.joint(robot.movable_joints()[coordinate]).mimic.map(|mimic| mimic.master);
            let coordinate = master.and_then(|master| robot.coordinate(master)).unwrap_or(coordinate);
            let column = columns.iter().find(|column| column.coordinate == coordinate)?;
            Some(header.cells[column.cell].to_owned())
        };
        let places = TablePlaces { lines: Vec::new(), columns: (0..robot.dof()).map(names).collect() };
        let mut table = Self { times_s: Vec::new(), points: Vec::new(), places };
        for row in rows {
            if row.cells.len() != header.cells.len() {
                let (found, expected) = (row.cells.len(), header.cells.len());
                let message = format!("line {}: {found} cells, the header has {expected}", row.number);
                return Err(fault(&message, row.span));
            }
            let time_s = row.number_in(time)?;
            let mut q = from.clone();
            for column in &columns {
                let value = row.number_in(column.cell)?;
                q[column.coordinate] = column.engineering_unit.map_or(value, |unit| unit.convert(value));
            }
            robot.apply_mimic(&mut q);
            row.check_range(&q, robot, &table.places)?;
            table.follow(&row, (time_s, &q), (robot, limits))?;
            table.times_s.push(time_s);
            table.points.push(q);
            table.places.lines.push(row.number);
        }
        if table.points.len() < 2 {
            return Err(fault("the table has fewer than two rows of positions", header.span));
        }
        let first_s = table.times_s[0];
        table.times_s.iter_mut().for_each(|time_s| *time_s -= first_s);
        Ok(table)
    }

    /// Refuses a row that does not follow on the one before.
    fn follow(
        &self,
        row: &TableRow<'_>,
        (time_s, q): (f64, &RobotQ),
        (robot, limits): (&Robot, &MotionLimits),
    ) -> Result<(), Diagnostic> {
        let (Some(&before_s), Some(before)) = (self.times_s.last(), self.points.last()) else {
            return Ok(());
        };
        if time_s <= before_s {
            let message = format!("line {}: time {time_s} s is not after {before_s} s", row.number);
            return Err(fault(&message, row.span.clone()));
        }
        // With "slow" or "warn" the whole move is compared with the limits later: a single row would be refused too early.
        if limits.over_limit != OverLimit::Refuse {
            return Ok(());
        }
        let speed = |joint: usize| (q[joint] - before[joint]).abs() / (time_s - before_s);
        // A table has few digits: half a unit of the fourth is no jump.
        let jumps = |joint: &usize| speed(*joint) > limits.velocity[*joint] * 1.0005;
        let Some(joint) = (0..q.len()).find(jumps) else { return Ok(()) };
        let described = robot.joint(robot.movable_joints()[joint]);
        let unit = described.kind.unit();
        let [distance, interval] = [(q[joint] - before[joint], unit), (time_s - before_s, "s")]
            .map(|(value, unit)| quantity(value, unit));
        let [speed, limit] =
            [speed(joint), limits.velocity[joint]].map(|value| quantity(value, &format!("{unit}/s")));
        let message = format!(
            "line {}{}: joint \"{}\" jumps by {distance} in {interval}: {speed}, its limit is {limit}",
            row.number,
            self.places.column(joint),
            described.name
        );
        let error = Diagnostic::error("scenario::playback_jump", message).at(row.span.clone());
        Err(error
            .with_help("give the row more time, or write over_limit = \"slow\" or \"warn\" under [limits]"))
    }
}

impl TableRow<'_> {
    /// Refuses positions outside the range of a joint.
    fn check_range(&self, q: &RobotQ, robot: &Robot, places: &TablePlaces) -> Result<(), Diagnostic> {
        for (coordinate, (&joint, &position)) in robot.movable_joints().iter().zip(q).enumerate() {
            let joint = robot.joint(joint);
            let Some((lower, upper)) = joint.position_range() else { continue };
            if position < lower - SAME_PLACE || position > upper + SAME_PLACE {
                let unit = joint.kind.unit();
                let [position, lower, upper] = [position, lower, upper].map(|value| quantity(value, unit));
                let message = format!(
                    "line {}{}: joint \"{}\" is at {position}, outside its range of {lower} to {upper}",
                    self.number,
                    places.column(coordinate),
                    joint.name
                );
                return Err(Diagnostic::error("scenario::playback_range", message).at(self.span.clone()));
            }
        }
        Ok(())
    }

    fn number_in(&self, cell: usize) -> Result<f64, Diagnostic> {
        let written = self.cells[cell];
        written.parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(|| {
            let message = format!("line {}: \"{written}\" is not a finite number", self.number);
            fault(&message, self.span.clone())
        })
    }
}

/// All lines except empty ones and comments.
fn rows(text: &str) -> impl Iterator<Item = TableRow<'_>> {
    let mut start = 0;
    let lines = text.split_inclusive('\n').enumerate().map(move |(index, whole)| {
        let line = whole.trim_end_matches(['\n', '\r']);
        let span = start..start + line.len();
        start += whole.len();
        (index, line, span)
    });
    lines.filter(|(_, line, _)| !line.trim().is_empty() && !line.starts_with('#')).map(
        |(index, line, span)| {
            // A comma inside quotes does not separate cells (RFC 4180): joint names may contain one.
            let mut is_quoted = false;
            let separates = |character| {
                is_quoted ^= character == '"';
                character == ',' && !is_quoted
            };
            let cells = line.split(separates).map(|cell| cell.trim().trim_matches('"')).collect();
            TableRow { number: index + 1, span, cells }
        },
    )
}

/// The columns of positions; other quantities in a table that a run has written are ignored.
fn columns(header: &TableRow<'_>, robot: &Robot) -> Result<Vec<PositionColumn>, Diagnostic> {
    let mut columns: Vec<PositionColumn> = Vec::new();
    for (cell, name) in header.cells.iter().enumerate().filter(|(_, name)| **name != TIME) {
        let units = [
            ("_rad", true, None),
            ("_deg", true, Some(Unit::Angle)),
            ("_mm", false, Some(Unit::Length)),
            ("_m", false, None),
        ];
        let unit = units.iter().find_map(|(suffix, turns, engineering_unit)| {
            Some((name.strip_suffix(suffix)?, *turns, *engineering_unit))
        });
        let (stem, turns, engineering_unit) = match unit {
            Some((stem, turns, engineering_unit)) => {
                (stem.strip_suffix(POSITION).unwrap_or(stem), turns, engineering_unit)
            }
            None if is_other_quantity(name, robot) => continue,
            None => return Err(unknown(name, header, robot)),
        };
        let joint =
            robot.find_joint(stem).and_then(|joint| Some((robot.joint(joint), robot.coordinate(joint)?)));
        let Some((joint, coordinate)) = joint else {
            if is_other_quantity(name, robot) {
                continue;
            }
            return Err(unknown(name, header, robot));
        };
        if joint.kind.is_angular() != turns {
            let (what, keys) = if turns { ("slides", "_m or _mm") } else { ("turns", "_deg or _rad") };
            let message = format!("column \"{name}\": the joint {what}, so its column must end in {keys}");
            return Err(fault(&message, header.span.clone()));
        }
        if columns.iter().any(|known| known.coordinate == coordinate) {
            return Err(fault(&format!("joint \"{stem}\" has two columns"), header.span.clone()));
        }
        if joint.mimic.is_none() {
            columns.push(PositionColumn { cell, coordinate, engineering_unit });
        }
    }
    if columns.is_empty() {
        return Err(fault("the table has no column of a joint", header.span.clone()));
    }
    Ok(columns)
}

/// Whether a column is one that runs write in addition to positions: `joint.qd_rad_s`, `clearance_m`.
fn is_other_quantity(name: &str, robot: &Robot) -> bool {
    let is_dotted = name.split_once('.').is_some_and(|(_, quantity)| !quantity.starts_with("q_"));
    (is_dotted || OF_THE_RUN.contains(&name)) && robot.find_joint(name).is_none()
}

fn unknown(name: &str, header: &TableRow<'_>, robot: &Robot) -> Diagnostic {
    let message = format!("column \"{name}\" is not the name of a joint with a unit");
    let known = known_names(name, "joints", robot.movable_joint_names());
    fault(&message, header.span.clone())
        .with_help(format!("{known}; name a column JOINT_deg, _rad, _m or _mm"))
}

fn fault(message: &str, span: Range<usize>) -> Diagnostic {
    Diagnostic::error("scenario::playback", message.to_owned()).at(span)
}
