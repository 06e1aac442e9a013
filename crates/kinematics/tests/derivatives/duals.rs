//! The independent source: forward kinematics once more, with elementary matrices alone, on numbers that carry
//! their derivatives along. It shares no step with the crate.

use congruent_description::{DhConvention, DhRowKind, JointKind, LinkIndex, Robot};
use congruent_kinematics::{JacobianKind, Twist};
use nalgebra::{Isometry3, Matrix4, Vector3};
use num_dual::{Dual, Dual64, DualNum};

/// A number that carries derivatives.
pub(crate) trait Number: DualNum<Primitive = f64> + Copy {}
impl<D: DualNum<Primitive = f64> + Copy> Number for D {}

/// A number with its derivative along one direction, and the derivative of both along another.
pub(crate) type Second = Dual<Dual64>;

/// A homogeneous matrix.
pub(crate) type DualPose<D> = Matrix4<D>;

/// Angular, then linear.
pub(crate) type Six<D> = [D; 6];

pub(crate) fn constant<D: Number>(isometry: &Isometry3<f64>) -> DualPose<D> {
    isometry.to_homogeneous().map(D::from)
}

/// A shift along x, y or z.
pub(crate) fn along<D: Number>(axis: usize, by: D) -> DualPose<D> {
    let mut motion = DualPose::identity();
    motion[(axis, 3)] = by;
    motion
}

/// A turn about x, y or z.
pub(crate) fn about<D: Number>(axis: usize, by: D) -> DualPose<D> {
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut motion = DualPose::identity();
    (motion[(next, next)], motion[(last, last)]) = (by.cos(), by.cos());
    (motion[(next, last)], motion[(last, next)]) = (-by.sin(), by.sin());
    motion
}

/// Rodrigues: a turn about a unit axis.
fn about_axis<D: Number>(axis: &Vector3<f64>, by: D) -> DualPose<D> {
    let zero = D::from(0.0);
    let skew = hat([D::from(axis.x), D::from(axis.y), D::from(axis.z), zero, zero, zero]);
    DualPose::identity() + skew * by.sin() + skew * skew * (D::from(1.0) - by.cos())
}

fn hat<D: Number>([wx, wy, wz, vx, vy, vz]: Six<D>) -> DualPose<D> {
    let zero = D::from(0.0);
    DualPose::new(zero, -wz, wy, vx, wz, zero, -wx, vy, -wy, wx, zero, vz, zero, zero, zero, zero)
}

/// The power series of the matrix exponential, far beyond what twists of a few radians need.
pub(crate) fn exponential<D: Number>(twist: Six<D>) -> DualPose<D> {
    let generator = hat(twist);
    let (mut term, mut sum) = (DualPose::identity(), DualPose::identity());
    for order in 1..60 {
        term = term * generator * D::from(1.0 / f64::from(order));
        sum += term;
    }
    sum
}

pub(crate) fn inverse<D: Number>(motion: &DualPose<D>) -> DualPose<D> {
    let mut inverse = DualPose::identity();
    for row in 0..3 {
        let mut shift = D::from(0.0);
        for column in 0..3 {
            inverse[(row, column)] = motion[(column, row)];
            shift -= motion[(column, row)] * motion[(column, 3)];
        }
        inverse[(row, 3)] = shift;
    }
    inverse
}

/// A table whose every parameter is a number with derivatives.
#[derive(Debug, Clone)]
pub(crate) struct Table<D> {
    pub(crate) convention: DhConvention,
    /// A twist on the left of `base_from_dh0`, and that constant.
    pub(crate) base: (Six<D>, Isometry3<f64>),
    /// `a`, `alpha`, `d`, `theta`.
    pub(crate) rows: Vec<[D; 4]>,
    /// A twist on the left of `dhn_from_tip`, and that constant.
    pub(crate) tip: (Six<D>, Isometry3<f64>),
    pub(crate) joints: Vec<(DhRowKind, f64)>,
}

impl<D: Number> Table<D> {
    pub(crate) fn base_from_tip(&self, q: &[f64]) -> DualPose<D> {
        let mut motion = exponential(self.base.0) * constant(&self.base.1);
        for ((&[a, alpha, mut d, mut theta], (kind, sign)), q) in self.rows.iter().zip(&self.joints).zip(q) {
            match kind {
                DhRowKind::Revolute => theta += D::from(sign * q),
                DhRowKind::Prismatic => d += D::from(sign * q),
            }
            let (link, joint) = (along(0, a) * about(0, alpha), about(2, theta) * along(2, d));
            motion *= match self.convention {
                DhConvention::Standard => joint * link,
                DhConvention::Modified => link * joint,
            };
        }
        motion * exponential(self.tip.0) * constant(&self.tip.1)
    }
}

/// Pose of a link in the root of a tree.
pub(crate) fn root_from_link<D: Number>(robot: &Robot, link: LinkIndex, q: &[D]) -> DualPose<D> {
    let Some(index) = robot.parent_joint(link) else { return DualPose::identity() };
    let joint = robot.joint(index);
    let parent = root_from_link(robot, joint.parent, q) * constant(&joint.parent_from_joint);
    let axis = joint.axis_in_joint.into_inner();
    match (robot.coordinate(index), joint.kind) {
        (Some(coordinate), JointKind::Prismatic) => {
            let by = |at: usize| q[coordinate] * D::from(axis[at]);
            parent * along(0, by(0)) * along(1, by(1)) * along(2, by(2))
        }
        (Some(coordinate), _) => parent * about_axis(&axis, q[coordinate]),
        (None, _) => parent,
    }
}

/// The velocity of a pose as a Jacobian of this kind has it.
pub(crate) fn velocity<D: Number>(kind: JacobianKind, pose: &DualPose<D>, rate: &DualPose<D>) -> Six<D> {
    let in_space = rate * inverse(pose);
    let twist = if kind == JacobianKind::Body { inverse(pose) * rate } else { in_space };
    let linear = if kind == JacobianKind::Geometric { rate } else { &twist };
    let half = D::from(0.5);
    let turn = |row, column| (twist[(row, column)] - twist[(column, row)]) * half;
    [turn(2, 1), turn(0, 2), turn(1, 0), linear[(0, 3)], linear[(1, 3)], linear[(2, 3)]]
}

/// The space twist of a pose whose numbers carry one derivative.
pub(crate) fn space_twist(motion: &DualPose<Dual64>) -> Twist {
    twist_of(velocity(JacobianKind::Space, &motion.map(|entry| entry.re), &motion.map(|entry| entry.eps)))
}

/// The velocity of a pose along the outer direction, and the derivative of that along the inner one.
pub(crate) fn velocity_and_change(kind: JacobianKind, motion: &DualPose<Second>) -> (Twist, Twist) {
    let velocity = velocity(kind, &motion.map(|entry| entry.re), &motion.map(|entry| entry.eps));
    (twist_of(velocity.map(|entry| entry.re)), twist_of(velocity.map(|entry| entry.eps)))
}

fn twist_of([wx, wy, wz, vx, vy, vz]: Six<f64>) -> Twist {
    Twist { angular: Vector3::new(wx, wy, wz), linear: Vector3::new(vx, vy, vz) }
}
