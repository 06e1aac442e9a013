//! A path as a list of joints with constants between them: what `chain.rs` is built from, and
//! the one place there that knows URDF trees, tables and screws.

use congruent_description::{DhConvention, DhRowKind, DhTable, JointIndex, JointKind, LinkIndex, Robot};
use nalgebra::{Matrix3, Vector3};

use crate::{
    chain::{
        dh::{modified::ModifiedDh, standard::StandardDh},
        screws::chain::ScrewChain,
    },
    spatial::{pose::Pose, rotation::frame_about},
};

/// One joint of a path; its motion is along or about the z axis of a frame of its own.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PathStep {
    /// Pose of that frame in the one of the joint before, at position zero.
    pub(crate) before_from_axis: Pose,
    pub(crate) turns: bool,
    /// Motion for one unit of the coordinate.
    pub(crate) per_q: f64,
    pub(crate) coordinate: usize,
}

/// How a joint moves, in the frame that the path has reached.
struct AxisMotion {
    axis: Vector3<f64>,
    turns: bool,
    per_q: f64,
}

/// A path: its joints, and what follows the last.
#[derive(Debug, Clone)]
pub(crate) struct ChainPath {
    pub(crate) steps: Vec<PathStep>,
    pub(crate) last_from_here: Pose,
}

impl ChainPath {
    fn new() -> Self {
        Self { steps: Vec::new(), last_from_here: Pose::identity() }
    }

    fn constant(&mut self, here_from_there: Pose) {
        self.last_from_here = self.last_from_here * here_from_there;
    }

    /// A joint at the origin of the frame that the path has reached; the joint turns or shifts that frame.
    fn joint(&mut self, coordinate: usize, AxisMotion { axis, turns, per_q }: AxisMotion) {
        let here_from_axis = Pose::from_parts(frame_about(&axis), Vector3::zeros());
        let before_from_axis = self.last_from_here * here_from_axis;
        // The axis frame is turned back after the joint, so that the rest of the path is written in the frames of its source.
        self.steps.push(PathStep { before_from_axis, turns, per_q, coordinate });
        self.last_from_here = here_from_axis.inverse();
    }

    /// Up from `base` to the nearest common ancestor, then down to `tip`.
    pub(crate) fn from_urdf(robot: &Robot, base: LinkIndex, tip: LinkIndex) -> Self {
        // Both lists end at the root; what they share at that end is above the common ancestor and does not move one link
        // relative to the other.
        let (mut up, mut down) = (to_root(robot, base), to_root(robot, tip));
        while up.last().is_some() && up.last() == down.last() {
            up.pop();
            down.pop();
        }
        let mut path = Self::new();
        for joint in up {
            let parent_from_joint = Pose::from(robot.joint(joint).parent_from_joint);
            // Upwards the inverse of parent_from_joint * motion(q): the motion comes first and with the opposite sign.
            path.urdf_joint(robot, joint, -1.0);
            path.constant(parent_from_joint.inverse());
        }
        for joint in down.into_iter().rev() {
            path.constant(robot.joint(joint).parent_from_joint.into());
            path.urdf_joint(robot, joint, 1.0);
        }
        path
    }

    fn urdf_joint(&mut self, robot: &Robot, index: JointIndex, per_q: f64) {
        let joint = robot.joint(index);
        if let Some(coordinate) = robot.coordinate(index) {
            let (axis, turns) = (joint.axis_in_joint.into_inner(), joint.kind != JointKind::Prismatic);
            self.joint(coordinate, AxisMotion { axis, turns, per_q });
        }
    }

    /// From link `base` to link `tip` along the rows of a table.
    pub(crate) fn from_table(table: &DhTable, robot: &Robot) -> Self {
        let mut path = Self::new();
        path.constant(table.base_from_dh0.into());
        for row in &table.rows {
            let (a_m, alpha_rad, d_m, theta_rad) = (row.a_m, row.alpha_rad, row.d_m, row.theta_rad);
            let (before, after) = match table.convention {
                DhConvention::Standard => {
                    (Pose::identity(), StandardDh { a_m, alpha_rad, d_m, theta_rad }.transform())
                }
                // `Rx(alpha) Tx(a)` comes before the joint's motion; `Rz(theta) Tz(d)` commutes with it and may
                // follow.
                DhConvention::Modified => (
                    ModifiedDh { a_m, alpha_rad, d_m: 0.0, theta_rad: 0.0 }.transform(),
                    ModifiedDh { a_m: 0.0, alpha_rad: 0.0, d_m, theta_rad }.transform(),
                ),
            };
            let coordinate = robot.coordinate(row.joint).expect("a row of a table drives a moving joint");
            let turns = row.kind == DhRowKind::Revolute;
            path.constant(before);
            path.joint(coordinate, AxisMotion { axis: Vector3::z(), turns, per_q: row.sign });
            path.constant(after);
        }
        path.constant(table.dhn_from_tip.into());
        path
    }

    /// From base to tip along screws, whose joints are their own coordinates. Screws of a pitch that
    /// is neither zero nor infinite keep their turn alone.
    pub(crate) fn from_screws(chain: &ScrewChain) -> Self {
        let mut path = Self::new();
        let mut here_in_base = Vector3::zeros();
        for (coordinate, twist) in chain.twists_in_base.iter().enumerate() {
            let rate = twist.angular.norm();
            let motion = if rate > 0.0 {
                // The point of the axis nearest to the origin, w x v / w^2 (Lynch & Park, sec. 3.3.2).
                let point_in_base = twist.angular.cross(&twist.linear) / (rate * rate);
                // At position zero all frames of the path have the base's axes: only their origins differ.
                path.constant(Pose::from_parts(Matrix3::identity(), point_in_base - here_in_base));
                here_in_base = point_in_base;
                AxisMotion { axis: twist.angular / rate, turns: true, per_q: rate }
            } else {
                let rate = twist.linear.norm();
                // A joint without motion gets any axis; its rate of 0 keeps it still.
                let axis = if rate > 0.0 { twist.linear / rate } else { Vector3::z() };
                AxisMotion { axis, turns: false, per_q: rate }
            };
            path.joint(coordinate, motion);
        }
        // Back to the base's origin, in which the home pose is given.
        path.constant(Pose::from_parts(Matrix3::identity(), -here_in_base));
        path.constant(chain.base_from_tip_at_zero);
        path
    }
}

/// The joints above a link, nearest first.
fn to_root(robot: &Robot, mut link: LinkIndex) -> Vec<JointIndex> {
    let mut joints = Vec::new();
    while let Some(joint) = robot.parent_joint(link) {
        joints.push(joint);
        link = robot.joint(joint).parent;
    }
    joints
}
