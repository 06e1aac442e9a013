//! Pages of the guide that are made from the program: the keys of the robot file and of a scenario from their schemas, the
//! commands from their help, the codes from their explanations. `GUIDE=update` writes them.

use std::{collections::BTreeMap, fmt::Write, fs, path::Path};

use serde_json::Value;

use crate::{is_update, page::root, sandbox::Sandbox};

/// The first line of each page.
const MADE: &str = "<!-- Made from the program by `GUIDE=update cargo test --release -p congruent-cli --test guide reference`. -->\n";

/// Holds a page against the text that the program gives.
#[track_caller]
fn is_page(name: &str, text: &str) {
    let path = root().join("docs/reference").join(name);
    if is_update() {
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, text).unwrap();
    }
    let written = fs::read_to_string(&path).unwrap_or_default();
    assert!(written == text, "docs/reference/{name} is not what the program gives: GUIDE=update writes it");
}

/// Values of keys in the files of the project, by the path of the key: the first that is found.
struct Examples(BTreeMap<String, String>);

impl Examples {
    /// Of the files below these folders, in the order of their names.
    fn new(folders: &[&str]) -> Self {
        let mut examples = Self(BTreeMap::new());
        for folder in folders {
            examples.add_folder(&root().join(folder));
        }
        examples
    }

    fn add_folder(&mut self, folder: &Path) {
        let mut entries: Vec<_> = fs::read_dir(folder).unwrap().flatten().map(|entry| entry.path()).collect();
        entries.sort();
        for path in entries {
            if path.is_dir() {
                self.add_folder(&path);
            } else if path.extension().is_some_and(|ending| ending == "toml")
                && let Ok(table) = fs::read_to_string(&path).unwrap().parse::<toml::Table>()
            {
                self.add("", &table);
            }
        }
    }

    fn add(&mut self, above: &str, table: &toml::Table) {
        for (key, value) in table {
            let path = if above.is_empty() { key.clone() } else { format!("{above}.{key}") };
            match value {
                toml::Value::Table(below) => self.add(&path, below),
                toml::Value::Array(values) if values.iter().all(toml::Value::is_table) => {
                    values.iter().filter_map(toml::Value::as_table).for_each(|below| self.add(&path, below));
                }
                _ => {}
            }
            self.0.entry(path).or_insert_with(|| inline(value));
        }
    }

    /// An example of a key, in a column.
    fn of(&self, path: &str) -> String {
        /// Longer examples make a column that is hard to read.
        const LONGEST: usize = 48;
        match self.0.get(path) {
            Some(value) if value.chars().count() <= LONGEST => format!("`{value}`"),
            _ => String::new(),
        }
    }
}

/// A value as it stands behind a key.
fn inline(value: &toml::Value) -> String {
    match value {
        toml::Value::Table(table) => {
            let parts: Vec<String> =
                table.iter().map(|(key, value)| format!("{} = {}", as_key(key), inline(value))).collect();
            format!("{{ {} }}", parts.join(", "))
        }
        toml::Value::Array(values) => {
            format!("[{}]", values.iter().map(inline).collect::<Vec<_>>().join(", "))
        }
        // As files write it: 1e-12, and not twelve zeros.
        toml::Value::Float(value) if *value != 0.0 && value.abs() < 1e-4 => format!("{value:e}"),
        other => other.to_string(),
    }
}

/// A key as TOML needs it.
fn as_key(key: &str) -> String {
    let is_bare = key.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '-'));
    if is_bare { key.to_owned() } else { format!("\"{key}\"") }
}

/// The keys of a file in tables, a section for each table of the file.
struct KeyPage<'a> {
    schema: &'a Value,
    examples: &'a Examples,
    text: String,
}

impl KeyPage<'_> {
    fn resolved<'b>(&'b self, value: &'b Value) -> &'b Value {
        let target = value["$ref"].as_str().and_then(|path| path.strip_prefix("#/$defs/"));
        target.map_or(value, |name| &self.schema["$defs"][name])
    }

    /// The table or list of tables below a key: the schemas of what may be there.
    fn tables<'b>(&'b self, value: &'b Value) -> Vec<&'b Value> {
        let value = self.resolved(value);
        if value["type"] == "array" {
            return self.tables(&value["items"]);
        }
        if value["properties"].is_object() {
            return vec![value];
        }
        variants(value).into_iter().flat_map(|one| self.tables(one)).collect()
    }

    fn is_list<'b>(&'b self, value: &'b Value) -> bool {
        self.resolved(value)["type"] == "array"
    }

    /// A section with the keys of a table, and the sections of the tables below.
    fn section(&mut self, path: &str, heading: &str, table: &Value) {
        let _ = writeln!(self.text, "\n## {heading}\n\n{}\n", description(table));
        let empty = serde_json::Map::new();
        let properties = table["properties"].as_object().unwrap_or(&empty);
        if properties.values().any(|value| !value["const"].is_string()) {
            self.text += "| key | takes | default | example | meaning |\n|---|---|---|---|---|\n";
        }
        let required: Vec<&str> =
            table["required"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
        let mut below = Vec::new();
        for (key, value) in properties {
            let key_path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
            if value["const"].is_string() {
                continue;
            }
            let tables: Vec<Value> = self.tables(value).into_iter().cloned().collect();
            let takes = if tables.is_empty() {
                self.takes(value)
            } else {
                format!("table `{}`", heading_of(&key_path, self.is_list(value)))
            };
            let default = match &value["default"] {
                _ if required.contains(&key.as_str()) => "required".to_owned(),
                Value::Null | Value::Object(_) => String::new(),
                default => format!("`{default}`"),
            };
            let example = if tables.is_empty() { self.examples.of(&key_path) } else { String::new() };
            let meaning = description(value);
            let meaning = if meaning.is_empty() { description(self.resolved(value)) } else { meaning };
            let _ = writeln!(self.text, "| `{key}` | {takes} | {default} | {example} | {meaning} |");
            below.extend(tables.into_iter().map(|table| (key_path.clone(), self.is_list(value), table)));
        }
        let paths: Vec<String> = below.iter().map(|(path, ..)| path.clone()).collect();
        let alike = |path: &String| paths.iter().filter(|other| *other == path).count();
        for (path, is_list, table) in below {
            let kind = kind_of(&table);
            let heading = heading_of(&path, is_list);
            let own = own_key(&table).filter(|_| kind.is_none() && is_list && alike(&path) > 1);
            let heading = match (kind, own) {
                (Some((key, word)), _) => format!("{heading} {key} = {word}"),
                (None, Some(key)) => format!("{heading} {key}"),
                (None, None) => heading,
            };
            // A pose occurs in several tables: each has its section, so that a search for its path ends there.
            self.section(&path, &format!("`{heading}`"), &table);
        }
    }

    /// What a key takes, in words.
    fn takes(&self, value: &Value) -> String {
        let value = self.resolved(value);
        if let Some(words) = value["enum"].as_array() {
            return listed(words.iter());
        }
        let variants = variants(value);
        let words: Vec<&Value> =
            variants.iter().map(|one| &one["const"]).filter(|word| !word.is_null()).collect();
        if !words.is_empty() {
            return listed(words.into_iter());
        }
        if !variants.is_empty() {
            return variants.into_iter().map(|one| self.takes(one)).collect::<Vec<_>>().join(", or ");
        }
        let kind = value["type"].as_str().or_else(|| value["type"].as_array()?.first()?.as_str());
        match kind {
            Some("number") => "number".to_owned(),
            Some("integer") => "whole number".to_owned(),
            Some("string") => "text".to_owned(),
            Some("boolean") => "`true` or `false`".to_owned(),
            Some("array") => {
                let count =
                    value["minItems"].as_u64().filter(|count| value["maxItems"].as_u64() == Some(*count));
                let count = count.map_or("list".to_owned(), |count| format!("{count}"));
                let each = self.takes(&value["items"]);
                if count == "list" { format!("list: {each}") } else { format!("{count} values: {each}") }
            }
            Some("object") if value["properties"].is_object() => "table".to_owned(),
            Some("object") => format!("for each name: {}", self.takes(&value["additionalProperties"])),
            _ => String::new(),
        }
    }
}

/// The key that says which one of several tables is meant, and its word, as `kind = "payload"`.
fn kind_of(table: &Value) -> Option<(&String, &Value)> {
    let properties = table["properties"].as_object()?.iter();
    properties.map(|(key, value)| (key, &value["const"])).find(|(_, word)| word.is_string())
}

/// The first key that a table must have: of several tables under one heading it says which one is meant.
fn own_key(table: &Value) -> Option<&str> {
    let required = table["required"].as_array().and_then(|keys| keys.first()?.as_str());
    // Positions have a key for each unit, of which none is required by itself.
    let of_joints = || table["properties"].as_object()?.keys().find(|key| key.contains("joints"));
    required.or_else(|| of_joints().map(String::as_str))
}

/// What a key takes, without null.
fn variants(value: &Value) -> Vec<&Value> {
    let several = value["oneOf"].as_array().or_else(|| value["anyOf"].as_array());
    several.into_iter().flatten().filter(|one| one["type"] != "null").collect()
}

fn listed<'a>(words: impl Iterator<Item = &'a Value>) -> String {
    words.map(|word| format!("`{}`", word.to_string().replace('"', ""))).collect::<Vec<_>>().join(", ")
}

/// `[dh]`, `[[dh.row]]`.
#[expect(clippy::fn_params_excessive_bools, reason = "a key is of a table or of a list of tables")]
fn heading_of(path: &str, is_list: bool) -> String {
    if is_list { format!("[[{path}]]") } else { format!("[{path}]") }
}

/// A description on one line of a table.
fn description(value: &Value) -> String {
    value["description"].as_str().unwrap_or_default().replace('\n', " ").replace('|', "\\|")
}

fn keys(schema: &str, title: &str, examples: &Examples) -> String {
    let sandbox = Sandbox::new();
    let schema: Value =
        serde_json::from_str(&sandbox.run(&format!("congruent schema {schema}")).printed).unwrap();
    let mut page = KeyPage { schema: &schema, examples, text: format!("{MADE}\n# {title}\n") };
    page.text += "\nKeys with units end in them; of a quantity that has two keys, give exactly one. Examples are from the files of the project.\n";
    page.section("", "At the top", &schema);
    page.text
}

#[test]
fn reference_of_the_robot_file() {
    is_page(
        "robot_file.md",
        &keys("robot", "Keys of the robot file", &Examples::new(&["robots", "docs/examples"])),
    );
}

#[test]
fn reference_of_the_scenario() {
    is_page("scenario.md", &keys("scenario", "Keys of a scenario", &Examples::new(&["scenarios"])));
}

#[test]
fn reference_of_the_commands() {
    let sandbox = Sandbox::new();
    let help = |command: &str| sandbox.run(&format!("congruent {command} --help")).printed;
    let all = help("");
    let mut text = format!("{MADE}\n# All commands and options\n\n```text\n{}\n```\n", all.trim_end());
    for name in sandbox.commands() {
        let _ = writeln!(text, "\n## congruent {name}\n\n```text\n{}\n```", help(&name).trim_end());
        if name == "new" {
            for below in ["new robot", "new scenario"] {
                let _ = writeln!(text, "\n## congruent {below}\n\n```text\n{}\n```", help(below).trim_end());
            }
        }
    }
    is_page("commands.md", &text);
}

#[test]
fn reference_of_the_codes() {
    let mut areas: BTreeMap<&str, String> = BTreeMap::new();
    let mut codes = congruent_cli::codes();
    codes.sort_by_key(|code| (code.id, code.name));
    for code in codes {
        let area = code.id.and_then(|id| id.split('-').nth(1)).unwrap_or("CHECK");
        let heading = code.id.map_or(code.name.to_owned(), |id| format!("{id} {}", code.name));
        let (about, example) = code.about.split_once('\n').unwrap_or((code.about, ""));
        let text = areas.entry(area).or_default();
        let _ = writeln!(text, "\n### {heading}\n\n{about}");
        if !example.is_empty() {
            let lines: Vec<&str> = example.lines().map(str::trim_start).collect();
            let _ = writeln!(text, "\n```text\n{}\n```", lines.join("\n"));
        }
    }
    let mut text = format!(
        "{MADE}\n# Codes of messages\n\nEach message has a code. `congruent explain CODE` prints what is here.\n"
    );
    for (area, codes) in areas {
        let _ = write!(text, "\n## {area}\n{codes}");
    }
    is_page("codes.md", &text);
}
