//! The chain that is calibrated: of the table if there is one, otherwise of the URDF, up to the tool.

use congruent_description::{ChainQ, DhTable, LinkIndex, Robot, RobotDescription, RobotQ};
use congruent_input::Diagnostic;
use congruent_kinematics::{DhChain, KinematicsError, Pose, ScrewChain};

use crate::codes;

/// The kind of motion of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum JointMotionKind {
    /// A rotation, with or without limits.
    Revolute,
    /// A translation along the axis.
    Prismatic,
}

/// A robot's chain from `base` to the measured frame, in the form that is corrected.
#[derive(Debug, Clone)]
pub(super) struct NominalChain<'a> {
    pub(super) robot: &'a Robot,
    /// The declared table, if there is one.
    pub(super) table: Option<(&'a DhTable, DhChain)>,
    pub(super) chain: ScrewChain,
    /// For each joint of the chain its entry of the configuration vector.
    pub(super) coordinates: Vec<usize>,
    /// Pose of the measured frame in link `tip`, without corrections.
    tip_from_tcp: Pose,
}

impl<'a> NominalChain<'a> {
    /// # Errors
    /// The tip does not hang below the base, or no joint moves between them.
    pub(super) fn new(description: &'a RobotDescription) -> Result<Self, Diagnostic> {
        let refused = |error: KinematicsError| Diagnostic::error(codes::calibrate::ROBOT, error.to_string());
        let robot = &description.robot;
        let table = description.dh.as_ref().map(|table| (table, DhChain::new(table, robot)));
        let (mut chain, coordinates) = if let Some((_, dh)) = &table {
            (ScrewChain::from_dh(dh, robot.dof()).map_err(refused)?, dh.coordinates().to_vec())
        } else {
            let (base, tip) = (description.base, description.tip);
            let coordinates = moving(robot, base, tip).ok_or_else(|| {
                let message =
                    format!("robot \"{}\": no joint moves the tip relative to the base", robot.name());
                Diagnostic::error(codes::calibrate::ROBOT, message)
            })?;
            (ScrewChain::from_urdf(robot, base, tip, &coordinates).map_err(refused)?, coordinates)
        };
        let tip_from_tcp = description.tip_from_tcp.map_or(Pose::identity(), Pose::from);
        chain.base_from_tip_at_zero = chain.base_from_tip_at_zero * tip_from_tcp;
        Ok(Self { robot, table, chain, coordinates, tip_from_tcp })
    }

    /// Pose of the measured frame in link `tip`, with the displacement of the tool, which is in link `base` at zero.
    pub(super) fn tip_from_measured(&self, tool: &Pose) -> Pose {
        let base_from_tcp = self.chain.base_from_tip_at_zero;
        let base_from_tip = base_from_tcp * self.tip_from_tcp.inverse();
        base_from_tip.inverse() * *tool * base_from_tcp
    }

    /// Indices, in the configuration vector, of the joints with this kind of motion.
    pub(super) fn coordinates_of(&self, motion: JointMotionKind) -> Vec<usize> {
        let is_revolute =
            |&coordinate: &usize| self.robot.joint(self.robot.movable_joints()[coordinate]).kind.is_angular();
        self.coordinates
            .iter()
            .copied()
            .filter(|each| is_revolute(each) == (motion == JointMotionKind::Revolute))
            .collect()
    }

    /// Names of the chain's joints, base to tip.
    pub(super) fn joint_names(&self) -> Vec<&'a str> {
        let name =
            |&coordinate: &usize| self.robot.joint(self.robot.movable_joints()[coordinate]).name.as_str();
        self.coordinates.iter().map(name).collect()
    }

    /// The positions of the chain's joints from a configuration vector.
    pub(super) fn chain_positions(&self, q: &RobotQ) -> ChainQ {
        q.chain_positions(&self.coordinates)
    }
}

/// Indices, in the configuration vector, of the joints that move the tip relative to the base; `None` if there are none.
fn moving(robot: &Robot, base: LinkIndex, tip: LinkIndex) -> Option<Vec<usize>> {
    let joints = robot.chain(base, tip)?;
    let coordinates: Vec<usize> = joints.iter().filter_map(|&joint| robot.coordinate(joint)).collect();
    (!coordinates.is_empty()).then_some(coordinates)
}
