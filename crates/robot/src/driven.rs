//! The coordinates of the driven joints: a joint that follows another by `<mimic>` has none of its own.

use super::robot::Robot;

/// How joints that follow others count.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Followers {
    /// They move with their masters: their torques and velocities are part of those of the driven joint.
    #[default]
    Folded,
    /// They count as if they were driven, each by itself.
    Free,
}

/// The driven joints of a robot, and by which ratio each of its moving joints follows one of them.
#[derive(Debug, Clone, PartialEq)]
pub struct DrivenCoordinates {
    /// Coordinates of the driven joints.
    driven: Vec<usize>,
    /// For each coordinate the place of its driver among the driven ones, and the ratio.
    drivers: Vec<(usize, f64)>,
}

impl DrivenCoordinates {
    /// The driven joints, in the robot's order.
    ///
    /// # Examples
    /// The fingers of a gripper feel 2 N and 3 N, and the second follows the first by half:
    /// ```
    /// use congruent_description::{DrivenCoordinates, Followers, parse_urdf};
    /// let robot = parse_urdf(
    ///     r#"<robot name="gripper"><link name="palm"/><link name="left"/><link name="right"/>
    ///         <joint name="a" type="continuous"><parent link="palm"/><child link="left"/></joint>
    ///         <joint name="b" type="continuous"><parent link="palm"/><child link="right"/>
    ///             <mimic joint="a" multiplier="0.5"/></joint>
    ///     </robot>"#,
    /// ).unwrap();
    /// assert_eq!(DrivenCoordinates::new(&robot, Followers::Folded).folded(&[2.0, 3.0]), [3.5]);
    /// assert_eq!(DrivenCoordinates::new(&robot, Followers::Free).folded(&[2.0, 3.0]), [2.0, 3.0]);
    /// ```
    pub fn new(robot: &Robot, followers: Followers) -> Self {
        let joints = robot.movable_joints().iter();
        let mimics: Vec<Option<(usize, f64)>> = joints
            .map(|&joint| {
                let mimic = robot.joint(joint).mimic.filter(|_| followers == Followers::Folded)?;
                Some((robot.coordinate(mimic.master)?, mimic.multiplier))
            })
            .collect();
        let driven: Vec<usize> = (0..mimics.len()).filter(|&at| mimics[at].is_none()).collect();
        let driver = |(at, mimic): (usize, &Option<(usize, f64)>)| {
            let (master, ratio) = mimic.unwrap_or((at, 1.0));
            (place(&driven, master), ratio)
        };
        let drivers = mimics.iter().enumerate().map(driver).collect();
        Self { driven, drivers }
    }

    /// The coordinates of the driven joints among those of the robot.
    pub fn driven(&self) -> &[usize] {
        &self.driven
    }

    /// Names of the driven joints of this robot.
    ///
    /// # Panics
    /// If the coordinates are another robot's.
    pub fn joint_names(&self, robot: &Robot) -> Vec<String> {
        let name = |&at: &usize| robot.joint(robot.movable_joints()[at]).name.clone();
        self.driven.iter().map(name).collect()
    }

    /// Values for a unit of each coordinate, such as torques or a row of a Jacobian, for a unit of each driven one. A
    /// follower moves `ratio` times as far, so its value counts `ratio` times (principle of virtual work).
    ///
    /// # Panics
    /// If there is not one value for each moving joint.
    pub fn folded(&self, values: &[f64]) -> Vec<f64> {
        assert_eq!(values.len(), self.drivers.len(), "one value for each movable joint");
        let mut folded = vec![0.0; self.driven.len()];
        for (value, &(driver, ratio)) in values.iter().zip(&self.drivers) {
            folded[driver] += ratio * value;
        }
        folded
    }

    /// The values of the driven joints, such as their accelerations.
    ///
    /// # Panics
    /// If there is not one value for each moving joint.
    pub fn of_driven<T: Clone>(&self, values: &[T]) -> Vec<T> {
        self.driven.iter().map(|&at| values[at].clone()).collect()
    }
}

/// The place of a master among the driven joints.
fn place(driven: &[usize], master: usize) -> usize {
    driven.binary_search(&master).expect("no master follows another joint")
}
