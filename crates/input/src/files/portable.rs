//! Paths as results name them: none begins at the root of a machine, so that a result can be shown to others.

use std::path::{Path, PathBuf};

use super::relative_path::relative_path;

/// A path as a result names it: an absolute one relative to the current folder, so that a command with it still works there;
/// only its last part if there is no path from one to the other, as between drives.
pub fn portable_path(path: &Path) -> PathBuf {
    if !path.is_absolute() {
        return path.to_owned();
    }
    let current = std::env::current_dir().unwrap_or_default();
    relative_path(&current, path).unwrap_or_else(|| path.file_name().map_or_else(PathBuf::new, PathBuf::from))
}

/// A text of a result in which every absolute path of an input is written as results name it; of JSON, too.
pub fn portable_text(text: &str, inputs: &[impl AsRef<Path>]) -> String {
    let mut paths: Vec<&Path> = inputs.iter().map(AsRef::as_ref).filter(|path| path.is_absolute()).collect();
    // The longest first: one path may begin with another.
    paths.sort_by_key(|path| std::cmp::Reverse(path.as_os_str().len()));
    let in_json = |path: &Path| path.display().to_string().replace('\\', r"\\");
    paths.into_iter().fold(text.to_owned(), |text, path| {
        let named = portable_path(path);
        let text = with_path(&text, &path.display().to_string(), &named.display().to_string());
        with_path(&text, &in_json(path), &in_json(&named))
    })
}

/// A text with another path in place of an absolute one; of a longer path that only contains it, nothing is replaced: it may be
/// the relative one.
fn with_path(text: &str, absolute: &str, named: &str) -> String {
    let (mut replaced, mut done) = (String::with_capacity(text.len()), 0);
    for (at, _) in text.match_indices(absolute) {
        let before = text[..at].chars().next_back();
        let begins = before.is_none_or(|letter| !(letter.is_alphanumeric() || "./\\_-".contains(letter)));
        if begins {
            replaced.push_str(&text[done..at]);
            replaced.push_str(named);
            done = at + absolute.len();
        }
    }
    replaced.push_str(&text[done..]);
    replaced
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn a_text_names_inputs_without_the_root() {
        let input = |path: &str| PathBuf::from(path);
        let inputs = [input("/nowhere/arm"), input("/nowhere/arm.urdf"), input("cell.toml")];
        let text = portable_text("/nowhere/arm.urdf:7 and \"/nowhere/arm\" and cell.toml", &inputs);
        assert!(!text.contains(" /nowhere") && !text.starts_with('/') && !text.contains("\"/"), "{text}");
        assert!(
            text.contains("nowhere/arm.urdf:7 and \"") && text.ends_with("nowhere/arm\" and cell.toml"),
            "{text}"
        );
    }

    #[cfg(unix)]
    #[test]
    fn no_path_begins_at_the_root() {
        let folder = Path::new("/home/ann/cell");
        for (path, expected) in [
            ("/home/ann/cell/robots/arm.toml", "robots/arm.toml"),
            ("/home/ann/other/arm.toml", "../other/arm.toml"),
            ("/tmp/arm.toml", "../../../tmp/arm.toml"),
            ("/home/ann/cell", "."),
        ] {
            assert_eq!(
                relative_path(folder, Path::new(path)).as_deref(),
                Some(Path::new(expected)),
                "{path}"
            );
        }
        assert_eq!(portable_path(Path::new("scenarios/a.toml")), Path::new("scenarios/a.toml"));
        assert!(portable_path(Path::new("/somewhere/else/a.toml")).is_relative());
    }
}
