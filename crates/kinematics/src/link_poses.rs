//! Where link poses come from: one trait for tables, URDF chains, screws, physics, and whatever else places
//! the links of a robot.

use congruent_description::RobotQ;

use crate::{
    chain::{screws::tree::ScrewTree, urdf::UrdfTree},
    error::KinematicsError,
    spatial::pose::Pose,
};

/// A source of link poses: given a configuration, it says where every link is.
///
/// An analytical model is one, a physics engine that is only asked for the poses of its bodies is another, and so
/// is a second description of the robot. Whoever compares two sources sees nothing else of them.
pub trait LinkPoses {
    /// Writes the poses of all links at configuration `q`, in the root link's frame and the robot's order.
    ///
    /// | value | shape | unit |
    /// |---|---|---|
    /// | `q` | dof | rad or m |
    /// | `root_from_links` | number of links | m |
    ///
    /// # Errors
    /// [`LinkPosesError`] if the source refuses the configuration, or a length does not fit.
    fn root_from_links_into(
        &mut self,
        q: &RobotQ,
        root_from_links: &mut [Pose],
    ) -> Result<(), LinkPosesError>;
}

/// Why a source has no poses.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LinkPosesError {
    /// A length does not fit the robot.
    #[error(transparent)]
    Kinematics(#[from] KinematicsError),
    /// What a source outside this crate says.
    #[error(transparent)]
    Source(Box<dyn std::error::Error + Send + Sync>),
}

impl LinkPosesError {
    /// The error of a source outside this crate.
    pub fn source(error: impl std::error::Error + Send + Sync + 'static) -> Self {
        Self::Source(Box::new(error))
    }
}

impl<T: LinkPoses + ?Sized> LinkPoses for &mut T {
    fn root_from_links_into(
        &mut self,
        q: &RobotQ,
        root_from_links: &mut [Pose],
    ) -> Result<(), LinkPosesError> {
        (**self).root_from_links_into(q, root_from_links)
    }
}

impl LinkPoses for UrdfTree {
    fn root_from_links_into(
        &mut self,
        q: &RobotQ,
        root_from_links: &mut [Pose],
    ) -> Result<(), LinkPosesError> {
        Ok(UrdfTree::root_from_links_into(self, q, root_from_links)?)
    }
}

impl LinkPoses for ScrewTree {
    fn root_from_links_into(
        &mut self,
        q: &RobotQ,
        root_from_links: &mut [Pose],
    ) -> Result<(), LinkPosesError> {
        Ok(ScrewTree::root_from_links_into(self, q, root_from_links)?)
    }
}
