//! Colours of the words that say how something ended, where answers have them: behind the name of a row, at the beginning of a
//! row that has no name, and behind the name of a heading.

use std::{fmt::Write, ops::Range};

const GREEN: u8 = 32;
const RED: u8 = 31;
const YELLOW: u8 = 33;

/// Words with their colours; of two with the same beginning the longer is first.
const WORDS: [(&str, u8); 31] = [
    ("SAME ROBOT", GREEN),
    ("SAME GEOMETRY, DIFFERENT DYNAMICS", RED),
    ("SAME GEOMETRY AND DYNAMICS, DIFFERENT JOINT LIMITS", RED),
    ("SAME DYNAMICS, DIFFERENT JOINT LIMITS", RED),
    ("SAME GEOMETRY, DYNAMICS NOT COMPARED", GREEN),
    ("SAME DYNAMICS, GEOMETRY NOT COMPARED", GREEN),
    ("SAME GEOMETRY AFTER MAPPING", RED),
    ("SAME GEOMETRY IN", RED),
    ("SAME GEOMETRY in", GREEN),
    ("EQUAL", RED),
    ("DIFFERENT DYNAMICS", RED),
    ("DIFFERENT JOINT LIMITS", RED),
    ("DIFFERENT JOINTS", RED),
    ("DIFFERENT", RED),
    ("NO SECOND DESCRIPTION", YELLOW),
    ("NOTHING COMPARED", YELLOW),
    ("passed", GREEN),
    ("pass", GREEN),
    ("agree", GREEN),
    ("certified", GREEN),
    ("fail", RED),
    ("FAIL", RED),
    ("FAILED", RED),
    ("disagree", RED),
    ("error", RED),
    ("BAD INPUT", RED),
    ("BROKEN", RED),
    ("skipped", YELLOW),
    ("inconclusive", YELLOW),
    ("NOTHING CHECKED", YELLOW),
    ("NOT CHECKED", YELLOW),
];

/// The text with the words coloured that say how something ended, as a terminal obeys it. Numbers and names stay as they
/// are.
///
/// # Examples
/// ```
/// use congruent_text::layout::with_coloured_status;
///
/// assert_eq!(with_coloured_status("a: pass\n"), "a: \u{1b}[32mpass\u{1b}[0m\n");
/// ```
pub fn with_coloured_status(text: &str) -> String {
    let mut coloured = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        match status(line) {
            Some((Range { start, end }, colour)) => {
                let (before, word, after) = (&line[..start], &line[start..end], &line[end..]);
                let _ = write!(coloured, "{before}\u{1b}[{colour}m{word}\u{1b}[0m{after}");
            }
            None => coloured += line,
        }
    }
    coloured
}

/// The place of the word in a line, and its colour.
fn status(line: &str) -> Option<(Range<usize>, u8)> {
    places(line).into_iter().flatten().find_map(|start| {
        let rest = line.get(start..).filter(|_| line[..start].ends_with(' '))?;
        let ends = |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_');
        let is_here = |word: &str| rest.strip_prefix(word).is_some_and(ends);
        let &(word, colour) = WORDS.iter().find(|(word, _)| is_here(word))?;
        Some((start..start + word.len(), colour))
    })
}

/// Where the word may begin.
fn places(line: &str) -> [Option<usize>; 2] {
    /// Rows have this indent; what is deeper continues one.
    const ROW: usize = 2;
    /// The column of a row behind the name of its check.
    const BEHIND_NAME: usize = 13;
    match line.len() - line.trim_start_matches(' ').len() {
        0 => [line.find(": ").map(|at| at + 2), None],
        ROW => [Some(ROW), Some(BEHIND_NAME)],
        _ => [None, None],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_word_of_an_answer_is_coloured_and_nothing_else() {
        let check = |line: &str, word: Option<&str>| {
            let found = status(line).map(|(place, _)| &line[place]);
            assert_eq!(found, word, "{line}");
        };
        check("ur5e_pick: pass (ur5e, 4 s)", Some("pass"));
        check("a.toml: BAD INPUT\n", Some("BAD INPUT"));
        check("robot.toml: DIFFERENT, by up to 1 mm", Some("DIFFERENT"));
        check("  limits     pass    61.1 deg of margin", Some("pass"));
        check("  disagree  DH table against URDF chain", Some("disagree"));
        check("ur5e_pick: FAIL (ur5e, 4 s)", Some("FAIL"));
        check("ur5e_pick: NOTHING CHECKED: add a [[check]]", Some("NOTHING CHECKED"));
        check("  cycle_time pass    4 s", Some("pass"));
        check("  tracking   skipped", Some("skipped"));
        check("  passive    passenger", None);
        // Neither names of a file nor words of a sentence.
        check("  largest error at link tool0, at", None);
        check("  fail_joint pass", Some("pass"));
        check("  joint fail", None);
        check("  gelenk_äöü fail", None);
        check("                     fail", None);
        check("fail: 3", None);
        check("", None);
        check("  ", None);
        assert_eq!(with_coloured_status("a: pass\nb\n"), "a: \u{1b}[32mpass\u{1b}[0m\nb\n");
    }
}
