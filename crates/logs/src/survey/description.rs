//! The name of the robot in a description that was recorded.

use super::report::RobotInLog;
use crate::{
    descriptions::{Descriptions, LastDescription},
    event::LogTopic,
};

/// The description that was recorded last.
pub(super) fn robot_in_log(found: &Descriptions, topics: &[LogTopic]) -> Option<RobotInLog> {
    let LastDescription { description, changes } = found.all().last()?;
    Some(RobotInLog {
        topic: topics[description.topic].name.clone(),
        robot: robot_name(&description.text),
        bytes: description.text.len(),
        changes: *changes,
    })
}

/// The name that the root element gives. It is searched instead of parsed: a survey does not judge the description.
fn robot_name(text: &str) -> Option<String> {
    let roots = [("<robot", "name"), ("<mujoco", "model")];
    roots.iter().find_map(|(root, key)| {
        let element = &text[text.find(root)? + root.len()..];
        let attributes = &element[..element.find('>')?];
        let behind = &attributes[attributes.find(&format!(" {key}="))? + key.len() + 2..];
        let quote = behind.chars().next().filter(|letter| ['"', '\''].contains(letter))?;
        behind[1..].split_once(quote).map(|(name, _)| name.to_owned())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_root_elements() {
        let name = |text| robot_name(text);
        assert_eq!(name("<?xml version='1.0'?><robot name=\"ur5e\">").as_deref(), Some("ur5e"));
        assert_eq!(name("<mujoco model='so_arm'><x/>").as_deref(), Some("so_arm"));
        for text in ["", "<robot", "<robot>", "<robot name=>", "<robot name=\"a>", "\u{e9}<robot name=\u{e9}"]
        {
            assert_eq!(name(text), None, "{text}");
        }
    }
}
