//! What a caller of the kinematics can get wrong. Wrong robots are refused by their reader.

/// Why values were refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum KinematicsError {
    /// The configuration vector has another length than the robot has moving joints.
    #[error("{found} joint positions for {expected} moving joints")]
    JointCount {
        /// The robot's degrees of freedom, mimic joints included.
        expected: usize,
        /// Length of the vector.
        found: usize,
    },
    /// The buffer for poses has another length than there are poses to write.
    #[error("room for {found} poses where {expected} are written")]
    PoseCount {
        /// Number of poses.
        expected: usize,
        /// Length of the buffer.
        found: usize,
    },
    /// The buffer for the columns of a Jacobian has another length than there are coordinates.
    #[error("room for {found} columns of a Jacobian of {expected}")]
    ColumnCount {
        /// Number of coordinates.
        expected: usize,
        /// Length of the buffer.
        found: usize,
    },
    /// A Jacobian has no column of this number.
    #[error("no column {index}: the Jacobian has {count}")]
    ColumnIndex {
        /// The column that was asked for, from 0.
        index: usize,
        /// Number of coordinates.
        count: usize,
    },
    /// Nothing moves between the two ends of an arm.
    #[error("no joint moves between base and tip")]
    NoJoint,
    /// A table has no frame of this number.
    #[error("no frame dh{index}: the table's last is dh{last}")]
    FrameIndex {
        /// The frame that was asked for.
        index: usize,
        /// The table's last frame.
        last: usize,
    },
    /// A joint's range is no closed interval of finite positions.
    #[error("joint {joint} has the range {lower} to {upper}")]
    JointRange {
        /// The joint, from 0.
        joint: usize,
        /// Where the range begins.
        lower: f64,
        /// Where it ends.
        upper: f64,
    },
}

impl KinematicsError {
    /// Compares lengths once, so that the loops behind need no further care.
    pub(crate) fn check_joints(expected: usize, q: &[f64]) -> Result<(), Self> {
        Self::check_joint_count(expected, q.len())
    }

    /// Compares two numbers of joints.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] if they differ.
    pub fn check_joint_count(expected: usize, found: usize) -> Result<(), Self> {
        if found == expected { Ok(()) } else { Err(Self::JointCount { expected, found }) }
    }

    /// Compares the length of a buffer for columns.
    pub(crate) fn check_columns<T>(expected: usize, columns: &[T]) -> Result<(), Self> {
        if columns.len() == expected {
            Ok(())
        } else {
            Err(Self::ColumnCount { expected, found: columns.len() })
        }
    }

    /// Compares the length of a buffer for poses.
    pub(crate) fn check_poses<T>(expected: usize, poses: &[T]) -> Result<(), Self> {
        if poses.len() == expected { Ok(()) } else { Err(Self::PoseCount { expected, found: poses.len() }) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_hold_both_numbers() {
        assert_eq!(
            KinematicsError::check_joints(6, &[0.0; 5]).unwrap_err().to_string(),
            "5 joint positions for 6 moving joints"
        );
        assert_eq!(
            KinematicsError::check_poses(7, &[0.0; 6]).unwrap_err().to_string(),
            "room for 6 poses where 7 are written"
        );
        assert_eq!(
            KinematicsError::check_columns(7, &[0.0; 6]).unwrap_err().to_string(),
            "room for 6 columns of a Jacobian of 7"
        );
        assert_eq!(
            KinematicsError::ColumnIndex { index: 6, count: 6 }.to_string(),
            "no column 6: the Jacobian has 6"
        );
        assert_eq!(
            KinematicsError::FrameIndex { index: 9, last: 6 }.to_string(),
            "no frame dh9: the table's last is dh6"
        );
    }
}
