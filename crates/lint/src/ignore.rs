//! `[[lint.ignore]]` of a robot file: warnings that the author knows and accepts.

use std::{path::PathBuf, sync::Arc};

use congruent_description::{WrittenIgnore, WrittenLint};
use congruent_input::{Code, Diagnostic, Severity, SourceFile};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::codes;

/// The entries of `[[lint.ignore]]` of a robot file.
#[derive(Debug, Clone, Default)]
pub struct Ignores {
    source: Option<Arc<SourceFile>>,
    written: WrittenLint,
}

/// An entry of `[[lint.ignore]]` that has ignored something.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct IgnoredFinding {
    /// Number of the code of the warnings, as in `CGR-URDF-017`.
    pub id: String,
    /// Name of the code, as in `urdf::massless`.
    pub code: &'static str,
    /// Why the warnings are no fault, as the robot file says.
    pub reason: String,
    /// How many places were ignored.
    pub places: usize,
}

/// The section of a robot file that is read here; all other keys are skipped, since they may be wrong.
#[derive(Deserialize)]
struct LintAlone {
    #[serde(default)]
    lint: WrittenLint,
}

impl Ignores {
    /// Reads the entries of a robot file; none if the file is not valid, which its own reader reports.
    pub fn from_robot_file(source: &Arc<SourceFile>) -> Self {
        // A file that cannot be read has been reported by its reader.
        let written = toml::from_str::<LintAlone>(&source.text).map(|file| file.lint).unwrap_or_default();
        Self { source: Some(Arc::clone(source)), written }
    }

    /// Path of the robot file with these entries.
    pub fn path(&self) -> Option<PathBuf> {
        self.source.as_ref().map(|source| source.path.clone())
    }

    /// Removes the ignored findings from `found`, and adds the faults of the entries themselves, which name `known` codes.
    pub fn apply(
        &self,
        mut found: Vec<Diagnostic>,
        known: &[&'static Code],
    ) -> (Vec<Diagnostic>, Vec<IgnoredFinding>) {
        let (mut wrong, mut ignored) = (Vec::new(), Vec::new());
        for entry in &self.written.ignore {
            match apply_one(entry.get_ref(), &mut found, known) {
                Ok(done) => ignored.push(done),
                Err(fault) => wrong.push(match &self.source {
                    Some(source) => fault.at(entry.get_ref().code.span()).in_file(source),
                    None => fault,
                }),
            }
        }
        found.extend(wrong);
        (found, ignored)
    }
}

fn apply_one(
    entry: &WrittenIgnore,
    found: &mut Vec<Diagnostic>,
    known: &[&'static Code],
) -> Result<IgnoredFinding, Diagnostic> {
    let written = entry.code.get_ref();
    let refused = |what: String| Diagnostic::error(codes::lint::IGNORE, format!("\"{written}\" {what}"));
    let Some(code) = Code::find(written, known) else {
        let nearest = Code::nearest(written, known);
        let help = nearest
            .map_or_else(String::new, |near| format!("did you mean {}, {}?", near.id_or_name(), near.name));
        return Err(refused("is not the code of a finding".to_owned()).with_help(help));
    };
    if entry.reason.trim().is_empty() {
        return Err(refused("is ignored without a reason".to_owned())
            .with_help("add reason = \"...\", so that later readers of the file know why"));
    }
    if found.iter().any(|found| found.code == code && found.severity == Severity::Error) {
        return Err(refused("is an error here, and errors cannot be ignored".to_owned())
            .with_help("correct what is wrong, and remove the entry"));
    }
    let places = |found: &[Diagnostic]| -> usize {
        let of_code = found.iter().filter(|found| found.code == code);
        of_code.map(|found| found.kind.occurrences.len().max(1)).sum()
    };
    // Counted before and after, since one finding may list several links, of which only the named one is removed.
    let before = places(found);
    *found = std::mem::take(found)
        .into_iter()
        .filter_map(|found| match &entry.name {
            _ if found.code != code => Some(found),
            None => None,
            Some(name) => found.without(name),
        })
        .collect();
    let places = before - places(found);
    let id = code.id_or_name();
    if places == 0 {
        let of = entry.name.as_ref().map_or_else(String::new, |name| format!(" of \"{name}\""));
        let message = format!("no finding {id} ({}){of} occurs, so this entry ignores nothing", code.name);
        return Err(Diagnostic::warning(codes::lint::IGNORED_NOTHING, message)
            .with_help("remove the entry, so that it does not hide a finding later"));
    }
    Ok(IgnoredFinding { id: id.to_owned(), code: code.name, reason: entry.reason.clone(), places })
}

#[cfg(test)]
mod tests {
    use super::*;
    use congruent_input::Diagnostics;

    fn massless(names: &[&str]) -> Vec<Diagnostic> {
        let source =
            Arc::new(SourceFile { path: "r.urdf".into(), text: "abc".to_owned(), is_foreign: false });
        let mut found = Diagnostics::default();
        for (at, name) in names.iter().enumerate() {
            let warning = Diagnostic::warning(
                congruent_description::codes::urdf::MASSLESS,
                format!("link {name} has no mass"),
            );
            found.push(warning.one_of("links have no mass", *name).at(at..at));
        }
        found.in_file(&source)
    }

    fn applied(entries: &str, found: Vec<Diagnostic>) -> (Vec<String>, Vec<IgnoredFinding>) {
        let text = format!("urdf = 'r.urdf'\n{entries}");
        let ignores = Ignores::from_robot_file(&Arc::new(SourceFile {
            path: "robot.toml".into(),
            text,
            is_foreign: false,
        }));
        let (kept, ignored) = ignores.apply(found, congruent_description::codes::ALL);
        (kept.into_iter().map(|found| found.message).collect(), ignored)
    }

    #[test]
    fn a_whole_kind_or_one_name_is_ignored() {
        let all = "[[lint.ignore]]\ncode = 'CGR-URDF-028'\nreason = 'frames'";
        let (kept, ignored) = applied(all, massless(&["a", "b", "c"]));
        assert_eq!((kept.len(), ignored[0].places, ignored[0].reason.as_str()), (0, 3, "frames"));
        let one = "[[lint.ignore]]\ncode = 'urdf::massless'\nreason = 'a frame'\nname = 'a'";
        let (kept, ignored) = applied(one, massless(&["a", "b", "c"]));
        assert_eq!((kept, ignored[0].places), (vec!["2 links have no mass: b, c".to_owned()], 1));
        let (kept, _) = applied(one, massless(&["a", "b"]));
        assert_eq!(kept, ["link b has no mass"]);
        let (kept, _) = applied(one, massless(&["a"]));
        assert_eq!(kept, [""; 0]);
    }

    #[test]
    fn what_ignores_nothing_is_reported() {
        let entry = |code: &str, reason: &str| {
            format!("[[lint.ignore]]\ncode = '{code}'\nreason = '{reason}'\nname = 'z'")
        };
        for (code, reason, message) in [
            ("urdf::massless", "x", "this entry ignores nothing"),
            ("urdf::masless", "x", "is not the code of a finding"),
            ("urdf::massless", " ", "without a reason"),
        ] {
            let (kept, ignored) = applied(&entry(code, reason), massless(&["a"]));
            assert!(kept[1].contains(message) && ignored.is_empty(), "{kept:?}");
        }
    }

    #[test]
    fn an_error_is_not_ignored() {
        let error = vec![Diagnostic::error(congruent_description::codes::urdf::MASS, "mass -1 is negative")];
        let (kept, ignored) = applied("[[lint.ignore]]\ncode = 'urdf::mass'\nreason = 'x'", error);
        assert!(kept[0].contains("negative") && kept[1].contains("cannot be ignored") && ignored.is_empty());
    }
}
