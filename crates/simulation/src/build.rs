//! From a robot to a rapier multibody: one rapier body for each lumped body, one multibody joint
//! for each movable joint, inserted in the order of `Robot::movable_joints`.
//!
//! Insertion order is row order, so body `i + 1`, multibody link `i + 1` and coordinate `i` are
//! one and the same joint throughout the crate.

use std::collections::BTreeMap;

use congruent_description::{Inertia, Joint, JointIndex, Mimic, Obstacle, Robot};
use nalgebra::Isometry3;
use rapier3d_f64::{
    dynamics::MultibodyDofCoupling,
    prelude::{
        Collider, ColliderHandle, GenericJoint, JointAxesMask, JointAxis, MultibodyIndex, Pose,
        RigidBodyBuilder, RigidBodyHandle,
    },
};

use crate::{
    adapter,
    contact::{near::NearShapes, shapes},
    drive::DriveCapability,
    error::SimulationError,
    lumping::Bodies,
    sets::{EngineSets, EngineSlot},
    settings::WorldSettings,
};

/// Most movable joints. A pose costs the engine 6 n^2 entries of Jacobians in time and memory, and a check sets 4 n of them:
/// 4 s for a chain of 300, 16 s for one of 500. A humanoid with two hands has 100. Kind: choice.
pub(crate) const MOST_JOINTS: usize = 300;

/// A robot in rapier's sets.
pub(crate) struct Built {
    pub sets: EngineSets,
    pub handles: Vec<RigidBodyHandle>,
    pub slots: Vec<EngineSlot>,
    /// The bodies of obstacles that may move, by the number of the obstacle.
    pub moving: BTreeMap<usize, RigidBodyHandle>,
    /// `None` for a robot without a movable joint, for which rapier makes no multibody.
    pub multibody: Option<MultibodyIndex>,
}

pub(crate) fn build(
    robot: &Robot,
    bodies: &Bodies,
    settings: &WorldSettings,
) -> Result<Built, SimulationError> {
    let mut sets = EngineSets::default();
    let handles: Vec<RigidBodyHandle> = bodies
        .inertias
        .iter()
        .enumerate()
        .map(|(body, inertia)| sets.bodies.insert(rigid_body(body, inertia)))
        .collect();
    let mut moving = BTreeMap::new();
    // Without obstacles nothing can touch: links never collide with each other.
    if settings.contacts && !settings.obstacles.is_empty() {
        let links = add_colliders(&mut sets, shapes::link_colliders(robot, bodies, settings)?, &handles);
        let standing;
        (moving, standing) = add_obstacles(&mut sets, settings)?;
        // Obstacles that move would have to be followed: beside one, all shapes stay as they are.
        if moving.is_empty() {
            sets.near = NearShapes::new(&sets.colliders, &links, &standing);
        }
    }
    let slots = slots(robot, settings)?;
    // In the order of movable joints: rapier numbers links in the order of insertion, with the root as 0, and
    // everything else counts on link `i + 1` being coordinate `i`.
    for (slot, &index) in slots.iter().zip(robot.movable_joints()) {
        let joint = robot.joint(index);
        let (parent, child) = (bodies.links[joint.parent.get()].body, bodies.links[joint.child.get()].body);
        let data = generic_joint(joint, bodies, slot);
        let inserted = sets.multibody_joints.insert(handles[parent], handles[child], data, true);
        assert!(inserted.is_some(), "a tree has no second path to a body");
    }
    // Masses are zero until this is called.
    for &handle in &handles {
        let body = sets.bodies.get_mut(handle).expect("the body was inserted above");
        body.recompute_mass_properties_from_colliders(&sets.colliders);
    }
    let multibody = sets.multibody_joints.rigid_body_link(handles[0]).map(|link| link.multibody);
    sets.damping = robot.movable_joints().iter().map(|&joint| robot.joint(joint).damping).collect();
    if let Some(index) = multibody {
        finish_multibody(&mut sets, index, robot, &slots);
    }
    Ok(Built { sets, handles, slots, moving, multibody })
}

fn rigid_body(body: usize, inertia: &Inertia) -> RigidBodyBuilder {
    if body == 0 {
        return RigidBodyBuilder::fixed();
    }
    let mass_properties = adapter::mass_properties(inertia);
    // Forces are added without waking a body, so none may sleep.
    RigidBodyBuilder::dynamic().additional_mass_properties(mass_properties).can_sleep(false)
}

fn add_colliders(
    sets: &mut EngineSets,
    colliders: Vec<(usize, Collider)>,
    handles: &[RigidBodyHandle],
) -> Vec<ColliderHandle> {
    let insert = |(body, collider): (usize, Collider)| {
        sets.colliders.insert_with_parent(collider, handles[body], &mut sets.bodies)
    };
    colliders.into_iter().map(insert).collect()
}

/// Obstacles that stand still are colliders alone; those that may move hang on bodies whose poses are given.
fn add_obstacles(
    sets: &mut EngineSets,
    settings: &WorldSettings,
) -> Result<(BTreeMap<usize, RigidBodyHandle>, Vec<ColliderHandle>), SimulationError> {
    let (mut moving, mut standing) = (BTreeMap::new(), Vec::new());
    for (index, obstacle) in settings.obstacles.iter().enumerate() {
        if settings.moving_obstacles.contains(&index) {
            // Its pose is that of its body; a collider with the same pose would have it twice.
            let at_origin = Obstacle { world_from_obstacle: Isometry3::identity(), ..obstacle.clone() };
            let Some(collider) = shapes::obstacle_collider(index, &at_origin, settings)? else { continue };
            let pose = adapter::pose(&obstacle.world_from_obstacle);
            let body = sets.bodies.insert(RigidBodyBuilder::kinematic_position_based().pose(pose));
            sets.colliders.insert_with_parent(collider, body, &mut sets.bodies);
            moving.insert(index, body);
        } else if let Some(collider) = shapes::obstacle_collider(index, obstacle, settings)? {
            standing.push(sets.colliders.insert(collider));
        }
    }
    Ok((moving, standing))
}

fn slots(robot: &Robot, settings: &WorldSettings) -> Result<Vec<EngineSlot>, SimulationError> {
    let mut slots =
        robot.movable_joints().iter().map(|&joint| slot(robot, joint)).collect::<Result<Vec<_>, _>>()?;
    if !settings.actuator_limits {
        for slot in &mut slots {
            // Not infinite: products with 0 would be NaN.
            slot.capability = DriveCapability { effort: f64::MAX, speed: f64::MAX };
        }
    }
    for (row, &joint) in robot.movable_joints().iter().enumerate() {
        if let Some(mimic) = robot.joint(joint).mimic {
            let master = robot.coordinate(mimic.master).expect("a mimicked joint moves");
            let (lower, upper) = (slots[row].lower, slots[row].upper);
            (slots[row].lower, slots[row].upper) = (f64::NEG_INFINITY, f64::INFINITY);
            slots[master].narrow(lower, upper, &mimic);
        }
    }
    Ok(slots)
}

impl EngineSlot {
    /// Makes a master stop if one of its followers has to. Two limits on coupled joints would
    /// be one constraint twice, with which the solver converges slowly: 1e-12 instead of 1e-15.
    fn narrow(&mut self, lower: f64, upper: f64, mimic: &Mimic) {
        // A negative multiplier swaps the ends; one of 0 gives values that are not used below.
        let [a, b] = [lower, upper].map(|end| (end - mimic.offset) / mimic.multiplier);
        let (lower, upper) = (self.lower.max(a.min(b)), self.upper.min(a.max(b)));
        // Ranges without a common position limit nothing that could be kept.
        if mimic.multiplier != 0.0 && lower <= upper {
            (self.lower, self.upper) = (lower, upper);
        }
    }
}

fn slot(robot: &Robot, index: JointIndex) -> Result<EngineSlot, SimulationError> {
    let joint = robot.joint(index);
    let (lower, upper) = joint.position_range().unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
    let ordered = lower <= upper;
    if !ordered {
        let (joint_name, unit) = (joint.name.clone(), joint.kind.unit());
        return Err(SimulationError::Limits { joint: joint_name, lower, upper, unit });
    }
    // Zero is what descriptions write for unknown.
    let largest =
        |limit: Option<f64>| limit.filter(|&limit| limit > 0.0).map_or(f64::MAX, |limit| limit.min(f64::MAX));
    let effort = largest(joint.limit.and_then(|limit| limit.effort));
    let speed = largest(joint.limit.and_then(|limit| limit.velocity));
    Ok(EngineSlot {
        axis: if joint.kind.is_angular() { JointAxis::AngX } else { JointAxis::LinX },
        lower,
        upper,
        capability: DriveCapability { effort, speed },
        is_mimic: joint.mimic.is_some(),
    })
}

/// Joint frames whose x axis is the axis of motion, at the origin of the child link.
fn generic_joint(joint: &Joint, bodies: &Bodies, slot: &EngineSlot) -> GenericJoint {
    let locked = match slot.axis {
        JointAxis::AngX => JointAxesMask::LOCKED_REVOLUTE_AXES,
        _ => JointAxesMask::LOCKED_PRISMATIC_AXES,
    };
    let x_onto_axis =
        Isometry3::from_parts(nalgebra::Translation3::identity(), adapter::x_onto(&joint.axis_in_joint));
    let parent = bodies.links[joint.parent.get()];
    let body_from_joint = adapter::pose(&parent.body_from_link) * adapter::pose(&joint.parent_from_joint);
    let turn: Pose = adapter::pose(&x_onto_axis);
    let mut data = GenericJoint::new(locked);
    // The same turn on both sides, so that at zero the child has its own axes again.
    data.set_local_frame1(body_from_joint * turn).set_local_frame2(turn).set_contacts_enabled(false);
    data
}

/// Damping, friction, armature and couplings, and the first forward kinematics, which also turns the root
/// from free to fixed and so gives the rows their final numbers.
fn finish_multibody(sets: &mut EngineSets, index: MultibodyIndex, robot: &Robot, slots: &[EngineSlot]) {
    let multibody = sets.multibody_joints.get_multibody_mut(index).expect("the multibody exists");
    multibody.set_self_contacts_enabled(false);
    multibody.forward_kinematics(&sets.bodies, true);
    multibody.update_rigid_bodies(&mut sets.bodies, true);
    assert_eq!(multibody.ndofs(), slots.len(), "one degree of freedom for each movable joint");
    for (row, &joint) in robot.movable_joints().iter().enumerate() {
        let joint = robot.joint(joint);
        // rapier starts every angular joint with a damping of 0.1 N m s/rad: always overwrite.
        multibody.damping_mut()[row] = joint.damping;
        multibody.frictions_mut()[row] = joint.friction;
        multibody.armature_mut()[row] = joint.armature.unwrap_or(0.0);
        if let Some(mimic) = joint.mimic {
            let master = robot.coordinate(mimic.master).expect("a mimicked joint moves");
            multibody.add_dof_coupling(MultibodyDofCoupling {
                // Links of the multibody count the root as 0.
                link1: master + 1,
                dof1: 0,
                axis1: slots[master].axis as usize,
                link2: row + 1,
                dof2: 0,
                axis2: slots[row].axis as usize,
                coeff: mimic.multiplier,
                offset: mimic.offset,
            });
        }
    }
}
