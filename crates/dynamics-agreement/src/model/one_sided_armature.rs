//! Armatures that only one of two descriptions states, such as an MJCF beside a URDF, which has no place for them.

use congruent_description::Robot;

use super::DynamicsModel;

/// Sets armatures that only one of two robots states to zero in both models, so that they cannot differ. Joints are matched by
/// name.
///
/// Returns the index of the robot that alone states an armature other than zero; `None` if nothing is left out of the
/// comparison.
///
/// # Panics
/// If a model is not that of the robot at its index.
pub fn without_one_sided_armature(
    robots: [&Robot; 2],
    [first, second]: [&mut DynamicsModel; 2],
) -> Option<usize> {
    let mut alone = None;
    for (coordinate, &joint) in robots[0].movable_joints().iter().enumerate() {
        let own = robots[0].joint(joint);
        let Some(there) = robots[1].find_joint(&own.name) else { continue };
        let Some(other) = robots[1].coordinate(there) else { continue };
        let stated = [own.armature, robots[1].joint(there).armature];
        if stated[0].is_some() == stated[1].is_some() {
            continue;
        }
        first.resistances[coordinate].armature = 0.0;
        second.resistances[other].armature = 0.0;
        alone = alone.or_else(|| stated.iter().position(|of| of.is_some_and(|value| value != 0.0)));
    }
    alone
}
