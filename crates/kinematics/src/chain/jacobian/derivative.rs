//! Derivatives of a Jacobian by one coordinate and by time. Both follow from its columns alone.
//!
//! A joint moves all joints behind it, so with `k` before `i` on the path to the link:
//!
//! | kind | `dJ_i/dq_k` | `dJ_k/dq_i` |
//! |---|---|---|
//! | `Space` | `[J_k, J_i]` | 0 |
//! | `Body` | 0 | `[J_k, J_i]` |
//! | `Geometric` | `w_k x` both parts of `J_i` | linear `w_k x v_i` |
//!
//! Source: Müller, *Derivatives of screw systems in body-fixed representation* (2014), for the first two;
//! Bruyninckx & De Schutter, *Symbolic differentiation of the velocity mapping for a serial kinematic
//! chain* (1996), for all three.

use super::{
    columns::{Jacobian, twist_of},
    kind::JacobianKind,
};
use crate::{error::KinematicsError, spatial::twist::Twist};

impl JacobianKind {
    /// The derivative of every column of a Jacobian of this kind by one coordinate: `dJ/dq_k`.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `columns` | n | 1 per unit of their coordinate | as the kind says |
    /// | `coordinate` | 1 | | k, below n |
    /// | `derivative` | n | the same per unit of `q_k` | as the kind says |
    ///
    /// The columns are in the order of their joints on the path to the link, zeros for joints that
    /// do not move it anywhere between: what [`UrdfTree::jacobian_into`](crate::UrdfTree::jacobian_into)
    /// and [`SerialChain::pose_and_jacobian_into`](crate::SerialChain::pose_and_jacobian_into) give.
    /// Each is that of its own coordinate; a sum over joints that follow one another is none.
    ///
    /// # Errors
    /// [`KinematicsError::ColumnCount`] when there is not room for n columns, or
    /// [`KinematicsError::ColumnIndex`] when k is not below n.
    /// # Examples
    /// See [`Jacobian::derivative`].
    pub fn derivative_into(
        self,
        columns: &[Twist],
        coordinate: usize,
        derivative: &mut [Twist],
    ) -> Result<(), KinematicsError> {
        KinematicsError::check_columns(columns.len(), derivative)?;
        let by = columns
            .get(coordinate)
            .ok_or(KinematicsError::ColumnIndex { index: coordinate, count: columns.len() })?;
        for (at, (derivative, column)) in derivative.iter_mut().zip(columns).enumerate() {
            *derivative = match self {
                // In the root's axes joint k carries the axes behind it along; in the link's axes those before it
                // move the other direction. A column of its own joint never changes.
                Self::Space if coordinate < at => by.bracket(column),
                Self::Body if at < coordinate => column.bracket(by),
                Self::Space | Self::Body => Twist::zero(),
                Self::Geometric if coordinate < at => Twist {
                    angular: by.angular.cross(&column.angular),
                    linear: by.angular.cross(&column.linear),
                },
                // Axes before k stay. The reference point moves with the link, by k's linear column.
                Self::Geometric => Twist::shift(column.angular.cross(&by.linear)),
            };
        }
        Ok(())
    }

    /// The time derivative of every column of a Jacobian of this kind, `sum_k dJ/dq_k qd_k`, in work
    /// proportional to the chain.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `columns` | n | 1 per unit of their coordinate | as for [`JacobianKind::derivative_into`] |
    /// | `qd` | n | rad/s, m/s | |
    /// | `rate` | n | the same per s | as the kind says |
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] or [`KinematicsError::ColumnCount`] when a length is not n.
    /// # Examples
    /// See [`Jacobian::rate`].
    pub fn rate_into(self, columns: &[Twist], qd: &[f64], rate: &mut [Twist]) -> Result<(), KinematicsError> {
        KinematicsError::check_joints(columns.len(), qd)?;
        KinematicsError::check_columns(columns.len(), rate)?;
        rate.iter_mut().zip(self.rates(columns, qd)).for_each(|(rate, found)| *rate = found);
        Ok(())
    }

    /// The time derivative of the twist `J qd`: `J qdd + (dJ/dt) qd`.
    ///
    /// Of the geometric kind it is the angular acceleration and the acceleration of the link's
    /// origin; of the others the derivative of the twist's components, which is no acceleration of a
    /// point.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `columns` | n | 1 per unit of their coordinate | as for [`JacobianKind::derivative_into`] |
    /// | `qd`, `qdd` | n | rad/s, m/s; rad/s^2, m/s^2 | |
    /// | result | 6 | rad/s^2, m/s^2 | as the kind says |
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when a length is not n.
    /// # Examples
    /// See [`Jacobian::acceleration`].
    pub fn acceleration(self, columns: &[Twist], qd: &[f64], qdd: &[f64]) -> Result<Twist, KinematicsError> {
        KinematicsError::check_joints(columns.len(), qd)?;
        KinematicsError::check_joints(columns.len(), qdd)?;
        let add = |sum: Twist, (rate, &speed): (Twist, &f64)| sum + rate * speed;
        Ok(self.rates(columns, qd).zip(qd).fold(twist_of(columns, qdd), add))
    }

    /// The rate of each column, in order.
    #[inline]
    fn rates(self, columns: &[Twist], qd: &[f64]) -> impl Iterator<Item = Twist> {
        // Parts of `J qd`: `before` of the joints before this one, `behind` of this joint and those behind it. Running sums make
        // the work proportional to n; summing dJ/dq_k qd_k for each column would be n^2.
        let (mut before, mut behind) = (Twist::zero(), twist_of(columns, qd));
        columns.iter().zip(qd).map(move |(column, &speed)| {
            let Twist { angular, linear } = column;
            let rate = match self {
                Self::Space => before.bracket(column),
                Self::Body => column.bracket(&behind),
                Self::Geometric => Twist {
                    angular: before.angular.cross(angular),
                    linear: before.angular.cross(linear) + angular.cross(&behind.linear),
                },
            };
            before += *column * speed;
            behind += *column * -speed;
            rate
        })
    }
}

impl Jacobian {
    /// `dJ/dq_k` for k = `coordinate`: each column's derivative, of the same kind and order.
    ///
    /// # Errors
    /// [`KinematicsError::ColumnIndex`] when there is no such coordinate.
    /// # Examples
    /// The tip of a planar arm of 0.6 m and 0.4 m, stretched along x: when the elbow turns, the
    /// velocity by either joint leans back towards the elbow.
    /// ```
    /// use congruent_kinematics::{Jacobian, JacobianKind, Twist};
    /// use nalgebra::Vector3;
    /// let about_z = |y: f64| Twist { angular: Vector3::z(), linear: Vector3::new(0., y, 0.) };
    /// let tip_jacobian = Jacobian::from_columns(JacobianKind::Geometric, vec![about_z(1.0), about_z(0.4)]);
    /// let by_elbow = tip_jacobian.derivative(1)?;
    /// assert_eq!(by_elbow.columns()[0].linear, Vector3::new(-0.4, 0., 0.));
    /// assert_eq!(by_elbow.columns()[1].linear, Vector3::new(-0.4, 0., 0.));
    /// # Ok::<(), congruent_kinematics::KinematicsError>(())
    /// ```
    pub fn derivative(&self, coordinate: usize) -> Result<Self, KinematicsError> {
        let mut derivative = vec![Twist::zero(); self.columns().len()];
        self.kind().derivative_into(self.columns(), coordinate, &mut derivative)?;
        Ok(Self::from_columns(self.kind(), derivative))
    }

    /// The time derivative of the Jacobian at coordinate speeds `qd`: each column's, of the same kind
    /// and order. [`JacobianKind::rate_into`] with a vector of its own.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when there is not one speed for each column.
    /// # Examples
    /// An arm of 0.5 m along x that turns by 2 rad/s:
    /// ```
    /// use congruent_kinematics::{Jacobian, JacobianKind, Twist};
    /// use nalgebra::Vector3;
    /// let column = Twist { angular: Vector3::z(), linear: Vector3::new(0., 0.5, 0.) };
    /// let tip_jacobian = Jacobian::from_columns(JacobianKind::Geometric, vec![column]);
    /// assert_eq!(tip_jacobian.rate(&[2.0])?.columns()[0].linear, Vector3::new(-1., 0., 0.));
    /// # Ok::<(), congruent_kinematics::KinematicsError>(())
    /// ```
    pub fn rate(&self, qd: &[f64]) -> Result<Self, KinematicsError> {
        let mut rate = vec![Twist::zero(); self.columns().len()];
        self.kind().rate_into(self.columns(), qd, &mut rate)?;
        Ok(Self::from_columns(self.kind(), rate))
    }

    /// The time derivative of the link's twist, `J qdd + (dJ/dt) qd`; see [`JacobianKind::acceleration`].
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when there is not one speed and one acceleration for each column.
    /// # Examples
    /// An arm of 0.5 m along x that turns by 2 rad/s falls towards its axis with `r w^2`:
    /// ```
    /// use congruent_kinematics::{Jacobian, JacobianKind, Twist};
    /// use nalgebra::Vector3;
    /// let column = Twist { angular: Vector3::z(), linear: Vector3::new(0., 0.5, 0.) };
    /// let tip_jacobian = Jacobian::from_columns(JacobianKind::Geometric, vec![column]);
    /// assert_eq!(tip_jacobian.acceleration(&[2.0], &[0.0])?.linear, Vector3::new(-2., 0., 0.));
    /// # Ok::<(), congruent_kinematics::KinematicsError>(())
    /// ```
    pub fn acceleration(&self, qd: &[f64], qdd: &[f64]) -> Result<Twist, KinematicsError> {
        self.kind().acceleration(self.columns(), qd, qdd)
    }
}
