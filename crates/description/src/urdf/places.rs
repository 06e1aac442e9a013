//! Byte ranges of joints and links in the text of a URDF, for messages about one of them.

use std::{ops::Range, sync::Arc};

use congruent_input::{SourceFile, line_column, xml};
use roxmltree::{Document, Node};

use super::{
    digits::JointDigits,
    node::{element, elements, last, place, tag},
};
use congruent_robot::WrittenNames;

/// The text of a URDF, in which joints and links are found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UrdfPlaces {
    source: Arc<SourceFile>,
    names: WrittenNames,
}

impl UrdfPlaces {
    /// `source` must have been read before. It is parsed again for each place, since places are needed only for messages.
    pub(crate) fn new(source: Arc<SourceFile>) -> Self {
        Self { source, names: WrittenNames::default() }
    }

    /// The same of a robot whose joints and links have other names than in the file, or are those of no element there.
    #[must_use]
    pub(crate) fn with_names(self, change: impl FnOnce(WrittenNames) -> WrittenNames) -> Self {
        Self { names: change(self.names), ..self }
    }

    /// Whether the robot has been rewritten in other variables: values of its joints are not those that the file writes.
    pub fn is_rewritten(&self) -> bool {
        self.names.is_rewritten()
    }

    /// The element of a joint.
    pub(super) fn joint<'a, 'i>(&self, document: &'a Document<'i>, name: &str) -> Option<Node<'a, 'i>> {
        last(document.root_element(), "joint", self.names.joint(name))
    }

    /// The element of a link.
    pub(super) fn link<'a, 'i>(&self, document: &'a Document<'i>, name: &str) -> Option<Node<'a, 'i>> {
        last(document.root_element(), "link", self.names.link(name)?)
    }

    /// The URDF that the places are in.
    pub fn source(&self) -> &Arc<SourceFile> {
        &self.source
    }

    /// The same, to name its file in another form.
    pub(crate) fn source_mut(&mut self) -> &mut Arc<SourceFile> {
        &mut self.source
    }

    /// The names of all joints in the order of the file.
    pub fn joint_order(&self) -> Vec<String> {
        let Ok(document) = xml::parse(&self.source.text) else { return Vec::new() };
        let names = elements(document.root_element(), "joint").filter_map(|joint| joint.attribute("name"));
        names.map(str::to_owned).collect()
    }

    /// Place of the `<origin>` of a joint, or of the joint if it has none; `None` if there is no joint of
    /// that name.
    pub fn joint_origin(&self, name: &str) -> Option<Range<usize>> {
        let document = xml::parse(&self.source.text).ok()?;
        Some(place(self.joint(&document, name)?, "origin"))
    }

    /// The `rpy` of a joint's `<origin>` as the file writes it, and its line from 1; `None` if it has none.
    pub fn joint_rpy(&self, name: &str) -> Option<(String, usize)> {
        if self.names.is_rewritten() {
            return None;
        }
        let document = xml::parse(&self.source.text).ok()?;
        let origin = element(self.joint(&document, name)?, "origin")?;
        let rpy = origin.attributes().find(|attribute| attribute.name() == "rpy")?;
        Some((rpy.value().to_owned(), line_column(&self.source.text, rpy.range().start).0))
    }

    /// The digits of these joints; whole components of an axis are exact, and so is what is not written.
    pub fn joint_digits(&self, names: &[&str]) -> Vec<JointDigits> {
        let Ok(document) = xml::parse(&self.source.text) else {
            return vec![JointDigits::default(); names.len()];
        };
        let joints: Vec<_> = names.iter().map(|name| self.joint(&document, name)).collect();
        JointDigits::read(&joints)
    }

    /// Place of the `<axis>` of a joint, or of the joint if it has none.
    pub fn joint_axis(&self, name: &str) -> Option<Range<usize>> {
        let document = xml::parse(&self.source.text).ok()?;
        Some(place(self.joint(&document, name)?, "axis"))
    }

    /// An attribute of a part of a joint, such as `xyz` of its `origin`, as the file writes it; `None` if it has none.
    pub fn joint_attribute(&self, name: &str, part: &str, attribute: &str) -> Option<String> {
        if self.names.is_rewritten() {
            return None;
        }
        let document = xml::parse(&self.source.text).ok()?;
        let part = element(self.joint(&document, name)?, part)?;
        part.attribute(attribute).map(|written| written.split_whitespace().collect::<Vec<_>>().join(" "))
    }

    /// Place of the `<dynamics>` of a joint, or of the joint if it has none.
    pub fn joint_dynamics(&self, name: &str) -> Option<Range<usize>> {
        let document = xml::parse(&self.source.text).ok()?;
        Some(place(self.joint(&document, name)?, "dynamics"))
    }

    /// Whether a joint has a `<dynamics>`: if not, the file says nothing about its damping and dry friction.
    pub fn has_joint_dynamics(&self, name: &str) -> bool {
        let document = xml::parse(&self.source.text).ok();
        document.is_some_and(|document| {
            self.joint(&document, name).and_then(|of| element(of, "dynamics")).is_some()
        })
    }

    /// Place of the `<mimic>` of a joint, or of the joint if it has none.
    pub fn joint_mimic(&self, name: &str) -> Option<Range<usize>> {
        let document = xml::parse(&self.source.text).ok()?;
        Some(place(self.joint(&document, name)?, "mimic"))
    }

    /// Place of a part of the `<inertial>` of a link: `mass`, `origin` or `inertia`; of the `<inertial>` if that is
    /// missing, or of the link if it has none.
    pub fn inertial_part(&self, link: &str, part: &str) -> Option<Range<usize>> {
        let document = xml::parse(&self.source.text).ok()?;
        let link = self.link(&document, link)?;
        Some(element(link, "inertial").map_or_else(|| tag(link), |inertial| place(inertial, part)))
    }

    /// Whether a link has an `<inertial>`, readable or not.
    pub fn has_inertial(&self, link: &str) -> bool {
        let document = xml::parse(&self.source.text).ok();
        document.is_some_and(|document| {
            self.link(&document, link).and_then(|link| element(link, "inertial")).is_some()
        })
    }

    /// A link and the joint that carries it, as the file writes them; `None` if there is no such link.
    pub fn link_with_its_joint(&self, link: &str) -> Option<String> {
        let text = &self.source.text;
        let document = xml::parse(text).ok()?;
        let root = document.root_element();
        let node = self.link(&document, link)?;
        let carries = |joint: &roxmltree::Node<'_, '_>| {
            element(*joint, "child").and_then(|child| child.attribute("link")) == node.attribute("name")
        };
        let joint = elements(root, "joint").find(carries);
        let nodes = std::iter::once(node).chain(joint);
        Some(nodes.map(|node| text[node.range()].to_owned()).collect::<Vec<_>>().join("\n  "))
    }

    /// Place of the `<limit>` of a joint, or of the joint if it has none.
    pub fn joint_limit(&self, name: &str) -> Option<Range<usize>> {
        let document = xml::parse(&self.source.text).ok()?;
        Some(place(self.joint(&document, name)?, "limit"))
    }

    /// Place of the `<inertial>` of a link, or of the link if it has none.
    pub fn link_inertial(&self, name: &str) -> Option<Range<usize>> {
        let document = xml::parse(&self.source.text).ok()?;
        Some(place(self.link(&document, name)?, "inertial"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rpy_of_a_joint_is_shown_as_it_is_written() {
        let text = "<robot name='two'>\n<joint name='a'>\n<origin xyz='1 0 0'\n rpy='1.5708 0 0'/></joint>\n\
                    <joint name='b'><origin xyz='0 0 0'/></joint></robot>";
        let source = SourceFile { path: "two.urdf".into(), text: text.to_owned(), is_foreign: false };
        let places = UrdfPlaces::new(Arc::new(source));
        assert_eq!(places.joint_rpy("a"), Some(("1.5708 0 0".to_owned(), 4)));
        assert_eq!([places.joint_rpy("b"), places.joint_rpy("c")], [None, None]);
    }

    #[test]
    fn a_link_is_shown_with_its_joint() {
        let text = "<robot name='two'><link name='a'/><link name='b'>\n</link>\n\
            <joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint></robot>";
        let source = SourceFile { path: "two.urdf".into(), text: text.to_owned(), is_foreign: false };
        let places = UrdfPlaces::new(Arc::new(source));
        let with_joint = "<link name='b'>\n</link>\n  \
            <joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>";
        assert_eq!(places.link_with_its_joint("b").as_deref(), Some(with_joint));
        assert_eq!(places.link_with_its_joint("a").as_deref(), Some("<link name='a'/>"));
        assert_eq!(places.link_with_its_joint("j"), None);
        assert!(!places.has_joint_dynamics("j"));
    }

    #[test]
    fn the_place_of_a_joint_is_that_of_its_origin() {
        let text =
            "<robot name='two'>\n<joint name='a'>\n<origin xyz='1 0 0'/></joint>\n<joint name='b'/></robot>";
        let source = SourceFile { path: "two.urdf".into(), text: text.to_owned(), is_foreign: false };
        let places = UrdfPlaces::new(Arc::new(source));
        let at = |name| places.joint_origin(name).map(|span| &text[span]);
        assert_eq!(at("a"), Some("<origin"));
        assert_eq!(at("b"), Some("<joint"));
        assert_eq!(at("c"), None);
        assert_eq!(places.joint_axis("a").map(|span| &text[span]), Some("<joint"));
    }

    #[test]
    fn the_place_of_a_link_is_that_of_its_inertial() {
        let text = "<robot name='two'>\n<link name='a'>\n<inertial/></link>\n<link name='b'/>\n\
            <joint name='j'><dynamics damping='1'/></joint></robot>";
        let source = SourceFile { path: "two.urdf".into(), text: text.to_owned(), is_foreign: false };
        let places = UrdfPlaces::new(Arc::new(source));
        let at = |name| places.link_inertial(name).map(|span| &text[span]);
        assert_eq!(at("a"), Some("<inertial"));
        assert_eq!(at("b"), Some("<link"));
        assert_eq!(at("j"), None);
        assert_eq!(places.inertial_part("a", "mass").map(|span| &text[span]), Some("<inertial"));
        assert_eq!(places.inertial_part("b", "mass").map(|span| &text[span]), Some("<link"));
        assert_eq!(places.joint_limit("j").map(|span| &text[span]), Some("<joint"));
        assert_eq!(places.joint_dynamics("j").map(|span| &text[span]), Some("<dynamics"));
    }
}
