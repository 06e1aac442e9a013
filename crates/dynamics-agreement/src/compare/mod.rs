//! The comparison from end to end: torques, then a cause for their difference, then the report.
//!
//! Names, lines and edits are made in `report`, values that differ in `differences`; neither takes anything from here.

mod compare_descriptions;
mod compare_long;
mod compare_with_source;
mod link_by_link;
mod named_diagnosis;
mod statements;
mod unmatched;

pub use compare_descriptions::{CompareError, certify, compare};
pub use compare_with_source::compare_with_source;
pub use named_diagnosis::NamedModel;
