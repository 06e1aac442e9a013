//! A motion that shows the parameters of a robot: `congruent plan`.

use std::{fmt::Write, path::Path};

use congruent_description::{RobotDescription, RobotQ};
use congruent_dynamics::BodyTree;
use congruent_identification::{
    FreeGroup, JointUnknown,
    excitation::{Excitation, ExcitationLimits, ExcitationOptions, excite},
    report::term_unit,
};
use congruent_input::{Capability, Diagnostic, Findings, number::number as written};
use congruent_kinematics::{Pose, Uniform, UrdfTree, range};
use congruent_proximity::{Clearance, PairChoice};
use congruent_scenario::{
    Check, ClearanceCheck, ControllerKind, ControllerSettings, JointNumbers, LimitsCheck, MotionSettings,
    OnViolation, OutputSettings, PlaybackMotion, Scenario, StartSettings, TrajectoryFormat,
};
use congruent_twin::RunSetup;
use nalgebra::Isometry3;
use schemars::JsonSchema;
use serde::Serialize;

use super::{identified_log::free_parameters, request::IdentifyRequest};
use crate::codes;

/// What a motion is for, and how it may be.
#[derive(Debug, Clone)]
pub struct PlanRequest {
    /// What it shall show.
    pub free: Vec<FreeGroup>,
    /// The link that carries the payload; the TCP if it is not named.
    pub payload_at: Option<String>,
    /// How long it takes, s.
    pub duration_s: f64,
    /// Part of the velocity limits that is used.
    pub speed: f64,
    /// Smallest distance of links from each other and from obstacles, m.
    pub clearance_m: f64,
    /// Noise of the efforts, as part of the largest effort of each joint.
    pub effort_noise: f64,
    /// Seed of the motions that are tried.
    pub seed: u64,
}

/// A term, and the standard error with which it will be known.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct PlannedTerm {
    /// The joint.
    pub joint: String,
    /// Which.
    pub term: JointUnknown,
    /// Its standard error.
    pub standard_error: f64,
    /// Its unit.
    pub unit: &'static str,
}

/// The answer of `congruent plan`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct PlanReport {
    /// Path of the description.
    pub file: String,
    /// Name of the robot.
    pub robot: String,
    /// How long the motion takes, s.
    pub duration_s: f64,
    /// Motions that were tried.
    pub tried: usize,
    /// Smallest distance of links from each other and from obstacles in the motion, m; null without pairs.
    pub nearest_m: Option<f64>,
    /// The noise of efforts that the standard errors are for, as part of the largest effort of each joint.
    pub effort_noise: f64,
    /// What it will show of the joints.
    pub terms: Vec<PlannedTerm>,
    /// Standard error of the mass of a payload, kg.
    pub payload_mass_error_kg: Option<f64>,
    /// Combinations of inertial parameters of which it shows more than is known.
    pub known_combinations: usize,
    /// Inertial parameters that are free.
    pub free_inertial_parameters: usize,
    /// The files that were written: positions over time, and a scenario that runs them.
    pub written: Vec<String>,
}

/// A motion with the texts of its files.
#[derive(Debug, Clone)]
pub struct PlannedMotion {
    /// The report, without the files.
    pub report: PlanReport,
    /// Positions over time.
    pub table: String,
    /// A scenario that runs them, with paths as they were given.
    pub scenario: Scenario,
}

/// Names of the two files.
pub const PLAN_FILES: [&str; 2] = ["identification.csv", "identification.toml"];
/// Rows of the table. Unit: Hz; kind: choice, 25 for each period of the fastest sine of a motion of 20 s and more of longer ones.
const ROWS_HZ: f64 = 50.0;
/// Parts of the ranges, of the accelerations and of the efforts that a motion leaves free or uses. No unit; kind: choice.
const FREE_RANGE: f64 = 0.05;
const USED_EFFORT: f64 = 0.8;
/// Accelerations that are assumed without a limit, rad/s^2 or m/s^2: as the certificates do.
const ACCELERATION: f64 = 10.0;
/// Noise of the effort of a joint without a limit, N m or N. Kind: choice.
const UNKNOWN_EFFORT: f64 = 10.0;
/// Configurations that are tried as the middle of the motion. Kind: choice.
const CENTERS: usize = 200;

/// The best motion for what is to be identified, within the limits of the robot and among the obstacles of a scenario.
///
/// # Errors
/// Masses or shapes are missing, or no motion stays within the limits.
pub fn plan_excitation(
    description: &RobotDescription,
    surroundings: Option<&RunSetup>,
    request: &PlanRequest,
) -> Result<PlannedMotion, Findings> {
    description.check_capability(Capability::Physics)?;
    let identify = IdentifyRequest {
        free: request.free.clone(),
        payload_at: request.payload_at.clone(),
        ..IdentifyRequest::default()
    };
    let (free, _) = free_parameters(description, &identify)?;
    let robot = &description.robot;
    let tree = BodyTree::new(robot);
    let mut distances = LinkDistances::new(description, surroundings)?;
    let limits = limits(description, request);
    let mut is_clear =
        |q: &RobotQ| distances.nearest_m(q).is_none_or(|nearest_m| nearest_m >= request.clearance_m);
    let center = center(description, surroundings, request, &mut is_clear)?;
    let noise = tree.driven_joints().iter().map(|&joint| {
        let largest = Some(limits.effort[joint] / USED_EFFORT).filter(|effort| effort.is_finite());
        request.effort_noise * largest.unwrap_or(UNKNOWN_EFFORT)
    });
    let options = ExcitationOptions {
        free,
        duration_s: request.duration_s,
        center,
        noise: noise.collect(),
        seed: request.seed,
    };
    let found =
        excite(&tree, &limits, &options, &mut is_clear).map_err(|error| no_motion(&error.to_string()))?;
    let (table, nearest_m) = table(description, &found, &mut distances);
    let scenario = scenario(description, surroundings, &found, request);
    Ok(PlannedMotion { report: report(description, &found, nearest_m, request), table, scenario })
}

fn no_motion(why: &str) -> Findings {
    Diagnostic::error(codes::identify::PLAN, why.to_owned())
        .with_help("lower --clearance or --speed, or give a start with room about it by --scenario")
        .into()
}

fn limits(description: &RobotDescription, request: &PlanRequest) -> ExcitationLimits {
    let robot = &description.robot;
    let joints = || robot.movable_joints().iter().map(|&joint| robot.joint(joint));
    let of = |value: fn(&congruent_description::JointLimit) -> f64| -> Vec<f64> {
        joints().map(|joint| joint.limit.as_ref().map_or(f64::INFINITY, value)).collect()
    };
    let positive = |values: Vec<f64>, part: f64| -> Vec<f64> {
        let used = |value: f64| if value > 0.0 { part * value } else { f64::INFINITY };
        values.into_iter().map(used).collect()
    };
    let ranges: Vec<(f64, f64)> = joints().map(range).collect();
    let margin = |(lower, upper): &(f64, f64)| FREE_RANGE * (upper - lower);
    let accelerations =
        description.accelerations.iter().map(|of| of.unwrap_or(ACCELERATION).min(ACCELERATION));
    ExcitationLimits {
        lower: ranges.iter().map(|range| range.0 + margin(range)).collect(),
        upper: ranges.iter().map(|range| range.1 - margin(range)).collect(),
        velocity: positive(of(|limit| limit.velocity.unwrap_or(f64::INFINITY)), request.speed),
        acceleration: accelerations.collect(),
        effort: positive(of(|limit| limit.effort.unwrap_or(f64::INFINITY)), USED_EFFORT),
    }
}

/// Where the motion begins: the start of the scenario, the middle of the ranges, or a configuration with room about it.
fn center(
    description: &RobotDescription,
    surroundings: Option<&RunSetup>,
    request: &PlanRequest,
    is_clear: &mut impl FnMut(&RobotQ) -> bool,
) -> Result<RobotQ, Findings> {
    let robot = &description.robot;
    let ranges: Vec<(f64, f64)> =
        robot.movable_joints().iter().map(|&joint| range(robot.joint(joint))).collect();
    let at = |part: &mut dyn FnMut() -> f64| -> RobotQ {
        let mut q: RobotQ = ranges.iter().map(|(lower, upper)| lower + part() * (upper - lower)).collect();
        robot.apply_mimic(&mut q);
        q
    };
    let mut random = Uniform::seeded(request.seed);
    let first = surroundings.map_or_else(|| at(&mut || 0.5), |setup| setup.start.clone());
    let others = std::iter::repeat_with(|| at(&mut || random.between(0.2, 0.8))).take(CENTERS);
    let mut tried = std::iter::once(first).chain(others);
    tried
        .find(|q| is_clear(q))
        .ok_or_else(|| no_motion("no configuration has its links far enough from each other"))
}

/// LinkDistances of the links at configurations.
struct LinkDistances {
    clearance: Clearance,
    tree: UrdfTree,
    poses: Vec<Pose>,
    root_from_links: Vec<Isometry3<f64>>,
}

impl LinkDistances {
    fn new(description: &RobotDescription, surroundings: Option<&RunSetup>) -> Result<Self, Findings> {
        description.check_capability(Capability::Clearance)?;
        let obstacles = surroundings.map_or(&[][..], |setup| &setup.obstacles);
        let clearance = Clearance::new(description, obstacles, PairChoice::Usual);
        let clearance = clearance.map_err(|error| no_motion(&error.to_string()))?;
        let links = description.robot.links().len();
        Ok(Self {
            clearance,
            tree: UrdfTree::new(&description.robot),
            poses: vec![Pose::identity(); links],
            root_from_links: vec![Isometry3::identity(); links],
        })
    }

    /// The smallest distance; `None` if no links can touch.
    fn nearest_m(&mut self, q: &RobotQ) -> Option<f64> {
        self.tree.root_from_links_into(q, &mut self.poses).ok()?;
        self.root_from_links.iter_mut().zip(&self.poses).for_each(|(link, pose)| *link = pose.to_isometry());
        self.clearance.move_links(&self.root_from_links);
        self.clearance.nearest().map(|nearest| nearest.distance_m)
    }
}

/// Positions over time, and the smallest distance.
fn table(
    description: &RobotDescription,
    found: &Excitation,
    distances: &mut LinkDistances,
) -> (String, Option<f64>) {
    let robot = &description.robot;
    let motion = &found.motion;
    let mut text = String::from("time_s");
    for &joint in &motion.joints {
        let joint = robot.joint(robot.movable_joints()[joint]);
        let unit = if joint.kind.is_angular() { "rad" } else { "m" };
        let _ = write!(text, ",{}_{unit}", joint.name);
    }
    text.push('\n');
    let (mut q, mut qd, mut qdd) = (motion.center.clone(), vec![0.0; robot.dof()], vec![0.0; robot.dof()]);
    let mut nearest_m: Option<f64> = None;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "durations are bounded")]
    let rows = (motion.duration_s * ROWS_HZ).round() as u32;
    for row in 0..=rows {
        let time_s = f64::from(row) / ROWS_HZ;
        motion.state_into(time_s.min(motion.duration_s), &mut q, &mut qd, &mut qdd);
        let _ = write!(text, "{}", written(time_s));
        for &joint in &motion.joints {
            let _ = write!(text, ",{:.6}", q[joint]);
        }
        text.push('\n');
        let distance_m = distances.nearest_m(&q);
        nearest_m = [nearest_m, distance_m].into_iter().flatten().min_by(f64::total_cmp);
    }
    (text, nearest_m)
}

fn scenario(
    description: &RobotDescription,
    surroundings: Option<&RunSetup>,
    found: &Excitation,
    request: &PlanRequest,
) -> Scenario {
    let robot = &description.robot;
    let mut start = StartSettings::default();
    for &joint in &found.motion.joints {
        let of = robot.joint(robot.movable_joints()[joint]);
        let values = if of.kind.is_angular() { &mut start.joints_rad } else { &mut start.joints_m };
        // As in the first row of the table.
        let value = format!("{:.6}", found.motion.center[joint]).parse().unwrap_or_default();
        values.insert(of.name.clone(), value);
    }
    let playback = PlaybackMotion { play_csv: PLAN_FILES[0].to_owned(), ..PlaybackMotion::default() };
    let clearance = ClearanceCheck {
        // The simulated arm lags a little.
        minimum_m: Some(request.clearance_m / 2.0),
        minimum_mm: None,
        pairs: Vec::new(),
        ignore: Vec::new(),
        on_violation: OnViolation::default(),
    };
    Scenario {
        name: "identification".to_owned(),
        robot: description.path.display().to_string(),
        start,
        // Critically damped, whatever the masses are.
        controller: ControllerSettings {
            kind: ControllerKind::ComputedTorque,
            stiffness: JointNumbers::All(400.0),
            damping: JointNumbers::All(40.0),
            ..ControllerSettings::default()
        },
        motion: vec![MotionSettings::Playback(playback)],
        obstacle: surroundings.map(|setup| setup.scenario.obstacle.clone()).unwrap_or_default(),
        check: vec![Check::Limits(LimitsCheck::default()), Check::Clearance(clearance)],
        output: OutputSettings { trajectory: Some(TrajectoryFormat::Mcap), ..OutputSettings::default() },
        ..Scenario::default()
    }
}

fn report(
    description: &RobotDescription,
    found: &Excitation,
    nearest_m: Option<f64>,
    request: &PlanRequest,
) -> PlanReport {
    let robot = &description.robot;
    let terms = found.terms.iter().map(|of| {
        let joint = robot.joint(robot.movable_joints()[of.joint]);
        PlannedTerm {
            joint: joint.name.clone(),
            term: of.term,
            standard_error: of.standard_error,
            unit: term_unit(of.term, joint.kind),
        }
    });
    PlanReport {
        file: description.path.display().to_string(),
        robot: description.name.clone(),
        duration_s: found.motion.duration_s,
        tried: found.tried,
        nearest_m,
        effort_noise: request.effort_noise,
        terms: terms.collect(),
        payload_mass_error_kg: found.payload_mass_error_kg,
        known_combinations: found.known_combinations[0],
        free_inertial_parameters: found.known_combinations[1],
        written: Vec::new(),
    }
}

/// The scenario for a folder that has the table already, as text.
///
/// # Errors
/// A file that it names is not there.
pub fn plan_text(scenario: &Scenario, folder: &Path, command: &str) -> Result<String, Findings> {
    let mut placed = scenario.clone();
    for motion in &mut placed.motion {
        if let MotionSettings::Playback(playback) = motion {
            playback.play_csv = folder.join(&playback.play_csv).display().to_string();
        }
    }
    let placed = crate::in_folder(&placed, folder)?;
    Ok(format!("# Written by `{command}`: a motion for `congruent identify`.\n{}", placed.motion_to_toml()))
}
