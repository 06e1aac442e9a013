//! Text in the columns of the terminal. In a pipe lines stay whole, so that programs can search them.

use super::units::is_unit_of;

/// Narrower than this no line is read with ease: fewer columns of a terminal count as these.
pub const NARROWEST: usize = 40;
/// Additional indent of a continued line, unless its own indent is deep already.
const HANGING: usize = 4;
const DEEP: usize = 12;

/// The text with its long lines continued below, each under its own beginning. Lines to paste and snippets stay whole.
///
/// # Examples
/// ```
/// use congruent_text::layout::fitted;
///
/// let line = "  limits  pass  61.1 deg of margin at the joint that is nearest to its limit";
/// assert!(fitted(line, 40).lines().all(|line| line.len() <= 40));
/// ```
pub fn fitted(text: &str, columns: usize) -> String {
    let mut fitted = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        let (line, end) = line.strip_suffix('\n').map_or((line, ""), |line| (line, "\n"));
        if line.chars().count() <= columns || is_verbatim(line) {
            fitted.push_str(line);
        } else {
            push_continued(&mut fitted, line, columns);
        }
        fitted.push_str(end);
    }
    fitted
}

/// Whether a line is part of a file or of a snippet of one: broken it could not be pasted.
fn is_verbatim(line: &str) -> bool {
    let line = line.trim_start();
    let is_key = |key: &str| {
        !key.is_empty() && key.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '.' | '-'))
    };
    let is_value = line.split_once(" = ").is_some_and(|(key, _)| is_key(key));
    let is_between = |open: char, close: char| line.starts_with(open) && line.ends_with(close);
    is_value
        || is_between('[', ']')
        || is_between('<', '>')
        || is_between('{', '}')
        || line.contains(['│', '╭', '╰', '·', '\u{1b}'])
}

/// Breaks a line at spaces; what has no space within the columns stays whole.
fn push_continued(text: &mut String, line: &str, columns: usize) {
    let chars: Vec<char> = line.chars().collect();
    let indent = hanging(&chars, columns);
    let (mut start, mut room) = (0, columns);
    while chars.len() - start > room {
        let begin = chars[start..].iter().position(|&c| c != ' ').map_or(start, |at| start + at);
        let is_space = |at: &usize| chars[*at] == ' ' && !is_before_unit(&chars, *at);
        let last = (begin + 1..=start + room).rev().find(is_space);
        // A word that is longer than a line is not broken: the line ends at the first space after it.
        let Some(at) = last.or_else(|| (start + room..chars.len()).find(is_space)) else { break };
        let part: String = chars[start..at].iter().collect();
        text.push_str(part.trim_end());
        text.push('\n');
        text.extend(std::iter::repeat_n(' ', indent));
        start = chars[at..].iter().position(|&c| c != ' ').map_or(chars.len(), |spaces| at + spaces);
        room = columns - indent;
    }
    text.extend(&chars[start..]);
}

/// Whether the space is between a number and its unit, or within a unit.
fn is_before_unit(chars: &[char], at: usize) -> bool {
    let behind: String = chars[at + 1..].iter().take_while(|c| !c.is_whitespace()).collect();
    let start = chars[..at].iter().rposition(|c| c.is_whitespace()).map_or(0, |space| space + 1);
    is_unit_of(&chars[start..at].iter().collect::<String>(), &behind)
}

/// Where a continued line begins: under the last of its columns that begins in the first third, else a little beyond its
/// own indent.
fn hanging(chars: &[char], columns: usize) -> usize {
    let own = chars.iter().take_while(|&&c| c == ' ').count();
    let is_column =
        |at: &usize| *at > own && chars[at - 1] == ' ' && chars[at - 2] == ' ' && chars[*at] != ' ';
    let column = (own + 2..chars.len().min(columns / 3)).rev().find(is_column);
    column.unwrap_or(if own < DEEP { own + HANGING } else { own }).min(columns / 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_line_goes_on_below_its_column() {
        let line = "  limits     pass    share of velocity limit 0.7 at a_joint_with_a_long_name (2.4 s), at most 1: 0.2 left";
        let text = fitted(&format!("{line}\nshort\n"), 80);
        let lines: Vec<&str> = text.lines().collect();
        assert!(lines.iter().all(|line| line.chars().count() <= 80), "{text}");
        assert!(lines[1].starts_with(&format!("{}(2.4 s)", " ".repeat(21))), "{text}");
        assert_eq!(lines[2], "short");
        let words = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
        assert_eq!(words(&text), words(&format!("{line} short")), "nothing is lost");
    }

    #[test]
    fn lines_to_paste_and_words_without_end_stay_whole() {
        let value = format!("    xyz_m = [{}]", "0.123456789, ".repeat(9));
        let word = "x".repeat(200);
        for whole in [value.as_str(), &word, "  │ \u{1b}[31msomething"] {
            assert_eq!(fitted(whole, 40), whole);
        }
        assert_eq!(fitted(&format!("a {word} b"), 40), format!("a\n    {word}\n    b"));
    }

    #[test]
    fn a_number_stays_with_its_unit() {
        let line = "    joint_1: revolute about z, at most 250 deg/s and 100 N m";
        for columns in line.len() - 5..line.len() {
            assert!(fitted(line, columns).ends_with(" 100 N m"), "{}", fitted(line, columns));
        }
    }

    #[test]
    fn every_width_ends() {
        let line = "  one  two three   four".repeat(20);
        for columns in NARROWEST..100 {
            let text = fitted(&line, columns);
            assert!(text.lines().all(|line| line.chars().count() <= columns), "{columns}: {text}");
        }
    }
}
