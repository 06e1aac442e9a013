//! Runs the built command as a user does.

use std::{ffi::OsStr, path::Path, process::Command};

use serde_json::Value;

/// What the command did.
#[derive(Debug)]
pub(crate) struct Answer {
    pub(crate) code: i32,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Answer {
    /// The one JSON document on standard output.
    #[track_caller]
    pub(crate) fn json(&self) -> Value {
        serde_json::from_str(&self.stdout)
            .unwrap_or_else(|error| panic!("no JSON: {error}\n{}\n{}", self.stdout, self.stderr))
    }
}

/// Runs `congruent` with these arguments, from the root of the workspace.
pub(crate) fn congruent<S: AsRef<OsStr>>(arguments: &[S]) -> Answer {
    let output = Command::new(env!("CARGO_BIN_EXE_congruent"))
        .args(arguments)
        .current_dir(crate::corpus::workspace())
        .env_remove("GITHUB_ACTIONS")
        .env_remove("COLUMNS") // the width of help
        .output()
        .expect("the command starts");
    Answer {
        code: output.status.code().expect("the command ends by itself"),
        stdout: String::from_utf8(output.stdout).expect("the command prints UTF-8"),
        stderr: String::from_utf8(output.stderr).expect("the command prints UTF-8"),
    }
}

/// The same, with `--format json`.
pub(crate) fn congruent_json<S: AsRef<OsStr>>(arguments: &[S]) -> Answer {
    let mut all: Vec<&OsStr> = arguments.iter().map(AsRef::as_ref).collect();
    all.extend(["--format", "json"].map(OsStr::new));
    congruent(&all)
}

/// A path as an argument.
pub(crate) fn text(path: &Path) -> String {
    path.to_str().expect("paths of tests are UTF-8").to_owned()
}
