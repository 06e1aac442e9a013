//! Parts of both files: comments, and relative paths to the files that they name.

use std::path::{Path, PathBuf};

/// A file as an absolute path. The folder is freed of symbolic links, the file is not: a URDF finds its meshes from the
/// folder that it is named in.
pub(super) fn absolute(path: &Path) -> PathBuf {
    if path.is_dir() {
        return path.canonicalize().unwrap_or_else(|_| path.to_owned());
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    match (folder.canonicalize(), path.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => path.to_owned(),
    }
}

/// Words as lines of comments. Names of a URDF may hold characters that no comment of TOML may.
pub(super) fn comment(words: &str) -> String {
    let is_allowed = |c: char| !c.is_control() || c == '\n';
    let words: String =
        words.chars().map(|c| if is_allowed(c) { c } else { char::REPLACEMENT_CHARACTER }).collect();
    words.lines().fold(String::new(), |text, line| text + format!("# {line}").trim_end() + "\n")
}
