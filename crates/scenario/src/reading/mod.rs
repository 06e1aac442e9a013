//! Scenario files: text to data, with the places of all values, and overrides of single keys.

mod expect;
mod faults;
mod file;
mod motion;
mod name;
mod other_file;
mod robot_overrides;
mod section;
mod written_numbers;

pub use file::ScenarioFile;
pub use name::scenario_name;
pub use robot_overrides::robot_overrides;
pub use written_numbers::written_numbers;
