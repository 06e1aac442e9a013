//! `congruent run` and what works on its results: verdicts, the safety layer, faults, recordings, runs compared and resumed.

mod clearance_pairs;
mod comparing;
mod default_checks;
mod faults;
mod interruptions;
#[cfg(feature = "recording")]
mod recordings;
mod replay;
mod resuming;
mod safety;
mod same_everywhere;
mod scenarios;
mod servo;
#[cfg(feature = "db3")]
mod sqlite_bags;
mod sweep;
mod trajectories;
mod uncertainty;
mod velocity_rates;
mod watch;
