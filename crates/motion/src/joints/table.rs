//! A table of joint positions over time, read from CSV or Parquet: a header that names time and joints with their units, one instant
//! in each row.

use std::sync::Arc;

use congruent_description::{Robot, RobotQ};
use congruent_input::{
    Diagnostic, SourceFile,
    display::{compared_quantities, quantity},
    known_names,
    units::{Unit, WrittenUnit},
};
use congruent_scenario::OverLimit;
use congruent_tables::{
    Header, Row, WrittenTable,
    run_columns::{POSITION, TIME, is_other_quantity},
};

use crate::{codes, planning::Planning};

/// Largest table that is read.
pub(super) const MOST_BYTES: u64 = 256 << 20;
/// How far positions of a table may be from where they should be, rad or m. Kind: digits of a table.
pub(super) const SAME_PLACE: f64 = 1e-4;
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
        // A time before the first or after the last row is between the two nearest ones.
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
    unit: WrittenUnit,
}

impl JointTable {
    /// Reads a table; joints without a column stay where the motion before has left them.
    ///
    /// # Errors
    /// A column or a number is wrong, times do not increase, or a joint would have to move
    /// faster than its limit from one row to the next.
    pub(super) fn read(source: &Arc<SourceFile>, planning: &Planning<'_>) -> Result<Self, Diagnostic> {
        Self::parse(source, planning).map_err(|fault| fault.in_file(source))
    }

    fn parse(source: &SourceFile, planning: &Planning<'_>) -> Result<Self, Diagnostic> {
        let robot = &planning.description.robot;
        let no_header = || Diagnostic::error(codes::scenario::PLAYBACK, "the table has no header").at(0..0);
        let WrittenTable { header, rows } =
            WrittenTable::read(&source.text, codes::scenario::PLAYBACK).ok_or_else(no_header)?;
        let time = header.names().position(|name| name == TIME);
        let time = time.ok_or_else(|| fault(&header, format!("the table has no column {TIME}")))?;
        let columns = columns(&header, robot)?;
        let names = |coordinate: usize| {
            // A follower's own column is ignored: messages name that of its master.
            let master = robot.joint(robot.movable_joints()[coordinate]).mimic.map(|mimic| mimic.master);
            let coordinate = master.and_then(|master| robot.coordinate(master)).unwrap_or(coordinate);
            let column = columns.iter().find(|column| column.coordinate == coordinate)?;
            header.names().nth(column.cell).map(str::to_owned)
        };
        let places = TablePlaces { lines: Vec::new(), columns: (0..robot.dof()).map(names).collect() };
        let mut table = Self { times_s: Vec::new(), points: Vec::new(), places };
        for row in rows {
            let row = row?;
            let time_s = header.needed_number(codes::scenario::PLAYBACK, &row, time)?;
            // Joints without a column stay where the motion begins.
            let mut q = planning.from.clone();
            for column in &columns {
                q[column.coordinate] =
                    column.unit.to_si(header.needed_number(codes::scenario::PLAYBACK, &row, column.cell)?);
            }
            // Columns of followers are read and ignored: runs write them.
            robot.apply_mimic(&mut q);
            table.places.check_range(&row, &q, robot)?;
            table.follow(&row, time_s, &q, planning)?;
            table.times_s.push(time_s);
            table.points.push(q);
            table.places.lines.push(row.line);
        }
        if table.points.len() < 2 {
            return Err(fault(&header, "the table has fewer than two rows of positions".to_owned()));
        }
        // Tables may begin at any time, as parts of a recording do.
        let first_s = table.times_s[0];
        table.times_s.iter_mut().for_each(|time_s| *time_s -= first_s);
        Ok(table)
    }

    /// Refuses a row that does not follow on the one before.
    fn follow(&self, row: &Row, time_s: f64, q: &RobotQ, planning: &Planning<'_>) -> Result<(), Diagnostic> {
        let (robot, limits) = (&planning.description.robot, planning.limits);
        let (Some(&before_s), Some(before)) = (self.times_s.last(), self.points.last()) else {
            return Ok(());
        };
        if time_s <= before_s {
            return Err(
                row.fault(codes::scenario::PLAYBACK, &format!("time {time_s} s is not after {before_s} s"))
            );
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
            compared_quantities([speed(joint), limits.velocity[joint]], &format!("{unit}/s"));
        let message = format!(
            "line {}{}: joint \"{}\" jumps by {distance} in {interval}: {speed}, its limit is {limit}",
            row.line,
            self.places.column(joint),
            described.name
        );
        let error = Diagnostic::error(codes::scenario::PLAYBACK_JUMP, message).at(row.span.clone());
        Err(error
            .with_help("give the row more time, or write over_limit = \"slow\" or \"warn\" under [limits]"))
    }
}

impl TablePlaces {
    /// Refuses positions outside the range of a joint.
    fn check_range(&self, row: &Row, q: &RobotQ, robot: &Robot) -> Result<(), Diagnostic> {
        for (coordinate, (&joint, &position)) in robot.movable_joints().iter().zip(q).enumerate() {
            let joint = robot.joint(joint);
            let Some((lower, upper)) = joint.position_range() else { continue };
            if position < lower - SAME_PLACE || position > upper + SAME_PLACE {
                let unit = joint.kind.unit();
                let [position, lower, upper] = [position, lower, upper].map(|value| quantity(value, unit));
                let message = format!(
                    "line {}{}: joint \"{}\" is at {position}, outside its range of {lower} to {upper}",
                    row.line,
                    self.column(coordinate),
                    joint.name
                );
                return Err(Diagnostic::error(codes::scenario::PLAYBACK_RANGE, message).at(row.span.clone()));
            }
        }
        Ok(())
    }
}

/// The columns of positions; other quantities in a table that a run has written are ignored.
fn columns(header: &Header, robot: &Robot) -> Result<Vec<PositionColumn>, Diagnostic> {
    let mut columns: Vec<PositionColumn> = Vec::new();
    for (cell, name) in header.names().enumerate().filter(|(_, name)| *name != TIME) {
        let column = WrittenUnit::split(name).and_then(|(quantity, unit)| {
            let stem = quantity.rsplit_once('.').filter(|(_, quantity)| *quantity == POSITION);
            let joint = robot.find_joint(stem.map_or(quantity, |(joint, _)| joint))?;
            Some((robot.joint(joint), robot.coordinate(joint)?, unit))
        });
        let Some((joint, coordinate, unit)) = column else {
            if is_other_quantity(name) && robot.find_joint(name).is_none() {
                continue;
            }
            return Err(unknown(name, header, robot));
        };
        let turns = unit.unit == Unit::Angle;
        if joint.kind.is_angular() != turns {
            let (what, keys) = if turns { ("slides", "_m or _mm") } else { ("turns", "_deg or _rad") };
            let message = format!("column \"{name}\": the joint {what}, so its column must end in {keys}");
            return Err(fault(header, message));
        }
        if columns.iter().any(|known| known.coordinate == coordinate) {
            return Err(fault(header, format!("joint \"{}\" has two columns", joint.name)));
        }
        // After the checks of its name and unit, which apply to a follower's column as well.
        if joint.mimic.is_none() {
            columns.push(PositionColumn { cell, coordinate, unit });
        }
    }
    if columns.is_empty() {
        return Err(fault(header, "the table has no column of a joint".to_owned()));
    }
    Ok(columns)
}

fn unknown(name: &str, header: &Header, robot: &Robot) -> Diagnostic {
    let message = format!("column \"{name}\" is not the name of a joint with a unit");
    let known = known_names(name, "joints", robot.movable_joint_names());
    fault(header, message).with_help(format!("{known}; name a column JOINT_deg, _rad, _m or _mm"))
}

fn fault(header: &Header, message: String) -> Diagnostic {
    Diagnostic::error(codes::scenario::PLAYBACK, message).at(header.row.span.clone())
}
