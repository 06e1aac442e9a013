//! A table whose joints all have other names than those of the URDF, by one prefix or suffix, as of an arm in a cell.

use congruent_input::Diagnostic;
use congruent_robot::{JointIndex, Robot};
use toml::Spanned;

use super::written::WrittenRow;
use crate::codes;

/// The one finding about such a table: an error for each row would hide what is wrong.
pub(super) fn other_names(
    rows: &[Spanned<WrittenRow>],
    robot: &Robot,
    chain: &[JointIndex],
) -> Option<Diagnostic> {
    let written: Vec<&str> = rows.iter().map(|row| row.get_ref().joint.get_ref().as_str()).collect();
    let of_chain: Vec<&str> = chain.iter().map(|&joint| robot.joint(joint).name.as_str()).collect();
    if written.iter().any(|name| robot.find_joint(name).is_some()) {
        return None;
    }
    let (affix, names) = renamed(&written, &of_chain)?;
    let Affix { side, text, is_missing } = affix;
    let with = if is_missing { "with" } else { "without" };
    let message = format!(
        "no joint of the table is in the robot: the URDF has all of them {with} the {side} \"{text}\""
    );
    let or = if is_missing { format!("; or make the URDF without the {side}") } else { String::new() };
    let found = Diagnostic::error(codes::robot_file::UNKNOWN_JOINT, message);
    Some(
        found
            .at(rows[0].get_ref().joint.span())
            .with_help(format!("write in the rows: {}{or}", names.join(", "))),
    )
}

/// The affix by which all names differ from known ones, and the known ones.
fn renamed<'a>(written: &[&'a str], known: &[&'a str]) -> Option<(Affix<'a>, Vec<String>)> {
    // One joint alone is a name that is misspelt.
    let [first, _, ..] = written else { return None };
    known.iter().find_map(|known_name| {
        let affix = Affix::between(first, known_name)?;
        // Up to the first that is not known: of hostile files any name may begin or end as any other.
        let renamed = |name: &&str| affix.applied(name).filter(|name| known.contains(&name.as_str()));
        let names: Option<Vec<String>> = written.iter().map(renamed).collect();
        Some((affix, names?))
    })
}

/// What a name has before or behind another one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Affix<'a> {
    /// `prefix` or `suffix`.
    side: &'static str,
    text: &'a str,
    /// Whether the written name lacks it; otherwise it has it, and the known one does not.
    is_missing: bool,
}

impl<'a> Affix<'a> {
    fn between(written: &'a str, known: &'a str) -> Option<Self> {
        let affix = |side, text, is_missing| Self { side, text, is_missing };
        let found = known
            .strip_suffix(written)
            .map(|text| affix("prefix", text, true))
            .or_else(|| known.strip_prefix(written).map(|text| affix("suffix", text, true)))
            .or_else(|| written.strip_suffix(known).map(|text| affix("prefix", text, false)))
            .or_else(|| written.strip_prefix(known).map(|text| affix("suffix", text, false)));
        found.filter(|affix| !affix.text.is_empty())
    }

    /// A written name as the known one is.
    fn applied(self, written: &str) -> Option<String> {
        let Self { side, text, is_missing } = self;
        match (side, is_missing) {
            ("prefix", true) => Some(format!("{text}{written}")),
            ("prefix", false) => written.strip_prefix(text).map(str::to_owned),
            (_, true) => Some(format!("{written}{text}")),
            (_, false) => written.strip_suffix(text).map(str::to_owned),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn is(written: &[&str], known: &[&str], expected: Option<(&'static str, &str, bool)>) {
        let found = renamed(written, known).map(|(affix, _)| (affix.side, affix.text, affix.is_missing));
        assert_eq!(found, expected, "{written:?}");
    }

    #[test]
    fn one_prefix_or_suffix_of_all_names_is_found() {
        is(&["pan", "lift"], &["ur_pan", "ur_lift"], Some(("prefix", "ur_", true)));
        is(&["ur_pan", "ur_lift"], &["pan", "lift"], Some(("prefix", "ur_", false)));
        is(&["pan", "lift"], &["pan_joint", "lift_joint"], Some(("suffix", "_joint", true)));
        is(&["pan_joint", "lift_joint"], &["base", "pan", "lift"], Some(("suffix", "_joint", false)));
        // Of joint_1 and joint_11 the first fits with another affix than all do.
        is(&["1", "2"], &["joint_11", "joint_1", "joint_2"], Some(("prefix", "joint_", true)));
        is(&["pan", "lift"], &["ur_pan", "ra_lift"], None);
        is(&["pan"], &["ur_pan"], None);
    }
}
