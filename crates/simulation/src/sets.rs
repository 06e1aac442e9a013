//! The part of rapier that belongs to one robot: its sets, and one slot for each movable joint.

use rapier3d_f64::prelude::{
    BroadPhaseBvh, CCDSolver, ColliderSet, ImpulseJointSet, IslandManager, JointAxis, MultibodyJointSet,
    NarrowPhase, Pose, RigidBodyHandle, RigidBodySet, SoftBodySet,
};

use crate::{contact::near::NearShapes, drive::DriveCapability};

/// Everything that a step or a change of the robot changes; a clone is a snapshot.
#[derive(Clone, Default)]
pub(crate) struct EngineSets {
    pub bodies: RigidBodySet,
    pub colliders: ColliderSet,
    pub multibody_joints: MultibodyJointSet,
    pub impulse_joints: ImpulseJointSet,
    pub soft_bodies: SoftBodySet,
    pub islands: IslandManager,
    pub broad_phase: BroadPhaseBvh,
    pub narrow_phase: NarrowPhase,
    pub ccd: CCDSolver,
    pub near: NearShapes,
    /// The joints' own damping: rapier's has that of the servos in addition.
    pub damping: Vec<f64>,
}

/// Properties of one movable joint; unit of the coordinate, N m or N.
#[derive(Debug, Clone, Copy)]
pub(crate) struct EngineSlot {
    pub axis: JointAxis,
    pub lower: f64,
    pub upper: f64,
    pub capability: DriveCapability,
    pub is_mimic: bool,
}

/// An obstacle that moves in the next step, by its poses before and after.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ObstacleMove {
    pub body: RigidBodyHandle,
    pub before: Pose,
    pub after: Pose,
}
