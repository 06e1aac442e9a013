//! Names: which are taken, and which elements a reference means. A replicated element has several copies under one name of
//! the file, distinguished by the number of the replica.

use std::collections::BTreeMap;

use congruent_input::{Diagnostic, known_names};

use crate::{codes, document::MjElement, model::MjPlace};

/// More names are not compared with an unknown one. Kind: choice; a person reads fewer.
const MOST_COMPARED: usize = 1_000;

/// Kinds of elements; each has names of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum MjNamed {
    Body,
    Joint,
    Geom,
    Site,
    Frame,
    Mesh,
    Actuator,
    Equality,
    Tendon,
    Keyframe,
}

impl MjNamed {
    /// The word of messages, and its plural.
    fn words(self) -> [&'static str; 2] {
        match self {
            Self::Body => ["body", "bodies"],
            Self::Joint => ["joint", "joints"],
            Self::Geom => ["geom", "geoms"],
            Self::Site => ["site", "sites"],
            Self::Frame => ["frame", "frames"],
            Self::Mesh => ["mesh", "meshes"],
            Self::Actuator => ["actuator", "actuators"],
            Self::Equality => ["equality", "equalities"],
            Self::Tendon => ["tendon", "tendons"],
            Self::Keyframe => ["keyframe", "keyframes"],
        }
    }
}

/// A copy of a named element: the number of its replica, empty without one, and its index.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct MjCopy {
    pub(super) replica: String,
    pub(super) index: usize,
}

/// The names so far.
#[derive(Debug, Default)]
pub(super) struct MjNames {
    taken: BTreeMap<(MjNamed, String), MjPlace>,
    /// Copies by attachment, kind and name in the file of that attachment.
    copies: BTreeMap<(usize, MjNamed, String), Vec<MjCopy>>,
}

impl MjNames {
    /// Takes a full name.
    pub(super) fn take(&mut self, kind: MjNamed, name: &str, element: &MjElement) -> Result<(), Diagnostic> {
        let key = (kind, name.to_owned());
        let [word, plural] = kind.words();
        if kind == MjNamed::Body && name == "world" {
            let message = "a body is called \"world\", which is the name of the world itself";
            return Err(element.fault_at("name", codes::mjcf::NAME, message).with_help("rename it"));
        }
        if let Some(first) = self.taken.get(&key) {
            let message = format!("two {plural} are called \"{name}\"");
            let fault = element.fault_at("name", codes::mjcf::NAME, message);
            return Err(if first.source == element.source {
                fault.related_to(first.span.clone(), format!("the first {word} of this name"))
            } else {
                fault
                    .with_help(format!("the first {word} of this name is in {}", first.source.path.display()))
            });
        }
        self.taken.insert(key, element.place());
        Ok(())
    }

    /// Notes a copy, so that references find it.
    pub(super) fn add(&mut self, attachment: usize, kind: MjNamed, name: &str, copy: MjCopy) {
        self.copies.entry((attachment, kind, name.to_owned())).or_default().push(copy);
    }

    /// The copies that a name of a file means.
    pub(super) fn copies(&self, attachment: usize, kind: MjNamed, name: &str) -> &[MjCopy] {
        self.copies.get(&(attachment, kind, name.to_owned())).map_or(&[], Vec::as_slice)
    }

    /// The fault of a name that means nothing.
    pub(super) fn unknown(
        &self,
        attachment: usize,
        kind: MjNamed,
        key: &str,
        element: &MjElement,
    ) -> Diagnostic {
        let name = element.text(key).unwrap_or_default();
        let [word, plural] = kind.words();
        let all = self.copies.range((attachment, kind, String::new())..);
        let known = all.take_while(|((at, of, _), _)| (*at, *of) == (attachment, kind));
        let known: Vec<&str> = known.map(|((_, _, name), _)| name.as_str()).take(MOST_COMPARED).collect();
        let help = if known.is_empty() {
            format!("the model has no {word} with a name")
        } else {
            known_names(name, plural, known)
        };
        let message = format!("{}: there is no {word} \"{name}\"", element.label());
        element.fault_at(key, codes::mjcf::UNKNOWN_NAME, message).with_help(help)
    }
}
