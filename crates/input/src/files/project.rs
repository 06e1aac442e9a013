//! Finds the folder of a project, inside which a file may name other files.

use std::path::{Component, Path, PathBuf};

/// The nearest folder at or above `folder` that holds one of `marks`; if none does, the folder above it, or `current` if that
/// is higher. Never `/` or the home folder of the user.
pub(super) fn project_folder(folder: &Path, marks: &[&str], current: Option<&Path>) -> PathBuf {
    let home = std::env::var_os("HOME").and_then(|home| Path::new(&home).canonicalize().ok());
    below_home(folder, marks, current, home.as_deref())
}

fn below_home(folder: &Path, marks: &[&str], current: Option<&Path>, home: Option<&Path>) -> PathBuf {
    let too_wide = |folder: &Path| folder.parent().is_none() || home == Some(folder);
    let narrow = || folder.ancestors().take_while(|folder| !too_wide(folder));
    let marked = |folder: &&Path| marks.iter().any(|mark| folder.join(mark).exists());
    let higher = || narrow().enumerate().find(|&(above, folder)| above > 1 && current == Some(folder));
    let unmarked = || higher().map(|(_, folder)| folder).or_else(|| narrow().nth(1));
    narrow().find(marked).or_else(unmarked).unwrap_or(folder).to_owned()
}

/// The path without `.` and `..`, lexically.
pub(super) fn normalised(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for component in path.components() {
        match component {
            Component::CurDir => {}
            Component::ParentDir => {
                plain.pop();
            }
            other => plain.push(other),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_project_folder_is_never_the_root_or_a_home() {
        let home = Some(Path::new("/home/someone"));
        let check = |folder: &str, expected: &str| {
            assert_eq!(below_home(Path::new(folder), &[".git"], None, home), Path::new(expected));
        };
        check("/urdf", "/urdf");
        check("/home/someone", "/home/someone");
        check("/home/someone/arm", "/home/someone/arm");
        check("/home/someone/arm/urdf", "/home/someone/arm");
    }

    #[test]
    fn without_a_mark_the_project_may_be_where_the_user_is() {
        let check = |current: &str, expected: &str| {
            let current = Some(Path::new(current));
            let found = below_home(Path::new("/copy/scenarios/faults"), &[".git"], current, None);
            assert_eq!(found, Path::new(expected), "{current:?}");
        };
        check("/copy", "/copy");
        check("/copy/scenarios/faults", "/copy/scenarios");
        check("/", "/copy/scenarios");
        check("/elsewhere", "/copy/scenarios");
    }
}
