//! The part of rapier that belongs to one robot: its sets, and one slot for each movable joint.

use rapier3d_f64::prelude::{
    BroadPhaseBvh, CCDSolver, ColliderSet, ImpulseJointSet, IslandManager, JointAxis, MultibodyJointSet,
    NarrowPhase, RigidBodySet, SoftBodySet,
};

/// Everything that a step changes; a clone is a snapshot.
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
}

/// Properties of one movable joint; unit of the coordinate, N m or N.
#[derive(Debug, Clone, Copy)]
pub(crate) struct EngineSlot {
    pub axis: JointAxis,
    pub lower: f64,
    pub upper: f64,
    /// Largest force or torque; `f64::MAX` if there is no limit.
    pub effort: f64,
    pub is_mimic: bool,
}
