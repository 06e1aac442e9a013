//! The cases of `[uncertainty]`: what of a run each of them keeps, and what all of them show of each check.

mod case_checks;
mod key_importance;
mod requirement;
mod sentence;
mod uncertainty_report;

pub use case_checks::CaseChecks;
pub use key_importance::KeyImportance;
pub use requirement::{PassingShare, RequirementResult, RequirementVerdict};
pub(super) use sentence::uncertainty_sentence;
pub use sentence::{
    QuantityWords, case_lines, cases_title, decided_by, passes_in, requirement_sentence, unfinished_words,
};
pub use uncertainty_report::{
    CaseHistogram, CheckInCases, QuantityInCases, UncertaintyReport, UnfinishedCase, VariedValue,
};
