//! Vectors of joint positions with owners: those of a robot, of a chain and of an arm are three types, so
//! that one cannot be taken for another.

use std::ops::{Deref, DerefMut};

macro_rules! joint_positions {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Debug, Clone, PartialEq, Default)]
        pub struct $name(Vec<f64>);

        impl $name {
            /// All joints at zero.
            pub fn zeros(joints: usize) -> Self {
                Self(vec![0.0; joints])
            }
        }

        impl Deref for $name {
            type Target = [f64];

            #[inline]
            fn deref(&self) -> &[f64] {
                &self.0
            }
        }

        impl DerefMut for $name {
            #[inline]
            fn deref_mut(&mut self) -> &mut [f64] {
                &mut self.0
            }
        }

        impl<'a> IntoIterator for &'a $name {
            type Item = &'a f64;
            type IntoIter = std::slice::Iter<'a, f64>;

            fn into_iter(self) -> Self::IntoIter {
                self.0.iter()
            }
        }

        impl From<Vec<f64>> for $name {
            fn from(positions: Vec<f64>) -> Self {
                Self(positions)
            }
        }

        impl<const N: usize> From<[f64; N]> for $name {
            fn from(positions: [f64; N]) -> Self {
                Self(positions.to_vec())
            }
        }

        impl From<&[f64]> for $name {
            fn from(positions: &[f64]) -> Self {
                Self(positions.to_vec())
            }
        }

        impl FromIterator<f64> for $name {
            fn from_iter<I: IntoIterator<Item = f64>>(positions: I) -> Self {
                Self(positions.into_iter().collect())
            }
        }
    };
}

joint_positions! {
    /// A configuration of a robot: one position for each movable joint, mimic joints included, in
    /// [`Robot::movable_joints`](crate::Robot::movable_joints) order; rad or m.
    ///
    /// # Examples
    /// The positions of a chain are no configuration of a robot:
    /// ```compile_fail
    /// use congruent_description::{ChainQ, RobotQ};
    /// let q: RobotQ = ChainQ::zeros(6);
    /// ```
    RobotQ
}

joint_positions! {
    /// Positions of the joints of a chain, base to tip, each with a variable of its own; rad or m.
    ChainQ
}

joint_positions! {
    /// Positions of the independent joints of an arm, base to tip; rad or m.
    ArmQ
}

impl RobotQ {
    /// The positions of the joints with these coordinates, in their order.
    ///
    /// # Panics
    /// If a coordinate is none of the robot's.
    ///
    /// # Examples
    /// ```
    /// use congruent_description::{ChainQ, RobotQ};
    /// let q = RobotQ::from([0.1, 0.2, 0.3]);
    /// assert_eq!(q.chain_positions(&[2, 0]), ChainQ::from([0.3, 0.1]));
    /// ```
    pub fn chain_positions(&self, coordinates: &[usize]) -> ChainQ {
        coordinates.iter().map(|&coordinate| self.0[coordinate]).collect()
    }

    /// Puts the positions of a chain where its joints have these coordinates; others stay.
    ///
    /// # Panics
    /// If a coordinate is none of the robot's.
    pub fn set_chain(&mut self, coordinates: &[usize], q: &ChainQ) {
        for (&coordinate, &position) in coordinates.iter().zip(q.iter()) {
            self.0[coordinate] = position;
        }
    }
}
