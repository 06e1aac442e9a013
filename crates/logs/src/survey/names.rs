//! Names of joints in a log against those of a robot.

use std::{cmp::Reverse, collections::BTreeMap};

/// How a name in a log is one of the robot.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct NameMatch {
    /// Index among the names of the robot.
    pub(super) joint: usize,
    pub(super) difference: NameDifference,
}

/// What names in a log have more or less than those of the robot; all empty if they are the same.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(super) struct NameDifference {
    /// What the log has before and behind the name of the robot.
    pub(super) prefix: String,
    pub(super) suffix: String,
    /// What the robot has before the name in the log.
    pub(super) prefix_of_robot: String,
}

impl NameDifference {
    fn length(&self) -> usize {
        self.prefix.len() + self.suffix.len() + self.prefix_of_robot.len()
    }
}

/// The joints of the robot that names in a log are, for each name. The names of a topic have one difference as a rule: the same
/// name first, then the difference that most names have, and of two that as many have the shorter one. Joints that `is_taken`,
/// or that an earlier difference has found, are not found again.
pub(super) fn match_names(
    names: &[&str],
    robot: &[String],
    is_taken: impl Fn(usize) -> bool,
) -> Vec<Option<NameMatch>> {
    let candidates: Vec<Vec<NameMatch>> = names.iter().map(|name| candidates(name, robot)).collect();
    let mut counts: BTreeMap<&NameDifference, usize> = BTreeMap::new();
    for candidate in candidates.iter().flatten() {
        *counts.entry(&candidate.difference).or_default() += 1;
    }
    let mut differences: Vec<(&NameDifference, usize)> =
        counts.iter().map(|(of, count)| (*of, *count)).collect();
    differences.sort_by_key(|(of, count)| (of.length() > 0, Reverse(*count), of.length()));
    let mut taken: Vec<bool> = (0..robot.len()).map(is_taken).collect();
    let mut found = vec![None; names.len()];
    for (difference, count) in differences {
        for (name, candidates) in found.iter_mut().zip(&candidates).filter(|(name, _)| name.is_none()) {
            let free = || candidates.iter().filter(|candidate| !taken[candidate.joint]);
            let Some(candidate) = free().find(|candidate| candidate.difference == *difference) else {
                continue;
            };
            // Of an arm whose names lack the prefix nothing says whether it is the left or the right one.
            let is_other = |of: &NameDifference| {
                of != difference && !of.prefix_of_robot.is_empty() && counts[of] == count
            };
            if difference.prefix_of_robot.is_empty() || !free().any(|of| is_other(&of.difference)) {
                taken[candidate.joint] = true;
                *name = Some(candidate.clone());
            }
        }
    }
    found
}

/// The joints that a name may be: of the same name, or one with more or less. Names end at a character that is no letter and no
/// digit.
fn candidates(name: &str, robot: &[String]) -> Vec<NameMatch> {
    let difference = |known: &str| {
        let mut found = NameDifference::default();
        if known == name {
            return Some(found);
        }
        if known.is_empty() || name.is_empty() {
            return None;
        }
        if let Some(prefix) = name.strip_suffix(known).filter(|prefix| ends_word(prefix)) {
            prefix.clone_into(&mut found.prefix);
        } else if let Some(suffix) = name.strip_prefix(known).filter(|suffix| begins_word(suffix)) {
            suffix.clone_into(&mut found.suffix);
        } else {
            let prefix = known.strip_suffix(name).filter(|prefix| ends_word(prefix))?;
            prefix.clone_into(&mut found.prefix_of_robot);
        }
        Some(found)
    };
    let joints = robot.iter().enumerate();
    joints.filter_map(|(joint, known)| Some(NameMatch { joint, difference: difference(known)? })).collect()
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

    /// The joints of the names, with their differences.
    fn matched(names: &[&str], robot: &[&str]) -> Vec<Option<(usize, String)>> {
        let robot: Vec<String> = robot.iter().map(|&name| name.to_owned()).collect();
        let words =
            |of: &NameDifference| [&of.prefix, &of.suffix, &of.prefix_of_robot].map(String::as_str).join("|");
        let found = match_names(names, &robot, |_| false);
        found.into_iter().map(|found| found.map(|of| (of.joint, words(&of.difference)))).collect()
    }

    #[track_caller]
    fn check(name: &str, robot: &[&str], expected: Option<(usize, &str)>) {
        let expected = expected.map(|(joint, difference)| (joint, difference.to_owned()));
        assert_eq!(matched(&[name], robot), [expected], "{name}");
    }

    #[test]
    fn names_with_more_or_less_than_those_of_the_robot() {
        let robot = ["joint_1", "arm_joint_1", "elbow"];
        check("joint_1", &robot, Some((0, "||")));
        check("left_arm_joint_1", &robot, Some((1, "left_||")));
        check("elbow/position", &robot, Some((2, "|/position|")));
        check("belbow", &robot, None);
        check("1", &robot, None);
        check("joint1", &["panda_joint1", "panda_joint2"], Some((0, "||panda_")));
        check("", &robot, None);
    }

    #[test]
    fn the_difference_is_that_of_most_names() {
        let arm: Vec<String> = (1..=7).map(|at| format!("joint{at}")).collect();
        let arm: Vec<&str> = arm.iter().map(String::as_str).collect();
        let with = |prefix: &str| arm.iter().map(|name| format!("{prefix}{name}")).collect::<Vec<_>>();
        let panda =
            [with("panda_"), vec!["panda_finger_joint1".to_owned(), "panda_finger_joint2".to_owned()]]
                .concat();
        let panda: Vec<&str> = panda.iter().map(String::as_str).collect();
        let expected: Vec<_> = (0..7).map(|at| Some((at, "||panda_".to_owned()))).collect();
        assert_eq!(matched(&arm, &panda), expected);
        // The other way round, the fingers are none of the arm.
        let found = matched(&panda, &arm);
        assert!(found[..7].iter().all(|of| of.as_ref().is_some_and(|of| of.1 == "panda_||")), "{found:?}");
        assert_eq!(found[7..], [None, None]);
    }

    #[test]
    fn which_of_two_arms_is_not_guessed() {
        let arms = ["left_joint1", "left_joint2", "right_joint1", "right_joint2"];
        assert_eq!(matched(&["joint1", "joint2"], &arms), [None, None]);
    }
}
