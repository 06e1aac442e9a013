//! Forward kinematics of a declared table, of either convention. The equations of a single row are
//! `standard.rs` and `modified.rs`.

use congruent_description::{DhConvention, DhRow, DhRowKind, DhTable, Robot, RobotQ};

use super::derivatives::{DhDerivatives, DhRowTwists};
use crate::{
    chain::{
        axes::Axes,
        sin_cos::{BLOCK, SinCos, SinesCosines},
    },
    error::KinematicsError,
    spatial::{pose::Pose, twist::Twist},
};

/// A table prepared for forward kinematics: constants and joint indices are computed once.
///
/// Frames are numbered as in the literature: `dh0` is the table's own base, `dhn` the frame of its
/// last row. All poses are in link `base` of the robot description.
///
/// # Examples
/// A planar arm of two links of 0.6 m and 0.4 m, the elbow at a right angle:
/// ```
/// # use congruent_description::{DhConvention, DhRow, DhRowKind, DhTable, JointKind, JointParts, Link, Robot};
/// # use nalgebra::{Isometry3, Vector3};
/// use congruent_description::RobotQ;
/// use congruent_kinematics::{DhChain, DhFrames, Pose};
/// # let link = |name: &str| Link { name: name.into(), ..Link::default() };
/// # let parts = |name: &str, parent: &str, child: &str, x: f64| {
/// #     JointParts::new(name, JointKind::Continuous, parent, child, Isometry3::translation(x, 0., 0.))
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
/// let q = RobotQ::from([0.0, std::f64::consts::FRAC_PI_2]);
/// assert!((chain.base_from_tip(&q)?.translation - Vector3::new(0.6, 0.4, 0.)).norm() < 4.0 * f64::EPSILON);
/// let mut frames = [Pose::identity(); 3];
/// chain.dh_frames_into(&q, &mut frames)?;
/// assert_eq!(frames[1].translation, Vector3::new(0.6, 0., 0.));
/// let tip_from_elbow = chain.dhi_from_dhj(&q, DhFrames { transformed_by: 2, of: 1 })?;
/// assert!((tip_from_elbow.translation - Vector3::new(-0.4, 0., 0.)).norm() < f64::EPSILON);
/// # Ok::<(), congruent_kinematics::KinematicsError>(())
/// ```
#[derive(Debug, Clone)]
pub struct DhChain {
    convention: DhConvention,
    rows: Vec<PreparedRow>,
    coordinates: Vec<usize>,
    base_from_dh0: Pose,
    dhn_from_tip: Pose,
    dof: usize,
}

/// One row with everything computed that no joint position changes. Both entries follow the
/// coordinate, one of them with the factor 0: a branch for each row would cost more.
#[derive(Debug, Clone, Copy)]
struct PreparedRow {
    coordinate: usize,
    a_m: f64,
    alpha: SinCos,
    theta_rad: f64,
    theta_per_q: f64,
    d_m: f64,
    d_per_q: f64,
}

impl DhChain {
    /// Prepares a table of `robot`.
    ///
    /// # Panics
    /// When a row names a joint that does not move, which no loaded description holds.
    pub fn new(table: &DhTable, robot: &Robot) -> Self {
        let rows: Vec<PreparedRow> = table.rows.iter().map(|row| PreparedRow::new(row, robot)).collect();
        Self {
            convention: table.convention,
            coordinates: rows.iter().map(|row| row.coordinate).collect(),
            rows,
            base_from_dh0: table.base_from_dh0.into(),
            dhn_from_tip: table.dhn_from_tip.into(),
            dof: robot.dof(),
        }
    }

    /// The equation of the rows.
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
    pub fn dh_frames_into(&self, q: &RobotQ, base_from_dh: &mut [Pose]) -> Result<(), KinematicsError> {
        KinematicsError::check_joints(self.dof, q)?;
        KinematicsError::check_poses(self.rows.len() + 1, base_from_dh)?;
        base_from_dh[0] = self.base_from_dh0;
        self.visit(Axes::from_pose(&self.base_from_dh0), &self.rows, q, |at, axes| {
            base_from_dh[at] = axes.pose();
        });
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
    pub fn base_from_tip(&self, q: &RobotQ) -> Result<Pose, KinematicsError> {
        KinematicsError::check_joints(self.dof, q)?;
        let base_from_dhn = self.visit(Axes::from_pose(&self.base_from_dh0), &self.rows, q, |_, _| {});
        Ok(base_from_dhn.times(&self.dhn_from_tip))
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
    pub fn base_from_tcp(&self, q: &RobotQ, tip_from_tcp: &Pose) -> Result<Pose, KinematicsError> {
        Ok(self.base_from_tip(q)? * *tip_from_tcp)
    }

    /// Pose of frame `dh<of>` in frame `dh<transformed_by>`, either way round and for equal numbers.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `q` | the robot's dof | rad, m | order of [`Robot::movable_joints`] |
    /// | result | SE(3) | m | `dhi_from_dhj`, i = `transformed_by`, j = `of` |
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`], or [`KinematicsError::FrameIndex`] for a frame that is not there.
    /// # Examples
    /// See [`DhChain`].
    pub fn dhi_from_dhj(&self, q: &RobotQ, frames: DhFrames) -> Result<Pose, KinematicsError> {
        KinematicsError::check_joints(self.dof, q)?;
        let (first, last) = (frames.transformed_by.min(frames.of), frames.transformed_by.max(frames.of));
        if last > self.rows.len() {
            return Err(KinematicsError::FrameIndex { index: last, last: self.rows.len() });
        }
        // Along the chain in its order, whichever direction is asked for: an inverse is cheaper than a second form of
        // the product.
        let first_from_last =
            self.visit(Axes::from_pose(&Pose::identity()), &self.rows[first..last], q, |_, _| {}).pose();
        Ok(if frames.transformed_by <= frames.of { first_from_last } else { first_from_last.inverse() })
    }

    /// Pose of link `tip`, and its derivative by every parameter of the table.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `q` | the robot's dof | rad, m | order of [`Robot::movable_joints`] |
    /// | `derivatives` | n rows | 1 per unit of the parameter | base |
    ///
    /// It allocates only while `derivatives` is of a shorter table.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when `q` is no configuration vector of the robot.
    /// # Examples
    /// See [`DhDerivatives`].
    pub fn derivatives_into(
        &self,
        q: &RobotQ,
        derivatives: &mut DhDerivatives,
    ) -> Result<(), KinematicsError> {
        KinematicsError::check_joints(self.dof, q)?;
        let DhDerivatives { base_from_tip, by_base_from_dh0, by_rows, by_dhn_from_tip } = derivatives;
        by_rows.clear();
        let mut before = Axes::from_pose(&self.base_from_dh0);
        let base_from_dhn = self.visit(before, &self.rows, q, |_, behind| {
            by_rows.push(DhRowTwists::between(self.convention, &before, behind));
            before = *behind;
        });
        *base_from_tip = base_from_dhn.times(&self.dhn_from_tip);
        *by_base_from_dh0 = Twist::units();
        *by_dhn_from_tip = Twist::units().map(|unit| unit.transformed_by(&base_from_dhn.pose()));
        Ok(())
    }

    /// Steps along `rows`, the sines of a block first, so that they are computed together.
    #[inline]
    fn visit(
        &self,
        from: Axes,
        rows: &[PreparedRow],
        q: &RobotQ,
        mut each: impl FnMut(usize, &Axes),
    ) -> Axes {
        let mut axes = from;
        let mut at = 0;
        // All angles of a block first, then all sines, then the products: the sines are independent of each other and overlap.
        for block in rows.chunks(BLOCK) {
            let mut theta_rad = [0.0; BLOCK];
            for (theta_rad, row) in theta_rad.iter_mut().zip(block) {
                *theta_rad = row.theta_rad + row.theta_per_q * q[row.coordinate];
            }
            let theta = SinesCosines::from_block(theta_rad);
            for (row, theta) in block.iter().zip(theta.iter()) {
                let d_m = row.d_m + row.d_per_q * q[row.coordinate];
                axes = match self.convention {
                    DhConvention::Standard => axes.about_z(theta, d_m).about_x(row.alpha, row.a_m),
                    DhConvention::Modified => axes.about_x(row.alpha, row.a_m).about_z(theta, d_m),
                };
                at += 1;
                each(at, &axes);
            }
        }
        axes
    }
}

/// A pair of frames of a chain: the frame whose pose is computed, and the frame it is expressed in.
///
/// A struct and not two numbers, since swapping those would compile.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DhFrames {
    /// Number of the frame that the result is expressed in.
    pub transformed_by: usize,
    /// Number of the frame whose pose is computed.
    pub of: usize,
}

impl PreparedRow {
    fn new(row: &DhRow, robot: &Robot) -> Self {
        let (theta_per_q, d_per_q) = match row.kind {
            DhRowKind::Revolute => (row.sign, 0.0),
            DhRowKind::Prismatic => (0.0, row.sign),
        };
        Self {
            coordinate: robot.coordinate(row.joint).expect("a row of a table drives a moving joint"),
            a_m: row.a_m,
            alpha: SinCos::from_angle(row.alpha_rad),
            theta_rad: row.theta_rad,
            theta_per_q,
            d_m: row.d_m,
            d_per_q,
        }
    }
}
