//! A motion that shows the parameters of a robot: `congruent plan`.

use std::{fmt::Write, path::Path};

use congruent_description::{RobotDescription, RobotQ};
use congruent_dynamics::BodyTree;
use congruent_identification::{
    FreeGroup,
    excitation::{Excitation, ExcitationError, ExcitationLimits, ExcitationOptions, excite},
    report::term_unit,
};
use congruent_input::{Capability, Diagnostic, Findings, display::length, number::number as written};
use congruent_kinematics::{Uniform, range};
use congruent_scenario::{
    Check, ClearanceCheck, ControllerKind, ControllerSettings, JointNumbers, LimitsCheck, MotionSettings,
    ObstacleSettings, OnViolation, OutputSettings, PlaybackMotion, Scenario, StartSettings, TrajectoryFormat,
};
use congruent_twin::RunSetup;

use super::{
    identified_log::free_parameters,
    link_distances::{LinkDistances, NearestLinks},
    plan_report::{PlanReport, PlannedTerm},
    request::IdentifyRequest,
};
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
    /// Noise of the efforts, as part of the effort limit of each joint.
    pub effort_noise: f64,
    /// Seed of the motions that are tried.
    pub seed: u64,
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
/// Parts of the ranges, of the accelerations and of the efforts that a motion does not use, or uses. No unit; kind: choice.
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
    description.check_capability(Capability::Clearance)?;
    if let Some(setup) = surroundings.filter(|setup| !is_same_robot(&setup.description, description)) {
        let message =
            format!("the scenario is of robot \"{}\", which has other joints", setup.description.name);
        let error = Diagnostic::error(codes::identify::PLAN, message);
        return Err(error.with_help("give a scenario of this robot, for its start and its obstacles").into());
    }
    let distances = LinkDistances::new(description, surroundings, request.clearance_m, request.seed);
    let mut distances = distances.map_err(|error| no_motion(&error.to_string()))?;
    let limits = limits(description, request);
    let center = center(description, surroundings, request, &mut distances)?;
    let mut is_clear = |q: &RobotQ| is_far(distances.nearest(q).as_ref(), request);
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
        excite(&tree, &limits, &options, &mut is_clear).map_err(|error| stopped(&error, description))?;
    let (table, nearest_m) = table(description, &found, &mut distances);
    let scenario = scenario(description, surroundings, &found, request);
    Ok(PlannedMotion {
        report: report(
            description,
            &found,
            NearestInMotion { nearest_m, always_near: distances.always_near() },
            request,
        ),
        table,
        scenario,
    })
}

fn is_far(nearest: Option<&NearestLinks>, request: &PlanRequest) -> bool {
    nearest.is_none_or(|nearest| nearest.distance_m >= request.clearance_m)
}

fn is_same_robot(one: &RobotDescription, other: &RobotDescription) -> bool {
    one.robot.movable_joint_names().eq(other.robot.movable_joint_names())
}

/// Why there is no motion, with the name of the joint.
fn stopped(error: &ExcitationError, description: &RobotDescription) -> Findings {
    let robot = &description.robot;
    match error {
        ExcitationError::TooStrong { tried, joint } => {
            let joint = &robot.joint(robot.movable_joints()[*joint]).name;
            let message = format!("each of {tried} motions exceeds the effort limit of {joint}");
            let error = Diagnostic::error(codes::identify::PLAN, message);
            error
                .with_help("is the limit a placeholder? Correct it in the description, or lower --speed")
                .into()
        }
        _ => no_motion(&error.to_string()),
    }
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
    distances: &mut LinkDistances,
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
    let mut nearest_there = None;
    for q in std::iter::once(first).chain(others) {
        let nearest = distances.nearest(&q);
        if is_far(nearest.as_ref(), request) {
            return Ok(q);
        }
        nearest_there = nearest_there.or(nearest);
    }
    let there = nearest_there.map_or_else(String::new, |of| {
        format!(": {} and {} are {} apart at the first", of.names[0], of.names[1], length(of.distance_m))
    });
    Err(no_motion(&format!(
        "none of {CENTERS} configurations has its links far enough from each other{there}"
    )))
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
        let distance_m = distances.nearest(&q).map(|nearest| nearest.distance_m);
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
        passing: None,
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
        obstacle: surroundings.map(obstacles).unwrap_or_default(),
        check: vec![Check::Limits(LimitsCheck::default()), Check::Clearance(clearance)],
        output: OutputSettings { trajectory: Some(TrajectoryFormat::Mcap), ..OutputSettings::default() },
        ..Scenario::default()
    }
}

/// How near links come in a motion.
struct NearestInMotion {
    nearest_m: Option<f64>,
    always_near: Vec<String>,
}

/// The obstacles of a scenario, their meshes by whole paths.
fn obstacles(setup: &RunSetup) -> Vec<ObstacleSettings> {
    let folder = setup.path.as_deref().and_then(Path::parent).map(Path::to_owned).unwrap_or_default();
    let mut obstacles = setup.scenario.obstacle.clone();
    for mesh in obstacles.iter_mut().filter_map(|obstacle| obstacle.mesh.as_mut()) {
        let path = folder.join(&*mesh);
        *mesh = path.canonicalize().unwrap_or(path).display().to_string();
    }
    obstacles
}

fn report(
    description: &RobotDescription,
    found: &Excitation,
    nearest: NearestInMotion,
    request: &PlanRequest,
) -> PlanReport {
    let robot = &description.robot;
    let joints = found.motion.joints.iter().map(|&joint| robot.joint(robot.movable_joints()[joint]));
    let is_limited = |joint: &congruent_description::Joint| {
        joint.limit.as_ref().and_then(|limit| limit.velocity).is_some_and(|velocity| velocity > 0.0)
    };
    let without_velocity_limit = joints.filter(|joint| !is_limited(joint)).map(|joint| joint.name.clone());
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
        nearest_m: nearest.nearest_m,
        always_near: nearest.always_near,
        without_velocity_limit: without_velocity_limit.collect(),
        assumed_acceleration: ACCELERATION,
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
