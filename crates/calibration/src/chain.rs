//! The chain that is calibrated: of the table if there is one, otherwise of the URDF, up to the tool.

use congruent_description::{ChainQ, DhTable, Diagnostic, LinkIndex, Robot, RobotDescription, RobotQ};
use congruent_kinematics::{DhChain, KinematicsError, Pose, ScrewChain};

/// How a joint moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum JointMotionKind {
    /// It rotates; continuous joints as well.
    Revolute,
    /// It slides.
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
}

impl<'a> NominalChain<'a> {
    /// # Errors
    /// The tip does not hang below the base, or no joint moves between them.
    pub(super) fn new(description: &'a RobotDescription) -> Result<Self, Diagnostic> {
        let refused = |error: KinematicsError| Diagnostic::error("calibrate::robot", error.to_string());
        let robot = &description.robot;
        let table = description.dh.as_ref().map(|table| (table, DhChain::new(table, robot)));
        let (mut chain, coordinates) = if let Some((_, dh)) = &table {
            (ScrewChain::from_dh(dh, robot.dof()).map_err(refused)?, dh.coordinates().to_vec())
        } else {
            let ends = (description.base, description.tip);
            let coordinates = moving(robot, ends).ok_or_else(|| {
                let message = format!("robot \"{}\": no joint moves the tip against the base", robot.name());
                Diagnostic::error("calibrate::robot", message)
            })?;
            (ScrewChain::from_urdf(robot, ends, &coordinates).map_err(refused)?, coordinates)
        };
        let tip_from_tcp = description.tip_from_tcp.map_or(Pose::identity(), Pose::from);
        chain.base_from_tip_at_zero = chain.base_from_tip_at_zero * tip_from_tcp;
        Ok(Self { robot, table, chain, coordinates })
    }

    /// The coordinates of its joints that move so.
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

    /// The chain's part of a configuration vector.
    pub(super) fn of_configuration(&self, q: &RobotQ) -> ChainQ {
        q.of_chain(&self.coordinates)
    }
}

/// The configuration vector's entries that move the tip against the base; `None` for none.
fn moving(robot: &Robot, (base, tip): (LinkIndex, LinkIndex)) -> Option<Vec<usize>> {
    let joints = robot.chain(base, tip)?;
    let coordinates: Vec<usize> = joints.iter().filter_map(|&joint| robot.coordinate(joint)).collect();
    (!coordinates.is_empty()).then_some(coordinates)
}
