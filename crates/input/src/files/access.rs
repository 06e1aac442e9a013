//! Decides which files another file may name, and records which files were read.

use std::{
    collections::BTreeMap,
    fmt::Display,
    fs,
    io::{self, Read},
    path::{Path, PathBuf},
    sync::{Arc, Mutex},
};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::{
    kind::TextKind,
    open::{decode_text, folder_of, read_named_bytes, read_regular_bytes, unreadable},
    portable::portable_path,
    project::{normalised, project_folder},
    ros_packages::RosPackages,
};
use crate::{
    codes,
    diagnostic::{Diagnostic, SourceFile},
};

/// Names that mark the top folder of a project of scenarios and robot files.
const MARKS: [&str; 2] = ["package.xml", ".git"];

/// Permission to open files, and the record of the files that were read.
///
/// A file that a person names, on the command line or in a call, is opened wherever it is, and so is a regular file that such a file
/// names, if it is what is expected there: a URDF, an SRDF, a robot file, a mesh or a table. No line is quoted of a file outside the
/// project of the first file: the nearest folder at or above it that holds `package.xml` or `.git`, or else the folder above its own,
/// or the current folder if that is higher above it, but never `/` or the home folder; symbolic links are resolved. A fence
/// ([`FileAccess::fenced`]) refuses these files. Folders that a person allows count as the project.
#[derive(Debug, Clone, Default)]
pub struct FileAccess {
    ros: RosPackages,
    allowed: Vec<PathBuf>,
    /// The project, canonical; `None` until a file names others.
    project: Option<PathBuf>,
    is_fenced: bool,
    /// Folders of ROS packages by name, as a person gives them.
    packages: BTreeMap<String, PathBuf>,
    read: Arc<Mutex<Vec<InputFile>>>,
}

/// A file that was read.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct InputFile {
    /// The file as it was named: a path, never an absolute one, or the address of a mesh.
    pub file: String,
    /// SHA-256 of its bytes.
    pub sha256: String,
    /// Path of the file on this machine.
    #[serde(skip)]
    pub path: PathBuf,
}

/// Its path.
impl AsRef<Path> for InputFile {
    fn as_ref(&self) -> &Path {
        &self.path
    }
}

impl FileAccess {
    /// With the ROS packages to search, and with further folders that may be opened.
    ///
    /// # Errors
    /// One of `allowed` is not a folder.
    pub fn new(ros: RosPackages, allowed: &[PathBuf]) -> Result<Self, Diagnostic> {
        let canonical = |folder: &PathBuf| {
            let real = folder.canonicalize().ok().filter(|real| real.is_dir());
            real.ok_or_else(|| {
                let message = format!("--allow {}: not a folder", folder.display());
                Diagnostic::error(codes::file::ALLOW, message)
                    .with_help("give a folder that exists, whose files may be opened")
            })
        };
        let allowed = allowed.iter().map(canonical).collect::<Result<_, _>>()?;
        Ok(Self { ros, allowed, ..Self::default() })
    }

    /// The same behind a fence: a file names only what is in its project.
    #[must_use]
    pub fn fenced(self) -> Self {
        Self { is_fenced: true, ..self }
    }

    /// The same with folders of ROS packages, each as `NAME=DIR`.
    ///
    /// # Errors
    /// One is not written so, or is not a folder.
    pub fn with_packages(mut self, packages: &[String]) -> Result<Self, Diagnostic> {
        for written in packages {
            let (name, folder) = written.split_once('=').unwrap_or((written, ""));
            let real = Path::new(folder).canonicalize().ok().filter(|real| real.is_dir());
            let Some(real) = real.filter(|_| !name.is_empty()) else {
                let message = format!("--package {written}: expected NAME=DIR with a folder that exists");
                return Err(Diagnostic::error(codes::file::ALLOW, message)
                    .with_help("--package my_description=../my_description"));
            };
            self.packages.insert(name.to_owned(), real);
        }
        Ok(self)
    }

    /// The same with the folder of a file that a person names.
    #[must_use]
    pub fn beside(&self, file: &Path) -> Self {
        let folder = real_folder(file).ok();
        Self { allowed: self.allowed.iter().cloned().chain(folder).collect(), ..self.clone() }
    }

    /// The same for what `file` names: inside its project, unless a file before it has set that.
    ///
    /// # Errors
    /// Its folder cannot be read.
    pub fn inside_project_of(&self, file: &Path) -> Result<Self, Diagnostic> {
        let project = if let Some(project) = &self.project {
            project.clone()
        } else {
            let current = std::env::current_dir().and_then(|current| current.canonicalize()).ok();
            project_folder(&real_folder(file)?, &MARKS, current.as_deref())
        };
        Ok(Self { project: Some(project), ..self.clone() })
    }

    /// The same permissions with an empty record of files.
    #[must_use]
    pub fn fresh(&self) -> Self {
        Self { read: Arc::default(), ..self.clone() }
    }

    /// The files that were read, in the order of their first reading.
    pub fn files(&self) -> Vec<InputFile> {
        self.read.lock().map(|read| read.clone()).unwrap_or_default()
    }

    /// The text of a file that a person names: a regular file of at most `most_bytes`, a pipe, or `-` for standard input. If a file
    /// names it, as a scenario names its robot, it must be a regular file. Behind a fence a link must not lead out of its project.
    ///
    /// # Errors
    /// The file cannot be read or is no UTF-8 text; the fault comes with as much of the text as is needed to show its
    /// place.
    pub fn read_named_text(&self, path: &Path, most_bytes: u64) -> Result<Arc<SourceFile>, Diagnostic> {
        // The project is set as soon as a file names others: from then on no path is a person's.
        let is_named_by_file = self.project.is_some();
        if self.is_fenced && !is_named_by_file {
            self.refuse_links(path)?;
        }
        let bytes = if is_named_by_file {
            read_regular_bytes(path, most_bytes)?
        } else {
            read_named_bytes(path, most_bytes)?
        };
        self.note(&path.display(), path, &bytes);
        self.marked(decode_text(path, &bytes))
    }

    /// Refuses the path of a person if a link of the project leads out of it: the person has named the link, and whoever made the
    /// project has chosen what it leads to.
    fn refuse_links(&self, path: &Path) -> Result<(), Diagnostic> {
        let current = std::env::current_dir().and_then(|current| current.canonicalize()).ok();
        for link in path.ancestors().filter(|part| part.is_symlink()) {
            let access = self.inside_project_of(link)?;
            // Links of the machine, as of a folder for temporary files, belong to no project.
            let is_of_a_project = |project: &PathBuf| {
                let is_marked = MARKS.iter().any(|mark| project.join(mark).exists());
                is_marked || current.as_ref().is_some_and(|current| current.starts_with(project))
            };
            if access.project.as_ref().is_some_and(is_of_a_project) {
                access.check(path)?;
            }
        }
        Ok(())
    }

    /// The text of a file that another file names: a regular file of at most `most_bytes`, and outside of the project of this kind.
    ///
    /// # Errors
    /// The file may not be opened, or as [`FileAccess::read_named_text`].
    pub fn read_text(
        &self,
        path: &Path,
        most_bytes: u64,
        kind: TextKind,
    ) -> Result<Arc<SourceFile>, Diagnostic> {
        kind.check(self.marked(decode_text(path, &self.read_bytes(path, most_bytes)?))?)
    }

    /// Marks a text from outside of the project, also that which shows the place of a fault.
    fn marked(&self, read: Result<Arc<SourceFile>, Diagnostic>) -> Result<Arc<SourceFile>, Diagnostic> {
        let mark = |source: &mut Arc<SourceFile>| {
            let is_foreign = self.is_foreign(&source.path);
            if let Some(source) = Arc::get_mut(source) {
                source.is_foreign = is_foreign;
            }
        };
        match read {
            Ok(mut source) => {
                mark(&mut source);
                Ok(source)
            }
            Err(mut fault) => {
                fault.source.iter_mut().for_each(mark);
                Err(fault)
            }
        }
    }

    /// The bytes of a file that another file names: a regular file of at most `most_bytes`.
    ///
    /// # Errors
    /// The file may not be opened or cannot be read.
    pub fn read_bytes(&self, path: &Path, most_bytes: u64) -> Result<Vec<u8>, Diagnostic> {
        self.check(path)?;
        let bytes = read_regular_bytes(path, most_bytes)?;
        self.note(&path.display(), path, &bytes);
        Ok(bytes)
    }

    /// Notes a recorded log, which is read by others since it may be longer than memory: a file, or the files of a folder.
    ///
    /// # Errors
    /// It may not be opened or cannot be read.
    pub fn note_log(&self, path: &Path) -> Result<(), Diagnostic> {
        self.check(path)?;
        let unreadable = |error: io::Error| unreadable(path, &error);
        let mut files = vec![path.to_owned()];
        if path.is_dir() {
            let entries = fs::read_dir(path).map_err(unreadable)?;
            files = entries.flatten().map(|entry| entry.path()).filter(|path| path.is_file()).collect();
            files.sort();
        }
        for path in files {
            // A missing log is reported by its reader, which knows what else may be meant.
            let Ok(file) = fs::File::open(&path) else { continue };
            let sha256 = streamed_sha256(file).map_err(unreadable)?;
            self.note_sha256(&path.display(), &path, sha256);
        }
        Ok(())
    }

    /// The bytes of a mesh, which was found in a folder that may be opened.
    ///
    /// # Errors
    /// The file cannot be read, or is longer than `most_bytes`.
    pub fn read_mesh(&self, uri: &str, path: &Path, most_bytes: u64) -> Result<Vec<u8>, Diagnostic> {
        let bytes = read_regular_bytes(path, most_bytes)?;
        self.note(&uri, path, &bytes);
        Ok(bytes)
    }

    /// Whether a file names `path` that is outside of its project and of the folders that are allowed.
    pub fn is_foreign(&self, path: &Path) -> bool {
        self.project.is_some() && !self.is_inside(&real(path))
    }

    /// Whether a file may name `path`. A path that does not exist is checked by its name alone, so that the answer does not
    /// reveal which files exist outside the project.
    ///
    /// # Errors
    /// There is a fence, and it is outside of the project and of the folders that are allowed.
    pub fn check(&self, path: &Path) -> Result<(), Diagnostic> {
        let Some(project) = self.project.as_ref().filter(|_| self.is_fenced) else { return Ok(()) };
        let real = real(path);
        if self.is_inside(&real) {
            return Ok(());
        }
        let message = format!(
            "{} is outside of the project folder {}, so it is not opened",
            path.display(),
            project.display()
        );
        let folder = real.parent().unwrap_or(&real).display();
        Err(Diagnostic::error(codes::file::OUTSIDE, message).with_help(format!(
            "move it into the project, whose top is marked by package.xml or .git, allow its folder (--allow {folder}), or leave out \
             --fence"
        )))
    }

    /// Whether a file names only what is in its project.
    pub(super) fn is_fenced(&self) -> bool {
        self.is_fenced
    }

    /// Folders of ROS packages by name, as a person gives them.
    pub fn packages(&self) -> &BTreeMap<String, PathBuf> {
        &self.packages
    }

    /// The ROS packages that may be searched.
    pub(super) fn ros(&self) -> &RosPackages {
        &self.ros
    }

    /// The folders that a person has allowed in addition to the project.
    pub(super) fn allowed(&self) -> &[PathBuf] {
        &self.allowed
    }

    /// The project, if a file has set it.
    pub(super) fn project(&self) -> Option<&Path> {
        self.project.as_deref()
    }

    fn is_inside(&self, path: &Path) -> bool {
        self.project.iter().chain(&self.allowed).any(|folder| path.starts_with(folder))
    }

    /// Adds files to the list.
    pub fn add(&self, files: &[InputFile]) {
        let Ok(mut read) = self.read.lock() else { return };
        for file in files {
            if !read.contains(file) {
                read.push(file.clone());
            }
        }
    }

    fn note(&self, name: &dyn Display, path: &Path, bytes: &[u8]) {
        self.note_sha256(name, path, format!("{:x}", Sha256::digest(bytes)));
    }

    fn note_sha256(&self, name: &dyn Display, path: &Path, sha256: String) {
        // An address, as `package://`, is no absolute path.
        let file = portable_path(Path::new(&name.to_string())).display().to_string();
        self.add(&[InputFile { file, sha256, path: path.to_owned() }]);
    }
}

/// The hash of a file that may be longer than memory.
fn streamed_sha256(mut file: fs::File) -> io::Result<String> {
    const PART_BYTES: usize = 1 << 20;
    let (mut hash, mut part) = (Sha256::new(), vec![0; PART_BYTES]);
    loop {
        match file.read(&mut part)? {
            0 => return Ok(format!("{:x}", hash.finalize())),
            bytes => hash.update(&part[..bytes]),
        }
    }
}

/// The folder of a file, canonical; a bare name is in the current folder, and so is standard input.
fn real_folder(file: &Path) -> Result<PathBuf, Diagnostic> {
    let folder = folder_of(file);
    folder.canonicalize().map_err(|error| {
        Diagnostic::error(codes::file::UNREADABLE, format!("{} cannot be read: {error}", folder.display()))
    })
}

/// The path from the root without links; of what does not exist, as far as it exists.
fn real(path: &Path) -> PathBuf {
    if let Ok(real) = path.canonicalize() {
        return real;
    }
    let named = normalised(&std::env::current_dir().unwrap_or_default().join(path));
    let existing = named.ancestors().find_map(|above| {
        let (real, rest) = (above.canonicalize().ok()?, named.strip_prefix(above).ok()?);
        Some(real.join(rest))
    });
    existing.unwrap_or_else(|| named.clone())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    /// `top/project/scenarios/s.toml` beside `top/project/robots`, and `top/outside`.
    fn folders() -> tempfile::TempDir {
        let top = tempfile::tempdir().unwrap();
        for folder in ["project/scenarios", "project/robots", "outside"] {
            fs::create_dir_all(top.path().join(folder)).unwrap();
        }
        for file in ["project/scenarios/s.toml", "project/robots/r.urdf", "outside/secret"] {
            fs::write(top.path().join(file), "text").unwrap();
        }
        top
    }

    fn code(access: &FileAccess, path: &Path) -> Option<&'static str> {
        access.read_text(path, 99, TextKind::Table).err().map(|fault| fault.code.name)
    }

    #[test]
    fn files_name_only_what_is_in_their_project() {
        let top = folders();
        let scenario = top.path().join("project/scenarios/s.toml");
        let access = FileAccess::default().fenced().inside_project_of(&scenario).unwrap();
        let robots = scenario.parent().unwrap().join("../robots");
        assert_eq!(code(&access, &robots.join("r.urdf")), None);
        assert_eq!(code(&access, &robots.join("gone.urdf")), Some("file::not_found"));
        assert_eq!(code(&access, &robots.join("../../outside/secret")), Some("file::outside"));
        assert_eq!(code(&access, &robots.join("../../outside/gone")), Some("file::outside"));
        assert_eq!(code(&access, Path::new("/etc/passwd")), Some("file::outside"));
        // What a robot file names is inside the project of the scenario, not of its own folder's.
        let nested = access.inside_project_of(&top.path().join("project/r.toml")).unwrap();
        assert_eq!(code(&nested, &top.path().join("outside/secret")), Some("file::outside"));
        #[cfg(unix)]
        {
            let link = robots.join("link");
            std::os::unix::fs::symlink(top.path().join("outside"), &link).unwrap();
            assert_eq!(code(&access, &link.join("secret")), Some("file::outside"));
        }
    }

    #[test]
    #[cfg(unix)]
    fn behind_a_fence_a_link_that_a_person_names_does_not_lead_out_of_its_project() {
        let top = folders();
        let project = top.path().join("project");
        fs::write(project.join("package.xml"), "").unwrap();
        let (file, folder) = (project.join("robots/arm.urdf"), project.join("robots/arm"));
        std::os::unix::fs::symlink(top.path().join("outside/secret"), &file).unwrap();
        std::os::unix::fs::symlink(top.path().join("outside"), &folder).unwrap();
        let inside = project.join("robots/same.urdf");
        std::os::unix::fs::symlink(project.join("robots/r.urdf"), &inside).unwrap();
        let code = |access: &FileAccess, path: &Path| {
            access.read_named_text(path, 99).err().map(|fault| fault.code.name)
        };
        let fenced = FileAccess::default().fenced();
        assert_eq!(code(&fenced, &file), Some("file::outside"));
        assert_eq!(code(&fenced, &folder.join("secret")), Some("file::outside"));
        assert_eq!(code(&fenced, &inside), None);
        assert_eq!(code(&FileAccess::default(), &file), None);
    }

    #[test]
    #[cfg(unix)]
    fn a_pipe_that_a_file_names_is_not_opened() {
        let top = folders();
        let pipe = top.path().join("project/robots/p.urdf");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let scenario = top.path().join("project/scenarios/s.toml");
        let access = FileAccess::default().inside_project_of(&scenario).unwrap();
        let named = |path: &Path| access.read_named_text(path, 99).err().map(|fault| fault.code.name);
        assert_eq!(named(&pipe), Some("file::not_regular"));
        assert_eq!(named(Path::new("-")), Some("file::not_found"));
        assert_eq!(named(&top.path().join("project/robots/r.urdf")), None);
    }

    #[test]
    fn without_a_fence_files_are_opened_if_they_are_what_is_expected_and_not_quoted() {
        let top = folders();
        let scenario = top.path().join("project/scenarios/s.toml");
        let access = FileAccess::default().inside_project_of(&scenario).unwrap();
        let write = |name: &str, text: &str| {
            let path = top.path().join(name);
            fs::write(&path, text).unwrap();
            path
        };
        let read = |path: &Path, kind| access.read_text(path, 999, kind);
        let urdf = write("outside/r.urdf", "<?xml version='1.0'?>\n<!-- <x> --><robot name='r'/>");
        assert!(read(&urdf, TextKind::Robot).unwrap().is_foreign);
        let table = write("outside/t.csv", "time_s,q\n0,\"1.5\"\n");
        assert!(read(&table, TextKind::Table).unwrap().is_foreign);
        let robot_file = write("outside/robot.toml", "name = 'r'\nurdf = 'r.urdf'\n");
        assert!(read(&robot_file, TextKind::RobotFile).is_ok());
        let secret = write("outside/passwd", "root:x:0:0\nsecond,line\n");
        for kind in [TextKind::Robot, TextKind::RobotFile, TextKind::Table] {
            let fault = read(&secret, kind).unwrap_err();
            assert!(fault.code.name == "file::kind" && !format!("{fault:?}").contains("root:x"), "{fault:?}");
        }
        let not_text = top.path().join("outside/bytes");
        fs::write(&not_text, b"secret\xff").unwrap();
        let fault = read(&not_text, TextKind::Table).unwrap_err();
        assert!(fault.source.is_none_or(|source| source.is_foreign));
        // In the project the reader itself says what is wrong.
        let own = write("project/robots/odd.csv", "root:x:0:0\nsecond,line\n");
        assert!(!read(&own, TextKind::Table).unwrap().is_foreign);
        #[cfg(unix)]
        assert_eq!(read(Path::new("/dev/zero"), TextKind::Table).unwrap_err().code.name, "file::not_regular");
    }

    #[test]
    fn allowed_folders_and_marked_projects_are_wider() {
        let top = folders();
        let scenario = top.path().join("project/scenarios/s.toml");
        let outside = top.path().join("outside");
        let allowing =
            FileAccess::new(RosPackages::default(), std::slice::from_ref(&outside)).unwrap().fenced();
        assert_eq!(code(&allowing.inside_project_of(&scenario).unwrap(), &outside.join("secret")), None);
        fs::create_dir(top.path().join(".git")).unwrap();
        let marked = FileAccess::default().fenced().inside_project_of(&scenario).unwrap();
        assert_eq!(code(&marked, &outside.join("secret")), None);
        assert!(FileAccess::new(RosPackages::default(), &[scenario]).is_err());
    }

    #[test]
    fn what_was_read_is_listed_once_with_its_hash() {
        let top = folders();
        let access = FileAccess::default();
        let file = top.path().join("outside/secret");
        for _ in 0..2 {
            access.read_named_text(&file, 99).unwrap();
        }
        let sha256 = "982d9e3eb996f559e633f4d194def3761d909f5a3b647d1a851fead67c32c9d1".to_owned();
        let named = portable_path(&file).display().to_string();
        assert!(!named.starts_with('/'), "{named}");
        assert_eq!(access.files(), [InputFile { file: named, sha256, path: file }]);
        assert!(access.fresh().files().is_empty());
    }
}
