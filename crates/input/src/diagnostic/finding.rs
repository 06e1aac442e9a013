//! Diagnostics in the JSON of reports, and as one line.

use std::{borrow::Cow, fmt};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::visible::visible;

use super::{
    diagnostic::{Capability, Diagnostic, Occurrence, Severity},
    line_counter::LineCounter,
};

/// A diagnostic in the JSON of a report.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Finding {
    /// Severity: `error` or `warning`.
    pub severity: Severity,
    /// The use of the robot that this finding blocks; other uses are not affected.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub stops: Option<Capability>,
    /// Stable name of the kind of finding, as `urdf::axis`.
    pub code: Cow<'static, str>,
    /// Stable number, as in `CGR-URDF-017`; the causes of disagreements have none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub id: Option<String>,
    /// What is wrong, in one sentence.
    pub message: String,
    /// The file, if it is known.
    pub file: Option<String>,
    /// Line in the file, from 1.
    pub line: Option<usize>,
    /// Column in the line, in characters from 1.
    pub column: Option<usize>,
    /// How to correct it.
    pub help: Option<String>,
    /// Another place of the file that explains this one, such as where an element begins that is not closed.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub related: Option<FindingPlace>,
    /// If several findings of one kind were joined: each of them, up to 1000.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub places: Vec<FindingPlace>,
    /// Number of further places that are not listed.
    #[serde(skip_serializing_if = "is_none", default)]
    pub places_left_out: usize,
}

/// Most places of a finding. Kind: choice; a hundred kilobytes of JSON.
const MOST_PLACES: usize = 1000;

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands it over so")]
fn is_none(left_out: &usize) -> bool {
    *left_out == 0
}

/// One of several findings of a kind, or a place that explains a finding.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct FindingPlace {
    /// What is wrong at this place.
    pub message: String,
    /// The link, joint or file that it is about.
    pub name: Option<String>,
    /// Line in the file, from 1.
    pub line: Option<usize>,
    /// Column in the line, in characters from 1.
    pub column: Option<usize>,
}

impl From<&Diagnostic> for Finding {
    fn from(diagnostic: &Diagnostic) -> Self {
        let place = diagnostic.line_column();
        let mut places = diagnostic.source.as_ref().map(|source| LineCounter::new(&source.text));
        Self {
            severity: diagnostic.severity,
            stops: diagnostic.stops,
            code: diagnostic.code.name.into(),
            id: diagnostic.code.id.map(str::to_owned),
            message: diagnostic.message.clone(),
            file: diagnostic.source.as_ref().map(|source| source.path.display().to_string()),
            line: place.map(|(line, _)| line),
            column: place.map(|(_, column)| column),
            help: diagnostic.help.clone(),
            related: diagnostic.kind.related.as_ref().map(|found| finding_place(places.as_mut(), found)),
            places: diagnostic
                .kind
                .occurrences
                .iter()
                .take(MOST_PLACES)
                .map(|found| finding_place(places.as_mut(), found))
                .collect(),
            places_left_out: diagnostic.kind.occurrences.len().saturating_sub(MOST_PLACES),
        }
    }
}

fn finding_place(places: Option<&mut LineCounter<'_>>, found: &Occurrence) -> FindingPlace {
    let place = places.zip(found.span.as_ref()).map(|(places, span)| places.line_column(span.start));
    FindingPlace {
        message: found.message.clone(),
        name: found.name.clone(),
        line: place.map(|(line, _)| line),
        column: place.map(|(_, column)| column),
    }
}

/// One line: the place, what is wrong, what to do.
impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.file, self.line) {
            (Some(file), Some(line)) => write!(f, "{}:{line}: ", visible(file))?,
            (Some(file), None) => write!(f, "{}: ", visible(file))?,
            (None, _) => {}
        }
        f.write_str(&self.message)?;
        match &self.help {
            Some(help) => write!(f, "; {help}"),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::Diagnostics;

    #[test]
    fn a_finding_has_so_many_places_and_the_number_of_the_others() {
        let found = |count: usize| {
            let mut all = Diagnostics::default();
            let one = |at: usize| {
                Diagnostic::warning(crate::codes::toml::NOT_FINITE, "odd")
                    .one_of("odd things", at.to_string())
            };
            all.extend((0..count).map(one));
            Finding::from(&all.into_vec()[0])
        };
        let (few, many) = (found(3), found(MOST_PLACES + 7));
        assert_eq!((few.places.len(), few.places_left_out), (3, 0));
        assert_eq!((many.places.len(), many.places_left_out), (MOST_PLACES, 7));
    }
}
