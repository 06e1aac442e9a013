//! The columns of arrays: the joints that are driven, in the robot's order. A joint that follows another by `<mimic>` has none.

use congruent::description::{DrivenCoordinates, Followers, Robot};

/// The place of a joint's position in a row: `q = multiplier * row[column] + offset`.
#[derive(Debug, Clone, Copy)]
pub(super) struct FollowedColumn {
    pub(super) column: usize,
    pub(super) multiplier: f64,
    pub(super) offset: f64,
}

/// The driven joints of a robot as columns, and how each of its moving joints follows one of them.
#[derive(Debug)]
pub(super) struct JointColumns {
    names: Vec<String>,
    driven: DrivenCoordinates,
    /// One for each moving joint.
    follows: Vec<FollowedColumn>,
}

impl JointColumns {
    pub(super) fn new(robot: &Robot) -> Self {
        let driven = DrivenCoordinates::new(robot, Followers::Folded);
        let column =
            |coordinate| driven.driven().binary_search(&coordinate).expect("no master follows another");
        let follows = robot.movable_joints().iter().enumerate().map(|(coordinate, &joint)| {
            match robot.joint(joint).mimic {
                None => FollowedColumn { column: column(coordinate), multiplier: 1.0, offset: 0.0 },
                Some(mimic) => {
                    let master = robot.coordinate(mimic.master).expect("a mimicked joint moves");
                    FollowedColumn {
                        column: column(master),
                        multiplier: mimic.multiplier,
                        offset: mimic.offset,
                    }
                }
            }
        });
        let follows = follows.collect();
        Self { names: driven.joint_names(robot), follows, driven }
    }

    /// Names of the driven joints.
    pub(super) fn names(&self) -> &[String] {
        &self.names
    }

    /// Number of driven joints.
    pub(super) fn count(&self) -> usize {
        self.names.len()
    }

    /// Number of moving joints, those that follow others among them.
    pub(super) fn moving(&self) -> usize {
        self.follows.len()
    }

    /// Whether a row is a configuration of the robot as it is.
    pub(super) fn is_configuration(&self) -> bool {
        self.count() == self.moving()
    }

    /// For each moving joint the place of its position in a row.
    pub(super) fn follows(&self) -> &[FollowedColumn] {
        &self.follows
    }

    /// The coordinates of the driven joints among those of the robot.
    pub(super) fn driven(&self) -> &[usize] {
        self.driven.driven()
    }

    /// Values for a unit of each moving joint as those for a unit of each driven one, of which the followers are a part.
    pub(super) fn fold_into(&self, of_moving: &[f64], of_driven: &mut [f64]) {
        of_driven.fill(0.0);
        for (value, follows) in of_moving.iter().zip(&self.follows) {
            of_driven[follows.column] += follows.multiplier * value;
        }
    }

    /// Rows with the position of each moving joint.
    pub(super) fn positions_into(&self, rows: &[f64], of_moving: &mut Vec<f64>) {
        self.expand(rows, of_moving, |follows| follows.offset);
    }

    /// The same for speeds and accelerations, which no offset changes.
    pub(super) fn rates_into(&self, rows: &[f64], of_moving: &mut Vec<f64>) {
        self.expand(rows, of_moving, |_| 0.0);
    }

    /// The same for torques of actuators, which followers do not have.
    pub(super) fn torques_into(&self, rows: &[f64], of_moving: &mut Vec<f64>) {
        of_moving.clear();
        for row in rows.chunks(self.count().max(1)) {
            let begin = of_moving.len();
            of_moving.resize(begin + self.moving(), 0.0);
            for (&coordinate, &torque) in self.driven().iter().zip(row) {
                of_moving[begin + coordinate] = torque;
            }
        }
    }

    fn expand(&self, rows: &[f64], of_moving: &mut Vec<f64>, constant: fn(&FollowedColumn) -> f64) {
        of_moving.clear();
        // A robot without a joint has rows without numbers, which are none.
        for row in rows.chunks(self.count().max(1)) {
            let place =
                |follows: &FollowedColumn| follows.multiplier * row[follows.column] + constant(follows);
            of_moving.extend(self.follows.iter().map(place));
        }
    }
}
