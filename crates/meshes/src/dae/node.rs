//! Elements of a COLLADA document: children, references by id, and the numbers that they hold as text.

use std::collections::BTreeMap;

use roxmltree::{Document, Node};

use crate::mesh_file::MeshError;

/// The elements with an id.
pub(super) struct Ids<'a, 'i>(BTreeMap<&'a str, Node<'a, 'i>>);

impl<'a, 'i> Ids<'a, 'i> {
    pub(super) fn new(document: &'a Document<'i>) -> Self {
        Self(document.descendants().filter_map(|node| Some((node.attribute("id")?, node))).collect())
    }

    /// What the `key` of a node points to: `#id`, of an element called `name`.
    pub(super) fn target(
        &self,
        node: Node<'a, 'i>,
        key: &str,
        name: &str,
    ) -> Result<(&'a str, Node<'a, 'i>), MeshError> {
        let url = node.attribute(key).unwrap_or_default();
        let id = url.strip_prefix('#').unwrap_or(url);
        match self.0.get_key_value(id) {
            Some((id, target)) if target.tag_name().name() == name => Ok((id, *target)),
            _ => Err(fault(node, format!("<{name}> \"{url}\" not found"))),
        }
    }
}

pub(super) fn format_fault(what: impl Into<String>) -> MeshError {
    MeshError::Format { what: what.into() }
}

/// A fault at an element.
pub(super) fn fault(node: Node<'_, '_>, what: impl Into<String>) -> MeshError {
    let line = node.document().text_pos_at(node.range().start).row as usize;
    MeshError::Line { line, what: what.into() }
}

pub(super) fn child<'a, 'i>(parent: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    children(parent, name).next()
}

pub(super) fn children<'a, 'i>(parent: Node<'a, 'i>, name: &str) -> impl Iterator<Item = Node<'a, 'i>> {
    parent.children().filter(move |node| node.tag_name().name() == name)
}

/// The numbers that an element holds as text.
pub(super) fn numbers<T: std::str::FromStr>(node: Node<'_, '_>) -> Result<Vec<T>, MeshError> {
    let parse = |token: &str| {
        token
            .parse()
            .map_err(|_| fault(node, format!("<{}>: \"{token}\" is not a number", node.tag_name().name())))
    };
    node.text().unwrap_or_default().split_ascii_whitespace().map(parse).collect()
}

pub(super) fn numbers_of<const N: usize>(node: Node<'_, '_>) -> Result<[f64; N], MeshError> {
    let found: Vec<f64> = numbers(node)?;
    let count = found.len();
    found
        .try_into()
        .map_err(|_| fault(node, format!("<{}> needs {N} numbers, found {count}", node.tag_name().name())))
}
