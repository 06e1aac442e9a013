//! The episodes of a dataset: which there are, and in which rows of which files one of them is.

use std::{
    collections::BTreeSet,
    ops::Range,
    path::{Path, PathBuf},
    sync::Arc,
};

use congruent_input::{Diagnostic, catch_panic, open_regular};
use parquet::{
    file::reader::{FileReader, SerializedFileReader},
    record::{Field, reader::RowIter},
    schema::types::Type,
};

use crate::{codes, table_reading::TableEpisodes};

/// The column with the index of the episode of each row.
pub(super) const EPISODE: &str = "episode_index";

/// A file, and which of its rows are read.
#[derive(Debug, Clone)]
pub(super) struct ChosenFile {
    pub(super) path: PathBuf,
    /// Numbers of rows from 0 on; `None` for all.
    pub(super) rows: Option<Vec<Range<u64>>>,
}

/// The files of a dataset, or those with the rows of one episode, and what episodes there are; `None` without the column.
///
/// # Errors
/// There is no such episode.
pub(super) fn choose(
    name: &Path,
    files: Vec<PathBuf>,
    taken: Option<u64>,
) -> Result<(Vec<ChosenFile>, Option<TableEpisodes>), Diagnostic> {
    let mut all = BTreeSet::new();
    let mut chosen = Vec::new();
    for path in files {
        // What cannot be read is said when the rows are.
        let indices = catch_panic(|| indices(&path)).unwrap_or_default();
        let rows = taken.map(|taken| ranges(&indices, taken));
        all.extend(indices.into_iter().flatten());
        if rows.as_ref().is_none_or(|rows| !rows.is_empty()) {
            chosen.push(ChosenFile { path, rows });
        }
    }
    let ends = all.first().zip(all.last());
    let episodes = ends.map(|(&first, &last)| TableEpisodes { count: all.len() as u64, first, last, taken });
    match (taken, &episodes) {
        (Some(taken), None) => Err(refused(
            name,
            &format!("has no column {EPISODE}, by which episode {taken} would be found"),
            "leave --episode out",
        )),
        (Some(taken), Some(TableEpisodes { count, first, last, .. })) if chosen.is_empty() => {
            let among = if *count == last - first + 1 { String::new() } else { format!(", {count} of them") };
            let what = format!("has no episode {taken}; its episodes are {first} to {last}{among}");
            Err(refused(name, &what, "give the index of one of them, as --episode 0"))
        }
        _ => Ok((chosen, episodes)),
    }
}

/// What is refused of `--episode`.
pub(crate) fn refused(name: &Path, what: &str, help: &str) -> Diagnostic {
    let message = format!("{} {what}", name.display());
    Diagnostic::error(codes::log::EPISODE, message).with_help(help)
}

/// The episode of each row of a file, as far as it can be read; none without the column.
fn indices(path: &Path) -> Result<Vec<Option<u64>>, String> {
    let file = open_regular(path, u64::MAX).map_err(|fault| fault.message)?;
    let reader = SerializedFileReader::new(file).map_err(|fault| fault.to_string())?;
    let schema = reader.metadata().file_metadata().schema();
    let is_index = |field: &&Arc<Type>| field.name() == EPISODE && field.is_primitive();
    let Some(field) = schema.get_fields().iter().find(is_index) else { return Ok(Vec::new()) };
    let builder = Type::group_type_builder(schema.name()).with_fields(vec![Arc::clone(field)]);
    let alone = builder.build().map_err(|fault| fault.to_string())?;
    let rows = RowIter::from_file_into(Box::new(reader));
    let rows = rows.project(Some(alone)).map_err(|fault| fault.to_string())?;
    let index = |row: &parquet::record::Row| match row.get_column_iter().next() {
        Some((_, Field::Long(index))) => u64::try_from(*index).ok(),
        Some((_, Field::Int(index))) => u64::try_from(*index).ok(),
        _ => None,
    };
    Ok(rows.map_while(Result::ok).map(|row| index(&row)).collect())
}

/// Where an episode is: mostly one range.
fn ranges(indices: &[Option<u64>], taken: u64) -> Vec<Range<u64>> {
    let mut ranges: Vec<Range<u64>> = Vec::new();
    for (row, index) in (0..).zip(indices) {
        if *index != Some(taken) {
            continue;
        }
        match ranges.last_mut().filter(|range| range.end == row) {
            Some(range) => range.end = row + 1,
            None => ranges.push(row..row + 1),
        }
    }
    ranges
}
