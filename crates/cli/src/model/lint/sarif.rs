//! Findings as SARIF 2.1.0, which code hosts show beside the lines. Source: OASIS, *Static Analysis Results Interchange
//! Format (SARIF) Version 2.1.0* (2020). A finding about several places is a result for each of them.

use std::{
    collections::BTreeMap,
    fmt::Write,
    ops::Range,
    path::{Component, Path, PathBuf, Prefix},
};

use congruent::{
    LintFix, LintReport,
    input::{Code, Diagnostic, Occurrence, Severity, SourceFile, TextEdit},
};
use serde::Serialize;
use serde_json::{Value, json};

use super::lines::Lines;
use crate::ci::{inside, top_of_repository};

/// A log with one run.
#[derive(Serialize)]
pub(super) struct Sarif {
    #[serde(rename = "$schema")]
    schema: &'static str,
    version: &'static str,
    runs: [Value; 1],
}

/// Writes the results of a run.
struct SarifResults {
    /// The top of the repository; `None` outside of one.
    top: Option<PathBuf>,
    /// The rules, by the names of their codes.
    codes: BTreeMap<&'static str, &'static Code>,
    /// Number of results with the same rule, file and subject, which differ only in their lines.
    fingerprints: BTreeMap<String, usize>,
    lines: Lines,
}

/// Corrections by the code of what they correct, and the file and line of their first change.
type FixesByLine<'a> = BTreeMap<(&'a str, &'a Path, usize), Vec<&'a LintFix>>;

/// One place of a finding.
struct ResultPlace<'a> {
    message: &'a str,
    /// What it is about.
    name: Option<&'a str>,
    span: Option<&'a Range<usize>>,
}

impl<'a> From<&'a Occurrence> for ResultPlace<'a> {
    fn from(found: &'a Occurrence) -> Self {
        Self { message: &found.message, name: found.name.as_deref(), span: found.span.as_ref() }
    }
}

pub(super) fn document(reports: &[(&Path, &LintReport)]) -> Sarif {
    let found = reports.iter().flat_map(|(_, report)| &report.diagnostics);
    let codes: BTreeMap<&str, &Code> = found.map(|found| (found.code.name, found.code)).collect();
    let rules: Vec<Value> = codes.values().map(|code| rule(code)).collect();
    let mut results = SarifResults {
        top: top_of_repository(),
        codes,
        fingerprints: BTreeMap::new(),
        lines: Lines::default(),
    };
    let of_report = |(path, report): &(&Path, &LintReport)| {
        let fixes = results.fixes(&report.fixes);
        let found = report.diagnostics.iter();
        found.flat_map(|found| results.of(found, path, &fixes)).collect::<Vec<_>>()
    };
    let written: Vec<Value> = reports.iter().flat_map(of_report).collect();
    let driver = json!({
        "name": "congruent",
        "semanticVersion": env!("CARGO_PKG_VERSION"),
        "rules": rules,
    });
    let run = json!({
        "tool": { "driver": driver },
        "columnKind": "unicodeCodePoints",
        "results": written,
    });
    Sarif { schema: "https://json.schemastore.org/sarif-2.1.0.json", version: "2.1.0", runs: [run] }
}

fn rule(code: &Code) -> Value {
    let Code { name, about, .. } = code;
    let first = about.split_inclusive(['.', ':']).next().unwrap_or(name).trim_end_matches(':');
    json!({
        "id": code.id_or_name(),
        "name": name,
        "shortDescription": { "text": first },
        "fullDescription": { "text": about },
        "help": { "text": about },
    })
}

impl SarifResults {
    fn fixes<'f>(&mut self, fixes: &'f [LintFix]) -> FixesByLine<'f> {
        let mut by_line = FixesByLine::new();
        for fix in fixes {
            let Some(first) = fix.edits.first() else { continue };
            let line = self.lines.line(&fix.source, first.span.start);
            by_line.entry((fix.code, &fix.source.path, line)).or_default().push(fix);
        }
        by_line
    }

    /// A finding of the file that was linted: a result for each of its places.
    fn of(&mut self, found: &Diagnostic, linted: &Path, fixes: &FixesByLine<'_>) -> Vec<Value> {
        let name = found.kind.plural_and_name.as_ref().map(|(_, name)| name.as_str());
        let whole = ResultPlace { message: &found.message, name, span: found.span.as_ref() };
        let mut one = |place: ResultPlace<'_>| {
            let mut result = self.result(found, linted, &place);
            if let (Some(source), Some(span)) = (&found.source, place.span) {
                let line = self.lines.line(source, span.start);
                if let Some(fixes) = fixes.get(&(found.code.name, &*source.path, line)) {
                    result["fixes"] = fixes.iter().map(|fix| self.fix(fix)).collect();
                }
            }
            result
        };
        match &found.kind.occurrences[..] {
            [] => vec![one(whole)],
            several => several.iter().map(|each| one(each.into())).collect(),
        }
    }

    fn result(&mut self, found: &Diagnostic, linted: &Path, place: &ResultPlace<'_>) -> Value {
        let id = found.code.id_or_name();
        let level = match found.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
        };
        let help = found.help.as_ref().map_or_else(String::new, |help| format!("; {help}"));
        let artifact = self.artifact(found.source.as_ref().map_or(linted, |source| &source.path));
        let fingerprint = self.fingerprint(id, &artifact, place);
        let source = found.source.as_deref();
        let mut result = json!({
            "ruleId": id,
            "level": level,
            "message": { "text": format!("{}{help}", place.message) },
            "locations": [{ "physicalLocation": self.location(&artifact, source, place.span) }],
            "partialFingerprints": { "congruentFinding/v1": fingerprint },
        });
        if let Some(rule) = self.codes.keys().position(|known| *known == found.code.name) {
            result["ruleIndex"] = json!(rule);
        }
        if let Some(related) = &found.kind.related {
            let physical = self.location(&artifact, source, related.span.as_ref());
            let message = json!({ "text": related.message });
            result["relatedLocations"] = json!([{ "physicalLocation": physical, "message": message }]);
        }
        result
    }

    /// Identity of a result that does not change with lines added before it: its rule, its file and its subject.
    fn fingerprint(&mut self, id: &str, artifact: &Value, place: &ResultPlace<'_>) -> String {
        let about = place.name.unwrap_or(place.message);
        let key = format!("{id} {} {about}", artifact["uri"]);
        // Results that differ only in their line are numbered, since a fingerprint must be unique in its file.
        let before = self.fingerprints.entry(key.clone()).or_default();
        *before += 1;
        format!("{:016x}:{before}", hash(&key))
    }

    /// A place in a file; its first line if it is about the whole file, since code hosts show no finding without one.
    fn location(
        &mut self,
        artifact: &Value,
        source: Option<&SourceFile>,
        span: Option<&Range<usize>>,
    ) -> Value {
        let region = match (source, span) {
            (Some(source), Some(span)) => self.region(source, span),
            _ => json!({ "startLine": 1 }),
        };
        json!({ "artifactLocation": artifact, "region": region })
    }

    /// Lines and columns from 1; the end is the column behind the last character.
    fn region(&mut self, source: &SourceFile, span: &Range<usize>) -> Value {
        let (line, column) = self.lines.line_column(source, span.start);
        let mut region = json!({ "startLine": line, "startColumn": column });
        if span.end > span.start {
            let (line, column) = self.lines.line_column(source, span.end);
            region["endLine"] = json!(line);
            region["endColumn"] = json!(column);
        }
        region
    }

    fn fix(&mut self, fix: &LintFix) -> Value {
        let replacement = |edit: &TextEdit| {
            let inserted = json!({ "text": edit.text });
            json!({ "deletedRegion": self.region(&fix.source, &edit.span), "insertedContent": inserted })
        };
        let replacements: Vec<Value> = fix.edits.iter().map(replacement).collect();
        let artifact = self.artifact(&fix.source.path);
        json!({
            "description": { "text": fix.about },
            "artifactChanges": [{ "artifactLocation": artifact, "replacements": replacements }],
        })
    }

    /// A file as code hosts find it: by its path from the top of the repository, else from the current folder, else whole.
    fn artifact(&self, path: &Path) -> Value {
        let current = || std::env::current_dir().ok()?.canonicalize().ok();
        let top = self.top.clone().or_else(current);
        let below = top.and_then(|top| inside(path, &top));
        let whole = || path.canonicalize().unwrap_or_else(|_| path.to_owned());
        let file = below.unwrap_or_else(whole);
        if file.is_absolute() {
            json!({ "uri": format!("file://{}", uri(&file)) })
        } else {
            json!({ "uri": uri(&file), "uriBaseId": "%SRCROOT%" })
        }
    }
}

/// FNV-1a of 64 bits. Source: Fowler, Noll, Vo; RFC 9923.
fn hash(text: &str) -> u64 {
    text.bytes()
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

/// The parts of a path with slashes between, every byte escaped that has a meaning in a URI.
fn uri(path: &Path) -> String {
    let part = |part: Component<'_>| match part {
        Component::RootDir => None,
        Component::Prefix(prefix) => match prefix.kind() {
            Prefix::Disk(letter) | Prefix::VerbatimDisk(letter) => Some(format!("/{}:", char::from(letter))),
            _ => Some(escaped(prefix.as_os_str().as_encoded_bytes())),
        },
        other => Some(escaped(other.as_os_str().as_encoded_bytes())),
    };
    let parts: Vec<String> =
        path.components().filter(|part| *part != Component::CurDir).filter_map(part).collect();
    // `join` gives the root no slash of its own.
    let starts_at_root = path.components().next() == Some(Component::RootDir);
    format!("{}{}", if starts_at_root { "/" } else { "" }, parts.join("/"))
}

fn escaped(bytes: &[u8]) -> String {
    let mut escaped = String::with_capacity(bytes.len());
    for &byte in bytes {
        if byte.is_ascii_alphanumeric() || b"-._~".contains(&byte) {
            escaped.push(char::from(byte));
        } else {
            let _ = write!(escaped, "%{byte:02X}");
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use congruent::input::Diagnostics;

    use super::*;

    fn results(found: &[Diagnostic]) -> Vec<Value> {
        let codes = found.iter().map(|found| (found.code.name, found.code)).collect();
        let mut results =
            SarifResults { top: None, codes, fingerprints: BTreeMap::new(), lines: Lines::default() };
        let none = FixesByLine::new();
        found.iter().flat_map(|found| results.of(found, Path::new("a.urdf"), &none)).collect()
    }

    #[test]
    fn every_place_is_a_result_with_its_region() {
        let source = Arc::new(SourceFile {
            path: "my robot/a.urdf".into(),
            text: "ab\né<x>\n<y>\n".to_owned(),
            is_foreign: false,
        });
        let mut found = Diagnostics::default();
        for (name, span) in [("x", 5..7), ("y", 9..11)] {
            let warning = Diagnostic::warning(
                congruent::description::codes::urdf::MASSLESS,
                format!("link {name} has no mass"),
            );
            found.push(warning.one_of("links have no mass", name).at(span));
        }
        let results = results(&found.in_file(&source));
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

    #[test]
    fn a_fingerprint_stays_when_lines_are_added() {
        let of = |lines: &str, names: &[&str]| -> Vec<Value> {
            let source = Arc::new(SourceFile {
                path: "a.urdf".into(),
                text: format!("{lines}<x>"),
                is_foreign: false,
            });
            let fault = |name: &&str| {
                Diagnostic::error(congruent::description::codes::urdf::MASS, format!("link {name}: negative"))
            };
            let at = lines.len()..lines.len() + 2;
            let found: Vec<Diagnostic> =
                names.iter().map(|name| fault(name).at(at.clone()).in_file(&source)).collect();
            results(&found).into_iter().map(|result| result["partialFingerprints"].clone()).collect()
        };
        let both = of("", &["x", "y", "x"]);
        assert_eq!(both, of("\n\n\n", &["x", "y", "x"]));
        assert!(both[0] != both[1] && both[0] != both[2], "{both:?}");
        assert_eq!(of("", &["y"])[0], both[1]);
    }

    #[test]
    fn a_path_is_a_uri() {
        for (path, expected) in [
            ("robots/my arm/ärm#1.urdf", "robots/my%20arm/%C3%A4rm%231.urdf"),
            ("./a.urdf", "a.urdf"),
            ("../a%b.urdf", "../a%25b.urdf"),
            ("/r/a:b?.urdf", "/r/a%3Ab%3F.urdf"),
        ] {
            assert_eq!(uri(Path::new(path)), expected);
        }
        let backslash = if cfg!(windows) { "a/b" } else { "a%5Cb" };
        assert_eq!(uri(Path::new("a\\b")), backslash);
    }
}
