//! `congruent jacobian`: the velocity of a link by the velocities of the joints.

use congruent_configurations::JointState;
use congruent_description::{
    DrivenCoordinates, Followers, LinkIndex, ReportedChain, RobotDescription, RobotQ,
};
use congruent_input::{Diagnostic, Finding, known_names};
use congruent_kinematics::{Jacobian, KinematicsError, Pose, ReportedPose, UrdfTree};
use nalgebra::Matrix3xX;
use schemars::JsonSchema;
use serde::Serialize;

use crate::{codes, stream::Stream};

pub use congruent_kinematics::JacobianKind;

/// A Jacobian as programs read it: named blocks, since half the field stacks linear first and half
/// angular first. Columns are in the order of the report's joints.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct JacobianBlocks {
    /// Three rows: m/s for each rad/s or m/s.
    pub linear: [Vec<f64>; 3],
    /// Three rows: rad/s for each rad/s or m/s.
    pub angular: [Vec<f64>; 3],
}

impl JacobianBlocks {
    /// The columns of the driven joints: a follower moves the frame by its ratio, as a part of its master's motion.
    fn new(jacobian: &Jacobian, coordinates: &DrivenCoordinates) -> Self {
        let rows = |block: Matrix3xX<f64>| {
            [0, 1, 2].map(|row| coordinates.folded(&block.row(row).iter().copied().collect::<Vec<f64>>()))
        };
        Self { linear: rows(jacobian.linear()), angular: rows(jacobian.angular()) }
    }
}

/// The Jacobian at one configuration.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct JacobianResult {
    /// Linear and angular block of the Jacobian.
    #[serde(flatten)]
    pub jacobian: JacobianBlocks,
    /// Its time derivative at the given joint velocities, each entry per s; absent unless it was requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub derivative: Option<JacobianBlocks>,
}

/// The answer of `congruent jacobian`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "JacobianReport")]
pub struct JacobianReport<Results> {
    /// Name of the robot.
    pub robot: String,
    /// Base and tip, and who named them.
    pub chain: ReportedChain,
    /// The driven joints, in the order of columns: a joint that follows another by `<mimic>` is part of the column of that one.
    /// With `--free-followers` all moving joints, each as if it were driven.
    pub joints: Vec<String>,
    /// The frame that moves, and whose origin is the point of the linear part: a link, or `tcp` for the declared tool
    /// centre point.
    pub link: String,
    /// The place of the tool centre point, if the frame is that.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tcp: Option<TcpInLink>,
    /// Which axes and which point.
    pub kind: JacobianKind,
    /// One entry for each configuration, in input order.
    pub results: Results,
    /// Warnings about the input.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Finding>,
}

/// The place of the tool centre point.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct TcpInLink {
    /// The link that carries it.
    pub link: String,
    /// Its pose in that link.
    pub link_from_tcp: ReportedPose,
}

/// The frame whose Jacobian is computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JacobianFrame {
    /// The frame of a link.
    Link(LinkIndex),
    /// The declared tool centre point, in a link.
    Tcp(LinkIndex, Pose),
}

impl JacobianFrame {
    /// The frame with the name of a link, or of the declared tool centre point ([`Robot::tcp_name`](congruent_description::Robot::tcp_name)); the tip if
    /// no name is given.
    ///
    /// # Errors
    /// There is no such link, or no TCP is declared.
    pub fn named(description: &RobotDescription, name: Option<&str>) -> Result<Self, Diagnostic> {
        let robot = &description.robot;
        let Some(name) = name else { return Ok(Self::Link(description.tip)) };
        match (robot.find_link(name), description.tip_from_tcp) {
            (Some(link), _) => Ok(Self::Link(link)),
            (None, Some(tip_from_tcp)) if name == description.robot.tcp_name() => {
                Ok(Self::Tcp(description.tip, tip_from_tcp.into()))
            }
            (None, None) if name == description.robot.tcp_name() => {
                let message = format!(
                    "robot \"{}\" declares no tool centre point at the end of this chain",
                    robot.name()
                );
                Err(Diagnostic::error(codes::jacobian::NO_TCP, message)
                    .with_help("declare it under [tcp] in robot.toml, or name a link"))
            }
            (None, declared) => {
                let links = robot.links().iter().map(|link| link.name.as_str());
                let known: Vec<&str> = links.chain(declared.map(|_| description.robot.tcp_name())).collect();
                let message = format!("robot \"{}\" has no link \"{name}\"", robot.name());
                Err(Diagnostic::error(codes::jacobian::LINK, message)
                    .with_help(known_names(name, "links", known)))
            }
        }
    }

    /// The link that carries it, and its place there.
    fn in_link(self) -> (LinkIndex, Pose) {
        match self {
            Self::Link(link) => (link, Pose::identity()),
            Self::Tcp(link, link_from_tcp) => (link, link_from_tcp),
        }
    }
}

/// Jacobians that are computed while they are written.
pub type JacobianStream<'a> = Stream<'a, JacobianResult>;

/// Jacobians of one frame at each configuration, from the URDF chain, each computed on demand.
///
/// # Errors
/// The first configuration is of another length.
pub fn jacobians<'a>(
    description: &RobotDescription,
    frame: JacobianFrame,
    kind: JacobianKind,
    followers: Followers,
    configurations: impl Iterator<Item = RobotQ> + 'a,
) -> Result<JacobianReport<JacobianStream<'a>>, Diagnostic> {
    let tree = UrdfTree::new(&description.robot);
    let coordinates = DrivenCoordinates::new(&description.robot, followers);
    let driven = coordinates.clone();
    let (link, link_from_frame) = frame.in_link();
    let at = move |q: RobotQ| {
        let jacobian = tree.jacobian_of_frame(&q, link, &link_from_frame, kind)?;
        Ok(JacobianResult { jacobian: JacobianBlocks::new(&jacobian, &coordinates), derivative: None })
    };
    report(description, frame, kind, &driven, configurations.map(at))
}

/// Jacobians of one frame and their time derivatives, from the URDF chain, each computed on demand.
///
/// # Errors
/// The first positions or velocities are of another length.
pub fn jacobians_in_motion<'a>(
    description: &RobotDescription,
    frame: JacobianFrame,
    kind: JacobianKind,
    followers: Followers,
    states: impl Iterator<Item = JointState> + 'a,
) -> Result<JacobianReport<JacobianStream<'a>>, Diagnostic> {
    let tree = UrdfTree::new(&description.robot);
    let coordinates = DrivenCoordinates::new(&description.robot, followers);
    let driven = coordinates.clone();
    let (link, link_from_frame) = frame.in_link();
    let at = move |JointState { q, qd, .. }: JointState| {
        let jacobian = tree.jacobian_of_frame(&q, link, &link_from_frame, kind)?;
        let derivative = Some(JacobianBlocks::new(&jacobian.rate(&qd)?, &coordinates));
        Ok(JacobianResult { jacobian: JacobianBlocks::new(&jacobian, &coordinates), derivative })
    };
    report(description, frame, kind, &driven, states.map(at))
}

fn report<'a>(
    description: &RobotDescription,
    frame: JacobianFrame,
    kind: JacobianKind,
    coordinates: &DrivenCoordinates,
    results: impl Iterator<Item = Result<JacobianResult, KinematicsError>> + 'a,
) -> Result<JacobianReport<JacobianStream<'a>>, Diagnostic> {
    let refused =
        |error: KinematicsError| Diagnostic::error(codes::jacobian::CONFIGURATION, error.to_string());
    let robot = &description.robot;
    let name = |link| robot.link(link).name.clone();
    let (link, tcp) = match frame {
        JacobianFrame::Link(link) => (name(link), None),
        JacobianFrame::Tcp(link, pose) => (
            description.robot.tcp_name().to_owned(),
            Some(TcpInLink { link: name(link), link_from_tcp: (&pose).into() }),
        ),
    };
    Ok(JacobianReport {
        chain: description.reported_chain(),
        robot: description.name.clone(),
        joints: coordinates.joint_names(robot),
        link,
        tcp,
        kind,
        results: Stream::begin(results.map(move |result| result.map_err(refused)))?,
        warnings: description.warnings.iter().map(Finding::from).collect(),
    })
}
