//! The command as it was called, which pages repeat: each word, quoted where a shell needs it, without absolute paths.

use std::{cell::RefCell, ffi::OsString, path::Path};

use congruent::input::portable_path;

thread_local! {
    /// Of this thread: several calls may run in one process, as in tests.
    static WORDS: RefCell<Vec<String>> = const { RefCell::new(Vec::new()) };
}

/// Options with a topic, which begins with a slash as a path does.
const OF_TOPICS: [&str; 5] =
    ["--joints", "--setpoint", "--measured-pose", "--controller-pose", "--derived-pose"];

/// Keeps the words of a call, the first of which is the program.
pub(crate) fn note(words: &[OsString]) {
    let words: Vec<String> = words.iter().map(|word| word.to_string_lossy().into_owned()).collect();
    let is_topic = |at: usize| OF_TOPICS.contains(&words[at - 1].as_str());
    let words = (1..words.len()).map(|at| if is_topic(at) { words[at].clone() } else { shown(&words[at]) });
    let words = words.collect();
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

fn portable(word: &str) -> String {
    portable_path(Path::new(word)).display().to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_is_quoted_and_names_no_absolute_path() {
        let words = [
            "/usr/bin/congruent",
            "check",
            "my robot.toml",
            "--html=/elsewhere/x.html",
            "--tolerance",
            "1mm",
            "--setpoint",
            "/arm/reference",
        ];
        note(&words.map(OsString::from));
        let shown = command();
        assert!(shown.starts_with("congruent check 'my robot.toml' --html="), "{shown}");
        assert!(
            shown.ends_with("elsewhere/x.html --tolerance 1mm --setpoint /arm/reference")
                && !shown.contains("=/"),
            "{shown}"
        );
    }
}
