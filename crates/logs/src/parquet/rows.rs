//! The rows of one or several files of Parquet as one table.

use std::{
    collections::VecDeque,
    fs::File,
    ops::Range,
    path::{Path, PathBuf},
    sync::Arc,
    vec,
};

use congruent_input::{Diagnostic, Severity, SourceFile, catch_panic, open_regular};
use parquet::{
    file::reader::{FileReader, SerializedFileReader},
    record::{Row, reader::RowIter},
};

use super::{
    columns::{NumberColumns, STATE, TIMESTAMP, cells, list_length},
    dataset::{INFO, ListNames, files_of, is_dataset, names_of},
    episodes::{self, ChosenFile},
};
use crate::{
    codes,
    event::LogFormat,
    table::{OpenTable, RowSource, TableHead, TableRow, says_quantity},
    table_reading::DecimalMark,
};

/// Rows by which a table is judged. Kind: choice; as of a text.
const HEAD_ROWS: usize = 200;

/// A file of which the rows are read one after the other.
struct OpenFile {
    path: PathBuf,
    /// Which of its rows are wanted: those of an episode.
    wanted: Option<Vec<Range<u64>>>,
    /// Rows so far.
    number: u64,
    columns: NumberColumns,
    rows: RowIter<'static>,
}

struct NumberRows {
    /// The rows of the beginning, which come again.
    head: VecDeque<Vec<String>>,
    file: Option<OpenFile>,
    files: vec::IntoIter<ChosenFile>,
    /// Names of the columns of the first file, which all have.
    names: Vec<String>,
    number: u64,
    gaps: Vec<Diagnostic>,
}

/// Opens a file, or the folder of a dataset of LeRobot; of one episode alone if its index is given.
///
/// # Errors
/// It has no file or no such episode, or the first file cannot be read.
pub(crate) fn open(path: &Path, episode: Option<u64>) -> Result<OpenTable, Diagnostic> {
    let paths = if is_dataset(path) { files_of(path)? } else { vec![path.to_owned()] };
    let (chosen, episodes) = episodes::choose(path, paths, episode)?;
    let mut files = chosen.into_iter();
    let Some(first) = files.next() else {
        let message = format!("{} has no file data/*/*.parquet", path.display());
        return Err(Diagnostic::error(codes::log::PARQUET, message)
            .with_help("download the dataset with its data: `hf download --repo-type dataset USER/NAME`"));
    };
    let mut file = OpenFile::new(first)?;
    let mut head: Vec<Row> = Vec::new();
    while head.len() < HEAD_ROWS
        && let Some(row) = file.next().map_err(|fault| refused(&file.path, &fault))?
    {
        head.push(row);
    }
    let Some(row) = head.first() else {
        return Err(refused(&file.path, "it has no row"));
    };
    let NumberColumns { names, are_of_lerobot, .. } = &file.columns;
    let state = if *are_of_lerobot { names_of_state(&file.path, names, row)? } else { StateNames::default() };
    let column_names = if *are_of_lerobot { state.columns } else { names.clone() };
    let rows: Vec<Vec<String>> = head.iter().map(cells).collect();
    let source = SourceFile { path: path.to_owned(), text: String::new(), is_foreign: false };
    Ok(OpenTable {
        source: Arc::new(source),
        head: TableHead {
            width: column_names.len(),
            names: Some(column_names),
            rows: rows.clone(),
            decimal: DecimalMark::Point,
        },
        format: if *are_of_lerobot { LogFormat::LeRobot } else { LogFormat::Parquet },
        text: None,
        episodes,
        not_read: file.columns.others.clone(),
        warnings: state.fault.into_iter().collect(),
        rows: Box::new(NumberRows {
            head: rows.into(),
            names: names.clone(),
            file: Some(file),
            files,
            number: 0,
            gaps: Vec::new(),
        }),
    })
}

/// The columns of a dataset.
#[derive(Default)]
struct StateNames {
    columns: Vec<String>,
    /// Why the joints have no names.
    fault: Option<Diagnostic>,
}

/// The names of the columns of a dataset, in the order of the file: the state has one for each of its values, each a position if its
/// name does not say another quantity.
fn names_of_state(path: &Path, columns: &[String], row: &Row) -> Result<StateNames, Diagnostic> {
    let length = list_length(row).unwrap_or_default();
    let ListNames { names: written, mut fault } = names_of(path, STATE)?;
    if fault.is_none() && !written.is_empty() && written.len() != length {
        fault = Some(format!("names {} values of {STATE}, which has {length}", written.len()));
    }
    let name = |at: usize| match written.get(at).filter(|_| written.len() == length) {
        Some(name) if says_quantity(name) => name.clone(),
        Some(name) => format!("{name} position"),
        None => format!("joint_{} position", at + 1),
    };
    let of_column = |column: &String| match column.as_str() {
        STATE => (0..length).map(name).collect(),
        // Of any other table the unit would be found by the steps.
        TIMESTAMP => vec![format!("{TIMESTAMP}_s")],
        other => vec![other.to_owned()],
    };
    let unnamed = |fault: String| {
        let last = format!("joint_{length}");
        let message = format!("{}: {INFO} {fault}: the joints are called joint_1 to {last}", path.display());
        Diagnostic::warning(codes::log::STATE_NAMES, message).with_help(format!(
            "write their names into {INFO}, under features, {STATE}, names, in the order of the values"
        ))
    };
    Ok(StateNames { columns: columns.iter().flat_map(of_column).collect(), fault: fault.map(unnamed) })
}

impl OpenFile {
    fn new(ChosenFile { path, rows: wanted }: ChosenFile) -> Result<Self, Diagnostic> {
        let file = open_regular(&path, u64::MAX)?;
        let opened = catch_panic(|| Self::parts(file));
        let (columns, rows) = opened.map_err(|fault| refused(&path, &fault))?;
        Ok(Self { path, wanted, number: 0, columns, rows })
    }

    fn parts(file: File) -> Result<(NumberColumns, RowIter<'static>), String> {
        let reader = SerializedFileReader::new(file).map_err(|fault| fault.to_string())?;
        let columns = NumberColumns::new(reader.metadata())?;
        if let Some(compression) = columns.unread_compression(reader.metadata()) {
            // The name of a compression has its level behind it.
            let written = format!("{compression}").to_lowercase();
            let name = written.split('(').next().unwrap_or_default();
            return Err(format!("it is compressed by {name}, which is not read"));
        }
        let rows = columns.rows(reader)?;
        Ok((columns, rows))
    }

    /// The next row that is wanted.
    fn next(&mut self) -> Result<Option<Row>, String> {
        loop {
            let number = self.number;
            self.number += 1;
            if self.is_behind(number) {
                return Ok(None);
            }
            let row = catch_panic(|| self.rows.next().transpose().map_err(|fault| fault.to_string()))?;
            if row.is_none() || self.is_wanted(number) {
                return Ok(row);
            }
        }
    }

    fn is_wanted(&self, row: u64) -> bool {
        self.wanted.as_ref().is_none_or(|wanted| wanted.iter().any(|range| range.contains(&row)))
    }

    /// Whether no later row is wanted.
    fn is_behind(&self, row: u64) -> bool {
        self.wanted.as_ref().is_some_and(|wanted| wanted.last().is_none_or(|last| last.end <= row))
    }
}

impl NumberRows {
    /// The next row of the files; one that cannot be read costs the rest of its file.
    fn next_cells(&mut self) -> Option<Vec<String>> {
        if let Some(cells) = self.head.pop_front() {
            return Some(cells);
        }
        loop {
            let Some(file) = &mut self.file else {
                self.open_next()?;
                continue;
            };
            match file.next() {
                Ok(Some(row)) => return Some(cells(&row)),
                Ok(None) => {}
                Err(fault) => {
                    let message =
                        format!("{} cannot be read behind row {}", file.path.display(), self.number);
                    self.gaps.push(Diagnostic::warning(codes::log::DAMAGED, format!("{message}: {fault}")));
                }
            }
            self.file = None;
        }
    }

    /// Opens the next file, unless it is of another kind than the first or cannot be read; `None` behind the last.
    fn open_next(&mut self) -> Option<()> {
        let file = self.files.next()?;
        match OpenFile::new(file) {
            Ok(file) if file.columns.names == self.names => self.file = Some(file),
            Ok(file) => self.gaps.push(refused(&file.path, "its columns are not those of the files before")),
            Err(fault) => self.gaps.push(fault),
        }
        Some(())
    }
}

impl RowSource for NumberRows {
    fn next_row(&mut self) -> Result<Option<TableRow>, Diagnostic> {
        let Some(cells) = self.next_cells() else { return Ok(None) };
        self.number += 1;
        Ok(Some(TableRow { cells, line: self.number }))
    }

    fn take_gaps(&mut self) -> Vec<Diagnostic> {
        let as_warning = |cause| Diagnostic { severity: Severity::Warning, ..cause };
        self.gaps.drain(..).map(as_warning).collect()
    }
}

fn refused(path: &Path, fault: &str) -> Diagnostic {
    let message = format!("{} is no Parquet that is read: {fault}", path.display());
    Diagnostic::error(codes::log::PARQUET, message).with_help(
        "read are files with their end, without compression or by snappy; `import pyarrow.parquet as pq; \
         pq.write_table(pq.read_table(\"FILE\"), \"out.parquet\", compression=\"snappy\")` writes such a file",
    )
}

#[cfg(test)]
#[path = "rows_tests.rs"]
mod tests;
