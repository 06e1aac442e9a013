//! Which bracket of a text that is no TOML is not closed: the reader of TOML names the place where it noticed.

use std::ops::Range;

use crate::diagnostic::line_column;

/// A bracket that is not closed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Unclosed {
    /// Byte range from the bracket to the end of its line.
    pub(super) span: Range<usize>,
    /// What is wrong.
    pub(super) message: String,
}

/// The bracket that is open where another line begins that cannot be in it: a row, the end of the list, a table, a key. `at`
/// is where the reader of TOML has found a fault.
pub(super) fn unclosed(text: &str, at: usize) -> Option<Unclosed> {
    let line_start = text.get(..at)?.rfind('\n').map_or(0, |end| end + 1);
    let line_end = text[line_start..].find('\n').map_or(text.len(), |length| line_start + length);
    let line = text[line_start..line_end].trim_start();
    // At the end of a text the reader points behind its last line.
    let is_at_end = text[at..].trim().is_empty();
    let open = open_brackets(text, if is_at_end { text.len() } else { line_start });
    let &(start, bracket) = open.last()?;
    let begins_other = match bracket {
        '{' => line.starts_with(['{', ']', '[']),
        _ => line.starts_with('[') || is_assignment(line),
    };
    if !is_at_end && !begins_other {
        return None;
    }
    let (number, _) = line_column(text, start);
    let first = open.first().map(|&(first, _)| key_before(&text[..first])).unwrap_or_default();
    let (what, missing) = match bracket {
        '{' if open.len() > 1 && first == "row" => ("row", '}'),
        '{' => ("table { ... }", '}'),
        _ => ("list [ ... ]", ']'),
    };
    let end = text[start..].find('\n').map_or(text.len(), |length| start + length);
    let message = format!("the {what} that begins in line {number} is not closed: {missing} is missing");
    Some(Unclosed { span: start..end, message })
}

/// Whether a line is `key = value`, which is no value of a list.
fn is_assignment(line: &str) -> bool {
    line.split_once('=').is_some_and(|(key, _)| {
        let key = key.trim_end();
        !key.is_empty() && key.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"_-.".contains(&byte))
    })
}

/// The key of the value that follows: `row` of `row = `.
fn key_before(text: &str) -> &str {
    let Some(key) = text.trim_end().strip_suffix('=') else { return "" };
    key.trim_end().rsplit(['\n', ' ', ',', '{', '.']).next().unwrap_or_default()
}

/// The brackets that are open at this place, the innermost last; those in texts and comments do not count.
fn open_brackets(text: &str, end: usize) -> Vec<(usize, char)> {
    let mut open: Vec<(usize, char)> = Vec::new();
    let mut quote: Option<char> = None;
    let mut is_comment = false;
    let mut escaped = false;
    for (at, letter) in text[..end].char_indices() {
        match (quote, letter) {
            // A text ends at the end of its line at the latest; those of several lines have no place in our files.
            (_, '\n') => (quote, is_comment) = (None, false),
            _ if is_comment => {}
            (Some('"'), '\\') if !escaped => {
                escaped = true;
                continue;
            }
            (Some(mark), letter) if letter == mark && !escaped => quote = None,
            (None, '"' | '\'') => quote = Some(letter),
            (None, '#') => is_comment = true,
            (None, '{' | '[') => open.push((at, letter)),
            (None, '}' | ']') => {
                open.pop();
            }
            (Some(_) | None, _) => {}
        }
        escaped = false;
    }
    open
}

#[cfg(test)]
mod tests {
    use toml::de::DeTable;

    use super::*;

    #[track_caller]
    fn found(text: &str) -> Option<String> {
        let at = DeTable::parse(text).unwrap_err().span().unwrap().start;
        unclosed(text, at).map(|found| found.message)
    }

    #[test]
    fn the_line_of_the_bracket_is_named() {
        let row = Some("the row that begins in line 2 is not closed: } is missing".to_owned());
        assert_eq!(found("row = [\n  { a = 1, b = \"}\",\n  { a = 2 },\n]\n"), row);
        assert_eq!(found("row = [\n  { a = 1, b = 2 # }\n  { a = 2 },\n]\n"), row);
        assert_eq!(found("row = [\n  { a = 1, b = 2\n]\n"), row);
        let list = Some("the list [ ... ] that begins in line 1 is not closed: ] is missing".to_owned());
        assert_eq!(found("row = [\n  { a = 1 },\n  { a = 2 },\n"), list);
        assert_eq!(found("row = [\n  { a = 1 },\n[tcp]\nx = 1\n"), list);
        assert_eq!(found("row = [\n  { a = 1 },\nname = \"x\"\n"), list);
        let table = Some("the table { ... } that begins in line 1 is not closed: } is missing".to_owned());
        assert_eq!(found("tcp = { x = 1\n[dh]\n"), table);
    }

    #[test]
    fn another_fault_is_not_a_missing_bracket() {
        assert_eq!(found("row = [\n  { a = x },\n]\n"), None);
        assert_eq!(found("a = = 2"), None);
        assert_eq!(found("[dh]\na = 1 2\n"), None);
    }
}
