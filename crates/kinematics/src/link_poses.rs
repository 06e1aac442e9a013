//! The source of link poses: one trait for tables, URDF chains, screws, physics, and any other model that gives the poses of
//! a robot's links.

use congruent_description::RobotQ;

use crate::{
    chain::{screws::tree::ScrewTree, urdf::UrdfTree},
    error::KinematicsError,
    spatial::pose::Pose,
};

/// A source of link poses: gives the pose of every link at a configuration.
///
/// An analytical model is a source; so is a physics engine (by the poses of its bodies) and a second description of the robot.
/// Comparisons of two sources use nothing but this trait.
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

/// The reason why a source cannot give poses.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LinkPosesError {
    /// A length does not fit the robot.
    #[error(transparent)]
    Kinematics(#[from] KinematicsError),
    /// The error of a source outside this crate.
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
