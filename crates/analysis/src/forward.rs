//! `congruent fk`: poses of links by a chosen source.

use std::collections::BTreeMap;

use congruent_description::{Diagnostic, Finding, ReportedChain, RobotDescription, RobotQ};
use congruent_kinematics::{
    DhChain, KinematicsError, LinkPoses, LinkPosesError, Pose, ReportedPose, UrdfTree,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The tool centre point among links.
pub(crate) const TCP: &str = "tcp";

/// A source of link poses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Source {
    /// The URDF chain, by analysis.
    Urdf,
    /// The table of robot.toml: its frames, the tip and the TCP.
    Dh,
    /// Screws (product of exponentials).
    Poe,
    /// The physics engine.
    Simulation,
}

/// Poses at one configuration, by name, in order.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReportedLinkPoses {
    /// Links (or frames of the table) with their poses in the root link's frame.
    #[serde(serialize_with = "as_map")]
    #[schemars(with = "BTreeMap<String, ReportedPose>")]
    pub links: Vec<(String, ReportedPose)>,
}

fn as_map<S: serde::Serializer>(poses: &[(String, ReportedPose)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(poses.iter().map(|(name, pose)| (name, pose)))
}

/// The answer of `congruent fk`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ForwardReport {
    /// Name of the robot.
    pub robot: String,
    /// Base and tip, and who named them.
    pub chain: ReportedChain,
    /// Movable joints, in the order of configuration vectors.
    pub joints: Vec<String>,
    /// The source.
    pub source: Source,
    /// One entry for each configuration, in input order.
    pub results: Vec<ReportedLinkPoses>,
    /// Warnings about the input.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Finding>,
}

/// Why a source has no poses.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ForwardError {
    /// The robot file has no table.
    #[error("robot \"{robot}\" has no [dh] table along this chain")]
    NoTable {
        /// The robot.
        robot: String,
    },
    /// The source refuses the robot.
    #[error(transparent)]
    Source(#[from] LinkPosesError),
}

impl From<ForwardError> for Diagnostic {
    fn from(error: ForwardError) -> Self {
        let found = Diagnostic::error("fk::source", error.to_string());
        match error {
            ForwardError::NoTable { .. } => {
                found.with_help("use --source urdf, poe or simulation, or add [dh] to robot.toml")
            }
            ForwardError::Source(_) => found,
        }
    }
}

/// Poses of all links and of the declared TCP at each configuration, by a source of link poses.
///
/// # Errors
/// [`ForwardError`] if the source refuses a configuration.
pub fn forward(
    description: &RobotDescription,
    (source, link_poses): (Source, &mut dyn LinkPoses),
    configurations: &[RobotQ],
) -> Result<ForwardReport, ForwardError> {
    let robot = &description.robot;
    let mut root_from_links = vec![Pose::identity(); robot.links().len()];
    let tip_from_tcp = description.tip_from_tcp.filter(|_| robot.find_link(TCP).is_none()).map(Pose::from);
    let mut results = Vec::with_capacity(configurations.len());
    for q in configurations {
        link_poses.root_from_links_into(q, &mut root_from_links)?;
        let names = robot.links().iter().map(|link| link.name.clone());
        let mut links: Vec<(String, ReportedPose)> =
            names.zip(root_from_links.iter().map(ReportedPose::from)).collect();
        if let Some(tip_from_tcp) = tip_from_tcp {
            let root_from_tcp = root_from_links[description.tip.get()] * tip_from_tcp;
            links.push((TCP.to_owned(), (&root_from_tcp).into()));
        }
        results.push(ReportedLinkPoses { links });
    }
    Ok(report(description, source, results))
}

fn report(description: &RobotDescription, source: Source, results: Vec<ReportedLinkPoses>) -> ForwardReport {
    let robot = &description.robot;
    ForwardReport {
        robot: robot.name().to_owned(),
        chain: description.reported_chain(),
        joints: robot.movable_joint_names().map(str::to_owned).collect(),
        source,
        results,
        warnings: description.warnings.iter().map(Finding::from).collect(),
    }
}

/// Frames `dh0` to `dhn`, the tip under its name, and the TCP, which is the tip without a tool.
///
/// # Errors
/// [`ForwardError::NoTable`] for a robot without a table.
pub fn forward_by_table(
    description: &RobotDescription,
    configurations: &[RobotQ],
) -> Result<ForwardReport, ForwardError> {
    let robot = &description.robot;
    let table =
        description.dh.as_ref().ok_or_else(|| ForwardError::NoTable { robot: robot.name().to_owned() })?;
    let chain = DhChain::new(table, robot);
    let tree = UrdfTree::new(robot);
    let tip_from_tcp = description.tip_from_tcp.map_or(Pose::identity(), Pose::from);
    let mut base_from_dh = vec![Pose::identity(); chain.joint_count() + 1];
    let at = |q: &RobotQ| -> Result<ReportedLinkPoses, KinematicsError> {
        let root_from_base = tree.root_from_link(q, description.base)?;
        chain.dh_frames_into(q, &mut base_from_dh)?;
        let root_from_tip = root_from_base * chain.base_from_tip(q)?;
        let frames = base_from_dh.iter().enumerate();
        let mut links: Vec<(String, ReportedPose)> = frames
            .map(|(index, frame)| (format!("dh{index}"), (&(root_from_base * *frame)).into()))
            .collect();
        links.push((robot.link(description.tip).name.clone(), (&root_from_tip).into()));
        links.push((TCP.to_owned(), (&(root_from_tip * tip_from_tcp)).into()));
        Ok(ReportedLinkPoses { links })
    };
    let results = configurations.iter().map(at).collect::<Result<_, KinematicsError>>();
    Ok(report(description, Source::Dh, results.map_err(LinkPosesError::from)?))
}
