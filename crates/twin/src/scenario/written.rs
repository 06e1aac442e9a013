//! The top of a scenario file as written, and its way to a checked [`Scenario`].

use std::path::{Path, PathBuf};

use congruent_description::{Diagnostic, Findings, RobotDescription};
use congruent_simulation::{Gains, controller_names};
use nalgebra::Vector3;
use serde::Deserialize;
use toml::Spanned;

use super::{
    ControllerSettings, Overrides, Scenario, SimulationSettings,
    joint_values::{JointValues, WrittenJoints},
    number::{Finite, NonNegative, Positive},
    obstacle,
    section::Section,
};
use crate::{monitor, motion::Trajectory, verdict::Expectation};

/// The one version of the format that exists.
const SCHEMA_VERSION: u32 = 1;
/// Longest step: beyond it no arm in `robots/` is stable.
const LONGEST_STEP_S: f64 = 0.01;
/// Most steps of one run: about an hour of computing.
const MOST_STEPS: f64 = 1e8;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Top {
    schema_version: Spanned<u32>,
    name: Spanned<String>,
    robot: Spanned<String>,
    #[serde(default)]
    seed: u64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Simulation {
    step_s: Option<Spanned<Positive>>,
    duration_s: Option<Spanned<Positive>>,
    gravity_m_s2: Option<[Finite; 3]>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(clippy::struct_field_names, reason = "the keys of the file")]
struct Start {
    #[serde(default)]
    joints_deg: WrittenJoints,
    #[serde(default)]
    joints_rad: WrittenJoints,
    #[serde(default)]
    joints_m: WrittenJoints,
    #[serde(default)]
    joints_mm: WrittenJoints,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Controller {
    stiffness: Option<NonNegative>,
    damping: Option<NonNegative>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Expect {
    #[serde(default)]
    checks: Vec<Spanned<String>>,
}

/// A scenario file, taken apart: each section is read by the module that knows it.
pub(super) struct Document<'a> {
    top: Top,
    simulation: Option<Section<'a>>,
    start: Option<Section<'a>>,
    controller: Option<Section<'a>>,
    motions: Vec<Section<'a>>,
    obstacles: Vec<Section<'a>>,
    checks: Vec<Section<'a>>,
    expect: Option<Section<'a>>,
}

/// The sections that [`Document::parse`] takes out of the top.
const SECTIONS: [&str; 7] = ["simulation", "start", "controller", "motion", "obstacle", "check", "expect"];

impl<'a> Document<'a> {
    pub(super) fn parse(text: &'a str) -> Result<Self, Vec<Diagnostic>> {
        Self::take_apart(text).map_err(|error| vec![error])
    }

    fn take_apart(text: &'a str) -> Result<Self, Diagnostic> {
        let mut document = Section::document(text)?;
        Ok(Self {
            simulation: document.take_table("simulation")?,
            start: document.take_table("start")?,
            controller: document.take_table("controller")?,
            motions: document.take_tables("motion")?,
            obstacles: document.take_tables("obstacle")?,
            checks: document.take_tables("check")?,
            expect: document.take_table("expect")?,
            top: document.read().map_err(name_sections)?,
        })
    }

    /// The robot's path, relative to the scenario's folder.
    pub(super) fn robot_path(&self, scenario: &Path) -> PathBuf {
        let folder = scenario.parent().unwrap_or(Path::new(""));
        folder.join(self.top.robot.get_ref())
    }

    /// Points from the scenario at a robot that was refused.
    pub(super) fn robot_refused(&self) -> Diagnostic {
        let message = format!("robot \"{}\" cannot be used", self.top.robot.get_ref());
        Diagnostic::error("scenario::robot", message)
            .with_help(
                "`robot` is a folder with robot.toml, a robot file or a .urdf, relative to the scenario file",
            )
            .at(self.top.robot.span())
    }

    pub(super) fn check(
        self,
        path: &Path,
        description: RobotDescription,
        overrides: Overrides,
    ) -> Result<Scenario, Vec<Diagnostic>> {
        let mut found = Findings::default();
        found.keep(check_top(&self.top));
        let start = keep_all(&mut found, read_start(self.start, &description));
        let start = start.unwrap_or_else(|| vec![0.0; description.robot.dof()]);
        let mut warnings = start_warnings(&start, &description);
        let mut start = start;
        move_inside_limits(&mut start, &description);
        let trajectory =
            keep_all(&mut found, Trajectory::parse(self.motions, &description.robot, &start, &mut warnings));
        let motions_s = trajectory.as_ref().map_or(0.0, Trajectory::duration_s);
        let simulation = found.keep(read_simulation(self.simulation, motions_s));
        let controller = found.keep(read_controller(self.controller));
        let obstacles = keep_all(&mut found, obstacle::read(self.obstacles));
        let checks: Vec<_> = self
            .checks
            .into_iter()
            .filter_map(|section| found.keep(monitor::Check::parse(section, &description)))
            .collect();
        let expect = found.keep(read_expect(self.expect));
        match (!found.has_error(), trajectory, simulation, controller, obstacles, expect) {
            (true, Some(trajectory), Some(simulation), Some(controller), Some(obstacles), Some(expect)) => {
                Ok(Scenario {
                    path: path.to_owned(),
                    name: self.top.name.into_inner(),
                    seed: overrides.seed.unwrap_or(self.top.seed),
                    robot_as_written: self.top.robot.into_inner(),
                    description,
                    simulation,
                    start,
                    controller,
                    trajectory,
                    obstacles,
                    checks,
                    expect,
                    warnings,
                })
            }
            _ => Err(found.into_vec()),
        }
    }
}

/// The value of `result`; its faults are kept in `findings`.
fn keep_all<T>(findings: &mut Findings, result: Result<T, Vec<Diagnostic>>) -> Option<T> {
    result.map_err(|errors| findings.extend(errors)).ok()
}

/// An unknown key at the top may be a misspelt section.
fn name_sections(error: Diagnostic) -> Diagnostic {
    let help = error.help.clone().unwrap_or_default();
    let sections = SECTIONS.map(|section| format!("[{section}]")).join(", ");
    error.with_help(format!("{help}; sections: {sections}").trim_start_matches("; ").to_owned())
}

fn check_top(top: &Top) -> Result<(), Diagnostic> {
    let version = *top.schema_version.get_ref();
    if version != SCHEMA_VERSION {
        let message = format!("schema_version = {version} is not known");
        return Err(Diagnostic::error("scenario::version", message)
            .with_help(format!("this program reads version {SCHEMA_VERSION}"))
            .at(top.schema_version.span()));
    }
    if top.name.get_ref().trim().is_empty() {
        return Err(Diagnostic::error("scenario::name", "the name is empty")
            .with_help("results go to a folder of this name")
            .at(top.name.span()));
    }
    Ok(())
}

fn read_start(
    section: Option<Section<'_>>,
    description: &RobotDescription,
) -> Result<Vec<f64>, Vec<Diagnostic>> {
    let robot = &description.robot;
    let written: Start = section.map_or(Ok(Start::default()), Section::read).map_err(|error| vec![error])?;
    let values = JointValues {
        deg: written.joints_deg,
        rad: written.joints_rad,
        m: written.joints_m,
        mm: written.joints_mm,
    }
    .resolve(robot)?;
    let mut q = vec![0.0; robot.dof()];
    let mut errors = Vec::new();
    for value in values {
        if let Some(message) = value.beyond_limits(robot, "start") {
            errors.push(Diagnostic::error("scenario::start_limit", message).at(value.span));
        }
        q[robot.coordinate(value.joint).expect("resolved joints move")] = value.value;
    }
    if errors.is_empty() { Ok(q) } else { Err(errors) }
}

/// A joint that is not named starts at 0, or at its limit nearest to 0, which is said.
fn start_warnings(start: &[f64], description: &RobotDescription) -> Vec<Diagnostic> {
    let robot = &description.robot;
    let mut warnings = Vec::new();
    for (&joint, &q) in robot.movable_joints().iter().zip(start) {
        let joint = robot.joint(joint);
        let Some((lower, upper)) = joint.position_range().filter(|_| joint.mimic.is_none()) else { continue };
        if !(lower..=upper).contains(&q) {
            let message = format!(
                "joint \"{}\" has no start and 0 is outside [{lower}, {upper}]: it starts at {} {}",
                joint.name,
                q.clamp(lower, upper),
                joint.kind.unit()
            );
            warnings.push(
                Diagnostic::warning("scenario::start_default", message).with_help("name it under [start]"),
            );
        }
    }
    warnings
}

fn move_inside_limits(start: &mut [f64], description: &RobotDescription) {
    let robot = &description.robot;
    for (&joint, q) in robot.movable_joints().iter().zip(start.iter_mut()) {
        if let Some((lower, upper)) = robot.joint(joint).position_range() {
            *q = q.clamp(lower, upper);
        }
    }
    robot.apply_mimic(start);
}

fn read_simulation(section: Option<Section<'_>>, motions_s: f64) -> Result<SimulationSettings, Diagnostic> {
    let written = match section {
        Some(section) => section.read()?,
        None => Simulation { step_s: None, duration_s: None, gravity_m_s2: None },
    };
    let step_s = written.step_s.as_ref().map_or(0.001, |step| step.get_ref().get());
    let duration_s = written.duration_s.as_ref().map_or(motions_s, |duration| duration.get_ref().get());
    let at_step = |error: Diagnostic| match &written.step_s {
        Some(step) => error.at(step.span()),
        None => error,
    };
    if step_s > LONGEST_STEP_S {
        let message = format!("step_s = {step_s} is outside (0, {LONGEST_STEP_S}]");
        return Err(at_step(
            Diagnostic::error("scenario::step", message).with_help("0.001 suits every robot in robots/"),
        ));
    }
    if duration_s <= 0.0 {
        return Err(Diagnostic::error("scenario::duration", "the run has no duration")
            .with_help("give `duration_s` under [simulation], or a [[motion]]"));
    }
    if step_s > duration_s {
        let message = format!("step_s = {step_s} is longer than the run ({duration_s} s)");
        return Err(at_step(Diagnostic::error("scenario::step", message)));
    }
    let steps = (duration_s / step_s).round();
    if steps > MOST_STEPS {
        let message = format!("{duration_s} s in steps of {step_s} s are {steps:e} steps");
        return Err(at_step(
            Diagnostic::error("scenario::steps", message)
                .with_help(format!("at most {MOST_STEPS:e} steps are run at once")),
        ));
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 < steps <= 1e8")]
    let steps = steps as u64;
    let gravity = written.gravity_m_s2.map_or([0.0, 0.0, -9.81], |gravity| gravity.map(Finite::get));
    Ok(SimulationSettings { step_s, steps, gravity_in_world: Vector3::from(gravity) })
}

fn read_controller(section: Option<Section<'_>>) -> Result<ControllerSettings, Diagnostic> {
    let Some(mut section) = section else {
        return Err(Diagnostic::error("scenario::no_controller", "the scenario has no [controller]")
            .with_help(format!(
                "add one with kind = {}",
                controller_names().collect::<Vec<_>>().join(" | ")
            )));
    };
    let known: Vec<&str> = controller_names().collect();
    let kind = (*section.select("kind", "controller", &known, |name| name)?).to_owned();
    let written: Controller = section.read()?;
    let gains = Gains {
        stiffness: written.stiffness.map_or(0.0, NonNegative::get),
        damping: written.damping.map_or(0.0, NonNegative::get),
    };
    Ok(ControllerSettings { kind, gains })
}

fn read_expect(section: Option<Section<'_>>) -> Result<Expectation, Diagnostic> {
    let Some(mut section) = section else { return Ok(Expectation::Pass) };
    let span = section.span();
    let verdict = *section.select("verdict", "expected verdict", &["pass", "fail"], |name| name)?;
    let Expect { checks } = section.read()?;
    for check in &checks {
        if !monitor::kinds().any(|kind| kind == check.get_ref()) {
            let message = format!("unknown kind of check \"{}\"", check.get_ref());
            return Err(Diagnostic::error("scenario::unknown_kind", message)
                .with_help(congruent_description::known_names(check.get_ref(), "kinds", monitor::kinds()))
                .at(check.span()));
        }
    }
    let checks: Vec<String> = checks.into_iter().map(Spanned::into_inner).collect();
    match (verdict, checks.is_empty()) {
        ("fail", _) => Ok(Expectation::Fail { checks }),
        (_, true) => Ok(Expectation::Pass),
        (_, false) => Err(Diagnostic::error("scenario::expect", "`checks` names the checks that must fail")
            .with_help("it goes with verdict = \"fail\"")
            .at(span)),
    }
}
