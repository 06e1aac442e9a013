//! From a robot and a log to its parameters.

use std::path::Path;

use congruent_description::{LinkIndex, RobotDescription, RobotQ};
use congruent_dynamics::BodyTree;
use congruent_identification::{
    EffortKind, FreeGroup, FreeUnknowns, IdentifiedParameters, Instants, PayloadPlace, RecognisedEffort,
    RecordedEquations, RecordingSurvey, identify, recognise,
    report::{IdentificationParts, IdentificationReport, edited_text, identification_report},
};
use congruent_input::{Capability, Diagnostic, Findings, display::number, known_names};
use congruent_kinematics::{Pose, UrdfTree};

use super::{recorded_efforts::RecordedEfforts, request::IdentifyRequest};
use crate::{codes, draft::joints_draft};

/// Half of the window in which efforts at rest are averaged, s. Kind: choice; rows at 50 Hz fill it.
const STILL_HALF_WINDOW_S: f64 = 0.1;

/// What helps where a log has too little.
const LONGER: &str = "record longer and more often, 50 Hz at least, or state a longer window: --window-ms";

/// What a log says of the parameters of a robot.
#[derive(Debug, Clone)]
pub struct IdentifiedLog {
    /// The report.
    pub report: IdentificationReport,
    /// The URDF or MJCF with the identified parameters; `None` if nothing in it changes, or they are not better.
    pub edited: Option<String>,
    /// What was found in the log and taken, a line each.
    pub taken: Vec<String>,
}

/// The parameters of a robot that a log of its joint positions and efforts identifies.
///
/// # Errors
/// The log cannot be read or has no such efforts, masses are missing, or what is asked for cannot be identified.
pub fn identify_log(
    description: &RobotDescription,
    log: &Path,
    request: &IdentifyRequest,
) -> Result<IdentifiedLog, Findings> {
    description.check_capability(Capability::Physics)?;
    let (free, payload_frame) = free_parameters(description, request)?;
    let draft = joints_draft(description, log, &request.log)?;
    let mut tree = BodyTree::new(&description.robot);
    if let Some(gravity_m_s2) = request.gravity_m_s2 {
        tree = tree.with_gravity(gravity_m_s2);
    }
    let given = given_constants(description, &tree, request)?;
    if !request.torque_constants.is_empty() && request.effort.is_some_and(|kind| kind != EffortKind::Current)
    {
        let message = "a torque constant is given, and the efforts are stated to be torques".to_owned();
        let error = Diagnostic::error(codes::identify::FREE, message);
        return Err(error.with_help("torque constants are of currents: --effort current, or neither").into());
    }
    let efforts = RecordedEfforts::open(draft.scenario, description)?;
    let (survey, equations) = read(&efforts, &tree, request, log)?;
    let (equations, recognised, kind) = as_torques(equations, request, &given)?;
    let identified = identify(&equations, &free)
        .ok_or_else(|| no_motion(log, "no joint has an effort while it moves", LONGER))?;
    let report = identification_report(&IdentificationParts {
        description,
        log: &log.display().to_string(),
        recognised: &recognised,
        kind,
        is_declared: request.effort.is_some(),
        given_constants: &given,
        smoothing: survey.smoothing,
        is_still: request.is_still,
        instants: equations.instants,
        held: efforts.held(),
        payload_frame: &payload_frame,
        identified: &identified,
    });
    let edited = edited(description, &identified);
    Ok(IdentifiedLog { report, edited, taken: draft.taken })
}

/// How the joints of a log move, and its equations.
fn read(
    efforts: &RecordedEfforts,
    tree: &BodyTree,
    request: &IdentifyRequest,
    log: &Path,
) -> Result<(RecordingSurvey, RecordedEquations), Findings> {
    if !efforts.has_efforts {
        return Err(no_efforts());
    }
    // At rest, whatever averages noise is as good.
    let half_window_s = request.half_window_s.or(request.is_still.then_some(STILL_HALF_WINDOW_S));
    let survey = efforts.survey(half_window_s)?;
    let survey = survey.ok_or_else(|| {
        no_motion(log, "too few rows lie within a window for velocities and accelerations", LONGER)
    })?;
    let instants = if request.is_still {
        Instants::Still(survey.still_speeds())
    } else {
        Instants::Moving(survey.moving_speeds())
    };
    let equations = efforts.equations(tree, &survey, instants)?;
    if equations.instants == 0 {
        return Err(if request.is_still {
            no_motion(
                log,
                "the robot is never at rest for a window",
                "leave out --still: in motion, all parameters show",
            )
        } else {
            no_motion(
                log,
                "no joint moves faster than the noise of its position",
                "efforts at rest show masses: --still",
            )
        });
    }
    Ok((survey, equations))
}

fn no_motion(log: &Path, why: &str, help: &str) -> Findings {
    let error = Diagnostic::error(codes::identify::MOTION, format!("{}: {why}", log.display()));
    error.with_help(help.to_owned()).into()
}

fn no_efforts() -> Findings {
    let message = "the log has no efforts of this robot, or they do not change".to_owned();
    Diagnostic::error(codes::identify::EFFORT, message)
        .with_help("`congruent describe LOG --robot ROBOT` shows what it has of each joint")
        .into()
}

fn edited(description: &RobotDescription, identified: &IdentifiedParameters) -> Option<String> {
    if identified.is_better { edited_text(description, identified) } else { None }
}

/// The equations with efforts that are torques, what the efforts look like, and what they were taken to be.
fn as_torques(
    equations: RecordedEquations,
    request: &IdentifyRequest,
    given: &[Option<f64>],
) -> Result<(RecordedEquations, RecognisedEffort, EffortKind), Findings> {
    let recognised = recognise(&equations);
    // At rest there is no motion by which kinds would differ.
    let by_itself = if request.is_still { EffortKind::Torque } else { recognised.kind };
    let kind = match request.effort {
        _ if recognised.kind == EffortKind::None => EffortKind::None,
        Some(kind) => kind,
        None if given.iter().any(Option::is_some) => EffortKind::Current,
        None => by_itself,
    };
    match kind {
        EffortKind::Torque => Ok((equations, recognised, kind)),
        EffortKind::TorqueWithoutGravity => Ok((equations.with_gravity_added(), recognised, kind)),
        EffortKind::Current => {
            let is_of_links = request.free.contains(&FreeGroup::Links) && given.iter().all(Option::is_none);
            if is_of_links {
                let message = "masses of links and torque constants show their ratio alone".to_owned();
                let error = Diagnostic::error(codes::identify::FREE, message);
                return Err(error
                    .with_help("give the torque constant of a joint: --torque-constant JOINT=N_M_PER_A")
                    .into());
            }
            // A joint without one has no torque: its rows are left out.
            let fitted = |(fitted, given): (&Option<(f64, f64)>, &Option<f64>)| {
                given.map(|given| (given, 0.0)).or(*fitted).unwrap_or((f64::NAN, 0.0))
            };
            let factors: Vec<(f64, f64)> = recognised.factors.iter().zip(given).map(fitted).collect();
            let errors: Vec<f64> = factors.iter().map(|(factor, error)| (error / factor).abs()).collect();
            let factors: Vec<f64> = factors.iter().map(|(factor, _)| *factor).collect();
            Ok((equations.with_factors(&factors, &errors), recognised, kind))
        }
        EffortKind::None => Err(no_efforts()),
        EffortKind::Unknown => Err(unknown(&recognised)),
    }
}

fn unknown(recognised: &RecognisedEffort) -> Findings {
    let [torque, without_gravity, current] = recognised.left.map(|left| number(100.0 * left));
    let message = format!(
        "the description does not explain the efforts: of their variance, {torque} % is left if they are torques, {without_gravity} % if torques \
         without gravity, {current} % if currents"
    );
    Diagnostic::error(codes::identify::EFFORT, message)
        .with_help(
            "is this log of this robot? Of an arm on a wall state --gravity, of positions in degrees --degrees; a longer window for coarse \
             encoders is --window-ms. --effort takes the efforts as what you say",
        )
        .into()
}

pub(super) fn free_parameters(
    description: &RobotDescription,
    request: &IdentifyRequest,
) -> Result<(FreeUnknowns, String), Findings> {
    let has = |group| request.free.contains(&group);
    if request.payload_at.is_some() && !has(FreeGroup::Payload) {
        let message = "a link for the payload is named, and no payload is estimated".to_owned();
        return Err(Diagnostic::error(codes::identify::FREE, message)
            .with_help("--free friction,payload")
            .into());
    }
    let (payload, frame) = payload_place(description, request)?;
    if has(FreeGroup::Payload) && payload.is_none() {
        let message = format!("no joint moves {frame}, so that no effort shows what hangs there");
        let error = Diagnostic::error(codes::identify::FREE, message);
        return Err(error.with_help("name a link that moves: --payload-at LINK").into());
    }
    if has(FreeGroup::Payload) && has(FreeGroup::Links) {
        let message =
            "a payload and the link that carries it show their sum alone: --free payload or links".to_owned();
        return Err(Diagnostic::error(codes::identify::FREE, message).into());
    }
    let is_estimated = |group: &FreeGroup| {
        // Friction at rest has either sign, and nothing accelerates.
        !request.is_still || !matches!(group, FreeGroup::Friction | FreeGroup::Armature)
    };
    let groups = request.free.iter().copied().filter(is_estimated).collect();
    let free = FreeUnknowns { groups, payload: payload.filter(|_| has(FreeGroup::Payload)) };
    Ok((free, frame))
}

/// Where the payload hangs, and the name of its frame.
fn payload_place(
    description: &RobotDescription,
    request: &IdentifyRequest,
) -> Result<(Option<PayloadPlace>, String), Findings> {
    let robot = &description.robot;
    let (link, link_from_payload, frame) = match &request.payload_at {
        None => (description.tip, description.tip_from_tcp, "TCP".to_owned()),
        Some(name) => {
            let link = robot.find_link(name).ok_or_else(|| {
                let error = Diagnostic::error(codes::identify::FREE, format!("there is no link \"{name}\""));
                error.with_help(known_names(
                    name,
                    "links",
                    robot.links().iter().map(|link| link.name.as_str()),
                ))
            })?;
            (link, None, name.clone())
        }
    };
    let Some((joint, body)) = carrier(description, link) else { return Ok((None, frame)) };
    let tree = UrdfTree::new(robot);
    let zero = RobotQ::from(vec![0.0; robot.dof()]);
    let pose = |link: LinkIndex| {
        tree.root_from_link(&zero, link)
            .map_err(|error| Findings::from(Diagnostic::error(codes::identify::FREE, error.to_string())))
    };
    let body_from_link = pose(body)?.inverse() * pose(link)?;
    let link_from_payload = body_from_link * link_from_payload.map_or_else(Pose::identity, Pose::from);
    Ok((Some(PayloadPlace { joint, link_from_payload }), frame))
}

/// The moving joint that moves a link, and the link that this joint carries.
fn carrier(description: &RobotDescription, link: LinkIndex) -> Option<(usize, LinkIndex)> {
    let robot = &description.robot;
    let body = robot.body(link);
    let joint = robot.parent_joint(body)?;
    Some((robot.coordinate(joint)?, body))
}

/// Torque for a unit of effort of each driven joint, as the caller gives it.
fn given_constants(
    description: &RobotDescription,
    tree: &BodyTree,
    request: &IdentifyRequest,
) -> Result<Vec<Option<f64>>, Findings> {
    let names: Vec<&str> = description.robot.movable_joint_names().collect();
    let driven: Vec<&str> = tree.driven_joints().iter().map(|&joint| names[joint]).collect();
    if let Some(unknown) = request.torque_constants.keys().find(|name| !driven.contains(&name.as_str())) {
        let error =
            Diagnostic::error(codes::identify::FREE, format!("there is no driven joint \"{unknown}\""));
        return Err(error.with_help(known_names(unknown, "joints", driven)).into());
    }
    Ok(driven.iter().map(|name| request.torque_constants.get(*name).copied()).collect())
}
