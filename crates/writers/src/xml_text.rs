//! XML as it is written: elements, one a line, indented by their depth.

use std::fmt::Write;

use congruent_input::number::{number, numbers};

/// Attributes of an element, in their order.
#[derive(Debug, Default)]
pub(crate) struct Attributes(String);

impl Attributes {
    pub(crate) fn text(mut self, key: &str, value: &str) -> Self {
        let _ = write!(self.0, " {key}=\"{}\"", escaped(value));
        self
    }

    /// A number in its shortest form that reads back as the same.
    pub(crate) fn number(self, key: &str, value: f64) -> Self {
        let value = number(value);
        self.text(key, &value)
    }

    pub(crate) fn numbers(self, key: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let values = numbers(values, " ");
        self.text(key, &values)
    }

    /// The attribute only if there is a value.
    pub(crate) fn optional(self, key: &str, value: Option<f64>) -> Self {
        match value {
            Some(value) => self.number(key, value),
            None => self,
        }
    }
}

/// A document that grows from its beginning.
#[derive(Debug)]
pub(crate) struct XmlText {
    text: String,
    open: Vec<&'static str>,
}

impl XmlText {
    pub(crate) fn new() -> Self {
        Self { text: "<?xml version=\"1.0\"?>\n".to_owned(), open: Vec::new() }
    }

    /// An element without children.
    pub(crate) fn element(&mut self, tag: &str, Attributes(attributes): Attributes) {
        self.line(&format!("<{tag}{attributes}/>"));
    }

    /// The beginning of an element whose children follow.
    pub(crate) fn begin(&mut self, tag: &'static str, Attributes(attributes): Attributes) {
        self.line(&format!("<{tag}{attributes}>"));
        self.open.push(tag);
    }

    /// The end of the element that was begun last.
    pub(crate) fn end(&mut self) {
        if let Some(tag) = self.open.pop() {
            self.line(&format!("</{tag}>"));
        }
    }

    /// The whole text; what is open is ended.
    pub(crate) fn finish(mut self) -> String {
        while !self.open.is_empty() {
            self.end();
        }
        self.text
    }

    fn line(&mut self, line: &str) {
        let _ = writeln!(self.text, "{:1$}{line}", "", 2 * self.open.len());
    }
}

/// A value of an attribute. White space other than blanks would be read as a blank.
fn escaped(value: &str) -> String {
    let mut text = String::with_capacity(value.len());
    for character in value.chars() {
        match character {
            '&' => text.push_str("&amp;"),
            '<' => text.push_str("&lt;"),
            '>' => text.push_str("&gt;"),
            '"' => text.push_str("&quot;"),
            '\t' | '\n' | '\r' => {
                let _ = write!(text, "&#{};", u32::from(character));
            }
            other => text.push(other),
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_escaped_and_numbers_keep_their_bits() {
        let mut text = XmlText::new();
        text.begin("robot", Attributes::default().text("name", "a<b> & \"c\"\n"));
        text.element("mass", Attributes::default().number("value", 0.1 + 0.2).optional("none", None));
        let expected = "<?xml version=\"1.0\"?>\n<robot name=\"a&lt;b&gt; &amp; &quot;c&quot;&#10;\">\n  \
                        <mass value=\"0.30000000000000004\"/>\n</robot>\n";
        assert_eq!(text.finish(), expected);
    }
}
