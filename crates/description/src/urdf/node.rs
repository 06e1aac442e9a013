//! Elements of a URDF's XML, and the spans at which messages show them.

use std::ops::Range;

use congruent_input::visible;
use roxmltree::Node;

/// The last element with this name: of two that share one, the second is at fault.
pub fn last<'a, 'i>(root: Node<'a, 'i>, tag_name: &str, name: &str) -> Option<Node<'a, 'i>> {
    elements(root, tag_name).filter(|node| node.attribute("name") == Some(name)).last()
}

/// The child elements with this name, in file order.
pub fn elements<'a, 'i>(parent: Node<'a, 'i>, name: &str) -> impl Iterator<Item = Node<'a, 'i>> {
    parent.children().filter(move |node| node.is_element() && node.tag_name().name() == name)
}

/// The child element with this name, if there is one.
pub fn element<'a, 'i>(parent: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    elements(parent, name).next()
}

/// The place of a child element, or of the element itself if the child is missing.
pub fn place(parent: Node<'_, '_>, child: &str) -> Range<usize> {
    tag(element(parent, child).unwrap_or(parent))
}

/// The opening of a start tag, `<name`: an element's whole range may be a thousand lines.
pub fn tag(node: Node<'_, '_>) -> Range<usize> {
    let range = node.range();
    let text = &node.document().input_text()[range.clone()];
    let end = text.find(|c: char| c.is_whitespace() || c == '/' || c == '>').unwrap_or(text.len());
    range.start..range.start + end
}

/// `link "forearm"`, its name cut if it is longer than a line.
pub fn label(node: Node<'_, '_>) -> String {
    const SHOWN: usize = 60;
    let name = node.attribute("name").unwrap_or_default();
    let short: String = name.chars().take(SHOWN).collect();
    let dots = if short.len() < name.len() { "..." } else { "" };
    format!("{} \"{}{dots}\"", node.tag_name().name(), visible(&short))
}
