//! Reads a table row by row.

use std::{collections::VecDeque, path::Path, sync::Arc};

use congruent_input::{Diagnostic, SourceFile, display::counted};

use super::{
    columns::{ReadColumns, find_columns},
    head::{OpenTable, RowSource, TableHead, TableRow},
    number::{CellValue, cell_value},
    time::{FoundTime, TimeColumn, find_time},
};
use crate::{
    codes,
    event::{EventTime, LogEvent, LogFormat, LogGap, LogReader, LogTopic, LoggedJoints, TopicContent},
    options::LogOptions,
    table_reading::{DecimalMark, TableReading, TableTime},
    tcp_pose::pose_of_ur,
};

/// A table that is read as a log.
pub(crate) struct TableReader {
    source: Arc<SourceFile>,
    format: LogFormat,
    table: Box<dyn RowSource>,
    width: usize,
    decimal: DecimalMark,
    columns: ReadColumns,
    joints: Arc<[String]>,
    time: RowTime,
    reading: TableReading,
    topics: Vec<LogTopic>,
    events: VecDeque<LogEvent>,
    first_ns: Option<i64>,
    /// Rows that were read.
    rows: u32,
    faults: RowFaults,
    warnings: Vec<Diagnostic>,
    is_at_end: bool,
}

/// Where the time of a row comes from.
#[derive(Debug, Clone, Copy)]
enum RowTime {
    Column(TimeColumn),
    RateHz(f64),
}

/// Rows and cells that are not used, with the first line of each kind.
#[derive(Debug, Default)]
struct RowFaults {
    width: Counted,
    cells: Counted,
    times: Counted,
}

/// How many, and the line of the first.
#[derive(Debug, Default)]
struct Counted {
    count: usize,
    first_line: u64,
}

impl Counted {
    fn add(&mut self, line: u64) {
        if self.count == 0 {
            self.first_line = line;
        }
        self.count += 1;
    }
}

impl TableReader {
    /// A table as a log.
    ///
    /// # Errors
    /// It has no column of a joint, or its rows have no time.
    pub(crate) fn new(path: &Path, table: OpenTable, options: &LogOptions) -> Result<Self, Diagnostic> {
        let OpenTable { source, head, rows, format, text, not_read, warnings, episodes } = table;
        let time = row_time(&head, options).map_err(|fault| fault.in_file(&source))?;
        let of_time = match time {
            RowTime::Column(column) => Some(column.column),
            RowTime::RateHz(_) => match find_time(&head) {
                // A time that is not used is no joint.
                FoundTime::Coarse(column) | FoundTime::NoNumbers(column) => Some(column),
                FoundTime::Column(found) => Some(found.column),
                FoundTime::None => None,
            },
        };
        let mut columns = find_columns(&head, of_time, &options.joints);
        columns.unused.extend(not_read);
        if columns.cells.is_empty() {
            return Err(no_columns(&columns, options).in_file(&source));
        }
        Ok(Self {
            reading: TableReading { text, episodes, ..reading(&head, time, &columns) },
            topics: topics(path, format, &columns),
            source,
            format,
            table: rows,
            width: head.width,
            decimal: head.decimal,
            joints: columns.joints.clone().into(),
            columns,
            time,
            events: VecDeque::new(),
            first_ns: None,
            rows: 0,
            faults: RowFaults::default(),
            warnings,
            is_at_end: false,
        })
    }

    /// Reads a row; the faults of all rows behind the last.
    fn step(&mut self) -> Result<(), Diagnostic> {
        let row = self.table.next_row()?;
        let gap = |cause| LogEvent::Gap(LogGap { between_s: None, cause });
        self.events.extend(self.table.take_gaps().into_iter().map(gap));
        if let Some(TableRow { cells, line }) = row {
            self.row(&cells, line);
        } else {
            self.is_at_end = true;
            self.report_faults();
        }
        Ok(())
    }

    fn row(&mut self, cells: &[String], line: u64) {
        // A row that is not used was recorded nevertheless: at a rate it takes its time.
        let number = self.rows;
        self.rows = self.rows.saturating_add(1);
        if cells.len() != self.width {
            return self.faults.width.add(line);
        }
        let log_ns = match self.time {
            RowTime::Column(column) => column.ns(cells, self.decimal),
            RowTime::RateHz(rate_hz) => ns_of_row(number, rate_hz),
        };
        let Some(log_ns) = log_ns else { return self.faults.times.add(line) };
        let first_ns = *self.first_ns.get_or_insert(log_ns);
        // A table has one time: that of the values.
        let time = EventTime::new(log_ns, Some(log_ns), first_ns);
        let joints = self.joints(cells, line, time);
        self.events.push_back(LogEvent::Joints(joints));
        if let Some(columns) = self.columns.tcp_pose {
            let pose = columns.map(|column| self.number(cells, column, line));
            self.events.push_back(LogEvent::Pose(pose_of_ur(pose, 1, time)));
        }
    }

    fn joints(&mut self, cells: &[String], line: u64, time: EventTime) -> LoggedJoints {
        let mut arrays = [const { Vec::new() }; 3];
        for at in 0..self.columns.cells.len() {
            let cell = self.columns.cells[at];
            let array = &mut arrays[cell.quantity as usize];
            if array.is_empty() {
                array.resize(self.joints.len(), f64::NAN);
            }
            array[cell.joint] = self.number(cells, cell.column, line) * cell.si_per_unit;
        }
        let [position, velocity, effort] = arrays;
        LoggedJoints { topic: 0, time, names: Arc::clone(&self.joints), position, velocity, effort }
    }

    fn number(&mut self, cells: &[String], column: usize, line: u64) -> f64 {
        match cell_value(&cells[column], self.decimal) {
            CellValue::Number(number) => number,
            CellValue::Missing => f64::NAN,
            CellValue::NotANumber => {
                self.faults.cells.add(line);
                f64::NAN
            }
        }
    }

    fn report_faults(&mut self) {
        let width = self.width;
        let place = if self.reading.text.is_some() { "line" } else { "row" };
        let reported = [
            (&self.faults.width, "row", format!("left out for another number of cells than {width}")),
            (&self.faults.times, "row", "left out for want of a time".to_owned()),
            (&self.faults.cells, "cell", "taken for missing, for want of a number".to_owned()),
        ];
        for (found, noun, what) in reported.into_iter().filter(|(found, ..)| found.count > 0) {
            let Counted { count, first_line } = *found;
            let message = format!("{} {what}; the first is in {place} {first_line}", counted(count, noun));
            let cause = Diagnostic::warning(codes::log::ROWS, message).in_file(&self.source);
            self.events.push_back(LogEvent::Gap(LogGap { between_s: None, cause }));
        }
    }
}

impl LogReader for TableReader {
    fn format(&self) -> LogFormat {
        self.format
    }

    fn topics(&self) -> &[LogTopic] {
        &self.topics
    }

    fn next_event(&mut self) -> Result<Option<LogEvent>, Diagnostic> {
        while self.events.is_empty() && !self.is_at_end {
            self.step()?;
        }
        Ok(self.events.pop_front())
    }

    fn warnings(&self) -> &[Diagnostic] {
        &self.warnings
    }

    fn table(&self) -> Option<&TableReading> {
        Some(&self.reading)
    }
}

/// The given rate before the column of times: who gives one knows that the times are of no use.
fn row_time(head: &TableHead, options: &LogOptions) -> Result<RowTime, Diagnostic> {
    if let Some(rate_hz) = options.rate_hz {
        return Ok(RowTime::RateHz(rate_hz));
    }
    let message = match find_time(head) {
        FoundTime::Column(column) => return Ok(RowTime::Column(column)),
        FoundTime::Coarse(column) => {
            format!("most rows have the time of the row before in column \"{}\"", head.name(column))
        }
        FoundTime::NoNumbers(column) => {
            let name = head.name(column);
            format!("column \"{name}\" is named as a time, and its cells are not numbers")
        }
        FoundTime::None => "no column has the times of the rows".to_owned(),
    };
    Err(Diagnostic::error(codes::log::TIME, message)
        .with_help("give the rate of the rows, as --rate-hz 125, or write a column time_s"))
}

fn no_columns(columns: &ReadColumns, options: &LogOptions) -> Diagnostic {
    let listed = congruent_input::display::first_of(&columns.unused, 20);
    let hint = if options.joints.is_empty() {
        "--robot ROBOT recognises columns by the names of its joints"
    } else {
        "name each as a joint of the robot"
    };
    Diagnostic::error(codes::log::COLUMNS, "no column is of a joint")
        .with_help(format!("{hint}; columns: {listed}"))
}

fn reading(head: &TableHead, time: RowTime, columns: &ReadColumns) -> TableReading {
    let time = match time {
        RowTime::Column(TimeColumn { column, unit, unit_from }) => {
            TableTime::Column { name: head.name(column), unit, unit_from }
        }
        RowTime::RateHz(rate_hz) => TableTime::RateHz(rate_hz),
    };
    TableReading {
        text: None,
        has_header: head.names.is_some(),
        time,
        preset: columns.preset,
        columns: columns.described.clone(),
        unused: columns.unused.clone(),
        episodes: None,
    }
}

fn topics(path: &Path, format: LogFormat, columns: &ReadColumns) -> Vec<LogTopic> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let encoding = if format == LogFormat::Table { "csv" } else { "parquet" };
    let topic = |name: String, content| LogTopic {
        name,
        message_type: "rows of a table".to_owned(),
        encoding: encoding.to_owned(),
        content,
    };
    let pose = columns.tcp_pose.map(|_| topic("actual_TCP_pose".to_owned(), TopicContent::Pose));
    [topic(name, TopicContent::Joints)].into_iter().chain(pose).collect()
}

fn ns_of_row(row: u32, rate_hz: f64) -> Option<i64> {
    let ns = f64::from(row) / rate_hz * 1e9;
    #[expect(
        clippy::cast_possible_truncation,
        reason = "a float in the range of i64, or the nearest end of it"
    )]
    ns.is_finite().then_some(ns.round() as i64)
}

#[cfg(test)]
#[path = "reader_tests.rs"]
mod tests;
