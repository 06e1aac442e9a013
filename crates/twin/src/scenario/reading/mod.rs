//! Scenario files: text to data, with the places of all values, and overrides of single keys.

mod faults;
mod file;
mod overrides;
mod section;

pub use file::ScenarioFile;
pub use overrides::Override;
