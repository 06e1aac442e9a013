//! A pose that the source of a run has of the robot, against that of the model at the same instant.

use congruent_description::{LinkIndex, RobotQ};
use congruent_kinematics::Pose;
use congruent_scenario::PoseOrigin;
use nalgebra::Isometry3;

/// Poses of one target in one frame, and what of the robot the two are.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparedPoses {
    /// Their name in reports: the topic, and of TF the frames.
    pub name: String,
    /// Their topic.
    pub topic: String,
    /// Where they come from.
    pub origin: PoseOrigin,
    /// The link that carries the frame.
    pub from_link: LinkIndex,
    /// The frame in that link.
    pub link_from_frame: Isometry3<f64>,
    /// The link that carries the target.
    pub link: LinkIndex,
    /// The target in that link.
    pub link_from_target: Isometry3<f64>,
    /// Whether the two frames were fitted to the poses.
    pub frames_are_fitted: bool,
    /// Whether only the position of the target is known.
    pub position_only: bool,
    /// What was added to their times, s.
    pub offset_s: f64,
}

impl ComparedPoses {
    /// The pose of the target in the frame, from the poses of all links in one frame.
    pub fn frame_from_target(&self, root_from_links: &[Pose]) -> Isometry3<f64> {
        let root_from = |link: LinkIndex| root_from_links[link.get()].to_isometry();
        let root_from_frame = root_from(self.from_link) * self.link_from_frame;
        root_from_frame.inverse() * root_from(self.link) * self.link_from_target
    }
}

/// A pose at its own instant, which is between two samples as a rule.
#[derive(Debug, Clone, Copy)]
pub struct PoseSample<'a> {
    /// Number of the [`ComparedPoses`].
    pub of: usize,
    /// Time of the source.
    pub time_s: f64,
    /// The pose of the target in the frame, as the source has it.
    pub frame_from_target: Isometry3<f64>,
    /// The joint positions at this instant, interpolated between two samples.
    pub q: &'a RobotQ,
    /// Poses of the links by the model at these positions, in the root link's frame and the robot's order.
    pub root_from_links: &'a [Pose],
}
