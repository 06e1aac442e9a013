//! The corpus of logs, which a user's clone does not have.

use std::path::{Path, PathBuf};

/// The folder of logs of the corpus; `None` if the tests that need it are skipped.
pub(crate) fn logs() -> Option<PathBuf> {
    let Some(corpus) = std::env::var_os("CONGRUENT_CORPUS") else {
        eprintln!("skipped: CONGRUENT_CORPUS is not set");
        return None;
    };
    // A relative path is from the root of the workspace, where the gate runs.
    let logs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(corpus).join("logs");
    assert!(logs.is_dir(), "CONGRUENT_CORPUS: {} is no folder", logs.display());
    Some(logs)
}
