//! The names that a file gives the joints and links of a robot which has been rewritten: in other variables, or with links joined.

use std::{collections::BTreeMap, sync::Arc};

/// Names in the file by those under which they are asked for, where these differ.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct WrittenNames {
    joints: Arc<BTreeMap<String, String>>,
    /// `None` for a link whose values are those of no element of the file.
    links: Arc<BTreeMap<String, Option<String>>>,
    is_rewritten: bool,
}

impl WrittenNames {
    /// The names of a robot that has been rewritten in other variables: those in the file by those that it has.
    #[must_use]
    pub fn rewritten(self, joints: BTreeMap<String, String>, links: BTreeMap<String, String>) -> Self {
        let links = links.into_iter().map(|(name, written)| {
            let known = self.links.get(&written).cloned();
            (name, known.unwrap_or(Some(written)))
        });
        Self { joints: joints.into(), links: Arc::new(links.collect()), is_rewritten: true }
    }

    /// The same without these links.
    #[must_use]
    pub fn without_links<'a>(mut self, links: impl Iterator<Item = &'a String>) -> Self {
        Arc::make_mut(&mut self.links).extend(links.map(|link| (link.clone(), None)));
        self
    }

    /// Whether the robot has been rewritten in other variables: values of its joints are not those that the file writes.
    pub fn is_rewritten(&self) -> bool {
        self.is_rewritten
    }

    /// The name of a joint in the file.
    pub fn joint<'a>(&'a self, name: &'a str) -> &'a str {
        self.joints.get(name).map_or(name, String::as_str)
    }

    /// The name of a link in the file; `None` if its values are those of no element of the file.
    pub fn link<'a>(&'a self, name: &'a str) -> Option<&'a str> {
        self.links.get(name).map_or(Some(name), |written| written.as_deref())
    }
}
