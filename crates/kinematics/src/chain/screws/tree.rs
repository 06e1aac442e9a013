//! Forward kinematics by products of exponentials (POE): screws and home poses in the root frame.
//!
//! It takes axes and origins from the description and shares no step with `chain/urdf.rs`, so that
//! the two can be compared.

use congruent_description::{JointIndex, JointKind, LinkIndex, Robot, RobotQ};
use nalgebra::{Isometry3, Point3};

use crate::{
    error::KinematicsError,
    spatial::{pose::Pose, twist::Screw},
};

/// A robot as space screws at position zero and home poses of its links.
///
/// `root_from_link(q) = exp([S_1] q_1) ... exp([S_k] q_k) root_from_link(0)` over the moving joints
/// above the link.
///
/// Joints go by their own entry of the configuration vector, mimic joints too:
/// [`Robot::apply_mimic`] makes those follow their masters.
///
/// # Examples
/// A turn about the vertical axis through (0.6, 0, 0), which carries a tool at (1, 0, 0):
/// ```
/// # use congruent_description::{JointKind, JointParts, Link, Robot};
/// # use nalgebra::{Isometry3, Vector3};
/// use congruent_description::RobotQ;
/// use congruent_kinematics::ScrewTree;
/// # let link = |name: &str| Link { name: name.into(), ..Link::default() };
/// # let at = |x: f64| Isometry3::translation(x, 0., 0.);
/// # let robot = Robot::new("r", vec![link("base"), link("arm"), link("tool")], vec![
/// #     JointParts::new("turn", JointKind::Continuous, "base", "arm", at(0.6)),
/// #     JointParts::new("flange", JointKind::Fixed, "arm", "tool", at(0.4))]).unwrap();
/// let screws = ScrewTree::new(&robot);
/// let turn = screws.screw(robot.find_joint("turn").unwrap()).unwrap();
/// assert_eq!(turn.twist().linear, Vector3::new(0., -0.6, 0.));
/// let tool = robot.find_link("tool").unwrap();
/// let quarter_turn = RobotQ::from([std::f64::consts::FRAC_PI_2]);
/// let root_from_tool = screws.root_from_link(&quarter_turn, tool)?;
/// assert!((root_from_tool.translation - Vector3::new(0.6, 0.4, 0.)).norm() < 4.0 * f64::EPSILON);
/// # Ok::<(), congruent_kinematics::KinematicsError>(())
/// ```
#[derive(Debug, Clone)]
pub struct ScrewTree {
    /// Joints in the order of the robot, parents first.
    joints: Vec<ScrewJoint>,
    /// For each link the joint above it; `None` for the root.
    parent_joints: Vec<Option<usize>>,
    /// For each link `root_from_link` at position zero.
    homes: Vec<Pose>,
    dof: usize,
}

#[derive(Debug, Clone)]
struct ScrewJoint {
    parent: usize,
    child: usize,
    /// Coordinate and screw; `None` for a fixed joint.
    motion: Option<(usize, Screw)>,
}

impl ScrewTree {
    /// Computes the screws and home poses of a robot.
    pub fn new(robot: &Robot) -> Self {
        let mut homes = vec![Isometry3::identity(); robot.links().len()];
        let mut parent_joints = vec![None; robot.links().len()];
        let mut joints = Vec::with_capacity(robot.joints().len());
        for (index, joint) in robot.joints().iter().enumerate() {
            let (parent, child) = (joint.parent.get(), joint.child.get());
            let root_from_joint = homes[parent] * joint.parent_from_joint;
            homes[child] = root_from_joint;
            parent_joints[child] = Some(index);
            let axis_in_root = root_from_joint.rotation * joint.axis_in_joint;
            let joint_in_root = Point3::from(root_from_joint.translation.vector);
            let screw = match joint.kind {
                JointKind::Fixed => None,
                JointKind::Revolute | JointKind::Continuous => {
                    Some(Screw::revolute(axis_in_root, &joint_in_root))
                }
                JointKind::Prismatic => Some(Screw::prismatic(axis_in_root)),
            };
            let coordinate = robot.parent_joint(joint.child).and_then(|index| robot.coordinate(index));
            joints.push(ScrewJoint { parent, child, motion: coordinate.zip(screw) });
        }
        let homes = homes.into_iter().map(Pose::from).collect();
        Self { joints, parent_joints, homes, dof: robot.dof() }
    }

    /// The space screw of a joint at position zero, in the root frame; `None` for a fixed joint.
    ///
    /// # Panics
    /// When `joint` is a joint of a larger robot.
    pub fn screw(&self, joint: JointIndex) -> Option<&Screw> {
        self.joints[joint.get()].motion.as_ref().map(|(_, screw)| screw)
    }

    /// `root_from_link` at position zero, in metres.
    ///
    /// # Panics
    /// When `link` is a link of a larger robot.
    pub fn home(&self, link: LinkIndex) -> &Pose {
        &self.homes[link.get()]
    }

    /// Poses of all links in the root link.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `q` | the robot's dof | rad, m | order of [`Robot::movable_joints`] |
    /// | `root_from_links` | number of links | m | order of [`Robot::links`] |
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), eq. 4.14 (space form), one product per branch.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] or [`KinematicsError::PoseCount`] when a length is wrong.
    /// # Examples
    /// See [`ScrewTree`].
    pub fn root_from_links_into(
        &self,
        q: &RobotQ,
        root_from_links: &mut [Pose],
    ) -> Result<(), KinematicsError> {
        KinematicsError::check_joints(self.dof, q)?;
        KinematicsError::check_poses(self.homes.len(), root_from_links)?;
        // First the products of exponentials alone: a child continues the product of its parent, which a home pose in between
        // would spoil. Then every product is multiplied by its home pose.
        root_from_links[0] = Pose::identity();
        for joint in &self.joints {
            let above = root_from_links[joint.parent];
            root_from_links[joint.child] = match &joint.motion {
                Some((coordinate, screw)) => above * screw.exp(q[*coordinate]),
                None => above,
            };
        }
        for (pose, home) in root_from_links.iter_mut().zip(&self.homes) {
            *pose = *pose * *home;
        }
        Ok(())
    }

    /// Pose of one link in the root link.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `q` | the robot's dof | rad, m | order of [`Robot::movable_joints`] |
    /// | result | SE(3) | m | `root_from_link` |
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), eq. 4.14 (space form).
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when `q` is no configuration vector of the robot.
    /// # Panics
    /// When `link` is a link of a larger robot.
    /// # Examples
    /// See [`ScrewTree`].
    pub fn root_from_link(&self, q: &RobotQ, link: LinkIndex) -> Result<Pose, KinematicsError> {
        KinematicsError::check_joints(self.dof, q)?;
        let mut pose = self.homes[link.get()];
        let mut above = link.get();
        // From the link upwards: screws in the root's frame multiply from the left, the nearest to the link first.
        while let Some(joint) = self.parent_joints[above] {
            let joint = &self.joints[joint];
            if let Some((coordinate, screw)) = &joint.motion {
                pose = screw.exp(q[*coordinate]) * pose;
            }
            above = joint.parent;
        }
        Ok(pose)
    }
}
