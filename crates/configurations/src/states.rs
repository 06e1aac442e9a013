//! States of a robot: positions with speeds, accelerations and torques.

use congruent_description::{RobotQ, RobotQList};

/// One entry of a batch in full: one value for each movable joint.
#[derive(Debug, Clone, PartialEq)]
pub struct JointState {
    /// Positions in rad and m.
    pub q: RobotQ,
    /// Speeds in rad/s and m/s.
    pub qd: Vec<f64>,
    /// Accelerations in rad/s^2 and m/s^2.
    pub qdd: Vec<f64>,
    /// Torques in N m and forces in N.
    pub tau: Vec<f64>,
}

/// States of one robot in little memory: 8 bytes for each value, and none for what is zero in all of them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct JointStateList {
    count: usize,
    /// Positions, speeds, accelerations and torques.
    parts: [RobotQList; 4],
}

impl JointStateList {
    /// An empty list for a robot with this number of movable joints.
    pub fn new(joints: usize) -> Self {
        Self { count: 0, parts: std::array::from_fn(|_| RobotQList::new(joints)) }
    }

    /// Adds a state at the end.
    ///
    /// # Panics
    /// If it has not one value for each movable joint.
    pub fn push(&mut self, JointState { q, qd, qdd, tau }: &JointState) {
        self.count += 1;
        for (rows, row) in self.parts.iter_mut().zip([&**q, qd, qdd, tau]) {
            rows.push(row);
        }
    }

    /// All states in the order in which they were added.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = JointState> + Clone + '_ {
        (0..self.count).map(|index| {
            let [q, qd, qdd, tau] =
                self.parts.each_ref().map(|rows| rows.get(index).unwrap_or_default().to_vec());
            JointState { q: q.into(), qd, qdd, tau }
        })
    }
}
