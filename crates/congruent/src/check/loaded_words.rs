//! Words of an answer about what a program has loaded, or about poses, in the place of those for a second file: neither has lines, and
//! nothing is to be written there.

/// What the other description is, if it is no file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LoadedKind {
    /// The model that an engine has loaded.
    Model,
    /// The poses of a function.
    Poses,
}

/// Phrases about two files, and those about a file and what is loaded from it; `THERE` is what is compared with.
const PHRASES: [(&str, &str); 4] = [
    (" (in one file alone)", " (THERE has no such link)"),
    ("the other file", "THERE"),
    ("the other description", "THERE"),
    // The file is what should be loaded; its lines with these values say what is.
    ("to write", "as loaded, the lines would be"),
];

/// A text about two files in the words for what is loaded.
pub(crate) fn in_words_of(loaded: Option<LoadedKind>, text: String) -> String {
    let Some(kind) = loaded else { return text };
    let there = match kind {
        LoadedKind::Model => "the loaded model",
        LoadedKind::Poses => "the function",
    };
    PHRASES
        .iter()
        .fold(text, |text, (of_files, loaded)| text.replace(of_files, &loaded.replace("THERE", there)))
}
