//! The reference model that the candidate is compared with: a chain of constant transforms and joints.
//! Hypotheses can remove one of them or read its angles in another order.

use congruent_description::ChainQ;
use congruent_kinematics::{Pose, ScrewChain, Twist};
use nalgebra::Matrix3;

/// Space screws at a configuration, in the order of the moving joints, and the tip.
#[derive(Debug, Clone)]
pub(super) struct ChainState {
    pub(super) twists: Vec<Twist>,
    pub(super) base_from_tip: Pose,
}

/// One joint of the reference, moving or fixed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReferenceJoint {
    /// The constant transform that leads to the joint.
    pub parent_from_joint: Pose,
    /// Twist for one unit of its coordinate, in its own frame; `None` for a fixed joint.
    pub twist_in_joint: Option<Twist>,
    /// Whether the chain passes it from child to parent, as it does from a base link beside the chain.
    pub is_upward: bool,
    /// Whether it is written in a file, so that its values can be wrong; false for a black box.
    pub is_written: bool,
}

impl ReferenceJoint {
    /// The constant transform in the direction of the chain.
    fn step(&self) -> Pose {
        if self.is_upward { self.parent_from_joint.inverse() } else { self.parent_from_joint }
    }
}

/// The chain that counts as correct: joints from base to tip.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceModel {
    /// All joints, fixed ones included; the moving ones are numbered like the coordinates.
    pub joints: Vec<ReferenceJoint>,
}

impl ReferenceModel {
    /// A reference model of which only the screws are known: a black box that was identified.
    pub fn from_screws(chain: &ScrewChain) -> Self {
        let moving = |&twist: &Twist| ReferenceJoint {
            parent_from_joint: Pose::identity(),
            twist_in_joint: Some(twist),
            is_upward: false,
            is_written: false,
        };
        let mut joints: Vec<ReferenceJoint> = chain.twists_in_base.iter().map(moving).collect();
        // The home pose comes last, as in the product of exponentials (Lynch and Park 2017, eq. 4.14).
        joints.push(ReferenceJoint {
            parent_from_joint: chain.base_from_tip_at_zero,
            twist_in_joint: None,
            is_upward: false,
            is_written: false,
        });
        Self { joints }
    }

    /// Number of moving joints: the length of a configuration `q`.
    pub fn joint_count(&self) -> usize {
        self.joints.iter().filter(|joint| joint.twist_in_joint.is_some()).count()
    }

    /// Pose of the tip at joint positions `q`.
    pub fn base_from_tip(&self, q: &ChainQ) -> Pose {
        self.state(q).base_from_tip
    }

    /// The space screws at position zero, and the home pose.
    pub fn screws(&self) -> ScrewChain {
        let ChainState { twists, base_from_tip } = self.state(&ChainQ::zeros(self.joint_count()));
        ScrewChain { twists_in_base: twists, base_from_tip_at_zero: base_from_tip }
    }

    pub(super) fn state(&self, q: &ChainQ) -> ChainState {
        let mut pose = Pose::identity();
        let mut twists = Vec::with_capacity(q.len());
        for joint in &self.joints {
            // First the constant transform, then the joint's own motion, as a URDF defines it.
            pose = pose * joint.step();
            if let Some(twist) = joint.twist_in_joint {
                // The number of screws so far is the number of the coordinate.
                let position = q[twists.len()];
                twists.push(twist.transformed_by(&pose));
                pose = pose * twist.exp(position);
            }
        }
        ChainState { twists, base_from_tip: pose }
    }

    /// The pose before a joint's constant transform in the base, and that of the tip behind it.
    pub(super) fn around(&self, joint: usize, q: &ChainQ) -> (Pose, Pose) {
        let (mut before, mut behind) = (Pose::identity(), Pose::identity());
        let mut coordinate = 0;
        for (at, each) in self.joints.iter().enumerate() {
            let part = if at <= joint { &mut before } else { &mut behind };
            if at != joint {
                *part = *part * each.step();
            }
            if let Some(twist) = each.twist_in_joint {
                // A joint moves behind its own constant transform.
                let part = if at < joint { &mut before } else { &mut behind };
                *part = *part * twist.exp(q[coordinate]);
                coordinate += 1;
            }
        }
        (before, behind)
    }

    /// Whether a joint's constant transform changes anything.
    pub(super) fn is_identity(&self, joint: usize) -> bool {
        let Pose { rotation, translation } = self.joints[joint].parent_from_joint;
        rotation == Matrix3::identity() && translation.norm() == 0.0
    }
}
