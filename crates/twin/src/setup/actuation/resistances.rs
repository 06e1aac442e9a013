//! Damping, dry friction and armature of each joint: the description's values, or those of `[joints]`.

use congruent_description::Robot;
use congruent_dynamics::JointResistance;
use congruent_input::Findings;
use congruent_scenario::{FilePlace, JointNumbers, JointSettings, Range};

use super::joint_numbers::{NumberRule, Unnamed, resolve};

/// One for each movable joint.
///
/// # Errors
/// Every joint that is unknown and every number that is negative or not finite.
pub(in crate::setup) fn resistances(
    settings: &JointSettings,
    place: FilePlace<'_>,
    robot: &Robot,
) -> Result<Vec<JointResistance>, Findings> {
    let joints = || robot.movable_joints().iter().map(|&joint| robot.joint(joint));
    let mut errors = Vec::new();
    let mut numbers = |numbers: &Option<JointNumbers>, key: &str, described: Vec<f64>| {
        let Some(numbers) = numbers else { return described };
        let unnamed = Unnamed::Described(&described);
        let rule = NumberRule { what: key, range: Range::NonNegative, unnamed, of_angles: None };
        let replaced = resolve(numbers, rule, place.key(key), robot);
        replaced.map_err(|found| errors.extend(found)).unwrap_or(described)
    };
    let damping = numbers(&settings.damping, "damping", joints().map(|joint| joint.damping).collect());
    let friction = numbers(&settings.friction, "friction", joints().map(|joint| joint.friction).collect());
    let armature = numbers(
        &settings.armature,
        "armature",
        joints().map(|joint| joint.armature.unwrap_or(0.0)).collect(),
    );
    if !errors.is_empty() {
        return Err(errors.into());
    }
    let all = damping.into_iter().zip(friction).zip(armature);
    Ok(all.map(|((damping, friction), armature)| JointResistance { damping, friction, armature }).collect())
}
