//! Which joints of two descriptions have the same name, or the same one except for what descriptions add: a prefix of the robot,
//! the word "joint", capitals.

use std::collections::BTreeMap;

use congruent_description::{JointIndex, Robot};

/// Pairs of joints of two robots, in the order of the first.
pub(crate) type JointPairs = Vec<[JointIndex; 2]>;

/// The moving joints of two robots that have one name.
pub(crate) fn with_one_name(a: &Robot, b: &Robot) -> JointPairs {
    let there = |&index: &JointIndex| {
        let found = b.find_joint(&a.joint(index).name)?;
        is_alike([a, b], [index, found]).then_some([index, found])
    };
    a.movable_joints().iter().filter_map(there).collect()
}

/// The moving joints that carry links of one name.
pub(crate) fn with_one_link(a: &Robot, b: &Robot) -> JointPairs {
    let there = |&index: &JointIndex| {
        let found = b.parent_joint(b.find_link(&a.link(a.joint(index).child).name)?)?;
        is_alike([a, b], [index, found]).then_some([index, found])
    };
    a.movable_joints().iter().filter_map(there).collect()
}

/// The moving joints whose names are the same without what is common to all names of a description, capitals, marks
/// between words and the word "joint". Names that are then no longer unique are not used.
pub(crate) fn with_similar_names(a: &Robot, b: &Robot) -> JointPairs {
    let [here, there] = [a, b].map(by_stem);
    let pairs = here.into_iter().filter_map(|(stem, index)| {
        let found = *there.get(&stem)?;
        is_alike([a, b], [index, found]).then_some([index, found])
    });
    let mut pairs: JointPairs = pairs.collect();
    pairs.sort();
    pairs
}

/// Whether both turn, or both slide.
pub(crate) fn is_alike(robots: [&Robot; 2], pair: [JointIndex; 2]) -> bool {
    let [a, b] = [robots[0].joint(pair[0]), robots[1].joint(pair[1])].map(|joint| joint.kind);
    b.is_movable() && a.is_angular() == b.is_angular()
}

/// The joints by the rest of their names; without those that share it.
fn by_stem(robot: &Robot) -> BTreeMap<String, JointIndex> {
    let words: Vec<Vec<String>> = robot.movable_joint_names().map(words).collect();
    let mut stems: BTreeMap<String, Vec<JointIndex>> = BTreeMap::new();
    for (words, &index) in without_common(&words).iter().zip(robot.movable_joints()) {
        stems.entry(words.concat()).or_default().push(index);
    }
    let unique = stems.into_iter().filter(|(stem, joints)| !stem.is_empty() && joints.len() == 1);
    unique.map(|(stem, joints)| (stem, joints[0])).collect()
}

/// The words of a name in small letters, numbers apart, without "joint".
fn words(name: &str) -> Vec<String> {
    let mut words: Vec<String> = vec![String::new()];
    let mut before = ' ';
    for letter in name.chars() {
        let begins = (letter.is_uppercase() && before.is_lowercase())
            || (letter.is_ascii_digit() != before.is_ascii_digit() && before.is_alphanumeric());
        if begins || !letter.is_alphanumeric() {
            words.push(String::new());
        }
        if letter.is_alphanumeric() {
            words.last_mut().expect("a word is begun").extend(letter.to_lowercase());
        }
        before = letter;
    }
    // "01" is 1.
    let short = |word: String| match word.parse::<u64>() {
        Ok(number) => number.to_string(),
        Err(_) => word,
    };
    words.retain(|word| !word.is_empty() && word != "joint" && word != "jnt");
    words.into_iter().map(short).collect()
}

/// The words without those with which all names begin or end; at least one word is kept of each.
fn without_common(names: &[Vec<String>]) -> Vec<Vec<String>> {
    if names.len() < 2 {
        return names.to_vec();
    }
    let shortest = names.iter().map(Vec::len).min().unwrap_or(0).saturating_sub(1);
    let is_common = |word: fn(&[String], usize) -> &String, at: usize| {
        names.iter().all(|name| word(name, at) == word(&names[0], at))
    };
    let first: fn(&[String], usize) -> &String = |name, at| &name[at];
    let last: fn(&[String], usize) -> &String = |name, at| &name[name.len() - 1 - at];
    let before = (0..shortest).take_while(|&at| is_common(first, at)).count();
    let behind = (0..shortest - before).take_while(|&at| is_common(last, at)).count();
    names.iter().map(|name| name[before..name.len() - behind].to_vec()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prefixes_capitals_and_the_word_joint_make_no_other_name() {
        let stems = |names: &[&str]| -> Vec<String> {
            let words: Vec<_> = names.iter().map(|name| words(name)).collect();
            without_common(&words).iter().map(|words| words.concat()).collect()
        };
        assert_eq!(stems(&["fr3_joint1", "fr3_joint2"]), ["1", "2"]);
        assert_eq!(stems(&["joint1", "joint2"]), ["1", "2"]);
        assert_eq!(stems(&["A01", "A02"]), ["1", "2"]);
        assert_eq!(stems(&["shoulder_pan_joint", "elbow_joint"]), stems(&["ShoulderPan", "elbow"]));
        assert_eq!(stems(&["robot0:left_hinge", "robot0:right_hinge"]), ["left", "right"]);
    }
}
