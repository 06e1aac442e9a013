//! Two trajectories, row beside row. Neither file is held in memory.

use std::path::Path;

use super::{
    file_comparison::{ComparedFile, FileComparison},
    series::{SAME_TIME_S, SeriesComparison, is_compared},
};
use crate::trajectory_file::{RowReader, TIME, TableError, Value, open};

/// Compares two trajectories at the times that both have.
///
/// # Errors
/// [`TableError`] if one of them cannot be read to its end.
pub fn compare_tables(a: &Path, b: &Path, tolerance: f64) -> Result<FileComparison, TableError> {
    let mut sides = [Side::open(a)?, Side::open(b)?];
    let [of_a, of_b] = &sides;
    let (columns_a, columns_b) = (of_a.rows.columns(), of_b.rows.columns());
    let place = |name: &String| columns_b.iter().position(|column| column == name);
    let mut common: Vec<(usize, usize, SeriesComparison)> = Vec::new();
    for (at, name) in
        columns_a.iter().enumerate().filter(|(_, name)| *name != TIME && is_compared(name, tolerance))
    {
        if let Some(place) = place(name) {
            common.push((at, place, SeriesComparison::new(name, joint(name), tolerance)));
        }
    }
    let missing = |from: &[String], to: &[String]| -> Vec<String> {
        from.iter().filter(|name| !to.contains(name)).cloned().collect()
    };
    let only_in = [missing(columns_a, columns_b), missing(columns_b, columns_a)];
    let mut statements = other_robot(columns_a, columns_b);
    let mut only_rows = [0_u64; 2];
    loop {
        let [a, b] = &sides;
        let (side, later_s) = match (a.time_s, b.time_s) {
            (None, None) => break,
            (Some(a_s), Some(b_s)) if (a_s - b_s).abs() <= SAME_TIME_S => {
                for (at, place, series) in &mut common {
                    series.observe(Some(a_s), &a.row[*at], &b.row[*place]);
                }
                sides.iter_mut().try_for_each(Side::advance)?;
                continue;
            }
            (Some(a_s), b_s) if b_s.is_none_or(|b_s| a_s < b_s) => (0, a_s),
            (_, Some(b_s)) => (1, b_s),
            (a_s, None) => (0, a_s.unwrap_or_default()),
        };
        if only_rows[side] == 0 {
            statements.push(format!("only {} has a row at {later_s:?} s", ["A", "B"][side]));
        }
        only_rows[side] += 1;
        sides[side].advance()?;
    }
    let [rows_a, rows_b] = [sides[0].read, sides[1].read];
    if only_rows != [0, 0] {
        let both = rows_a - only_rows[0];
        statements.insert(0, format!("A has {rows_a} rows, B {rows_b}; {both} are at the same times"));
    }
    // Without a row at a time that both have, nothing was compared.
    let has_common_rows = rows_a > only_rows[0];
    let compared = if has_common_rows { common.len() } else { 0 };
    let series = common.into_iter().filter_map(|(.., series)| series.finish()).collect();
    Ok(FileComparison::new(ComparedFile::Trajectory, compared, series, only_in, statements))
}

/// One of the two files, at a row.
struct Side<'a> {
    path: &'a Path,
    rows: Box<dyn RowReader>,
    row: Vec<Value>,
    time_column: usize,
    /// The time of the row; `None` after the last.
    time_s: Option<f64>,
    /// Number of rows so far.
    read: u64,
}

impl<'a> Side<'a> {
    fn open(path: &'a Path) -> Result<Self, TableError> {
        let rows = open(path)?;
        let time_column = rows.columns().iter().position(|column| column == TIME).unwrap_or_default();
        let mut side = Self { path, rows, row: Vec::new(), time_column, time_s: None, read: 0 };
        side.advance()?;
        Ok(side)
    }

    /// Goes to the next row, which must be later.
    fn advance(&mut self) -> Result<(), TableError> {
        let path = self.path.to_owned();
        let refused = |message: String| TableError { path, message };
        let row = self.read + 1;
        match self.rows.next_row(&mut self.row) {
            Err(message) => return Err(refused(format!("row {row}: {message}"))),
            Ok(false) => {
                self.time_s = None;
                return Ok(());
            }
            Ok(true) => {}
        }
        let before_s = self.time_s.unwrap_or(f64::NEG_INFINITY);
        match self.row[self.time_column] {
            Value::Number(time_s) if time_s > before_s => self.time_s = Some(time_s),
            _ => return Err(refused(format!("row {row}: {TIME} is not after that of the row before"))),
        }
        self.read = row;
        Ok(())
    }
}

/// The joint of a column `JOINT.value`.
fn joint(column: &str) -> Option<String> {
    let (joint, _) = column.rsplit_once('.')?;
    (!matches!(joint, "twin_tcp" | "model_tcp")).then(|| joint.to_owned())
}

/// Says that the tables are of different robots, if they have no joint in common although both have joints.
fn other_robot(a: &[String], b: &[String]) -> Vec<String> {
    let joints = |columns: &[String]| -> Vec<String> {
        let mut joints: Vec<String> = columns.iter().filter_map(|column| joint(column)).collect();
        joints.dedup();
        joints
    };
    let (a, b) = (joints(a), joints(b));
    if a.is_empty() || b.is_empty() || a.iter().any(|joint| b.contains(joint)) {
        return Vec::new();
    }
    vec![format!("the robots differ: A has the joints {}, B {}", a.join(", "), b.join(", "))]
}
