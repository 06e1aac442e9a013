//! How a text for people is laid out.

use super::layout::{Colours, fitted, for_people, with_coloured_status};

/// How a text for people is laid out. The default is that of a pipe: whole lines without colours, long findings clipped.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct TextOptions {
    /// Columns of the terminal in characters; `None` in a pipe or a file, where lines stay whole.
    pub columns: Option<usize>,
    /// Whether words and snippets are coloured, with the escape sequences of a terminal.
    pub is_coloured: bool,
    /// Whether all findings are shown in full, and lists that are counted otherwise (`--verbose`).
    pub is_in_full: bool,
}

impl TextOptions {
    /// The text in these columns, with the words coloured that say how something ended.
    pub fn laid_out(&self, text: String) -> String {
        let text = match self.columns {
            Some(columns) => fitted(&text, columns),
            None => text,
        };
        if self.is_coloured { with_coloured_status(&text) } else { text }
    }

    /// The text of a report as the command prints it: laid out, and without what a terminal or a CI host would obey.
    ///
    /// # Examples
    /// ```
    /// use congruent_text::TextOptions;
    ///
    /// let options = TextOptions { is_coloured: true, ..TextOptions::default() };
    /// assert_eq!(options.for_terminal("a\u{7}: pass\n"), "a\\u{7}: \u{1b}[32mpass\u{1b}[0m\n");
    /// ```
    pub fn for_terminal(&self, text: &str) -> String {
        for_people(&self.laid_out(text.to_owned()), self.colours())
    }

    /// Whether colours stay in the text.
    pub fn colours(&self) -> Colours {
        if self.is_coloured { Colours::Kept } else { Colours::Escaped }
    }
}
