//! Tables for people: columns as wide as their longest entry.

use std::{fmt::Write, ops::Range};

use super::units::is_unit_of;
use congruent_input::display::in_column;
use congruent_kinematics::ReportedPose;

/// Rows of a table: the first column is aligned to the left, the others to the right.
#[derive(Debug, Default)]
pub struct Table {
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table with the names of its columns.
    pub fn headed<const N: usize>(names: [&str; N]) -> Self {
        Self { rows: vec![names.map(str::to_owned).to_vec()] }
    }

    /// Adds a row below the others; its first cell is aligned to the left.
    pub fn row(&mut self, row: impl IntoIterator<Item = String>) {
        self.rows.push(row.into_iter().collect());
    }

    /// Adds it to a text, each row indented. If it is wider than the columns of the terminal it goes on below, with its
    /// first column again; `None` is a text without a width.
    pub fn write(&self, text: &mut String, columns: Option<usize>) {
        let columns = columns.unwrap_or(usize::MAX);
        let count = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        let length = |cell: &String| cell.chars().count();
        let width = |at: usize| column_width(self.rows.iter().filter_map(|row| row.get(at)).map(length));
        let widths: Vec<usize> = (0..count).map(width).collect();
        let mut next = 1;
        loop {
            let room = columns.saturating_sub(widths.first().map_or(0, |first| first + 2));
            let mut end = next;
            let mut used = 0;
            while end < count && (end == next || used + widths[end] + 2 <= room) {
                used += widths[end] + 2;
                end += 1;
            }
            self.write_columns(text, &widths, next..end);
            if end >= count {
                return;
            }
            next = end;
        }
    }

    /// The first column and these.
    fn write_columns(&self, text: &mut String, widths: &[usize], shown: Range<usize>) {
        for row in &self.rows {
            let mut line = String::new();
            if let (Some(cell), Some(width)) = (row.first(), widths.first()) {
                let _ = write!(line, "  {cell:width$}");
            }
            for at in shown.clone() {
                if let Some(cell) = row.get(at) {
                    let _ = write!(line, "  {cell:>0$}", widths[at]);
                }
            }
            let _ = writeln!(text, "{}", line.trim_end());
        }
    }
}

/// The width of a column, in characters, with cells of these lengths. A cell that is longer than any name should be moves its own row alone.
pub fn column_width(lengths: impl Iterator<Item = usize>) -> usize {
    const WIDEST: usize = 160;
    lengths.max().unwrap_or(0).min(WIDEST)
}

/// A list whose entries are divided by `, `, in lines of at most 96 characters, each indented.
pub fn wrapped(list: &str) -> String {
    const WIDTH: usize = 96;
    const INDENT: &str = "    ";
    let (mut text, mut length) = (String::new(), WIDTH);
    for entry in list.split_inclusive(", ") {
        let longer = length + entry.trim_end().chars().count();
        if longer > WIDTH {
            text.truncate(text.trim_end().len());
            let _ = write!(text, "{}{INDENT}", if text.is_empty() { "" } else { "\n" });
            length = INDENT.len();
        }
        text.push_str(entry);
        length += entry.chars().count();
    }
    text.push('\n');
    text
}

/// Words in lines of at most 80 characters, the first line and those after it each with its indent. A word that is longer
/// than a line has one of its own; a number stays with its unit.
pub fn paragraph(words: &str, first_indent: usize, indent: usize) -> String {
    const WIDTH: usize = 80;
    let (mut text, mut length) = (" ".repeat(first_indent), first_indent);
    let mut is_first = true;
    for word in values(words) {
        let word_length = word.chars().count();
        if !is_first && length + 1 + word_length > WIDTH {
            text.push('\n');
            text += &" ".repeat(indent);
            length = indent;
        } else if !is_first {
            text.push(' ');
            length += 1;
        }
        text += &word;
        length += word_length;
        is_first = false;
    }
    text.push('\n');
    text
}

/// The words of a text, numbers with their units as one.
fn values(text: &str) -> Vec<String> {
    let (mut values, mut before) = (Vec::<String>::new(), "");
    for word in text.split_whitespace() {
        match values.last_mut().filter(|_| is_unit_of(before, word)) {
            Some(value) => *value = format!("{value} {word}"),
            None => values.push(word.to_owned()),
        }
        before = word;
    }
    values
}

/// The columns of [`pose_cells`].
pub const POSE_COLUMNS: [&str; 11] =
    ["", "x mm", "y mm", "z mm", "roll deg", "pitch", "yaw", "quat w", "x", "y", "z"];

/// A pose: translation, roll, pitch and yaw about the fixed axes, quaternion.
pub fn pose_cells(pose: &ReportedPose) -> impl Iterator<Item = String> {
    let lengths = pose.translation_m.map(|value| in_column(value, "m"));
    // Half a turn has one name.
    let angle = |value| in_column(value, "rad").replace("-180.00", "180.00");
    let angles = pose.rpy_rad().map(angle);
    let quaternion = with_one_sign(pose.quaternion_wxyz).map(|value| in_column(value, ""));
    lengths.into_iter().chain(angles).chain(quaternion)
}

/// The quaternion of an orientation, of the two with opposite signs, whose first component above rounding is
/// positive.
pub fn with_one_sign(quaternion_wxyz: [f64; 4]) -> [f64; 4] {
    const ROUNDING: f64 = 1e-9;
    let first = quaternion_wxyz.iter().find(|component| component.abs() > ROUNDING);
    let sign = first.map_or(1.0, |component| component.signum());
    quaternion_wxyz.map(|component| sign * component)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_does_not_turn_a_quaternion_around() {
        assert_eq!(with_one_sign([-1e-17, 0.0, 0.6, 0.8])[2..], [0.6, 0.8]);
        assert_eq!(with_one_sign([1e-17, 0.0, -0.6, -0.8])[2..], [0.6, 0.8]);
        assert_eq!(with_one_sign([-1.0, 0.0, 0.0, 0.0])[0].to_bits(), 1.0_f64.to_bits());
    }

    #[test]
    fn long_lists_are_wrapped() {
        let text = wrapped(&["joint 90 deg"; 9].join(", "));
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 2);
        assert_eq!(lines.iter().map(|line| line.matches("joint").count()).sum::<usize>(), 9);
        assert!(lines.iter().all(|line| line.len() <= 96 && line.starts_with("    j")), "{text}");
    }

    #[test]
    fn a_paragraph_has_80_columns_except_for_longer_words() {
        let text = paragraph(&format!("{} {}", ["word"; 30].join(" "), "x".repeat(90)), 2, 4);
        let lines: Vec<&str> = text.lines().collect();
        assert!(lines[0].starts_with("  word") && lines[1].starts_with("    word"), "{text}");
        assert!(lines[..lines.len() - 1].iter().all(|line| line.len() <= 80), "{text}");
        assert_eq!(lines.last().unwrap().len(), 94);
    }

    #[test]
    fn a_table_that_is_too_wide_goes_on_below() {
        let mut table = Table::headed(["", "one", "two", "three"]);
        table.row(["name", "1.00", "2.00", "3.00"].map(str::to_owned));
        let mut text = String::new();
        table.write(&mut text, Some(18));
        assert_eq!(text, "         one   two\n  name  1.00  2.00\n        three\n  name   3.00\n");
        for columns in 0..40 {
            let mut text = String::new();
            table.write(&mut text, Some(columns));
            assert!(["1.00", "2.00", "3.00"].iter().all(|cell| text.matches(cell).count() == 1), "{text}");
        }
    }

    #[test]
    fn columns_are_aligned() {
        let mut table = Table::headed(["", "mm"]);
        table.row(["shoulder".to_owned(), "1.00".to_owned()]);
        table.row(["tip".to_owned(), "-817.25".to_owned()]);
        let mut text = String::new();
        table.write(&mut text, None);
        assert_eq!(text, "                 mm\n  shoulder     1.00\n  tip       -817.25\n");
    }
}
