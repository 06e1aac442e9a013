//! A folder with a copy of what the guide's commands read, in which they run as in the root of the project.

use std::{
    env, fs,
    os::unix::fs::symlink,
    path::{Path, PathBuf},
    process,
};

use tempfile::TempDir;

use crate::page::root;

/// Folders of the project that the guide reads.
const COPIED: [&str; 5] = ["robots", "scenarios", "schemas", "docs/examples", "docs/ci"];

/// How a command from the sources begins; the rest is run with the binary that the tests have.
const FROM_SOURCES: &str = "cargo run --release -- ";

/// Beginnings of commands that need a compiler, a network or a window: `.ci/run` calls cargo's, the others are
/// another program's.
const NOT_RUN: [&str; 10] = [
    "cargo test",
    "cargo run --release --package congruent --example",
    "cargo install",
    "cargo bench",
    "cargo add",
    "cargo binstall",
    "mdbook",
    "pip ",
    "rerun",
    "docker",
];

/// The folder; it is removed with the value.
pub(crate) struct Sandbox {
    folder: TempDir,
}

/// What a command did.
pub(crate) struct Answer {
    pub(crate) code: i32,
    /// Standard output and then standard error.
    pub(crate) printed: String,
}

impl Sandbox {
    pub(crate) fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        for name in COPIED {
            copy(&root().join(name), &folder.path().join(name));
        }
        fs::create_dir(folder.path().join("bin")).unwrap();
        symlink(env!("CARGO_BIN_EXE_congruent"), folder.path().join("bin/congruent")).unwrap();
        Self { folder }
    }

    pub(crate) fn write(&self, path: &str, text: &str) {
        let path = self.folder.path().join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }

    /// The files in the folder itself with this extension.
    pub(crate) fn files(&self, extension: &str) -> Vec<PathBuf> {
        let entries = fs::read_dir(self.folder.path()).unwrap().flatten();
        let paths = entries.map(|entry| entry.path());
        paths.filter(|path| path.extension().is_some_and(|found| found == extension)).collect()
    }

    /// The names of all commands, in the groups of the help.
    pub(crate) fn commands(&self) -> Vec<String> {
        let help = self.run("congruent --help").printed;
        let listed = help.lines().skip_while(|line| *line != "Check:").take_while(|line| *line != "Options:");
        // A line that goes on with a description is indented further.
        let names = listed.filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
        names.filter(|name| !["", "help"].contains(name)).map(str::to_owned).collect()
    }

    pub(crate) fn run(&self, command: &str) -> Answer {
        let command = command.trim();
        if NOT_RUN.iter().any(|beginning| command.starts_with(beginning)) {
            return Answer { code: 0, printed: String::new() };
        }
        let command = command.replace(FROM_SOURCES, "congruent ");
        let path = format!("{}:{}", self.folder.path().join("bin").display(), env::var("PATH").unwrap());
        let output = process::Command::new("sh")
            .args(["-c", &command])
            .current_dir(self.folder.path())
            .env("PATH", path)
            .env("GITHUB_STEP_SUMMARY", self.folder.path().join("summary.md"))
            .env_remove("GITHUB_ACTIONS")
            .env_remove("COLUMNS") // the width of help
            .output()
            .unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        let code = output.status.code().expect("the command ends by itself");
        Answer { code, printed: text(output.stdout) + &text(output.stderr) }
    }
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap().flatten() {
        let (from, to) = (entry.path(), to.join(entry.file_name()));
        if from.is_dir() {
            copy(&from, &to);
        } else {
            fs::copy(&from, &to).unwrap();
        }
    }
}
