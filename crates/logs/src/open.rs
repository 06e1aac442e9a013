//! Which files are logs, which of them are read, and how the others become one that is.

use std::{
    collections::BTreeSet,
    io::Read,
    path::{Path, PathBuf},
};

use congruent_input::{Diagnostic, absence, codes::file, open_regular, read_text, unreadable};

use crate::{
    codes, csv, db3,
    event::LogReader,
    json_lines::JsonLinesReader,
    mcap::{McapReader, is_mcap},
    options::{CONVERT, LogOptions},
    parquet,
    table::TableReader,
};

/// The file that rosbag2 writes beside those with messages.
const METADATA: &str = "metadata.yaml";
/// Most bytes of that file.
const METADATA_BYTES: u64 = 16 << 20;
/// Bytes of the beginning by which an MCAP is recognised.
const MAGIC_BYTES: u64 = 8;

/// Endings of an MCAP; the second one has that of a run which did not end.
const MCAPS: [&str; 2] = [".mcap", ".mcap.partial"];
/// Endings of tables.
const TABLES: [&str; 3] = [".csv", ".tsv", PARQUET];
/// The ending of a table that is no text.
const PARQUET: &str = ".parquet";
/// Endings of files in JSON Lines.
const JSON_LINES: [&str; 2] = [".jsonl", ".ndjson"];
/// The ending of a bag in SQLite.
const DB3: &str = ".db3";
/// Endings of files of a bag that were compressed as a whole.
const COMPRESSED: [&str; 2] = [".mcap.zstd", ".db3.zstd"];
/// Endings of logs that are not read, with what to do.
const NOT_READ: [(&str, &str, &str); 4] = [
    (COMPRESSED[0], "an MCAP that was compressed as a whole", "decompress it: `zstd -d FILE`"),
    (COMPRESSED[1], "a SQLite bag that was compressed as a whole", "decompress it: `zstd -d FILE`"),
    (".bag", "a bag of ROS 1", "convert it: `rosbags-convert --src FILE --dst FOLDER --dst-storage mcap`"),
    (
        ".bag.active",
        "a bag of ROS 1 that was not closed",
        "`rosbag reindex FILE`, then convert it by `rosbags-convert`",
    ),
];

/// Whether a path is a log: by its ending, or a folder with files that rosbag2 wrote. One with a robot.toml is a robot, whatever
/// has been recorded into it.
pub fn is_log(path: &Path) -> bool {
    if path.is_dir() {
        let is_of_bag = |path: &PathBuf| is_one_of(path, &[MCAPS[0], DB3]) || not_read(path).is_some();
        let is_robot = |path: &PathBuf| is_one_of(path, &[".urdf"]);
        let is_bag = |files: Vec<PathBuf>| files.iter().any(is_of_bag) && !files.iter().any(is_robot);
        let has = |name: &str| path.join(name).is_file();
        return !has("robot.toml")
            && (has(METADATA) || parquet::is_dataset(path) || files_in(path).is_ok_and(is_bag));
    }
    is_table(path)
        || is_one_of(path, &JSON_LINES)
        || is_one_of(path, &MCAPS)
        || is_one_of(path, &[DB3])
        || not_read(path).is_some()
}

/// Whether a path is a log that is a table, by its ending.
pub fn is_table(path: &Path) -> bool {
    !path.is_dir() && is_one_of(path, &TABLES)
}

/// Opens a log: an MCAP, a SQLite bag (with the feature `db3`), a table in CSV or Parquet, JSON Lines, or a folder that
/// rosbag2 or LeRobot wrote.
///
/// # Errors
/// It cannot be read, or is of a format that is not; then the help says how to convert it.
pub fn open_log(path: &Path, options: &LogOptions) -> Result<Box<dyn LogReader>, Diagnostic> {
    if parquet::is_dataset(path) {
        return Ok(Box::new(TableReader::new(path, parquet::open(path, options.episode)?, options)?));
    }
    if options.episode.is_some() && path.exists() && !is_one_of(path, &[PARQUET]) {
        return Err(parquet::episode_refused(
            path,
            "is no dataset: it has no episodes",
            "leave --episode out: it is for Parquet and LeRobot",
        ));
    }
    if path.is_dir() {
        return open_folder(path);
    }
    if !path.exists() {
        return Err(Diagnostic::error(file::NOT_FOUND, absence(path)));
    }
    if let Some(refused) = not_read(path) {
        return Err(refused);
    }
    if is_table(path) {
        let table = if is_one_of(path, &[PARQUET]) {
            parquet::open(path, options.episode)?
        } else {
            csv::open(path)?
        };
        return Ok(Box::new(TableReader::new(path, table, options)?));
    }
    if is_one_of(path, &JSON_LINES) {
        return Ok(Box::new(JsonLinesReader::open(path)?));
    }
    if is_one_of(path, &[DB3]) {
        return db3::open(&[path.to_owned()], Vec::new());
    }
    Ok(Box::new(McapReader::new(vec![checked_mcap(path)?], Vec::new())))
}

fn is_one_of(path: &Path, endings: &[&str]) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
    endings.iter().any(|ending| name.ends_with(ending))
}

/// Why a file by its name is not read; `None` if it may be.
fn not_read(path: &Path) -> Option<Diagnostic> {
    let (_, what, help) = NOT_READ.iter().find(|(ending, ..)| is_one_of(path, &[ending]))?;
    let message = format!("{} is {what}, which is not read", path.display());
    Some(Diagnostic::error(codes::log::FORMAT, message).with_help(*help))
}

/// The path of an MCAP, whose first bytes are those of one.
fn checked_mcap(path: &Path) -> Result<PathBuf, Diagnostic> {
    let mut head = Vec::new();
    let file = open_regular(path, u64::MAX)?;
    file.take(MAGIC_BYTES).read_to_end(&mut head).map_err(|fault| unreadable(path, &fault))?;
    let name = path.display();
    if head.is_empty() {
        return Err(Diagnostic::error(file::EMPTY, format!("{name} is empty"))
            .with_help("a recorder writes nothing before its first topic: record it again"));
    }
    if !is_mcap(&head) {
        return Err(Diagnostic::error(codes::log::NOT_MCAP, format!("{name} does not begin as an MCAP"))
            .with_help("`file FILE` says what it is; copy it again if it was damaged"));
    }
    Ok(path.to_owned())
}

/// Opens the files of a folder that rosbag2 wrote, in the order of their numbers. What metadata.yaml says about them decides nothing: files
/// are renamed, rosbag2 itself writes it without names after a failure, and not at all if it is killed. Files that it names and that
/// are not there are a warning.
fn open_folder(folder: &Path) -> Result<Box<dyn LogReader>, Diagnostic> {
    let metadata = metadata_of(folder)?;
    if is_compressed_by_message(&metadata) {
        let message = format!("{}: each message is compressed on its own", folder.display());
        return Err(Diagnostic::error(codes::log::COMPRESSED_MESSAGES, message).with_help(CONVERT));
    }
    let files = files_in(folder)?;
    // Of files that were compressed one after the other, some may have both forms.
    let is_compressed =
        |path: &&PathBuf| is_one_of(path, &COMPRESSED) && !files.contains(&path.with_extension(""));
    let mut refused: Vec<Diagnostic> =
        files.iter().filter(is_compressed).filter_map(|path| not_read(path)).collect();
    refused.extend(missing_files(folder, &metadata, &files));
    let named = |ending: &str| -> Vec<PathBuf> {
        files.iter().filter(|path| is_one_of(path, &[ending])).cloned().collect()
    };
    let (mcaps, databases) = (named(MCAPS[0]), named(DB3));
    // A bag that was converted in its own folder has both: they are the same log.
    if mcaps.is_empty() && !databases.is_empty() {
        return db3::open(&databases, refused);
    }
    let mut whole = Vec::new();
    for path in mcaps {
        match checked_mcap(&path) {
            Ok(path) => whole.push(path),
            Err(fault) => refused.push(fault),
        }
    }
    if whole.is_empty() {
        let other = || files.iter().find_map(|path| not_read(path));
        let message = format!("{} has no file *.mcap or *.db3", folder.display());
        let none = || {
            Diagnostic::error(codes::log::FOLDER, message)
                .with_help("give the folder with the recorded files, or the .mcap itself")
        };
        return Err(refused.into_iter().next().or_else(other).unwrap_or_else(none));
    }
    Ok(Box::new(McapReader::new(whole, refused)))
}

/// The text of metadata.yaml; empty without one.
fn metadata_of(folder: &Path) -> Result<String, Diagnostic> {
    let metadata = folder.join(METADATA);
    if !metadata.exists() {
        return Ok(String::new());
    }
    Ok(read_text(&metadata, METADATA_BYTES)?.text.clone())
}

fn is_compressed_by_message(metadata: &str) -> bool {
    metadata.lines().any(|line| line.trim().to_lowercase() == "compression_mode: message")
}

/// The files that metadata.yaml names and that are not in the folder. Of a bag whose files were all renamed none is missing: as many
/// are there as it names.
fn missing_files(folder: &Path, metadata: &str, files: &[PathBuf]) -> Option<Diagnostic> {
    // The lists `relative_file_paths` and `files` with `path: NAME` have the same names.
    let name = |line: &str| {
        let line = line.trim().trim_start_matches("- ").trim();
        let value = line.strip_prefix("path:").unwrap_or(line).trim().trim_matches(['"', '\'']);
        let path = PathBuf::from(value);
        is_one_of(&path, &[MCAPS[0], DB3, COMPRESSED[0], COMPRESSED[1]]).then_some(path)
    };
    let named: BTreeSet<PathBuf> = metadata.lines().filter_map(name).collect();
    // One that was decompressed has lost its second ending.
    let is_there =
        |path: &&PathBuf| folder.join(path).is_file() || folder.join(path.with_extension("")).is_file();
    let missing: Vec<&PathBuf> = named.iter().filter(|path| !is_there(path)).collect();
    let is_of_bag = |path: &&PathBuf| is_one_of(path, &[MCAPS[0], DB3, COMPRESSED[0], COMPRESSED[1]]);
    if missing.is_empty() || files.iter().filter(is_of_bag).count() >= named.len() {
        return None;
    }
    let names: Vec<String> = missing.iter().map(|path| path.display().to_string()).collect();
    let message =
        format!("{}: metadata.yaml names files that are not there: {}", folder.display(), names.join(", "));
    Some(
        Diagnostic::error(codes::log::MISSING_FILES, message)
            .with_help("copy the whole folder again; what is judged is only a part of the recording"),
    )
}

/// The files of a folder in the order of their numbers, without hidden ones: macOS puts a file `._bag_0.mcap` beside `bag_0.mcap`.
fn files_in(folder: &Path) -> Result<Vec<PathBuf>, Diagnostic> {
    let entries = std::fs::read_dir(folder).map_err(|fault| unreadable(folder, &fault))?;
    let is_hidden =
        |path: &PathBuf| path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
    let mut files: Vec<PathBuf> =
        entries.flatten().map(|entry| entry.path()).filter(|path| !is_hidden(path)).collect();
    files.sort_by_cached_key(|path| by_number(path));
    Ok(files)
}

/// A name without and with the number at its end: `arm_2.mcap` is before `arm_10.mcap`.
fn by_number(path: &Path) -> (String, u64, PathBuf) {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let name = stem.trim_end_matches(|letter: char| letter.is_ascii_digit());
    let number = stem[name.len()..].parse().unwrap_or_default();
    (name.to_owned(), number, path.to_owned())
}

#[cfg(test)]
#[path = "open_tests.rs"]
mod tests;
