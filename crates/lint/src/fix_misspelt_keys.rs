//! Safe corrections of a robot file: misspelt keys. The value of a key and the unit in its name are never changed.

use congruent_description::WrittenRobot;
use congruent_input::{
    TextEdit, edited,
    toml_text::{UnknownKey, unknown_keys},
};

use super::fix::SafeFix;

/// Suffixes of keys that name a unit.
const UNITS: [&str; 8] = ["_m", "_mm", "_rad", "_deg", "_kg", "_g", "_s", "_s2"];
/// Keys of at least this many letters may have two wrong letters, shorter ones one.
const LONG_KEY: usize = 8;

/// The safe corrections of a robot file. A key is renamed if exactly one known key is similar to it, this key is not given
/// in the same table, and the file has fewer faults afterwards.
pub fn safe_robot_file_fixes(text: &str) -> Vec<SafeFix> {
    let Some((unknown, others)) = unknown_keys::<WrittenRobot>(text) else { return Vec::new() };
    let fix = |key: &UnknownKey| {
        let meant = meant(key)?;
        // The span of a quoted key includes its quotes, which stay.
        let at = key.span.start + text.get(key.span.clone())?.find(&key.name)?;
        let edit = TextEdit { span: at..at + key.name.len(), text: meant.to_owned() };
        let (after, others_after) = unknown_keys::<WrittenRobot>(&edited(text, std::slice::from_ref(&edit)))?;
        // Reading the corrected text again proves that the key is accepted and takes the value: a key that is given twice,
        // or one of another type, raises another fault.
        (after.len() < unknown.len() && others_after <= others).then(|| SafeFix {
            code: congruent_input::codes::toml::UNKNOWN_KEY,
            about: format!("rename the key \"{}\" to \"{meant}\"", key.name),
            edits: vec![edit],
        })
    };
    unknown.iter().filter_map(fix).collect()
}

/// The only known key that is similar to an unknown one; `None` if several are. Keys of other units are left out, so that a
/// correction never changes the unit of a value.
fn meant(key: &UnknownKey) -> Option<&str> {
    let most = if key.name.chars().count() < LONG_KEY { 1 } else { 2 };
    let unit = |name: &str| UNITS.iter().filter(|unit| name.ends_with(**unit)).max_by_key(|unit| unit.len());
    let is_near = |known: &str| strsim::osa_distance(&key.name, known) <= most;
    // The same unit: `_m` and `_mm` are a letter apart, and exchanging them changes the value a thousandfold.
    let mut near = key.known.iter().filter(|known| unit(known) == unit(&key.name) && is_near(known));
    // Two near keys are no correction but a choice.
    let (only, None) = (near.next()?, near.next()) else { return None };
    Some(only)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fixed(text: &str) -> String {
        let edits: Vec<TextEdit> =
            safe_robot_file_fixes(text).into_iter().flat_map(|fix| fix.edits).collect();
        edited(text, &edits)
    }

    #[test]
    fn a_misspelt_key_becomes_the_one_that_is_meant() {
        let wrong =
            "urfd = 'r.urdf'\nnmae = 'x'\n[tcp]\nxzy_m = [0, 0, 0.1]\n\"quaternoin_wxyz\" = [1, 0, 0, 0]\n";
        let right =
            "urdf = 'r.urdf'\nname = 'x'\n[tcp]\nxyz_m = [0, 0, 0.1]\n\"quaternion_wxyz\" = [1, 0, 0, 0]\n";
        assert_eq!(fixed(wrong), right);
        assert_eq!(safe_robot_file_fixes(right), []);
    }

    #[test]
    fn what_needs_a_decision_is_left_alone() {
        for text in [
            // The unit is what is wrong or missing.
            "urdf = 'r.urdf'\n[tcp]\nxyz = [0, 0, 0.1]\n",
            "urdf = 'r.urdf'\n[tcp]\nxyz_n = [0, 0, 0.1]\n",
            "urdf = 'r.urdf'\n[tcp]\nrpy_rd = [0, 0, 0.1]\n",
            // The key is there already, takes no such value, or is none of these.
            "urdf = 'r.urdf'\nurfd = 'q.urdf'\n",
            "urdf = 'r.urdf'\nnmae = 3\n",
            "urdf = 'r.urdf'\ncolour = 'red'\n",
            "urdf = 'r.urdf'\n[tcp]\nrpy_rad = [0, 90, 0]\n",
            "urdf = \n",
        ] {
            assert_eq!(fixed(text), text);
        }
    }
}
