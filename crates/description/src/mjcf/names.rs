//! Names of links and joints: those of the file, and new ones for the links and joints that a robot needs in addition.

use std::collections::BTreeSet;

use congruent_mjcf::MjName;

/// The names that are taken.
pub(super) struct TakenNames(BTreeSet<String>);

impl TakenNames {
    /// The names that the file states come first: none of them is changed for a name that is made here.
    pub(super) fn of_file<'a>(names: impl Iterator<Item = &'a MjName>) -> Self {
        Self(names.filter(|name| name.is_written).map(|name| name.text.clone()).collect())
    }

    /// The name of the file, or the one that the reader made for what has none.
    pub(super) fn take(&mut self, name: &MjName) -> String {
        if name.is_written { name.text.clone() } else { self.make(name.text.clone()) }
    }

    /// A name that no other has: the wanted one, with a number after it if that is taken.
    pub(super) fn make(&mut self, wanted: String) -> String {
        let numbered = (2..).map(|number| format!("{wanted} ({number})"));
        let free = std::iter::once(wanted.clone()).chain(numbered).find(|name| !self.0.contains(name));
        let name = free.unwrap_or(wanted);
        self.0.insert(name.clone());
        name
    }

    pub(super) fn has(&self, name: &str) -> bool {
        self.0.contains(name)
    }
}
