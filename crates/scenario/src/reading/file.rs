//! A scenario file: TOML text to plain data, every fault a diagnostic at its place.

use std::{
    ops::Range,
    path::{Path, PathBuf},
    sync::Arc,
};

use congruent_input::{
    Diagnostic, Diagnostics, FileAccess, Findings, Override, SourceFile, codes::toml::UNKNOWN_KEY,
    direct_path, distinct_places, is_standard_input, nearest, toml_text,
};
use serde::Deserialize;
use toml::Spanned;

use super::{
    expect::read_expect,
    faults::read_fault,
    motion::read_motion,
    other_file::{refuse_folder, refuse_other_text},
    robot_overrides::of_scenario,
    section::Section,
};
use crate::{
    Check, CheckKind, ControllerKind, ControllerSettings, Expectation, FilePlace, SCHEMA_VERSION, Scenario,
    SourceSettings, codes, place::PlaceNode,
};

/// Largest scenario file that is read.
pub(super) const MOST_BYTES: u64 = 4 << 20;

/// A scenario with the places of its values.
#[derive(Debug, Clone)]
pub struct ScenarioFile {
    /// The content of the file, with the overrides applied.
    pub scenario: Scenario,
    source: Arc<SourceFile>,
    places: PlaceNode,
    /// Unknown keys: the rest can be checked all the same.
    findings: Vec<Diagnostic>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Top {
    schema_version: Spanned<u32>,
    name: Spanned<String>,
    robot: String,
    #[serde(default)]
    folder: Option<String>,
    #[serde(default)]
    seed: u64,
}

/// The sections of a file below its top.
const SECTIONS: [&str; 17] = [
    "simulation",
    "source",
    "start",
    "controller",
    "joints",
    "sensors",
    "payload",
    "limits",
    "motion",
    "obstacle",
    "grasp",
    "zone",
    "fault",
    "check",
    "uncertainty",
    "output",
    "expect",
];

impl ScenarioFile {
    /// Reads a file; `overrides` replace its values.
    ///
    /// # Errors
    /// Every finding, if the file is not a valid scenario.
    pub fn read(path: &Path, overrides: &[Override]) -> Result<Self, Findings> {
        Self::read_with(path, overrides, &FileAccess::default())
    }

    /// The same, and `access` lists the file.
    ///
    /// # Errors
    /// As [`ScenarioFile::read`].
    pub fn read_with(path: &Path, overrides: &[Override], access: &FileAccess) -> Result<Self, Findings> {
        refuse_folder(path)?;
        let source = access.read_named_text(path, MOST_BYTES)?;
        refuse_other_text(path, &source.text)?;
        let in_file = |fault: Diagnostic| fault.in_file(&source);
        let mut document = toml_text::parse_document(&source.text).map_err(in_file)?;
        let places = PlaceNode::of_document(&source.text, &document);
        distinct_places(of_scenario(overrides), &document).map_err(in_file)?;
        let set: Result<Vec<Range<usize>>, Diagnostic> =
            of_scenario(overrides).map(|change| change.apply(&mut document)).collect();
        let set = set.and_then(|set| set_once(overrides).map(|()| set)).map_err(in_file)?;
        let mut findings = Diagnostics::default();
        let scenario = read(Section::new(document), &mut findings);
        let findings = findings.map(|finding| name_override(finding, overrides, &set)).into_vec();
        let findings: Vec<Diagnostic> = findings.into_iter().map(in_file).collect();
        match scenario {
            Some(scenario) if findings.iter().all(is_unknown_key) => {
                Ok(Self { scenario, source, places, findings })
            }
            _ => Err(findings.into()),
        }
    }

    /// Path of the scenario file, as it was named.
    pub fn path(&self) -> &Path {
        &self.source.path
    }

    /// The text of the file, with its path.
    pub fn source(&self) -> &Arc<SourceFile> {
        &self.source
    }

    /// The robot's path, relative to the folder of the file.
    pub fn robot_path(&self) -> PathBuf {
        direct_path(&self.folder().join(&self.scenario.robot))
    }

    /// The folder to which paths in the file are relative: its own, unless it names another.
    pub fn folder(&self) -> PathBuf {
        let own = self.path().parent().filter(|_| !is_standard_input(self.path()));
        let own = own.unwrap_or(Path::new(""));
        self.scenario.folder.as_ref().map_or_else(|| own.to_owned(), |folder| own.join(folder))
    }

    /// The places of the values in the file.
    pub fn place(&self) -> FilePlace<'_> {
        FilePlace::at_node(Some(&self.places))
    }

    /// Errors with which the file could still be read: unknown keys.
    pub fn findings(&self) -> &[Diagnostic] {
        &self.findings
    }

    /// A diagnostic about it.
    pub fn mark(&self, diagnostic: Diagnostic) -> Diagnostic {
        diagnostic.in_file(&self.source)
    }
}

fn is_unknown_key(finding: &Diagnostic) -> bool {
    finding.code == UNKNOWN_KEY
}

/// Refuses a key that is set twice: which of the values is meant is not known.
fn set_once(overrides: &[Override]) -> Result<(), Diagnostic> {
    let again = overrides.iter().enumerate().find_map(|(at, change)| {
        overrides[..at]
            .iter()
            .find(|before| before.same_key(change) && before.excludes(change))
            .map(|before| (before, change))
    });
    again.map_or(Ok(()), |(before, change)| {
        Err(change.refused(&format!("the key is set twice, first by {before}")))
    })
}

/// Names in the help on unknown keys a key that was read before the others.
fn named_too(found: Vec<Diagnostic>, key: &str) -> Vec<Diagnostic> {
    let named = |finding: Diagnostic| {
        if is_unknown_key(&finding) { with_more_help(finding, key) } else { finding }
    };
    found.into_iter().map(named).collect()
}

/// Adds to a fault of an overridden value that it was set: the line of the file has another value.
fn name_override(finding: Diagnostic, overrides: &[Override], set: &[Range<usize>]) -> Diagnostic {
    let cause = of_scenario(overrides).zip(set).find(|(_, place)| finding.span.as_ref() == Some(place));
    match cause {
        // The key is not in the file: a place there would be that of another one.
        Some((change, _)) if is_unknown_key(&finding) => {
            Diagnostic { message: format!("--set {change}: {}", finding.message), span: None, ..finding }
        }
        Some((change, _)) => with_more_help(finding, &format!("it was set by --set {change}")),
        None => finding,
    }
}

fn with_more_help(finding: Diagnostic, more: &str) -> Diagnostic {
    let help = finding.help.clone().unwrap_or_default();
    // Without a help the text would begin with the separator.
    finding.with_help(format!("{help}; {more}").trim_start_matches("; ").to_owned())
}

/// Reads all sections, also after a fault, so that one reading names all of them.
fn read(mut document: Section<'_>, findings: &mut Diagnostics) -> Option<Scenario> {
    let simulation = one(&mut document, "simulation", findings);
    let start = one(&mut document, "start", findings);
    let controller = driven_by(&mut document, findings);
    let source = read_source(&mut document);
    let source = findings.keep(source);
    let limits = one(&mut document, "limits", findings);
    let joints = one(&mut document, "joints", findings);
    let sensors = one(&mut document, "sensors", findings);
    let payload = all(&mut document, "payload", findings, |section, findings| {
        findings.keep(section.require_table("inertia_kg_m2"));
        section.read_into(findings)
    });
    let motion = all(&mut document, "motion", findings, read_motion);
    let obstacle = all(&mut document, "obstacle", findings, |section, findings| {
        findings.keep(section.require_table("cylinder"));
        section.read_into(findings)
    });
    let grasp = all(&mut document, "grasp", findings, Section::read_into);
    let zone = all(&mut document, "zone", findings, |section, findings| {
        findings.keep(section.require_table("cylinder"));
        section.read_into(findings)
    });
    let fault = all(&mut document, "fault", findings, read_fault);
    let checks = all(&mut document, "check", findings, read_check);
    let uncertainty = if_given(&mut document, "uncertainty", findings);
    let output = one(&mut document, "output", findings);
    let expect = findings.keep(document.take_table("expect")).flatten();
    let expect = findings.keep(expect.map_or(Ok(Expectation::default()), read_expect));
    let mut at_top = Diagnostics::default();
    let top: Option<Top> = document.read_into(&mut at_top);
    findings.extend(at_top.map(name_sections).into_vec());
    if findings.has_misspelt("controller") {
        findings.retain(|found| found.code != codes::scenario::NO_CONTROLLER);
    }
    let top = top?;
    findings.keep(check_top(&top));
    Some(Scenario {
        schema_version: top.schema_version.into_inner(),
        name: top.name.into_inner(),
        robot: top.robot,
        folder: top.folder,
        seed: top.seed,
        simulation: simulation?,
        start: start?,
        source: source?,
        controller: controller?,
        limits: limits?,
        joints: joints?,
        sensors: sensors?,
        payload: payload?,
        motion: motion?,
        obstacle: obstacle?,
        grasp: grasp?,
        zone: zone?,
        fault: fault?,
        check: checks?,
        uncertainty,
        output: output?,
        expect: expect?,
    })
}

/// A section that may be left out.
fn one<T: serde::de::DeserializeOwned + Default>(
    document: &mut Section<'_>,
    key: &str,
    findings: &mut Diagnostics,
) -> Option<T> {
    match findings.keep(document.take_table(key))? {
        Some(section) => section.read_into(findings),
        None => Some(T::default()),
    }
}

/// A section without defaults, if it is there; one that cannot be read is in `findings`.
fn if_given<T: serde::de::DeserializeOwned>(
    document: &mut Section<'_>,
    key: &str,
    findings: &mut Diagnostics,
) -> Option<T> {
    findings.keep(document.take_table(key)).flatten().and_then(|section| section.read_into(findings))
}

/// All sections of one name; `None` if one of them could not be read.
fn all<'a, T>(
    document: &mut Section<'a>,
    key: &str,
    findings: &mut Diagnostics,
    read: impl Fn(Section<'a>, &mut Diagnostics) -> Option<T>,
) -> Option<Vec<T>> {
    let sections = findings.keep(document.take_tables(key))?;
    // Each is read, even if one before it is wrong.
    let read: Vec<Option<T>> = sections.into_iter().map(|section| read(section, findings)).collect();
    read.into_iter().collect()
}

fn read_check(mut section: Section<'_>, findings: &mut Diagnostics) -> Option<Check> {
    let kind = *findings.keep(section.select("kind", "check", &CheckKind::ALL, |kind| kind.word()))?;
    let mut found = Diagnostics::default();
    let check = match kind {
        CheckKind::Agreement => section.read_into(&mut found).map(Check::Agreement),
        CheckKind::Clearance => section.read_into(&mut found).map(Check::Clearance),
        CheckKind::Contact => section.read_into(&mut found).map(Check::Contact),
        CheckKind::CycleTime => section.read_into(&mut found).map(Check::CycleTime),
        CheckKind::Dynamics => section.read_into(&mut found).map(Check::Dynamics),
        CheckKind::Effort => section.read_into(&mut found).map(Check::Effort),
        CheckKind::Goal => section.read_into(&mut found).map(Check::Goal),
        CheckKind::Invariants => section.read_into(&mut found).map(Check::Invariants),
        CheckKind::Limits => section.read_into(&mut found).map(Check::Limits),
        CheckKind::Pose => section.read_into(&mut found).map(Check::Pose),
        CheckKind::Power => section.read_into(&mut found).map(Check::Power),
        CheckKind::Recording => section.read_into(&mut found).map(Check::Recording),
        CheckKind::Step => section.read_into(&mut found).map(Check::Step),
        CheckKind::Tracking => section.read_into(&mut found).map(Check::Tracking),
        CheckKind::Twist => section.read_into(&mut found).map(Check::Twist),
        CheckKind::SamePoint => section.read_into(&mut found).map(Check::SamePoint),
        CheckKind::Velocity => section.read_into(&mut found).map(Check::Velocity),
        CheckKind::Zone => section.read_into(&mut found).map(Check::Zone),
    };
    findings.extend(named_too(found.into_vec(), "of every check: kind"));
    check
}

/// The log of a scenario; nothing of what only a simulation needs may be beside it.
fn read_source(document: &mut Section<'_>) -> Result<Option<SourceSettings>, Findings> {
    let Some(section) = document.take_table("source")? else { return Ok(None) };
    let mut findings = Diagnostics::default();
    for excluded in ["controller", "motion", "fault", "uncertainty"] {
        if let Some(span) = document.take_span_of(excluded) {
            let message = format!("[{excluded}] is beside [source], whose log says how the joints moved");
            let error = Diagnostic::error(codes::scenario::SOURCE, message);
            let help = format!("remove [{excluded}], or remove [source] to simulate the robot");
            findings.keep(Err::<(), _>(error.with_help(help).at(span)));
        }
    }
    match section.read_into(&mut findings) {
        Some(source) if !findings.has_error() => Ok(Some(source)),
        _ => Err(findings.into()),
    }
}

/// The controller; none beside `[source]`.
fn driven_by(document: &mut Section<'_>, findings: &mut Diagnostics) -> Option<ControllerSettings> {
    if document.has("source") {
        // One that is there all the same is refused with the source.
        return Some(ControllerSettings::absent());
    }
    let controller = document.take_table("controller").map_err(Findings::from);
    findings.keep(controller.and_then(read_controller))
}

fn read_controller(section: Option<Section<'_>>) -> Result<ControllerSettings, Findings> {
    let known = ControllerKind::names();
    let Some(section) = section else {
        return Err(Diagnostic::error(codes::scenario::NO_CONTROLLER, "the scenario has no [controller]")
            .with_help(format!("add one with kind = {}", known.join(" | ")))
            .into());
    };
    // The kind first: with an unknown kind it is not known which other keys are valid.
    section.clone().select("kind", "controller", &known, |name| name)?;
    section.read()
}

/// An unknown key at the top may be a misspelt section.
fn name_sections(error: Diagnostic) -> Diagnostic {
    if !is_unknown_key(&error) {
        return error;
    }
    let unknown = error.message.split('"').nth(1).unwrap_or_default();
    let meant = nearest(unknown, SECTIONS);
    let sections = SECTIONS.map(|section| format!("[{section}]")).join(", ");
    let error = with_more_help(error, &format!("sections: {sections}"));
    match (meant, error.help.clone()) {
        (Some(meant), Some(help)) if !help.starts_with("did you mean") => {
            error.with_help(format!("did you mean \"{meant}\"? {help}"))
        }
        _ => error,
    }
}

fn check_top(top: &Top) -> Result<(), Diagnostic> {
    let version = *top.schema_version.get_ref();
    if version != SCHEMA_VERSION {
        let message = format!("schema_version = {version} is not supported");
        return Err(Diagnostic::error(codes::scenario::VERSION, message)
            .with_help(format!("this program reads version {SCHEMA_VERSION}"))
            .at(top.schema_version.span()));
    }
    if top.name.get_ref().trim().is_empty() {
        return Err(Diagnostic::error(codes::scenario::NAME, "the name is empty")
            .with_help("results go to a folder of this name")
            .at(top.name.span()));
    }
    Ok(())
}
