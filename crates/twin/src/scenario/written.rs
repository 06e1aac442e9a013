//! The top of a scenario file as written, and its way to a checked [`Scenario`].

use std::path::{Path, PathBuf};

use congruent_description::{Diagnostic, Diagnostics, RobotDescription, known_names, toml_text};
use congruent_kinematics::move_inside_limits;
use congruent_simulation::{Gains, controller_names};
use serde::Deserialize;
use toml::Spanned;

use super::{
    ControllerSettings, Overrides, Scenario,
    joint_values::{JointValues, WrittenJoints},
    number::NonNegative,
    obstacle,
    section::Section,
    simulation, zone,
};
use crate::{monitor, motion::Trajectory, verdict::Expectation};

/// The one version of the format that exists.
const SCHEMA_VERSION: u32 = 1;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Top {
    schema_version: Spanned<u32>,
    name: Spanned<String>,
    robot: Spanned<String>,
    seed: Option<Spanned<u64>>,
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
    zones: Vec<Section<'a>>,
    checks: Vec<Section<'a>>,
    expect: Option<Section<'a>>,
    /// What is wrong so far; the sections are checked all the same.
    findings: Diagnostics,
}

/// The sections that [`Document::parse`] takes out of the top.
const SECTIONS: [&str; 8] =
    ["simulation", "start", "controller", "motion", "obstacle", "zone", "check", "expect"];

impl<'a> Document<'a> {
    pub(super) fn parse(text: &'a str) -> Result<Self, Vec<Diagnostic>> {
        let mut document = Section::document(text)?;
        let simulation = document.take_table("simulation")?;
        let start = document.take_table("start")?;
        let controller = document.take_table("controller")?;
        let motions = document.take_tables("motion")?;
        let obstacles = document.take_tables("obstacle")?;
        let zones = document.take_tables("zone")?;
        let checks = document.take_tables("check")?;
        let expect = document.take_table("expect")?;
        let mut findings = Diagnostics::default();
        let top = document.read_into(&mut findings);
        let mut findings = findings.map(name_sections);
        let Some(top) = top else { return Err(findings.into_vec()) };
        findings.keep(check_top(&top));
        Ok(Self { top, simulation, start, controller, motions, obstacles, zones, checks, expect, findings })
    }

    /// The robot's path, relative to the scenario's folder.
    pub(super) fn robot_path(&self, scenario: &Path) -> PathBuf {
        let folder = scenario.parent().unwrap_or(Path::new(""));
        folder.join(self.top.robot.get_ref())
    }

    /// What is wrong with a scenario whose robot was refused.
    pub(super) fn robot_refused(mut self) -> Vec<Diagnostic> {
        let message = format!("robot \"{}\" cannot be used", self.top.robot.get_ref());
        let refused = Diagnostic::error("scenario::robot", message)
            .with_help(
                "`robot` is a folder with robot.toml, a robot file or a .urdf, relative to the scenario file",
            )
            .at(self.top.robot.span());
        self.findings.push(refused);
        self.findings.into_vec()
    }

    pub(super) fn check(
        self,
        path: &Path,
        description: RobotDescription,
        overrides: Overrides,
    ) -> Result<Scenario, Vec<Diagnostic>> {
        let mut found = self.findings;
        let seed = found.keep(read_seed(overrides, self.top.seed.as_ref()));
        let start = keep_all(&mut found, read_start(self.start, &description));
        let start = start.unwrap_or_else(|| vec![0.0; description.robot.dof()]);
        let mut warnings = start_warnings(&start, &description);
        let mut start = start;
        move_inside_limits(&mut start, &description.robot);
        let trajectory =
            keep_all(&mut found, Trajectory::parse(self.motions, &description, &start, &mut warnings));
        let motions_s = trajectory.as_ref().map_or(0.0, Trajectory::duration_s);
        let simulation = keep_all(&mut found, simulation::read(self.simulation, motions_s, &mut warnings));
        let controller = keep_all(&mut found, read_controller(self.controller));
        let robot = &description.robot;
        let obstacles = keep_all(&mut found, obstacle::read(self.obstacles, &obstacle::OBSTACLE, robot));
        let first_zone = self.zones.first().map(Section::span);
        let zones = keep_all(&mut found, zone::read(self.zones, robot));
        let spans: Vec<_> = self.checks.iter().map(Section::span).collect();
        let checks: Vec<_> = self
            .checks
            .into_iter()
            .filter_map(|section| keep_all(&mut found, monitor::Check::parse(section, &description)))
            .collect();
        let all_checks = (checks.len() == spans.len()).then_some(&checks[..]);
        if let Some(checks) = all_checks {
            let placed: Vec<_> = checks.iter().zip(spans).collect();
            found.keep(zone::paired_with_checks(first_zone, &placed));
        }
        let expect = keep_all(&mut found, read_expect(self.expect, all_checks));
        let (Some(seed), Some(trajectory), Some(simulation), Some(controller)) =
            (seed, trajectory, simulation, controller)
        else {
            return Err(found.into_vec());
        };
        let (Some(obstacles), Some(zones), Some(expect)) = (obstacles, zones, expect) else {
            return Err(found.into_vec());
        };
        if found.has_error() {
            return Err(found.into_vec());
        }
        let (path, name) = (path.to_owned(), self.top.name.into_inner());
        Ok(Scenario {
            path,
            name,
            seed,
            description,
            simulation,
            start,
            controller,
            trajectory,
            obstacles,
            zones,
            checks,
            expect,
            warnings,
        })
    }
}

/// The value of `result`; its faults are kept in `findings`.
fn keep_all<T>(findings: &mut Diagnostics, result: Result<T, Vec<Diagnostic>>) -> Option<T> {
    result.map_err(|errors| findings.extend(errors)).ok()
}

/// An unknown key at the top may be a misspelt section.
fn name_sections(error: Diagnostic) -> Diagnostic {
    if error.code != toml_text::UNKNOWN_KEY_CODE {
        return error;
    }
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
    let written: Start = section.map_or(Ok(Start::default()), Section::read)?;
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

fn read_seed(overrides: Overrides, written: Option<&Spanned<u64>>) -> Result<u64, Diagnostic> {
    let seed = overrides.seed.or(written.map(|seed| *seed.get_ref())).unwrap_or(0);
    if i64::try_from(seed).is_ok() {
        return Ok(seed);
    }
    let message = format!("seed = {seed} is above {}, the largest integer of TOML", i64::MAX);
    Err(Diagnostic::error("scenario::seed", message).at(written.map_or(0..0, Spanned::span)))
}

fn read_controller(section: Option<Section<'_>>) -> Result<ControllerSettings, Vec<Diagnostic>> {
    let Some(mut section) = section else {
        return Err(Diagnostic::error("scenario::no_controller", "the scenario has no [controller]")
            .with_help(format!("add one with kind = {}", controller_names().collect::<Vec<_>>().join(" | ")))
            .into());
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

/// `checks` are all of the scenario, where all could be read.
fn read_expect(
    section: Option<Section<'_>>,
    checks: Option<&[monitor::Check]>,
) -> Result<Expectation, Vec<Diagnostic>> {
    let Some(mut section) = section else { return Ok(Expectation::Pass) };
    let span = section.span();
    let verdict = *section.select("verdict", "expected verdict", &["pass", "fail"], |name| name)?;
    let Expect { checks: named } = section.read()?;
    for name in &named {
        expects_a_check(name.get_ref(), checks).map_err(|error| error.at(name.span()))?;
    }
    match (verdict, named.is_empty()) {
        ("fail", _) => Ok(Expectation::Fail { checks: named.into_iter().map(Spanned::into_inner).collect() }),
        (_, true) => Ok(Expectation::Pass),
        (_, false) => Err(Diagnostic::error("scenario::expect", "`checks` names the checks that must fail")
            .with_help("it goes with verdict = \"fail\"")
            .at(span)
            .into()),
    }
}

/// A check that is expected to fail must be one of the scenario's.
fn expects_a_check(name: &str, checks: Option<&[monitor::Check]>) -> Result<(), Diagnostic> {
    if !monitor::kinds().any(|kind| kind == name) {
        return Err(Diagnostic::error("scenario::unknown_kind", format!("unknown kind of check \"{name}\""))
            .with_help(known_names(name, "kinds", monitor::kinds())));
    }
    if checks.is_some_and(|checks| checks.iter().all(|check| check.kind != name)) {
        let message = format!("check \"{name}\" is expected to fail, but the scenario has none");
        return Err(Diagnostic::error("scenario::expect", message)
            .with_help(format!("add a [[check]] with kind = \"{name}\"")));
    }
    Ok(())
}
