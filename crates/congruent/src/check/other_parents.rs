//! Joints that hang on another link in the other description: with equal names all behind them is elsewhere, which no value of a joint
//! explains.

use congruent_description::{Joint, JointElement, RobotDescription};

/// Joints with a name and a child in both descriptions whose parents are different links that both have, in words: `joint "elbow" hangs on
/// link "base" (a.urdf:12), and on link "upper_arm" in b.urdf:9`.
pub(super) fn other_parents([description, other]: [&RobotDescription; 2]) -> Vec<String> {
    let (robot, there) = (&description.robot, &other.robot);
    let differs = |joint: &Joint| {
        let namesake = there.joint(there.find_joint(&joint.name)?);
        let [parent, child] = [joint.parent, joint.child].map(|link| &robot.link(link).name);
        let [other_parent, other_child] =
            [namesake.parent, namesake.child].map(|link| &there.link(link).name);
        let are_known = there.find_link(parent).is_some() && robot.find_link(other_parent).is_some();
        let at = |of: &RobotDescription| {
            let place =
                of.places.parameters().and_then(|of| of.joint_part(&joint.name, JointElement::Origin));
            let file = of.urdf_path.display();
            place.map_or_else(|| file.to_string(), |place| format!("{file}:{}", place.line()))
        };
        (parent != other_parent && child == other_child && are_known).then(|| {
            format!(
                "joint \"{}\" hangs on link \"{parent}\" in {}, and on link \"{other_parent}\" in {}",
                joint.name,
                at(description),
                at(other)
            )
        })
    };
    robot.joints().iter().filter_map(differs).collect()
}
