//! Attributes of one element of an MJCF, changed in its text.

use congruent_input::{TextEdit, xml};

/// An attribute that an element gets.
pub(super) struct NewAttribute {
    /// The attribute that it takes the place of, which may have the same key; it is added if the element has none of this key.
    pub(super) in_place_of: String,
    pub(super) key: &'static str,
    pub(super) value: String,
}

impl NewAttribute {
    /// Another value of an attribute, or the attribute if the element lacks it.
    pub(super) fn value(key: &'static str, value: String) -> Self {
        Self { in_place_of: key.to_owned(), key, value }
    }
}

/// The edits after which the element whose tag begins at `start` has the new attributes and lacks the removed ones; none if no
/// element begins there.
pub(super) fn changed_attributes(
    text: &str,
    start: usize,
    new: &[NewAttribute],
    removed: &[&str],
) -> Vec<TextEdit> {
    let Ok(document) = xml::parse(text) else { return Vec::new() };
    let is_there = |node: &roxmltree::Node<'_, '_>| node.is_element() && node.range().start == start;
    let Some(node) = document.descendants().find(is_there) else { return Vec::new() };
    let attribute = |key: &str| node.attributes().find(|attribute| attribute.name() == key);
    let tag_end = start + 1 + node.tag_name().name().len();
    let end = node.attributes().next_back().map_or(tag_end, |last| last.range().end);
    let changed = new.iter().map(|NewAttribute { in_place_of, key, value }| match attribute(in_place_of) {
        Some(written) => TextEdit { span: written.range(), text: format!("{key}=\"{value}\"") },
        None => TextEdit { span: end..end, text: format!(" {key}=\"{value}\"") },
    });
    let removed = removed.iter().filter_map(|key| {
        let range = attribute(key)?.range();
        // With the space before it.
        let before = text[..range.start].trim_end().len();
        Some(TextEdit { span: before..range.end, text: String::new() })
    });
    changed.chain(removed).collect()
}
