//! The model that is converted: its joints by name, and its forward kinematics.

use congruent_description::{ChainQ, DhTable, JointIndex, RobotDescription, RobotQ};
use congruent_input::Diagnostic;
use congruent_kinematics::{DhChain, Pose, ScrewChain, SerialDh, UrdfTree};
use nalgebra::Vector3;

use super::options::ConversionSource;
use crate::codes;

/// One model of a chain.
pub(super) struct ConvertedModel<'a> {
    pub(super) description: &'a RobotDescription,
    pub(super) source: ConversionSource,
    /// Base to tip; for a table in the order of its rows.
    pub(super) joints: Vec<JointIndex>,
    /// Index of each joint in a configuration vector.
    pub(super) coordinates: Vec<usize>,
}

impl<'a> ConvertedModel<'a> {
    pub(super) fn new(
        description: &'a RobotDescription,
        source: Option<ConversionSource>,
    ) -> Result<Self, Diagnostic> {
        let joints = match (source, &description.dh) {
            (Some(ConversionSource::Dh) | None, Some(table)) => {
                table.rows.iter().map(|row| row.joint).collect()
            }
            (Some(ConversionSource::Dh), None) => {
                let message = format!("robot \"{}\" has no [dh] table", description.name);
                return Err(Diagnostic::error(codes::convert::NO_DH, message)
                    .with_help("leave --from out to convert the chain of the URDF"));
            }
            _ => description.moving_chain(),
        };
        let coordinate = |&joint| description.robot.coordinate(joint).expect("joints of a chain move");
        let is_table = source != Some(ConversionSource::Urdf) && description.dh.is_some();
        Ok(Self {
            description,
            source: if is_table { ConversionSource::Dh } else { ConversionSource::Urdf },
            coordinates: joints.iter().map(coordinate).collect(),
            joints,
        })
    }

    /// The declared table, if that is converted.
    pub(super) fn declared(&self) -> Option<&'a DhTable> {
        self.description.dh.as_ref().filter(|_| self.source == ConversionSource::Dh)
    }

    pub(super) fn joint_name(&self, joint: usize) -> &'a str {
        &self.description.robot.joint(self.joints[joint]).name
    }

    /// The model as screws.
    pub(super) fn screws(&self) -> ScrewChain {
        match self.declared() {
            Some(table) => SerialDh::from_table(table).screw_chain(),
            None => ScrewChain::identify(self.joints.len(), self.forward()),
        }
    }

    /// Origins of the joints at zero, in the base.
    pub(super) fn origins(&self) -> Vec<Vector3<f64>> {
        let RobotDescription { robot, base, .. } = self.description;
        let tree = UrdfTree::new(robot);
        let zero = RobotQ::zeros(robot.dof());
        let root_from = |link| tree.root_from_link(&zero, link).expect("the robot's own configuration");
        let base_from_root = root_from(*base).inverse();
        let origin = |&joint: &JointIndex| (base_from_root * root_from(robot.joint(joint).child)).translation;
        self.joints.iter().map(origin).collect()
    }

    /// `base_from_tip` at the positions of the joints, by the same arithmetic as `congruent check`.
    pub(super) fn forward(&self) -> impl FnMut(&ChainQ) -> Pose + use<'a> {
        let RobotDescription { robot, base, tip, .. } = self.description;
        let table = self.declared().map(|table| DhChain::new(table, robot));
        let tree = UrdfTree::new(robot);
        let coordinates = self.coordinates.clone();
        let mut q = RobotQ::zeros(robot.dof());
        move |values: &ChainQ| {
            q.set_chain(&coordinates, values);
            let root_from = |link| tree.root_from_link(&q, link).expect("the robot's own configuration");
            match &table {
                Some(chain) => chain.base_from_tip(&q).expect("the robot's own configuration"),
                None => root_from(*base).inverse() * root_from(*tip),
            }
        }
    }
}
