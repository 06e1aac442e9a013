//! A base that is turned about the first axis of the arm: another zero of the first joint moves everything alike.

use congruent_description::RobotDescription;
use congruent_kinematics::ScrewTree;
use nalgebra::{Isometry3, Point3};

/// The first joint, if another zero of it moves everything as this pose of the other root does.
pub(super) fn turned_first_joint<'a>(
    description: &'a RobotDescription,
    root_from_other_root: &Isometry3<f64>,
) -> Option<&'a str> {
    /// Rounding of a fitted base. Unit: rad and m.
    const SAME: f64 = 1e-6;
    let first = *description.moving_chain().first()?;
    let screw = ScrewTree::new(&description.robot).screw(first)?.twist();
    let turn = root_from_other_root.rotation.axis()?;
    let is_about_axis = screw.angular.cross(&turn).norm() < SAME && screw.angular.norm() > SAME;
    let on_axis = Point3::from(screw.angular.cross(&screw.linear));
    let is_still = (root_from_other_root * on_axis - on_axis).norm() < SAME;
    (is_about_axis && is_still).then(|| description.robot.joint(first).name.as_str())
}
