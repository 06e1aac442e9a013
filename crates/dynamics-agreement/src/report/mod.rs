//! The comparison as data and in words.

mod compare_descriptions;
mod content;
mod explained;
mod words;

pub use compare_descriptions::{CompareError, Description, compare};
pub use content::{DynamicsReport, Explanation, Name, Premise, Sides, Verdict};
