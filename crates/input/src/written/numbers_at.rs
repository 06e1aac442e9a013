//! The numbers that a key of a TOML file names: one, or those of a list or table.

use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

use super::overrides::Override;
use crate::diagnostic::Diagnostic;

/// A number with its key.
#[derive(Debug, Clone, PartialEq)]
pub struct NumberAt {
    /// The key, joined by dots, as of --set.
    pub key: String,
    /// The number.
    pub value: f64,
}

impl Override {
    /// The numbers of a document under its key: one, or each of a list or table with a key of its own. Empty if there is no such key.
    ///
    /// # Errors
    /// The path goes to an entry that a list does not have, or the key has something else than numbers.
    pub fn numbers_in(&self, document: &Spanned<DeTable<'_>>) -> Result<Vec<NumberAt>, Diagnostic> {
        let Some(found) = self.find(document)? else { return Ok(Vec::new()) };
        let key: Vec<&str> = self.path().collect();
        let mut numbers = Vec::new();
        if add_numbers(&key.join("."), found.get_ref(), &mut numbers) {
            Ok(numbers)
        } else {
            Err(self.refused("the value is neither a number nor a list or table of numbers"))
        }
    }
}

/// Whether all of it is numbers.
fn add_numbers(key: &str, value: &DeValue<'_>, numbers: &mut Vec<NumberAt>) -> bool {
    let mut inner = |name: &str, value: &Spanned<DeValue<'_>>| {
        add_numbers(&format!("{key}.{name}"), value.get_ref(), numbers)
    };
    let text = match value {
        DeValue::Array(items) => {
            return !items.is_empty()
                && (1..).zip(items).all(|(number, item): (usize, _)| inner(&number.to_string(), item));
        }
        DeValue::Table(table) => {
            return !table.is_empty() && table.iter().all(|(name, item)| inner(name.get_ref(), item));
        }
        DeValue::Float(number) => number.as_str(),
        DeValue::Integer(number) if number.radix() == 10 => number.as_str(),
        _ => return false,
    };
    let Some(value) = text.replace('_', "").parse().ok().filter(|value: &f64| value.is_finite()) else {
        return false;
    };
    numbers.push(NumberAt { key: key.to_owned(), value });
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::toml_text::parse_document;

    #[test]
    fn a_number_a_list_and_a_table() {
        let text = "a = 1_000\nb = [0.5, 2]\nc = { x = 1e-3 }\n[[o]]\nname = \"wall\"\nz = 3.0";
        let document = parse_document(text).unwrap();
        let numbers = |key: &str| {
            let key: Override = format!("{key}=0").parse().unwrap();
            key.numbers_in(&document)
                .map(|numbers| numbers.into_iter().map(|at| (at.key, at.value)).collect::<Vec<_>>())
        };
        assert_eq!(numbers("a").unwrap(), [("a".to_owned(), 1000.0)]);
        assert_eq!(numbers("b").unwrap(), [("b.1".to_owned(), 0.5), ("b.2".to_owned(), 2.0)]);
        assert_eq!(numbers("c").unwrap(), [("c.x".to_owned(), 1e-3)]);
        assert_eq!(numbers("o.wall.z").unwrap(), [("o.wall.z".to_owned(), 3.0)]);
        assert_eq!(numbers("d").unwrap(), []);
        assert!(numbers("o.wall").is_err() && numbers("o.door.z").is_err());
    }
}
