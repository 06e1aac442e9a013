//! Names that are a letter or two away from one that the grammar knows.

use std::ops::Range;

use congruent_input::Code;
use roxmltree::Node;

use super::rules::{Element, Occurs, ROBOT};
use crate::{
    codes,
    urdf::node::{elements, label},
};

/// A misspelt name of an element or attribute whose correct name does not occur beside it.
#[derive(Debug, Clone)]
pub struct Misspelling<'a> {
    /// The code of the finding that reports the name.
    pub code: &'static Code,
    /// The link or joint that it is in.
    pub owner: String,
    /// The name in the file.
    pub written: String,
    /// The name of the grammar that is meant.
    pub meant: &'static str,
    /// Where the name is.
    pub place: Misspelt<'a>,
}

/// The element or attribute whose name is misspelt.
#[derive(Debug, Clone)]
pub enum Misspelt<'a> {
    /// An attribute, by its range.
    Attribute(Range<usize>),
    /// An element.
    Element(Node<'a, 'a>),
}

/// All misspelt names of a document that the grammar check reports.
pub fn misspellings<'a>(root: Node<'a, 'a>) -> Vec<Misspelling<'a>> {
    let mut found = Vec::new();
    inside(root, &ROBOT, "robot", &mut found);
    for child in ROBOT.children {
        for node in elements(root, child.element.name) {
            below(node, child.element, &label(node), &mut found);
        }
    }
    found
}

/// Recursion ends with the grammar, whose deepest path has six elements.
fn below<'a>(node: Node<'a, 'a>, rules: &Element, owner: &str, found: &mut Vec<Misspelling<'a>>) {
    inside(node, rules, owner, found);
    for attribute in node.attributes().filter(|attribute| attribute.namespace().is_none()) {
        let name = attribute.name();
        if rules.attributes.iter().any(|known| known.name == name) {
            continue;
        }
        let meant = misspelt(name, rules.attributes, |known| known.name);
        // If the right name is there as well, the wrong one is not a misspelling of it.
        if let Some(meant) = meant.filter(|meant| !node.has_attribute(meant.name)) {
            found.push(Misspelling {
                code: codes::urdf::UNKNOWN_ATTRIBUTE,
                owner: owner.to_owned(),
                written: name.to_owned(),
                meant: meant.name,
                place: Misspelt::Attribute(attribute.range()),
            });
        }
    }
    for child in rules.children {
        for inner in node.children().filter(Node::is_element) {
            let name = inner.tag_name().name();
            let is_meant = || {
                misspelt(name, rules.children, |known| known.element.name)
                    .is_some_and(|known| known.element.name == child.element.name)
            };
            if name == child.element.name || (is_unknown(inner, rules) && is_meant()) {
                below(inner, child.element, owner, found);
            }
        }
    }
}

fn is_unknown(node: Node<'_, '_>, rules: &Element) -> bool {
    let name = node.tag_name();
    name.namespace().is_none() && rules.children.iter().all(|child| child.element.name != name.name())
}

/// The misspelt children of an element; of one that may be there once, the first if there is no other.
fn inside<'a>(parent: Node<'a, 'a>, rules: &Element, owner: &str, found: &mut Vec<Misspelling<'a>>) {
    let mut taken: Vec<&str> = Vec::new();
    for node in parent.children().filter(Node::is_element).filter(|node| is_unknown(*node, rules)) {
        let name = node.tag_name().name();
        let Some(meant) = misspelt(name, rules.children, |child| child.element.name) else { continue };
        let meant_name = meant.element.name;
        let is_there = elements(parent, meant_name).next().is_some() || taken.contains(&meant_name);
        if is_there && meant.occurs != Occurs::AnyNumber {
            continue;
        }
        taken.push(meant_name);
        let owner = if rules.name == "robot" { label(node) } else { owner.to_owned() };
        found.push(Misspelling {
            code: codes::urdf::UNKNOWN_ELEMENT,
            owner,
            written: name.to_owned(),
            meant: meant_name,
            place: Misspelt::Element(node),
        });
    }
}

/// The known thing whose name `name` is a misspelling of: other case, or at most one letter in three wrong.
pub(super) fn misspelt<'a, T>(
    name: &str,
    known: &'a [T],
    name_of: impl Fn(&T) -> &'static str,
) -> Option<&'a T> {
    const MOST_WRONG: usize = 2;
    let wrong = |known: &T| strsim::damerau_levenshtein(&name.to_lowercase(), name_of(known));
    known
        .iter()
        .map(|known| (wrong(known), known))
        // At most a third of the letters: "xyz" is no misspelling of "rpy".
        .filter(|(wrong, known)| *wrong <= MOST_WRONG && wrong * 3 <= name_of(known).len())
        .min_by_key(|(wrong, _)| *wrong)
        .map(|(_, known)| known)
}

#[cfg(test)]
mod tests {
    use super::misspelt;

    #[track_caller]
    fn check(name: &str, expected: Option<&str>) {
        let known = ["origin", "limit", "axis", "xyz", "collision", "joint", "safety_controller"];
        assert_eq!(misspelt(name, &known, |known| known).copied(), expected, "{name}");
    }

    #[test]
    fn misspellings_are_distinguished_from_vendor_names() {
        check("limits", Some("limit"));
        check("Limit", Some("limit"));
        check("orgin", Some("origin"));
        check("axes", Some("axis"));
        check("xzy", Some("xyz"));
        check("colission", Some("collision"));
        check("K", None);
        check("mu1", None);
        check("self_collision_checking", None);
        check("gazebo", None);
        check("sensor", None);
    }
}
