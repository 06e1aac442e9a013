//! Corrections of a robot file as changes of its text: a written value is replaced, a missing one is added beside its
//! neighbour, and the rest of the line is kept.

use std::ops::Range;

use congruent_input::{ChangedLines, Slack, TextEdit, WrittenTransform, changed_lines, line_end};
use congruent_robot::DhConvention;
use nalgebra::Isometry3;
use toml::Spanned;

use super::places::{ConstantKey, RobotFilePlaces, RowKey};

impl RobotFilePlaces {
    /// The edit after which the table has another convention; `None` if the file has no convention.
    pub fn set_convention(&self, convention: DhConvention) -> Option<TextEdit> {
        Some(TextEdit { span: self.convention()?, text: format!("\"{}\"", convention.name()) })
    }

    /// The edit after which a row has another value, given as a TOML literal in the unit of the key that the row uses.
    pub fn set_value(&self, row: usize, key: RowKey, literal: &str) -> Option<TextEdit> {
        let place = self.value(row, key)?;
        Some(if place.is_written {
            TextEdit { span: place.span, text: literal.to_owned() }
        } else {
            let sibling = self.last_of_row(row).unwrap_or(place.span);
            self.beside(&sibling, &format!("{} = {literal}", place.key))
        })
    }

    /// The edits after which a declared transform has another value, in the units and by the kind of rotation that the file uses.
    pub fn set_constant(&self, key: ConstantKey, pose: &Isometry3<f64>, slack: Slack) -> Vec<TextEdit> {
        let name = key.name();
        let keys = self.constant_keys(key, pose, slack);
        let Some(written) = self.written(key) else {
            let Some(convention) = self.convention() else { return Vec::new() };
            return vec![self.beside(&convention, &format!("{name} = {{ {} }}", keys.join(", ")))];
        };
        let text = &self.source().text;
        if text[written.span()].starts_with('{') {
            let inline = if keys.is_empty() { "{}".to_owned() } else { format!("{{ {} }}", keys.join(", ")) };
            return vec![TextEdit { span: written.span(), text: inline }];
        }
        // Under a header of its own, or with dotted keys.
        let is_header = text[written.span()].starts_with('[');
        let last = spans(written.get_ref()).map(|(_, span)| span).max_by_key(|span| span.end);
        let mut edits = Vec::new();
        for assignment in keys {
            let Some((key, value)) = assignment.split_once(" = ") else { continue };
            let mut known = spans(written.get_ref());
            let edit = match (known.find(|(known, _)| *known == key), &last) {
                (Some((_, span)), _) => TextEdit { span, text: value.to_owned() },
                (None, Some(sibling)) => self.beside(sibling, &assignment),
                (None, None) if is_header => {
                    let end = line_end(text, written.span().start);
                    TextEdit { span: end..end, text: format!("\n{assignment}") }
                }
                (None, None) => continue,
            };
            edits.push(edit);
        }
        edits
    }

    /// A key beside a value of the same table: in an inline table behind it, otherwise on a line of its own.
    fn beside(&self, sibling: &Range<usize>, assignment: &str) -> TextEdit {
        let text = &self.source().text;
        let is_inline = text[sibling.end..].trim_start().starts_with([',', '}']);
        if is_inline {
            return TextEdit { span: sibling.end..sibling.end, text: format!(", {assignment}") };
        }
        let line = text[..sibling.start].rfind('\n').map_or(0, |at| at + 1);
        // `dh.convention = ...` has a prefix that its siblings need as well, `  convention` an indentation.
        let key = text[line..sibling.start].trim_end().trim_end_matches('=').trim_end();
        let own = key.rfind(['.', ' ', '\t']).map_or(0, |at| at + 1);
        let end = line_end(text, sibling.end);
        TextEdit { span: end..end, text: format!("\n{}{assignment}", &key[..own]) }
    }

    /// The lines that edits change, each with all edits in it; in the order of the file.
    pub fn changed_lines(&self, edits: &[TextEdit]) -> Vec<ChangedLines> {
        changed_lines(&self.source().text, edits)
    }
}

/// The keys of a transform that are written, with the places of their values.
fn spans(written: &WrittenTransform) -> impl Iterator<Item = (&'static str, Range<usize>)> {
    let WrittenTransform { xyz_m, xyz_mm, rpy_rad, rpy_deg, quaternion_wxyz, matrix } = written;
    [
        ("xyz_m", xyz_m.as_ref().map(Spanned::span)),
        ("xyz_mm", xyz_mm.as_ref().map(Spanned::span)),
        ("rpy_rad", rpy_rad.as_ref().map(Spanned::span)),
        ("rpy_deg", rpy_deg.as_ref().map(Spanned::span)),
        ("quaternion_wxyz", quaternion_wxyz.as_ref().map(Spanned::span)),
        ("matrix", matrix.as_ref().map(Spanned::span)),
    ]
    .into_iter()
    .filter_map(|(key, span)| Some((key, span?)))
}
