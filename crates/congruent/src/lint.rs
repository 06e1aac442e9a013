//! `lint`: everything that is wrong or suspicious in a file, whatever its kind, as one report.

use std::{path::Path, sync::Arc};

use congruent_description::{
    ChangedLines, Code, Diagnostic, FileAccess, FileKind, Finding, IgnoredFinding, Ignores, RobotDescription,
    SRDF_BYTES, SafeFix, Severity, SourceFile, TextEdit, Use, changed_lines, examine_srdf, load_robot_with,
    safe_fixes, unit_slips,
};
use congruent_twin::RunSetup;
use schemars::JsonSchema;
use serde::Serialize;

/// What is wrong or suspicious in a file.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct LintReport {
    /// What the file is; `None` if it is nothing that can be linted.
    pub kind: Option<FileKind>,
    /// What the findings come to.
    pub verdict: LintVerdict,
    /// Number of findings that are errors.
    pub errors: usize,
    /// Number of findings that are warnings; those of one kind are one.
    pub warnings: usize,
    /// What the robot cannot be used for because of them; empty of a scenario.
    pub stops: Vec<Use>,
    /// The findings, in the order of the file.
    pub findings: Vec<LintFinding>,
    /// What the robot file ignores.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub ignored: Vec<IgnoredFinding>,
    /// Corrections that are safe.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub fixes: Vec<LintFix>,
    /// The findings with the texts of their files, for printing.
    #[serde(skip)]
    pub diagnostics: Vec<Diagnostic>,
}

/// A correction that is safe: the file means the same after it, or what was refused has the one meaning that was left.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct LintFix {
    /// Number of the finding that it answers.
    pub id: String,
    /// Its name.
    pub code: &'static str,
    /// What it does.
    pub about: String,
    /// The file.
    pub file: String,
    /// The lines that change.
    pub changed: Vec<ChangedLines>,
    /// The file with its text.
    #[serde(skip)]
    pub source: Arc<SourceFile>,
    /// The changes of the text.
    #[serde(skip)]
    pub edits: Vec<TextEdit>,
}

/// What findings come to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LintVerdict {
    /// Nothing was found.
    Clean,
    /// Nothing is wrong, something is suspicious or missing.
    Warnings,
    /// Something is wrong.
    Errors,
    /// The file cannot be read.
    Unreadable,
}

/// A finding, and what it stops.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct LintFinding {
    /// The finding.
    #[serde(flatten)]
    pub finding: Finding,
    /// What the robot cannot be used for because of it; an error without a use of its own stops all.
    pub stopped_uses: Vec<Use>,
}

/// What was found in a file.
struct Examined {
    kind: Option<FileKind>,
    found: Vec<Diagnostic>,
    ignores: Ignores,
}

/// Everything that is wrong or suspicious in a URDF, an SRDF, a robot file or a scenario, with the files that it names.
///
/// # Examples
/// ```
/// # let folder = std::env::temp_dir().join("congruent_lint");
/// # std::fs::create_dir_all(&folder).unwrap();
/// # let path = folder.join("a.urdf");
/// use congruent::{description::FileAccess, lint, LintVerdict};
/// std::fs::write(&path, "<robot name='r'><link name='a'/><link name='a'/></robot>").unwrap();
/// let report = lint(&path, &FileAccess::default());
/// assert_eq!(report.verdict, LintVerdict::Errors);
/// assert_eq!(report.findings[0].finding.id.as_deref(), Some("CGR-URDF-005"));
/// ```
pub fn lint(path: &Path, access: &FileAccess) -> LintReport {
    let Examined { kind, found, ignores } = examined(path, access);
    let is_unreadable = found.iter().any(|found| found.source.is_none() && is_about_the_file(found));
    let (kept, ignored) = ignores.apply(found);
    let diagnostics: Vec<Diagnostic> = kept.into_iter().map(judged).collect();
    let of = |severity| diagnostics.iter().filter(|found| found.severity == severity).count();
    let (errors, warnings) = (of(Severity::Error), of(Severity::Warning));
    let findings: Vec<LintFinding> = diagnostics
        .iter()
        .map(|found| LintFinding { finding: Finding::from(found), stopped_uses: stopped_uses(found, kind) })
        .collect();
    let is_stopped = |needed: &Use| findings.iter().any(|found| found.stopped_uses.contains(needed));
    let verdict = match (errors, warnings) {
        _ if is_unreadable => LintVerdict::Unreadable,
        (0, 0) => LintVerdict::Clean,
        (0, _) => LintVerdict::Warnings,
        _ => LintVerdict::Errors,
    };
    let stops = ALL_USES.into_iter().filter(is_stopped).collect();
    let fixes = fixes(&diagnostics);
    LintReport { kind, verdict, errors, warnings, stops, findings, ignored, fixes, diagnostics }
}

/// The safe corrections of each URDF that has findings.
fn fixes(found: &[Diagnostic]) -> Vec<LintFix> {
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
        let fixes = safe_fixes(&source.text).into_iter().filter(found);
        fixes.map(|fix| LintFix::of(fix, source)).collect::<Vec<_>>()
    };
    sources.into_iter().flat_map(of).collect()
}

impl LintFix {
    fn of(fix: SafeFix, source: &Arc<SourceFile>) -> Self {
        Self {
            id: Code::find(fix.code).map_or_else(String::new, |code| code.to_string()),
            code: fix.code,
            about: fix.about,
            file: source.path.display().to_string(),
            changed: changed_lines(&source.text, &fix.edits),
            source: Arc::clone(source),
            edits: fix.edits,
        }
    }
}

/// A finding that stops a use is an error of the file, although the other uses go on.
fn judged(found: Diagnostic) -> Diagnostic {
    let severity = if found.stops.is_some() { Severity::Error } else { found.severity };
    Diagnostic { severity, ..found }
}

const ALL_USES: [Use; 3] = [Use::Kinematics, Use::Clearance, Use::Physics];

fn stopped_uses(found: &Diagnostic, kind: Option<FileKind>) -> Vec<Use> {
    match (found.severity, found.stops, kind) {
        (_, Some(stopped), _) => vec![stopped],
        (Severity::Error, None, Some(FileKind::Urdf | FileKind::RobotFile)) => ALL_USES.to_vec(),
        _ => Vec::new(),
    }
}

/// Whether a finding says that the file itself could not be read.
fn is_about_the_file(found: &Diagnostic) -> bool {
    ["file::", "load::", "lint::kind"].iter().any(|area| found.code.starts_with(area))
}

fn examined(path: &Path, access: &FileAccess) -> Examined {
    let refused = |fault| Examined { kind: None, found: vec![fault], ignores: Ignores::default() };
    let kind = match FileKind::of(path, access) {
        Ok(kind) => kind,
        Err(fault) => return refused(fault),
    };
    let (found, ignores) = match kind {
        FileKind::Urdf | FileKind::RobotFile => robot(path, access),
        FileKind::Scenario => scenario(path, access),
        FileKind::Srdf => {
            let source = access.read_named_text(path, SRDF_BYTES);
            (source.map_or_else(|fault| vec![fault], |source| examine_srdf(&source)), Ignores::default())
        }
    };
    Examined { kind: Some(kind), found, ignores }
}

fn robot(path: &Path, access: &FileAccess) -> (Vec<Diagnostic>, Ignores) {
    let found = load_robot_with(path, access).map_or_else(|found| found, suspicions);
    (found, ignores_of(path, access))
}

/// What is suspicious in a robot that could be read.
fn suspicions(description: RobotDescription) -> Vec<Diagnostic> {
    let slips = unit_slips(&description);
    let mut found = description.warnings;
    found.extend(slips);
    found
}

fn scenario(path: &Path, access: &FileAccess) -> (Vec<Diagnostic>, Ignores) {
    match RunSetup::load_with(path, &[], access) {
        Ok(setup) => {
            let ignores = ignores_of(&setup.description.path, access);
            let mut found = setup.warnings.clone();
            found.extend(suspicions(setup.description.clone()));
            // A run is a simulation, which needs more than a plan.
            if let Err(refused) = setup.for_simulation() {
                found.retain(|found| refused.iter().all(|refused| !is_same(found, refused)));
                found.extend(refused);
            }
            (found, ignores)
        }
        Err(found) => (found, Ignores::default()),
    }
}

fn is_same(one: &Diagnostic, other: &Diagnostic) -> bool {
    one.code == other.code && one.message == other.message
}

/// What the robot file of a robot ignores.
fn ignores_of(robot: &Path, access: &FileAccess) -> Ignores {
    let file = if robot.is_dir() { robot.join("robot.toml") } else { robot.to_owned() };
    let is_robot_file = file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"));
    let source = is_robot_file.then(|| access.fresh().read_named_text(&file, SRDF_BYTES).ok()).flatten();
    source.map_or_else(Ignores::default, |source| Ignores::of(&source))
}
