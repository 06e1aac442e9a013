//! What the command `congruent` prints of reports, as text for people: a program or a test framework prints the same. The
//! functions only make text; nothing is written.
//!
//! Each takes the report. [`TextOptions`] says how wide the terminal is and whether it has colours, and
//! [`TextOptions::for_terminal`] is the last step before one.

mod calibration;
mod check;
mod comparison;
mod description;
mod fault_table;
mod findings;
pub mod layout;
mod lint;
mod options;
#[cfg(feature = "recording")]
mod recording;
mod run;

pub use calibration::calibration_text;
pub use check::{CheckTextParts, check_text, check_text_parts, shown_pairs, tip_differences};
pub use comparison::comparison_text;
pub use description::description_text;
pub use fault_table::fault_table_text;
pub use findings::{MOST_FINDINGS, finding_text, listed_findings};
pub use lint::lint_text;
pub use options::TextOptions;
#[cfg(feature = "recording")]
pub use recording::{disagreement_sentence, rechecked_text, recording_text};
pub use run::run_text;
