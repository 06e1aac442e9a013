//! Packages of a ROS installation, which are found by environment variables. They are read only if the user
//! requests it: without [`RosPackages::from_environment`] no variable is ever looked at.

use std::{
    ffi::OsStr,
    fs, io,
    path::{Path, PathBuf},
};

/// Folders below a folder of `ROS_PACKAGE_PATH` in which packages are looked for: `src/repository/package`.
const DEEPEST: usize = 3;
/// Most folders that are looked at for one package.
const MOST_FOLDERS: usize = 20_000;
/// The file that marks a package.
const MARK: &str = "package.xml";

/// Where packages of ROS may be; nowhere by default.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct RosPackages {
    /// Folders that hold packages, at any of the first levels: `ROS_PACKAGE_PATH`.
    pub package_paths: Vec<PathBuf>,
    /// Prefixes of installations, whose packages are in `share`: `AMENT_PREFIX_PATH`.
    pub prefixes: Vec<PathBuf>,
}

impl RosPackages {
    /// The folders that the environment variables `ROS_PACKAGE_PATH` and `AMENT_PREFIX_PATH` list.
    pub fn from_environment() -> Self {
        let folders = |name| {
            let value = std::env::var_os(name).unwrap_or_default();
            std::env::split_paths(&value).filter(|path| !path.as_os_str().is_empty()).collect()
        };
        Self { package_paths: folders("ROS_PACKAGE_PATH"), prefixes: folders("AMENT_PREFIX_PATH") }
    }

    /// The folder of a package, canonical: the first that is found.
    pub(crate) fn find(&self, package: &str) -> Option<PathBuf> {
        // A name with a separator, such as `../x`, would leave the folders that are searched.
        if Path::new(package).file_name() != Some(OsStr::new(package)) {
            return None;
        }
        let shared = self.prefixes.iter().map(|prefix| prefix.join("share").join(package));
        let shared = shared.filter(|folder| folder.is_dir());
        let mut crawled = self.package_paths.iter().filter_map(|folder| crawl(folder, package));
        shared.take(1).next().or_else(|| crawled.next())?.canonicalize().ok()
    }
}

/// The folder of a package at or below `top`, nearer ones first; nothing is looked for inside of packages and
/// hidden folders.
fn crawl(top: &Path, package: &str) -> Option<PathBuf> {
    let is_named = |folder: &Path| folder.file_name().is_some_and(|name| name == package);
    let (mut level, mut looked_at) = (vec![top.to_owned()], 0);
    for depth in 0..=DEEPEST {
        if let Some(found) =
            level.iter().find(|folder| is_named(folder) && (depth < 2 || folder.join(MARK).exists()))
        {
            return found.is_dir().then(|| found.clone());
        }
        looked_at += level.len();
        if looked_at > MOST_FOLDERS {
            return None;
        }
        let open = level.iter().filter(|folder| depth == 0 || !folder.join(MARK).exists());
        level = open.filter_map(|folder| subfolders(folder).ok()).flatten().collect();
    }
    None
}

fn subfolders(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let is_hidden =
        |path: &Path| path.file_name().is_some_and(|name| name.as_encoded_bytes().starts_with(b"."));
    let entries = fs::read_dir(folder)?.flatten().map(|entry| entry.path());
    let mut folders: Vec<PathBuf> = entries.filter(|path| path.is_dir() && !is_hidden(path)).collect();
    folders.sort();
    Ok(folders)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packages_are_found_in_workspaces_and_installations() {
        let top = tempfile::tempdir().unwrap();
        let real = top.path().canonicalize().unwrap();
        for folder in
            ["ws/src/repo/arm", "ws/src/repo/arm/inner", "ws/direct", "opt/share/arm", "opt/share/hand"]
        {
            fs::create_dir_all(real.join(folder)).unwrap();
        }
        for package in ["ws/src/repo/arm", "ws/src/repo/arm/inner"] {
            fs::write(real.join(package).join(MARK), "").unwrap();
        }
        let workspace = RosPackages { package_paths: vec![real.join("ws")], prefixes: Vec::new() };
        assert_eq!(workspace.find("arm"), Some(real.join("ws/src/repo/arm")));
        assert_eq!(workspace.find("direct"), Some(real.join("ws/direct")));
        // A package inside a package, a folder without a mark, and what leads elsewhere are none.
        for name in ["inner", "repo", "hand", "", "..", "../opt", "src/repo"] {
            assert_eq!(workspace.find(name), None, "{name}");
        }
        let itself = RosPackages { package_paths: vec![real.join("ws/direct")], prefixes: Vec::new() };
        assert_eq!(itself.find("direct"), Some(real.join("ws/direct")));
        let both = RosPackages { prefixes: vec![real.join("none"), real.join("opt")], ..workspace };
        assert_eq!(both.find("hand"), Some(real.join("opt/share/hand")));
        assert_eq!(both.find("arm"), Some(real.join("opt/share/arm")));
        assert_eq!(RosPackages::default().find("arm"), None);
    }
}
