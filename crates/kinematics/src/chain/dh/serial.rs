//! A table of either convention as parameters alone, without a robot that names its joints: what
//! conversions read and write. Its forward kinematics multiplies the rows' own transforms and
//! shares no step with `chain.rs`.

use congruent_description::{ChainQ, DhConvention, DhRow, DhRowKind, DhTable, JointIndex};
use nalgebra::Vector3;

use super::{modified::ModifiedDh, standard::StandardDh};
use crate::{
    chain::screws::chain::ScrewChain,
    error::KinematicsError,
    spatial::{pose::Pose, twist::Twist},
};

/// A table with its two constants: `base_from_tip(q) = base_from_dh0 T_1(q_1) ... T_n(q_n) dhn_from_tip`.
///
/// # Examples
/// The convention is a matter of grouping: a row `Rz Tz Tx Rx` of one is cut in the middle and its
/// second half leads the next row of the other.
/// ```
/// use congruent_description::{ChainQ, DhConvention, DhRow, DhRowKind};
/// use congruent_kinematics::{Pose, SerialDh};
/// let row = DhRow {
///     joint: (), kind: DhRowKind::Revolute, a_m: 0.3, alpha_rad: 0.5, d_m: 0.1, theta_rad: 0.2, sign: -1.0, line: 0,
/// };
/// let standard = SerialDh {
///     convention: DhConvention::Standard,
///     base_from_dh0: Pose::identity(),
///     rows: vec![row, row],
///     dhn_from_tip: Pose::identity(),
/// };
/// let modified = standard.to_convention(DhConvention::Modified);
/// assert_eq!((modified.rows[0].a_m, modified.rows[1].a_m), (0.0, 0.3));
/// let q = ChainQ::from([0.7, -0.4]);
/// let (a, b) = (standard.base_from_tip(&q)?, modified.base_from_tip(&q)?);
/// assert!(a.distance_m(&b) < 4.0 * f64::EPSILON && a.angle_rad(&b) < 4.0 * f64::EPSILON);
/// # Ok::<(), congruent_kinematics::KinematicsError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct SerialDh {
    /// The equation of the rows.
    pub convention: DhConvention,
    /// Pose of frame 0 in the base.
    pub base_from_dh0: Pose,
    /// The rows, base to tip, without joints of a robot.
    pub rows: Vec<DhRow<()>>,
    /// Pose of the tip in the last frame.
    pub dhn_from_tip: Pose,
}

impl SerialDh {
    /// The parameters of a declared table, in the order of its rows.
    pub fn from_table(table: &DhTable) -> Self {
        let row = |row: &DhRow| {
            let DhRow { kind, a_m, alpha_rad, d_m, theta_rad, sign, .. } = *row;
            DhRow { joint: (), kind, a_m, alpha_rad, d_m, theta_rad, sign, line: 0 }
        };
        Self {
            convention: table.convention,
            base_from_dh0: table.base_from_dh0.into(),
            rows: table.rows.iter().map(row).collect(),
            dhn_from_tip: table.dhn_from_tip.into(),
        }
    }

    /// The table with the joints that drive its rows.
    ///
    /// # Panics
    /// When there are not as many joints as rows.
    pub fn to_table(&self, joints: &[JointIndex]) -> DhTable {
        assert_eq!(joints.len(), self.rows.len(), "one joint for each row");
        let row = |(row, &joint): (&DhRow<()>, &JointIndex)| {
            let DhRow { kind, a_m, alpha_rad, d_m, theta_rad, sign, .. } = *row;
            DhRow { joint, kind, a_m, alpha_rad, d_m, theta_rad, sign, line: 0 }
        };
        DhTable {
            convention: self.convention,
            source: None,
            base_from_dh0: self.base_from_dh0.to_isometry(),
            dhn_from_tip: self.dhn_from_tip.to_isometry(),
            rows: self.rows.iter().zip(joints).map(row).collect(),
        }
    }

    /// Pose of the tip in the base.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `q` | n | rad, m | one for each row, base to tip |
    /// | result | SE(3) | m | `base_from_tip` |
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when `q` has another length.
    /// # Examples
    /// See [`SerialDh`].
    pub fn base_from_tip(&self, q: &ChainQ) -> Result<Pose, KinematicsError> {
        KinematicsError::check_joints(self.rows.len(), q)?;
        let step = |pose: Pose, (row, &q): (&DhRow<()>, &f64)| pose * transform(row, self.convention, q);
        Ok(self.rows.iter().zip(q).fold(self.base_from_dh0, step) * self.dhn_from_tip)
    }

    /// The same robot in the other convention (or a copy in its own): nothing is computed but the
    /// constants that take in the first or last half row.
    #[must_use]
    pub fn to_convention(&self, convention: DhConvention) -> Self {
        let mut other = Self { convention, ..self.clone() };
        let (Some(first), Some(last)) = (self.rows.first(), self.rows.last()) else { return other };
        // Standard is Rz Tz (Tx Rx), modified is (Tx Rx) Rz Tz, so a and alpha move to the neighbouring row; at one end the half
        // row goes into a constant, at the other a zero half row is left. No value is computed, so none is rounded.
        match (self.convention, convention) {
            (DhConvention::Standard, DhConvention::Modified) => {
                other.dhn_from_tip = link(last) * self.dhn_from_tip;
                (other.rows[0].a_m, other.rows[0].alpha_rad) = (0.0, 0.0);
                for (row, before) in other.rows[1..].iter_mut().zip(&self.rows) {
                    (row.a_m, row.alpha_rad) = (before.a_m, before.alpha_rad);
                }
            }
            (DhConvention::Modified, DhConvention::Standard) => {
                other.base_from_dh0 = self.base_from_dh0 * link(first);
                for (row, after) in other.rows.iter_mut().zip(&self.rows[1..]) {
                    (row.a_m, row.alpha_rad) = (after.a_m, after.alpha_rad);
                }
                let end = other.rows.len() - 1;
                (other.rows[end].a_m, other.rows[end].alpha_rad) = (0.0, 0.0);
            }
            _ => {}
        }
        other
    }

    /// The table as space screws and home pose.
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), appendix C.6: the screw of a joint lies along
    /// the z axis of its frame.
    pub fn screw_chain(&self) -> ScrewChain {
        let mut base_from_here = self.base_from_dh0;
        let mut twists_in_base = Vec::with_capacity(self.rows.len());
        for row in &self.rows {
            // The joint's axis is z of the frame before the motion: in the modified convention behind Tx(a) Rx(alpha).
            let before_motion = match self.convention {
                DhConvention::Standard => base_from_here,
                DhConvention::Modified => base_from_here * link(row),
            };
            let along = Vector3::z() * row.sign;
            let in_frame = match row.kind {
                DhRowKind::Revolute => Twist { angular: along, linear: Vector3::zeros() },
                DhRowKind::Prismatic => Twist { angular: Vector3::zeros(), linear: along },
            };
            twists_in_base.push(in_frame.transformed_by(&before_motion));
            base_from_here = base_from_here * transform(row, self.convention, 0.0);
        }
        ScrewChain { twists_in_base, base_from_tip_at_zero: base_from_here * self.dhn_from_tip }
    }
}

/// The transform of a row at joint position `q` (rad or m).
fn transform(row: &DhRow<()>, convention: DhConvention, q: f64) -> Pose {
    let DhRow { kind, a_m, alpha_rad, mut d_m, mut theta_rad, sign, .. } = *row;
    match kind {
        DhRowKind::Revolute => theta_rad += sign * q,
        DhRowKind::Prismatic => d_m += sign * q,
    }
    match convention {
        DhConvention::Standard => StandardDh { a_m, alpha_rad, d_m, theta_rad }.transform(),
        DhConvention::Modified => ModifiedDh { a_m, alpha_rad, d_m, theta_rad }.transform(),
    }
}

/// `Tx(a) Rx(alpha)`: the part of a row that no joint moves.
fn link(row: &DhRow<()>) -> Pose {
    StandardDh { a_m: row.a_m, alpha_rad: row.alpha_rad, d_m: 0.0, theta_rad: 0.0 }.transform()
}
