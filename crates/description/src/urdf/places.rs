//! Where the joints of a URDF stand: for messages that blame one.

use std::{ops::Range, path::Path, sync::Arc};

use super::{
    URDF_BYTES,
    node::{last, place},
};
use crate::{diagnostic::SourceFile, file::read_text, xml};

/// A URDF's text, in which joints are found.
#[derive(Debug, Clone)]
pub struct UrdfPlaces {
    source: Arc<SourceFile>,
}

impl UrdfPlaces {
    /// Reads the file again; `None` where it cannot be read any more.
    pub fn read(path: &Path) -> Option<Self> {
        Some(Self { source: read_text(path, URDF_BYTES).ok()? })
    }

    /// The file.
    pub fn source(&self) -> &Arc<SourceFile> {
        &self.source
    }

    /// The origin of a joint, or the joint itself where it is left out; `None` where there is none of
    /// that name.
    pub fn joint_origin(&self, name: &str) -> Option<Range<usize>> {
        let document = xml::parse(&self.source.text).ok()?;
        Some(place(last(document.root_element(), "joint", name)?, "origin"))
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn a_joint_stands_where_its_origin_does() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("two.urdf");
        let text =
            "<robot name='two'>\n<joint name='a'>\n<origin xyz='1 0 0'/></joint>\n<joint name='b'/></robot>";
        fs::write(&path, text).unwrap();
        let places = UrdfPlaces::read(&path).unwrap();
        let at = |name| places.joint_origin(name).map(|span| &text[span]);
        assert_eq!(at("a"), Some("<origin"));
        assert_eq!(at("b"), Some("<joint"));
        assert_eq!(at("c"), None);
    }
}
