//! The analytical model: the pose of every link from the table if a row moves the link, otherwise from the
//! URDF chain, with the origin of each pose.

use congruent_description::{LinkIndex, Robot, RobotDescription, RobotQ};
use congruent_kinematics::{DhChain, KinematicsError, Pose, UrdfTree};

/// The origin of the model's pose of a link.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PoseSource {
    /// The table and its declared transforms; nothing is fitted.
    Dh,
    /// The table, with one constant transform from the row's frame to the link, fitted at the
    /// zero configuration. It cannot show a constant error, only one that moves.
    DhFitted,
    /// The URDF chain: no row of the table moves this link.
    Urdf,
}

/// A link that a table row moves: `base_from_link = base_from_dhk * dhk_from_link`.
#[derive(Debug, Clone, Copy)]
struct DhLink {
    link: usize,
    frame: usize,
    dhk_from_link: Pose,
}

/// The table with the links that its rows move.
#[derive(Debug, Clone)]
struct DhModel {
    chain: DhChain,
    base: LinkIndex,
    links: Vec<DhLink>,
    base_from_frames: Vec<Pose>,
}

/// Analytical poses of all links, at one configuration after another without allocation.
#[derive(Debug, Clone)]
pub struct Model {
    tree: UrdfTree,
    dh: Option<DhModel>,
    sources: Vec<PoseSource>,
    root_from_links: Vec<Pose>,
}

impl Model {
    /// The model that a robot file declares; a bare URDF is modelled by its own chain.
    ///
    /// # Errors
    /// [`KinematicsError`] if table and robot do not fit together.
    pub fn new(description: &RobotDescription) -> Result<Self, KinematicsError> {
        let robot = &description.robot;
        let tree = UrdfTree::new(robot);
        let mut root_from_links = vec![Pose::identity(); robot.links().len()];
        tree.root_from_links_into(&RobotQ::zeros(robot.dof()), &mut root_from_links)?;
        let mut sources = vec![PoseSource::Urdf; robot.links().len()];
        let dh = match &description.dh {
            Some(_) => Some(DhModel::new(description, &root_from_links, &mut sources)?),
            None => None,
        };
        Ok(Self { tree, dh, sources, root_from_links })
    }

    /// The origin of each link's pose, in the robot's order of links.
    pub fn sources(&self) -> &[PoseSource] {
        &self.sources
    }

    /// The last poses of [`Model::root_from_links`]; identities before its first call.
    pub fn latest(&self) -> &[Pose] {
        &self.root_from_links
    }

    /// Poses of all links at configuration `q`, in the root link's frame and the robot's order.
    ///
    /// # Errors
    /// [`KinematicsError`] if `q` has the wrong number of joints.
    pub fn root_from_links(&mut self, q: &RobotQ) -> Result<&[Pose], KinematicsError> {
        self.tree.root_from_links_into(q, &mut self.root_from_links)?;
        if let Some(dh) = &mut self.dh {
            dh.overwrite(q, &mut self.root_from_links)?;
        }
        Ok(&self.root_from_links)
    }
}

impl DhModel {
    fn new(
        description: &RobotDescription,
        root_from_links_at_zero: &[Pose],
        sources: &mut [PoseSource],
    ) -> Result<Self, KinematicsError> {
        let (robot, Some(table)) = (&description.robot, &description.dh) else {
            unreachable!("called only if a table is declared")
        };
        let chain = DhChain::new(table, robot);
        let mut base_from_frames = vec![Pose::identity(); chain.joint_count() + 1];
        chain.dh_frames_into(&RobotQ::zeros(robot.dof()), &mut base_from_frames)?;
        let root_from_base = root_from_links_at_zero[description.base.get()];
        let mut links = Vec::new();
        for link in robot.link_indices() {
            let Some(frame) = frame_that_moves(robot, description, link) else { continue };
            let declared = link == description.tip;
            // The tip is declared in the last frame, whatever row its joint is in.
            let frame = if declared { chain.joint_count() } else { frame };
            // The tip has a declared constant, which can be wrong and is compared. Every other link gets the
            // constant that makes it agree at zero, since no table says where link frames lie.
            let dhk_from_link = if declared {
                table.dhn_from_tip.into()
            } else {
                let base_from_link = root_from_base.inverse() * root_from_links_at_zero[link.get()];
                base_from_frames[frame].inverse() * base_from_link
            };
            sources[link.get()] = if declared { PoseSource::Dh } else { PoseSource::DhFitted };
            links.push(DhLink { link: link.get(), frame, dhk_from_link });
        }
        Ok(Self { chain, base: description.base, links, base_from_frames })
    }

    fn overwrite(&mut self, q: &RobotQ, root_from_links: &mut [Pose]) -> Result<(), KinematicsError> {
        self.chain.dh_frames_into(q, &mut self.base_from_frames)?;
        let root_from_base = root_from_links[self.base.get()];
        for link in &self.links {
            root_from_links[link.link] =
                root_from_base * (self.base_from_frames[link.frame] * link.dhk_from_link);
        }
        Ok(())
    }
}

/// The table's frame that moves rigidly with `link`; `None` for a link that no row moves.
fn frame_that_moves(robot: &Robot, description: &RobotDescription, link: LinkIndex) -> Option<usize> {
    let body = robot.body(link);
    let joint = robot.parent_joint(body)?;
    let row = description.dh.as_ref()?.rows.iter().position(|row| row.joint == joint)?;
    Some(row + 1)
}
