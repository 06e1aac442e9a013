//! Limits of 0, which mean "not given" to some readers and "cannot move" to others.

use std::collections::BTreeMap;

use crate::{
    description::RobotDescription,
    diagnostic::{Diagnostic, Diagnostics},
    model::{Joint, JointLimit},
    urdf::node::{elements, place},
    xml,
};

/// A limit of a joint by its attribute, and what is told if it is 0.
struct Limit {
    key: &'static str,
    of: fn(&JointLimit) -> Option<f64>,
    words: &'static str,
    help: &'static str,
    /// Whether files write 0 for all joints if they know none, and whether that is harmless.
    is_idiom: bool,
}

const LIMITS: [Limit; 2] = [
    Limit {
        key: "velocity",
        of: |limit| limit.velocity,
        words: "joints have a velocity limit of 0, which is taken as not given",
        help: "give what the joint can do: motions in the least time need it, and other planners take 0 as a joint that must \
               not move",
        is_idiom: false,
    },
    Limit {
        key: "effort",
        of: |limit| limit.effort,
        words: "joints have an effort limit of 0 while others have one; it is taken as not given",
        help: "give what the drive can do: in physics the joint has unlimited effort until then",
        is_idiom: true,
    },
];

/// Velocity and effort limits of 0 of joints that are driven and can move. An effort of 0 everywhere is how many published
/// files say that none is known: it is told only beside others.
pub fn zero_limits(description: &RobotDescription) -> Vec<Diagnostic> {
    let Some(places) = &description.places.urdf else { return Vec::new() };
    let Ok(document) = xml::parse(&places.source().text) else { return Vec::new() };
    let joints: BTreeMap<&str, roxmltree::Node<'_, '_>> = elements(document.root_element(), "joint")
        .filter_map(|node| Some((node.attribute("name")?, node)))
        .collect();
    let driven = || description.robot.joints().iter().filter(|joint| is_driven(joint));
    let mut found = Diagnostics::default();
    for limit in &LIMITS {
        let value = |joint: &Joint| joint.limit.as_ref().and_then(limit.of);
        if limit.is_idiom && driven().all(|joint| value(joint).is_none_or(|value| value == 0.0)) {
            continue;
        }
        for joint in driven().filter(|joint| value(joint) == Some(0.0)) {
            let message = format!(
                "joint \"{}\": its {} limit is 0, which is taken as not given",
                joint.name, limit.key
            );
            let warning = Diagnostic::warning("urdf::zero_limit", message)
                .one_of(limit.words, joint.name.as_str())
                .with_help(limit.help);
            let node = joints.get(joint.name.as_str());
            found.push(warning.at(node.map_or(0..0, |node| place(*node, "limit"))));
        }
    }
    found.in_file(places.source())
}

/// Whether a joint has a drive of its own and a range to move in.
fn is_driven(joint: &Joint) -> bool {
    let is_locked = joint.position_range().is_some_and(|(lower, upper)| lower >= upper);
    joint.kind.is_movable() && joint.mimic.is_none() && !is_locked
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::{diagnostic::SourceFile, load::parse_robot};

    /// The messages about two joints in a row with these attributes of their limits.
    fn told(limits: [&str; 2], kind: &str) -> Vec<String> {
        let joint = |(at, limit): (usize, &str)| {
            format!(
                "<link name='l{}'/><joint name='j{at}' type='{kind}'><parent link='l{at}'/>\
                 <child link='l{}'/><limit lower='0' upper='1' {limit}/></joint>\n",
                at + 1,
                at + 1
            )
        };
        let joints: String = limits.into_iter().enumerate().map(joint).collect();
        let text = format!("<robot name='r'><link name='l0'/>\n{joints}</robot>");
        let source = Arc::new(SourceFile { path: "r.urdf".into(), text });
        let found = zero_limits(&parse_robot(None, &source).unwrap());
        assert!(
            found
                .iter()
                .all(|found| found.code == "urdf::zero_limit" && found.severity < crate::Severity::Error)
        );
        found.into_iter().map(|found| found.message).collect()
    }

    #[test]
    fn a_velocity_of_0_is_told_and_an_effort_of_0_beside_others() {
        let [none, both] = ["velocity='1' effort='0'", "velocity='1' effort='2'"];
        assert_eq!(told([none, none], "revolute"), [""; 0]);
        assert_eq!(told([both, both], "prismatic"), [""; 0]);
        let one = "joint \"j0\": its effort limit is 0, which is taken as not given";
        assert_eq!(told([none, both], "revolute"), [one]);
        let still = "velocity='0' effort='2'";
        assert!(told([both, still], "continuous")[0].starts_with("joint \"j1\": its velocity limit is 0"));
        assert!(told([still, still], "revolute")[0].starts_with("2 joints have a velocity limit of 0"));
        assert_eq!(told([still, still], "fixed"), [""; 0]);
    }
}
