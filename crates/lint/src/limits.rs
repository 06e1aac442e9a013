//! Limits of 0, which mean "not given" to some readers and "cannot move" to others.

use std::collections::BTreeMap;

use congruent_description::{
    Joint, JointLimit, RobotDescription,
    node::{elements, place},
};
use congruent_input::{Diagnostic, Diagnostics, xml};

use crate::codes;

/// A limit of a joint by its attribute, and the texts of the warning if it is 0.
struct ZeroLimitRule {
    key: &'static str,
    of: fn(&JointLimit) -> Option<f64>,
    words: &'static str,
    help: &'static str,
    /// Whether files commonly write 0 for all joints to say "unknown", so that only a mixture of 0 and others is reported.
    is_idiom: bool,
}

const ZERO_LIMIT_RULES: [ZeroLimitRule; 2] = [
    ZeroLimitRule {
        key: "velocity",
        of: |limit| limit.velocity,
        words: "joints have a velocity limit of 0, which is taken as not given",
        help: "give the largest velocity of the joint: motions in the least time need it, and other planners take 0 to mean \
               that the joint must not move",
        is_idiom: false,
    },
    ZeroLimitRule {
        key: "effort",
        of: |limit| limit.effort,
        words: "joints have an effort limit of 0, which is taken as not given, while other joints have one",
        help: "give the largest effort of the actuator: until then the effort is unlimited in the simulation",
        is_idiom: true,
    },
];

/// Warnings of velocity and effort limits of 0, for joints that have an actuator and can move. Many published files write an
/// effort of 0 for all joints if they know none: it is reported only if another joint has an effort limit.
pub fn zero_limits(description: &RobotDescription) -> Vec<Diagnostic> {
    let Some(places) = &description.places.urdf else { return Vec::new() };
    let Ok(document) = xml::parse(&places.source().text) else { return Vec::new() };
    let joints: BTreeMap<&str, roxmltree::Node<'_, '_>> = elements(document.root_element(), "joint")
        .filter_map(|node| Some((node.attribute("name")?, node)))
        .collect();
    let driven = || description.robot.joints().iter().filter(|joint| is_driven(joint));
    let mut found = Diagnostics::default();
    for limit in &ZERO_LIMIT_RULES {
        let value = |joint: &Joint| joint.limit.as_ref().and_then(limit.of);
        // If no joint has an effort limit, 0 is the exporter's word for "none" and no oversight.
        if limit.is_idiom && driven().all(|joint| value(joint).is_none_or(|value| value == 0.0)) {
            continue;
        }
        for joint in driven().filter(|joint| value(joint) == Some(0.0)) {
            let message = format!(
                "joint \"{}\": its {} limit is 0, which is taken as not given",
                joint.name, limit.key
            );
            let warning = Diagnostic::warning(codes::urdf::ZERO_LIMIT, message)
                .one_of(limit.words, joint.name.as_str())
                .with_help(limit.help);
            let node = joints.get(joint.name.as_str());
            found.push(warning.at(node.map_or(0..0, |node| place(*node, "limit"))));
        }
    }
    found.in_file(places.source())
}

/// Whether a joint has an actuator of its own (no mimic joint) and a range of more than one position.
fn is_driven(joint: &Joint) -> bool {
    let is_locked = joint.position_range().is_some_and(|(lower, upper)| lower >= upper);
    joint.kind.is_movable() && joint.mimic.is_none() && !is_locked
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use congruent_description::parse_robot;
    use congruent_input::SourceFile;

    /// The messages about two joints in a row with these attributes of their limits.
    fn findings(limits: [&str; 2], kind: &str) -> Vec<String> {
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
        let source = Arc::new(SourceFile { path: "r.urdf".into(), text, is_foreign: false });
        let found = zero_limits(&parse_robot(None, &source).unwrap());
        assert!(found.iter().all(|found| found.code.name == "urdf::zero_limit"
            && found.severity < congruent_input::Severity::Error));
        found.into_iter().map(|found| found.message).collect()
    }

    #[test]
    fn a_velocity_of_0_is_reported_and_an_effort_of_0_beside_others() {
        let [none, both] = ["velocity='1' effort='0'", "velocity='1' effort='2'"];
        assert_eq!(findings([none, none], "revolute"), [""; 0]);
        assert_eq!(findings([both, both], "prismatic"), [""; 0]);
        let one = "joint \"j0\": its effort limit is 0, which is taken as not given";
        assert_eq!(findings([none, both], "revolute"), [one]);
        let still = "velocity='0' effort='2'";
        assert!(
            findings([both, still], "continuous")[0].starts_with("joint \"j1\": its velocity limit is 0")
        );
        assert!(findings([still, still], "revolute")[0].starts_with("2 joints have a velocity limit of 0"));
        assert_eq!(findings([still, still], "fixed"), [""; 0]);
    }
}
