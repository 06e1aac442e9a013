//! Paths as results name them: none begins at the root of a machine, so that a result can be shown to others.

use std::path::{Component, Path, PathBuf};

/// A path as a result names it: an absolute one relative to the current folder, so that a command with it still works there;
/// only its last part if there is no way from one to the other, as between drives.
pub fn portable_path(path: &Path) -> PathBuf {
    if !path.is_absolute() {
        return path.to_owned();
    }
    let current = std::env::current_dir().unwrap_or_default();
    relative(path, &current).unwrap_or_else(|| path.file_name().map_or_else(PathBuf::new, PathBuf::from))
}

/// An absolute path relative to a folder; `None` if they have no root in common.
fn relative(path: &Path, folder: &Path) -> Option<PathBuf> {
    let root = |path: &Path| path.components().next().map(|first| first.as_os_str().to_owned());
    if root(path) != root(folder) {
        return None;
    }
    let (mut steps, mut parts) = (folder.components().peekable(), path.components().peekable());
    while steps.peek().is_some() && steps.peek() == parts.peek() {
        (steps.next(), parts.next());
    }
    let up = steps.map(|_| Component::ParentDir);
    let found: PathBuf = up.chain(parts).collect();
    // The folder itself.
    Some(if found.as_os_str().is_empty() { PathBuf::from(".") } else { found })
}

#[cfg(test)]
mod tests {
    use super::*;

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
            assert_eq!(relative(Path::new(path), folder).as_deref(), Some(Path::new(expected)), "{path}");
        }
        assert_eq!(portable_path(Path::new("scenarios/a.toml")), Path::new("scenarios/a.toml"));
        assert!(portable_path(Path::new("/somewhere/else/a.toml")).is_relative());
    }
}
