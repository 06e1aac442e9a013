//! Names and places in files for the numbers of a diagnosis.

use congruent_description::{ConstantKey, JointIndex, RobotDescription, RobotFilePlaces, UrdfPlaces};

use crate::diagnosis::{CandidateModel, DeclaredTransform};

/// Names of joints, and places in the robot file and the URDF.
pub(crate) struct ModelNames<'a> {
    pub(crate) description: &'a RobotDescription,
    /// Moving joints of the chain, base to tip, as the models number them.
    pub(crate) moving: Vec<JointIndex>,
    /// All joints of the chain, fixed ones included.
    pub(crate) chain: Vec<JointIndex>,
    pub(crate) places: Option<&'a RobotFilePlaces>,
    pub(crate) urdf: Option<&'a UrdfPlaces>,
}

impl ModelNames<'_> {
    /// The table with the roll, pitch and yaw of its declared transforms as the file writes them.
    pub(super) fn candidate(&self) -> Option<CandidateModel> {
        let candidate = CandidateModel::from_table(self.description.dh.as_ref()?, &self.moving)?;
        let written = |transform: DeclaredTransform, key| DeclaredTransform {
            written_rpy_rad: self.places.and_then(|places| places.rpy_rad(key)),
            ..transform
        };
        Some(CandidateModel {
            base: written(candidate.base, ConstantKey::BaseFromDh0),
            tool: written(candidate.tool, ConstantKey::DhnFromTip),
            ..candidate
        })
    }

    /// Name of a moving joint of the chain.
    pub(super) fn moving_joint(&self, joint: usize) -> String {
        let name = |&index| self.description.robot.joint(index).name.clone();
        self.moving.get(joint).map(name).unwrap_or_default()
    }

    /// Name of any joint of the chain.
    pub(super) fn chain_joint(&self, joint: usize) -> String {
        let name = |&index| self.description.robot.joint(index).name.clone();
        self.chain.get(joint).map(name).unwrap_or_default()
    }
}
