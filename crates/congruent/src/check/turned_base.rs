//! A base that is turned about the first axis of the arm: another zero of the first joint moves everything alike.

use congruent_description::{JointElement, RobotDescription};
use congruent_kinematics::ScrewTree;
use nalgebra::{Isometry3, Point3};

use super::cause_in_words::place;

/// The first joint with another zero, in words, if that moves everything as this pose of the other root does:
/// `j1 has another zero (robot.toml:10)`.
pub(super) fn zero_of_first_joint(
    description: &RobotDescription,
    root_from_other_root: &Isometry3<f64>,
) -> Option<String> {
    /// Rounding of a fitted base. Unit: rad and m.
    const SAME: f64 = 1e-6;
    let first = *description.moving_chain().first()?;
    let screw = ScrewTree::new(&description.robot).screw(first)?.twist();
    let turn = root_from_other_root.rotation.axis()?;
    let is_about_axis = screw.angular.cross(&turn).norm() < SAME && screw.angular.norm() > SAME;
    let on_axis = Point3::from(screw.angular.cross(&screw.linear));
    let is_still = (root_from_other_root * on_axis - on_axis).norm() < SAME;
    let joint = &description.robot.joint(first).name;
    (is_about_axis && is_still)
        .then(|| format!("{joint} has another zero{}", place_of_origin(description, joint)))
}

/// The line of a joint's origin in the URDF or MJCF.
fn place_of_origin(description: &RobotDescription, joint: &str) -> String {
    let found = description.places.parameters().and_then(|places| {
        let line = places.joint_part(joint, JointElement::Origin)?.line_in(places.source());
        Some(place(places.source().path.to_str(), line))
    });
    found.unwrap_or_default()
}
