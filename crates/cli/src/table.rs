//! Tables for people: columns as wide as their longest entry.

use std::fmt::Write;

use congruent::{description::display::in_column, kinematics::ReportedPose};

/// Rows of a table: the first column is aligned to the left, the others to the right.
#[derive(Debug, Default)]
pub(crate) struct Table {
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table with the names of its columns.
    pub(crate) fn headed<const N: usize>(names: [&str; N]) -> Self {
        Self { rows: vec![names.map(str::to_owned).to_vec()] }
    }

    /// Adds a row.
    pub(crate) fn row(&mut self, row: impl IntoIterator<Item = String>) {
        self.rows.push(row.into_iter().collect());
    }

    /// Adds it to a text, each row indented.
    pub(crate) fn write(&self, text: &mut String) {
        let columns = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        let length = |cell: &String| cell.chars().count();
        let width = |at: usize| self.rows.iter().filter_map(|row| row.get(at)).map(length).max().unwrap_or(0);
        let widths: Vec<usize> = (0..columns).map(width).collect();
        for row in &self.rows {
            let mut line = String::new();
            for (at, (cell, &width)) in row.iter().zip(&widths).enumerate() {
                let _ =
                    if at == 0 { write!(line, "  {cell:width$}") } else { write!(line, "  {cell:>width$}") };
            }
            let _ = writeln!(text, "{}", line.trim_end());
        }
    }
}

/// The columns of [`pose_cells`].
pub(crate) const POSE_COLUMNS: [&str; 11] =
    ["", "x mm", "y mm", "z mm", "roll deg", "pitch", "yaw", "quat w", "x", "y", "z"];

/// A pose: translation, roll, pitch and yaw about the fixed axes, quaternion.
pub(crate) fn pose_cells(pose: &ReportedPose) -> impl Iterator<Item = String> {
    let lengths = pose.translation_m.map(|value| in_column(value, "m"));
    let angles = pose.rpy_rad().map(|value| in_column(value, "rad"));
    let quaternion = pose.quaternion_wxyz.map(|value| in_column(value, ""));
    lengths.into_iter().chain(angles).chain(quaternion)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_aligned() {
        let mut table = Table::headed(["", "mm"]);
        table.row(["shoulder".to_owned(), "1.00".to_owned()]);
        table.row(["tip".to_owned(), "-817.25".to_owned()]);
        let mut text = String::new();
        table.write(&mut text);
        assert_eq!(text, "                 mm\n  shoulder     1.00\n  tip       -817.25\n");
    }
}
