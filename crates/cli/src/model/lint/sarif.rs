//! Findings as SARIF 2.1.0, which code hosts show beside the lines. Source: OASIS, *Static Analysis Results Interchange
//! Format (SARIF) Version 2.1.0* (2020). A finding that stands for several places is a result for each of them.

use std::{collections::BTreeMap, fmt::Write, ops::Range, path::Path};

use congruent::{
    LintFix, LintReport,
    description::{Code, Diagnostic, Severity, TextEdit, line_column},
};
use serde::Serialize;
use serde_json::{Value, json};

/// A log with one run.
#[derive(Serialize)]
pub(super) struct Sarif {
    #[serde(rename = "$schema")]
    schema: &'static str,
    version: &'static str,
    runs: [Value; 1],
}

pub(super) fn document(reports: &[&LintReport]) -> Sarif {
    let found = || reports.iter().flat_map(|report| report.diagnostics.iter().map(|found| (*report, found)));
    let codes: BTreeMap<&str, Option<Code>> =
        found().map(|(_, found)| (found.code, Code::find(found.code))).collect();
    let rules: Vec<Value> = codes.iter().map(|(name, code)| rule(name, *code)).collect();
    let index = |name: &str| codes.keys().position(|known| *known == name);
    let results: Vec<Value> = found()
        .flat_map(|(report, found)| results(found, &report.fixes, (index(found.code), codes[found.code])))
        .collect();
    let driver = json!({
        "name": "congruent",
        "semanticVersion": env!("CARGO_PKG_VERSION"),
        "rules": rules,
    });
    let run = json!({
        "tool": { "driver": driver },
        "columnKind": "unicodeCodePoints",
        "results": results,
    });
    Sarif { schema: "https://json.schemastore.org/sarif-2.1.0.json", version: "2.1.0", runs: [run] }
}

fn rule(name: &str, code: Option<Code>) -> Value {
    let id = code.map_or_else(|| name.to_owned(), |code| code.to_string());
    let about = code.map_or("", |code| code.about);
    let first = about.split_inclusive(['.', ':']).next().unwrap_or(name).trim_end_matches(':');
    json!({
        "id": id,
        "name": name,
        "shortDescription": { "text": first },
        "fullDescription": { "text": about },
        "help": { "text": about },
    })
}

fn results(found: &Diagnostic, fixes: &[LintFix], (rule, code): (Option<usize>, Option<Code>)) -> Vec<Value> {
    let id = code.map_or_else(|| found.code.to_owned(), |code| code.to_string());
    let level = match found.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
    };
    let one = |message: &str, span: Option<&Range<usize>>| {
        let help = found.help.as_ref().map_or_else(String::new, |help| format!("; {help}"));
        let mut result = json!({
            "ruleId": id,
            "level": level,
            "message": { "text": format!("{message}{help}") },
        });
        if let Some(rule) = rule {
            result["ruleIndex"] = json!(rule);
        }
        if let Some(location) = location(found, span) {
            result["locations"] = json!([{ "physicalLocation": location }]);
        }
        let fixes = fixes.iter().filter(|fix| answers(fix, found, span)).map(fix);
        let fixes: Vec<Value> = fixes.collect();
        if !fixes.is_empty() {
            result["fixes"] = json!(fixes);
        }
        result
    };
    match &found.kind.occurrences[..] {
        [] => vec![one(&found.message, found.span.as_ref())],
        several => several.iter().map(|each| one(&each.message, each.span.as_ref())).collect(),
    }
}

/// Whether a correction is of what stands at a place: of the same file, in the same line.
fn answers(fix: &LintFix, found: &Diagnostic, span: Option<&Range<usize>>) -> bool {
    let (Some(source), Some(span)) = (&found.source, span) else { return false };
    let line = |at| line_column(&source.text, at).0;
    let is_here = |edit: &TextEdit| line(edit.span.start) == line(span.start);
    fix.code == found.code && fix.source.path == source.path && fix.edits.first().is_some_and(is_here)
}

fn fix(fix: &LintFix) -> Value {
    let replacement = |edit: &TextEdit| {
        let inserted = json!({ "text": edit.text });
        json!({ "deletedRegion": region(&fix.source.text, &edit.span), "insertedContent": inserted })
    };
    let replacements: Vec<Value> = fix.edits.iter().map(replacement).collect();
    let uri = uri(&fix.source.path);
    json!({
        "description": { "text": fix.about },
        "artifactChanges": [{ "artifactLocation": { "uri": uri }, "replacements": replacements }],
    })
}

fn location(found: &Diagnostic, span: Option<&Range<usize>>) -> Option<Value> {
    let source = found.source.as_ref()?;
    let mut location = json!({ "artifactLocation": { "uri": uri(&source.path) } });
    if let Some(span) = span {
        location["region"] = region(&source.text, span);
    }
    Some(location)
}

/// Lines and columns from 1; the end is the column behind the last character.
fn region(text: &str, span: &Range<usize>) -> Value {
    let (line, column) = line_column(text, span.start);
    let mut region = json!({ "startLine": line, "startColumn": column });
    if span.end > span.start {
        let (line, column) = line_column(text, span.end);
        region["endLine"] = json!(line);
        region["endColumn"] = json!(column);
    }
    region
}

/// A path as a URI: relative to the current folder where it is below it, which is how code hosts find the file.
fn uri(path: &Path) -> String {
    let current = std::env::current_dir().ok();
    let below = current.as_ref().and_then(|current| path.strip_prefix(current).ok()).unwrap_or(path);
    let text = below.to_string_lossy().replace('\\', "/");
    let mut uri = if below.is_absolute() { "file://".to_owned() } else { String::new() };
    for byte in text.trim_start_matches("./").bytes() {
        if byte.is_ascii_alphanumeric() || b"-._~/".contains(&byte) {
            uri.push(char::from(byte));
        } else {
            let _ = write!(uri, "%{byte:02X}");
        }
    }
    uri
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use congruent::description::{Diagnostics, SourceFile};

    use super::*;

    #[test]
    fn every_place_is_a_result_with_its_region() {
        let source =
            Arc::new(SourceFile { path: "my robot/a.urdf".into(), text: "ab\né<x>\n<y>\n".to_owned() });
        let mut found = Diagnostics::default();
        for (name, span) in [("x", 5..7), ("y", 9..11)] {
            let warning = Diagnostic::warning("urdf::massless", format!("link {name} has no mass"));
            found.push(warning.one_of("links have no mass", name).at(span));
        }
        let found = found.in_file(&source);
        let code = Code::find("urdf::massless");
        let results = results(&found[0], &[], (Some(0), code));
        assert_eq!(results.len(), 2);
        let location = &results[0]["locations"][0]["physicalLocation"];
        assert_eq!(location["artifactLocation"]["uri"], "my%20robot/a.urdf");
        assert_eq!(
            location["region"],
            json!({ "startLine": 2, "startColumn": 2, "endLine": 2, "endColumn": 4 })
        );
        assert_eq!(results[1]["locations"][0]["physicalLocation"]["region"]["startLine"], 3);
        assert_eq!(results[0]["ruleId"], "CGR-URDF-028");
        assert_eq!(results[0]["ruleIndex"], 0);
    }
}
