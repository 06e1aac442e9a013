//! Collects diagnostics, so that reading does not stop at the first fault. Warnings of one kind are joined.

use std::{
    collections::BTreeMap,
    ops::Range,
    path::{Path, PathBuf},
    sync::Arc,
};

use super::{
    diagnostic::{Capability, Diagnostic, Grouping, Occurrence, Severity, SourceFile},
    findings::Findings,
    line_counter::LineCounter,
};
use crate::display::first_of;

/// The diagnostics of one input so far.
#[derive(Debug, Default)]
pub struct Diagnostics(Vec<Diagnostic>);

impl Diagnostics {
    /// Adds a diagnostic at the end.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        self.0.push(diagnostic);
    }

    /// Adds several diagnostics at the end.
    pub fn extend(&mut self, diagnostics: impl IntoIterator<Item = Diagnostic>) {
        self.0.extend(diagnostics);
    }

    /// The value of `result`; its errors are added here.
    pub fn keep<T>(&mut self, result: Result<T, impl Into<Findings>>) -> Option<T> {
        result.map_err(|found| self.extend(found.into())).ok()
    }

    /// Applies a change to every diagnostic.
    #[must_use]
    pub fn map(self, change: impl FnMut(Diagnostic) -> Diagnostic) -> Self {
        Self(self.0.into_iter().map(change).collect())
    }

    /// Whether one of them is as `is_meant` says.
    pub fn any(&self, is_meant: impl FnMut(&Diagnostic) -> bool) -> bool {
        self.0.iter().any(is_meant)
    }

    /// Drops the findings that are not as `is_kept` says.
    pub fn retain(&mut self, is_kept: impl FnMut(&Diagnostic) -> bool) {
        self.0.retain(is_kept);
    }

    /// Whether one of them is about a key that was meant to be this one.
    pub fn has_misspelt(&self, key: &str) -> bool {
        self.any(|found| found.is_misspelt(key))
    }

    /// Whether a finding inside a byte range blocks physics.
    pub fn blocks_physics_within(&self, range: &Range<usize>) -> bool {
        let within = |found: &Diagnostic| found.span.as_ref().is_some_and(|span| range.contains(&span.start));
        self.0.iter().any(|found| found.stops == Some(Capability::Physics) && within(found))
    }

    /// Number of diagnostics so far.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether any of them is an error.
    pub fn has_error(&self) -> bool {
        self.0.iter().any(|diagnostic| diagnostic.severity == Severity::Error)
    }

    /// All diagnostics in the order of the text; warnings of one kind in one file are one, at the place of the
    /// first.
    pub fn into_vec(mut self) -> Vec<Diagnostic> {
        self.sort();
        joined(self.0)
    }

    /// The same, each marked as being about `source` unless it already says otherwise.
    pub fn in_file(mut self, source: &Arc<SourceFile>) -> Vec<Diagnostic> {
        self.sort();
        joined(self.0.into_iter().map(|diagnostic| diagnostic.in_file(source)).collect())
    }

    fn sort(&mut self) {
        self.0.sort_by(|one, other| place(one).cmp(&place(other)));
    }
}

/// As [`Diagnostics::into_vec`].
///
/// # Panics
/// If there are none.
impl From<Diagnostics> for Findings {
    fn from(found: Diagnostics) -> Self {
        found.into_vec().into()
    }
}

fn joined(diagnostics: Vec<Diagnostic>) -> Vec<Diagnostic> {
    let mut joined_findings: Vec<Diagnostic> = Vec::with_capacity(diagnostics.len());
    let mut first_of_kind = BTreeMap::new();
    for diagnostic in diagnostics {
        // Errors stay apart: each must be corrected by itself.
        let first = match diagnostic.severity {
            Severity::Warning => *first_of_kind.entry(kind(&diagnostic)).or_insert(joined_findings.len()),
            Severity::Error => joined_findings.len(),
        };
        match joined_findings.get_mut(first) {
            Some(first) => join(first, diagnostic),
            None => joined_findings.push(diagnostic),
        }
    }
    for several in joined_findings.iter_mut().filter(|found| !found.kind.occurrences.is_empty()) {
        several.message = headline(several);
    }
    joined_findings
}

impl Diagnostic {
    /// The same without those of its occurrences that are about something of this name; `None` if none is left.
    #[must_use]
    pub fn without(mut self, name: &str) -> Option<Self> {
        if self.kind.occurrences.is_empty() {
            let own = self.kind.plural_and_name.as_ref().map(|(_, name)| name.as_str());
            return (own != Some(name)).then_some(self);
        }
        self.kind.occurrences.retain(|found| found.name.as_deref() != Some(name));
        let first = self.kind.occurrences.first()?.clone();
        self.span.clone_from(&first.span);
        if self.kind.occurrences.len() == 1 {
            self.kind.occurrences.clear();
            if let (Some((_, own)), Some(name)) = (&mut self.kind.plural_and_name, first.name) {
                *own = name;
            }
            return Some(Self { message: first.message, ..self });
        }
        self.message = headline(&self);
        Some(self)
    }
}

/// By file, first the one that is being read, then by place in it.
fn place(diagnostic: &Diagnostic) -> (Option<&Path>, Option<usize>) {
    (file(diagnostic), diagnostic.span.as_ref().map(|span| span.start))
}

fn file(diagnostic: &Diagnostic) -> Option<&Path> {
    diagnostic.source.as_ref().map(|source| source.path.as_path())
}

/// The properties that warnings must share to be joined.
fn kind(found: &Diagnostic) -> (Option<PathBuf>, &'static str, Option<Capability>, Option<String>) {
    let words = found.kind.plural_and_name.as_ref().map(|(words, _)| words.clone());
    (file(found).map(Path::to_owned), found.code.name, found.stops, words)
}

fn join(first: &mut Diagnostic, other: Diagnostic) {
    if first.kind.occurrences.is_empty() {
        first.kind.occurrences = occurrences(first.clone());
    }
    first.kind.occurrences.extend(occurrences(other));
}

fn occurrences(found: Diagnostic) -> Vec<Occurrence> {
    if found.kind.occurrences.is_empty() {
        let name = found.kind.plural_and_name.map(|(_, name)| name);
        vec![Occurrence { message: found.message, name, span: found.span }]
    } else {
        found.kind.occurrences
    }
}

/// One message for all: their number and their names, or the first message and the lines of the others.
fn headline(found: &Diagnostic) -> String {
    const MOST_LISTED: usize = 6;
    let Grouping { plural_and_name, occurrences, .. } = &*found.kind;
    let listed = |words: Vec<String>| first_of(&words, MOST_LISTED);
    if let Some((words, _)) = plural_and_name {
        let names = occurrences.iter().filter_map(|found| found.name.clone()).collect();
        return format!("{} {words}: {}", occurrences.len(), listed(names));
    }
    let (first, others) = (&occurrences[0].message, &occurrences[1..]);
    let mut places = found.source.as_ref().map(|source| LineCounter::new(&source.text));
    let line = |found: &Occurrence| {
        let (places, span) = (places.as_mut()?, found.span.as_ref()?);
        Some(places.line_column(span.start).0.to_string())
    };
    let lines: Vec<String> = others.iter().filter_map(line).collect();
    let places = match &lines[..] {
        [] => String::new(),
        [line] => format!(", at line {line}"),
        _ => format!(", at lines {}", listed(lines)),
    };
    format!("{first} (and {} more of this kind{places})", others.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source() -> Arc<SourceFile> {
        Arc::new(SourceFile { path: "a.urdf".into(), text: "1\n2\n3\n4\n".to_owned(), is_foreign: false })
    }

    #[test]
    fn warnings_of_one_kind_are_one() {
        let massless = |name: &str, at| {
            Diagnostic::warning(crate::codes::file::EMPTY, format!("link {name} has no mass"))
                .one_of("links have no mass", name)
                .at(at..at + 1)
        };
        let mut found = Diagnostics::default();
        found.extend([
            massless("c", 4),
            massless("a", 0),
            Diagnostic::warning(crate::codes::toml::UNKNOWN_KEY, "other").at(2..3),
        ]);
        let once = found.in_file(&source());
        let messages: Vec<&str> = once.iter().map(|found| found.message.as_str()).collect();
        assert_eq!(messages, ["2 links have no mass: a, c", "other"]);
        assert_eq!(once[0].line_column(), Some((1, 1)));
        // A list that is joined to another one is joined once more.
        let mut again = Diagnostics::default();
        again.extend(once);
        again.push(massless("d", 6).in_file(&source()));
        let again = again.into_vec();
        assert_eq!(again[0].message, "3 links have no mass: a, c, d");
        let own: Vec<&str> = again[0].kind.occurrences.iter().map(|found| found.message.as_str()).collect();
        assert_eq!(own, ["link a has no mass", "link c has no mass", "link d has no mass"]);
    }

    #[test]
    fn without_names_the_lines_are_listed_and_errors_stay_apart() {
        let mut found = Diagnostics::default();
        for at in [0, 4, 6] {
            found.push(Diagnostic::warning(crate::codes::toml::NOT_FINITE, format!("odd {at}")).at(at..at));
            found.push(Diagnostic::error(crate::codes::toml::UNKNOWN_KEY, format!("wrong {at}")).at(at..at));
        }
        let found = found.in_file(&source());
        let messages: Vec<&str> = found.iter().map(|found| found.message.as_str()).collect();
        assert_eq!(
            messages,
            ["odd 0 (and 2 more of this kind, at lines 3, 4)", "wrong 0", "wrong 4", "wrong 6"]
        );
    }

    #[test]
    fn what_stops_one_use_is_not_joined_with_what_stops_none() {
        let mut found = Diagnostics::default();
        found.push(Diagnostic::error(crate::codes::toml::NOT_FINITE, "drawn").needed_by(None));
        found.push(
            Diagnostic::error(crate::codes::toml::NOT_FINITE, "touched")
                .needed_by(Some(Capability::Clearance)),
        );
        found.push(
            Diagnostic::error(crate::codes::toml::NOT_FINITE, "moved")
                .needed_by(Some(Capability::Kinematics)),
        );
        let found = found.into_vec();
        let grades: Vec<_> = found.iter().map(|found| (found.severity, found.stops)).collect();
        assert_eq!(
            grades,
            [
                (Severity::Warning, None),
                (Severity::Warning, Some(Capability::Clearance)),
                (Severity::Error, None)
            ]
        );
    }
}
