//! Forward kinematics of a declared table, of either convention. The equations of a single row are
//! `standard.rs` and `modified.rs`.

use congruent_description::{DhConvention, DhRow, DhRowKind, DhTable, Robot};

use super::{Axes, SinCos};
use crate::{error::KinematicsError, pose::Pose};

/// A table made ready for forward kinematics: constants computed once, joints found once.
///
/// Frames are numbered as in the literature: `dh0` is the table's own base, `dhn` the frame of its
/// last row. All poses are in link `base` of the robot description.
///
/// # Examples
/// A planar arm of two links of 0.6 m and 0.4 m, the elbow at a right angle:
/// ```
/// # use congruent_description::{DhConvention, DhRow, DhRowKind, DhTable, Joint, JointKind, JointParts, Link, Robot};
/// # use nalgebra::{Isometry3, Vector3};
/// use congruent_kinematics::{DhChain, Pose};
/// # let link = |name: &str| Link { name: name.into(), ..Link::default() };
/// # let single = Robot::new("r", vec![link("base")], vec![]).unwrap();
/// # let parts = |name: &str, parent: &str, child: &str, x: f64| JointParts {
/// #     joint: Joint {
/// #         name: name.into(), kind: JointKind::Continuous, parent: single.root(), child: single.root(),
/// #         parent_from_joint: Isometry3::translation(x, 0., 0.), axis_in_joint: Vector3::z_axis(),
/// #         limit: None, damping: 0., friction: 0., mimic: None,
/// #     },
/// #     parent: parent.into(), child: child.into(), mimic: None,
/// # };
/// # let robot = Robot::new("2r", vec![link("base"), link("upper"), link("lower")],
/// #     vec![parts("shoulder", "base", "upper", 0.), parts("elbow", "upper", "lower", 0.6)]).unwrap();
/// # let row = |joint: &str, a_m: f64| DhRow {
/// #     joint: robot.find_joint(joint).unwrap(), kind: DhRowKind::Revolute, a_m, alpha_rad: 0.,
/// #     d_m: 0., theta_rad: 0., sign: 1., line: 1,
/// # };
/// let table = DhTable {
///     convention: DhConvention::Standard,
///     source: None,
///     base_from_dh0: Isometry3::identity(),
///     dhn_from_tip: Isometry3::identity(),
///     rows: vec![row("shoulder", 0.6), row("elbow", 0.4)],
/// };
/// let chain = DhChain::new(&table, &robot);
/// let q = [0.0, std::f64::consts::FRAC_PI_2];
/// assert!((chain.base_from_tip(&q)?.translation - Vector3::new(0.6, 0.4, 0.)).norm() < 1e-15);
/// let mut frames = [Pose::identity(); 3];
/// chain.dh_frames_into(&q, &mut frames)?;
/// assert_eq!(frames[1].translation, Vector3::new(0.6, 0., 0.));
/// # Ok::<(), congruent_kinematics::KinematicsError>(())
/// ```
#[derive(Debug, Clone)]
pub struct DhChain {
    convention: DhConvention,
    rows: Vec<Row>,
    coordinates: Vec<usize>,
    base_from_dh0: Pose,
    dhn_from_tip: Pose,
    dof: usize,
}

/// One row with everything computed that no joint position changes.
#[derive(Debug, Clone, Copy)]
struct Row {
    coordinate: usize,
    sign: f64,
    a_m: f64,
    alpha: SinCos,
    drive: Drive,
}

/// What the joint drives, and the other entry at its constant value.
#[derive(Debug, Clone, Copy)]
enum Drive {
    Theta { at_zero_rad: f64, d_m: f64 },
    D { at_zero_m: f64, theta: SinCos },
}

impl DhChain {
    /// Prepares a table of `robot`.
    ///
    /// # Panics
    /// When a row names a joint that does not move, which no loaded description holds.
    pub fn new(table: &DhTable, robot: &Robot) -> Self {
        let rows: Vec<Row> = table.rows.iter().map(|row| Row::new(row, robot)).collect();
        Self {
            convention: table.convention,
            coordinates: rows.iter().map(|row| row.coordinate).collect(),
            rows,
            base_from_dh0: table.base_from_dh0.into(),
            dhn_from_tip: table.dhn_from_tip.into(),
            dof: robot.dof(),
        }
    }

    /// Which of the two equations the rows stand for.
    pub fn convention(&self) -> DhConvention {
        self.convention
    }

    /// Number of rows, n.
    pub fn joint_count(&self) -> usize {
        self.rows.len()
    }

    /// For each row the entry of the robot's configuration vector that drives it.
    pub fn coordinates(&self) -> &[usize] {
        &self.coordinates
    }

    /// Poses of the frames `dh0` to `dhn` in link `base`.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `q` | the robot's dof | rad, m | order of [`Robot::movable_joints`] |
    /// | `base_from_dh` | n + 1 | m | `base_from_dh0` to `base_from_dhn` |
    ///
    /// Source: the product of the rows, Spong (2006) eq. 3.10 or Craig (2005) eq. 3.6.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] or [`KinematicsError::PoseCount`] when a length is wrong.
    /// # Examples
    /// See [`DhChain`].
    pub fn dh_frames_into(&self, q: &[f64], base_from_dh: &mut [Pose]) -> Result<(), KinematicsError> {
        KinematicsError::check_joints(self.dof, q)?;
        KinematicsError::check_poses(self.rows.len() + 1, base_from_dh)?;
        base_from_dh[0] = self.base_from_dh0;
        let mut axes = Axes::of(&self.base_from_dh0);
        for (row, frame) in self.rows.iter().zip(&mut base_from_dh[1..]) {
            axes = self.step(&axes, row, q);
            *frame = axes.pose();
        }
        Ok(())
    }

    /// Pose of link `tip` in link `base`: the table between its two declared constants.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `q` | the robot's dof | rad, m | order of [`Robot::movable_joints`] |
    /// | result | SE(3) | m | `base_from_tip` |
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when `q` is no configuration vector of the robot.
    /// # Examples
    /// See [`DhChain`].
    pub fn base_from_tip(&self, q: &[f64]) -> Result<Pose, KinematicsError> {
        KinematicsError::check_joints(self.dof, q)?;
        Ok(self.walk(Axes::of(&self.base_from_dh0), &self.rows, q) * self.dhn_from_tip)
    }

    /// Pose of the tool centre point in link `base`; the tool is no part of the table.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `q` | the robot's dof | rad, m | order of [`Robot::movable_joints`] |
    /// | `tip_from_tcp` | SE(3) | m | tool in link `tip` |
    /// | result | SE(3) | m | `base_from_tcp` |
    ///
    /// # Errors
    /// As [`DhChain::base_from_tip`].
    pub fn base_from_tcp(&self, q: &[f64], tip_from_tcp: &Pose) -> Result<Pose, KinematicsError> {
        Ok(self.base_from_tip(q)? * *tip_from_tcp)
    }

    /// Pose of frame `dh<of>` in frame `dh<seen_from>`, either way round and for equal numbers.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `q` | the robot's dof | rad, m | order of [`Robot::movable_joints`] |
    /// | result | SE(3) | m | `dhi_from_dhj`, i = `seen_from`, j = `of` |
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`], or [`KinematicsError::FrameIndex`] for a frame that is not there.
    pub fn dhi_from_dhj(&self, q: &[f64], frames: DhFrames) -> Result<Pose, KinematicsError> {
        KinematicsError::check_joints(self.dof, q)?;
        let (first, last) = (frames.seen_from.min(frames.of), frames.seen_from.max(frames.of));
        if last > self.rows.len() {
            return Err(KinematicsError::FrameIndex { index: last, last: self.rows.len() });
        }
        let first_from_last = self.walk(Axes::of(&Pose::identity()), &self.rows[first..last], q);
        Ok(if frames.seen_from <= frames.of { first_from_last } else { first_from_last.inverse() })
    }

    #[inline]
    fn walk(&self, from: Axes, rows: &[Row], q: &[f64]) -> Pose {
        rows.iter().fold(from, |axes, row| self.step(&axes, row, q)).pose()
    }

    #[inline]
    fn step(&self, axes: &Axes, row: &Row, q: &[f64]) -> Axes {
        let moved = row.sign * q[row.coordinate];
        let (theta, d_m) = match row.drive {
            Drive::Theta { at_zero_rad, d_m } => (SinCos::of(at_zero_rad + moved), d_m),
            Drive::D { at_zero_m, theta } => (theta, at_zero_m + moved),
        };
        match self.convention {
            DhConvention::Standard => axes.about_z(theta, d_m).about_x(row.alpha, row.a_m),
            DhConvention::Modified => axes.about_x(row.alpha, row.a_m).about_z(theta, d_m),
        }
    }
}

/// Which frame of a chain is looked at, and from which one.
///
/// A struct and not two numbers, since swapping those would compile.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DhFrames {
    /// Number of the frame that the result is expressed in.
    pub seen_from: usize,
    /// Number of the frame whose pose is asked for.
    pub of: usize,
}

impl Row {
    fn new(row: &DhRow, robot: &Robot) -> Self {
        let coordinate = robot.coordinate(row.joint).expect("a row of a table drives a moving joint");
        let drive = match row.kind {
            DhRowKind::Revolute => Drive::Theta { at_zero_rad: row.theta_rad, d_m: row.d_m },
            DhRowKind::Prismatic => Drive::D { at_zero_m: row.d_m, theta: SinCos::of(row.theta_rad) },
        };
        Self { coordinate, sign: row.sign, a_m: row.a_m, alpha: SinCos::of(row.alpha_rad), drive }
    }
}
