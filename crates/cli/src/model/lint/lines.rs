//! Lines and columns of many places of several files: where its lines begin is found out once for each file.

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

use congruent::input::SourceFile;

/// The beginnings of the lines of files, by path.
#[derive(Debug, Default)]
pub(super) struct Lines(BTreeMap<PathBuf, Vec<usize>>);

impl Lines {
    /// The line of a byte offset, from 1.
    pub(super) fn line(&mut self, source: &SourceFile, offset: usize) -> usize {
        self.starts(source).partition_point(|&start| start <= offset)
    }

    /// Line and column of a byte offset, both from 1, columns in characters.
    pub(super) fn line_column(&mut self, source: &SourceFile, offset: usize) -> (usize, usize) {
        let offset = source.text.floor_char_boundary(offset);
        let line = self.line(source, offset);
        let start = self.starts(source)[line - 1];
        (line, 1 + source.text[start..offset].chars().count())
    }

    fn starts(&mut self, source: &SourceFile) -> &[usize] {
        let path: &Path = &source.path;
        if !self.0.contains_key(path) {
            let breaks = source.text.match_indices('\n').map(|(at, _)| at + 1);
            self.0.insert(path.to_owned(), std::iter::once(0).chain(breaks).collect());
        }
        &self.0[path]
    }
}

#[cfg(test)]
mod tests {
    use congruent::input::line_column;

    use super::*;

    #[test]
    fn places_are_those_of_the_text() {
        let text = "ab\n\u{e9}<x>\n\n<y>".to_owned();
        let source = SourceFile { path: "a.urdf".into(), text: text.clone(), is_foreign: false };
        let mut lines = Lines::default();
        for offset in (0..=text.len() + 2).rev() {
            let expected = line_column(&text, offset);
            assert_eq!(lines.line_column(&source, offset), expected, "{offset}");
        }
    }
}
