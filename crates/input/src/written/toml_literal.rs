//! Strings and keys as TOML writes them.

/// A string as a TOML literal, quoted and escaped.
pub fn toml_string(text: &str) -> String {
    toml::Value::from(text).to_string()
}

/// A name as a key of TOML: quoted if need be, and in one line, which strings with quotes are not.
pub fn toml_key(name: &str) -> String {
    let line = toml::Table::from_iter([(name.to_owned(), toml::Value::from(0))]).to_string();
    line.trim_end().trim_end_matches("= 0").trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_bare_or_in_one_line() {
        let names =
            ["a-1", "", "a b", "q\"'2", "\\", "line\nbreak", "\u{7f}", "'''\"\"\"", "gr\u{f6}\u{df}e = 0"];
        for name in names {
            let key = toml_key(name);
            assert!(!key.contains('\n'), "{key}");
            let table: toml::Table = format!("{key} = 1").parse().unwrap();
            assert_eq!(table.keys().next().unwrap(), name);
        }
        assert_eq!(toml_key("a-1"), "a-1");
    }
}
