//! Scenario files: text to data, with the places of all values, and overrides of single keys.

mod faults;
mod file;
mod motion;
mod name;
mod other_file;
mod section;

pub use file::{ScenarioFile, robot_overrides};
pub use name::scenario_name;
