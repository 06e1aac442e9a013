//! `[expect]`: the expected verdict.

use congruent_input::{Diagnostic, Findings, known_names};
use serde::Deserialize;
use toml::Spanned;

use super::section::Section;
use crate::{CheckKind, Expectation, codes};

pub(super) fn read_expect(mut section: Section<'_>) -> Result<Expectation, Findings> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Named {
        #[serde(default)]
        checks: Vec<Spanned<String>>,
    }
    let span = section.span();
    let verdict = *section.select("verdict", "expected verdict", &["pass", "fail"], |name| name)?;
    let Named { checks } = section.read()?;
    let kind = |name: Spanned<String>| check_kind(name.get_ref()).map_err(|error| error.at(name.span()));
    let checks: Vec<CheckKind> = checks.into_iter().map(kind).collect::<Result<_, _>>()?;
    match (verdict, checks.is_empty()) {
        ("fail", _) => Ok(Expectation::Fail { checks }),
        (_, true) => Ok(Expectation::Pass),
        (_, false) => Err(Diagnostic::error(codes::scenario::EXPECT, "`checks` needs verdict = \"fail\"")
            .with_help("`checks` names the checks that must fail: change the verdict, or remove `checks`")
            .at(span)
            .into()),
    }
}

/// A kind of check by its name, with the nearest known one if there is none.
fn check_kind(name: &str) -> Result<CheckKind, Diagnostic> {
    CheckKind::ALL.into_iter().find(|kind| kind.word() == name).ok_or_else(|| {
        Diagnostic::error(codes::scenario::UNKNOWN_KIND, format!("unknown kind of check \"{name}\""))
            .with_help(known_names(name, "kinds", CheckKind::ALL.map(CheckKind::word)))
    })
}
