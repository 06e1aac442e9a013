//! Words of the program, as they are read back from a report.

use std::{
    collections::BTreeSet,
    sync::{Mutex, PoisonError},
};

use serde::{Deserialize, Deserializer};

/// A word of the program: a name of its own, since serde takes any `&str` for one that is borrowed from the input.
pub(crate) type Word = &'static str;

/// A word that the program has itself: the name of a quantity, a unit. Each is kept once, for good.
pub(crate) fn known_word<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Word, D::Error> {
    static KNOWN: Mutex<BTreeSet<Word>> = Mutex::new(BTreeSet::new());
    let word = String::deserialize(deserializer)?;
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(word) = known.get(word.as_str()) {
        return Ok(word);
    }
    let word: Word = Box::leak(word.into_boxed_str());
    known.insert(word);
    Ok(word)
}
