//! A path relative to a folder, by the names alone.

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
