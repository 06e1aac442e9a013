//! A dataset of LeRobot as a folder: its files with rows, and what `meta/info.json` says about the state of the robot.

use std::path::{Path, PathBuf};

use congruent_input::{Diagnostic, read_text, unreadable};
use serde_json::Value;

/// What describes a dataset, from its folder on.
pub(super) const INFO: &str = "meta/info.json";
/// Most bytes of it. Kind: choice; it has some kB.
const INFO_BYTES: u64 = 16 << 20;
/// How many folders a file with rows is below that of its dataset: `data/chunk-000/file-000.parquet`.
const DEPTH: usize = 3;

/// Whether a folder is a dataset.
pub(crate) fn is_dataset(folder: &Path) -> bool {
    folder.join(INFO).is_file() && folder.join("data").is_dir()
}

/// The files of a dataset in the order of their numbers: one for each episode (v2), or for many (v3).
pub(super) fn files_of(dataset: &Path) -> Result<Vec<PathBuf>, Diagnostic> {
    let mut files = Vec::new();
    for chunk in sorted(&dataset.join("data"))?.into_iter().filter(|path| path.is_dir()) {
        let is_table = |path: &PathBuf| path.extension().is_some_and(|ending| ending == "parquet");
        files.extend(sorted(&chunk)?.into_iter().filter(is_table));
    }
    Ok(files)
}

/// Numbers in the names of a dataset have leading zeros: their order is that of the text.
fn sorted(folder: &Path) -> Result<Vec<PathBuf>, Diagnostic> {
    let entries = std::fs::read_dir(folder).map_err(|fault| unreadable(folder, &fault))?;
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    Ok(paths)
}

/// The names of the values of a list.
#[derive(Debug, Default)]
pub(super) struct ListNames {
    /// Empty if nothing says them.
    pub(super) names: Vec<String>,
    /// Why nothing says them, of what should: a verb with what follows.
    pub(super) fault: Option<String>,
}

/// The names of the values of a list in a dataset to which a file belongs.
pub(super) fn names_of(file: &Path, list: &str) -> Result<ListNames, Diagnostic> {
    let above = file.ancestors().skip(1).take(DEPTH).map(|folder| folder.join(INFO));
    let Some(info) = above.into_iter().find(|path| path.is_file()) else { return Ok(ListNames::default()) };
    let text = read_text(&info, INFO_BYTES)?.text.clone();
    let info: Value = match serde_json::from_str(&text) {
        Ok(info) => info,
        Err(fault) => {
            let fault = Some(format!("is no JSON ({fault})"));
            return Ok(ListNames { names: Vec::new(), fault });
        }
    };
    let mut names = Vec::new();
    collect(&info["features"][list]["names"], &mut names);
    let fault = names.is_empty().then(|| format!("has no names of the values of {list}"));
    Ok(ListNames { names, fault })
}

/// Names are a list, or a list under a key such as `motors`.
fn collect(value: &Value, names: &mut Vec<String>) {
    match value {
        Value::String(name) => names.push(name.clone()),
        Value::Array(values) => values.iter().for_each(|value| collect(value, names)),
        Value::Object(values) => values.values().for_each(|value| collect(value, names)),
        _ => {}
    }
}
