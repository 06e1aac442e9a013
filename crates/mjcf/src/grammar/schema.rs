//! The elements and attributes that MuJoCo 4.0.0 knows, from `schema.txt`.
//!
//! The file is what `mj_printSchema` prints, with the types of the XML reference; which arrays may be shorter was
//! tried. A line is an element, indented below its parent, or begins with `.` and continues the one before.
//! After the name: how often it occurs (`!` once, `?` at most once, `*` any, `R` any and inside itself), then
//! `=body` if its children are those of a body, then the attributes as `name:type`, required ones as `name!:type`.
//! Types: `s` text, `k[a|b]` one of some words, `r3` three numbers, `r..3` at most three, `r*` any, `i` for integers.

use std::{collections::BTreeMap, sync::LazyLock};

use super::numbers::MjNumberKind;

/// An attribute's type.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum MjAttributeType {
    Text,
    Keyword(Vec<&'static str>),
    Numbers { least: usize, most: usize, kind: MjNumberKind },
}

/// An attribute that an element may have.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct MjAttributeRule {
    pub(super) value: MjAttributeType,
    pub(super) is_required: bool,
}

/// An element that MJCF knows.
#[derive(Debug, Default)]
pub(super) struct MjElementRule {
    pub(super) occurs: char,
    pub(super) attributes: BTreeMap<&'static str, MjAttributeRule>,
    /// Indices of the children's rules in the schema.
    children: BTreeMap<&'static str, usize>,
}

/// All rules; the first is that of the root.
#[derive(Debug)]
pub(super) struct MjSchema(Vec<MjElementRule>);

/// The schema, parsed once.
pub(super) static SCHEMA: LazyLock<MjSchema> = LazyLock::new(|| MjSchema::parse(include_str!("schema.txt")));

impl MjSchema {
    pub(super) fn root(&self) -> &MjElementRule {
        &self.0[0]
    }

    /// The rule of a child.
    pub(super) fn child(&self, parent: &MjElementRule, tag: &str) -> Option<&MjElementRule> {
        parent.children.get(tag).map(|&index| &self.0[index])
    }

    /// The names of all children of an element.
    pub(super) fn children(parent: &MjElementRule) -> impl Iterator<Item = &'static str> + Clone {
        parent.children.keys().copied()
    }

    fn parse(text: &'static str) -> Self {
        let mut rules: Vec<MjElementRule> = Vec::new();
        // Indices of the elements that are open, outermost first.
        let mut open: Vec<usize> = Vec::new();
        let (mut like_body, mut body) = (Vec::new(), 0);
        for line in text.lines() {
            let mut words = line.split_whitespace();
            let Some(tag) = words.next() else { continue };
            let index = rules.len();
            if tag != "." {
                let depth = (line.len() - line.trim_start().len()) / 2;
                open.truncate(depth);
                let occurs = words.next().and_then(|word| word.chars().next()).unwrap_or('*');
                rules.push(MjElementRule { occurs, ..MjElementRule::default() });
                if let Some(&parent) = open.last() {
                    rules[parent].children.insert(tag, index);
                }
                if occurs == 'R' {
                    rules[index].children.insert(tag, index);
                }
                if tag == "body" && occurs == 'R' {
                    body = index;
                }
                open.push(index);
            }
            let at = open.last().copied().unwrap_or_default();
            for word in words {
                if word == "=body" {
                    like_body.push(at);
                } else if let Some((key, rule)) = attribute(word) {
                    rules[at].attributes.insert(key, rule);
                }
            }
        }
        // A body is written in <worldbody>, not beside it.
        rules[0].children.remove("body");
        for index in like_body {
            rules[index].children = rules[body].children.clone();
        }
        Self(rules)
    }
}

fn attribute(word: &'static str) -> Option<(&'static str, MjAttributeRule)> {
    let (key, kind) = word.split_once(':')?;
    let value = if let Some(words) = kind.strip_prefix("k[") {
        MjAttributeType::Keyword(words.trim_end_matches(']').split('|').collect())
    } else if kind == "s" {
        MjAttributeType::Text
    } else {
        let is_integer = kind.starts_with('i');
        let (kind, count) = (if is_integer { MjNumberKind::Integer } else { MjNumberKind::Real }, &kind[1..]);
        let (least, most) = match count.strip_prefix("..") {
            _ if count == "*" => (0, usize::MAX),
            Some(most) => (1, most.parse().ok()?),
            None => (count.parse().ok()?, count.parse().ok()?),
        };
        MjAttributeType::Numbers { least, most, kind }
    };
    let name = key.trim_end_matches('!');
    Some((name, MjAttributeRule { value, is_required: name.len() < key.len() }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_schema_is_complete() {
        let child = |parent, tag| SCHEMA.child(parent, tag).unwrap();
        let world = child(SCHEMA.root(), "worldbody");
        let body = child(world, "body");
        assert!(world.attributes.is_empty() && SCHEMA.child(SCHEMA.root(), "body").is_none());
        let nested = child(child(child(child(body, "body"), "frame"), "replicate"), "body");
        let joint = child(nested, "joint");
        let range = MjAttributeType::Numbers { least: 2, most: 2, kind: MjNumberKind::Real };
        assert_eq!(joint.attributes["range"].value, range);
        assert!(child(body, "inertial").attributes["mass"].is_required);
        let class = child(child(SCHEMA.root(), "default"), "default");
        assert_eq!(child(class, "joint").occurs, '?');
    }
}
