//! A path relative to a folder, by the names alone, and one without folders that it enters in vain.

use std::path::{Component, Path, PathBuf};

/// `path` relative to `folder`; `None` if they have no root in common, as two drives have none.
///
/// # Examples
/// ```
/// use std::path::{Path, PathBuf};
/// let relative = congruent_input::relative_path(Path::new("/a/b/c"), Path::new("/a/d/r.urdf"));
/// assert_eq!(relative, Some(PathBuf::from("../../d/r.urdf")));
/// ```
pub fn relative_path(folder: &Path, path: &Path) -> Option<PathBuf> {
    let shared = folder.components().zip(path.components()).take_while(|(a, b)| a == b).count();
    if shared == 0 && path.is_absolute() {
        return None;
    }
    let up = folder.components().skip(shared).map(|_| Component::ParentDir);
    let found: PathBuf = up.chain(path.components().skip(shared)).collect();
    // The folder itself.
    Some(if found.as_os_str().is_empty() { PathBuf::from(".") } else { found })
}

/// `path` without each `folder/..` and each `.`, if that is the same file: a folder that is a link has its parent elsewhere.
pub fn direct_path(path: &Path) -> PathBuf {
    let mut direct = PathBuf::new();
    for part in path.components() {
        let is_in_folder = matches!(direct.components().next_back(), Some(Component::Normal(_)));
        match part {
            Component::CurDir => {}
            Component::ParentDir if is_in_folder => {
                direct.pop();
            }
            part => direct.push(part),
        }
    }
    let is_same = || Some(direct.canonicalize().ok()? == path.canonicalize().ok()?);
    if !direct.as_os_str().is_empty() && is_same() == Some(true) { direct } else { path.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_that_is_left_again_is_not_in_the_path() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("arm.urdf");
        std::fs::create_dir(folder.path().join("table")).unwrap();
        std::fs::write(&file, "").unwrap();
        assert_eq!(direct_path(&folder.path().join("table/.././arm.urdf")), file);
        // What does not exist is named as it is written.
        let missing = folder.path().join("nowhere/../arm.urdf");
        assert_eq!(direct_path(&missing), missing);
        assert_eq!(direct_path(Path::new("../x/../../y")), Path::new("../x/../../y"));
    }
}
