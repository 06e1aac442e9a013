//! A scenario checked against its robot: nothing later validates again.

pub(crate) mod actuation;
mod checks;
mod cost;
mod default_values;
mod head;
mod load;
mod motions;
mod of_the_run;
mod output;
mod recorded;
mod run_setup;
mod start;
mod surroundings;
mod timing;
mod uncertain_case;
mod uncertainty;
mod written_at;

pub(crate) use actuation::ControlPeriod;
pub use actuation::{ControllerSetup, SensorSetup, TorqueTable};
pub use load::LoadRobot;
pub use of_the_run::is_of_the_run;
pub use recorded::RecordedSetup;
pub use run_setup::RunSetup;
pub(crate) use surroundings::LARGEST_M;
pub use uncertain_case::{CaseValue, KnownValues, UncertainCase};
