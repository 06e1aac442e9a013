//! `congruent fk`: poses of links by a chosen witness.

use congruent_description::{Diagnostic, RobotDescription};
use congruent_kinematics::{DhChain, KinematicsError, Pose, ScrewTree, UrdfTree};
use congruent_simulation::{World, WorldSettings};
use nalgebra::Isometry3;
use serde::Serialize;

use crate::check::CheckError;

/// The tool center point among links.
const TCP: &str = "tcp";

/// Which witness answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Source {
    /// The URDF chain, by analysis.
    Urdf,
    /// The declared table: its frames, the tip and the TCP.
    Dh,
    /// Screws (product of exponentials).
    Poe,
    /// The physics engine.
    Simulation,
}

/// A pose as programs read it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ReportedPose {
    /// Origin, in the root link's frame where nothing else is said.
    pub translation_m: [f64; 3],
    /// Orientation in the same frame; the first component that is not zero is positive.
    pub quaternion_wxyz: [f64; 4],
}

impl From<&Pose> for ReportedPose {
    fn from(pose: &Pose) -> Self {
        Self { translation_m: pose.translation.into(), quaternion_wxyz: pose.quaternion_wxyz() }
    }
}

/// Poses at one configuration, by name, in order.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Poses {
    /// Links (or frames of the table) with their poses in the root link's frame.
    #[serde(serialize_with = "as_map")]
    pub links: Vec<(String, ReportedPose)>,
}

fn as_map<S: serde::Serializer>(poses: &[(String, ReportedPose)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(poses.iter().map(|(name, pose)| (name, pose)))
}

/// The answer of `congruent fk`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ForwardReport {
    /// Name of the robot.
    pub robot: String,
    /// Movable joints, in the order of configuration vectors.
    pub joints: Vec<String>,
    /// Which witness answered.
    pub source: Source,
    /// One entry for each configuration, in input order.
    pub results: Vec<Poses>,
}

/// Why a witness cannot answer.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ForwardError {
    /// The robot file has no table.
    #[error("robot \"{robot}\" has no [dh] table")]
    NoTable {
        /// The robot.
        robot: String,
    },
    /// A witness refuses the robot.
    #[error(transparent)]
    Check(#[from] CheckError),
}

impl From<ForwardError> for Diagnostic {
    fn from(error: ForwardError) -> Self {
        let found = Diagnostic::error("fk::source", error.to_string());
        match error {
            ForwardError::NoTable { .. } => {
                found.with_help("use --source urdf, poe or simulation, or add [dh] to robot.toml")
            }
            ForwardError::Check(_) => found,
        }
    }
}

/// Poses of all links and of the declared TCP, or of the table's frames, at each configuration.
///
/// # Errors
/// [`ForwardError`] where the witness does not exist or refuses the robot.
pub fn forward(
    description: &RobotDescription,
    source: Source,
    configurations: &[Vec<f64>],
) -> Result<ForwardReport, ForwardError> {
    let robot = &description.robot;
    let mut poses = vec![Pose::identity(); robot.links().len()];
    let names = || robot.links().iter().map(|link| link.name.clone());
    let mut results = Vec::with_capacity(configurations.len());
    let mut keep = |poses: &[Pose]| {
        let mut links: Vec<(String, ReportedPose)> =
            names().zip(poses.iter().map(ReportedPose::from)).collect();
        if let Some(tip_from_tcp) = description.tip_from_tcp.filter(|_| robot.find_link(TCP).is_none()) {
            let root_from_tcp = poses[description.tip.get()] * Pose::from(tip_from_tcp);
            links.push((TCP.to_owned(), (&root_from_tcp).into()));
        }
        results.push(Poses { links });
    };
    match source {
        Source::Urdf => {
            let tree = UrdfTree::new(robot);
            for q in configurations {
                tree.root_from_links_into(q, &mut poses).map_err(CheckError::from)?;
                keep(&poses);
            }
        }
        Source::Poe => {
            let tree = ScrewTree::new(robot);
            for q in configurations {
                tree.root_from_links_into(q, &mut poses).map_err(CheckError::from)?;
                keep(&poses);
            }
        }
        Source::Simulation => {
            let mut world = World::new(robot, &WorldSettings::default()).map_err(CheckError::from)?;
            let (at_rest, mut twin) = (vec![0.0; robot.dof()], vec![Isometry3::identity(); poses.len()]);
            for q in configurations {
                world.set_state(q, &at_rest).map_err(CheckError::from)?;
                world.root_from_links_into(&mut twin);
                for (pose, twin) in poses.iter_mut().zip(&twin) {
                    *pose = Pose::from(*twin);
                }
                keep(&poses);
            }
        }
        Source::Dh => results = by_table(description, configurations)?,
    }
    Ok(ForwardReport {
        robot: robot.name().to_owned(),
        joints: robot.movable_joint_names().map(str::to_owned).collect(),
        source,
        results,
    })
}

/// Frames `dh0` to `dhn`, the tip under its name, and the TCP, which is the tip without a tool.
fn by_table(description: &RobotDescription, configurations: &[Vec<f64>]) -> Result<Vec<Poses>, ForwardError> {
    let robot = &description.robot;
    let table =
        description.dh.as_ref().ok_or_else(|| ForwardError::NoTable { robot: robot.name().to_owned() })?;
    let chain = DhChain::new(table, robot);
    let tree = UrdfTree::new(robot);
    let tip_from_tcp = description.tip_from_tcp.map_or(Pose::identity(), Pose::from);
    let mut base_from_dh = vec![Pose::identity(); chain.joint_count() + 1];
    let mut at = |q: &Vec<f64>| -> Result<Poses, KinematicsError> {
        let root_from_base = tree.root_from_link(q, description.base)?;
        chain.dh_frames_into(q, &mut base_from_dh)?;
        let root_from_tip = root_from_base * chain.base_from_tip(q)?;
        let frames = base_from_dh.iter().enumerate();
        let mut links: Vec<(String, ReportedPose)> = frames
            .map(|(index, frame)| (format!("dh{index}"), (&(root_from_base * *frame)).into()))
            .collect();
        links.push((robot.link(description.tip).name.clone(), (&root_from_tip).into()));
        links.push((TCP.to_owned(), (&(root_from_tip * tip_from_tcp)).into()));
        Ok(Poses { links })
    };
    configurations.iter().map(|q| at(q).map_err(|error| CheckError::from(error).into())).collect()
}
