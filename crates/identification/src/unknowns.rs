//! What is unknown of a robot, and its place in the vector of unknowns.

use std::ops::Range;

use congruent_dynamics::{BodyTree, PARAMETERS};
use congruent_kinematics::Pose;
use nalgebra::DVector;
use schemars::JsonSchema;
use serde::Serialize;

/// What a joint adds to the torque of the rigid bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum JointUnknown {
    /// Viscous friction, N m s/rad or N s/m.
    Viscous,
    /// Coulomb friction, N m or N.
    Coulomb,
    /// Inertia of motor and gear as the joint feels it, kg m^2 or kg.
    Armature,
    /// A constant effort, as of a sensor that does not read zero, N m or N.
    Offset,
}

impl JointUnknown {
    /// All, in the order of the unknowns.
    pub const ALL: [Self; 4] = [Self::Viscous, Self::Coulomb, Self::Armature, Self::Offset];

    /// Whether it cannot be negative.
    pub(crate) fn is_positive(self) -> bool {
        self != Self::Offset
    }
}

/// Where a payload hangs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PayloadPlace {
    /// The moving joint whose body carries it.
    pub joint: usize,
    /// The frame in which it is reported, in the frame of the link of that joint.
    pub link_from_payload: Pose,
}

/// A group of parameters that is estimated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FreeGroup {
    /// Viscous and Coulomb friction of each joint.
    Friction,
    /// Armature of each joint: inertia of motor and gear.
    Armature,
    /// A body that the description does not have.
    Payload,
    /// The ten inertial parameters of each body.
    Links,
}

/// The parameters that are estimated. Constant efforts of joints always are.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FreeUnknowns {
    /// The groups; a payload needs its place.
    pub groups: Vec<FreeGroup>,
    /// Where a payload hangs.
    pub payload: Option<PayloadPlace>,
}

impl FreeUnknowns {
    pub(crate) fn has_group(&self, group: FreeGroup) -> bool {
        self.groups.contains(&group)
    }

    /// The place of the payload, if one is estimated: with all links free, it is part of one of them.
    pub(crate) fn payload_alone(&self) -> Option<PayloadPlace> {
        let is_alone = self.has_group(FreeGroup::Payload) && !self.has_group(FreeGroup::Links);
        self.payload.filter(|_| is_alone)
    }

    /// Whether a term of the joints is estimated.
    pub(crate) fn has(&self, term: JointUnknown) -> bool {
        match term {
            JointUnknown::Viscous | JointUnknown::Coulomb => self.has_group(FreeGroup::Friction),
            JointUnknown::Armature => self.has_group(FreeGroup::Armature),
            JointUnknown::Offset => true,
        }
    }
}

/// The vector of unknowns: ten inertial parameters of each body, then four terms of each driven joint, then the delay of the efforts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct UnknownOrder {
    pub(crate) bodies: usize,
    /// The driven joints, among the moving ones.
    pub(crate) joints: Vec<usize>,
}

impl UnknownOrder {
    pub(crate) fn len(&self) -> usize {
        self.delay() + 1
    }

    /// By how much efforts are recorded later than the positions of the same time, s: one for all joints.
    pub(crate) fn delay(&self) -> usize {
        PARAMETERS * self.bodies + JointUnknown::ALL.len() * self.joints.len()
    }

    pub(crate) fn body(body: usize) -> Range<usize> {
        PARAMETERS * body..PARAMETERS * (body + 1)
    }

    /// A term of a driven joint, by its number among these.
    pub(crate) fn term(&self, joint: usize, term: JointUnknown) -> usize {
        PARAMETERS * self.bodies + JointUnknown::ALL.len() * joint + term as usize
    }

    /// The unknowns as a description has them; terms of a joint with those of its followers.
    pub(crate) fn nominal(&self, tree: &BodyTree) -> DVector<f64> {
        let mut nominal = DVector::zeros(self.len());
        nominal.rows_mut(0, PARAMETERS * self.bodies).copy_from(&tree.all_parameters());
        for (joint, resistance) in tree.resistances().iter().enumerate() {
            // What brakes a follower brakes its driver.
            let (at, ratio) = tree.driver(joint);
            nominal[self.term(at, JointUnknown::Viscous)] += ratio * ratio * resistance.damping;
            nominal[self.term(at, JointUnknown::Coulomb)] += ratio.abs() * resistance.friction;
            nominal[self.term(at, JointUnknown::Armature)] += ratio * ratio * resistance.armature;
        }
        nominal
    }
}
