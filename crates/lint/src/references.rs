//! Joints and links that the sections for other programs refer to: transmissions, `ros2_control`, Gazebo.

use congruent_description::{
    Robot, RobotDescription,
    node::{elements, label, tag},
};
use congruent_input::{Diagnostic, Diagnostics, known_names, xml};
use roxmltree::Node;

use crate::codes;

/// Warnings of joints and links that sections for other programs name and the robot does not have: these programs ignore the
/// section, or do not start.
pub fn unknown_references(description: &RobotDescription) -> Vec<Diagnostic> {
    let Some(places) = &description.places.urdf else { return Vec::new() };
    let Ok(document) = xml::parse(&places.source().text) else { return Vec::new() };
    let (root, robot) = (document.root_element(), &description.robot);
    let mut found = Diagnostics::default();
    for section in ["transmission", "ros2_control"] {
        for section in elements(root, section) {
            let joints = elements(section, "joint");
            found.extend(joints.filter_map(|joint| unknown_joint(section, joint, robot)));
        }
    }
    found.extend(elements(root, "gazebo").filter_map(|section| unknown_reference(section, robot)));
    found.in_file(places.source())
}

fn unknown_joint(section: Node<'_, '_>, joint: Node<'_, '_>, robot: &Robot) -> Option<Diagnostic> {
    let name = joint.attribute("name")?;
    if robot.find_joint(name).is_some() {
        return None;
    }
    let message = format!("{} names joint \"{name}\", which the robot does not have", label(section));
    let joints = robot.joints().iter().map(|joint| joint.name.as_str());
    Some(warning(message, name, joint).with_help(known_names(name, "joints", joints)))
}

fn unknown_reference(section: Node<'_, '_>, robot: &Robot) -> Option<Diagnostic> {
    let name = section.attribute("reference").filter(|name| !name.is_empty())?;
    if robot.find_joint(name).is_some() || robot.find_link(name).is_some() {
        return None;
    }
    let message = format!("<gazebo> refers to \"{name}\", which is neither a link nor a joint of the robot");
    let links = robot.links().iter().map(|link| link.name.as_str());
    let all = links.chain(robot.joints().iter().map(|joint| joint.name.as_str()));
    Some(warning(message, name, section).with_help(known_names(name, "names", all)))
}

fn warning(message: String, name: &str, node: Node<'_, '_>) -> Diagnostic {
    Diagnostic::warning(codes::urdf::UNKNOWN_REFERENCE, message)
        .one_of("names in <transmission>, <ros2_control> or <gazebo> are not in the robot", name)
        .at(tag(node))
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use congruent_description::parse_robot;
    use congruent_input::SourceFile;

    #[test]
    fn sections_name_what_there_is() {
        let findings = |section: &str| {
            let text = format!(
                "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='fixed'><parent link='a'/>\
                 <child link='b'/></joint>{section}</robot>"
            );
            let source = Arc::new(SourceFile { path: "r.urdf".into(), text, is_foreign: false });
            let found = unknown_references(&parse_robot(None, &source).unwrap());
            found.into_iter().map(|found| found.message).collect::<Vec<_>>()
        };
        for known in [
            "<transmission name='t'><joint name='j'/><actuator name='m'/></transmission>",
            "<ros2_control name='s' type='system'><joint name='j'/><gpio name='io'/><sensor name='f'/></ros2_control>",
            "<gazebo reference='a'/><gazebo reference='j'/><gazebo><plugin/></gazebo>",
        ] {
            assert_eq!(findings(known), [""; 0], "{known}");
        }
        for (unknown, message) in [
            (
                "<transmission name='t'><joint name='k'/></transmission>",
                "transmission \"t\" names joint \"k\"",
            ),
            (
                "<ros2_control name='s'><joint name='k'/></ros2_control>",
                "ros2_control \"s\" names joint \"k\"",
            ),
            ("<gazebo reference='c'/>", "<gazebo> refers to \"c\""),
        ] {
            let found = findings(unknown);
            assert!(found.len() == 1 && found[0].contains(message), "{unknown}: {found:?}");
        }
    }
}
