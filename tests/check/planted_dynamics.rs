//! The 71 planted faults of dynamics of the corpus, each written into a URDF that `congruent check` holds against the
//! original: what torque shows is named, with its line, and what is suggested makes the check agree; the others raise no
//! alarm.

use std::{fmt::Write, fs, path::Path};

use serde_json::Value;

use crate::support::{
    command::{congruent_json, text},
    corpus::corpus,
    golden::numbers,
    suggested_changes::{apply, names},
};

fn joined(values: &[f64]) -> String {
    values.iter().map(|value| format!("{value:?}")).collect::<Vec<_>>().join(" ")
}

/// The text of an `<inertial>`, each element on its line.
fn inertial(figures: &Value) -> String {
    if figures.is_null() {
        return String::new();
    }
    let mut tensor = String::new();
    for (name, value) in ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"].iter().zip(numbers(&figures["inertia"])) {
        let _ = write!(tensor, " {name}=\"{value:?}\"");
    }
    let [xyz, rpy] = ["xyz", "rpy"].map(|key| joined(&numbers(&figures[key])));
    format!(
        "<inertial>\n<origin xyz=\"{xyz}\" rpy=\"{rpy}\"/>\n<mass value=\"{:?}\"/>\n<inertia{tensor}/>\n</inertial>",
        figures["mass"].as_f64().unwrap()
    )
}

/// The range of an element of this name, from its start tag to its end.
fn element(text: &str, tag: &str, name: &str) -> (usize, usize) {
    let mut from = 0;
    loop {
        let start = from + text[from..].find(&format!("<{tag} ")).unwrap();
        let close = start + text[start..].find('>').unwrap();
        if text[start..close].contains(&format!("name=\"{name}\"")) {
            if text[..close].ends_with('/') {
                return (start, close + 1);
            }
            let end = format!("</{tag}>");
            return (start, close + text[close..].find(&end).unwrap() + end.len());
        }
        from = close;
    }
}

/// The original with the changes of a fault.
fn mutated(original: &str, fault: &Value) -> String {
    let mut text = original.to_owned();
    for (link, figures) in fault["changes"].as_object().unwrap() {
        let (start, end) = element(&text, "link", link);
        let mut part = text[start..end].to_owned();
        if let (Some(from), Some(to)) = (part.find("<inertial"), part.find("</inertial>")) {
            part.replace_range(from..to + "</inertial>".len(), "");
        }
        if let Some(open) = part.strip_suffix("/>").filter(|_| !part.contains("</link>")) {
            part = format!("{open}></link>");
        }
        let inside = part.find('>').unwrap() + 1;
        part.insert_str(inside, &inertial(figures));
        text.replace_range(start..end, &part);
    }
    for (joint, terms) in fault["joint_changes"].as_object().unwrap() {
        for (term, value) in terms.as_object().unwrap() {
            let (start, end) = element(&text, "joint", joint);
            let mut part = text[start..end].to_owned();
            let tag = if ["damping", "friction"].contains(&term.as_str()) { "<dynamics" } else { "<limit" };
            if !part.contains(tag) {
                part = part.replace("</joint>", &format!("{tag} /></joint>"));
            }
            let tag_start = part.find(tag).unwrap();
            let tag_end = tag_start + part[tag_start..].find('>').unwrap();
            let mut attributes = part[tag_start..tag_end].to_owned();
            if let Some(from) = attributes.find(&format!("{term}=\"")) {
                let value_start = from + term.len() + 2;
                let value_end = value_start + attributes[value_start..].find('"').unwrap();
                attributes.replace_range(from..=value_end, "");
            }
            attributes.insert_str(tag.len(), &format!(" {term}=\"{:?}\"", value.as_f64().unwrap()));
            part.replace_range(tag_start..tag_end, &attributes);
            text.replace_range(start..end, &part);
        }
    }
    text
}

/// All names of an explanation with their places.
fn all_names(explanation: &Value) -> Vec<(String, Vec<String>)> {
    let one = |of: &Value| {
        let place = sorted(&of["place"]);
        (of["cause"].as_str().unwrap().to_owned(), place)
    };
    let also = explanation["also_named"].as_array().unwrap();
    std::iter::once(explanation).chain(also).map(one).collect()
}

/// The links or joints of a fault, by name: of several those with the largest effect come first in a report.
fn sorted(place: &Value) -> Vec<String> {
    let mut names: Vec<String> = names(place).into_iter().map(str::to_owned).collect();
    names.sort();
    names
}

/// A fault in a file of its own against the original.
fn check(path: &Path, original: &Path) -> (i32, Value) {
    let answer = congruent_json(&["check", &text(path), "--against", &text(original)]);
    (answer.code, answer.json())
}

fn assert_named(fault: &Value, code: i32, report: &Value, path: &Path, original: &Path) {
    let id = fault["id"].as_str().unwrap();
    assert_eq!(code, 1, "{id}");
    let planted = sorted(&fault["place"]);
    let planted = (fault["cause"].as_str().unwrap().to_owned(), planted);
    let explanations = &report["dynamics"]["explanations"];
    let first = &explanations[0];
    assert!(all_names(first).contains(&planted), "{id}: {:?}", all_names(first));
    // The line is in the element of the first place.
    let file = fs::read_to_string(path).unwrap();
    let line = usize::try_from(first["line"].as_u64().unwrap()).unwrap();
    let line_start = file.split_inclusive('\n').take(line - 1).map(str::len).sum::<usize>();
    let line_end = line_start + file[line_start..].find('\n').unwrap();
    let inside = planted.1.iter().filter(|place| *place != "*").any(|place| {
        let tag = if file.contains(&format!("<link name=\"{place}\"")) { "link" } else { "joint" };
        let (start, end) = element(&file, tag, place);
        line_end > start && line_start < end
    });
    assert!(inside || planted.1 == ["*"], "{id}: line {line} is not in {:?}", planted.1);
    apply(explanations);
    let (code, report) = check(path, original);
    assert_eq!(code, 0, "{id}: {:#}", report["dynamics"]["explanations"]);
}

#[test]
fn every_planted_fault_is_named_with_its_line_and_its_correction_agrees() {
    let Some(corpus) = corpus() else { return };
    let golden: Value =
        serde_json::from_str(&fs::read_to_string(corpus.join("dynamics-faults/faults.json")).unwrap())
            .unwrap();
    let faults = golden["faults"].as_array().unwrap();
    assert_eq!(faults.len(), 71);
    let folder = tempfile::tempdir().unwrap();
    let mut shown = 0;
    for fault in faults {
        let id = fault["id"].as_str().unwrap();
        let original = corpus.join("robots").join(fault["robot"].as_str().unwrap()).join("robot.urdf");
        let path = folder.path().join(format!("{id}.urdf"));
        fs::write(&path, mutated(&fs::read_to_string(&original).unwrap(), fault)).unwrap();
        let (code, report) = check(&path, &original);
        let dynamics = &report["dynamics"];
        if fault["seen_by_joint_torque"] == true {
            assert_named(fault, code, &report, &path, &original);
            shown += 1;
            continue;
        }
        assert_eq!(dynamics["explanations"].as_array().unwrap().len(), 0, "{id}");
        match fault["cause"].as_str().unwrap() {
            limit @ ("velocity_limit" | "effort_limit") => {
                assert_eq!(code, 1, "{id}");
                assert_eq!(dynamics["limits"][0]["cause"], limit, "{id}");
                assert_eq!(dynamics["limits"][0]["joint"], fault["place"][0], "{id}");
            }
            "none" => assert_eq!((code, &dynamics["verdict"]), (0, &Value::from("same")), "{id}"),
            _ => {
                assert_eq!((code, &dynamics["verdict"]), (0, &Value::from("same_torques")), "{id}");
                assert!(!dynamics["hidden_differences"].as_array().unwrap().is_empty(), "{id}");
            }
        }
    }
    assert_eq!(shown, 57);
}

#[test]
fn base_parameters_are_as_many_as_another_program_finds() {
    let Some(corpus) = corpus() else { return };
    let golden: Value =
        serde_json::from_str(&fs::read_to_string(corpus.join("dynamics-faults/faults.json")).unwrap())
            .unwrap();
    for (name, expected) in golden["robots"].as_object().unwrap() {
        let path = text(&corpus.join("robots").join(name).join("robot.urdf"));
        let report = congruent_json(&["dynamics", &path, "--base-parameters", "--free-followers"]).json();
        let found = report["base_parameters"].as_array().unwrap().len();
        assert_eq!(Some(found as u64), expected["base_parameters"].as_u64(), "{name}");
    }
}
