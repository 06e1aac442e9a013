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
use pyo3::{
    exceptions::{PyTypeError, PyValueError},
    prelude::*,
    types::PyDict,
};

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
    /// What an engine has loaded, or the poses of a function show, in place of another file.
    loaded: Option<RobotDescription>,
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
/// In the place of ``against`` may be ``engine``, what an engine has loaded, as ``congruent.engines.mujoco(model)``; or ``poses``, a function
/// that takes q, (joints,), in rad and m, and gives ``base_from_tip``, (4, 4), with ``joints``, the names of the joints of q in its order.
///
/// Without these each ``[[reference]]`` of the robot file is compared. ``tolerance`` is a text with units, as
/// ``"1mm,0.1deg"``. A difference is an answer, and no error. After Ctrl-C the rest of a check ends unseen.
#[pyfunction]
#[pyo3(signature = (robot, against=None, **options))]
#[pyo3(
    text_signature = "(robot, against=None, *, engine=None, poses=None, joints=None, tolerance=None, base=None, tip=None, \
                      seed=0, strict=False)"
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
    let [engine, poses, joints]: [Option<Py<PyAny>>; 3] =
        [keywords.take("engine")?, keywords.take("poses")?, keywords.take("joints")?];
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
    let asked = Asked { against: against.is_some(), engine, poses, joints };
    let loaded = asked.loaded(py, &description)?;
    let (declared_tolerance, declared) = (description.tolerance, description.declared_tolerance);
    let request = CheckRequest {
        description,
        against,
        loaded,
        tolerance,
        declared_tolerance,
        declared,
        seed,
        is_strict,
    };
    // A check has no place at which it could stop; it takes a second or some.
    let answer =
        interruptible(py, OnInterrupt::Abandon, move |_| request.answer().map(|checked| joined(&checked)))?;
    let report = answer.map_err(|findings| refused(py, findings))?;
    report.map_err(|error| failed(py, &error.to_string()))
}

/// What is compared with the robot: at most one of these.
struct Asked {
    against: bool,
    engine: Option<Py<PyAny>>,
    poses: Option<Py<PyAny>>,
    joints: Option<Py<PyAny>>,
}

impl Asked {
    /// The robot that an engine has loaded, or that the poses of a function show; `None` for another file.
    fn loaded(self, py: Python<'_>, description: &RobotDescription) -> PyResult<Option<RobotDescription>> {
        let Self { against, engine, poses, joints } = self;
        let given = usize::from(against) + usize::from(engine.is_some()) + usize::from(poses.is_some());
        if given > 1 {
            return Err(PyTypeError::new_err("check() takes one of against, engine and poses"));
        }
        if joints.is_some() != poses.is_some() {
            return Err(PyTypeError::new_err(
                "check() takes poses and joints together: the joints of q, in its order",
            ));
        }
        if engine.is_none() && poses.is_none() {
            return Ok(None);
        }
        let robot = PythonRobot::along(py, description.clone(), None, None)?;
        let asked = match (engine, poses) {
            (Some(engine), _) => {
                py.import("congruent.engines._engine")?.call_method1("asked", (engine, robot))?
            }
            (None, poses) => {
                py.import("congruent.engines._poses")?.call_method1("asked", (poses, joints, robot))?
            }
        };
        Ok(Some(asked.cast::<PythonRobot>()?.get().description().clone()))
    }
}

impl CheckRequest {
    /// The check against the given description, or else against each that the robot file names.
    fn answer(mut self) -> Result<Vec<CheckOfRobot>, Findings> {
        let warnings = self.set_tolerance()?;
        let others: Vec<Option<PathBuf>> = match (&self.against, &self.description.references[..]) {
            _ if self.loaded.is_some() => vec![None],
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
        let other = self.loaded.clone().map_or_else(|| other.transpose(), |loaded| Ok(Some(loaded)))?;
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
