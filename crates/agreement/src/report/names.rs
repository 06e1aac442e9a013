//! Which two models a diagnosis stands between, and what names and places their numbers have.

use congruent_description::{JointIndex, RobotDescription, RobotFilePlaces, UrdfPlaces};

/// Which two models a ladder stands between.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PairTitle {
    pub(crate) name: &'static str,
    pub(crate) title: &'static str,
}

/// What names and places the numbers of a models have.
pub(crate) struct ModelNames<'a> {
    pub(crate) description: &'a RobotDescription,
    /// Moving joints of the chain, base to tip: what a models numbers.
    pub(crate) moving: Vec<JointIndex>,
    /// All joints of the chain.
    pub(crate) chain: Vec<JointIndex>,
    pub(crate) places: Option<RobotFilePlaces>,
    pub(crate) urdf: Option<UrdfPlaces>,
}

impl ModelNames<'_> {
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
