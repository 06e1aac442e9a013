//! The corpus of real robots with numbers from independent programs. It is no part of a clone:
//! tests that use it say that they were skipped, unless `CONGRUENT_CORPUS` names its folder.

#![allow(clippy::print_stderr, dead_code, reason = "a skipped test says so; not every test needs all")]

use std::path::{Path, PathBuf};

/// The corpus folder, or `None` (and a line on stderr) where this run has none.
///
/// # Panics
/// When `CONGRUENT_CORPUS` is set and is no folder: a gate that cannot run must not pass.
pub(crate) fn corpus() -> Option<PathBuf> {
    let Some(path) = std::env::var_os("CONGRUENT_CORPUS") else {
        eprintln!("skipped: CONGRUENT_CORPUS is not set");
        return None;
    };
    let path = workspace().join(path);
    assert!(path.is_dir(), "CONGRUENT_CORPUS: {} is no folder", path.display());
    Some(path)
}

/// The root of the workspace; tests run in the folder of their package.
pub(crate) fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().expect("the workspace exists")
}
