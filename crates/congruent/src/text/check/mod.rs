//! What `congruent check` prints: the answer and the comparisons, the errors at requested configurations, the diagnosis of
//! poses, and dynamics.

mod diagnosis;
mod dynamics;
mod errors_at;
mod mapping;
mod whole;

pub use errors_at::{shown_pairs, tip_differences};
pub use whole::{CheckTextParts, check_text, check_text_parts};
