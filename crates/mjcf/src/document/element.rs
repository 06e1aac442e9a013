//! An element of an MJCF and its attributes, each with its file and place. They outlive the parsed texts, because elements
//! of several files form one tree.

use std::{ops::Range, sync::Arc};

use congruent_input::{Code, Diagnostic, SourceFile, visible};

use crate::model::MjPlace;

/// An attribute as it is written.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MjAttribute {
    pub(crate) key: String,
    pub(crate) value: String,
    /// Byte range of the value, between its quotes.
    pub(crate) span: Range<usize>,
    pub(crate) source: Arc<SourceFile>,
}

impl MjAttribute {
    /// An error at the value.
    pub(crate) fn fault(&self, code: &'static Code, message: impl Into<String>) -> Diagnostic {
        Diagnostic::error(code, message).at(self.span.clone()).in_file(&self.source)
    }

    /// The place of the value; `class` is the class of defaults that states it.
    pub(crate) fn place(&self, class: Option<&str>) -> MjPlace {
        MjPlace {
            source: Arc::clone(&self.source),
            span: self.span.clone(),
            key: self.key.clone(),
            class: class.map(str::to_owned),
        }
    }
}

/// An element with all that is in it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MjElement {
    pub(crate) tag: String,
    /// Byte range of the opening of its tag, `<name`.
    pub(crate) span: Range<usize>,
    pub(crate) attributes: Vec<Arc<MjAttribute>>,
    pub(crate) children: Vec<MjElement>,
    pub(crate) source: Arc<SourceFile>,
}

impl MjElement {
    /// The attribute as it is written in this element itself.
    pub(crate) fn attribute(&self, key: &str) -> Option<&Arc<MjAttribute>> {
        self.attributes.iter().find(|attribute| attribute.key == key)
    }

    /// The text of an attribute; `None` if it is missing or empty.
    pub(crate) fn text(&self, key: &str) -> Option<&str> {
        self.attribute(key).map(|attribute| attribute.value.as_str()).filter(|value| !value.is_empty())
    }

    /// The name, unless it is empty, which MuJoCo takes for no name.
    pub(crate) fn name(&self) -> Option<&str> {
        self.text("name")
    }

    /// The children with this tag, in file order.
    pub(crate) fn all<'a>(&'a self, tag: &'a str) -> impl Iterator<Item = &'a Self> {
        self.children.iter().filter(move |child| child.tag == tag)
    }

    /// The children of all sections with this tag: `<worldbody>` and others may be repeated.
    pub(crate) fn in_sections<'a>(&'a self, section: &'a str) -> impl Iterator<Item = &'a Self> {
        self.all(section).flat_map(|section| &section.children)
    }

    /// An error at the opening of the tag.
    pub(crate) fn fault(&self, code: &'static Code, message: impl Into<String>) -> Diagnostic {
        Diagnostic::error(code, message).at(self.span.clone()).in_file(&self.source)
    }

    /// A warning at the opening of the tag.
    pub(crate) fn warning(&self, code: &'static Code, message: impl Into<String>) -> Diagnostic {
        Diagnostic::warning(code, message).at(self.span.clone()).in_file(&self.source)
    }

    /// An error at an attribute, or at the tag if the attribute is not in this element.
    pub(crate) fn fault_at(&self, key: &str, code: &'static Code, message: impl Into<String>) -> Diagnostic {
        match self.attribute(key) {
            Some(attribute) => attribute.fault(code, message),
            None => self.fault(code, message),
        }
    }

    /// The place of the tag.
    pub(crate) fn place(&self) -> MjPlace {
        MjPlace {
            source: Arc::clone(&self.source),
            span: self.span.clone(),
            key: self.tag.clone(),
            class: None,
        }
    }

    /// `body "forearm"`, or `<body>` without a name; the name is cut if it is longer than a line.
    pub(crate) fn label(&self) -> String {
        const SHOWN: usize = 60;
        let Some(name) = self.name() else { return format!("<{}>", self.tag) };
        let short: String = name.chars().take(SHOWN).collect();
        let dots = if short.len() < name.len() { "..." } else { "" };
        format!("{} \"{}{dots}\"", self.tag, visible(&short))
    }
}
