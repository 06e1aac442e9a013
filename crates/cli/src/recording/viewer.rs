//! The rerun viewer: where it is, which version it has, and how it is started.

use std::{
    env,
    ffi::OsStr,
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
};

use congruent::recording::RERUN_VERSION;

use crate::failure::Failure;

/// Name of the viewer program, which is looked for in `PATH`.
const PROGRAM: &str = "rerun";

/// A viewer that is installed on this machine, with the version that it reports.
#[derive(Debug, Clone)]
pub(crate) struct Viewer {
    program: PathBuf,
    /// Its version; `None` if it does not print one.
    pub(super) version: Option<String>,
}

impl Viewer {
    /// The viewer in `PATH`.
    ///
    /// # Errors
    /// If it is not installed, the error says how to install it; `recording` is the file that can be opened on
    /// another machine.
    pub(crate) fn find(recording: Option<&Path>) -> Result<Self, Failure> {
        let program = in_path(env::var_os("PATH").as_deref()).ok_or_else(|| missing(recording))?;
        let output = Command::new(&program).arg("--version").stdin(Stdio::null()).output();
        let version = output.ok().and_then(|output| version(&String::from_utf8_lossy(&output.stdout)));
        Ok(Self { program, version })
    }

    /// What is wrong with its version: an older viewer does not read newer recordings.
    pub(crate) fn remark(&self) -> Option<String> {
        let version = self.version.as_deref()?;
        (numbers(version) < numbers(RERUN_VERSION)).then(|| {
            format!(
                "rerun {version} is older than {RERUN_VERSION}, which this recording needs: {}",
                install()
            )
        })
    }

    /// Opens a recording and waits until the viewer is closed.
    ///
    /// # Errors
    /// If it does not start or ends with an error, as without a display.
    pub(super) fn show(&self, recording: &Path) -> Result<(), Failure> {
        let failed = |why: String| {
            Failure::Machine(format!(
                "{}: {why}; the recording is {}",
                self.program.display(),
                recording.display()
            ))
        };
        // The output of the viewer is not part of this command's answer.
        let status = Command::new(&self.program)
            .arg(recording)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .status()
            .map_err(|error| failed(error.to_string()))?;
        if status.success() { Ok(()) } else { Err(failed(format!("the viewer ended with {status}"))) }
    }

    /// Starts it so that it shows what is written to its standard input.
    pub(super) fn live(&self) -> std::io::Result<Child> {
        Command::new(&self.program).arg("-").stdin(Stdio::piped()).stdout(Stdio::null()).spawn()
    }
}

/// The program in one of these folders.
fn in_path(path: Option<&OsStr>) -> Option<PathBuf> {
    let file = format!("{PROGRAM}{}", env::consts::EXE_SUFFIX);
    env::split_paths(path?).map(|folder| folder.join(&file)).find(|program| is_program(program))
}

#[cfg(unix)]
fn is_program(path: &Path) -> bool {
    use std::os::unix::fs::PermissionsExt;
    path.metadata().is_ok_and(|metadata| metadata.is_file() && metadata.permissions().mode() & 0o111 != 0)
}

#[cfg(not(unix))]
fn is_program(path: &Path) -> bool {
    path.is_file()
}

/// The version in `rerun-cli 0.36.3 (...)`.
fn version(text: &str) -> Option<String> {
    let word = text.split_whitespace().find(|word| word.starts_with(|c: char| c.is_ascii_digit()))?;
    Some(word.to_owned())
}

/// Numbers of a version, to be compared one by one.
fn numbers(version: &str) -> Vec<u32> {
    version.split(['.', '-', '+']).map_while(|number| number.parse().ok()).collect()
}

fn install() -> String {
    format!("`pip install rerun-sdk=={RERUN_VERSION}` or `cargo binstall rerun-cli@{RERUN_VERSION}`")
}

fn missing(recording: Option<&Path>) -> Failure {
    let elsewhere = recording.map_or_else(String::new, |recording| {
        format!(
            "; {} can be opened on any machine with it, or in a browser at https://app.rerun.io/version/{RERUN_VERSION}",
            recording.display()
        )
    });
    Failure::Machine(format!("`{PROGRAM}` is not in PATH: install the viewer with {}{elsewhere}", install()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_are_compared_by_their_numbers() {
        let found = version("rerun-cli 0.36.3 (base release) [rustc 1.95.0 (5980 2026)]").unwrap();
        assert_eq!(found, RERUN_VERSION);
        let viewer = |version: &str| Viewer { program: PathBuf::new(), version: Some(version.to_owned()) };
        assert!(viewer("0.9.10").remark().unwrap().contains("older"));
        assert!(viewer("0.36.3").remark().is_none() && viewer("0.100.0").remark().is_none());
        assert!(version("no number").is_none());
    }

    #[test]
    fn a_folder_without_the_program_is_passed_over() {
        let empty = tempfile::tempdir().unwrap();
        assert_eq!(in_path(Some(empty.path().as_os_str())), None);
        assert_eq!(in_path(None), None);
    }
}
