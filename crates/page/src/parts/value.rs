//! A value as people read it, with the exact value of the JSON report and its place there beside it.

use std::fmt;

use maud::{Markup, Render, html};

/// A place in the JSON report, RFC 6901.
#[derive(Debug, Clone, Default)]
pub(crate) struct Pointer(String);

impl Pointer {
    /// The pointer to the whole document, the empty string.
    pub(crate) fn root() -> Self {
        Self::default()
    }

    /// A member of it, or an entry by its index.
    pub(crate) fn key(&self, key: impl fmt::Display) -> Self {
        let key = key.to_string().replace('~', "~0").replace('/', "~1");
        Self(format!("{}/{key}", self.0))
    }

    /// Several members, one in the other.
    pub(crate) fn keys(&self, keys: &[&str]) -> Self {
        keys.iter().fold(self.clone(), |pointer, key| pointer.key(key))
    }
}

impl Render for Pointer {
    fn render_to(&self, buffer: &mut String) {
        self.0.render_to(buffer);
    }
}

/// A value of the report at its place, with the text that people read.
pub(crate) fn value(at: &Pointer, exact: f64, shown: &str) -> Markup {
    html! { data data-path=(at) value=(format!("{exact:?}")) { (shown) } }
}

/// A whole number of the report at its place.
pub(crate) fn count(at: &Pointer, exact: impl fmt::Display) -> Markup {
    html! { data data-path=(at) value=(exact) { (exact) } }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_pointers_and_values_exact() {
        let at = Pointer::root().key("joints").key("a/b~c").key(3);
        let shown = value(&at, 0.1 + 0.2, "300 mm <b>").into_string();
        assert_eq!(
            shown,
            "<data data-path=\"/joints/a~1b~0c/3\" value=\"0.30000000000000004\">300 mm &lt;b&gt;</data>"
        );
    }
}
