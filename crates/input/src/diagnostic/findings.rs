//! Everything for which an input is refused, as one error. [`Diagnostics`](super::Diagnostics) collects and joins, and may be
//! empty or have warnings alone; this is what is returned.

use std::{error::Error, fmt, ops::Index, slice, vec};

use super::diagnostic::Diagnostic;

/// Why an input is refused: at least one diagnostic, in the order of the text. Warnings that were found with the errors
/// are in it.
///
/// `Display` and `Debug` give one message in each line, without the lines of the file, so that
/// `fn main() -> Result<(), Findings>` prints what is wrong.
///
/// # Examples
/// ```
/// use congruent_input::{Diagnostic, Findings, codes::toml::NOT_FINITE};
/// fn positive(value: f64) -> Result<f64, Diagnostic> {
///     if value > 0.0 { Ok(value) } else { Err(Diagnostic::error(NOT_FINITE, format!("{value} is not positive"))) }
/// }
/// fn ratio(a: f64, b: f64) -> Result<f64, Findings> {
///     Ok(positive(a)? / positive(b)?)
/// }
/// let refused = ratio(1.0, -2.0).unwrap_err();
/// assert_eq!(refused.to_string(), "-2 is not positive");
/// assert!(refused.into_iter().all(|finding| finding.code == NOT_FINITE));
/// ```
#[derive(Clone, PartialEq)]
pub struct Findings(Vec<Diagnostic>);

#[expect(clippy::len_without_is_empty, reason = "it is never empty")]
impl Findings {
    /// The first finding; there always is one.
    pub fn first(&self) -> &Diagnostic {
        &self.0[0]
    }

    /// The first alone, without the others.
    pub fn into_first(mut self) -> Diagnostic {
        self.0.swap_remove(0)
    }

    /// All findings, in the order in which they were found.
    pub fn iter(&self) -> slice::Iter<'_, Diagnostic> {
        self.0.iter()
    }

    /// Number of findings, at least one.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// All findings, in the order in which they were found; never empty.
    pub fn into_vec(self) -> Vec<Diagnostic> {
        self.0
    }
}

impl From<Diagnostic> for Findings {
    fn from(finding: Diagnostic) -> Self {
        Self(vec![finding])
    }
}

/// # Panics
/// If the list is empty: an input must not be refused without a reason.
impl From<Vec<Diagnostic>> for Findings {
    fn from(findings: Vec<Diagnostic>) -> Self {
        assert!(!findings.is_empty(), "an input is refused for at least one reason");
        Self(findings)
    }
}

/// # Panics
/// If there are none.
impl FromIterator<Diagnostic> for Findings {
    fn from_iter<I: IntoIterator<Item = Diagnostic>>(findings: I) -> Self {
        Vec::from_iter(findings).into()
    }
}

impl Extend<Diagnostic> for Findings {
    fn extend<I: IntoIterator<Item = Diagnostic>>(&mut self, findings: I) {
        self.0.extend(findings);
    }
}

impl IntoIterator for Findings {
    type Item = Diagnostic;
    type IntoIter = vec::IntoIter<Diagnostic>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

impl<'a> IntoIterator for &'a Findings {
    type Item = &'a Diagnostic;
    type IntoIter = slice::Iter<'a, Diagnostic>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}

impl Index<usize> for Findings {
    type Output = Diagnostic;

    fn index(&self, index: usize) -> &Diagnostic {
        &self.0[index]
    }
}

impl fmt::Display for Findings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, finding) in self.0.iter().enumerate() {
            let line_break = if index == 0 { "" } else { "\n" };
            write!(f, "{line_break}{finding}")?;
        }
        Ok(())
    }
}

impl fmt::Debug for Findings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl Error for Findings {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_finding_is_a_line() {
        let mut found = Findings::from(Diagnostic::error(crate::codes::toml::NOT_FINITE, "wrong"));
        assert_eq!(found.to_string(), "wrong");
        found.extend([Diagnostic::warning(crate::codes::toml::UNKNOWN_KEY, "odd")]);
        assert_eq!((found.len(), found.to_string()), (2, "wrong\nodd".to_owned()));
        assert_eq!(format!("{found:?}"), found.to_string());
    }

    #[test]
    #[should_panic(expected = "at least one reason")]
    fn no_finding_is_no_error() {
        let _ = Findings::from(Vec::new());
    }
}
