//! Derives from the names of links and joints which frame is for tools: the only place that interprets names, used only if no
//! chain is declared.

use congruent_robot::{Joint, Link};
use std::cmp::Reverse;

/// Words for the frames in which tools are programmed, the most specific last.
const TOOL_FRAMES: [&[&str]; 4] =
    [&["flange"], &["ee", "eef", "effector", "endpoint"], &["tool", "tool0"], &["tcp"]];
/// Words without meaning for the choice: they only say that something is a link or a frame.
const FILLERS: [&str; 3] = ["link", "frame", "joint"];
/// Words for sensors, whose frames are not for tools.
const SENSORS: [&str; 9] = ["camera", "cam", "optical", "lidar", "laser", "imu", "sensor", "rgb", "depth"];
/// Words for joints that open and close a gripper.
const JAWS: [&str; 6] = ["gripper", "finger", "jaw", "knuckle", "claw", "thumb"];
/// Words for links that open and close; a link named after a gripper as a whole may be its palm.
const FINGERS: [&str; 5] = ["finger", "jaw", "knuckle", "claw", "thumb"];
/// Words for joints that turn a gripper and belong to the arm.
const TURNS: [&str; 6] = ["roll", "pitch", "yaw", "rotate", "rotation", "wrist"];

/// Words for joints of arms and legs, whatever their range is.
const LIMBS: [&str; 9] = ["shoulder", "elbow", "forearm", "neck", "waist", "hip", "knee", "ankle", "toe"];

/// The words of a name, which end at a sign, or before a capital: `jointGripper`, `left_TCPFrame`.
fn words(name: &str) -> impl DoubleEndedIterator<Item = String> {
    let letters: Vec<char> = name.chars().collect();
    let mut spaced = String::new();
    for (at, letter) in letters.iter().enumerate() {
        let before = at.checked_sub(1).map(|before| letters[before]);
        let is_small = |letter: Option<&char>| letter.is_some_and(|letter| letter.is_lowercase());
        // Of several capitals the last belongs to the word after them.
        let begins = letter.is_uppercase()
            && (is_small(before.as_ref())
                || before.is_some_and(char::is_uppercase) && is_small(letters.get(at + 1)));
        if begins {
            spaced.push(' ');
        }
        spaced.push(*letter);
    }
    let words = spaced.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    words.map(str::to_ascii_lowercase).collect::<Vec<_>>().into_iter()
}

/// How much a link's name says that tools are programmed in its frame: 0 if it says nothing.
pub(super) fn tool_rank(link: &Link) -> usize {
    // The last word that is not a filler decides: `tool_changer_link` is a changer, `gripper_tcp_frame` is a TCP.
    let Some(last) = words(&link.name).rev().find(|word| !FILLERS.contains(&word.as_str())) else { return 0 };
    TOOL_FRAMES.iter().position(|names| names.contains(&last.as_str())).map_or(0, |rank| rank + 1)
}

/// Order of the frames of the last body: by name, sensors last, then the farther in joints, then those that are frames and
/// nothing else, then by file order.
pub(super) fn preference(link: &Link, fixed_joints: usize, index: usize) -> impl Ord + use<> {
    let is_frame = link.inertia.is_none() && link.visuals.is_empty() && link.collisions.is_empty();
    let is_sensor = words(&link.name).any(|word| SENSORS.contains(&word.as_str()));
    // Compared in this order. More fixed joints mean farther out on the body, where a tool is attached; a link without mass
    // and shapes is a pure frame; `Reverse` prefers the first of equal frames in file order.
    (tool_rank(link), !is_sensor, fixed_joints, is_frame, Reverse(index))
}

/// Whether a last joint opens and closes a gripper, by its name or by that of the link that it moves.
pub(super) fn is_jaw(joint: &Joint, moved: &Link) -> bool {
    (has(&joint.name, &JAWS) || has(&moved.name, &FINGERS)) && !has(&joint.name, &TURNS)
}

/// Whether a joint or the link that it moves is called after a part of an arm or a leg, or after how it turns.
pub(super) fn is_of_limb(joint: &Joint, moved: &Link) -> bool {
    [&joint.name, &moved.name].into_iter().any(|name| has(name, &TURNS) || has(name, &LIMBS))
}

/// Whether a name has one of these words, with a number behind it or without.
fn has(name: &str, known: &[&str]) -> bool {
    words(name).any(|word| known.contains(&word.trim_end_matches(|c: char| c.is_ascii_digit())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_camera_is_no_tool() {
        let link = |name: &str| Link { name: name.to_owned(), ..Link::default() };
        let frames = [link("wrist_camera_optical_frame"), link("gripper_base"), link("tool0")];
        let preferences = frames.each_ref().map(|link| preference(link, 3, 0));
        assert!(preferences[0] < preferences[1] && preferences[1] < preferences[2]);
        assert!(preference(&frames[0], 9, 0) < preference(&frames[1], 1, 0));
    }

    #[test]
    fn the_last_word_of_a_name_counts() {
        let rank = |name: &str| tool_rank(&Link { name: name.to_owned(), ..Link::default() });
        let ranks =
            ["flange", "iiwa_link_ee", "ee_link", "left_tool0", "r_gripper_tool_frame", "panda_hand_tcp"];
        assert_eq!(ranks.map(rank), [1, 2, 2, 3, 3, 4]);
        assert_eq!(["leftTool0", "gripperTCPFrame", "EELink", "linkTCP"].map(rank), [3, 4, 2, 4]);
        assert_eq!(["tool_changer", "tool0_controller", "steel", "link", ""].map(rank), [0; 5]);
    }
}
