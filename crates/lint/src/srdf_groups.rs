//! Groups of an SRDF and their named states: defined twice, without members, or at positions beyond the joint limits.

use std::collections::BTreeMap;

use congruent_description::{
    Robot,
    node::{elements, label, tag},
};
use congruent_input::{Diagnostic, display::quantity};
use roxmltree::Node;

use crate::codes;

/// The findings about groups and states; positions are compared with the limits of the robot, if the robot is known.
pub(super) fn examine_groups(root: Node<'_, '_>, robot: Option<&Robot>) -> Vec<Diagnostic> {
    let mut found = defined_twice(root);
    found.extend(elements(root, "group").filter_map(without_members));
    let values = elements(root, "group_state").flat_map(|state| elements(state, "joint"));
    found.extend(values.filter_map(|joint| value(joint, robot)));
    found
}

/// Groups, and states of one group, must have different names: planners use only one of two with the same name.
fn defined_twice(root: Node<'_, '_>) -> Vec<Diagnostic> {
    let mut first = BTreeMap::new();
    let mut found = Vec::new();
    for node in root.children().filter(|node| node.has_tag_name("group") || node.has_tag_name("group_state"))
    {
        let key = (node.tag_name().name(), node.attribute("group"), node.attribute("name"));
        if key.2.is_none() {
            continue;
        }
        if let Some(before) = first.get(&key) {
            let message = format!("{} is defined twice", label(node));
            let warning = Diagnostic::warning(codes::srdf::TWICE, message).at(tag(node));
            let help = "motion planners use only one of the two: remove or rename the other";
            found.push(warning.related_to(tag(*before), "the first is here").with_help(help));
        } else {
            first.insert(key, node);
        }
    }
    found
}

fn without_members(group: Node<'_, '_>) -> Option<Diagnostic> {
    if group.children().any(|node| node.is_element()) {
        return None;
    }
    let warning = Diagnostic::warning(codes::srdf::EMPTY_GROUP, format!("{} has no members", label(group)));
    let help = "add <joint>, <link>, <chain> or <group> elements: nothing can be planned for an empty group";
    Some(warning.at(tag(group)).with_help(help))
}

/// A warning if the position of a state is not a number, or is beyond the limits of the joint.
fn value(joint: Node<'_, '_>, robot: Option<&Robot>) -> Option<Diagnostic> {
    let name = joint.attribute("name")?;
    let state = joint.parent_element().map(label)?;
    let warning = |code, what: String| {
        Some(Diagnostic::warning(code, format!("{state}: joint \"{name}\" {what}")).at(tag(joint)))
    };
    let Some(text) = joint.attribute("value").filter(|text| !text.trim().is_empty()) else {
        return warning(codes::srdf::VALUE, "has no value".to_owned());
    };
    // A joint with several degrees of freedom, such as a virtual one, has several values.
    let values: Result<Vec<f64>, _> = text.split_whitespace().map(str::parse::<f64>).collect();
    let Some(values) = values.ok().filter(|values| values.iter().all(|value| value.is_finite())) else {
        return warning(codes::srdf::VALUE, format!("has the value \"{text}\", which is not a number"));
    };
    let robot = robot?;
    let of_robot = robot.joint(robot.find_joint(name)?);
    let (limit, unit) = (of_robot.limit.as_ref()?, of_robot.kind.unit());
    let &[position] = &values[..] else { return None };
    // Positions at a limit are written with fewer digits than the limit.
    let slack = POSITION_DIGITS * limit.lower.abs().max(limit.upper.abs()).max(1.0);
    if !of_robot.kind.is_movable() || (limit.lower - slack..=limit.upper + slack).contains(&position) {
        return None;
    }
    let [at, lower, upper] = [position, limit.lower, limit.upper].map(|value| quantity(value, unit));
    let by = quantity((position - limit.upper).max(limit.lower - position), unit);
    let found = warning(
        codes::srdf::BEYOND_LIMIT,
        format!("is at {at}, {by} beyond its limits from {lower} to {upper}"),
    )?;
    Some(
        found.with_help(format!(
            "positions of a state are in {unit}; planners refuse a goal beyond the limits"
        )),
    )
}

/// Part by which a position may exceed its limit by the rounding of its digits. Kind: rounding of four decimals.
const POSITION_DIGITS: f64 = 1e-4;

#[cfg(test)]
mod tests {
    use super::*;
    use congruent_description::parse_urdf;
    use congruent_input::xml;

    const URDF: &str = "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='revolute'>\
                        <limit lower='-1' upper='2' velocity='1' effort='1'/><parent link='a'/><child link='b'/></joint></robot>";

    #[test]
    fn groups_and_states_are_examined() {
        let robot = parse_urdf(URDF).unwrap();
        let good = "<robot name='r'><group name='arm'><joint name='j'/></group>\
                    <group_state name='home' group='arm'><joint name='j' value='2.00001'/></group_state>\
                    <group_state name='home' group='hand'><joint name='j' value='-1 0 0'/></group_state></robot>";
        let examined = |text: &str| -> Vec<String> {
            let document = xml::parse(text).unwrap();
            let found = examine_groups(document.root_element(), Some(&robot));
            found.into_iter().map(|found| found.message).collect()
        };
        assert_eq!(examined(good), [""; 0]);
        for (from, to, message) in [
            ("<joint name='j'/>", "", "group \"arm\" has no members"),
            (
                "</group>",
                "</group><group name='arm'><link name='b'/></group>",
                "group \"arm\" is defined twice",
            ),
            ("group='hand'", "group='arm'", "group_state \"home\" is defined twice"),
            (
                "2.00001",
                "2.001",
                "joint \"j\" is at 115 deg, 0.0573 deg beyond its limits from -57.3 deg to 115 deg",
            ),
            ("2.00001", "-90", "beyond its limits"),
            ("2.00001", "zero", "joint \"j\" has the value \"zero\", which is not a number"),
            ("2.00001", "nan", "which is not a number"),
            (" value='2.00001'", "", "joint \"j\" has no value"),
        ] {
            assert!(good.contains(from), "{from}");
            let found = examined(&good.replacen(from, to, 1));
            assert!(found.len() == 1 && found[0].contains(message), "{to}: {found:?}");
        }
    }
}
