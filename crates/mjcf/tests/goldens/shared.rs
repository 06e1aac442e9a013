//! Finds the goldens, and reads models with the files beside them.

use std::{
    fs,
    path::{Path, PathBuf},
    sync::Arc,
};

use congruent_input::{Diagnostic, Diagnostics, SourceFile, codes};
use congruent_mjcf::MjModel;
use serde_json::Value;

/// The folder `shared/pairs` beside one of the folders above this one; `None` if there is none.
pub(crate) fn pairs() -> Option<PathBuf> {
    let above = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors();
    above.map(|folder| folder.join("shared/pairs")).find(|folder| folder.is_dir())
}

/// Says which test had nothing to compare with.
#[expect(clippy::print_stderr, reason = "a test that passes without its data says so")]
pub(crate) fn left_out(what: &str) {
    eprintln!("left out: {what}, for lack of a folder shared/pairs");
}

/// The folder of the goldens of one kind, with the goldens.
pub(crate) fn goldens(folder: &str) -> Option<(PathBuf, Value)> {
    let folder = pairs()?.join(folder);
    let text = fs::read_to_string(folder.join("golden.json")).unwrap();
    Some((folder, serde_json::from_str(&text).unwrap()))
}

fn open(path: &Path) -> Result<Arc<SourceFile>, Diagnostic> {
    let text = fs::read_to_string(path)
        .map_err(|error| Diagnostic::error(codes::file::NOT_FOUND, format!("{}: {error}", path.display())))?;
    Ok(Arc::new(SourceFile { path: path.to_owned(), text, is_foreign: false }))
}

/// Reads a model; its diagnostics beside it.
pub(crate) fn read(path: &Path) -> (Option<MjModel>, Vec<Diagnostic>) {
    let folder = path.parent().unwrap();
    let mut diagnostics = Diagnostics::default();
    let mut include = |name: &str| open(&folder.join(name));
    let model = congruent_mjcf::parse(&open(path).unwrap(), &mut include, &mut diagnostics);
    (model, diagnostics.into_vec())
}

/// Numbers of a JSON array.
pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}
