//! The known name that an unknown one was probably meant to be.

use crate::display::first_of;

/// The known name that `name` was probably meant to be: at most two letters are other, missing, too much or exchanged, and
/// fewer than half of them; or it is the only name of which this one is some of the words, as `elbow` of `elbow_joint`, or
/// nearly one of them, or one without its unit; or it is how the only name begins, as `track` of `tracking`.
/// `None` if there is none.
///
/// # Examples
/// ```
/// use congruent_input::nearest;
/// let joints = ["shoulder_joint", "elbow_joint"];
/// assert_eq!(nearest("elbow_jiont", joints), Some("elbow_joint"));
/// assert_eq!(nearest("elbow", joints), Some("elbow_joint"));
/// assert_eq!(nearest("elbw", joints), Some("elbow_joint"));
/// assert_eq!(nearest("wrist", joints), None);
/// assert_eq!(nearest("track", ["twist", "tracking"]), Some("tracking"));
/// ```
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    /// Most letters that are other. Kind: choice; two mistyped keys.
    const MOST_EDITS: usize = 2;
    let lower = name.to_lowercase();
    let known: Vec<&str> = known.into_iter().collect();
    let (mut best, mut containing) = (None, Vec::new());
    for &candidate in &known {
        let other = candidate.to_lowercase();
        let edits = strsim::osa_distance(&lower, &other);
        let unlike = (edits, -strsim::jaro_winkler(&lower, &other));
        let is_meant = edits <= MOST_EDITS && 2 * edits < lower.chars().count();
        if is_meant && best.is_none_or(|(least, _)| unlike < least) {
            best = Some((unlike, candidate));
        }
        if format!("_{other}_").contains(&format!("_{lower}_")) {
            containing.push(candidate);
        }
    }
    let is_with_unit = |known: &&&str| {
        let rest = known.to_lowercase();
        rest.strip_prefix(&format!("{lower}_")).is_some_and(|unit| !unit.contains('_'))
    };
    match containing[..] {
        _ if best.is_some() => best.map(|(_, candidate)| candidate),
        [only] => Some(only),
        [] => one_with_word(&lower, &known).or_else(|| only_with_beginning(&lower, &known)),
        _ => containing.iter().find(is_with_unit).copied(),
    }
}

/// Shorter words are like many others, letters. Kind: choice.
const SHORTEST: usize = 4;

/// The only known name of which one word differs in one letter: `elbow_joint` for `elbw`.
fn one_with_word<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    if name.chars().count() < SHORTEST {
        return None;
    }
    let is_like = |known: &&&str| {
        known
            .to_lowercase()
            .split('_')
            .any(|word| word.len() >= SHORTEST && strsim::osa_distance(name, word) <= 1)
    };
    let mut like = known.iter().filter(is_like);
    match (like.next(), like.next()) {
        (Some(only), None) => Some(only),
        _ => None,
    }
}

/// The only known name that begins with this one.
fn only_with_beginning<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    let mut longer = known.iter().filter(|known| known.to_lowercase().starts_with(name));
    match (longer.next(), longer.next()) {
        (Some(only), None) if name.chars().count() >= SHORTEST => Some(only),
        _ => None,
    }
}

/// How the help begins that has a guess.
pub(crate) const DID_YOU_MEAN: &str = "did you mean ";

/// Help for an unknown name: the most similar known name, then all known names.
pub fn known_names<'a>(name: &str, what: &str, known: impl IntoIterator<Item = &'a str> + Clone) -> String {
    const MOST_LISTED: usize = 40;
    let guess =
        nearest(name, known.clone()).map_or(String::new(), |near| format!("{DID_YOU_MEAN}\"{near}\"? "));
    let all: Vec<&str> = known.into_iter().collect();
    format!("{guess}known {what}: {}", first_of(&all, MOST_LISTED))
}
