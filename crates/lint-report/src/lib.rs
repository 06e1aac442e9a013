//! `lint`: everything that is wrong or suspicious in a file, whatever its kind, as one report.

pub mod codes;
mod find_robot;
mod report;
mod summary;
mod tables;

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use congruent_analysis::inverse::read_targets;
use congruent_calibration::{measurements::read_measurements, needed_coordinates};
use congruent_configurations::read_states;
use congruent_description::{RobotDescription, load_opened_robot};
use congruent_input::{
    Capability, Diagnostic, FileAccess, Finding, Findings, Severity, SourceFile, TextKind, read_text,
};
use congruent_lint::{
    FileKind, FileToLint, Ignores, SafeFix, coarse_quarter_turns, declared_encoding, examine_srdf,
    safe_fixes, safe_robot_file_fixes, still_mimics, undefined_materials, unit_mistakes, unknown_references,
    zero_limits,
};
use congruent_twin::RunSetup;

pub use self::{
    report::{LintFinding, LintFix, LintReport, LintVerdict},
    summary::LintSummary,
};

/// What was found in a file.
struct Examined {
    kind: Option<FileKind>,
    found: Vec<Diagnostic>,
    /// Whether rules that need a robot could not be applied.
    is_incomplete: bool,
    ignores: Ignores,
}

/// A file that is linted, and what else is known of it.
struct Subject<'a> {
    path: &'a Path,
    source: &'a Arc<SourceFile>,
    others: &'a [PathBuf],
    access: &'a FileAccess,
}

/// Everything that is wrong or suspicious in a URDF, an SRDF, a robot file or a scenario, with the files that it names.
///
/// # Examples
/// ```
/// # let folder = std::env::temp_dir().join("congruent_lint");
/// # std::fs::create_dir_all(&folder).unwrap();
/// # let path = folder.join("a.urdf");
/// use congruent_lint_report::{LintVerdict, lint};
/// use congruent_input::FileAccess;
/// std::fs::write(&path, "<robot name='r'><link name='a'/><link name='a'/></robot>").unwrap();
/// let report = lint(&path, &FileAccess::default());
/// assert_eq!(report.verdict, LintVerdict::Errors);
/// assert_eq!(report.findings[0].finding.id.as_deref(), Some("CGR-URDF-005"));
/// ```
pub fn lint(path: &Path, access: &FileAccess) -> LintReport {
    lint_among(path, &[], access)
}

/// Like `lint`, for one file among several: an SRDF is compared with the robot among them, as is a table of
/// configurations, targets or measurements.
pub fn lint_among(path: &Path, files: &[PathBuf], access: &FileAccess) -> LintReport {
    report(examined(path, files, access))
}

/// What [`lint`] finds in a robot that has been read.
pub fn lint_robot(description: &RobotDescription) -> LintReport {
    let is_bare = description.own_model().is_none() && description.path == description.urdf_path;
    let kind = if is_bare { FileKind::of_links(description) } else { FileKind::RobotFile };
    let ignores = if is_bare { Ignores::default() } else { ignores_of_robot(description) };
    report(Examined { kind: Some(kind), found: suspicions(description), is_incomplete: false, ignores })
}

fn report(examined: Examined) -> LintReport {
    let Examined { kind, found, is_incomplete, ignores } = examined;
    let is_unreadable = found.iter().any(|found| found.source.is_none() && found.code.is_unreadable);
    let (kept, ignored) = ignores.apply(found, &codes::known_codes());
    let diagnostics: Vec<Diagnostic> = kept.into_iter().map(judged).collect();
    let of = |severity| diagnostics.iter().filter(|found| found.severity == severity).count();
    let (errors, warnings) = (of(Severity::Error), of(Severity::Warning));
    let findings: Vec<LintFinding> = diagnostics
        .iter()
        .map(|found| LintFinding { finding: Finding::from(found), stopped_uses: stopped_uses(found, kind) })
        .collect();
    let is_stopped = |needed: &Capability| findings.iter().any(|found| found.stopped_uses.contains(needed));
    let verdict = match (errors, warnings) {
        _ if is_unreadable => LintVerdict::Unreadable,
        (0, 0) => LintVerdict::Clean,
        (0, _) => LintVerdict::Warnings,
        _ => LintVerdict::Errors,
    };
    let stops = ALL_USES.into_iter().filter(is_stopped).collect();
    let fixes = fixes(&diagnostics, kind);
    LintReport {
        kind,
        verdict,
        errors,
        warnings,
        stops,
        findings,
        is_incomplete: is_incomplete && !is_unreadable,
        ignored,
        fixes,
        diagnostics,
    }
}

/// The safe corrections of each file that has findings.
fn fixes(found: &[Diagnostic], kind: Option<FileKind>) -> Vec<LintFix> {
    let mut sources: Vec<&Arc<SourceFile>> = Vec::new();
    for source in found.iter().filter_map(|found| found.source.as_ref()) {
        if sources.iter().all(|known| known.path != source.path) {
            sources.push(source);
        }
    }
    let of = |source: &Arc<SourceFile>| {
        let found = |fix: &SafeFix| {
            found.iter().any(|found| {
                let path = found.source.as_ref().map(|source| &source.path);
                found.code == fix.code && path == Some(&source.path)
            })
        };
        let is_toml = source.path.extension().is_some_and(|extension| extension == "toml");
        let fixes = match (is_toml, kind) {
            (false, _) => safe_fixes(&source.text),
            (true, Some(FileKind::RobotFile)) => safe_robot_file_fixes(&source.text),
            (true, _) => Vec::new(),
        };
        let fixes = fixes.into_iter().filter(found);
        fixes.map(|fix| LintFix::from_safe_fix(fix, source)).collect::<Vec<_>>()
    };
    sources.into_iter().flat_map(of).collect()
}

/// A finding that stops a use is an error of the file, although the other uses go on.
fn judged(found: Diagnostic) -> Diagnostic {
    let severity = if found.stops.is_some() { Severity::Error } else { found.severity };
    Diagnostic { severity, ..found }
}

const ALL_USES: [Capability; 3] = [Capability::Kinematics, Capability::Clearance, Capability::Physics];

fn stopped_uses(found: &Diagnostic, kind: Option<FileKind>) -> Vec<Capability> {
    match (found.severity, found.stops, kind) {
        (_, Some(stopped), _) => vec![stopped],
        (Severity::Error, None, Some(FileKind::Urdf | FileKind::Mjcf | FileKind::RobotFile)) => {
            ALL_USES.to_vec()
        }
        _ => Vec::new(),
    }
}

fn examined(path: &Path, others: &[PathBuf], access: &FileAccess) -> Examined {
    let (kind, source) = match FileToLint::open(path, access) {
        Ok(FileToLint { kind, source }) => (kind, source),
        Err(fault) => {
            return Examined {
                kind: None,
                found: vec![fault],
                is_incomplete: false,
                ignores: Ignores::default(),
            };
        }
    };
    let mut is_incomplete = false;
    let (found, ignores) = match &source {
        None => (table(path, kind, others, access), Ignores::default()),
        Some(source) => {
            let subject = Subject { path, source, others, access };
            match kind {
                FileKind::Scenario => scenario(&subject),
                FileKind::Srdf => (srdf(&subject), Ignores::default()),
                _ => {
                    let robot = robot(&subject);
                    is_incomplete = robot.is_err();
                    (robot.unwrap_or_else(Findings::into_vec), ignores_of(source))
                }
            }
        }
    };
    Examined { kind: Some(kind), found, is_incomplete, ignores }
}

/// What is suspicious in a robot, or why it cannot be read.
fn robot(subject: &Subject<'_>) -> Result<Vec<Diagnostic>, Findings> {
    load_opened_robot(subject.source, subject.access).map(|robot| suspicions(&robot))
}

/// What is suspicious in a robot that could be read.
fn suspicions(description: &RobotDescription) -> Vec<Diagnostic> {
    let mut found = description.warnings.clone();
    if description.places.robot_file.is_none() {
        // A URDF has no place to choose a tip; commands that need one report the others.
        found.retain(|found| found.code != congruent_description::codes::chain::SEVERAL_TIPS);
    }
    let unit_mistakes = unit_mistakes(description);
    // Mass and shapes say which unit an inertia is in, so `units::inertia` replaces the reader's finding of its size.
    found = found.into_iter().filter_map(|found| without_inertias(found, &unit_mistakes)).collect();
    found.extend(unit_mistakes);
    found.extend(zero_limits(description));
    found.extend(still_mimics(description));
    found.extend(coarse_quarter_turns(description));
    found.extend(undefined_materials(description));
    found.extend(unknown_references(description));
    found.extend(description.places.urdf.as_ref().and_then(|places| declared_encoding(places.source())));
    if let Some(source) = srdf_of(description) {
        // The reader has compared only the names of its pairs: its findings on this file are replaced by those of the
        // whole SRDF.
        let is_reported_here =
            |found: &Diagnostic| found.source.as_ref().is_some_and(|of| of.path == source.path);
        found.retain(|found| !is_reported_here(found));
        let srdf_findings = examine_srdf(&source, Some(&description.robot)).into_iter();
        // A file that is not XML has no pairs, which blocks clearance only.
        found.extend(srdf_findings.map(|found| match found.severity {
            Severity::Error => found.needed_by(Some(Capability::Clearance)),
            Severity::Warning => found,
        }));
    }
    found
}

/// The reader's finding on tensors that are too large, without the links for which `units::inertia` names the unit.
fn without_inertias(found: Diagnostic, unit_mistakes: &[Diagnostic]) -> Option<Diagnostic> {
    if found.code != congruent_description::codes::urdf::INERTIA_SIZE {
        return Some(found);
    }
    let of_inertia = unit_mistakes
        .iter()
        .filter(|unit_mistake| unit_mistake.code == congruent_lint::codes::units::INERTIA);
    let own = |unit_mistake: &Diagnostic| {
        unit_mistake.kind.plural_and_name.iter().map(|(_, name)| name.clone()).collect::<Vec<_>>()
    };
    let names = of_inertia.flat_map(|unit_mistake| match &unit_mistake.kind.occurrences[..] {
        [] => own(unit_mistake),
        several => several.iter().filter_map(|each| each.name.clone()).collect(),
    });
    names.collect::<Vec<_>>().iter().try_fold(found, |found, name| found.without(name))
}

/// Largest file that is read a second time: larger ones were refused when they were read.
const MOST_BYTES: u64 = 16 << 20;
/// Largest table of measurements that is read a second time, in bytes.
const MOST_TABLE_BYTES: u64 = 64 << 20;

/// The SRDF of a robot file; `None` if it cannot be read, which the reader of the robot has reported.
fn srdf_of(description: &RobotDescription) -> Option<Arc<SourceFile>> {
    let srdf = description.named_files.srdf.as_ref()?;
    let is_read = description.inputs.iter().any(|file| file.path == *srdf);
    is_read.then(|| named_text(&description.path, srdf, TextKind::Robot)).flatten()
}

/// The text of a file that another file names.
fn named_text(by: &Path, path: &Path, kind: TextKind) -> Option<Arc<SourceFile>> {
    FileAccess::default().inside_project_of(by).ok()?.read_text(path, MOST_BYTES, kind).ok()
}

/// An SRDF by itself, with the robot that is given beside it or lies beside it.
fn srdf(subject: &Subject<'_>) -> Vec<Diagnostic> {
    match find_robot::robot_of_srdf(subject.path, subject.source, subject.others, subject.access) {
        Ok(robot) => examine_srdf(subject.source, Some(&robot)),
        Err(unknown) => {
            let mut found = examine_srdf(subject.source, None);
            found.push(unknown.in_file(subject.source));
            found
        }
    }
}

/// A table, as the command reads it that takes such a table.
fn table(path: &Path, kind: FileKind, others: &[PathBuf], access: &FileAccess) -> Vec<Diagnostic> {
    let description = match find_robot::robot_of_table(path, others, access) {
        Ok(description) => description,
        Err(unknown) => return vec![unknown],
    };
    let robot = &description.robot;
    let read = match kind {
        FileKind::Targets => read_targets(path, robot).map(|read| {
            let far = tables::targets(&read, &description);
            read.warnings.into_iter().chain(far).collect()
        }),
        FileKind::Measurements => needed_coordinates(&description)
            .map_err(Findings::from)
            .and_then(|needed| {
                Ok((read_measurements(path, robot, &needed)?, read_text(path, MOST_TABLE_BYTES)?))
            })
            .map(|(rows, source)| tables::measured(&rows, &description, &source)),
        // Velocities, accelerations and torques are checked with the positions.
        _ => read_states(path, robot).map(|read| read.warning.into_iter().collect()),
    };
    read.unwrap_or_else(Findings::into_vec)
}

fn scenario(subject: &Subject<'_>) -> (Vec<Diagnostic>, Ignores) {
    match RunSetup::load_with(subject.path, &[], subject.access) {
        Ok(setup) => {
            let ignores = ignores_of_robot(&setup.description);
            let mut found = setup.warnings.clone();
            found.extend(suspicions(&setup.description));
            // A run is a simulation, which needs more than a plan.
            if let Err(refused) = setup.for_simulation() {
                found.retain(|found| refused.iter().all(|refused| !is_same(found, refused)));
                found.extend(refused);
            }
            (found, ignores)
        }
        Err(found) => (found.into_vec(), Ignores::default()),
    }
}

fn is_same(one: &Diagnostic, other: &Diagnostic) -> bool {
    one.code == other.code && one.message == other.message
}

/// The findings that the robot file of a description ignores.
fn ignores_of_robot(description: &RobotDescription) -> Ignores {
    let path = &description.path;
    named_text(path, path, TextKind::RobotFile).as_ref().map_or_else(Ignores::default, ignores_of)
}

/// The findings that a robot file ignores; none for a URDF.
fn ignores_of(robot: &Arc<SourceFile>) -> Ignores {
    let is_robot_file =
        robot.path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"));
    if is_robot_file { Ignores::from_robot_file(robot) } else { Ignores::default() }
}
