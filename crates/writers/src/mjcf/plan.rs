//! Which links are bodies, and which joints move each.
//!
//! MuJoCo refuses bodies that move without mass, which a URDF needs between two joints that meet. There, as in every MJCF, the
//! joints are those of one body, and act in their order. The reader makes such links again, as `BODY (before JOINT)`.

use congruent_description::{Inertia, Joint, JointIndex, Link, LinkIndex, Robot, principal_moments};
use nalgebra::{Isometry3, UnitQuaternion, Vector3};

use super::world::WORLD;

/// The most degrees of freedom of a body. Source: `mjCBody::Compile` of MuJoCo 4.0.
const MOST_JOINTS: usize = 6;

/// Mass and moment of a body that moves with none, kg and kg m^2: MuJoCo demands 1e-15 (`mjMINVAL`), the real parts have 1e-3.
pub(crate) const LEAST: f64 = 1e-12;

/// A link that is written as a body.
#[derive(Debug, Clone)]
pub(crate) struct BodyPlan {
    pub(crate) link: LinkIndex,
    /// The link that carries it.
    pub(crate) parent: LinkIndex,
    /// Pose in the parent with all joints at zero.
    pub(crate) parent_from_body: Isometry3<f64>,
    /// The joints that move it, the one nearest to the parent first; empty for a fixed link.
    pub(crate) joints: Vec<PlannedJoint>,
}

/// A joint of a body.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlannedJoint {
    pub(crate) index: JointIndex,
    /// Frame of the joint in the body at zero.
    pub(crate) body_from_joint: Isometry3<f64>,
}

/// The bodies of a robot, parents before children. The root is one too unless it is the world itself; its parent is itself.
pub(crate) fn bodies(robot: &Robot) -> Vec<BodyPlan> {
    let mut is_merged = vec![false; robot.links().len()];
    let mut children = vec![0; robot.links().len()];
    for joint in robot.joints() {
        children[joint.parent.get()] += 1;
    }
    let tree = PlannedTree { robot, children, has_mass: has_mass(robot) };
    let mut plans = Vec::new();
    // From the end, since a body takes the links before it.
    for link in robot.joints().iter().rev().map(|joint| joint.child) {
        if let Some(joint) = robot.parent_joint(link).filter(|_| !is_merged[link.get()]) {
            plans.push(planned(&tree, joint, &mut is_merged));
        }
    }
    let root = robot.root();
    if robot.link(root).name != WORLD {
        let parent_from_body = Isometry3::identity();
        plans.push(BodyPlan { link: root, parent: root, parent_from_body, joints: Vec::new() });
    }
    plans.reverse();
    plans
}

/// A robot with what decides which links are bodies.
struct PlannedTree<'a> {
    robot: &'a Robot,
    /// How many joints each link carries.
    children: Vec<usize>,
    has_mass: Vec<bool>,
}

fn planned(tree: &PlannedTree<'_>, last: JointIndex, is_merged: &mut [bool]) -> BodyPlan {
    let robot = tree.robot;
    let body = robot.joint(last).child;
    let mut at = robot.joint(last);
    let mut link_from_body = at.parent_from_joint;
    let mut joints = Vec::new();
    if at.kind.is_movable() {
        joints.push(PlannedJoint { index: last, body_from_joint: Isometry3::identity() });
    }
    while let Some(above) = taken(tree, at, &joints, body) {
        is_merged[at.parent.get()] = true;
        joints.push(PlannedJoint { index: above, body_from_joint: link_from_body.inverse() });
        at = robot.joint(above);
        link_from_body = at.parent_from_joint * link_from_body;
    }
    joints.reverse();
    BodyPlan { link: body, parent: at.parent, parent_from_body: link_from_body, joints }
}

/// The joint of the link above, if that link needs no body of its own.
fn taken(tree: &PlannedTree<'_>, at: &Joint, joints: &[PlannedJoint], body: LinkIndex) -> Option<JointIndex> {
    let PlannedTree { robot, children, has_mass } = tree;
    let above = robot.parent_joint(at.parent)?;
    let link = robot.link(at.parent);
    let is_frame_of_joints =
        robot.joint(above).kind.is_movable() && is_frame(link) && children[at.parent.get()] == 1;
    if !is_frame_of_joints || joints.len() == MOST_JOINTS {
        return None;
    }
    // Below a fixed joint such a link is a body of no mass, which is allowed, unless the reader has made it of an axis beside
    // the origin of its body.
    let is_axis = || {
        let made = format!("{} (axis of {})", robot.link(at.child).name, robot.joint(above).name);
        link.name == made && at.parent_from_joint.rotation == UnitQuaternion::identity()
    };
    // Of a robot without masses every link is a body: they get as good as none, and keep their names.
    let is_between = at.kind.is_movable() && has_mass[body.get()];
    (is_between || (joints.is_empty() && is_axis())).then_some(above)
}

/// Whether the reader makes the link below a joint of a body as it is: parallel to the body, and on the axis of the joint.
pub(crate) fn keeps_frame(robot: &Robot, joint: &PlannedJoint) -> bool {
    let pose = &joint.body_from_joint;
    let is_on_axis =
        robot.joint(joint.index).kind.is_angular() || pose.translation.vector == Vector3::zeros();
    is_on_axis && pose.rotation == UnitQuaternion::identity()
}

/// For each link whether it, or one that is fixed to it, has mass and inertia enough for MuJoCo.
pub(crate) fn has_mass(robot: &Robot) -> Vec<bool> {
    let is_massive = |of: Inertia| of.mass_kg >= LEAST && principal_moments(&of.tensor_kg_m2)[0] >= LEAST;
    let mut has_mass: Vec<bool> =
        robot.links().iter().map(|link| link.inertia.is_some_and(is_massive)).collect();
    // Parents are before their children, so from the end a fixed link passes its mass on before its parent is judged.
    for joint in robot.joints().iter().rev().filter(|joint| !joint.kind.is_movable()) {
        has_mass[joint.parent.get()] |= has_mass[joint.child.get()];
    }
    has_mass
}

/// What the reader calls the link between two joints of a body.
pub(crate) fn before_name(body: &str, joint: &str) -> String {
    format!("{body} (before {joint})")
}

/// Whether a link has neither mass nor shapes.
fn is_frame(link: &Link) -> bool {
    let is_massless = link.inertia.is_none_or(|of| of.mass_kg == 0.0 && of.tensor_kg_m2.amax() == 0.0);
    is_massless && link.visuals.is_empty() && link.collisions.is_empty()
}
