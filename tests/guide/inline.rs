//! Commands and options that stand in the text: they exist.

use std::collections::BTreeMap;

use crate::{page::pages, sandbox::Sandbox};

/// The pieces of code in the text, without blocks.
fn pieces(text: &str) -> Vec<String> {
    let mut in_block = false;
    let mut prose = String::new();
    for line in text.lines() {
        if line.starts_with("```") {
            in_block = !in_block;
        } else if !in_block {
            prose.push_str(line);
            prose.push(' ');
        }
    }
    prose.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

#[test]
fn commands_in_the_text_exist() {
    let sandbox = Sandbox::new();
    let mut helps: BTreeMap<String, String> = BTreeMap::new();
    let mut found = 0;
    // The history has the names of its time.
    for page in pages().into_iter().filter(|page| page.name != "docs/history.md") {
        for piece in pieces(&page.text) {
            let Some(rest) = piece.strip_prefix("congruent ") else { continue };
            let is_name =
                |word: &&str| !word.is_empty() && word.chars().all(|letter| letter.is_ascii_lowercase());
            let words: Vec<&str> = rest.split_whitespace().collect();
            let Some(command) = words.first().map(|word| word.trim_end_matches(',')).filter(is_name) else {
                continue;
            };
            // `new` has commands of its own.
            let mut command = command.to_owned();
            if let ("new", Some(sub)) = (command.as_str(), words.get(1)) {
                command = format!("{command} {sub}");
            }
            let help = helps.entry(command.clone()).or_insert_with(|| {
                let answer = sandbox.run(&format!("congruent {command} --help"));
                assert_eq!(answer.code, 0, "{}: `{piece}`: {}", page.name, answer.printed);
                answer.printed
            });
            found += 1;
            for option in words.iter().filter(|word| word.starts_with("--")) {
                let option = option.split(['=', ',', '|']).next().unwrap_or_default();
                assert!(
                    help.contains(&format!("{option} ")) || help.contains(&format!("{option}\n")),
                    "{}: `{piece}`: {option}",
                    page.name
                );
            }
        }
    }
    assert!(found > 20, "{found} commands were found");
}

#[test]
fn files_in_toml_are_toml() {
    let mut found = 0;
    for page in pages() {
        for block in page.text.split("```toml").skip(1) {
            let (_, text) = block.split_once('\n').unwrap();
            let text = text.split("```").next().unwrap_or_default();
            if let Err(error) = text.parse::<toml::Table>() {
                panic!("{}: {error}\n{text}", page.name);
            }
            found += 1;
        }
    }
    assert!(found > 10, "{found} blocks were found");
}
