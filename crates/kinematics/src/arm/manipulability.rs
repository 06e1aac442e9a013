//! Velocity ellipsoids: how fast the tool can move in each direction at one configuration.

use congruent_description::ArmQ;
use nalgebra::{DMatrix, Matrix3};

use super::model::{Arm, ArmJoint};
use crate::{error::KinematicsError, spatial::twist::Twist};

/// Singular values below this share of the largest are zero. Kind: rounding of a dozen products.
const RANK_SHARE: f64 = 1e-9;
/// Number of configurations by which the attainable rank of a Jacobian is found.
const RANK_SAMPLES: u32 = 16;

/// Measures that follow from the singular values of a Jacobian. Singular values that are zero at every configuration are
/// left out, so a planar arm is not called singular because it stays in its plane.
///
/// Source: Yoshikawa, *Manipulability of Robotic Mechanisms* (1985), eq. 8 and section 3.
#[derive(Debug, Clone, PartialEq)]
pub struct Dexterity {
    /// Singular values, largest first; as many as the attainable rank.
    pub singular_values: Vec<f64>,
    /// Product of the singular values, Yoshikawa's measure.
    pub yoshikawa: f64,
    /// Largest over smallest singular value; infinite if the arm is singular.
    pub condition: f64,
    /// Smallest singular value: the distance to the nearest singular matrix.
    pub distance_to_singularity: f64,
}

/// The velocities that joint velocities of unit norm give the tool, as an ellipsoid.
#[derive(Debug, Clone, PartialEq)]
pub struct VelocityEllipsoid {
    /// Columns are the directions of the semi-axes in the base, the longest first.
    pub axes_in_base: Matrix3<f64>,
    /// Lengths of the semi-axes, in m or rad per rad; per m if no joint turns.
    pub semi_axes: [f64; 3],
    /// Measures that follow from the lengths of the semi-axes.
    pub dexterity: Dexterity,
}

/// Manipulability at one configuration. Metres and radians are not mixed: linear and angular parts are separate. In `whole`, and
/// for prismatic joints beside revolute ones, a length that counts as one radian converts between the two; without it a product
/// of singular values would depend on the unit of length.
#[derive(Debug, Clone, PartialEq)]
pub struct Manipulability {
    /// Ellipsoid of the tool centre point's velocity.
    pub linear: VelocityEllipsoid,
    /// Ellipsoid of the tool's angular velocity.
    pub angular: VelocityEllipsoid,
    /// Measures of the linear and angular velocity together.
    pub whole: Dexterity,
}

impl Arm {
    /// Manipulability at configuration `q`, with a length that counts as one radian, such as
    /// [`Arm::metres_per_rad`].
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when `q` is no configuration of the arm.
    pub fn manipulability(
        &mut self,
        q: &ArmQ,
        metres_per_rad: f64,
    ) -> Result<Manipulability, KinematicsError> {
        // By configurations of its own: at `q` the arm may be singular, and the zero would count as missing.
        let ranks = self.attainable_ranks();
        let [linear, angular, whole] = self.jacobians(q, metres_per_rad)?;
        Ok(Manipulability {
            linear: ellipsoid(&linear, ranks[0]),
            angular: ellipsoid(&angular, ranks[1]),
            whole: dexterity(&singular_values(&whole), ranks[2]),
        })
    }

    /// Whether some joints turn and others slide: their velocities have different units.
    pub fn turns_and_slides(&self) -> bool {
        let turns = |joint: &ArmJoint| joint.turns;
        self.joints().iter().any(turns) && !self.joints().iter().all(turns)
    }

    /// Linear, angular and whole Jacobian, the last without units.
    fn jacobians(&mut self, q: &ArmQ, metres_per_rad: f64) -> Result<[DMatrix<f64>; 3], KinematicsError> {
        let rad_per_metre = 1.0 / metres_per_rad;
        // One unit of a prismatic joint is made comparable with one radian only if both kinds occur; an arm of slides alone keeps
        // metres per metre.
        let of_slide = if self.turns_and_slides() { metres_per_rad } else { 1.0 };
        let unit = |joint: &ArmJoint| if joint.turns { 1.0 } else { of_slide };
        let units: Vec<f64> = self.joints().iter().map(unit).collect();
        let (_, columns) = self.pose_and_jacobian(q)?;
        let part = |of: fn(&Twist) -> nalgebra::Vector3<f64>| {
            DMatrix::from_fn(3, columns.len(), |row, column| of(&columns[column])[row] * units[column])
        };
        let (linear, angular) = (part(|twist| twist.linear), part(|twist| twist.angular));
        let mut whole = DMatrix::zeros(6, columns.len());
        whole.rows_mut(0, 3).copy_from(&angular);
        whole.rows_mut(3, 3).copy_from(&(&linear * rad_per_metre));
        Ok([linear, angular, whole])
    }

    /// The largest rank of each of the three Jacobians over a few fixed configurations. A single one might be singular.
    pub(super) fn attainable_ranks(&mut self) -> [usize; 3] {
        // They are of the arm, and sixteen times the work of a configuration: found once.
        if let Some(ranks) = self.ranks {
            return ranks;
        }
        let mut ranks = [0; 3];
        let metres_per_rad = self.metres_per_rad();
        for q in self.spread(RANK_SAMPLES) {
            let jacobians = self.jacobians(&q, metres_per_rad).expect("q is a configuration of this arm");
            for (rank, jacobian) in ranks.iter_mut().zip(jacobians) {
                let values = singular_values(&jacobian);
                let zero = RANK_SHARE * values.first().copied().unwrap_or(0.0);
                *rank = values.iter().filter(|&&value| value > zero).count().max(*rank);
            }
        }
        self.ranks = Some(ranks);
        ranks
    }
}

/// The singular values, largest first; NaN if an entry is not finite, since nalgebra would iterate for ever.
fn singular_values(matrix: &DMatrix<f64>) -> Vec<f64> {
    if matrix.iter().all(|entry| entry.is_finite()) {
        sorted(&matrix.singular_values())
    } else {
        vec![f64::NAN; matrix.nrows().min(matrix.ncols())]
    }
}

fn sorted(values: &nalgebra::DVector<f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.iter().copied().collect();
    // nalgebra gives them in any order for a rank-deficient matrix.
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

fn dexterity(values: &[f64], rank: usize) -> Dexterity {
    let values = &values[..rank];
    let (largest, smallest) = (values.first().copied().unwrap_or(0.0), values.last().copied().unwrap_or(0.0));
    Dexterity {
        singular_values: values.to_vec(),
        // The product of no values is 1, the measure of an arm that cannot move is 0.
        yoshikawa: if values.is_empty() { 0.0 } else { values.iter().product() },
        condition: if smallest > 0.0 { largest / smallest } else { f64::INFINITY },
        distance_to_singularity: smallest,
    }
}

/// The eigenvectors of a symmetric matrix as columns, that of the largest eigenvalue first; NaN if an entry is not finite.
fn eigenvectors(symmetric: Matrix3<f64>) -> Matrix3<f64> {
    if !symmetric.iter().all(|entry| entry.is_finite()) {
        return Matrix3::repeat(f64::NAN);
    }
    let eigen = symmetric.symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
    Matrix3::from_columns(&order.map(|at| eigen.eigenvectors.column(at).into_owned()))
}

/// The axes follow from `J J^T`; the singular values from `J` itself, since small ones lose half their digits in the square.
fn ellipsoid(jacobian: &DMatrix<f64>, rank: usize) -> VelocityEllipsoid {
    // nalgebra's SVD of a 3 x n matrix with n < 3 has only n left vectors; J J^T always has three.
    let gram = Matrix3::from_fn(|row, column| jacobian.row(row).dot(&jacobian.row(column)));
    let axes_in_base = eigenvectors(gram);
    let values = singular_values(jacobian);
    let semi_axes = [0, 1, 2].map(|at| values.get(at).copied().unwrap_or(0.0));
    VelocityEllipsoid { axes_in_base, semi_axes, dexterity: dexterity(&values, rank) }
}
