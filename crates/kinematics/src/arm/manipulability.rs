//! How well the tool moves in each direction at one configuration: the velocity ellipsoids.

use congruent_description::ArmQ;
use nalgebra::{DMatrix, Matrix3};

use super::model::{Arm, ArmJoint};
use crate::{error::KinematicsError, spatial::twist::Twist};

/// Singular values below this share of the largest are zero. Kind: rounding of a dozen products.
const RANK_SHARE: f64 = 1e-9;
/// Configurations that tell what an arm can span at all.
const RANK_SAMPLES: u32 = 16;

/// What the singular values of a Jacobian say; those that no configuration of the arm has are not
/// counted, so a planar arm is not called singular for staying in its plane.
///
/// Source: Yoshikawa, *Manipulability of Robotic Mechanisms* (1985), eq. 8 and section 3.
#[derive(Debug, Clone, PartialEq)]
pub struct Dexterity {
    /// Largest first, as many as the arm can have.
    pub singular_values: Vec<f64>,
    /// Their product, Yoshikawa's measure.
    pub yoshikawa: f64,
    /// Largest over smallest; infinite if the arm is singular.
    pub condition: f64,
    /// The smallest: the distance to the nearest singular matrix.
    pub distance_to_singularity: f64,
}

/// The velocities that joint velocities of unit norm give the tool, as an ellipsoid.
#[derive(Debug, Clone, PartialEq)]
pub struct VelocityEllipsoid {
    /// Columns are the directions of the semi-axes in the base, the longest first.
    pub axes_in_base: Matrix3<f64>,
    /// Their lengths, in m or rad per rad; per m if no joint turns.
    pub semi_axes: [f64; 3],
    /// What its semi-axes say.
    pub dexterity: Dexterity,
}

/// Manipulability at one configuration. Metres and radians do not mix: linear and angular parts stand
/// apart, and a length that counts as one radian measures the linear part in `whole`, and everywhere the
/// velocities of joints that slide, if others turn. Without it a product of singular values would depend on the
/// unit of length.
#[derive(Debug, Clone, PartialEq)]
pub struct Manipulability {
    /// Of the tool centre point's velocity.
    pub linear: VelocityEllipsoid,
    /// Of the tool's angular velocity.
    pub angular: VelocityEllipsoid,
    /// Of both together.
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
        let ranks = self.attainable_ranks();
        let [linear, angular, whole] = self.jacobians(q, metres_per_rad)?;
        Ok(Manipulability {
            linear: ellipsoid(&linear, ranks[0]),
            angular: ellipsoid(&angular, ranks[1]),
            whole: dexterity(&sorted(&whole.singular_values()), ranks[2]),
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

    /// The most directions that each of the three spans at a few fixed configurations.
    pub(super) fn attainable_ranks(&mut self) -> [usize; 3] {
        let mut ranks = [0; 3];
        let metres_per_rad = self.metres_per_rad();
        for q in self.spread(RANK_SAMPLES) {
            let jacobians = self.jacobians(&q, metres_per_rad).expect("q is a configuration of this arm");
            for (rank, jacobian) in ranks.iter_mut().zip(jacobians) {
                let values = sorted(&jacobian.singular_values());
                let zero = RANK_SHARE * values.first().copied().unwrap_or(0.0);
                *rank = values.iter().filter(|&&value| value > zero).count().max(*rank);
            }
        }
        ranks
    }
}

fn sorted(values: &nalgebra::DVector<f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.iter().copied().collect();
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

fn dexterity(values: &[f64], rank: usize) -> Dexterity {
    let values = &values[..rank];
    let (largest, smallest) = (values.first().copied().unwrap_or(0.0), values.last().copied().unwrap_or(0.0));
    Dexterity {
        singular_values: values.to_vec(),
        yoshikawa: if values.is_empty() { 0.0 } else { values.iter().product() },
        condition: if smallest > 0.0 { largest / smallest } else { f64::INFINITY },
        distance_to_singularity: smallest,
    }
}

/// From `J J^T` for the axes, which three columns always have, and from `J` for the singular values, of which
/// its square would lose the small ones.
fn ellipsoid(jacobian: &DMatrix<f64>, rank: usize) -> VelocityEllipsoid {
    let gram = Matrix3::from_fn(|row, column| jacobian.row(row).dot(&jacobian.row(column)));
    let eigen = gram.symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
    let axes_in_base = Matrix3::from_columns(&order.map(|at| eigen.eigenvectors.column(at).into_owned()));
    let values = sorted(&jacobian.singular_values());
    let semi_axes = [0, 1, 2].map(|at| values.get(at).copied().unwrap_or(0.0));
    VelocityEllipsoid { axes_in_base, semi_axes, dexterity: dexterity(&values, rank) }
}
