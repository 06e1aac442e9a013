//! Plans of sweeps among other files, as of `scenarios/*.toml`.

use std::path::{Path, PathBuf};

use congruent::text::layout::visible_path;

use crate::terminal::print::Printer;

/// The files without plans (`*.sweep.toml`), which are left out with a note; one file alone is what is meant.
pub(crate) fn without_plans(files: &[PathBuf], printer: &Printer) -> Vec<PathBuf> {
    let (plans, others): (Vec<&PathBuf>, Vec<&PathBuf>) = files.iter().partition(|file| is_plan(file));
    if plans.is_empty() || others.is_empty() {
        return files.to_vec();
    }
    let note = |plan: &&PathBuf| {
        let plan = visible_path(plan);
        format!(
            "{plan} is the plan of a sweep, left out; to run its cases: congruent sweep run {plan} --out DIR"
        )
    };
    let notes: Vec<String> = plans.iter().map(note).collect();
    printer.notes(notes.iter().map(String::as_str));
    others.into_iter().cloned().collect()
}

fn is_plan(file: &Path) -> bool {
    file.to_string_lossy().ends_with(".sweep.toml")
}
