//! Where joints and links of a URDF stand: for messages about one of them.

use std::{ops::Range, sync::Arc};

use super::node::{last, place};
use crate::{diagnostic::SourceFile, xml};

/// The text of a URDF, in which joints and links are found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UrdfPlaces {
    source: Arc<SourceFile>,
}

impl UrdfPlaces {
    /// Of a text that has been read; it is parsed again when a place is asked for, which is seldom.
    pub(crate) fn new(source: Arc<SourceFile>) -> Self {
        Self { source }
    }

    /// The file.
    pub fn source(&self) -> &Arc<SourceFile> {
        &self.source
    }

    /// Place of the `<origin>` of a joint, or of the joint if it has none; `None` if there is no joint of
    /// that name.
    pub fn joint_origin(&self, name: &str) -> Option<Range<usize>> {
        let document = xml::parse(&self.source.text).ok()?;
        Some(place(last(document.root_element(), "joint", name)?, "origin"))
    }

    /// Place of the `<dynamics>` of a joint, or of the joint if it has none.
    pub fn joint_dynamics(&self, name: &str) -> Option<Range<usize>> {
        let document = xml::parse(&self.source.text).ok()?;
        Some(place(last(document.root_element(), "joint", name)?, "dynamics"))
    }

    /// Place of the `<inertial>` of a link, or of the link if it has none.
    pub fn link_inertial(&self, name: &str) -> Option<Range<usize>> {
        let document = xml::parse(&self.source.text).ok()?;
        Some(place(last(document.root_element(), "link", name)?, "inertial"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_place_of_a_joint_is_that_of_its_origin() {
        let text =
            "<robot name='two'>\n<joint name='a'>\n<origin xyz='1 0 0'/></joint>\n<joint name='b'/></robot>";
        let source = SourceFile { path: "two.urdf".into(), text: text.to_owned() };
        let places = UrdfPlaces::new(Arc::new(source));
        let at = |name| places.joint_origin(name).map(|span| &text[span]);
        assert_eq!(at("a"), Some("<origin"));
        assert_eq!(at("b"), Some("<joint"));
        assert_eq!(at("c"), None);
    }

    #[test]
    fn the_place_of_a_link_is_that_of_its_inertial() {
        let text = "<robot name='two'>\n<link name='a'>\n<inertial/></link>\n<link name='b'/>\n\
            <joint name='j'><dynamics damping='1'/></joint></robot>";
        let source = SourceFile { path: "two.urdf".into(), text: text.to_owned() };
        let places = UrdfPlaces::new(Arc::new(source));
        let at = |name| places.link_inertial(name).map(|span| &text[span]);
        assert_eq!(at("a"), Some("<inertial"));
        assert_eq!(at("b"), Some("<link"));
        assert_eq!(at("j"), None);
        assert_eq!(places.joint_dynamics("j").map(|span| &text[span]), Some("<dynamics"));
    }
}
