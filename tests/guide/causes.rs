//! Every cause of a disagreement has an example in the guide, and the example has this cause.

use std::{collections::BTreeSet, fs};

use serde_json::Value;

use crate::{
    page::{Block, Page, root},
    sandbox::Sandbox,
};

/// Names of the causes in the schema of the report of `check`.
fn causes(definition: &str) -> BTreeSet<String> {
    let text = fs::read_to_string(root().join("schemas/check.json")).unwrap();
    let schema: Value = serde_json::from_str(&text).unwrap();
    let variants = schema["$defs"][definition]["oneOf"].as_array().unwrap();
    variants.iter().map(|variant| variant["const"].as_str().unwrap().to_owned()).collect()
}

/// Every value of a key `cause`, wherever it is.
fn named(value: &Value, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(entries) => {
            for (key, value) in entries {
                if let Some(cause) = value.as_str().filter(|_| key == "cause") {
                    found.insert(cause.to_owned());
                } else {
                    named(value, found);
                }
            }
        }
        Value::Array(values) => values.iter().for_each(|value| named(value, found)),
        _ => {}
    }
}

/// The causes that the examples of a page are for, each verified with the first explanation of its example.
fn examples(name: &str, first_of: impl Fn(&Value) -> Value) -> BTreeSet<String> {
    let page = Page::new(&root().join(name), &root());
    let sandbox = Sandbox::new();
    let mut shown = BTreeSet::new();
    let headings: Vec<(usize, BTreeSet<String>)> = headings(&page.text);
    for block in &page.blocks {
        let Block::Commands { line, commands, .. } = block else { continue };
        let heading = headings.iter().rev().find(|(at, _)| at < line).map(|(_, causes)| causes.clone());
        for command in commands {
            if !command.text.starts_with("congruent check") {
                sandbox.run(&command.text);
                continue;
            }
            let answer = sandbox.run(&format!("{} --format json", command.text.trim()));
            // Warnings follow the document.
            let mut documents = serde_json::Deserializer::from_str(&answer.printed).into_iter::<Value>();
            let report = documents.next().unwrap().unwrap();
            let mut found = BTreeSet::new();
            named(&first_of(&report), &mut found);
            let heading = heading.clone().unwrap_or_default();
            if heading.contains("unexplained") {
                found.insert("unexplained".to_owned());
                assert_eq!(found.len(), 1, "{name}:{line}: {found:?}");
            }
            assert!(heading.is_subset(&found), "{name}:{line}: {heading:?}, but {found:?}");
            shown.extend(heading);
        }
    }
    shown
}

/// Headings by line, with the names in code that they have.
fn headings(text: &str) -> Vec<(usize, BTreeSet<String>)> {
    let numbered = text.lines().enumerate().filter(|(_, line)| line.starts_with('#'));
    let names = |line: &str| line.split('`').skip(1).step_by(2).map(str::to_owned).collect();
    numbered.map(|(at, line)| (at + 1, names(line))).collect()
}

/// Causes that no pair of files has, only a program's own source: the guide has a program for them, which is run as a
/// test of the crate `congruent`.
const OF_PROGRAMS: [(&str, &[&str]); 2] = [
    ("docs/disagreement/poses.md", &["ratio"]),
    ("docs/disagreement/dynamics/gravity.md", &["inertial_left_out"]),
];

/// The pages with the causes of a difference in dynamics.
const DYNAMICS: [&str; 5] = ["units", "centre_of_mass", "inertia", "joints", "gravity"];

/// What is reported of torques that no cause explains: the values of two files are compared one by one, so that no pair of
/// short files has it.
const WITHOUT_EXAMPLE: &str = "unexplained";

#[test]
fn every_cause_of_poses_has_an_example() {
    let mut shown = examples("docs/disagreement/poses.md", |report| report["diagnosis"][0].clone());
    shown.extend(OF_PROGRAMS[0].1.iter().map(|&cause| cause.to_owned()));
    assert_eq!(shown, causes("Cause"));
}

#[test]
fn every_cause_of_dynamics_has_an_example() {
    let first = |report: &Value| {
        let all: Vec<&Value> = report["other_dynamics"].as_array().into_iter().flatten().collect();
        let all = all.into_iter().chain([&report["dynamics"]]);
        Value::from(all.map(|dynamics| dynamics["explanations"][0].clone()).collect::<Vec<_>>())
    };
    let page = |name: &&str| examples(&format!("docs/disagreement/dynamics/{name}.md"), first);
    let mut shown: BTreeSet<String> = DYNAMICS.iter().flat_map(page).collect();
    shown.extend(OF_PROGRAMS[1].1.iter().map(|&cause| cause.to_owned()));
    shown.insert(WITHOUT_EXAMPLE.to_owned());
    assert_eq!(shown, causes("DynamicsCause"));
}

#[test]
fn causes_of_programs_are_in_a_program() {
    for (name, causes) in OF_PROGRAMS {
        let text = fs::read_to_string(root().join(name)).unwrap();
        let programs: String =
            text.split("```rust").skip(1).filter_map(|rest| rest.split("```").next()).collect();
        for cause in causes {
            let variant: String =
                cause.split('_').map(|word| word[..1].to_uppercase() + &word[1..]).collect();
            assert!(programs.contains(&variant), "{name}: no program has {variant}");
        }
    }
}
