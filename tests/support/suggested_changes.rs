//! The changes that `congruent check` suggests in the explanations of a difference in dynamics.

use std::{fs, path::Path};

use serde_json::Value;

/// Strings of a JSON array.
pub(crate) fn names(value: &Value) -> Vec<&str> {
    value.as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect()
}

/// Writes the suggested changes of all explanations into the files that they name.
pub(crate) fn apply(explanations: &Value) {
    for explanation in explanations.as_array().unwrap() {
        let path = Path::new(explanation["file"].as_str().unwrap());
        let text = fs::read_to_string(path).unwrap();
        let mut lines: Vec<&str> = text.lines().collect();
        let changes = explanation["changes"].as_array().unwrap();
        assert!(!changes.is_empty(), "{explanation:#}");
        for change in changes.iter().rev() {
            let line = |key: &str| usize::try_from(change[key].as_u64().unwrap()).unwrap();
            lines.splice(line("from_line") - 1..line("to_line"), [change["text"].as_str().unwrap()]);
        }
        fs::write(path, lines.join("\n") + "\n").unwrap();
    }
}
