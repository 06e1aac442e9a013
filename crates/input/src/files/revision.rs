//! Files of an earlier revision in git: `git:REV:PATH`. They are read from the objects of the repository, so nothing is checked out
//! and the working tree stays as it is.

use std::{
    collections::{BTreeMap, BTreeSet},
    ffi::OsStr,
    fs,
    path::{Path, PathBuf},
    process::{Command, Output, Stdio},
    str::FromStr,
};

use tempfile::TempDir;

use super::{open::folder_of, project::normalised};
use crate::{codes, diagnostic::Diagnostic, nearest::nearest};

/// What a path begins with that names a revision.
const PREFIX: &str = "git:";
/// Bytes of all files that one robot may bring. Kind: choice; meshes of the largest public arms have some 100 MB.
const MOST_BYTES: u64 = 1 << 30;
/// Texts that may name further files.
const TEXTS: [&str; 6] = ["toml", "urdf", "xml", "srdf", "mjcf", "xacro"];

/// A file of a revision as a person names it: `git:REV:PATH`, or `git:REV` for a path that is known otherwise.
///
/// # Examples
/// ```
/// use congruent_input::RevisionName;
/// let name: RevisionName = "git:HEAD~2:robots/arm.urdf".parse().unwrap();
/// assert_eq!((name.revision.as_str(), name.path.as_deref()), ("HEAD~2", Some("robots/arm.urdf".as_ref())));
/// assert!("arm.urdf".parse::<RevisionName>().is_err());
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RevisionName {
    /// What git takes as a revision: a branch, a tag, a commit.
    pub revision: String,
    /// From the top of the repository, or from the current folder.
    pub path: Option<PathBuf>,
}

/// The text does not name a revision.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NoRevision;

impl FromStr for RevisionName {
    type Err = NoRevision;

    fn from_str(text: &str) -> Result<Self, NoRevision> {
        let named = text.strip_prefix(PREFIX).ok_or(NoRevision)?;
        let (revision, path) = named.split_once(':').unwrap_or((named, ""));
        let path = (!path.is_empty()).then(|| PathBuf::from(path));
        Ok(Self { revision: revision.to_owned(), path })
    }
}

impl RevisionName {
    /// The revision that a path of the command line names.
    pub fn of(path: &Path) -> Option<Self> {
        path.to_str()?.parse().ok()
    }

    /// The same revision of another file, unless it names one; a path that it names is in the repository of that file.
    #[must_use]
    pub fn beside(self, file: &Path) -> Self {
        let Some(path) = &self.path else { return Self { path: Some(file.to_owned()), ..self } };
        let tops = [folder_of(file), Path::new(".")].map(|folder| top_of(folder).ok());
        match tops {
            [Some(top), here] if here.as_ref() != Some(&top) => Self { path: Some(top.join(path)), ..self },
            _ => self,
        }
    }

    /// As a path of the command line.
    pub fn to_path(&self) -> PathBuf {
        let path = self.path.as_ref().map(|path| format!(":{}", path.display())).unwrap_or_default();
        format!("{PREFIX}{}{path}", self.revision).into()
    }
}

/// The files of a robot as a revision has them, in a folder of their own that is removed at the end.
#[derive(Debug)]
pub struct RevisionFiles {
    folder: TempDir,
    /// The same folder without links.
    top: PathBuf,
    revision: String,
    /// The named file, from the top of the repository.
    path: PathBuf,
}

impl RevisionFiles {
    /// Reads the named file and what it mentions: every file of the revision whose name stands in it, and so on. A folder stands for
    /// the file `in_folder` of it.
    ///
    /// # Errors
    /// There is no git, no repository, no such revision or file in it, or the files are too large.
    pub fn read(name: &RevisionName, in_folder: &str) -> Result<Self, Diagnostic> {
        let Some(path) = &name.path else {
            let message = format!("{} names no file", name.to_path().display());
            return Err(Diagnostic::error(codes::file::REVISION, message).with_help(format!(
                "git:{}:PATH, with the path from the top of the repository",
                name.revision
            )));
        };
        let repository = Repository::around(path, &name.revision)?;
        let tree = repository.tree()?;
        let path = repository.in_tree(path, &tree, in_folder)?;
        let folder =
            tempfile::Builder::new().prefix("congruent-").tempdir().map_err(|error| unwritable(&error))?;
        let top = folder.path().canonicalize().map_err(|error| unwritable(&error))?;
        repository.write_mentioned(&path, &tree, &top)?;
        Ok(Self { folder, top, revision: name.revision.clone(), path })
    }

    /// The named file, as it can be opened.
    pub fn file(&self) -> PathBuf {
        self.top.join(&self.path)
    }

    /// A path of these files as a person names it: `git:main:robots/arm.urdf`; any other as it is.
    pub fn named(&self, path: &Path) -> PathBuf {
        let below =
            [self.top.as_path(), self.folder.path()].into_iter().find_map(|top| path.strip_prefix(top).ok());
        match below {
            Some(below) => format!("{PREFIX}{}:{}", self.revision, below.display()).into(),
            None => path.to_owned(),
        }
    }

    /// A text with these paths as a person names them.
    pub fn named_in(&self, text: &str) -> String {
        let prefix = format!("{PREFIX}{}:", self.revision);
        let replaced = |text: String, top: &Path| {
            let top = top.display();
            text.replace(&format!("{top}/"), &prefix).replace(&top.to_string(), prefix.trim_end_matches(':'))
        };
        replaced(replaced(text.to_owned(), &self.top), self.folder.path())
    }
}

/// A file of a revision.
struct Blob {
    id: String,
    bytes: u64,
}

/// The files of a revision, by their path from the top.
type RevisionTree = BTreeMap<PathBuf, Blob>;

/// A repository at a revision.
struct Repository {
    top: PathBuf,
    revision: String,
    commit: String,
}

impl Repository {
    /// That of a file, or else of the current folder.
    fn around(path: &Path, revision: &str) -> Result<Self, Diagnostic> {
        let exists = |folder: &&Path| !folder.as_os_str().is_empty() && folder.is_dir();
        let top = top_of(path.ancestors().skip(1).find(exists).unwrap_or(Path::new(".")))?;
        let commit = git(
            &top,
            ["rev-parse", "--verify", "--quiet", "--end-of-options", &format!("{revision}^{{commit}}")],
        )?;
        if !commit.status.success() || revision.is_empty() {
            return Err(unknown_revision(&top, revision)?);
        }
        let commit = String::from_utf8_lossy(&commit.stdout).trim_end().to_owned();
        Ok(Self { top, revision: revision.to_owned(), commit })
    }

    /// Its files; links and submodules are left out.
    fn tree(&self) -> Result<RevisionTree, Diagnostic> {
        let listed = git(&self.top, ["ls-tree", "-r", "-z", "-l", "--full-tree", &self.commit])?;
        if !listed.status.success() {
            return Err(failed(&listed));
        }
        let entry = |entry: &[u8]| {
            let entry = String::from_utf8_lossy(entry);
            let (about, path) = entry.split_once('\t')?;
            let mut about = about.split_whitespace();
            let (mode, _, id, bytes) = (about.next()?, about.next()?, about.next()?, about.next()?);
            let is_file = mode.starts_with("100");
            is_file.then(|| {
                Some((PathBuf::from(path), Blob { id: id.to_owned(), bytes: bytes.parse().ok()? }))
            })?
        };
        Ok(listed.stdout.split(|byte| *byte == 0).filter_map(entry).collect())
    }

    /// The file that is meant: from the top of the repository, or else from the current folder.
    fn in_tree(&self, path: &Path, tree: &RevisionTree, in_folder: &str) -> Result<PathBuf, Diagnostic> {
        let real = || path.canonicalize().ok().or_else(|| Some(std::env::current_dir().ok()?.join(path)));
        let top = self.top.canonicalize().unwrap_or_else(|_| self.top.clone());
        let here = real().and_then(|real| Some(normalised(&real).strip_prefix(&top).ok()?.to_owned()));
        let candidates = [Some(normalised(path)), here];
        let candidates = candidates.iter().flatten().flat_map(|path| [path.clone(), path.join(in_folder)]);
        if let Some(found) = candidates.into_iter().find(|path| tree.contains_key(path)) {
            return Ok(found);
        }
        let message = format!("{} has no file {}", self.revision, path.display());
        let fault = Diagnostic::error(codes::file::REVISION, message);
        let same_name = tree.keys().find(|other| other.file_name() == path.file_name());
        let similar = || {
            let names = tree.keys().filter_map(|path| path.to_str());
            nearest(path.to_str()?, names).map(PathBuf::from)
        };
        Err(match same_name.cloned().or_else(similar) {
            Some(other) => fault.with_help(format!("it has git:{}:{}", self.revision, other.display())),
            None => fault.with_help("the path is from the top of the repository, as in git show"),
        })
    }

    /// Writes the file, and every file whose name is mentioned in one that was written, below `top`.
    fn write_mentioned(&self, path: &Path, tree: &RevisionTree, top: &Path) -> Result<(), Diagnostic> {
        // Packages and relative paths are found by their folders, and the top of a project by its mark.
        for folder in tree.keys().filter_map(|path| path.parent()).collect::<BTreeSet<_>>() {
            fs::create_dir_all(top.join(folder)).map_err(|error| unwritable(&error))?;
        }
        fs::create_dir_all(top.join(".git")).map_err(|error| unwritable(&error))?;
        let by_name = names(tree);
        let marks = by_name.get(OsStr::new("package.xml")).into_iter().flatten().copied();
        let mut pending: Vec<&Path> = std::iter::once(path).chain(marks).collect();
        let (mut taken, mut bytes) = (BTreeSet::new(), 0);
        while let Some(path) = pending.pop() {
            let Some(blob) = tree.get(path).filter(|_| taken.insert(path)) else { continue };
            bytes += blob.bytes;
            if bytes > MOST_BYTES {
                let message = format!(
                    "the files of {} at {} are too large: the limit is {MOST_BYTES} bytes",
                    path.display(),
                    self.revision
                );
                return Err(Diagnostic::error(codes::file::TOO_LARGE, message));
            }
            let read = git(&self.top, ["cat-file", "blob", &blob.id])?;
            if !read.status.success() {
                return Err(failed(&read));
            }
            let is_mark = path.file_name() == Some(OsStr::new("package.xml"));
            if !is_mark && is_text(path) {
                pending.extend(mentioned(&String::from_utf8_lossy(&read.stdout), &by_name));
            }
            fs::write(top.join(path), &read.stdout).map_err(|error| unwritable(&error))?;
        }
        Ok(())
    }
}

/// The top of the repository of a folder.
fn top_of(folder: &Path) -> Result<PathBuf, Diagnostic> {
    let top = git(folder, ["rev-parse", "--show-toplevel"])?;
    if !top.status.success() {
        let message = format!("{} is in no git repository: {}", folder.display(), said(&top));
        return Err(Diagnostic::error(codes::file::REVISION, message)
            .with_help("git:REV takes a file from the history of the repository that the robot is in"));
    }
    Ok(PathBuf::from(String::from_utf8_lossy(&top.stdout).trim_end()))
}

/// The files by their name without folders.
fn names(tree: &RevisionTree) -> BTreeMap<&OsStr, Vec<&Path>> {
    let mut names: BTreeMap<&OsStr, Vec<&Path>> = BTreeMap::new();
    for path in tree.keys() {
        names.entry(path.file_name().unwrap_or_default()).or_default().push(path);
    }
    names
}

fn is_text(path: &Path) -> bool {
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    TEXTS.contains(&ending.as_str())
}

/// The files that a text names in quotes or as the text of an element; of several with that name those whose folders fit best.
fn mentioned<'a>(text: &str, by_name: &BTreeMap<&OsStr, Vec<&'a Path>>) -> Vec<&'a Path> {
    let mut found = Vec::new();
    for quoted in text.split(['"', '\'', '<', '>']).map(str::trim) {
        let written = Path::new(quoted);
        let Some(same_name) = written.file_name().and_then(|name| by_name.get(name)) else { continue };
        let fit = |path: &&Path| {
            let pairs = path.components().rev().zip(written.components().rev());
            pairs.take_while(|(a, b)| a == b).count()
        };
        let best = same_name.iter().map(fit).max();
        found.extend(same_name.iter().filter(|path| Some(fit(path)) == best));
    }
    found
}

/// Runs git in a folder; it neither asks nor writes.
fn git<const N: usize>(folder: &Path, arguments: [&str; N]) -> Result<Output, Diagnostic> {
    let mut command = Command::new("git");
    command.arg("-C").arg(folder).args(arguments).stdin(Stdio::null());
    command.env("GIT_OPTIONAL_LOCKS", "0").env("GIT_TERMINAL_PROMPT", "0").env("LC_ALL", "C");
    command.output().map_err(|error| {
        Diagnostic::error(codes::file::REVISION, format!("git cannot be run: {error}"))
            .with_help("git:REV needs the program git in PATH")
    })
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).trim().trim_start_matches("fatal: ").to_owned()
}

fn failed(output: &Output) -> Diagnostic {
    Diagnostic::error(codes::file::REVISION, format!("git: {}", said(output)))
}

fn unknown_revision(top: &Path, revision: &str) -> Result<Diagnostic, Diagnostic> {
    let listed = git(top, ["for-each-ref", "--format=%(refname:short)"])?;
    let listed = String::from_utf8_lossy(&listed.stdout).into_owned();
    let message = format!("the repository {} has no revision \"{revision}\"", top.display());
    let fault = Diagnostic::error(codes::file::REVISION, message);
    Ok(match nearest(revision, listed.lines()) {
        Some(similar) => fault.with_help(format!("did you mean git:{similar}?")),
        None => fault.with_help(
            "give a branch, a tag or a commit; a CI checkout often has only the newest commit: fetch more (fetch-depth: 0)",
        ),
    })
}

fn unwritable(error: &std::io::Error) -> Diagnostic {
    Diagnostic::error(codes::file::REVISION, format!("the files of the revision cannot be written: {error}"))
}
