//! Lines and columns of many places in one text. Offsets in ascending order are found in one pass over the text.

/// Counts lines and columns of a text.
///
/// # Examples
/// ```
/// use congruent_input::LineCounter;
/// let mut places = LineCounter::new("a = 1\nb = \u{e9} 2\n");
/// assert_eq!([0, 6, 13, 4].map(|offset| places.line_column(offset)), [(1, 1), (2, 1), (2, 7), (1, 5)]);
/// ```
#[derive(Debug)]
pub struct LineCounter<'a> {
    text: &'a str,
    /// Byte offset up to which lines are counted.
    at: usize,
    line: usize,
    column: usize,
}

impl<'a> LineCounter<'a> {
    /// A counter at the beginning of `text`.
    pub fn new(text: &'a str) -> Self {
        Self { text, at: 0, line: 1, column: 1 }
    }

    /// Line and column of a byte offset, both from 1, columns in characters. An offset before the last one starts from
    /// the beginning again.
    pub fn line_column(&mut self, offset: usize) -> (usize, usize) {
        let offset = self.text.floor_char_boundary(offset);
        if offset < self.at {
            *self = Self::new(self.text);
        }
        let passed = &self.text[self.at..offset];
        if let Some(last_break) = passed.rfind('\n') {
            self.line += memchr::memchr_iter(b'\n', passed.as_bytes()).count();
            self.column = 1 + passed[last_break + 1..].chars().count();
        } else {
            self.column += passed.chars().count();
        }
        self.at = offset;
        (self.line, self.column)
    }
}
