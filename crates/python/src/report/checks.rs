//! `congruent.check`: the check of the command, with its rules for references and tolerances.

use std::path::{Path, PathBuf};

use congruent::{
    NamedBy, RobotCheck,
    agreement::compare::{Agreement, CheckOptions},
    cannot_be_checked,
    description::{RequestedTolerance, RobotDescription, RobotQList, Tolerance},
    input::{Diagnostic, Findings, serde_name},
    other_description,
    text::{CheckTextParts, TextOptions, check_text},
    unusable_inertials,
};
use congruent_cli::{ToleranceArgument, worse};
use pyo3::{exceptions::PyValueError, prelude::*, types::PyDict};

use super::class::PythonReport;
use crate::{
    error::{failed, refused},
    interrupt::{OnInterrupt, interruptible},
    options::KeywordOptions,
    robot::{PythonRobot, access, from_path},
};

/// What is checked, read and complete.
struct CheckRequest {
    description: RobotDescription,
    against: Option<PathBuf>,
    tolerance: Option<ToleranceArgument>,
    /// The tolerance of the robot file, and which parts of it the file declares.
    declared_tolerance: Tolerance,
    declared: RequestedTolerance,
    seed: u64,
    is_strict: bool,
}

/// A check with the robot that its text is about.
struct CheckOfRobot {
    report: RobotCheck,
    description: RobotDescription,
}

/// Whether the descriptions of a robot are the same robot, as ``congruent check``: its table, its URDF and its physics, and the
/// robot of ``against``, a path or ``git:REV``.
///
/// Without ``against`` each ``[[reference]]`` of the robot file is compared. ``tolerance`` is a text with units, as
/// ``"1mm,0.1deg"``. A difference is an answer, and no error. After Ctrl-C the rest of a check ends unseen.
#[pyfunction]
#[pyo3(signature = (robot, against=None, **options))]
#[pyo3(
    text_signature = "(robot, against=None, *, tolerance=None, base=None, tip=None, seed=0, strict=False)"
)]
pub(crate) fn check(
    robot: &Bound<'_, PyAny>,
    against: Option<PathBuf>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<PythonReport> {
    let py = robot.py();
    let mut keywords = KeywordOptions::new("check", options);
    let tolerance: Option<String> = keywords.take("tolerance")?;
    let [base, tip]: [Option<String>; 2] = [keywords.take("base")?, keywords.take("tip")?];
    let seed: u64 = keywords.take("seed")?.unwrap_or_default();
    let is_strict: bool = keywords.take("strict")?.unwrap_or_default();
    keywords.finish()?;
    let tolerance = tolerance.map(|text| text.parse::<ToleranceArgument>()).transpose();
    let tolerance = tolerance.map_err(|why| PyValueError::new_err(format!("tolerance: {why}")))?;
    let description = if let Ok(robot) = robot.cast::<PythonRobot>() {
        robot.get().description().clone()
    } else {
        let path: PathBuf = robot.extract()?;
        py.detach(|| from_path(&path)).map_err(|findings| refused(py, findings))?
    };
    let chosen = description.with_chain(base.as_deref(), tip.as_deref());
    let description = chosen.map_err(|finding| refused(py, finding))?;
    let (declared_tolerance, declared) = (description.tolerance, description.declared_tolerance);
    let request =
        CheckRequest { description, against, tolerance, declared_tolerance, declared, seed, is_strict };
    // A check has no place at which it could stop; it takes a second or some.
    let answer =
        interruptible(py, OnInterrupt::Abandon, move |_| request.answer().map(|checked| joined(&checked)))?;
    let report = answer.map_err(|findings| refused(py, findings))?;
    report.map_err(|error| failed(py, &error.to_string()))
}

impl CheckRequest {
    /// The check against the given description, or else against each that the robot file names.
    fn answer(mut self) -> Result<Vec<CheckOfRobot>, Findings> {
        let warnings = self.set_tolerance()?;
        let others: Vec<Option<PathBuf>> = match (&self.against, &self.description.references[..]) {
            (Some(against), _) => vec![Some(against.clone())],
            (None, []) => vec![None],
            (None, named) => named.iter().map(|reference| Some(reference.path.clone())).collect(),
        };
        let checked = others.into_iter().map(|other| {
            let mut checked = self.compared(other.as_deref())?;
            checked.report.geometry.warnings.extend(warnings.iter().map(Into::into));
            Ok(checked)
        });
        checked.collect()
    }

    /// Puts the tolerance of the caller in place of that of the file; its warnings.
    fn set_tolerance(&mut self) -> Result<Vec<Diagnostic>, Findings> {
        let Some(tolerance) = self.tolerance else { return Ok(Vec::new()) };
        let (wrong, wide) = tolerance.examine(self.description.tolerance_scale());
        if !wrong.is_empty() {
            return Err(wrong.into());
        }
        let requested = tolerance.requested_or(self.description.declared_tolerance);
        self.description.declared_tolerance = requested;
        self.description.tolerance = requested.or(Tolerance::default());
        Ok(wide)
    }

    fn compared(&self, other: Option<&Path>) -> Result<CheckOfRobot, Findings> {
        let mut description = self.description.clone();
        let named_by = if self.against.is_some() { NamedBy::Caller } else { NamedBy::RobotFile };
        let other = other.map(|other| other_description(&mut description, other, named_by, access()?));
        let other = other.transpose()?;
        let configurations = RobotQList::new(description.robot.dof());
        let options = CheckOptions { seed: self.seed, configurations: configurations.into() };
        let compared = match &other {
            Some(other) => congruent::check_against(&description, other, &options),
            None => congruent::check(&description, &options),
        };
        let mut report = compared.map_err(|error| cannot_be_checked(&description.path, &error))?;
        let unusable = unusable_inertials(&description);
        if report.geometry.verdict == Agreement::Agree && !unusable.is_empty() {
            return Err(unusable.into());
        }
        let declared = self.declared.is_declared().then_some(self.declared_tolerance);
        report.lint.is_strict = self.is_strict;
        report.geometry.requested_tolerance = self.tolerance.map(ToleranceArgument::requested);
        report.geometry.replaced_tolerance = self.tolerance.and(declared);
        Ok(CheckOfRobot { report, description })
    }
}

/// One report of all comparisons: it is as good as the worst of them.
fn joined(checked: &[CheckOfRobot]) -> Result<PythonReport, serde_json::Error> {
    let options = TextOptions::default();
    let text = |of: &CheckOfRobot| {
        let text = check_text(&of.report, &of.description.robot, CheckTextParts::default(), &options);
        options.for_terminal(&text)
    };
    let headline = |of: &CheckOfRobot| format!("{}: {}", of.report.geometry.file, of.report.headline());
    let reports: Vec<&RobotCheck> = checked.iter().map(|of| &of.report).collect();
    let document = match &reports[..] {
        [only] => serde_json::to_string(only)?,
        several => serde_json::to_string(several)?,
    };
    Ok(PythonReport {
        exit_code: reports.iter().map(|of| of.exit_code()).fold(0, worse),
        grade: reports
            .iter()
            .filter_map(|of| of.geometry.grade)
            .max()
            .map(|grade| serde_name(&grade).to_owned()),
        headline: checked.iter().map(headline).collect::<Vec<_>>().join("\n"),
        text: checked.iter().map(text).collect(),
        document,
        series: None,
        folder: None,
    })
}
