//! Which folders may hold meshes: turns the path or URI in a URDF into a file inside those.
//!
//! One is the project folder. It is not the URDF's own, since real robots say `../meshes/x.stl`, but the
//! nearest folder at or above the URDF that holds `package.xml`, `robot.toml` or `.git`; if none does,
//! it is the folder above the URDF's. It is never `/` or a home folder. The others are the folders that
//! a robot file declares under `packages`. Symbolic links are resolved before a path is compared with
//! these folders, and nothing outside of them is opened.

use std::{
    collections::BTreeMap,
    io,
    path::{Component, Path, PathBuf},
};

use crate::diagnostic::Diagnostic;

/// Names that mark the top folder of a project.
const MARKS: [&str; 3] = ["package.xml", "robot.toml", ".git"];

/// The folders in which the meshes of one URDF may be; all canonical.
#[derive(Debug)]
pub(crate) struct Packages {
    urdf_folder: PathBuf,
    project_folder: PathBuf,
    declared: BTreeMap<String, PathBuf>,
}

impl Packages {
    /// For a URDF in `urdf_folder`; `declared` are folders of packages by name.
    pub(crate) fn new(urdf_folder: &Path, declared: BTreeMap<String, PathBuf>) -> io::Result<Self> {
        let urdf_folder = urdf_folder.canonicalize()?;
        let home = std::env::var_os("HOME").and_then(|home| Path::new(&home).canonicalize().ok());
        let project_folder = project_folder(&urdf_folder, home.as_deref());
        Ok(Self { urdf_folder, project_folder, declared })
    }

    /// The regular file that `uri` names: `package://PKG/rest`, `file:///path` or a path relative
    /// to the URDF.
    pub(crate) fn resolve(&self, uri: &str) -> Result<PathBuf, Diagnostic> {
        let mut tried = Vec::new();
        for candidate in self.candidates(uri)? {
            let outside = || {
                let message = format!(
                    "mesh \"{uri}\" leaves the project folder {}: refused",
                    self.project_folder.display()
                );
                Diagnostic::error("mesh::outside", message).with_help(
                    "mesh paths must stay inside the project; declare other folders under `packages` in robot.toml",
                )
            };
            let candidate = normalised(&candidate);
            if !self.allows(&candidate) {
                return Err(outside());
            }
            match candidate.canonicalize() {
                Ok(real) if !self.allows(&real) => return Err(outside()),
                Ok(real) => return Ok(real),
                Err(_) => tried.push(candidate.display().to_string()),
            }
        }
        let help = match uri.strip_prefix("package://") {
            Some(rest) => format!(
                "tried {}; declare the folder of package \"{}\" under `packages` in robot.toml",
                tried.join(", "),
                rest.split('/').next().unwrap_or_default()
            ),
            None => format!("tried {}", tried.join(", ")),
        };
        let message = format!("mesh file \"{uri}\" not found");
        Err(Diagnostic::error("mesh::not_found", message).with_help(help))
    }

    /// Whether a path is lexically inside an allowed folder.
    pub(crate) fn allows(&self, path: &Path) -> bool {
        let path = normalised(path);
        std::iter::once(&self.project_folder).chain(self.declared.values()).any(|root| path.starts_with(root))
    }

    fn candidates(&self, uri: &str) -> Result<Vec<PathBuf>, Diagnostic> {
        let Some((scheme, rest)) = uri.split_once("://") else {
            return Ok(vec![self.urdf_folder.join(uri)]);
        };
        match scheme.to_ascii_lowercase().as_str() {
            "file" => Ok(vec![self.urdf_folder.join(rest)]),
            "package" => {
                let (package, rest) = rest.split_once('/').unwrap_or((rest, ""));
                Ok(self.package_folders(package).into_iter().map(|folder| folder.join(rest)).collect())
            }
            "http" | "https" => {
                let message =
                    format!("mesh \"{uri}\": network paths are not allowed, no connection was made");
                Err(Diagnostic::error("mesh::network", message)
                    .with_help("put the mesh beside the URDF and name it by a relative path"))
            }
            _ => {
                let message = format!("mesh \"{uri}\": unknown scheme {scheme}://");
                Err(Diagnostic::error("mesh::scheme", message)
                    .with_help("use package://, file:// or a path relative to the URDF"))
            }
        }
    }

    /// The folders that may be a package: the declared one, or else every folder from the URDF's up to the
    /// project folder that has its name or a child of that name.
    fn package_folders(&self, package: &str) -> Vec<PathBuf> {
        if let Some(folder) = self.declared.get(package) {
            return vec![folder.clone()];
        }
        let inside =
            self.urdf_folder.ancestors().take_while(|folder| folder.starts_with(&self.project_folder));
        let mut folders = Vec::new();
        for folder in inside {
            if folder.file_name().is_some_and(|name| name == package) {
                folders.push(folder.to_owned());
            }
            folders.push(folder.join(package));
        }
        folders
    }
}

fn project_folder(urdf_folder: &Path, home: Option<&Path>) -> PathBuf {
    let too_wide = |folder: &Path| folder.parent().is_none() || home == Some(folder);
    let narrow = || urdf_folder.ancestors().take_while(|folder| !too_wide(folder));
    let marked = |folder: &&Path| MARKS.iter().any(|mark| folder.join(mark).exists());
    narrow().find(marked).or_else(|| narrow().nth(1)).unwrap_or(urdf_folder).to_owned()
}

/// The path without `.` and `..`, lexically.
fn normalised(path: &Path) -> PathBuf {
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
    use std::fs;

    use super::*;

    /// `top/robot/urdf` with a mesh in `top/robot/meshes` and one in `top/outside`.
    fn project(mark: Option<&str>) -> (tempfile::TempDir, Packages) {
        let top = tempfile::tempdir().unwrap();
        for folder in ["robot/urdf/pkg", "robot/meshes", "outside"] {
            fs::create_dir_all(top.path().join(folder)).unwrap();
        }
        for file in ["robot/meshes/a.stl", "robot/urdf/pkg/b.stl", "outside/c.stl"] {
            fs::write(top.path().join(file), "").unwrap();
        }
        if let Some(mark) = mark {
            fs::write(top.path().join(mark), "").unwrap();
        }
        let packages = Packages::new(&top.path().join("robot/urdf"), BTreeMap::new()).unwrap();
        (top, packages)
    }

    #[track_caller]
    fn found(packages: &Packages, uri: &str, end: &str) {
        let path = packages.resolve(uri).unwrap();
        assert!(path.ends_with(end), "{}", path.display());
    }

    #[track_caller]
    fn refused(packages: &Packages, uri: &str, code: &str) {
        assert_eq!(packages.resolve(uri).unwrap_err().code, code, "{uri}");
    }

    #[test]
    fn meshes_inside_the_project_are_found() {
        let (top, packages) = project(None);
        found(&packages, "../meshes/a.stl", "robot/meshes/a.stl");
        found(&packages, "package://pkg/b.stl", "urdf/pkg/b.stl");
        found(&packages, "package://robot/meshes/a.stl", "robot/meshes/a.stl");
        let absolute = top.path().canonicalize().unwrap().join("robot/meshes/a.stl");
        found(&packages, &format!("file://{}", absolute.display()), "robot/meshes/a.stl");
    }

    #[test]
    fn meshes_outside_the_project_are_refused() {
        let (top, packages) = project(None);
        refused(&packages, "../../outside/c.stl", "mesh::outside");
        refused(&packages, "../../../../../../../../etc/hosts", "mesh::outside");
        refused(&packages, "file:///etc/hosts", "mesh::outside");
        refused(&packages, "package://../../outside/c.stl", "mesh::outside");
        refused(&packages, "HTTP://127.0.0.1:9/a.stl", "mesh::network");
        refused(&packages, "model://a.stl", "mesh::scheme");
        refused(&packages, "nope.stl", "mesh::not_found");
        refused(&packages, "package://other/b.stl", "mesh::not_found");
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(top.path().join("outside"), top.path().join("robot/link")).unwrap();
            refused(&packages, "../link/c.stl", "mesh::outside");
        }
    }

    #[test]
    fn a_mark_sets_the_project_folder_and_declared_folders_are_allowed() {
        let (_top, packages) = project(Some(".git"));
        found(&packages, "../../outside/c.stl", "outside/c.stl");
        let (_top, packages) = project(Some("robot/urdf/package.xml"));
        refused(&packages, "../meshes/a.stl", "mesh::outside");
        let (top, _) = project(None);
        let declared =
            BTreeMap::from([("far".to_owned(), top.path().join("outside").canonicalize().unwrap())]);
        let packages = Packages::new(&top.path().join("robot/urdf"), declared).unwrap();
        found(&packages, "package://far/c.stl", "outside/c.stl");
    }

    #[test]
    fn the_project_folder_is_never_the_root_or_a_home() {
        let home = Some(Path::new("/home/someone"));
        assert_eq!(project_folder(Path::new("/urdf"), home), Path::new("/urdf"));
        assert_eq!(project_folder(Path::new("/home/someone"), home), Path::new("/home/someone"));
        assert_eq!(project_folder(Path::new("/home/someone/arm"), home), Path::new("/home/someone/arm"));
        assert_eq!(project_folder(Path::new("/home/someone/arm/urdf"), home), Path::new("/home/someone/arm"));
    }
}
