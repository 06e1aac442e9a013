//! `congruent compare`: what two runs have written against each other, file by file.

use std::{
    fs,
    path::{Path, PathBuf},
};

use congruent_input::absence;
use congruent_results::comparison::{ComparedFile, FileComparison, compare_reports, compare_tables};
use schemars::JsonSchema;
use serde::Serialize;

#[cfg(feature = "recording")]
use congruent_results::comparison::compare_scalars;

/// The answer of `congruent compare`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct RunComparison {
    /// Name and version of this format.
    pub format: &'static str,
    /// What was compared: a file or a folder.
    pub a: String,
    /// The file or folder that `a` is compared with.
    pub b: String,
    /// The largest difference of two numbers that counts as none.
    pub tolerance: f64,
    /// Whether nothing differs beyond the tolerance.
    pub same: bool,
    /// 0 if nothing differs, 1 otherwise, 4 if there is nothing to compare, as of two tables without rows.
    pub exit_code: u8,
    /// The comparison of each kind of file that both have.
    pub files: Vec<FileComparison>,
    /// Kinds of files that only one of the folders has; they decide nothing.
    pub not_compared: Vec<String>,
}

/// Why two paths cannot be compared.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct NotComparable(String);

/// The exit code of two runs without a value in common.
const NOTHING_COMPARED: u8 = 4;

/// The files of a run, in the order in which they are compared.
const FILES: [(ComparedFile, &[&str]); 3] = [
    (ComparedFile::Report, &["report.json"]),
    (ComparedFile::Trajectory, &["trajectory.csv", "trajectory.parquet"]),
    (ComparedFile::Recording, &["recording.rrd"]),
];

/// Compares two reports, two trajectories, two recordings, or the folders of two runs.
///
/// # Errors
/// [`NotComparable`] if a path is none of these, both are of different kinds, or a file cannot be read.
///
/// # Examples
/// ```no_run
/// let comparison = congruent::compare_runs("out/a".as_ref(), "out/b".as_ref(), 1e-9)?;
/// if let Some(first) = comparison.files.iter().find_map(|file| file.first.as_ref()) {
///     println!("{} at {:?}", first.series, first.time_s);
/// }
/// # Ok::<(), congruent::NotComparable>(())
/// ```
pub fn compare_runs(a: &Path, b: &Path, tolerance: f64) -> Result<RunComparison, NotComparable> {
    let refused = |why: String| Err(NotComparable(why));
    if !(tolerance.is_finite() && tolerance >= 0.0) {
        return refused(format!("the tolerance {tolerance} is not a finite number >= 0"));
    }
    for path in [a, b] {
        if let Err(error) = fs::metadata(path) {
            let name = path.display();
            return refused(match error.kind() {
                std::io::ErrorKind::NotFound => absence(path),
                _ => format!("cannot read {name}: {error}"),
            });
        }
    }
    let (mut files, mut not_compared) = (Vec::new(), Vec::new());
    if let Some(robot) = [a, b].into_iter().find(|path| is_robot(path)) {
        return refused(format!(
            "{} is a robot and no result of a run: congruent check {} --against {} compares two robots",
            robot.display(),
            a.display(),
            b.display()
        ));
    }
    match (a.is_dir(), b.is_dir()) {
        (true, true) => {
            for (kind, names) in FILES {
                match [a, b].map(|folder| find(folder, names)) {
                    [Some(a), Some(b)] => files.push(compare(kind, &a, &b, tolerance)?),
                    [Some(_), None] => not_compared.push(format!("only A has a {kind}")),
                    [None, Some(_)] => not_compared.push(format!("only B has a {kind}")),
                    [None, None] => {}
                }
            }
            if files.is_empty() {
                return refused("the folders have no report, trajectory or recording in common".to_owned());
            }
        }
        (false, false) => {
            let [of_a, of_b] = [kind(a)?, kind(b)?];
            if of_a != of_b {
                return refused(format!(
                    "A is a {of_a} and B a {of_b}: give two of one kind, or two folders"
                ));
            }
            files.push(compare(of_a, a, b, tolerance)?);
        }
        _ => return refused("one is a folder and the other a file: give two of one kind".to_owned()),
    }
    let same = files.iter().all(|file| file.same);
    // Two tables without rows are equal, and nothing was compared: that must not be success.
    let is_nothing = same && files.iter().all(|file| file.compared == 0);
    let exit_code = if is_nothing { NOTHING_COMPARED } else { u8::from(!same) };
    let [a, b] = [a, b].map(|path| path.display().to_string());
    let format = "congruent-comparison/1";
    Ok(RunComparison { format, a, b, tolerance, same, exit_code, files, not_compared })
}

/// Whether a path is that of a robot: its folder, its robot file, or a URDF or an MJCF.
fn is_robot(path: &Path) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str());
    path.join("robot.toml").is_file()
        || path.is_file() && ending.is_some_and(|ending| ["toml", "urdf", "xml"].contains(&ending))
}

fn find(folder: &Path, names: &[&str]) -> Option<PathBuf> {
    names.iter().map(|name| folder.join(name)).find(|path| path.is_file())
}

/// The kind of a file, by the ending of its name.
fn kind(path: &Path) -> Result<ComparedFile, NotComparable> {
    match path.extension().and_then(|ending| ending.to_str()).map(str::to_ascii_lowercase).as_deref() {
        Some("json") => Ok(ComparedFile::Report),
        Some("csv" | "parquet") => Ok(ComparedFile::Trajectory),
        Some("rrd") => Ok(ComparedFile::Recording),
        _ => Err(NotComparable(format!(
            "{} is not a report (.json), trajectory (.csv, .parquet) or recording (.rrd)",
            path.display()
        ))),
    }
}

fn compare(kind: ComparedFile, a: &Path, b: &Path, tolerance: f64) -> Result<FileComparison, NotComparable> {
    match kind {
        ComparedFile::Report => compare_reports(a, b, tolerance).map_err(NotComparable),
        ComparedFile::Trajectory => {
            compare_tables(a, b, tolerance).map_err(|error| NotComparable(error.to_string()))
        }
        ComparedFile::Recording => recordings(a, b, tolerance),
    }
}

#[cfg(feature = "recording")]
fn recordings(a: &Path, b: &Path, tolerance: f64) -> Result<FileComparison, NotComparable> {
    let read = |path| congruent_recording::scalars(path).map_err(|error| NotComparable(error.to_string()));
    let [(of_a, scalars_a), (of_b, scalars_b)] = [read(a)?, read(b)?];
    let label = |path: &str| congruent_recording::label(path, &of_a);
    let mut compared = compare_scalars(&scalars_a, &scalars_b, label, tolerance);
    let robot = |summary: &congruent_recording::RecordingSummary| {
        summary.report.as_ref()?.get("robot")?.as_str().map(str::to_owned)
    };
    if let (Some(a), Some(b)) = (robot(&of_a), robot(&of_b))
        && a != b
    {
        compared.statements.push(format!("the robots differ: {a} in A, {b} in B"));
    }
    for (name, summary) in [("A", of_a), ("B", of_b)] {
        compared.statements.extend(summary.problems.iter().map(|problem| format!("{name}: {problem}")));
    }
    compared.same &= compared.statements.is_empty();
    Ok(compared)
}

#[cfg(not(feature = "recording"))]
fn recordings(a: &Path, _: &Path, _: f64) -> Result<FileComparison, NotComparable> {
    Err(NotComparable(format!("{} cannot be read: this program was built without recordings", a.display())))
}
