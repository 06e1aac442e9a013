//! What is missing for which use: the findings that stop it, and what it goes on without.

use congruent_description::{Finding, Joint, Link, Robot, RobotDescription, Use};
use schemars::JsonSchema;
use serde::Serialize;

use super::parts::stated;

/// Whether a robot is fit for a use.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct UseSummary {
    /// The use.
    #[serde(rename = "use")]
    pub needed_for: Use,
    /// Whether nothing stops it.
    pub is_ready: bool,
    /// What stops it.
    pub stopped_by: Vec<Finding>,
    /// What is not stated, so that commands do without it.
    pub missing: Vec<Missing>,
}

/// What is not stated.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Missing {
    /// What it is, and what follows from it.
    pub what: &'static str,
    /// The links or joints that lack it; empty if it is about the robot as a whole.
    pub names: Vec<String>,
}

/// All uses, in the order in which they need more of a description.
pub(super) fn uses(description: &RobotDescription) -> Vec<UseSummary> {
    [Use::Kinematics, Use::Clearance, Use::Physics].map(|each| of_use(description, each)).into()
}

fn of_use(description: &RobotDescription, needed_for: Use) -> UseSummary {
    let stopped_by = description.for_use(needed_for).err().unwrap_or_default();
    UseSummary {
        needed_for,
        is_ready: stopped_by.is_empty(),
        stopped_by: stopped_by.iter().map(Finding::from).collect(),
        missing: match needed_for {
            Use::Kinematics => for_kinematics(description),
            // Shapes that cannot be read are no shapes that are missing.
            Use::Clearance if stopped_by.is_empty() => for_clearance(&description.robot),
            Use::Clearance => Vec::new(),
            Use::Physics => for_physics(description),
        },
    }
}

fn for_kinematics(description: &RobotDescription) -> Vec<Missing> {
    let mut missing = Vec::new();
    if description.dh.is_none() {
        missing.push(Missing {
            what: "no [dh] table: `check` compares the URDF with the physics alone",
            names: Vec::new(),
        });
    }
    if description.robot.dof() == 0 {
        missing.push(Missing { what: "no joint moves", names: Vec::new() });
    }
    let is_beyond = |joint: &Joint| {
        let range = joint.position_range().filter(|_| joint.mimic.is_none());
        range.is_some_and(|(lower, upper)| !(lower..=upper).contains(&0.0))
    };
    missing.extend(of_joints(&description.robot, "position 0 is outside of the limits", is_beyond));
    missing
}

fn for_clearance(robot: &Robot) -> Vec<Missing> {
    if robot.links().iter().all(|link| link.collisions.is_empty()) {
        let what = "no link has a collision shape: there is nothing to measure";
        return vec![Missing { what, names: Vec::new() }];
    }
    let lacks = |link: &Link| link.collisions.is_empty() && !link.visuals.is_empty();
    of_links(robot, "shown, but without a collision shape: nothing can touch it", lacks).into_iter().collect()
}

fn for_physics(description: &RobotDescription) -> Vec<Missing> {
    let robot = &description.robot;
    let drives = |joint: &Joint| joint.kind.is_movable() && joint.mimic.is_none();
    let no_speed =
        |joint: &Joint| drives(joint) && stated(joint.limit.and_then(|limit| limit.velocity)).is_none();
    let no_effort =
        |joint: &Joint| drives(joint) && stated(joint.limit.and_then(|limit| limit.effort)).is_none();
    let has_body = |link: &Link| !(link.visuals.is_empty() && link.collisions.is_empty());
    let no_mass = |link: &Link| has_body(link) && link.inertia.is_none();
    let missing = [
        some("moves without any mass: cannot be simulated with forces", massless(robot)),
        of_joints(robot, "no limit of speed is stated", no_speed),
        of_joints(robot, "no limit of effort is stated", no_effort),
        of_links(robot, "has a shape, but no <inertial>: its mass counts as 0", no_mass),
    ];
    missing.into_iter().flatten().collect()
}

/// Links that a joint moves although they and all that they carry have no mass.
fn massless(robot: &Robot) -> Vec<String> {
    let mut carried_kg: Vec<f64> =
        robot.links().iter().map(|link| link.inertia.map_or(0.0, |inertia| inertia.mass_kg)).collect();
    // Children come after their parents, so that from the end each sum is complete if it is used.
    for joint in robot.joints().iter().rev() {
        let carried = carried_kg[joint.child.get()];
        carried_kg[joint.parent.get()] += carried;
    }
    let moved = robot.joints().iter().filter(|joint| joint.kind.is_movable());
    let massless = moved.filter(|joint| carried_kg[joint.child.get()] <= 0.0);
    massless.map(|joint| robot.link(joint.child).name.clone()).collect()
}

fn of_joints(robot: &Robot, what: &'static str, lacks: impl Fn(&Joint) -> bool) -> Option<Missing> {
    let names = robot.joints().iter().filter(|joint| lacks(joint)).map(|joint| joint.name.clone());
    some(what, names.collect())
}

fn of_links(robot: &Robot, what: &'static str, lacks: impl Fn(&Link) -> bool) -> Option<Missing> {
    let names = robot.links().iter().filter(|link| lacks(link)).map(|link| link.name.clone());
    some(what, names.collect())
}

fn some(what: &'static str, names: Vec<String>) -> Option<Missing> {
    (!names.is_empty()).then_some(Missing { what, names })
}
