//! Errors in the arguments of calls. Faulty robots are refused by their reader, before they come here.

/// The reason why the arguments of a call were refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum KinematicsError {
    /// The configuration vector has another length than the robot has moving joints.
    #[error("{found} joint positions are given, but {expected} joints move")]
    JointCount {
        /// The robot's degrees of freedom, mimic joints included.
        expected: usize,
        /// Length of the vector that was given.
        found: usize,
    },
    /// The buffer for poses has another length than there are poses to write.
    #[error("the buffer has room for {found} poses, but {expected} are written")]
    PoseCount {
        /// Number of poses that the call writes.
        expected: usize,
        /// Length of the buffer that was given.
        found: usize,
    },
    /// The buffer for the columns of a Jacobian has another length than there are coordinates.
    #[error("the buffer has room for {found} columns, but the Jacobian has {expected}")]
    ColumnCount {
        /// Number of columns, one for each coordinate.
        expected: usize,
        /// Length of the buffer that was given.
        found: usize,
    },
    /// A Jacobian has no column of this number.
    #[error("there is no column {index}: the Jacobian has {count} columns")]
    ColumnIndex {
        /// The requested column, from 0.
        index: usize,
        /// Number of columns, one for each coordinate.
        count: usize,
    },
    /// Nothing moves between the two ends of an arm.
    #[error("no joint moves between base and tip")]
    NoJoint,
    /// A search over the joint range has too many joints to end in time.
    #[error(
        "{found} joints move between base and tip, limit <= {most} for a search over the whole joint range"
    )]
    SearchedJoints {
        /// Number of joints of the arm.
        found: usize,
        /// Largest number of joints.
        most: usize,
    },
    /// A table has no frame of this number.
    #[error("there is no frame dh{index}: the last frame of the table is dh{last}")]
    FrameIndex {
        /// Number of the requested frame.
        index: usize,
        /// Number of the last frame of the table.
        last: usize,
    },
    /// A joint's range is no closed interval of finite positions.
    #[error("joint {joint}: its range {lower} to {upper} is not a finite interval")]
    JointRange {
        /// Index of the joint, from 0.
        joint: usize,
        /// Lower end of the range, rad or m.
        lower: f64,
        /// Upper end of the range, rad or m.
        upper: f64,
    },
}

impl KinematicsError {
    /// Checks a length once at the entry of a call, so that its loops need no checks.
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
            "5 joint positions are given, but 6 joints move"
        );
        assert_eq!(
            KinematicsError::check_poses(7, &[0.0; 6]).unwrap_err().to_string(),
            "the buffer has room for 6 poses, but 7 are written"
        );
        assert_eq!(
            KinematicsError::check_columns(7, &[0.0; 6]).unwrap_err().to_string(),
            "the buffer has room for 6 columns, but the Jacobian has 7"
        );
        assert_eq!(
            KinematicsError::ColumnIndex { index: 6, count: 6 }.to_string(),
            "there is no column 6: the Jacobian has 6 columns"
        );
        assert_eq!(
            KinematicsError::FrameIndex { index: 9, last: 6 }.to_string(),
            "there is no frame dh9: the last frame of the table is dh6"
        );
    }
}
