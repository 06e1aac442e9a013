//! What is wrong with an input: a diagnostic, several of them, and their form in JSON.

#[expect(clippy::module_inception, reason = "the type of this module")]
mod diagnostic;
mod diagnostics;
mod finding;
mod findings;
mod line_counter;

pub use diagnostic::{Capability, Diagnostic, Grouping, Occurrence, Severity, SourceFile, line_column};
pub use diagnostics::Diagnostics;
pub use finding::{Finding, FindingPlace};
pub use findings::Findings;
pub use line_counter::LineCounter;
