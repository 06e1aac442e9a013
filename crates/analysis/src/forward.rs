//! `congruent fk`: poses of links by a chosen source.

use std::collections::BTreeMap;

use congruent_description::{ReportedChain, RobotDescription, RobotQ};
use congruent_input::{Diagnostic, Finding, known_names, serde_name};
use congruent_kinematics::{
    DhChain, KinematicsError, LinkPoses, LinkPosesError, Pose, ReportedPose, UrdfTree,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{codes, stream::Stream};

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
    /// The physics engine, by the poses of its bodies.
    Simulation,
}

/// Poses at one configuration, by name, in order.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReportedLinkPoses {
    /// Links (or frames of the table) with their poses in the frame `from` of the report.
    #[serde(serialize_with = "as_map")]
    #[schemars(with = "BTreeMap<String, ReportedPose>")]
    pub links: Vec<(String, ReportedPose)>,
}

fn as_map<S: serde::Serializer>(poses: &[(String, ReportedPose)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(poses.iter().map(|(name, pose)| (name, pose)))
}

/// The answer of `congruent fk`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "ForwardReport")]
pub struct ForwardReport<Results> {
    /// Name of the robot.
    pub robot: String,
    /// Base and tip, and who named them.
    pub chain: ReportedChain,
    /// Movable joints, in the order of configuration vectors.
    pub joints: Vec<String>,
    /// The source of the poses.
    pub source: Source,
    /// The frame in which the poses are given: a link, a frame of the table or the declared TCP; by default the root link.
    pub from: String,
    /// The one frame whose pose was requested; `None` for all frames.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to: Option<String>,
    /// One entry for each configuration, in input order.
    pub results: Results,
    /// Warnings about the input.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Finding>,
}

/// Why a source cannot compute poses.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ForwardError {
    /// The robot file has no table.
    #[error("robot \"{robot}\" has no [dh] table along this chain")]
    NoTable {
        /// Name of the robot.
        robot: String,
    },
    /// The source refuses the robot.
    #[error(transparent)]
    Source(#[from] LinkPosesError),
}

impl From<ForwardError> for Diagnostic {
    fn from(error: ForwardError) -> Self {
        let found = Diagnostic::error(codes::fk::SOURCE, error.to_string());
        match error {
            ForwardError::NoTable { .. } => {
                found.with_help("use --source urdf, poe or simulation, or add [dh] to robot.toml")
            }
            ForwardError::Source(_) => found,
        }
    }
}

/// Poses that are computed while they are written.
pub type PoseStream<'a> = Stream<'a, ReportedLinkPoses>;

impl ForwardReport<PoseStream<'_>> {
    /// The same poses expressed in the frame `from`, and only that of the frame `to`; `None` changes nothing. `self` has the poses
    /// of all frames in the root link.
    ///
    /// # Errors
    /// The source has no frame of that name.
    pub fn between(self, from: Option<&str>, to: Option<&str>) -> Result<Self, Diagnostic> {
        let (source, root) = (self.source, self.from.clone());
        let [from, to] = [from, to].map(|frame| frame.map(str::to_owned));
        let results = {
            let (from, to) = (from.clone(), to.clone());
            self.results.map(move |poses| poses.between(source, &root, from.as_deref(), to.as_deref()))?
        };
        Ok(Self { from: from.unwrap_or(self.from), to, results, ..self })
    }
}

impl ReportedLinkPoses {
    fn between(
        self,
        source: Source,
        root: &str,
        from: Option<&str>,
        to: Option<&str>,
    ) -> Result<Self, Diagnostic> {
        let mut links = self.links;
        let root_from = |name: &str| -> Result<Pose, Diagnostic> {
            let found = links.iter().find(|(link, _)| link == name);
            match found {
                Some((_, pose)) => Ok(pose.into()),
                None if name == root => Ok(Pose::identity()),
                None => Err(unknown_frame(name, source, &links)),
            }
        };
        let from_from_root = from.map(root_from).transpose()?.map(|root_from_from| root_from_from.inverse());
        // Both frames are looked up before the list is reduced to one of them.
        let root_from_to = to.map(root_from).transpose()?;
        if let (Some(to), Some(root_from_to)) = (to, root_from_to) {
            links = vec![(to.to_owned(), (&root_from_to).into())];
        }
        if let Some(from_from_root) = from_from_root {
            for (_, pose) in &mut links {
                *pose = (&(from_from_root * Pose::from(&*pose))).into();
            }
        }
        Ok(Self { links })
    }
}

fn unknown_frame(name: &str, source: Source, links: &[(String, ReportedPose)]) -> Diagnostic {
    let known = links.iter().map(|(link, _)| link.as_str());
    let message = format!("source {} has no frame \"{name}\"", serde_name(&source));
    Diagnostic::error(codes::fk::FRAME, message).with_help(known_names(name, "frames", known))
}

/// Poses of all links and of the declared TCP at each configuration, by a source of link poses.
///
/// # Errors
/// [`ForwardError`] if the source refuses the first configuration.
pub fn forward<'a>(
    description: &'a RobotDescription,
    source: Source,
    mut link_poses: Box<dyn LinkPoses + 'a>,
    configurations: impl Iterator<Item = RobotQ> + 'a,
) -> Result<ForwardReport<PoseStream<'a>>, Diagnostic> {
    let robot = &description.robot;
    let mut root_from_links = vec![Pose::identity(); robot.links().len()];
    let tip_from_tcp = description.tip_from_tcp.map(Pose::from);
    let at = move |q: RobotQ| -> Result<ReportedLinkPoses, ForwardError> {
        link_poses.root_from_links_into(&q, &mut root_from_links)?;
        let names = robot.links().iter().map(|link| link.name.clone());
        let mut links: Vec<(String, ReportedPose)> =
            names.zip(root_from_links.iter().map(ReportedPose::from)).collect();
        if let Some(tip_from_tcp) = tip_from_tcp {
            let root_from_tcp = root_from_links[description.tip.get()] * tip_from_tcp;
            links.push((robot.tcp_name().to_owned(), (&root_from_tcp).into()));
        }
        Ok(ReportedLinkPoses { links })
    };
    report(description, source, configurations.map(at))
}

fn report<'a>(
    description: &RobotDescription,
    source: Source,
    results: impl Iterator<Item = Result<ReportedLinkPoses, ForwardError>> + 'a,
) -> Result<ForwardReport<PoseStream<'a>>, Diagnostic> {
    let robot = &description.robot;
    Ok(ForwardReport {
        robot: description.name.clone(),
        chain: description.reported_chain(),
        joints: robot.movable_joint_names().map(str::to_owned).collect(),
        source,
        from: robot.link(robot.root()).name.clone(),
        to: None,
        results: Stream::begin(results.map(|result| result.map_err(Diagnostic::from)))?,
        warnings: description.warnings.iter().map(Finding::from).collect(),
    })
}

/// The base unless it is the root, frames `dh0` to `dhn`, the tip under its name, and the TCP, which is the tip without a tool.
///
/// # Errors
/// [`ForwardError::NoTable`] for a robot without a table.
pub fn forward_by_table<'a>(
    description: &'a RobotDescription,
    configurations: impl Iterator<Item = RobotQ> + 'a,
) -> Result<ForwardReport<PoseStream<'a>>, Diagnostic> {
    let robot = &description.robot;
    let table =
        description.dh.as_ref().ok_or_else(|| ForwardError::NoTable { robot: description.name.clone() })?;
    let chain = DhChain::new(table, robot);
    let tree = UrdfTree::new(robot);
    let name = |link| robot.link(link).name.clone();
    let tip_from_tcp = description.tip_from_tcp.map_or(Pose::identity(), Pose::from);
    let mut base_from_dh = vec![Pose::identity(); chain.joint_count() + 1];
    let mut at = move |q: &RobotQ| -> Result<ReportedLinkPoses, KinematicsError> {
        let root_from_base = tree.root_from_link(q, description.base)?;
        chain.dh_frames_into(q, &mut base_from_dh)?;
        let root_from_tip = root_from_base * chain.base_from_tip(q)?;
        let frames = base_from_dh.iter().enumerate();
        let frames = frames.map(|(index, frame)| (format!("dh{index}"), root_from_base * *frame));
        let base = (description.base != robot.root()).then(|| (name(description.base), root_from_base));
        let mut links: Vec<(String, ReportedPose)> =
            base.into_iter().chain(frames).map(|(name, pose)| (name, (&pose).into())).collect();
        links.push((name(description.tip), (&root_from_tip).into()));
        links.push((robot.tcp_name().to_owned(), (&(root_from_tip * tip_from_tcp)).into()));
        Ok(ReportedLinkPoses { links })
    };
    let results = configurations.map(move |q| at(&q).map_err(|error| LinkPosesError::from(error).into()));
    report(description, Source::Dh, results)
}
