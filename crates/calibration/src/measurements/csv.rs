//! Measurements as a table: a header that names joints and quantities with their units, one
//! configuration in each row.

use std::collections::BTreeMap;

use congruent_description::{Robot, RobotQ};
use congruent_input::{Diagnostic, Findings};
use congruent_tables::{Header, MOST_FAULTS, Row, WrittenTable};

use super::{
    checks::{missing_joints, no_rows, plausible},
    columns::{MeasuredQuantity, MeasurementColumn},
    measured_row::{MeasuredRow, WrittenOrientation},
};
use crate::codes;

/// Parses a whole file.
pub(super) fn parse(text: &str, robot: &Robot, needed: &[usize]) -> Result<Vec<MeasuredRow>, Findings> {
    let WrittenTable { header, rows: records } =
        WrittenTable::read(text, codes::measurements::CELLS).ok_or_else(no_rows)?;
    let columns = columns(&header, robot, needed)?;
    records.read_each(|record| row(&record, &header, &columns, robot))
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

fn columns(header: &Header, robot: &Robot, needed: &[usize]) -> Result<Vec<MeasurementColumn>, Findings> {
    let (mut columns, mut faults) = (Vec::new(), Vec::new());
    let mut places: BTreeMap<MeasuredQuantity, usize> = BTreeMap::new();
    for (at, name) in header.names().enumerate() {
        let span = &header.row.cells[at].span;
        match MeasurementColumn::parse(name, robot) {
            Ok(column) => {
                if let Some(first) = places.insert(column.quantity, at) {
                    let message = format!("columns {} and {} give the same quantity", first + 1, at + 1);
                    let fault =
                        Diagnostic::error(codes::measurements::REPEATED_COLUMN, message).at(span.clone());
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
            .push(Diagnostic::error(codes::measurements::MISSING_JOINT, message).with_help(
                "every joint of the chain needs a column, <joint>_rad or <joint>_deg (_m or _mm)",
            ));
    }
    let positions = (0..3).filter(|&at| has(MeasuredQuantity::Position(at))).count();
    let quaternion = (0..4).filter(|&at| has(MeasuredQuantity::Quaternion(at))).count();
    let rpy = (0..3).filter(|&at| has(MeasuredQuantity::Rpy(at))).count();
    let vector = (0..3).filter(|&at| has(MeasuredQuantity::RotationVector(at))).count();
    if positions + quaternion + rpy + vector == 0 {
        faults.push(
            Diagnostic::error(
                codes::measurements::NOTHING_MEASURED,
                "no column gives the measured position or orientation of the tip",
            )
            .with_help("add x_m, y_m, z_m (or _mm), and qw, qx, qy, qz if the orientation was measured"),
        );
    }
    let written = [(quaternion, 4), (rpy, 3), (vector, 3)].into_iter().filter(|(count, _)| *count > 0);
    if written.clone().count() > 1 || written.clone().any(|(count, all)| count < all) {
        faults.push(
            Diagnostic::error(
                codes::measurements::ORIENTATION,
                "the orientation is incomplete or given twice",
            )
            .with_help("give all of qw, qx, qy, qz, or all of roll, pitch, yaw, or all of rx, ry, rz, or none of them"),
        );
    }
    let placed = |fault: Diagnostic| fault.at(header.row.span.clone());
    if faults.is_empty() { Ok(columns) } else { Err(faults.into_iter().map(placed).collect()) }
}

fn row(
    record: &Row,
    header: &Header,
    columns: &[MeasurementColumn],
    robot: &Robot,
) -> Result<MeasuredRow, Diagnostic> {
    let mut row = MeasuredRow {
        line: record.line,
        q: RobotQ::zeros(robot.dof()),
        tip_in_base_m: [None; 3],
        orientation: None,
    };
    let (mut quaternion, mut rpy, mut vector) = ([None; 4], [None; 3], [None; 3]);
    for (at, (column, cell)) in columns.iter().zip(&record.cells).enumerate() {
        let beyond = |what| {
            header.fault(codes::measurements::NUMBER, record, at, &format!("\"{}\" {what}", cell.text))
        };
        let value = header
            .number(codes::measurements::NUMBER, record, at)?
            .map(|value| plausible(column.to_si(value)).map_err(beyond))
            .transpose()?;
        match column.quantity {
            MeasuredQuantity::Joint(coordinate) => {
                row.q[coordinate] = value.ok_or_else(|| {
                    header.fault(codes::measurements::EMPTY_CELL, record, at, "the joint position is missing")
                })?;
            }
            MeasuredQuantity::Position(at) => row.tip_in_base_m[at] = value,
            MeasuredQuantity::Quaternion(at) => quaternion[at] = value,
            MeasuredQuantity::Rpy(at) => rpy[at] = value,
            MeasuredQuantity::RotationVector(at) => vector[at] = value,
        }
    }
    // Mimic joints need no column: they follow from their masters.
    robot.apply_mimic(&mut row.q);
    let fault = |message: String| record.fault(codes::measurements::ORIENTATION, &message);
    let incomplete = || fault("the orientation is incomplete".to_owned());
    let quaternion = complete(quaternion).map_err(|()| incomplete())?;
    let rpy = complete(rpy).map_err(|()| incomplete())?.map(WrittenOrientation::RpyRad);
    let vector = complete(vector).map_err(|()| incomplete())?.map(WrittenOrientation::RotationVectorRad);
    let quaternion = quaternion.map(WrittenOrientation::from_quaternion_wxyz).transpose().map_err(fault)?;
    // The header has columns of one of them alone.
    row.orientation = quaternion.or(rpy).or(vector);
    Ok(row)
}

/// All values, nothing, or a fault if some are missing.
fn complete<const N: usize>(values: [Option<f64>; N]) -> Result<Option<[f64; N]>, ()> {
    match values.iter().flatten().count() {
        0 => Ok(None),
        count if count == N => Ok(Some(values.map(Option::unwrap_or_default))),
        _ => Err(()),
    }
}
