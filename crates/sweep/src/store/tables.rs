//! All rows as tables: `cases.csv` and `cases.parquet`, a line a case.

use std::{
    collections::BTreeSet,
    path::{Path, PathBuf},
};

use congruent_tables::writer::{
    ColumnKind, CsvTable, ParquetTable, TableWriteError, TableWriter, WrittenCell, WrittenColumn,
};

use super::merged::MergedTable;
use crate::run::CaseRow;

/// The table as comma-separated values.
pub const CASES_CSV: &str = "cases.csv";
/// The table as Parquet.
pub const CASES_PARQUET: &str = "cases.parquet";

/// The key that has a column of its own.
const SEED: &str = "seed";
/// Columns before those of keys and quantities.
const BEFORE: [(&str, ColumnKind); 3] =
    [("case", ColumnKind::Count), ("seed", ColumnKind::Count), ("verdict", ColumnKind::Name)];
/// Columns behind them.
const BEHIND: [(&str, ColumnKind); 7] = [
    ("least_margin", ColumnKind::Number),
    ("least_margin_of", ColumnKind::Name),
    ("failed", ColumnKind::Name),
    ("stopped_s", ColumnKind::Number),
    ("cause", ColumnKind::Name),
    ("error", ColumnKind::Name),
    ("trajectory_sha256", ColumnKind::Name),
];

/// Writes both tables into a folder, in place of older ones.
///
/// # Errors
/// One cannot be written.
pub fn write_tables(table: &MergedTable, folder: &Path) -> Result<(), TableWriteError> {
    let (rows, columns) = (&table.rows, CaseColumns::of(&table.header.keys, &table.rows));
    let written = columns.written();
    let partial = |name: &str| folder.join(format!("{name}.partial"));
    let csv = Box::new(CsvTable::create(&partial(CASES_CSV), &written)?);
    columns.write(rows, csv)?;
    // Parquet makes no table where there is one, as of a call that was killed.
    let parquet = partial(CASES_PARQUET);
    let _ = std::fs::remove_file(&parquet);
    columns.write(rows, Box::new(ParquetTable::create(&parquet, "cases", &written)?))?;
    [CASES_CSV, CASES_PARQUET].into_iter().try_for_each(|name| renamed(&partial(name), &folder.join(name)))
}

/// Rows whose values are of these keys as the text of a CSV file.
///
/// # Errors
/// None that memory has.
pub(crate) fn csv_of_rows(keys: &[String], rows: &[CaseRow]) -> Result<Vec<u8>, TableWriteError> {
    let (columns, mut text) = (CaseColumns::of(keys, rows), Vec::new());
    columns.write(rows, Box::new(CsvTable::to(&mut text, &columns.written())?))?;
    Ok(text)
}

fn renamed(from: &PathBuf, to: &PathBuf) -> Result<(), TableWriteError> {
    std::fs::rename(from, to).map_err(TableWriteError::from)
}

/// The columns of a sweep.
struct CaseColumns {
    /// Of each key its place in the row, its name, and whether all of its values are numbers.
    keys: Vec<(usize, String, bool)>,
    /// The quantities of all rows.
    measures: Vec<String>,
}

impl CaseColumns {
    fn of(keys: &[String], rows: &[CaseRow]) -> Self {
        let is_number = |at: usize| rows.iter().all(|row| number(&row.values[at]).is_some());
        // The seed has a column already.
        let keys = keys.iter().enumerate().filter(|(_, key)| *key != SEED);
        let measures: BTreeSet<&String> = rows.iter().flat_map(|row| row.worst.keys()).collect();
        Self {
            keys: keys.map(|(at, key)| (at, key.clone(), is_number(at))).collect(),
            measures: measures.into_iter().cloned().collect(),
        }
    }

    fn written(&self) -> Vec<WrittenColumn> {
        let fixed = |(name, kind): (&str, ColumnKind)| WrittenColumn { name: name.to_owned(), kind };
        let mut columns: Vec<WrittenColumn> = BEFORE.map(fixed).into();
        columns.extend(self.keys.iter().map(|(_, key, is_number)| WrittenColumn {
            name: key.clone(),
            kind: if *is_number { ColumnKind::Number } else { ColumnKind::Name },
        }));
        for measure in &self.measures {
            columns.extend(
                [measure.clone(), format!("{measure}.margin")].map(|name| fixed((&name, ColumnKind::Number))),
            );
        }
        columns.extend(BEHIND.map(fixed));
        columns
    }

    fn write(&self, rows: &[CaseRow], mut writer: Box<dyn TableWriter + '_>) -> Result<(), TableWriteError> {
        for row in rows {
            self.write_row(row, &mut *writer);
            writer.end_row()?;
        }
        writer.finish()
    }

    fn write_row(&self, row: &CaseRow, writer: &mut dyn TableWriter) {
        writer.cell(WrittenCell::Count(row.case));
        writer.cell(WrittenCell::Count(row.seed));
        writer.cell(WrittenCell::Name(row.verdict.word()));
        for (at, _, is_number) in &self.keys {
            let value = &row.values[*at];
            // Only numbers are in a column of numbers.
            let number = is_number.then(|| number(value)).flatten();
            let word = unquoted(value);
            writer.cell(number.map_or(WrittenCell::Name(&word), WrittenCell::Number));
        }
        for measure in &self.measures {
            let worst = row.worst.get(measure);
            writer.cell(number_cell(worst.and_then(|worst| worst.value)));
            writer.cell(number_cell(worst.and_then(|worst| worst.margin)));
        }
        let least = row.least_margin();
        writer.cell(number_cell(least.map(|(_, share)| share)));
        writer.cell(name_cell(least.map(|(name, _)| name)));
        let failed = row.failed.join(" ");
        writer.cell(name_cell(Some(failed.as_str()).filter(|failed| !failed.is_empty())));
        writer.cell(number_cell(row.stopped_s));
        writer.cell(name_cell(row.cause.as_deref()));
        writer.cell(name_cell(row.error.as_deref()));
        writer.cell(name_cell(row.trajectory_sha256.as_deref()));
    }
}

/// A value that is written as a number of TOML.
pub(crate) fn number(value: &str) -> Option<f64> {
    value.parse().ok()
}

/// A text of TOML without its quotes; anything else as it is written.
fn unquoted(value: &str) -> String {
    let table: Option<toml::Table> = format!("value = {value}").parse().ok();
    let text = table.and_then(|table| Some(table.get("value")?.as_str()?.to_owned()));
    text.unwrap_or_else(|| value.to_owned())
}

fn number_cell<'a>(number: Option<f64>) -> WrittenCell<'a> {
    number.map_or(WrittenCell::Missing, WrittenCell::Number)
}

fn name_cell(name: Option<&str>) -> WrittenCell<'_> {
    name.map_or(WrittenCell::Missing, WrittenCell::Name)
}
