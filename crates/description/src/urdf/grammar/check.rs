//! Checks the XML against the grammar: missing, repeated and misspelt parts, and every number.
//!
//! Elements and attributes that the grammar does not know are vendors' own and are ignored, unless the
//! name is a letter or two away from one that the grammar knows.

use std::ops::Range;

use congruent_input::{Capability, Code, Diagnostic, Diagnostics, hidden_character, known_names};
use roxmltree::{Attribute as XmlAttribute, Node};

use super::{
    misspelt::misspelt,
    number,
    rules::{Attribute, AttributeValue, Child, Element, Needed, Occurs, ROBOT},
};
use crate::{
    codes,
    urdf::node::{elements, label, tag},
};

/// The longest name without a warning: what a file system allows.
const LONGEST_NAME: usize = 255;
/// Limits that version 1.2 has added.
const RATES: [&str; 3] = ["acceleration", "deceleration", "jerk"];

/// Checks a whole document. Returns the byte ranges of faulty parts that kinematics does not need, which must not be read.
pub(crate) fn check(root: Node<'_, '_>, diagnostics: &mut Diagnostics) -> Vec<Range<usize>> {
    if root.attribute("name").is_none_or(str::is_empty) {
        diagnostics.push(Diagnostic::warning(codes::urdf::ROBOT_NAME, "the robot has no name").at(tag(root)));
    }
    let mut check = GrammarCheck {
        version: version(root),
        owner: "robot".to_owned(),
        part: DocumentPart { needed_by: Some(Capability::Kinematics), ranges: Vec::new() },
        unread: Vec::new(),
        diagnostics,
    };
    check.attributes(root, &ROBOT);
    check.unknown_children(root, &ROBOT);
    for child in ROBOT.children {
        for node in elements(root, child.element.name) {
            check.owner = label(node);
            check.element(node, child.element);
            check.name(node);
        }
    }
    check.unread
}

/// `version="1.1"` as numbers; 1.0 if it is missing or no version, as in urdfdom.
fn version(root: Node<'_, '_>) -> (u32, u32) {
    let parse = |text: &str| {
        let (major, minor) = text.trim().split_once('.')?;
        Some((major.parse().ok()?, minor.parse().ok()?))
    };
    root.attribute("version").and_then(parse).unwrap_or((1, 0))
}

/// A part of the document that is read or left out as a whole.
#[derive(Clone)]
struct DocumentPart {
    /// The use of the robot that a fault in this part blocks.
    needed_by: Option<Capability>,
    ranges: Vec<Range<usize>>,
}

impl DocumentPart {
    /// The part that a fault at `ranges` blanks: these ranges, unless they are as necessary as the element around them.
    fn inner(&self, needed: Needed, ranges: Vec<Range<usize>>) -> Self {
        match needed {
            Needed::AsItsParent => self.clone(),
            Needed::For(needed_by) => Self { needed_by, ranges },
        }
    }
}

struct GrammarCheck<'f> {
    version: (u32, u32),
    /// The link, joint or material that is read: every diagnostic begins with it.
    owner: String,
    part: DocumentPart,
    unread: Vec<Range<usize>>,
    diagnostics: &'f mut Diagnostics,
}

impl GrammarCheck<'_> {
    /// A fault of the part that is checked.
    fn report(&mut self, code: &'static Code, what: &str, at: Range<usize>) {
        let part = self.part.clone();
        self.report_in(&part, Diagnostic::error(code, what), at);
    }

    fn report_in(&mut self, part: &DocumentPart, fault: Diagnostic, at: Range<usize>) {
        let message = format!("{}: {}", self.owner, fault.message);
        let kind = format!("times {}", fault.message);
        let fault = Diagnostic { message, ..fault }.one_of(kind, &self.owner);
        self.diagnostics.push(fault.needed_by(part.needed_by).at(at));
        // Not read: urdf-rs would refuse the whole document for one such part.
        if part.needed_by != Some(Capability::Kinematics) {
            self.unread.extend(part.ranges.iter().cloned());
        }
    }

    /// Recursion ends with the grammar, whose deepest path has six elements.
    fn element(&mut self, node: Node<'_, '_>, rules: &Element) {
        let inner = self.part.inner(rules.needed, vec![node.range()]);
        let outer = std::mem::replace(&mut self.part, inner);
        self.attributes(node, rules);
        self.unknown_children(node, rules);
        for child in rules.children {
            self.occurrences(node, child);
            for found in elements(node, child.element.name) {
                self.element(found, child.element);
            }
        }
        let shapes = node.children().filter(Node::is_element).count();
        if rules.is_choice && shapes != 1 {
            let found = if shapes == 0 { "has no shape" } else { "has more than one shape" };
            self.report(codes::urdf::GEOMETRY, &format!("<{}> {found}", rules.name), tag(node));
        }
        if rules.name == "limit" && self.version < (1, 2) {
            self.limit(node);
        }
        self.part = outer;
    }

    /// Before version 1.2 both must be given. A missing one is read as unlimited and reported as a warning.
    fn limit(&mut self, node: Node<'_, '_>) {
        let is_fixed = node.parent().is_some_and(|joint| joint.attribute("type") == Some("fixed"));
        for key in ["effort", "velocity"].into_iter().filter(|key| !is_fixed && !node.has_attribute(*key)) {
            let fault = Diagnostic::error(
                codes::urdf::MISSING_ATTRIBUTE,
                format!("<limit> has no {key}: it is taken as unlimited"),
            );
            self.report_in(&DocumentPart { needed_by: None, ranges: Vec::new() }, fault, tag(node));
        }
    }

    fn occurrences(&mut self, parent: Node<'_, '_>, child: &Child) {
        let name = child.element.name;
        let mut found = elements(parent, name);
        match (found.next(), found.next()) {
            (None, _) if child.occurs == Occurs::Once => {
                let what = match parent.tag_name().name() {
                    "joint" | "link" => format!("missing <{name}>"),
                    inside => format!("<{inside}> has no <{name}>"),
                };
                self.report(codes::urdf::MISSING_ELEMENT, &what, tag(parent));
            }
            (_, Some(second)) if child.occurs != Occurs::AnyNumber => {
                // All of them: which one is meant is not known.
                let all = elements(parent, name).map(|node| node.range()).collect();
                let fault =
                    Diagnostic::error(codes::urdf::REPEATED_ELEMENT, format!("<{name}> is given twice"));
                self.report_in(&self.part.inner(child.element.needed, all), fault, tag(second));
            }
            _ => {}
        }
    }

    fn attributes(&mut self, node: Node<'_, '_>, rules: &Element) {
        for attribute in node.attributes().filter(|attribute| attribute.namespace().is_none()) {
            match rules.attributes.iter().find(|known| known.name == attribute.name()) {
                Some(known) => self.attribute(rules, known, &attribute),
                None => self.unknown_attribute(rules, &attribute),
            }
        }
        for missing in rules.attributes.iter().filter(|a| a.is_required && !node.has_attribute(a.name)) {
            let what = format!("<{}> has no {}", rules.name, missing.name);
            self.report(codes::urdf::MISSING_ATTRIBUTE, &what, tag(node));
        }
    }

    fn attribute(&mut self, rules: &Element, known: &Attribute, attribute: &XmlAttribute<'_, '_>) {
        let value = attribute.value();
        let fault = match known.value {
            AttributeValue::Name if value.trim().is_empty() => {
                Some((codes::urdf::EMPTY_NAME, "it is empty".to_owned()))
            }
            // Texts and names are copied into every output.
            AttributeValue::Text | AttributeValue::Name => hidden_character(value).map(|hidden| {
                (codes::urdf::HIDDEN_CHARACTER, format!("it has an invisible character: {hidden}"))
            }),
            AttributeValue::Numbers(count) => {
                number::fault(value, count).map(|fault| (codes::urdf::NUMBER, fault))
            }
            AttributeValue::Word(words) => (!words.contains(&value))
                .then(|| (codes::urdf::UNKNOWN_TYPE, known_names(value, "types", words.iter().copied()))),
        };
        let part = self.part.inner(known.needed, vec![attribute.range()]);
        if let Some((code, fault)) = fault {
            let what = match known.value {
                AttributeValue::Word(_) => format!("unknown {} \"{value}\"; {fault}", known.name),
                _ => format!("<{}> {} = \"{value}\": {fault}", rules.name, known.name),
            };
            self.report_in(&part, Diagnostic::error(code, what), attribute.range());
        } else if known.name == "quat_xyzw" && self.version < (1, 1) {
            let what = "unknown attribute \"quat_xyzw\": it needs <robot version=\"1.1\">";
            self.report(codes::urdf::QUATERNION, what, attribute.range());
        } else if RATES.contains(&known.name) && self.version < (1, 2) {
            let what = format!("<limit> {} is not read: it needs <robot version=\"1.2\">", known.name);
            self.report_in(&part, Diagnostic::error(codes::urdf::VERSION, what), attribute.range());
        }
    }

    fn unknown_attribute(&mut self, rules: &Element, attribute: &XmlAttribute<'_, '_>) {
        let name = attribute.name();
        if let Some(meant) = misspelt(name, rules.attributes, |known| known.name) {
            let what =
                format!("<{}>: unknown attribute \"{name}\" (did you mean \"{}\"?)", rules.name, meant.name);
            let part = self.part.inner(meant.needed, vec![attribute.range()]);
            self.report_in(&part, Diagnostic::error(codes::urdf::UNKNOWN_ATTRIBUTE, what), attribute.range());
        }
    }

    fn unknown_children(&mut self, parent: Node<'_, '_>, rules: &Element) {
        let known = || rules.children.iter().map(|child| child.element.name);
        for node in parent.children().filter(Node::is_element) {
            let name = node.tag_name().name();
            if node.tag_name().namespace().is_some() || known().any(|known| known == name) {
                continue;
            }
            if let Some(meant) = misspelt(name, rules.children, |child| child.element.name) {
                let what = format!("unknown element <{name}> (did you mean <{}>?)", meant.element.name);
                let part = self.part.inner(meant.element.needed, vec![node.range()]);
                self.report_in(&part, Diagnostic::error(codes::urdf::UNKNOWN_ELEMENT, what), tag(node));
            } else if rules.is_choice {
                let what = format!(
                    "unknown shape <{name}>; {}",
                    known_names(name, "shapes", known().collect::<Vec<_>>())
                );
                self.report(codes::urdf::GEOMETRY, &what, tag(node));
            }
        }
    }

    /// Names become file names, entity paths and table cells: unusual ones are legal but get a warning.
    fn name(&mut self, node: Node<'_, '_>) {
        let name = node.attribute("name").unwrap_or_default();
        let length = name.chars().count();
        let what = if length > LONGEST_NAME {
            format!("its name is {length} characters long (limit {LONGEST_NAME})")
        } else if name.contains("../") {
            "its name contains \"../\", which is escaped in every output".to_owned()
        } else {
            return;
        };
        self.diagnostics
            .push(Diagnostic::warning(codes::urdf::NAME, format!("{}: {what}", self.owner)).at(tag(node)));
    }
}
