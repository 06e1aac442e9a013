//! What the command `congruent` prints of reports, as text for people: a program or a test framework prints the same. The
//! functions only make text; nothing is written.
//!
//! Each takes the report. [`TextOptions`] says how wide the terminal is and whether it has colours, and
//! [`TextOptions::for_terminal`] is the last step before one.

mod check;
mod comparison;
#[cfg(feature = "recording")]
mod joint_sweep;
mod measured;
mod plan;

pub use check::{CheckTextParts, check_text, check_text_parts, shown_pairs, tip_differences};
pub use comparison::comparison_text;
pub use congruent_text::*;
#[cfg(feature = "recording")]
pub use joint_sweep::joint_sweep_text;
pub use measured::measured_text;
pub use plan::plan_report_text;
