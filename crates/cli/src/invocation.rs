//! The command as it was called, which pages repeat: each word, quoted where a shell needs it, without absolute paths.

use std::{cell::RefCell, ffi::OsString, path::Path};

use congruent::input::portable_path;

thread_local! {
    /// Of this thread: several calls may run in one process, as in tests.
    static WORDS: RefCell<Vec<String>> = const { RefCell::new(Vec::new()) };
}

/// Keeps the words of a call, the first of which is the program.
pub(crate) fn note(words: &[OsString]) {
    let words = words.iter().skip(1).map(|word| shown(&word.to_string_lossy())).collect();
    WORDS.with(|kept| *kept.borrow_mut() = words);
}

/// The command of the call that runs in this thread.
pub(crate) fn command() -> String {
    WORDS.with(|words| format!("congruent {}", words.borrow().join(" ")).trim_end().to_owned())
}

fn shown(word: &str) -> String {
    let word = match word.split_once('=') {
        Some((option, path)) if option.starts_with('-') => format!("{option}={}", portable(path)),
        _ => portable(word),
    };
    let is_plain = |letter: char| letter.is_ascii_alphanumeric() || "-_./=,:+@%".contains(letter);
    if !word.is_empty() && word.chars().all(is_plain) {
        word
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

/// Of a path that is there, or whose folder is: other words that begin with a slash are topics.
fn portable(word: &str) -> String {
    let path = Path::new(word);
    let in_folder = path.parent().is_some_and(|folder| folder.parent().is_some() && folder.exists());
    if path.is_absolute() && !path.exists() && !in_folder {
        return word.to_owned();
    }
    portable_path(path).display().to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_is_quoted_and_names_no_absolute_path() {
        assert_eq!(shown("/tool/pose"), "/tool/pose");
        let words = [
            "/usr/bin/congruent",
            "check",
            "my robot.toml",
            "--html=/elsewhere/x.html",
            "--tolerance",
            "1mm",
        ];
        note(&words.map(OsString::from));
        let shown = command();
        assert!(shown.starts_with("congruent check 'my robot.toml' --html="), "{shown}");
        assert!(shown.ends_with("elsewhere/x.html --tolerance 1mm") && !shown.contains("=/"), "{shown}");
    }
}
