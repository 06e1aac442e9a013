//! A robot as rigid bodies that joints move relative to each other, prepared for the algorithms.

use congruent_description::{JointKind, JointResistance, LinkIndex, Robot, RobotQ};
use congruent_kinematics::{Pose, Twist, frame_about, rotation_exp};
use nalgebra::{Matrix3, Vector3};

use crate::{
    algebra::rigid::{BodyInertia, JointFrame},
    error::DynamicsError,
    spatial_inertia::SpatialInertia,
};

/// Gravity in the root link unless another is chosen, in m/s^2.
pub const GRAVITY_M_S2: [f64; 3] = [0.0, 0.0, -9.81];

/// A robot as a tree of rigid bodies: each moving joint carries one, the links that fixed joints hold together.
///
/// Vectors go by the robot's moving joints in its own order. Mimic joints are independent, except in
/// [`BodyTree::forward_into`], which keeps their ratio.
///
/// Damping, dry friction and armature are those of the description, gravity is [`GRAVITY_M_S2`].
#[derive(Debug, Clone)]
pub struct BodyTree {
    /// One for each moving joint, parents first.
    pub(crate) bodies: Vec<TreeBody>,
    pub(crate) resistances: Vec<JointResistance>,
    pub(crate) gravity_in_root: Vector3<f64>,
    pub(crate) mimics: Vec<Option<FollowerRatio>>,
    /// The joints without a master.
    pub(crate) independent: Vec<usize>,
    joint_names: Vec<String>,
}

/// The body that one moving joint carries. Its frame has the joint's axis as z and the joint's origin.
#[derive(Debug, Clone)]
pub(crate) struct TreeBody {
    /// The body that the joint moves relative to; `None` for the root.
    pub(crate) parent: Option<usize>,
    /// End of the index range of the bodies that this one carries, which follow it: joints are sorted depth first.
    pub(crate) subtree_end: usize,
    pub(crate) frame: JointFrame,
    pub(crate) inertia: BodyInertia,
    /// Pose in the parent body with the joint at zero.
    pub(crate) parent_from_body: Pose,
    pub(crate) spatial_inertia: SpatialInertia,
    /// Axes of the link that the joint carries; the origins are one.
    pub(crate) body_from_link: Matrix3<f64>,
    pub(crate) link: LinkIndex,
}

/// A coordinate that follows another one rigidly.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FollowerRatio {
    pub(crate) master: usize,
    pub(crate) ratio: f64,
}

/// Positions, speeds and accelerations of all moving joints.
///
/// | field | shape | unit |
/// |---|---|---|
/// | `q` | the robot's dof | rad, m |
/// | `qd` | the robot's dof | rad/s, m/s |
/// | `qdd` | the robot's dof | rad/s^2, m/s^2 |
#[derive(Debug, Clone, Copy)]
pub struct JointMotionState<'a> {
    /// Joint positions, rad or m.
    pub q: &'a RobotQ,
    /// Joint speeds, rad/s or m/s.
    pub qd: &'a [f64],
    /// Joint accelerations, rad/s^2 or m/s^2.
    pub qdd: &'a [f64],
}

impl BodyTree {
    /// The bodies of a robot, with the inertias of links that fixed joints connect added up.
    pub fn new(robot: &Robot) -> Self {
        let mut tree = Self {
            bodies: Vec::with_capacity(robot.dof()),
            resistances: Vec::with_capacity(robot.dof()),
            gravity_in_root: Vector3::from(GRAVITY_M_S2),
            mimics: Vec::with_capacity(robot.dof()),
            independent: Vec::new(),
            joint_names: robot.movable_joint_names().map(str::to_owned).collect(),
        };
        // For each link the body that it belongs to, and its pose in it.
        let mut carriers: Vec<(Option<usize>, Pose)> = vec![(None, Pose::identity()); robot.links().len()];
        // Parents come before children, so a parent's carrier is known.
        for joint in robot.joints() {
            let (parent, parent_from_link) = carriers[joint.parent.get()];
            let parent_from_joint = parent_from_link * Pose::from(joint.parent_from_joint);
            carriers[joint.child.get()] = if joint.kind.is_movable() {
                // Each body frame has the joint axis as z: motion and torque of every joint are then one
                // component, without dot products.
                let joint_from_body = Pose::from_parts(frame_about(&joint.axis_in_joint), Vector3::zeros());
                let parent_from_body = parent_from_joint * joint_from_body;
                tree.bodies.push(TreeBody {
                    parent,
                    subtree_end: tree.bodies.len() + 1,
                    frame: JointFrame::new(joint.kind, &parent_from_body),
                    inertia: BodyInertia::ZERO,
                    parent_from_body,
                    spatial_inertia: SpatialInertia::zero(),
                    body_from_link: joint_from_body.rotation.transpose(),
                    link: joint.child,
                });
                tree.resistances.push(JointResistance::from(joint));
                tree.mimics.push(joint.mimic.and_then(|mimic| {
                    Some(FollowerRatio { master: robot.coordinate(mimic.master)?, ratio: mimic.multiplier })
                }));
                (Some(tree.bodies.len() - 1), joint_from_body.inverse())
            } else {
                // A fixed joint makes no body: its link belongs to the parent's.
                (parent, parent_from_joint)
            };
        }
        // After all bodies are there; links on the root are at rest and add to no torque.
        for (link, (body, body_from_link)) in robot.links().iter().zip(carriers) {
            if let (Some(body), Some(inertia)) = (body, &link.inertia) {
                let inertia = SpatialInertia::from_link(inertia).transformed_by(&body_from_link);
                let sum = tree.bodies[body].spatial_inertia + inertia;
                tree.bodies[body].set_inertia(sum);
            }
        }
        // From the tip, so that the end of a subtree is known before its parent asks for it.
        for joint in (0..tree.dof()).rev() {
            if let Some(parent) = tree.bodies[joint].parent {
                tree.bodies[parent].subtree_end =
                    tree.bodies[parent].subtree_end.max(tree.bodies[joint].subtree_end);
            }
        }
        tree.independent = (0..tree.dof()).filter(|&joint| tree.mimics[joint].is_none()).collect();
        tree
    }

    /// The same robot under another gravity, in the axes of the root link.
    #[must_use]
    pub fn with_gravity(mut self, gravity_in_root_m_s2: Vector3<f64>) -> Self {
        self.gravity_in_root = gravity_in_root_m_s2;
        self
    }

    /// The same robot with other resistances.
    ///
    /// # Errors
    /// [`DynamicsError::Length`] if there is not one for each moving joint.
    pub fn with_resistances(mut self, resistances: Vec<JointResistance>) -> Result<Self, DynamicsError> {
        if resistances.len() != self.dof() {
            let (expected, found) = (self.dof(), resistances.len());
            return Err(DynamicsError::Length { what: "resistances", expected, found });
        }
        self.resistances = resistances;
        Ok(self)
    }

    /// The same robot without damping, dry friction and armature.
    #[must_use]
    pub fn without_resistances(mut self) -> Self {
        self.resistances.fill(JointResistance::default());
        self
    }

    /// The same robot with every joint free of its master.
    #[must_use]
    pub fn with_independent_mimics(mut self) -> Self {
        self.mimics.fill(None);
        self.independent = (0..self.dof()).collect();
        self
    }

    /// Damping, dry friction and armature of each joint.
    pub fn resistances(&self) -> &[JointResistance] {
        &self.resistances
    }

    /// Number of moving joints, mimic joints included.
    pub fn dof(&self) -> usize {
        self.bodies.len()
    }

    /// The joints that follow no other, among the moving ones.
    pub fn driven_joints(&self) -> &[usize] {
        &self.independent
    }

    /// Whether the body of a moving joint moves with another moving joint, or is the one that this joint carries.
    ///
    /// # Panics
    /// If there is no such joint.
    pub fn carries(&self, joint: usize, body: usize) -> bool {
        (joint..self.bodies[joint].subtree_end).contains(&body)
    }

    /// The link that a moving joint carries, in whose frame the inertia of its body is given.
    ///
    /// # Panics
    /// If there is no such joint.
    pub fn link(&self, joint: usize) -> LinkIndex {
        self.bodies[joint].link
    }

    /// The inertia of the body that a moving joint carries, in the frame of [`BodyTree::link`].
    ///
    /// # Panics
    /// If there is no such joint.
    pub fn inertia_in_link(&self, joint: usize) -> SpatialInertia {
        let body = &self.bodies[joint];
        body.spatial_inertia.transformed_by(&body.link_from_body())
    }

    /// The same robot with other inertias of its bodies, in the frames of [`BodyTree::link`].
    ///
    /// # Errors
    /// [`DynamicsError::Length`] if there is not one for each moving joint.
    pub fn with_inertias_in_links(mut self, inertias: &[SpatialInertia]) -> Result<Self, DynamicsError> {
        if inertias.len() != self.dof() {
            let (expected, found) = (self.dof(), inertias.len());
            return Err(DynamicsError::Length { what: "inertias", expected, found });
        }
        for (body, inertia) in self.bodies.iter_mut().zip(inertias) {
            body.set_inertia(inertia.transformed_by(&body.link_from_body().inverse()));
        }
        Ok(self)
    }

    pub(crate) fn no_inertia(&self, joint: usize) -> DynamicsError {
        DynamicsError::NoInertia { joint: self.joint_names[joint].clone() }
    }

    pub(crate) fn has_mimics(&self) -> bool {
        self.independent.len() < self.dof()
    }
}

impl TreeBody {
    fn set_inertia(&mut self, inertia: SpatialInertia) {
        self.spatial_inertia = inertia;
        self.inertia = BodyInertia::from(&inertia);
    }

    /// Pose in the parent's frame at a position.
    pub(crate) fn parent_from_body_at(&self, q: f64) -> Pose {
        let (angle_rad, shift_m) = if self.frame.turns { (q, 0.0) } else { (0.0, q) };
        let along = Pose::from_parts(rotation_exp(&(Vector3::z() * angle_rad)), Vector3::z() * shift_m);
        self.parent_from_body * along
    }

    /// A unit of the joint's motion, in the body's frame.
    pub(crate) fn axis(&self) -> Twist {
        let (zero, z) = (Vector3::zeros(), Vector3::z());
        if self.frame.turns { Twist { angular: z, linear: zero } } else { Twist { angular: zero, linear: z } }
    }

    pub(crate) fn link_from_body(&self) -> Pose {
        Pose::from_parts(self.body_from_link.transpose(), Vector3::zeros())
    }
}

impl JointFrame {
    fn new(kind: JointKind, parent_from_body: &Pose) -> Self {
        Self {
            turns: kind.is_angular(),
            parent_from_body: parent_from_body.rotation.into(),
            body_from_parent: parent_from_body.rotation.transpose().into(),
            origin: parent_from_body.translation.into(),
        }
    }
}
