//! Makes invisible characters visible: control characters, marks of writing direction, line separators, characters without
//! width. Terminals and CI hosts obey them, so a malicious file could use them to falsify an output.

use std::borrow::Cow;

/// Whether a character is invisible: a control character, a mark of direction, a separator of lines, or one without width.
pub fn is_hidden(c: char) -> bool {
    // Nearly all characters are below the first that is hidden without being a control character.
    c.is_control()
        || c >= '\u{ad}'
            && matches!(
                c,
                '\u{ad}' | '\u{34f}' | '\u{61c}' | '\u{115f}' | '\u{1160}' | '\u{17b4}' | '\u{17b5}'
                    | '\u{180b}'..='\u{180f}'
                    | '\u{200b}'..='\u{200f}'
                    | '\u{2028}'..='\u{202e}'
                    | '\u{2060}'..='\u{206f}'
                    | '\u{3164}' | '\u{feff}' | '\u{ffa0}'
                    | '\u{fff0}'..='\u{fffb}'
                    | '\u{fffe}' | '\u{ffff}'
                    | '\u{1bca0}'..='\u{1bca3}'
                    | '\u{1d173}'..='\u{1d17a}'
                    | '\u{e0000}'..='\u{e0fff}'
            )
}

/// The first hidden character, as people name it: `U+001B`.
///
/// # Examples
/// ```
/// use congruent_input::hidden_character;
/// assert_eq!(hidden_character("tool\u{202e}0").as_deref(), Some("U+202E"));
/// assert_eq!(hidden_character("outil_d\u{e9}port\u{e9} 0"), None);
/// ```
pub fn hidden_character(text: &str) -> Option<String> {
    text.chars().find(|&c| is_hidden(c)).map(|c| format!("U+{:04X}", u32::from(c)))
}

/// A text in one line: hidden characters, also line breaks, are escaped as in Rust.
///
/// # Examples
/// ```
/// use congruent_input::visible;
/// assert_eq!(visible("a\u{1b}[2J\nb"), r"a\u{1b}[2J\nb");
/// ```
pub fn visible(text: &str) -> Cow<'_, str> {
    written(text, is_hidden)
}

/// A text with its line breaks; other hidden characters are escaped as in Rust.
pub fn visible_lines(text: &str) -> Cow<'_, str> {
    written(text, |c| is_hidden(c) && c != '\n')
}

fn written(text: &str, is_escaped: impl Fn(char) -> bool) -> Cow<'_, str> {
    // Nearly every text is printable ASCII.
    let printable = text.bytes().take_while(|byte| matches!(byte, b' '..=b'~')).count();
    let Some(first) = text[printable..].find(&is_escaped) else { return Cow::Borrowed(text) };
    let first = printable + first;
    let (plain, rest) = text.split_at(first);
    let mut written = plain.to_owned();
    for c in rest.chars() {
        match c {
            c if !is_escaped(c) => written.push(c),
            '\n' => written.push_str("\\n"),
            '\r' => written.push_str("\\r"),
            '\t' => written.push_str("\\t"),
            c => written.extend(c.escape_unicode()),
        }
    }
    Cow::Owned(written)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_hidden_is_written_out() {
        let hidden = "\u{7}\u{9b}\u{202e}\u{2066}\u{200f}\u{61c}\u{2028}\u{200b}\u{feff}\u{e0041}";
        assert_eq!(
            visible(hidden),
            r"\u{7}\u{9b}\u{202e}\u{2066}\u{200f}\u{61c}\u{2028}\u{200b}\u{feff}\u{e0041}"
        );
        assert_eq!(visible("a\r\n\tb"), r"a\r\n\tb");
        assert_eq!(visible_lines("a\r\n\tb"), "a\\r\n\\tb");
    }

    #[test]
    fn other_text_stays() {
        let text = "Gelenk \u{e4} \u{2019} \u{6a9}\u{6cc} \u{95a2}\u{7bc0} \u{1f9be}";
        assert_eq!((visible(text), hidden_character(text)), (Cow::Borrowed(text), None));
        // Once it is visible it stays as it is.
        assert_eq!(visible(&visible("a\u{1b}")), visible("a\u{1b}"));
    }
}
