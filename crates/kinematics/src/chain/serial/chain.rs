//! A serial chain made ready for speed: pose of the tip and its Jacobian in one pass, whatever the
//! chain was written as. For use in loops; the forms that are compared are
//! `dh/chain.rs`, `urdf.rs` and `screws/tree.rs`.

use congruent_description::{ChainQ, DhTable, LinkIndex, Robot};
use nalgebra::Vector3;

use super::steps::{ChainPath, PathStep};
use crate::{
    chain::{
        axes::Axes,
        jacobian::kind::JacobianKind,
        screws::chain::ScrewChain,
        sin_cos::{BLOCK, SinCos, SinesCosines},
    },
    error::KinematicsError,
    spatial::{pose::Pose, twist::Twist},
};

/// A chain of joints from one link to another, each reduced to
/// `Rz(theta + theta' q) T(x, y, d + d' q) Rx(alpha)` between two constants.
///
/// Any turn or shift between two axes can be written so: the turns about both axes go into the
/// joint angles. Unlike a DH table it also holds for axes that are almost parallel, since nothing is
/// divided by the sine of their angle.
///
/// # Examples
/// ```
/// # use congruent_description::{JointKind, JointParts, Link, Robot};
/// # use nalgebra::{Isometry3, Vector3};
/// use congruent_description::ChainQ;
/// use congruent_kinematics::{JacobianKind, SerialChain, Twist};
/// # let link = |name: &str| Link { name: name.into(), ..Link::default() };
/// # let at = |x: f64| Isometry3::translation(x, 0., 0.);
/// # let robot = Robot::new("2r", vec![link("base"), link("upper"), link("lower"), link("tip")], vec![
/// #     JointParts::new("shoulder", JointKind::Continuous, "base", "upper", at(0.)),
/// #     JointParts::new("elbow", JointKind::Continuous, "upper", "lower", at(0.6)),
/// #     JointParts::new("flange", JointKind::Fixed, "lower", "tip", at(0.4))]).unwrap();
/// let chain = SerialChain::from_urdf(&robot, robot.root(), robot.find_link("tip").unwrap());
/// let mut columns = vec![Twist::zero(); chain.joint_count()];
/// let q = ChainQ::zeros(2);
/// let base_from_tip = chain.pose_and_jacobian_into(&q, JacobianKind::Geometric, &mut columns)?;
/// assert_eq!(base_from_tip.translation, Vector3::new(1., 0., 0.));
/// assert_eq!(columns[1], Twist { angular: Vector3::z(), linear: Vector3::new(0., 0.4, 0.) });
/// # Ok::<(), congruent_kinematics::KinematicsError>(())
/// ```
#[derive(Debug, Clone)]
pub struct SerialChain {
    pub(crate) rows: Vec<SerialRow>,
    coordinates: Vec<usize>,
    pub(crate) base_from_first: Axes,
    /// The remaining turn about the axis of the last row.
    pub(crate) last: SinCos,
}

/// One joint and what follows it, up to the next joint's axis.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SerialRow {
    pub(crate) theta_rad: f64,
    pub(crate) theta_per_q: f64,
    pub(crate) d_per_q: f64,
    /// Translation x, y, d between the two turns, m.
    pub(crate) shift: Vector3<f64>,
    pub(crate) alpha: SinCos,
}

impl SerialChain {
    /// The chain from link `base` to link `tip`, which need not hang below `base`: joints on the
    /// path up to their common ancestor are passed backwards.
    ///
    /// # Panics
    /// When a link is none of the robot's.
    pub fn from_urdf(robot: &Robot, base: LinkIndex, tip: LinkIndex) -> Self {
        Self::from_path(&ChainPath::from_urdf(robot, base, tip))
    }

    /// The chain of a table of `robot`, from link `base` to link `tip`; joints are its rows.
    ///
    /// # Panics
    /// When a row names a joint that does not move, which no loaded description holds.
    pub fn from_dh(table: &DhTable, robot: &Robot) -> Self {
        Self::from_path(&ChainPath::from_table(table, robot))
    }

    /// The chain of screws, each its own coordinate. A screw that turns and shifts at once keeps its
    /// turn alone: no joint of a description is one.
    pub fn from_screws(chain: &ScrewChain) -> Self {
        Self::from_path(&ChainPath::from_screws(chain))
    }

    fn from_path(path: &ChainPath) -> Self {
        let after =
            |at: usize| path.steps.get(at).map_or(&path.last_from_here, |step| &step.before_from_axis);
        let mut remaining_rad = 0.0;
        let mut rows = Vec::with_capacity(path.steps.len());
        for (at, step) in path.steps.iter().enumerate() {
            let (row, next_remaining_rad) = SerialRow::new(step, remaining_rad, after(at + 1));
            rows.push(row);
            remaining_rad = next_remaining_rad;
        }
        Self {
            rows,
            coordinates: path.steps.iter().map(|step| step.coordinate).collect(),
            base_from_first: Axes::from_pose(after(0)),
            last: SinCos::from_angle(remaining_rad),
        }
    }

    /// Number of joints, n.
    pub fn joint_count(&self) -> usize {
        self.rows.len()
    }

    /// For each joint of the chain the entry of the robot's configuration vector that drives it.
    pub fn coordinates(&self) -> &[usize] {
        &self.coordinates
    }

    /// Pose of the tip in the base.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `q` | n | rad, m | joints of the chain, base to tip |
    /// | result | SE(3) | m | `base_from_tip` |
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when `q` has another length than the chain.
    /// # Examples
    /// See [`SerialChain`].
    pub fn base_from_tip(&self, q: &ChainQ) -> Result<Pose, KinematicsError> {
        KinematicsError::check_joints(self.rows.len(), q)?;
        Ok(self.base_from_tip_at(q))
    }

    /// The same for positions whose number was checked before.
    pub(super) fn base_from_tip_at(&self, q: &[f64]) -> Pose {
        self.visit(q, |_, _| {}).pose()
    }

    /// Pose of the tip and its Jacobian, in one pass.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `q` | n | rad, m | joints of the chain, base to tip |
    /// | `columns` | n | | as `kind` says; link `base` in place of the root |
    /// | result | SE(3) | m | `base_from_tip` |
    ///
    /// Source: Siciliano et al., *Robotics* (2009), eq. 3.30; Lynch & Park, *Modern Robotics* (2017), eq. 5.11.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] or [`KinematicsError::ColumnCount`] when a length is wrong.
    /// # Examples
    /// See [`SerialChain`].
    pub fn pose_and_jacobian_into(
        &self,
        q: &ChainQ,
        kind: JacobianKind,
        columns: &mut [Twist],
    ) -> Result<Pose, KinematicsError> {
        KinematicsError::check_joints(self.rows.len(), q)?;
        KinematicsError::check_columns(self.rows.len(), columns)?;
        // In the first pass `columns` holds the direction and a point of each axis, in the base frame; the velocity needs the
        // position of the tip, which is known only at its end.
        let tip = self.visit(q, |at, axes| columns[at] = Twist { angular: axes.z, linear: axes.origin });
        // The linear part is the velocity of this point of the link.
        let point_of_twist = if kind == JacobianKind::Space { Vector3::zeros() } else { tip.origin };
        for (column, row) in columns.iter_mut().zip(&self.rows) {
            let Twist { angular: z, linear: point } = *column;
            let angular = z * row.theta_per_q;
            *column = Twist { angular, linear: angular.cross(&(point_of_twist - point)) + z * row.d_per_q };
        }
        let base_from_tip = tip.pose();
        if kind == JacobianKind::Body {
            // Body and geometric twists have the same reference point and differ in their axes alone.
            let turn = base_from_tip.rotation.transpose();
            for column in columns {
                *column = Twist { angular: turn * column.angular, linear: turn * column.linear };
            }
        }
        Ok(base_from_tip)
    }

    /// Steps along the rows, the sines of a block first, so that they are computed together;
    /// `each` sees the axes before its joint turns.
    #[inline]
    fn visit(&self, q: &[f64], mut each: impl FnMut(usize, &Axes)) -> Axes {
        let mut axes = self.base_from_first;
        let mut at = 0;
        for (block, q) in self.rows.chunks(BLOCK).zip(q.chunks(BLOCK)) {
            let mut theta_rad = [0.0; BLOCK];
            for ((theta_rad, row), q) in theta_rad.iter_mut().zip(block).zip(q) {
                *theta_rad = row.theta_rad + row.theta_per_q * q;
            }
            let theta = SinesCosines::from_block(theta_rad);
            for ((row, theta), q) in block.iter().zip(theta.iter()).zip(q) {
                each(at, &axes);
                let shift = row.shift + Vector3::new(0.0, 0.0, row.d_per_q * q);
                axes = axes.turned_about_z(theta).shifted(&shift).turned_about_x(row.alpha);
                at += 1;
            }
        }
        axes.turned_about_z(self.last)
    }
}

impl SerialRow {
    /// The row of a joint that starts turned by `from_rad` and reaches to the next joint's axis, with
    /// the turn about that axis that the next row takes over.
    ///
    /// `axis_from_next` is `Rz(first) T Rx(alpha) Rz(second)`: `first` is added to the joint's angle.
    fn new(step: &PathStep, from_rad: f64, axis_from_next: &Pose) -> (Self, f64) {
        let Pose { rotation, translation } = axis_from_next;
        let (x, y) = (rotation[(0, 2)], rotation[(1, 2)]);
        let sine = libm::hypot(x, y);
        // Of parallel axes the split is free. Where `x` and `y` are little more than rounding any
        // direction serves as well: what `first` misses, the other two angles take up.
        let (sin, cos) = if sine < PARALLEL_RAD { (0.0, 1.0) } else { (x / sine, -y / sine) };
        let back = |v: Vector3<f64>| Vector3::new(cos * v.x + sin * v.y, cos * v.y - sin * v.x, v.z);
        let column = |at: usize| back(rotation.column(at).into_owned());
        let (next_x, next_y, next_z) = (column(0), column(1), column(2));
        // After `back`, next_z has no x component except rounding; dividing by the length keeps sine and cosine of alpha
        // normalised, so that rounding does not grow along the chain.
        let length = libm::hypot(next_z.y, next_z.z);
        let (theta_per_q, d_per_q) = if step.turns { (step.per_q, 0.0) } else { (0.0, step.per_q) };
        let row = Self {
            theta_rad: from_rad + libm::atan2(sin, cos),
            theta_per_q,
            d_per_q,
            shift: back(*translation),
            alpha: SinCos { sin: -next_z.y / length, cos: next_z.z / length },
        };
        (row, libm::atan2(-next_y.x, next_x.x))
    }
}

/// Below this angle two axes are parallel. Kind: rounding of a dozen products of rotations.
const PARALLEL_RAD: f64 = 1e-14;
