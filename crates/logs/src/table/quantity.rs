//! What of a joint a column is, by the words of its name.

use crate::table_reading::LoggedQuantity;

/// Words that say what a column is.
const WORDS: [(LoggedQuantity, &[&str]); 3] = [
    (LoggedQuantity::Position, &["position", "positions", "pos", "q", "angle", "angles"]),
    (
        LoggedQuantity::Velocity,
        &["velocity", "velocities", "vel", "qd", "dq", "qdot", "speed", "speeds", "v"],
    ),
    (
        LoggedQuantity::Effort,
        &["effort", "efforts", "eff", "torque", "torques", "tau", "current", "currents"],
    ),
];
/// Words of what is no measured value of a joint, with or without a number behind them.
const OTHERS: [&[&str]; 6] = [
    &["target", "targets", "goal", "goals", "desired", "des", "d", "setpoint", "setpoints", "sp"],
    &[
        "command",
        "commands",
        "commanded",
        "cmd",
        "reference",
        "references",
        "ref",
        "planned",
        "ideal",
        "error",
    ],
    &["acceleration", "accelerations", "acc", "accel", "qdd", "ddq", "qddot", "ddot", "jerk"],
    &[
        "temperature",
        "temperatures",
        "temp",
        "voltage",
        "std",
        "mode",
        "status",
        "id",
        "stamp",
        "offset",
        "raw",
    ],
    &["tcp", "tool", "pose", "force"],
    &["x", "y", "z", "w", "rx", "ry", "rz", "qx", "qy", "qz", "qw"],
];
/// Words for the state that a robot measures.
const MEASURED: [&str; 3] = ["actual", "measured", "real"];
/// Units that a name may end with, word by word; longer ones first.
const UNITS: [&[&str]; 12] = [
    &["rad", "s"],
    &["deg", "s"],
    &["mm", "s"],
    &["m", "s"],
    &["n", "m"],
    &["rad"],
    &["deg"],
    &["degree"],
    &["degrees"],
    &["mm"],
    &["m"],
    &["n"],
];

/// What the name of a column says.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct NamedColumn {
    /// `None` if no word says it.
    pub(super) quantity: Option<LoggedQuantity>,
    /// The name without the words that say what it is.
    pub(super) rest: String,
    pub(super) stated_unit: Option<String>,
}

/// Reads a name; `None` if it is of something else than a joint.
pub(super) fn named(name: &str) -> Option<NamedColumn> {
    let mut parts = parts(name);
    if parts.iter().any(|part| OTHERS.iter().any(|words| words.contains(&letters(&part.word)))) {
        return None;
    }
    let stated_unit = take_unit(&mut parts);
    parts.retain(|part| !MEASURED.contains(&part.word.as_str()));
    // Beside another such word "current" says when, as in `current_position`.
    let is_current = |part: &NamePart| letters(&part.word) == "current";
    if parts.iter().any(|part| !is_current(part) && quantity(&part.word).is_some()) {
        parts.retain(|part| !is_current(part));
    }
    // `q0_dot` is the rate of `q0`.
    let is_rate = |part: &NamePart| part.word == "dot";
    let has_rate = parts.iter().any(is_rate) && parts.len() > 1;
    if has_rate {
        parts.retain(|part| !is_rate(part));
    }
    let found = parts.iter().enumerate().find_map(|(at, part)| Some((at, quantity(&part.word)?)));
    if let Some((at, _)) = found {
        // Of `q1` the number names the joint.
        let number = digits(&parts[at].word).to_owned();
        if number.is_empty() {
            parts.remove(at);
        } else {
            parts[at] = NamePart { word: number.clone(), text: number, ..parts[at].clone() };
        }
    }
    let rest = joined(&parts);
    (!rest.is_empty()).then_some(NamedColumn {
        quantity: if has_rate { Some(LoggedQuantity::Velocity) } else { found.map(|(_, quantity)| quantity) },
        rest,
        stated_unit,
    })
}

/// Whether a name says which quantity of a joint its column has.
pub(crate) fn says_quantity(name: &str) -> bool {
    named(name).is_some_and(|column| column.quantity.is_some())
}

/// Takes the unit off the end of a name that has more words than that.
fn take_unit(parts: &mut Vec<NamePart>) -> Option<String> {
    let is_end = |unit: &&&[&str]| {
        parts.len() > unit.len()
            && parts[parts.len() - unit.len()..]
                .iter()
                .map(|part| part.word.as_str())
                .eq(unit.iter().copied())
    };
    let unit = UNITS.iter().find(is_end)?;
    parts.truncate(parts.len() - unit.len());
    Some(unit.join("_"))
}

/// Whether a name that says nothing else is that of a joint.
pub(super) fn is_name_of_joint(name: &str) -> bool {
    let is_numbered =
        |word: &str| !digits(word).is_empty() && ["j", "a", "axis", "joint"].contains(&letters(word));
    parts(name).iter().any(|part| is_numbered(&part.word) || part.word.contains("joint"))
}

/// Number of the words of a name.
pub(super) fn word_count(name: &str) -> usize {
    parts(name).len()
}

/// What a word says, with or without a number behind it.
fn quantity(word: &str) -> Option<LoggedQuantity> {
    let word = letters(word);
    WORDS.iter().find(|(_, words)| words.contains(&word)).map(|(quantity, _)| *quantity)
}

/// A word without the number at its end.
fn letters(word: &str) -> &str {
    word.trim_end_matches(|letter: char| letter.is_ascii_digit())
}

/// The number at the end of a word.
fn digits(word: &str) -> &str {
    &word[letters(word).len()..]
}

/// A word of a name, with what separates it from the word before.
#[derive(Clone)]
struct NamePart {
    before: String,
    text: String,
    /// In lower case.
    word: String,
}

fn parts(name: &str) -> Vec<NamePart> {
    let (mut found, mut before, mut text) = (Vec::new(), String::new(), String::new());
    for letter in name.chars().chain(['_']) {
        if letter.is_alphanumeric() {
            text.push(letter);
        } else {
            if !text.is_empty() {
                let word = text.to_lowercase();
                found.push(NamePart {
                    before: std::mem::take(&mut before),
                    text: std::mem::take(&mut text),
                    word,
                });
            }
            before.push(letter);
        }
    }
    found
}

fn joined(parts: &[NamePart]) -> String {
    let mut text = String::new();
    for part in parts {
        if !text.is_empty() {
            text += &part.before;
        }
        text += &part.text;
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(name: &str, expected: Option<(Option<LoggedQuantity>, &str)>) {
        let found = named(name);
        assert_eq!(found.as_ref().map(|found| (found.quantity, found.rest.as_str())), expected, "{name}");
    }

    #[test]
    fn names_of_real_tables() {
        check("- arm_1_joint_position", Some((Some(LoggedQuantity::Position), "arm_1_joint")));
        check("actual_qd_0", Some((Some(LoggedQuantity::Velocity), "0")));
        check("q1", Some((Some(LoggedQuantity::Position), "1")));
        check("tau_7", Some((Some(LoggedQuantity::Effort), "7")));
        check(
            "/joint_states/elbow_joint/velocity",
            Some((Some(LoggedQuantity::Velocity), "joint_states/elbow_joint")),
        );
        check("position[3]", Some((Some(LoggedQuantity::Position), "3")));
        check("shoulder_pan_joint_rad", Some((None, "shoulder_pan_joint")));
        check("elbow_joint.qd_rad_s", Some((Some(LoggedQuantity::Velocity), "elbow_joint")));
        check("elbow_joint.effort_n_m", Some((Some(LoggedQuantity::Effort), "elbow_joint")));
        check("elbow_joint.reference_q_rad", None);
        check("target_q_0", None);
        check("measurement_std_rx", None);
        check("position", None);
        for name in [
            "joint_1_acceleration",
            "joint_1_mode",
            "q_cmd_1",
            "q_d_0",
            "q_w",
            "qdd1",
            "j1_temp",
            "joint_1_raw",
        ] {
            check(name, None);
        }
        check("q0_dot", Some((Some(LoggedQuantity::Velocity), "0")));
        check("current_position_1", Some((Some(LoggedQuantity::Position), "1")));
        check("motor_current_1", Some((Some(LoggedQuantity::Effort), "motor_1")));
        check("", None);
    }

    #[test]
    fn units_in_names() {
        assert_eq!(named("elbow_deg").unwrap().stated_unit.as_deref(), Some("deg"));
        assert_eq!(named("a").unwrap().stated_unit, None);
    }

    #[test]
    fn joints_without_another_word() {
        assert!(["joint_1", "J3", "elbow_joint", "A6", "axis2"].into_iter().all(is_name_of_joint));
        assert!(!["temperature", "row", "id7"].into_iter().any(is_name_of_joint));
    }
}
