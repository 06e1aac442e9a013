//! The joints of all topics against those of a robot.

use congruent_input::nearest;
use congruent_robot::Robot;

use super::{
    joints::JointsTrack,
    limits::{RobotLimits, moving_names},
    names::NameMatch,
    report::{JointSource, RobotOfLog, UnknownJoint},
};

/// Compares the joints of topics, each with its name, with those of a robot.
pub(super) fn compare<'a>(
    robot: &Robot,
    topics: impl Iterator<Item = (&'a str, &'a JointsTrack)>,
) -> RobotOfLog {
    let names = moving_names(robot);
    let (mut sources, mut unknown, mut limits) = (Vec::new(), Vec::new(), RobotLimits::new());
    for (topic, track) in topics {
        for joint in &track.joints {
            let Some(matched) = &joint.of_robot else {
                let nearest = nearest(&joint.name, names.iter().map(String::as_str)).map(str::to_owned);
                unknown.push(UnknownJoint { topic: topic.to_owned(), name: joint.name.clone(), nearest });
                continue;
            };
            let of_robot = &names[matched.joint];
            source(&mut sources, topic, matched).joints.push(of_robot.clone());
            joint.limits.iter().for_each(|track| limits.add(of_robot, track));
        }
    }
    let is_found = |name: &str| sources.iter().any(|source| source.joints.iter().any(|joint| joint == name));
    // A joint that follows another is computed, whether it is published or not.
    let needed =
        robot.movable_joints().iter().map(|&joint| robot.joint(joint)).filter(|joint| joint.mimic.is_none());
    let missing = needed.filter(|joint| !is_found(&joint.name)).map(|joint| joint.name.clone()).collect();
    let position_unit = limits.unit();
    let limits = limits.report();
    RobotOfLog { robot: robot.name().to_owned(), sources, missing, unknown, position_unit, limits }
}

/// The joints of a topic with this difference of their names.
fn source<'a>(sources: &'a mut Vec<JointSource>, topic: &str, matched: &NameMatch) -> &'a mut JointSource {
    let NameMatch { difference, .. } = matched;
    let is_same = |source: &JointSource| {
        (source.topic.as_str(), &source.prefix, &source.suffix, &source.prefix_of_robot)
            == (topic, &difference.prefix, &difference.suffix, &difference.prefix_of_robot)
    };
    let at = sources.iter().position(is_same).unwrap_or_else(|| {
        sources.push(JointSource {
            topic: topic.to_owned(),
            prefix: difference.prefix.clone(),
            suffix: difference.suffix.clone(),
            prefix_of_robot: difference.prefix_of_robot.clone(),
            joints: Vec::new(),
        });
        sources.len() - 1
    });
    &mut sources[at]
}
