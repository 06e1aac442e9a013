//! Forward kinematics of the description itself: joint after joint along the tree.

use congruent_description::{Joint, JointKind, LinkIndex, Robot, RobotQ};
use nalgebra::{Matrix3, Vector3};

use super::{
    jacobian::{columns::Jacobian, kind::JacobianKind},
    sin_cos::{BLOCK, SinCos, SinesCosines},
};
use crate::{
    error::KinematicsError,
    spatial::{pose::Pose, rotation::hat, twist::Twist},
};

/// A robot's tree made ready for forward kinematics of every link.
///
/// Joints go by their own entry of the configuration vector, mimic joints too:
/// [`Robot::apply_mimic`] makes those follow their masters.
///
/// # Examples
/// A lift of 0.2 m that carries an arm:
/// ```
/// # use congruent_description::{JointKind, JointParts, Link, Robot};
/// # use nalgebra::{Isometry3, Vector3};
/// use congruent_description::RobotQ;
/// use congruent_kinematics::{Pose, UrdfTree};
/// # let link = |name: &str| Link { name: name.into(), ..Link::default() };
/// # let at = |x: f64| Isometry3::translation(x, 0., 0.);
/// # let robot = Robot::new("r", vec![link("base"), link("lift"), link("arm"), link("tool")], vec![
/// #     JointParts::new("lift", JointKind::Prismatic, "base", "lift", at(0.)),
/// #     JointParts::new("turn", JointKind::Continuous, "lift", "arm", at(0.)),
/// #     JointParts::new("flange", JointKind::Fixed, "arm", "tool", at(0.5))]).unwrap();
/// let tree = UrdfTree::new(&robot);
/// let q = RobotQ::from([0.2, std::f64::consts::FRAC_PI_2]);
/// let mut root_from_links = [Pose::identity(); 4];
/// tree.root_from_links_into(&q, &mut root_from_links)?;
/// let tool = robot.find_link("tool").unwrap();
/// assert!((root_from_links[tool.get()].translation - Vector3::new(0., 0.5, 0.2)).norm() < 4.0 * f64::EPSILON);
/// assert!((tree.root_from_link(&q, tool)?.translation - Vector3::new(0., 0.5, 0.2)).norm() < 4.0 * f64::EPSILON);
/// # Ok::<(), congruent_kinematics::KinematicsError>(())
/// ```
#[derive(Debug, Clone)]
pub struct UrdfTree {
    /// Joints in the order of the robot, parents first.
    joints: Vec<TreeJoint>,
    /// For each link the joint above it; `None` for the root.
    parent_joints: Vec<Option<usize>>,
    dof: usize,
}

#[derive(Debug, Clone)]
struct TreeJoint {
    parent: usize,
    child: usize,
    parent_from_joint: Pose,
    motion: UrdfJointMotion,
}

/// How the child moves, in the axes of the parent.
#[derive(Debug, Clone)]
enum UrdfJointMotion {
    Fixed,
    /// `R(q) = R(0) + sin q R(0) [w] + (1 - cos q) R(0) [w]^2`: Rodrigues with the joint's own
    /// rotation multiplied in.
    Turn {
        coordinate: usize,
        by_sine: Matrix3<f64>,
        by_versine: Matrix3<f64>,
        axis_in_child: Vector3<f64>,
    },
    Shift {
        coordinate: usize,
        axis_in_parent: Vector3<f64>,
        axis_in_child: Vector3<f64>,
    },
}

impl UrdfTree {
    /// Precomputes the constants of all joints of a robot.
    pub fn new(robot: &Robot) -> Self {
        let mut parent_joints = vec![None; robot.links().len()];
        let mut joints = Vec::with_capacity(robot.joints().len());
        for (index, joint) in robot.joints().iter().enumerate() {
            parent_joints[joint.child.get()] = Some(index);
            let coordinate = robot.parent_joint(joint.child).and_then(|index| robot.coordinate(index));
            joints.push(TreeJoint::new(joint, coordinate));
        }
        Self { joints, parent_joints, dof: robot.dof() }
    }

    /// Poses of all links in the root link.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `q` | the robot's dof | rad, m | order of [`Robot::movable_joints`] |
    /// | `root_from_links` | number of links | m | order of [`Robot::links`] |
    ///
    /// Source: the product of `parent_from_joint` and the joint's own motion, parents first; the turn
    /// by Lynch & Park, *Modern Robotics* (2017), eq. 3.51.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] or [`KinematicsError::PoseCount`] when a length is wrong.
    /// # Examples
    /// See [`UrdfTree`].
    pub fn root_from_links_into(
        &self,
        q: &RobotQ,
        root_from_links: &mut [Pose],
    ) -> Result<(), KinematicsError> {
        KinematicsError::check_joints(self.dof, q)?;
        KinematicsError::check_poses(self.parent_joints.len(), root_from_links)?;
        // Links begin with the root, and parents come before children, so every parent's pose is there.
        root_from_links[0] = Pose::identity();
        // Sines of a block first: their computation overlaps and uses vectors, which it could not between two products of poses.
        for block in self.joints.chunks(BLOCK) {
            let turns = SinesCosines::from_block(std::array::from_fn(|at| {
                block.get(at).map_or(0.0, |joint| joint.motion.angle_rad(q))
            }));
            for (joint, turn) in block.iter().zip(turns.iter()) {
                let root_from_parent = root_from_links[joint.parent];
                root_from_links[joint.child] = root_from_parent * joint.parent_from_child(q, turn);
            }
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
    /// # Errors
    /// [`KinematicsError::JointCount`] when `q` is no configuration vector of the robot.
    /// # Panics
    /// When `link` is a link of a larger robot.
    /// # Examples
    /// See [`UrdfTree`].
    pub fn root_from_link(&self, q: &RobotQ, link: LinkIndex) -> Result<Pose, KinematicsError> {
        KinematicsError::check_joints(self.dof, q)?;
        Ok(self.visit_up(q, link, |_, _| {}))
    }

    /// Pose of one link and the columns of its Jacobian; joints that do not move it get zeros.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `q` | the robot's dof | rad, m | order of [`Robot::movable_joints`] |
    /// | `columns` | the robot's dof | | as `kind` says |
    /// | result | SE(3) | m | `root_from_link` |
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), eq. 5.18: each joint's screw, moved to the link.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] or [`KinematicsError::ColumnCount`] when a length is wrong.
    /// # Panics
    /// When `link` is a link of a larger robot.
    /// # Examples
    /// See [`UrdfTree::jacobian`].
    pub fn jacobian_into(
        &self,
        q: &RobotQ,
        link: LinkIndex,
        kind: JacobianKind,
        columns: &mut [Twist],
    ) -> Result<Pose, KinematicsError> {
        KinematicsError::check_joints(self.dof, q)?;
        KinematicsError::check_columns(self.dof, columns)?;
        columns.fill(Twist::zero());
        // From the link up to the root. A body twist depends only on the joints between its joint and the link, which the walk
        // has passed already; the pose of the link, which the other kinds need, is known at its end.
        let root_from_link = self.visit_up(q, link, |joint, child_from_link| {
            if let Some((coordinate, twist_in_child)) = joint.motion.twist_in_child() {
                columns[coordinate] = twist_in_child.transformed_by(&child_from_link.inverse());
            }
        });
        for column in columns {
            *column = kind.column_from_body_twist(column, &root_from_link);
        }
        Ok(root_from_link)
    }

    /// The Jacobian of one link; [`UrdfTree::jacobian_into`] with a vector of its own.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when `q` is no configuration vector of the robot.
    /// # Panics
    /// When `link` is a link of a larger robot.
    /// # Examples
    /// An arm of 0.5 m on a vertical hinge, and its tool's velocity:
    /// ```
    /// # use congruent_description::{JointKind, JointParts, Link, Robot};
    /// # use nalgebra::{Isometry3, Vector3};
    /// use congruent_description::RobotQ;
    /// use congruent_kinematics::{JacobianKind, UrdfTree};
    /// # let link = |name: &str| Link { name: name.into(), ..Link::default() };
    /// # let at = |x: f64| Isometry3::translation(x, 0., 0.);
    /// # let robot = Robot::new("r", vec![link("base"), link("arm"), link("tool")], vec![
    /// #     JointParts::new("turn", JointKind::Continuous, "base", "arm", at(0.)),
    /// #     JointParts::new("flange", JointKind::Fixed, "arm", "tool", at(0.5))]).unwrap();
    /// let (tree, tool) = (UrdfTree::new(&robot), robot.find_link("tool").unwrap());
    /// let jacobian = tree.jacobian(&RobotQ::zeros(1), tool, JacobianKind::Geometric)?;
    /// assert_eq!(jacobian.times(&[2.0])?.linear, Vector3::new(0., 1., 0.));
    /// # Ok::<(), congruent_kinematics::KinematicsError>(())
    /// ```
    pub fn jacobian(
        &self,
        q: &RobotQ,
        link: LinkIndex,
        kind: JacobianKind,
    ) -> Result<Jacobian, KinematicsError> {
        let mut columns = vec![Twist::zero(); self.dof];
        self.jacobian_into(q, link, kind, &mut columns)?;
        Ok(Jacobian::from_columns(kind, columns))
    }

    /// The Jacobian of a frame that is fixed to a link, as a tool is to the tip; of the link itself if
    /// `link_from_frame` is the identity. The axes and the point of the link in [`JacobianKind`] are then those of
    /// the frame.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when `q` is no configuration vector of the robot.
    /// # Panics
    /// When `link` is a link of a larger robot.
    pub fn jacobian_of_frame(
        &self,
        q: &RobotQ,
        link: LinkIndex,
        link_from_frame: &Pose,
        kind: JacobianKind,
    ) -> Result<Jacobian, KinematicsError> {
        let mut columns = vec![Twist::zero(); self.dof];
        let root_from_link = self.jacobian_into(q, link, JacobianKind::Body, &mut columns)?;
        let (root_from_frame, frame_from_link) =
            (root_from_link * *link_from_frame, link_from_frame.inverse());
        for column in &mut columns {
            *column = kind.column_from_body_twist(&column.transformed_by(&frame_from_link), &root_from_frame);
        }
        Ok(Jacobian::from_columns(kind, columns))
    }

    /// Walks from a link up to the root. `each` is called with a joint and the pose of the link in the joint's child. Returns the
    /// pose in the root. Joints are taken in blocks, so that the sines of a block are computed together.
    #[inline]
    fn visit_up(&self, q: &RobotQ, link: LinkIndex, mut each: impl FnMut(&TreeJoint, &Pose)) -> Pose {
        let mut above_from_link = Pose::identity();
        let mut next = self.parent_joints[link.get()];
        while next.is_some() {
            let mut block = [None; BLOCK];
            for place in &mut block {
                let Some(index) = next else { break };
                let joint = &self.joints[index];
                *place = Some(joint);
                next = self.parent_joints[joint.parent];
            }
            let angle_rad = |joint: Option<&TreeJoint>| joint.map_or(0.0, |joint| joint.motion.angle_rad(q));
            let turns = SinesCosines::from_block(block.map(angle_rad));
            for (joint, turn) in block.into_iter().flatten().zip(turns.iter()) {
                // Before its own motion is added: the pose of the link in the joint's child.
                each(joint, &above_from_link);
                above_from_link = joint.parent_from_child(q, turn) * above_from_link;
            }
        }
        above_from_link
    }
}

impl UrdfJointMotion {
    /// The angle whose sine and cosine the motion needs; 0 if it needs none.
    #[inline]
    fn angle_rad(&self, q: &RobotQ) -> f64 {
        if let Self::Turn { coordinate, .. } = self { q[*coordinate] } else { 0.0 }
    }

    /// The coordinate and the twist of one unit of it, in the child's frame.
    #[inline]
    fn twist_in_child(&self) -> Option<(usize, Twist)> {
        let zero = Vector3::zeros();
        match *self {
            Self::Fixed => None,
            Self::Turn { coordinate, axis_in_child, .. } => {
                Some((coordinate, Twist { angular: axis_in_child, linear: zero }))
            }
            Self::Shift { coordinate, axis_in_child, .. } => {
                Some((coordinate, Twist { angular: zero, linear: axis_in_child }))
            }
        }
    }
}

impl TreeJoint {
    fn new(joint: &Joint, coordinate: Option<usize>) -> Self {
        let parent_from_joint = Pose::from(joint.parent_from_joint);
        let axis_in_parent = parent_from_joint.transform_vector(&joint.axis_in_joint);
        let motion = match (joint.kind, coordinate) {
            (JointKind::Revolute | JointKind::Continuous, Some(coordinate)) => {
                let axis_hat = hat(&joint.axis_in_joint);
                let by_sine = parent_from_joint.rotation * axis_hat;
                let axis_in_child = joint.axis_in_joint.into_inner();
                UrdfJointMotion::Turn { coordinate, by_sine, by_versine: by_sine * axis_hat, axis_in_child }
            }
            (JointKind::Prismatic, Some(coordinate)) => {
                let axis_in_child = joint.axis_in_joint.into_inner();
                UrdfJointMotion::Shift { coordinate, axis_in_parent, axis_in_child }
            }
            (JointKind::Fixed, _) | (_, None) => UrdfJointMotion::Fixed,
        };
        Self { parent: joint.parent.get(), child: joint.child.get(), parent_from_joint, motion }
    }

    #[inline]
    fn parent_from_child(&self, q: &RobotQ, turn: SinCos) -> Pose {
        let Pose { rotation, translation } = self.parent_from_joint;
        match &self.motion {
            UrdfJointMotion::Fixed => self.parent_from_joint,
            UrdfJointMotion::Turn { by_sine, by_versine, .. } => {
                let rotation = rotation + by_sine * turn.sin + by_versine * (1.0 - turn.cos);
                Pose { rotation, translation }
            }
            UrdfJointMotion::Shift { coordinate, axis_in_parent, .. } => {
                Pose { rotation, translation: translation + axis_in_parent * q[*coordinate] }
            }
        }
    }
}
