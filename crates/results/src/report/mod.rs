//! Results of a run for programs: `report.json` has everything, `junit.xml`, annotations and the summary the checks in the
//! formats of CI.

mod after_run;
mod annotations;
mod cases;
mod earlier;
mod fault_table;
mod junit;
mod portable;
mod run_report;
mod sentence;
mod source_report;
mod step_summary;
mod suite;
mod test_suite;
mod verdict_sentence;

pub use after_run::{AfterRun, diagnose_run, explain};
pub use annotations::github_annotations;
pub use cases::{
    CaseChecks, CaseHistogram, CheckInCases, KeyImportance, PassingShare, QuantityInCases, QuantityWords,
    RequirementResult, RequirementVerdict, UncertaintyReport, UnfinishedCase, VariedValue, case_lines,
    cases_title, decided_by, passes_in, requirement_sentence, unfinished_words,
};
pub use earlier::earlier_report;
pub use fault_table::{DetectedBy, FaultRow, FaultTable};
pub use junit::write_junit;
pub use run_report::{CaseOfRun, LinkSource, MotionTimes, RunClockReport, RunReport, Versions};
pub use sentence::{
    is_not_reached, joint_limit_words, limit_words, lines, margin_words, not_finite_words, quantity_words,
    sentence_at, share_in_full, value_and_margin,
};
pub use source_report::{ReportedJointTopic, ReportedPoses, SourceReport};
pub use step_summary::step_summary;
pub use suite::{CasePlace, ChangeSince, Clock, Reason, TestCase, TestResult, TestSuite};
pub use test_suite::{judged, planned_suite};
pub use verdict_sentence::{verdict_line, verdict_sentence, verdict_word};
