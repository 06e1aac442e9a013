//! Attributes of an element with the defaults of its class: its own first, then those of the class.

use std::array;

use crate::{
    defaults::MjClass,
    document::{MjAttribute, MjElement},
    grammar::numbers,
    model::{MjPlace, MjWritten},
};

/// An element and the class that its defaults come from.
#[derive(Clone, Copy)]
pub(crate) struct MjAttributes<'a> {
    pub(crate) element: &'a MjElement,
    class: Option<&'a MjClass>,
    /// The element of the class: equalities of all kinds share one, and so do tendons.
    tag: &'a str,
}

/// An attribute that was found, and the class that states it if the element does not.
#[derive(Clone, Copy)]
pub(crate) struct MjFound<'a> {
    pub(crate) attribute: &'a MjAttribute,
    class: Option<&'a str>,
}

impl MjFound<'_> {
    pub(crate) fn place(&self) -> MjPlace {
        self.attribute.place(self.class)
    }

    pub(crate) fn numbers(&self) -> Vec<f64> {
        numbers(&self.attribute.value)
    }

    /// The numbers with the place; those that are left out are taken from `default`.
    pub(crate) fn array<const N: usize>(&self, default: [f64; N]) -> MjWritten<[f64; N]> {
        let given = self.numbers();
        let value = array::from_fn(|index| given.get(index).copied().unwrap_or(default[index]));
        MjWritten { value, place: Some(self.place()) }
    }
}

impl<'a> MjAttributes<'a> {
    /// An element whose kind has no defaults.
    pub(crate) fn own(element: &'a MjElement) -> Self {
        Self { element, class: None, tag: &element.tag }
    }

    /// An element whose defaults are those of the same element of the class.
    pub(crate) fn with_class(element: &'a MjElement, class: &'a MjClass) -> Self {
        Self { element, class: Some(class), tag: &element.tag }
    }

    /// The same with the defaults of another element of the class.
    pub(crate) fn of_kind(self, tag: &'a str) -> Self {
        Self { tag, ..self }
    }

    /// The attribute if it is given and not empty.
    pub(crate) fn find(&self, key: &str) -> Option<MjFound<'a>> {
        let own = self.element.attribute(key).filter(|attribute| !attribute.value.trim().is_empty());
        if let Some(attribute) = own {
            return Some(MjFound { attribute, class: None });
        }
        let inherited = self.class?.attribute(self.tag, key)?;
        Some(MjFound { attribute: &inherited.attribute, class: Some(&inherited.class) })
    }

    /// The text of an attribute.
    pub(crate) fn text(&self, key: &str) -> Option<&'a str> {
        self.find(key).map(|found| found.attribute.value.as_str())
    }

    /// Whether a keyword is "true".
    pub(crate) fn is_true(&self, key: &str) -> bool {
        self.text(key) == Some("true")
    }

    /// Numbers with their place, or MuJoCo's default.
    pub(crate) fn array<const N: usize>(&self, key: &str, default: [f64; N]) -> MjWritten<[f64; N]> {
        self.find(key).map_or(MjWritten::unwritten(default), |found| found.array(default))
    }

    /// A number with its place, or MuJoCo's default.
    pub(crate) fn number(&self, key: &str, default: f64) -> MjWritten<f64> {
        self.array(key, [default]).map(|[value]| value)
    }

    /// An integer, or MuJoCo's default.
    pub(crate) fn integer(&self, key: &str, default: i32) -> i32 {
        self.text(key).and_then(|text| text.trim().parse().ok()).unwrap_or(default)
    }
}
