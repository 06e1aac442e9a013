//! The frame whose pose is computed: a link, or the tool centre point, at the end of a chain that starts at the base.

use congruent::{
    analysis::jacobians::JacobianFrame,
    description::{LinkIndex, RobotDescription},
    input::Diagnostic,
    kinematics::{Pose, SerialChain},
};

use super::columns::{FollowedColumn, JointColumns};

/// A frame with the chain that moves it.
#[derive(Debug, Clone)]
pub(super) struct MovedFrame {
    pub(super) chain: SerialChain,
    pub(super) link: LinkIndex,
    /// Where the frame is in the link at the end of the chain; `None` if it is that link.
    pub(super) link_from_frame: Option<Pose>,
    /// For each joint of the chain the place of its position in a row.
    follows: Vec<FollowedColumn>,
    /// Whether a row is a configuration of the chain as it is.
    is_direct: bool,
}

impl MovedFrame {
    /// The frame with the name of a link, or `tcp`; the tip of the robot if no name is given.
    ///
    /// # Errors
    /// There is no such link, or no tool centre point is declared.
    pub(super) fn named(
        description: &RobotDescription,
        columns: &JointColumns,
        name: Option<&str>,
    ) -> Result<Self, Diagnostic> {
        let (link, link_from_frame) = match JacobianFrame::named(description, name)? {
            JacobianFrame::Link(link) => (link, None),
            JacobianFrame::Tcp(link, link_from_tcp) => (link, Some(link_from_tcp)),
        };
        let chain = SerialChain::from_urdf(&description.robot, description.base, link);
        let follows: Vec<FollowedColumn> =
            chain.coordinates().iter().map(|&at| columns.follows()[at]).collect();
        let is_own = |(at, of): (usize, &FollowedColumn)| {
            of.column == at && columns.driven()[at] == chain.coordinates()[at]
        };
        let is_direct = follows.len() == columns.count() && follows.iter().enumerate().all(is_own);
        Ok(Self { chain, link, link_from_frame, follows, is_direct })
    }

    pub(super) fn follows(&self) -> &[FollowedColumn] {
        &self.follows
    }

    /// The positions of the joints of the chain: the rows themselves, or gathered from them into `memory`.
    pub(super) fn positions<'a>(
        &self,
        rows: &'a [f64],
        columns: usize,
        memory: &'a mut Vec<f64>,
    ) -> &'a [f64] {
        if self.is_direct {
            return rows;
        }
        memory.clear();
        for row in rows.chunks(columns.max(1)) {
            let place = |of: &FollowedColumn| of.multiplier * row[of.column] + of.offset;
            memory.extend(self.follows.iter().map(place));
        }
        memory
    }
}
