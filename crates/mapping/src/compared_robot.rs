//! One of two robots whose axes and frames are compared: what small motions of its joints change.

use congruent_description::{Joint, JointIndex, JointRounding, LinkIndex, Robot, SmallMotion};
use congruent_kinematics::{PoseError, Screw, ScrewTree, Twist};
use nalgebra::{DMatrix, DVector};

/// A joint with what its digits leave open.
pub(crate) struct RoundedJoint<'a> {
    pub(crate) joint: &'a Joint,
    pub(crate) rounding: JointRounding,
}

/// One of the two robots: the joints and links that are compared, in the order of both.
pub(crate) struct ComparedRobot<'a> {
    pub(crate) robot: &'a Robot,
    pub(crate) screws: ScrewTree,
    pub(crate) joints: Vec<JointIndex>,
    pub(crate) links: Vec<LinkIndex>,
}

impl ComparedRobot<'_> {
    pub(crate) fn screw(&self, joint: JointIndex) -> Twist {
        self.screws.screw(joint).map_or_else(Twist::zero, Screw::twist)
    }

    /// What each motion of the rounding of a joint changes in screws and poses at zero, in the root's frame; those of its axis move
    /// the links that it carries by this share.
    pub(crate) fn columns(
        &self,
        RoundedJoint { joint, rounding }: &RoundedJoint<'_>,
        of_axes_at_links: f64,
    ) -> Vec<DVector<f64>> {
        if rounding.values() == 0 {
            return Vec::new();
        }
        let root_from_parent = self.screws.home(joint.parent).to_isometry();
        let in_root = |motion: &SmallMotion| {
            let moved = motion.expressed_in(&root_from_parent);
            Twist { angular: moved.angular_rad, linear: moved.linear_m }
        };
        let carried = self.carried(joint);
        let of_origin = rounding.origin.iter().map(in_root).map(|motion| {
            let of_joint = |index: &JointIndex| {
                let is_moved = carried[self.robot.joint(*index).child.get()];
                if is_moved { rate_of(&self.screw(*index), &motion) } else { Twist::zero() }
            };
            let of_link = |link: &LinkIndex| if carried[link.get()] { motion } else { Twist::zero() };
            rows(self.joints.iter().map(of_joint).chain(self.links.iter().map(of_link)))
        });
        let of_axis = rounding.axis.iter().map(in_root).map(|motion| {
            let of_joint = |index: &JointIndex| {
                let is_its = self.robot.joint(*index).child == joint.child;
                if is_its { rate_of(&self.screw(*index), &motion) } else { Twist::zero() }
            };
            let at_links = Twist {
                angular: motion.angular * of_axes_at_links,
                linear: motion.linear * of_axes_at_links,
            };
            let of_link = |link: &LinkIndex| if carried[link.get()] { at_links } else { Twist::zero() };
            rows(self.joints.iter().map(of_joint).chain(self.links.iter().map(of_link)))
        });
        let of_frame = rounding.frame.iter().map(in_root).map(|motion| {
            let of_link = |link: &LinkIndex| if *link == joint.child { motion } else { Twist::zero() };
            rows(self.joints.iter().map(|_| Twist::zero()).chain(self.links.iter().map(of_link)))
        });
        of_origin.chain(of_axis).chain(of_frame).collect()
    }

    /// For each link whether a joint carries it.
    fn carried(&self, joint: &Joint) -> Vec<bool> {
        let mut carried = vec![false; self.robot.links().len()];
        carried[joint.child.get()] = true;
        // Parents come before their children.
        for below in self.robot.joints() {
            carried[below.child.get()] |= carried[below.parent.get()];
        }
        carried
    }

    /// The largest sum of what these parts of all motions move a link at zero.
    pub(crate) fn largest_at_links(&self, effects: &DMatrix<f64>, parts: &DVector<f64>) -> PoseError {
        let of_link = |(at, link): (usize, &LinkIndex)| {
            let (first, point) = (6 * (self.joints.len() + at), self.screws.home(*link).translation);
            let vector =
                |column: usize, from: usize| effects.fixed_view::<3, 1>(from, column) * parts[column];
            let motions =
                (0..effects.ncols()).map(|column| [vector(column, first), vector(column, first + 3)]);
            motions.fold(PoseError::default(), |sum, [angular, linear]| PoseError {
                position_m: sum.position_m + (linear + angular.cross(&point)).norm(),
                orientation_rad: sum.orientation_rad + angular.norm(),
            })
        };
        self.links.iter().enumerate().map(of_link).fold(PoseError::default(), PoseError::larger)
    }
}

/// How a screw changes if a motion carries its axis along: the bracket of the two.
///
/// Source: Lynch & Park, *Modern Robotics* (2017), definition 8.5.
fn rate_of(screw: &Twist, motion: &Twist) -> Twist {
    let angular = motion.angular.cross(&screw.angular);
    let linear = motion.angular.cross(&screw.linear) + motion.linear.cross(&screw.angular);
    Twist { angular, linear }
}

pub(crate) fn rows(twists: impl Iterator<Item = Twist>) -> DVector<f64> {
    let numbers = twists
        .flat_map(|of| [of.angular.x, of.angular.y, of.angular.z, of.linear.x, of.linear.y, of.linear.z]);
    DVector::from_vec(numbers.collect())
}
