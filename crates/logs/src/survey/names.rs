//! Names of joints in a log against those of a robot.

/// How a name in a log is one of the robot.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct NameMatch {
    /// Index among the names of the robot.
    pub(super) joint: usize,
    /// What the log has before and behind the name of the robot.
    pub(super) prefix: String,
    pub(super) suffix: String,
    /// What the robot has before the name in the log.
    pub(super) prefix_of_robot: String,
}

/// The joint of the robot that a name in a log is: the same name, the longest name that it ends or begins with, or the only name
/// that ends with it. Names end at a character that is no letter and no digit.
pub(super) fn match_name(name: &str, robot: &[String]) -> Option<NameMatch> {
    let matched = |joint: usize, prefix: &str, suffix: &str, prefix_of_robot: &str| NameMatch {
        joint,
        prefix: prefix.to_owned(),
        suffix: suffix.to_owned(),
        prefix_of_robot: prefix_of_robot.to_owned(),
    };
    if let Some(joint) = robot.iter().position(|known| known == name) {
        return Some(matched(joint, "", "", ""));
    }
    let longer =
        robot.iter().enumerate().filter(|(_, known)| !known.is_empty()).filter_map(|(joint, known)| {
            let ends = name.strip_suffix(known.as_str()).filter(|prefix| ends_word(prefix));
            let begins = || name.strip_prefix(known.as_str()).filter(|suffix| begins_word(suffix));
            let found = ends.map(|prefix| matched(joint, prefix, "", ""));
            found.or_else(|| begins().map(|suffix| matched(joint, "", suffix, "")))
        });
    if let Some(found) = longer.max_by_key(|found| robot[found.joint].len()) {
        return Some(found);
    }
    let shorter = |known: &String| known.strip_suffix(name).is_some_and(ends_word);
    let mut shorter = robot.iter().enumerate().filter(|(_, known)| !name.is_empty() && shorter(known));
    match (shorter.next(), shorter.next()) {
        (Some((joint, known)), None) => Some(matched(joint, "", "", &known[..known.len() - name.len()])),
        _ => None,
    }
}

fn ends_word(prefix: &str) -> bool {
    prefix.chars().next_back().is_some_and(|letter| !letter.is_alphanumeric())
}

fn begins_word(suffix: &str) -> bool {
    suffix.chars().next().is_some_and(|letter| !letter.is_alphanumeric())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(name: &str, robot: &[&str], expected: Option<(usize, &str, &str, &str)>) {
        let robot: Vec<String> = robot.iter().map(|&name| name.to_owned()).collect();
        let found = match_name(name, &robot);
        let found = found.as_ref().map(|found| {
            (found.joint, found.prefix.as_str(), found.suffix.as_str(), found.prefix_of_robot.as_str())
        });
        assert_eq!(found, expected, "{name}");
    }

    #[test]
    fn names_with_more_or_less_than_those_of_the_robot() {
        let robot = ["joint_1", "arm_joint_1", "elbow"];
        check("joint_1", &robot, Some((0, "", "", "")));
        check("left_arm_joint_1", &robot, Some((1, "left_", "", "")));
        check("elbow/position", &robot, Some((2, "", "/position", "")));
        check("belbow", &robot, None);
        check("1", &robot, None);
        check("joint1", &["panda_joint1", "panda_joint2"], Some((0, "", "", "panda_")));
        check("", &robot, None);
    }
}
