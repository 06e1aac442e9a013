//! A Jacobian by its columns, as twists. Robots fill them in `urdf.rs` and `serial/chain.rs`; `adjoint.rs`
//! defines the order of six numbers.

use nalgebra::{Matrix3xX, Matrix6xX, Vector3, Vector6};

use super::kind::JacobianKind;
use crate::{
    error::KinematicsError,
    spatial::{twist::Twist, wrench::Wrench},
};

/// A Jacobian: for each coordinate the twist that one unit of its speed gives the link.
///
/// # Examples
/// A planar arm of 0.6 m and 0.4 m, stretched along x: the shoulder moves the tip by 1 m per rad.
/// ```
/// use congruent_kinematics::{Jacobian, JacobianKind, Twist};
/// use nalgebra::Vector3;
/// let about_z = |y: f64| Twist { angular: Vector3::z(), linear: Vector3::new(0., y, 0.) };
/// let tip_jacobian = Jacobian::from_columns(JacobianKind::Geometric, vec![about_z(1.0), about_z(0.4)]);
/// let tip_twist = tip_jacobian.times(&[1.0, -1.0])?;
/// assert_eq!((tip_twist.angular.z, tip_twist.linear.y), (0.0, 0.6));
/// assert_eq!(tip_jacobian.linear()[(1, 1)], 0.4);
/// # Ok::<(), congruent_kinematics::KinematicsError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Jacobian {
    kind: JacobianKind,
    columns: Vec<Twist>,
}

impl Jacobian {
    /// A Jacobian of a kind from its columns, one for each coordinate.
    pub fn from_columns(kind: JacobianKind, columns: Vec<Twist>) -> Self {
        Self { kind, columns }
    }

    /// The kind of the Jacobian: its axes and its reference point.
    pub fn kind(&self) -> JacobianKind {
        self.kind
    }

    /// The columns, in the order of coordinates.
    pub fn columns(&self) -> &[Twist] {
        &self.columns
    }

    /// The twist that coordinate speeds give the link: `J qd`.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when there is not one speed for each column.
    pub fn times(&self, qd: &[f64]) -> Result<Twist, KinematicsError> {
        KinematicsError::check_joints(self.columns.len(), qd)?;
        Ok(twist_of(&self.columns, qd))
    }

    /// The joint efforts by which the link exerts a wrench when nothing moves: `J^T F`.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `wrench` | 6 | N m, N | axes and reference point of [`Jacobian::kind`] |
    /// | result | dof | N m or N | joints |
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), eq. 5.26.
    ///
    /// # Examples
    /// A planar arm of 0.6 m and 0.4 m, stretched along x, pushes along y with 10 N.
    /// ```
    /// use congruent_kinematics::{Jacobian, JacobianKind, Twist, Wrench};
    /// use nalgebra::Vector3;
    /// let about_z = |y: f64| Twist { angular: Vector3::z(), linear: Vector3::new(0., y, 0.) };
    /// let tip_jacobian = Jacobian::from_columns(JacobianKind::Geometric, vec![about_z(1.0), about_z(0.4)]);
    /// let push = Wrench { moment: Vector3::zeros(), force: Vector3::new(0., 10., 0.) };
    /// assert_eq!(tip_jacobian.efforts(&push), [10.0, 4.0]);
    /// ```
    pub fn efforts(&self, wrench: &Wrench) -> Vec<f64> {
        self.columns.iter().map(|column| wrench.power(column)).collect()
    }

    /// The angular rows, 3 x dof, in rad per unit of the coordinate.
    pub fn angular(&self) -> Matrix3xX<f64> {
        block(&self.columns, |column| column.angular)
    }

    /// The linear rows, 3 x dof, in m per unit of the coordinate.
    pub fn linear(&self) -> Matrix3xX<f64> {
        block(&self.columns, |column| column.linear)
    }

    /// The 6 x dof matrix, angular rows first.
    pub fn matrix(&self) -> Matrix6xX<f64> {
        let mut matrix = Matrix6xX::zeros(self.columns.len());
        for (mut column, twist) in matrix.column_iter_mut().zip(&self.columns) {
            column.copy_from(&Vector6::from(*twist));
        }
        matrix
    }
}

fn block(columns: &[Twist], part: impl Fn(&Twist) -> Vector3<f64>) -> Matrix3xX<f64> {
    let mut block = Matrix3xX::zeros(columns.len());
    for (mut column, twist) in block.column_iter_mut().zip(columns) {
        column.copy_from(&part(twist));
    }
    block
}

/// The sum of columns times speeds, without a buffer.
pub(crate) fn twist_of(columns: &[Twist], qd: &[f64]) -> Twist {
    let mut sum = Twist::zero();
    for (column, &speed) in columns.iter().zip(qd) {
        sum += *column * speed;
    }
    sum
}
