//! Resolves the path or URI of a mesh in a URDF to a file inside the folders that may hold meshes.
//!
//! One is the project folder. It is not the URDF's own, since real robots say `../meshes/x.stl`, but the
//! nearest folder at or above the URDF that holds `package.xml` or `.git`, as for every other file; if none does,
//! it is the folder above the URDF's. It is never `/` or a home folder. The others are the folders that
//! a robot file or the command line declares, ROS packages, and folders that the user allows. Behind a fence
//! nothing outside of them is opened; symbolic links are resolved before a path is compared with these folders.

use std::{
    collections::BTreeMap,
    io,
    path::{Path, PathBuf},
};

use super::{
    access::FileAccess,
    project::{normalised, project_folder},
    ros_packages::RosPackages,
};
use crate::{codes, diagnostic::Diagnostic};

/// Names that mark the top folder of a project.
const MARKS: [&str; 2] = ["package.xml", ".git"];

/// The folders in which the meshes of one URDF may be; all canonical.
#[derive(Debug)]
pub struct Packages {
    urdf_folder: PathBuf,
    project_folder: PathBuf,
    /// Folders of packages by name: those that the robot file declares, and ROS packages that were searched (`None` if not
    /// found).
    known: BTreeMap<String, Option<PathBuf>>,
    ros: RosPackages,
    /// Folders that a person allows.
    allowed: Vec<PathBuf>,
    is_fenced: bool,
}

/// A file that a URI names.
pub struct Resolved {
    /// The file that was found.
    pub path: PathBuf,
    /// A warning about a URI whose file was found although the URI is not correct.
    pub warning: Option<Diagnostic>,
}

impl Packages {
    /// For a URDF in `urdf_folder`; `declared` are folders of packages by name.
    ///
    /// # Errors
    /// The folder of the URDF does not exist.
    pub fn new(
        urdf_folder: &Path,
        declared: BTreeMap<String, PathBuf>,
        access: &FileAccess,
    ) -> io::Result<Self> {
        let urdf_folder = urdf_folder.canonicalize()?;
        let own = project_folder(&urdf_folder, &MARKS, None);
        // Never wider than the project of the file that names the URDF.
        let around = access.project().filter(|project| project.starts_with(&own));
        let project_folder = around.map_or(own, Path::to_owned);
        // The command line has the last word.
        let declared = declared.into_iter().chain(access.packages().clone());
        let known = declared.map(|(name, folder)| (name, Some(folder))).collect();
        let (ros, allowed) = (access.ros().clone(), access.allowed().to_vec());
        Ok(Self { urdf_folder, project_folder, known, ros, allowed, is_fenced: access.is_fenced() })
    }

    /// The regular file that `uri` names: `package://PKG/rest`, `file:///path` or a path relative
    /// to the URDF.
    ///
    /// # Errors
    /// There is no such file, or it may not be opened; the finding lists the paths that were tried.
    pub fn resolve(&mut self, uri: &str) -> Result<Resolved, Diagnostic> {
        let mut tried = Vec::new();
        for candidate in self.candidates(uri)? {
            let outside = || {
                let message = format!(
                    "mesh \"{uri}\" is outside of the project folder {}, so it is not opened",
                    self.project_folder.display()
                );
                Diagnostic::error(codes::mesh::OUTSIDE, message)
                    .one_of("meshes are outside of the project folder, so they are not opened", uri)
                    .with_help(
                        "move the mesh into the project, allow its folder with --allow DIR, or leave out --fence",
                    )
            };
            let candidate = normalised(&candidate);
            // By its name first, so that nothing outside is looked at; then by the real path, since a link may lead
            // out.
            if self.is_fenced && !self.allows(&candidate) {
                return Err(outside());
            }
            match candidate.canonicalize() {
                Ok(real) if self.is_fenced && !self.allows(&real) => return Err(outside()),
                Ok(path) => return Ok(Resolved { warning: three_slashes(uri, &path), path }),
                Err(_) => tried.push(candidate.display().to_string()),
            }
        }
        let message = format!("mesh file \"{uri}\" not found");
        let fault = Diagnostic::error(codes::mesh::NOT_FOUND, message);
        // The names of files distinguish meshes of one package.
        let fault = match package_of(uri) {
            Some((package, rest)) => {
                let name = rest.rsplit('/').next().unwrap_or(rest);
                fault.one_of(format!("mesh files of package \"{package}\" are not found"), name)
            }
            None => fault.one_of("mesh files are not found", uri),
        };
        let tried = tried.join(", ");
        Err(fault.with_help(match package_of(uri) {
            Some((package, _)) => format!(
                "tried {tried}; give the folder of the package with --package {package}=DIR, in robot.toml as packages = {{ {package} = \
                 \"../{package}\" }}, or in ROS_PACKAGE_PATH or AMENT_PREFIX_PATH"
            ),
            None => format!("tried {tried}"),
        }))
    }

    /// Whether a path is lexically inside an allowed folder.
    pub fn allows(&self, path: &Path) -> bool {
        let path = normalised(path);
        std::iter::once(&self.project_folder)
            .chain(self.known.values().flatten())
            .chain(&self.allowed)
            .any(|root| path.starts_with(root))
    }

    fn candidates(&mut self, uri: &str) -> Result<Vec<PathBuf>, Diagnostic> {
        if let Some((package, rest)) = package_of(uri) {
            let mut candidates: Vec<PathBuf> =
                self.package_folders(package).into_iter().map(|folder| folder.join(rest)).collect();
            if names_no_package(uri) {
                // Exporters mean the URDF's own folder or package.
                let own = [&self.urdf_folder, &self.project_folder];
                candidates.extend(own.map(|folder| folder.join(package).join(rest)));
            }
            return Ok(candidates);
        }
        let Some((scheme, rest)) = uri.split_once("://") else {
            return Ok(vec![self.urdf_folder.join(uri)]);
        };
        match scheme.to_ascii_lowercase().as_str() {
            "file" => Ok(vec![self.urdf_folder.join(rest)]),
            "http" | "https" => {
                let message =
                    format!("mesh \"{uri}\": network paths are not allowed, no connection was made");
                Err(Diagnostic::error(codes::mesh::NETWORK, message)
                    .one_of("meshes are on the network, which is never used", uri)
                    .with_help("put meshes beside the URDF and name them by relative paths"))
            }
            _ => {
                let message = format!("mesh \"{uri}\": unknown scheme {scheme}://");
                Err(Diagnostic::error(codes::mesh::SCHEME, message)
                    .one_of("mesh addresses have an unknown scheme (known: package://, file://)", uri)
                    .with_help("use package://, file:// or a path relative to the URDF"))
            }
        }
    }

    /// The folders that may be a package: the declared one, or else every folder from the URDF's up to the
    /// project folder that has its name or a child of that name, or else a package of ROS.
    fn package_folders(&mut self, package: &str) -> Vec<PathBuf> {
        if let Some(Some(folder)) = self.known.get(package) {
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
        if folders.iter().any(|folder| folder.is_dir()) {
            return folders;
        }
        let ros = &self.ros;
        let found = self.known.entry(package.to_owned()).or_insert_with(|| ros.find(package));
        found.clone().map_or(folders, |found| vec![found])
    }
}

/// Package and path of a `package://` address; of one with a third slash the first two parts of its path.
fn package_of(uri: &str) -> Option<(&str, &str)> {
    let (scheme, rest) = uri.split_once("://")?;
    let rest = rest.trim_start_matches('/');
    scheme.eq_ignore_ascii_case("package").then(|| rest.split_once('/').unwrap_or((rest, "")))
}

/// Whether a `package://` address has a third slash, before which there is no name.
fn names_no_package(uri: &str) -> bool {
    uri.contains(":///")
}

fn three_slashes(uri: &str, found: &Path) -> Option<Diagnostic> {
    package_of(uri).filter(|_| names_no_package(uri))?;
    let message = format!(
        "mesh \"{uri}\" has three slashes, so it names no package; the file was found as {}",
        found.display()
    );
    Some(
        Diagnostic::warning(codes::mesh::PACKAGE_SLASHES, message)
            .one_of("mesh addresses have three slashes, so they name no package; the files were found", uri)
            .with_help("write package://NAME/... with two slashes, or a path relative to the URDF"),
    )
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
        let packages =
            Packages::new(&top.path().join("robot/urdf"), BTreeMap::new(), &FileAccess::default().fenced())
                .unwrap();
        (top, packages)
    }

    #[track_caller]
    fn found(packages: &mut Packages, uri: &str, end: &str) {
        let path = packages.resolve(uri).unwrap().path;
        assert!(path.ends_with(end), "{}", path.display());
    }

    #[track_caller]
    fn refused(packages: &mut Packages, uri: &str, code: &str) {
        assert_eq!(packages.resolve(uri).err().map(|fault| fault.code.name), Some(code), "{uri}");
    }

    #[test]
    fn meshes_inside_the_project_are_found() {
        let (top, mut packages) = project(None);
        found(&mut packages, "../meshes/a.stl", "robot/meshes/a.stl");
        found(&mut packages, "package://pkg/b.stl", "urdf/pkg/b.stl");
        found(&mut packages, "package://robot/meshes/a.stl", "robot/meshes/a.stl");
        let absolute = top.path().canonicalize().unwrap().join("robot/meshes/a.stl");
        found(&mut packages, &format!("file://{}", absolute.display()), "robot/meshes/a.stl");
    }

    #[test]
    fn meshes_outside_the_project_are_refused() {
        let (top, mut packages) = project(None);
        refused(&mut packages, "../../outside/c.stl", "mesh::outside");
        refused(&mut packages, "../../../../../../../../etc/hosts", "mesh::outside");
        refused(&mut packages, "file:///etc/hosts", "mesh::outside");
        refused(&mut packages, "package://../../outside/c.stl", "mesh::outside");
        refused(&mut packages, "HTTP://127.0.0.1:9/a.stl", "mesh::network");
        refused(&mut packages, "model://a.stl", "mesh::scheme");
        refused(&mut packages, "nope.stl", "mesh::not_found");
        refused(&mut packages, "package://other/b.stl", "mesh::not_found");
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(top.path().join("outside"), top.path().join("robot/link")).unwrap();
            refused(&mut packages, "../link/c.stl", "mesh::outside");
        }
    }

    #[test]
    fn without_a_fence_meshes_are_found_wherever_they_are() {
        let (top, _) = project(None);
        let urdf_folder = top.path().join("robot/urdf");
        let open = |access: &FileAccess| Packages::new(&urdf_folder, BTreeMap::new(), access).unwrap();
        let mut packages = open(&FileAccess::default());
        found(&mut packages, "../../outside/c.stl", "outside/c.stl");
        let whole = top.path().join("outside/c.stl");
        found(&mut packages, &format!("file://{}", whole.display()), "outside/c.stl");
        refused(&mut packages, "HTTP://127.0.0.1:9/a.stl", "mesh::network");
        // The command line says where a package is, also behind a fence.
        let given = [format!("far={}", top.path().join("outside").display())];
        let access = FileAccess::default().with_packages(&given).unwrap();
        found(&mut open(&access), "package://far/c.stl", "outside/c.stl");
        found(&mut open(&access.fenced()), "package://far/c.stl", "outside/c.stl");
        for wrong in ["far", "far=/nowhere/at/all", "=.", ""] {
            assert!(FileAccess::default().with_packages(&[wrong.to_owned()]).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_mark_sets_the_project_folder_and_declared_folders_are_allowed() {
        let (_top, mut packages) = project(Some(".git"));
        found(&mut packages, "../../outside/c.stl", "outside/c.stl");
        let (_top, mut packages) = project(Some("robot/urdf/package.xml"));
        refused(&mut packages, "../meshes/a.stl", "mesh::outside");
        let (top, _) = project(None);
        let declared =
            BTreeMap::from([("far".to_owned(), top.path().join("outside").canonicalize().unwrap())]);
        let mut packages =
            Packages::new(&top.path().join("robot/urdf"), declared, &FileAccess::default().fenced()).unwrap();
        found(&mut packages, "package://far/c.stl", "outside/c.stl");
    }

    /// A repository with a folder for each robot, which has its robot file beside its URDF, and meshes that they share.
    #[test]
    fn a_robot_file_beside_the_urdf_is_no_top_of_a_project() {
        let top = tempfile::tempdir().unwrap();
        for folder in [".git", "robots/a", "meshes"] {
            fs::create_dir_all(top.path().join(folder)).unwrap();
        }
        let robot_file = top.path().join("robots/a/robot.toml");
        for file in [&robot_file, &top.path().join("meshes/m.obj")] {
            fs::write(file, "").unwrap();
        }
        let fenced = FileAccess::default().fenced();
        for access in [fenced.inside_project_of(&robot_file).unwrap(), fenced] {
            let mut packages = Packages::new(&top.path().join("robots/a"), BTreeMap::new(), &access).unwrap();
            found(&mut packages, "../../meshes/m.obj", "meshes/m.obj");
            refused(&mut packages, "../../../etc/hosts", "mesh::outside");
        }
    }

    #[test]
    fn packages_of_ros_are_allowed_only_where_they_are_asked_for() {
        let (top, mut packages) = project(None);
        let far = top.path().join("ros/share/far");
        fs::create_dir_all(&far).unwrap();
        fs::write(far.join("d.stl"), "").unwrap();
        fs::write(top.path().join("ros/share/e.stl"), "").unwrap();
        refused(&mut packages, "package://far/d.stl", "mesh::not_found");
        let ros = RosPackages { prefixes: vec![top.path().join("ros")], ..RosPackages::default() };
        let access = FileAccess::new(ros, &[]).unwrap().fenced();
        let mut packages = Packages::new(&top.path().join("robot/urdf"), BTreeMap::new(), &access).unwrap();
        found(&mut packages, "package://far/d.stl", "far/d.stl");
        // The package itself and nothing else.
        refused(&mut packages, "package://far/../e.stl", "mesh::outside");
        refused(&mut packages, "package://other/d.stl", "mesh::not_found");
    }

    #[test]
    fn three_slashes_are_read_and_reported() {
        let (_top, mut packages) = project(None);
        assert_eq!(packages.resolve("package://pkg/b.stl").ok().and_then(|found| found.warning), None);
        let warning = packages.resolve("package:///pkg/b.stl").ok().and_then(|found| found.warning);
        assert_eq!(warning.map(|warning| warning.code.name), Some("mesh::package_slashes"));
        // Without a package: beside the URDF, or in its project.
        found(&mut packages, "package:///pkg/b.stl", "urdf/pkg/b.stl");
        found(&mut packages, "package:///robot/meshes/a.stl", "robot/meshes/a.stl");
        refused(&mut packages, "package:///../../outside/c.stl", "mesh::outside");
        refused(&mut packages, "package:///c.stl", "mesh::not_found");
    }
}
