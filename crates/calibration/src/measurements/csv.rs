//! Measurements as a table: a header that names joints and quantities with their units, one
//! configuration in each row.

use std::{collections::BTreeMap, ops::Range};

use congruent_description::{Robot, RobotQ};
use congruent_input::{Diagnostic, Findings, LineCounter};
use csv::{ByteRecord, ReaderBuilder};

use super::{
    checks::{missing_joints, no_rows, plausible},
    columns::{MeasuredQuantity, MeasurementColumn},
    measured_row::{MeasuredRow, WrittenOrientation},
};

/// Most faults that are listed: one wrong column gives a fault in every row, one wrong header in every column.
const MOST_FAULTS: usize = 20;

/// A row of the file with the places of its cells in the text.
struct Record<'a> {
    line: usize,
    span: Range<usize>,
    cells: Vec<(&'a str, Range<usize>)>,
}

/// Parses a whole file.
pub(super) fn parse(text: &str, robot: &Robot, needed: &[usize]) -> Result<Vec<MeasuredRow>, Findings> {
    let mut records = records(text)?.into_iter();
    let header = records.next().ok_or_else(no_rows)?;
    let columns = columns(&header, robot, needed)?;
    let (mut rows, mut faults) = (Vec::new(), Vec::new());
    for record in records {
        match row(&record, &header, &columns, robot) {
            Ok(row) => rows.push(row),
            Err(fault) => faults.push(fault),
        }
        // More of the same would hide the first message.
        if faults.len() >= MOST_FAULTS {
            break;
        }
    }
    if faults.is_empty() { Ok(rows) } else { Err(faults.into()) }
}

fn records(text: &str) -> Result<Vec<Record<'_>>, Findings> {
    let mut reader = ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    let (mut records, mut record, mut lines) = (Vec::new(), ByteRecord::new(), LineCounter::new(text));
    loop {
        match reader.read_byte_record(&mut record) {
            Ok(true) => {
                records.push(cells(text, &record, offset(reader.position().byte()), &mut lines));
            }
            Ok(false) => return Ok(records),
            Err(fault) => return Err(Diagnostic::error("measurements::csv", fault.to_string()).into()),
        }
    }
}

fn offset(byte: u64) -> usize {
    usize::try_from(byte).unwrap_or(usize::MAX)
}

/// The cells with their places in the text. A quoted cell, which is longer there than its contents, and
/// those behind it get the place of the whole record.
fn cells<'a>(text: &'a str, record: &ByteRecord, end: usize, lines: &mut LineCounter<'_>) -> Record<'a> {
    let start = offset(record.position().map_or(0, csv::Position::byte));
    let raw = &text[start.min(end)..end];
    // Comments and blank lines before the record belong to what the reader skipped.
    let skipped: usize = raw
        .split_inclusive('\n')
        .take_while(|line| line.starts_with('#') || line.trim_end_matches(['\r', '\n']).is_empty())
        .map(str::len)
        .sum();
    let start = start + skipped;
    let span = start..start + text[start..end].trim_end_matches(['\r', '\n']).len();
    let mut from = start;
    let mut cells = Vec::with_capacity(record.len());
    for cell in record {
        let to = (from + cell.len()).min(text.len());
        let plain = text.get(from..to).filter(|raw| raw.as_bytes() == cell);
        let trimmed = plain.map(|raw| (raw.trim(), from + raw.len() - raw.trim_start().len()));
        cells.push(match trimmed {
            Some((trimmed, at)) => (trimmed, at..at + trimmed.len()),
            None => ("", span.clone()),
        });
        from = to + 1;
    }
    Record { line: lines.line_column(start).0, span, cells }
}

/// The help for two columns of one quantity. For a gantry they may be a joint and a coordinate.
fn repeated_help(robot: &Robot, column: &str) -> String {
    match column.rsplit_once('_') {
        Some((stem, _)) if robot.find_joint(stem).is_some() && ["x", "y", "z"].contains(&stem) => format!(
            "\"{stem}\" is both a joint of the robot and a measured coordinate, so a table is ambiguous: write the rows as \
             JSON, where the joints are in \"q\""
        ),
        _ => "remove one of them".to_owned(),
    }
}

fn columns(header: &Record<'_>, robot: &Robot, needed: &[usize]) -> Result<Vec<MeasurementColumn>, Findings> {
    let (mut columns, mut faults) = (Vec::new(), Vec::new());
    let mut places: BTreeMap<MeasuredQuantity, usize> = BTreeMap::new();
    for (at, (name, span)) in header.cells.iter().enumerate() {
        match MeasurementColumn::parse(name, robot) {
            Ok(column) => {
                if let Some(first) = places.insert(column.quantity, at) {
                    let message = format!("columns {} and {} give the same quantity", first + 1, at + 1);
                    let fault = Diagnostic::error("measurements::repeated_column", message).at(span.clone());
                    faults.push(fault.with_help(repeated_help(robot, name)));
                }
                columns.push(column);
            }
            Err(fault) => faults.push(fault.at(span.clone())),
        }
        if faults.len() >= MOST_FAULTS {
            break;
        }
    }
    if !faults.is_empty() {
        return Err(faults.into());
    }
    let has = |quantity| places.contains_key(&quantity);
    if let Some(missing) =
        missing_joints(robot, needed, |coordinate| has(MeasuredQuantity::Joint(coordinate)))
    {
        let message = format!("no column for {missing}");
        faults
            .push(Diagnostic::error("measurements::missing_joint", message).with_help(
                "every joint of the chain needs a column, <joint>_rad or <joint>_deg (_m or _mm)",
            ));
    }
    let positions = (0..3).filter(|&at| has(MeasuredQuantity::Position(at))).count();
    let quaternion = (0..4).filter(|&at| has(MeasuredQuantity::Quaternion(at))).count();
    let rpy = (0..3).filter(|&at| has(MeasuredQuantity::Rpy(at))).count();
    if positions == 0 && quaternion == 0 && rpy == 0 {
        faults.push(
            Diagnostic::error(
                "measurements::nothing_measured",
                "no column gives the measured position or orientation of the tip",
            )
            .with_help("add x_m, y_m, z_m (or _mm), and qw, qx, qy, qz if the orientation was measured"),
        );
    }
    if ![0, 4].contains(&quaternion) || ![0, 3].contains(&rpy) || (quaternion > 0 && rpy > 0) {
        faults.push(
            Diagnostic::error("measurements::orientation", "the orientation is incomplete or given twice")
                .with_help("give all of qw, qx, qy, qz, or all of roll, pitch, yaw, or none of them"),
        );
    }
    let placed = |fault: Diagnostic| fault.at(header.span.clone());
    if faults.is_empty() { Ok(columns) } else { Err(faults.into_iter().map(placed).collect()) }
}

fn row(
    record: &Record<'_>,
    header: &Record<'_>,
    columns: &[MeasurementColumn],
    robot: &Robot,
) -> Result<MeasuredRow, Diagnostic> {
    if record.cells.len() != columns.len() {
        let message =
            format!("line {} has {} cells, the header {}", record.line, record.cells.len(), columns.len());
        return Err(Diagnostic::error("measurements::cells", message).at(record.span.clone()));
    }
    let mut row = MeasuredRow {
        line: record.line,
        q: RobotQ::zeros(robot.dof()),
        tip_in_base_m: [None; 3],
        orientation: None,
    };
    let (mut quaternion, mut rpy) = ([None; 4], [None; 3]);
    for ((column, (cell, span)), (name, _)) in columns.iter().zip(&record.cells).zip(&header.cells) {
        let beyond = |what: String| {
            let message = format!("line {}, column \"{name}\": \"{cell}\" {what}", record.line);
            Diagnostic::error("measurements::number", message).at(span.clone())
        };
        let value = finite(cell, span, (name, record.line))?
            .map(|value| plausible(column.to_si(value)).map_err(beyond))
            .transpose()?;
        match column.quantity {
            MeasuredQuantity::Joint(coordinate) => {
                row.q[coordinate] = value.ok_or_else(|| {
                    let message =
                        format!("line {}, column \"{name}\": the joint position is missing", record.line);
                    Diagnostic::error("measurements::empty_cell", message).at(record.span.clone())
                })?;
            }
            MeasuredQuantity::Position(at) => row.tip_in_base_m[at] = value,
            MeasuredQuantity::Quaternion(at) => quaternion[at] = value,
            MeasuredQuantity::Rpy(at) => rpy[at] = value,
        }
    }
    // Mimic joints need no column: they follow from their masters.
    robot.apply_mimic(&mut row.q);
    let fault = |message: String| {
        Diagnostic::error("measurements::orientation", format!("line {}: {message}", record.line))
            .at(record.span.clone())
    };
    row.orientation = match (complete(quaternion), complete(rpy)) {
        (Some(Ok(quaternion)), _) => {
            Some(WrittenOrientation::from_quaternion_wxyz(quaternion).map_err(fault)?)
        }
        (None, Some(Ok(rpy))) => Some(WrittenOrientation::RpyRad(rpy)),
        (None, None) => None,
        (Some(Err(())), _) | (None, Some(Err(()))) => {
            return Err(fault("the orientation is incomplete".to_owned()));
        }
    };
    Ok(row)
}

/// All values, nothing, or a fault if some are missing.
fn complete<const N: usize>(values: [Option<f64>; N]) -> Option<Result<[f64; N], ()>> {
    match values.iter().flatten().count() {
        0 => None,
        count if count == N => Some(Ok(values.map(Option::unwrap_or_default))),
        _ => Some(Err(())),
    }
}

fn finite(cell: &str, span: &Range<usize>, (name, line): (&str, usize)) -> Result<Option<f64>, Diagnostic> {
    if cell.is_empty() {
        return Ok(None);
    }
    match cell.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(Some(value)),
        _ => {
            let message = format!("line {line}, column \"{name}\": \"{cell}\" is not a finite number");
            Err(Diagnostic::error("measurements::number", message).at(span.clone()))
        }
    }
}
