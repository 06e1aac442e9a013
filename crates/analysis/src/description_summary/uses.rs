//! What is missing for which use: findings that block it, and values that it does without.

use congruent_description::{Joint, Link, Robot, RobotDescription};
use congruent_input::{Capability, Finding, Findings};
use schemars::JsonSchema;
use serde::Serialize;

use super::parts::stated;

/// Whether a description is complete enough for a use.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct UseSummary {
    /// Kinematics, clearance or physics.
    #[serde(rename = "use")]
    pub needed_for: Capability,
    /// Whether no finding blocks the use.
    pub is_ready: bool,
    /// The findings that block the use.
    pub stopped_by: Vec<Finding>,
    /// Values that are not stated and that commands do without.
    pub missing: Vec<Missing>,
}

/// A value that the description does not state.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Missing {
    /// The value, and the consequence, as a sentence.
    pub what: &'static str,
    /// The links or joints that lack it; empty if it is about the robot as a whole.
    pub names: Vec<String>,
}

/// All uses, in the order in which they need more of a description.
pub(super) fn uses(description: &RobotDescription) -> Vec<UseSummary> {
    [Capability::Kinematics, Capability::Clearance, Capability::Physics]
        .map(|each| use_summary(description, each))
        .into()
}

fn use_summary(description: &RobotDescription, needed_for: Capability) -> UseSummary {
    let stopped_by = description.check_capability(needed_for).err().map_or_else(Vec::new, Findings::into_vec);
    UseSummary {
        needed_for,
        is_ready: stopped_by.is_empty(),
        stopped_by: stopped_by.iter().map(Finding::from).collect(),
        missing: match needed_for {
            Capability::Kinematics => for_kinematics(description),
            // A shape that cannot be read is an error of its own, not a missing shape.
            Capability::Clearance if stopped_by.is_empty() => for_clearance(&description.robot),
            Capability::Clearance => Vec::new(),
            Capability::Physics => for_physics(description),
        },
    }
}

fn for_kinematics(description: &RobotDescription) -> Vec<Missing> {
    let mut missing = Vec::new();
    if description.dh.is_none() {
        missing.push(Missing {
            what: match description.own_model() {
                Some(_) => "no [dh] table: the screws are the robot, and `check --against` gives a second description",
                None if description.places.mjcf.is_some() => "no [dh] table: `check` compares the MJCF with the physics alone",
                None => "no [dh] table: `check` compares the URDF with the physics alone",
            },
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
    missing.extend(missing_at_joints(&description.robot, "position 0 is outside of the limits", is_beyond));
    missing
}

/// What is said of a robot without shapes.
const NOTHING_TO_MEASURE: &str = "nothing to measure: no link has a collision shape";

/// What is said of links that move without a mass.
const MASSLESS: &str = "moves without any mass: cannot be simulated with forces";

impl UseSummary {
    /// Whether the robot can be used so, in words.
    pub fn readiness(&self) -> &'static str {
        let is_massless = self.missing.iter().any(|missing| missing.what == MASSLESS);
        match (self.is_ready, is_massless) {
            (false, _) => "cannot be used",
            (true, true) => "without forces alone, for lack of masses",
            (true, false) => "ready",
        }
    }

    /// Why there is nothing that the use could be ready for.
    pub fn why_nothing(&self) -> Option<&'static str> {
        self.missing.iter().map(|missing| missing.what).find(|what| *what == NOTHING_TO_MEASURE)
    }
}

fn for_clearance(robot: &Robot) -> Vec<Missing> {
    if robot.links().iter().all(|link| link.collisions.is_empty()) {
        return vec![Missing { what: NOTHING_TO_MEASURE, names: Vec::new() }];
    }
    let lacks = |link: &Link| link.collisions.is_empty() && !link.visuals.is_empty();
    missing_at_links(robot, "visual shape without a collision shape: clearance ignores it", lacks)
        .into_iter()
        .collect()
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
        some(MASSLESS, massless(robot)),
        missing_at_joints(robot, "no limit of speed is stated", no_speed),
        missing_at_joints(robot, "no limit of effort is stated", no_effort),
        missing_at_links(robot, "has a shape, but no <inertial>: its mass counts as 0", no_mass),
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

fn missing_at_joints(robot: &Robot, what: &'static str, lacks: impl Fn(&Joint) -> bool) -> Option<Missing> {
    let names = robot.joints().iter().filter(|joint| lacks(joint)).map(|joint| joint.name.clone());
    some(what, names.collect())
}

fn missing_at_links(robot: &Robot, what: &'static str, lacks: impl Fn(&Link) -> bool) -> Option<Missing> {
    let names = robot.links().iter().filter(|link| lacks(link)).map(|link| link.name.clone());
    some(what, names.collect())
}

fn some(what: &'static str, names: Vec<String>) -> Option<Missing> {
    (!names.is_empty()).then_some(Missing { what, names })
}
